#include "draw/legend.hpp"

#include <utility>
#include <vector>

#include "draw/marks.hpp"
#include "draw/panels.hpp"
#include "draw/pen.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/motion.hpp"

namespace lantern::draw {
namespace {

constexpr double kSampleWide = 58, kSampleHigh = 38;  // page units
constexpr double kCutRim = 6;                         // of a world, around what a sample shows
constexpr double kLegendRow = 46;
constexpr double kBeforeWords = 12, kBetweenEntries = 36;
const TextStyle kWordStyle{24, Weight::regular, Role::quiet_ink};

// A world of the sample's proportions: what it holds is seen as it is, a unit a page unit.
Frame blank_world() {
  Frame frame;
  frame.bounds = {{0, 0, 0}, {kSampleWide + 2 * kCutRim - 6, kSampleHigh + 2 * kCutRim - 6, 0}};
  frame.display.names = ShownNames::none;
  return frame;
}

Vec<3> middle_of_world(const Frame& frame) { return frame.bounds.center(); }

FrameBody& add_ball(Frame& frame, const Vec<2>& at, double radius) {
  FrameBody body;
  body.id = static_cast<BodyId>(frame.bodies.size());
  body.look = Look::disc;
  body.color = 4;
  body.shape = Sphere{radius};
  body.position = {at.x, at.y, 0};
  body.box = {{at.x - radius, at.y - radius, 0}, {at.x + radius, at.y + radius, 0}};
  return frame.bodies.emplace_back(body);
}

FrameNode& add_cell(Frame& frame, const Box<3>& box, std::uint32_t parent) {
  FrameNode node;
  node.id = static_cast<std::uint32_t>(frame.nodes.size());
  node.parent = parent;
  node.depth = parent == kNone ? 0 : 1;
  node.box = box;
  return frame.nodes.emplace_back(node);
}

void add_link(Frame& frame, FrameLink::Kind kind) {
  const Vec<3> c = middle_of_world(frame);
  const double reach = kind == FrameLink::Kind::pin ? 0 : 20;
  frame.add<FrameLinks>().links.push_back(
      {kind, c - Vec<3>(reach, 0, 0), c + Vec<3>(reach, 0, 0), 0});
}

// One cell of a world that is marked so.
void add_marked(Frame& frame, Mark mark, bool awake) {
  if (awake) add_cell(frame, frame.bounds, kNone).leaf = false;
  FrameNode& node = add_cell(frame, frame.bounds, awake ? 0 : kNone);
  node.mark = mark;
  node.awake = awake;
  if (!awake) node.bodies = {0};
}

// A quadtree's node whose lower right quarter fills the picture, and is not made.
void add_unmade(Frame& frame) {
  frame.structure = StructureKind::quadtree;
  FrameNode& node = add_cell(frame, frame.bounds, kNone);
  node.leaf = false;
  node.box.lo.x -= frame.bounds.size().x;
  node.box.hi.y += frame.bounds.size().y;
}

void add_bodies(Frame& frame, MarkKind kind) {
  const Vec<3> c = middle_of_world(frame);
  switch (kind) {
    case MarkKind::static_body: {
      FrameBody& body = add_ball(frame, {c.x, c.y}, 12);
      body.look = Look::box;
      body.shape = AxisBox<3>{{12, 12, 0}};
      body.is_static = true;
      break;
    }
    case MarkKind::sleeping_body:
      add_ball(frame, {c.x, c.y}, 13).asleep = true;
      break;
    case MarkKind::ruled_out:
      add_ball(frame, {c.x, c.y}, 13).dimmed = true;
      break;
    default:
      add_ball(frame, {c.x, c.y}, 11);
  }
}

void add_question(Frame& frame, MarkKind kind) {
  const Vec<3> c = middle_of_world(frame);
  const Vec<3> along{22, 0, 0};
  if (kind == MarkKind::ray) frame.add<FrameFinding>().rays.push_back({c - along, c + along, {}});
  if (kind == MarkKind::region)
    frame.add<FrameFinding>().queries.push_back(
        {{c - Vec<3>(20, 10, 0), c + Vec<3>(20, 10, 0)}, 0});
  if (kind == MarkKind::view)
    frame.add<FrameFinding>().views.push_back(
        {c - along, {c - along, c + Vec<3>(22, -12, 0), c + Vec<3>(22, 12, 0)}});
}

// The smallest world that carries the mark.
Frame sample_of(MarkKind kind) {
  Frame frame = blank_world();
  switch (kind) {
    case MarkKind::lit:
    case MarkKind::passed:
      add_marked(frame, kind == MarkKind::lit ? Mark::lit : Mark::passed, true);
      frame.nodes[1].box = {frame.bounds.lo + Vec<3>(8, 8, 0), frame.bounds.hi - Vec<3>(8, 8, 0)};
      break;
    case MarkKind::sleeping_cell:
      add_marked(frame, Mark::quiet, false);
      break;
    case MarkKind::not_made:
      add_unmade(frame);
      break;
    case MarkKind::spring:
      add_link(frame, FrameLink::Kind::spring);
      break;
    case MarkKind::rod:
      add_link(frame, FrameLink::Kind::distance);
      break;
    case MarkKind::ray:
    case MarkKind::region:
    case MarkKind::view:
      add_question(frame, kind);
      break;
    default:
      add_bodies(frame, kind);
  }
  frame.display.boxes = kind == MarkKind::box;
  return frame;
}

DrawList drawn_sample(MarkKind kind, const Box<2>& box) {
  DrawList list;
  Labels labels(list);
  const Frame sample = sample_of(kind);
  draw_world(sample, Staging(sample), shrunk(box, -kCutRim), list, labels);
  keep_within(list, 0, box);  // without the world's border
  return list;
}

struct Entry {
  MarkKind kind;
  double x = 0;  // of its left end, within its row
  int row = 0;
};

std::vector<Entry> entries_of(const MarkSet& marks, double width) {
  std::vector<Entry> entries;
  double x = 0;
  int row = 0;
  for (unsigned i = 0; i < kMarkKinds; ++i) {
    const auto kind = static_cast<MarkKind>(i);
    if (!marks.has(kind)) continue;
    const double needed = kSampleWide + kBeforeWords + text_width(words_of(kind), kWordStyle);
    if (x > 0 && x + needed > width) {
      x = 0;
      ++row;
    }
    entries.push_back({kind, x, row});
    x += needed + kBetweenEntries;
  }
  return entries;
}

}  // namespace

std::string_view words_of(MarkKind kind) {
  // By MarkKind.
  static constexpr std::string_view kWords[] = {"in question",
                                                "passed",
                                                "not made",
                                                "asleep: not searched",
                                                "never moves",
                                                "asleep",
                                                "not found",
                                                "to test",
                                                "to test, among many",
                                                "apart by box",
                                                "apart by shape",
                                                "box overlap",
                                                "contact",
                                                "contact begins",
                                                "impulse",
                                                "velocity",
                                                "force",
                                                "length",
                                                "box",
                                                "ray",
                                                "hit",
                                                "order of cells",
                                                "view",
                                                "region",
                                                "found",
                                                "skipped, with all below",
                                                "centre",
                                                "spring",
                                                "rod",
                                                "pin",
                                                "reach along the axis",
                                                "gap",
                                                "way out along the axis",
                                                "farthest point",
                                                "points kept",
                                                "origin",
                                                "portal",
                                                "line of sight",
                                                "step before step",
                                                "next, if it meets nothing",
                                                "a look within the step"};
  static_assert(std::size(kWords) == kMarkKinds);
  return kWords[static_cast<std::size_t>(kind)];
}

MarkSet marks_of_sample(MarkKind kind) {
  DrawList plain;
  if (draw_mark(kind, {{0, 0}, {kSampleWide, kSampleHigh}}, plain)) {
    plain.marks.add(kind);
    return plain.marks;
  }
  return drawn_sample(kind, {{0, 0}, {kSampleWide, kSampleHigh}}).marks;
}

void draw_sample(MarkKind kind, const Box<2>& box, DrawList& list) {
  if (draw_mark(kind, box, list)) return;
  DrawList own = drawn_sample(kind, box);
  for (DrawShape& shape : own.shapes)
    if (!std::holds_alternative<TextShape>(shape)) list.shapes.push_back(std::move(shape));
}

double legend_height(const MarkSet& marks, double width) {
  const std::vector<Entry> entries = entries_of(marks, width);
  return entries.empty() ? 0 : kLegendRow * (entries.back().row + 1);
}

void draw_legend(const MarkSet& marks, const Box<2>& strip, DrawList& list, Labels& labels) {
  for (const Entry& entry : entries_of(marks, strip.size().x)) {
    const DrawList::Scope scope(list, "legend/" + std::string(words_of(entry.kind)));
    const Vec<2> corner = strip.lo + Vec<2>(entry.x, entry.row * kLegendRow);
    const Box<2> sample{corner, corner + Vec<2>(kSampleWide, kSampleHigh)};
    draw_sample(entry.kind, sample, list);
    labels.add(words_of(entry.kind),
               centred({sample.hi.x + kBeforeWords, sample.center().y}, kWordStyle, 0), kWordStyle,
               strip);
  }
}

}  // namespace lantern::draw
