#include <utility>
#include <vector>

#include "draw/marks.hpp"
#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/pen.hpp"
#include "draw/world/narrow_marks.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/motion.hpp"

namespace lantern::draw {
namespace {

using frame::PairState;

constexpr double kSampleWide = 58, kSampleHigh = 38;  // page units
constexpr double kCutRim = 6;                         // of a world, around what a sample shows
constexpr double kLegendRow = 46;
constexpr double kBeforeWords = 12, kBetweenEntries = 36;

// A place for a sample: its middle, its ends, and points within them.
struct Sample {
  Pen& pen;
  DrawList& list;
  Vec<2> c{0.0}, left{0.0}, right{0.0};
  Vec<2> a{left.x + 8, left.y}, b{right.x - 8, right.y};
};

template <PairState state, bool full = true>
void draw_linked(const Sample& s) {
  draw_link(s.left, s.right, {state, full}, s.pen);
}

FrameBody& add_ball(Frame& frame, double radius) {
  FrameBody body;
  body.id = static_cast<BodyId>(frame.bodies.size());
  body.look = Look::disc;
  body.color = 4;
  body.shape = Sphere{radius};
  body.position = frame.bounds.center();
  body.box = Box<3>::around(body.position, {radius, radius, 0});
  return frame.bodies.emplace_back(body);
}

FrameNode& add_cell(Frame& frame, std::uint32_t parent) {
  FrameNode node;
  node.id = static_cast<std::uint32_t>(frame.nodes.size());
  node.parent = parent;
  node.depth = parent == kNone ? 0 : 1;
  node.box = frame.bounds;
  return frame.nodes.emplace_back(node);
}

// One cell of a world that is marked so.
void add_marked(Frame& frame, Mark mark) {
  add_cell(frame, kNone).leaf = false;
  FrameNode& node = add_cell(frame, 0);
  node.mark = mark;
  node.box = {frame.bounds.lo + Vec<3>(8, 8, 0), frame.bounds.hi - Vec<3>(8, 8, 0)};
}

void add_link(Frame& frame, FrameLink::Kind kind) {
  const Vec<3> c = frame.bounds.center();
  frame.add<FrameLinks>().links.push_back({kind, c - Vec<3>(20, 0, 0), c + Vec<3>(20, 0, 0), 0});
}

const Vec<3> kHalfWay{22, 0, 0};  // a half of what is asked for

// What a mark means, and its sample: drawn by itself, or the smallest world that carries it.
struct MarkRow {
  MarkKind kind;
  std::string_view words;
  void (*draw)(const Sample&) = nullptr;
  void (*make)(Frame& world, const Vec<3>& middle) = nullptr;
};

// By MarkKind.
constexpr MarkRow kRows[] = {
    {.kind = MarkKind::lit,
     .words = "in question",
     .make = [](Frame& f, const Vec<3>&) { add_marked(f, Mark::lit); }},
    {.kind = MarkKind::passed,
     .words = "passed",
     .make = [](Frame& f, const Vec<3>&) { add_marked(f, Mark::passed); }},
    {.kind = MarkKind::not_made,
     .words = "not made",
     .make =
         [](Frame& f, const Vec<3>&) {
           f.structure = StructureKind::quadtree;
           // its lower right quarter fills the picture, and is not made
           FrameNode& node = add_cell(f, kNone);
           node.leaf = false;
           node.box.lo.x -= f.bounds.size().x;
           node.box.hi.y += f.bounds.size().y;
         }},
    {.kind = MarkKind::sleeping_cell,
     .words = "asleep: not searched",
     .make =
         [](Frame& f, const Vec<3>&) {
           FrameNode& node = add_cell(f, kNone);
           node.awake = false;
           node.bodies = {0};
         }},
    {.kind = MarkKind::static_body,
     .words = "never moves",
     .make =
         [](Frame& f, const Vec<3>&) {
           FrameBody& body = add_ball(f, 12);
           body.look = Look::box;
           body.shape = AxisBox<3>{{12, 12, 0}};
           body.is_static = true;
         }},
    {.kind = MarkKind::sleeping_body,
     .words = "asleep",
     .make = [](Frame& f, const Vec<3>&) { add_ball(f, 13).asleep = true; }},
    {.kind = MarkKind::ruled_out,
     .words = "not found",
     .make = [](Frame& f, const Vec<3>&) { add_ball(f, 13).dimmed = true; }},
    {.kind = MarkKind::candidate, .words = "to test", .draw = draw_linked<PairState::candidate>},
    {.kind = MarkKind::faint_pair,
     .words = "to test, among many",
     .draw = draw_linked<PairState::candidate, false>},
    {.kind = MarkKind::boxes_apart,
     .words = "apart by box",
     .draw = draw_linked<PairState::boxes_apart>},
    {.kind = MarkKind::shapes_apart,
     .words = "apart by shape",
     .draw = draw_linked<PairState::shapes_apart>},
    {.kind = MarkKind::box_overlap,
     .words = "box overlap",
     .draw =
         [](const Sample& s) {
           draw_overlap(Box<2>::around(s.c, {14, 9}), s.list);
         }},
    {.kind = MarkKind::contact,
     .words = "contact",
     .draw =
         [](const Sample& s) {
           draw_contact(s.c, {0, -1}, 1, s.pen);
         }},
    {.kind = MarkKind::contact_begins,
     .words = "contact begins",
     .draw =
         [](const Sample& s) {
           draw_contact(s.c, {0, -1}, 1, s.pen);
           draw_beginning(s.c, 1, s.pen);
         }},
    {.kind = MarkKind::impulse,
     .words = "impulse",
     .draw =
         [](const Sample& s) {
           draw_impulse(s.left + Vec<2>(8, 0), s.right - Vec<2>(8, 0), 1, s.pen);
         }},
    {.kind = MarkKind::velocity,
     .words = "velocity",
     .draw =
         [](const Sample& s) {
           s.pen.arrow(s.left, s.right, kVelocityStroke, kVelocityHead, 1.2);
         }},
    {.kind = MarkKind::force,
     .words = "force",
     .draw = [](const Sample& s) { s.pen.arrow(s.left, s.right, kForceStroke, kForceHead, 1.6); }},
    {.kind = MarkKind::ruler,
     .words = "length",
     .draw =
         [](const Sample& s) {
           draw_ruler(s.left, s.right, {Role::ink, 2.2}, s.pen);
         }},
    {.kind = MarkKind::box,
     .words = "box",
     .make =
         [](Frame& f, const Vec<3>&) {
           add_ball(f, 11);
           f.display.boxes = true;
         }},
    {.kind = MarkKind::ray,
     .words = "ray",
     .make =
         [](Frame& f, const Vec<3>& c) {
           f.add<FrameFinding>().rays.push_back({c - kHalfWay, c + kHalfWay, {}});
         }},
    {.kind = MarkKind::ray_hit,
     .words = "hit",
     .draw =
         [](const Sample& s) {
           s.pen.line(s.left, s.right, {Role::ray, 3.6});
           s.pen.dot(s.c, 7, Role::panel, {Role::ray, 2.8});
         }},
    {.kind = MarkKind::met,
     .words = "order of cells",
     .draw =
         [](const Sample& s) {
           s.list.rect(Box<2>::around(s.c, {11, 11}), Role::panel, {Role::ray, 2}, 3);
           s.pen.line(s.c + Vec<2>(0, -5), s.c + Vec<2>(0, 5), {Role::ray, 2});
         }},
    {.kind = MarkKind::view,
     .words = "view",
     .make =
         [](Frame& f, const Vec<3>& c) {
           f.add<FrameFinding>().views.push_back(
               {c - kHalfWay, {c - kHalfWay, c + Vec<3>(22, -12, 0), c + Vec<3>(22, 12, 0)}});
         }},
    {.kind = MarkKind::region,
     .words = "region",
     .make =
         [](Frame& f, const Vec<3>& c) {
           f.add<FrameFinding>().queries.push_back(
               {{c - Vec<3>(20, 10, 0), c + Vec<3>(20, 10, 0)}, 0});
         }},
    {.kind = MarkKind::found,
     .words = "found",
     .draw = [](const Sample& s) { draw_tick(s.c, s.list); }},
    {.kind = MarkKind::skipped,
     .words = "skipped, with all below",
     .draw = [](const Sample& s) { draw_skipped(s.c, s.list); }},
    {.kind = MarkKind::centre,
     .words = "centre",
     .draw = [](const Sample& s) { draw_centre(s.c, s.pen); }},
    {.kind = MarkKind::spring,
     .words = "spring",
     .make = [](Frame& f, const Vec<3>&) { add_link(f, FrameLink::Kind::spring); }},
    {.kind = MarkKind::rod,
     .words = "rod",
     .make = [](Frame& f, const Vec<3>&) { add_link(f, FrameLink::Kind::distance); }},
    {.kind = MarkKind::pin, .words = "pin", .draw = [](const Sample& s) { draw_pin(s.c, s.pen); }},
    {.kind = MarkKind::shadow,
     .words = "reach along the axis",
     .draw = [](const Sample& s) { draw_shadow(s.left, s.right, body_role(4), s.pen); }},
    {.kind = MarkKind::shadow_gap,
     .words = "gap",
     .draw = [](const Sample& s) { draw_gap(s.a, s.b, s.pen); }},
    {.kind = MarkKind::shadow_overlap,
     .words = "way out along the axis",
     .draw = [](const Sample& s) { draw_shared_shadow(s.a, s.b, s.pen); }},
    {.kind = MarkKind::support,
     .words = "farthest point",
     .draw = [](const Sample& s) { draw_support(s.c, s.pen); }},
    {.kind = MarkKind::simplex,
     .words = "points kept",
     .draw =
         [](const Sample& s) {
           draw_simplex({s.a, s.b}, s.pen);
         }},
    {.kind = MarkKind::origin,
     .words = "origin",
     .draw = [](const Sample& s) { draw_origin(s.c, s.pen); }},
    {.kind = MarkKind::portal,
     .words = "portal",
     .draw = [](const Sample& s) { draw_portal(s.left, s.right, s.pen); }},
    {.kind = MarkKind::sight,
     .words = "line of sight",
     .draw = [](const Sample& s) { draw_sight(s.left, s.right, s.pen); }},
    {.kind = MarkKind::trail,
     .words = "step before step",
     .draw =
         [](const Sample& s) {
           draw_way({s.left + Vec<2>(6, 0), s.right}, s.pen);
           s.pen.dot(s.left + Vec<2>(6, 0), 9, Role::none, kTrailStroke);
         }},
    {.kind = MarkKind::ahead,
     .words = "next, if it meets nothing",
     .draw = [](const Sample& s) { s.pen.path(ring_of(s.c, 10, 24), true, kAheadStroke); }},
    {.kind = MarkKind::look,
     .words = "a look within the step",
     .draw = [](const Sample& s) { s.pen.dot(s.c, 10, Role::none, kLookStroke); }},
};
static_assert(std::size(kRows) == kMarkKinds);

const MarkRow& row_of(MarkKind kind) { return kRows[static_cast<std::size_t>(kind)]; }

// A world of the sample's proportions: what it holds is seen as it is, a unit a page unit.
Frame sample_of(const MarkRow& row) {
  Frame frame;
  frame.bounds = {{0, 0, 0}, {kSampleWide + 2 * kCutRim - 6, kSampleHigh + 2 * kCutRim - 6, 0}};
  frame.display.names = ShownNames::none;
  frame.display.boxes = false;
  row.make(frame, frame.bounds.center());
  return frame;
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
    const double needed = kSampleWide + kBeforeWords + text_width(words_of(kind), kQuiet);
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

std::string_view words_of(MarkKind kind) { return row_of(kind).words; }

MarkSet draw_sample(MarkKind kind, const Box<2>& box, DrawList& list) {
  const MarkRow& row = row_of(kind);
  if (row.draw) {
    Pen pen(list, box);
    const Vec<2> c = box.center();
    row.draw({pen, list, c, {box.lo.x + 4, c.y}, {box.hi.x - 4, c.y}});
    MarkSet told;
    told.add(kind);
    return told;
  }
  DrawList own;
  Labels labels(own);
  const Frame world = sample_of(row);
  draw_world(world, Staging(world), shrunk(box, -kCutRim), own, labels);
  keep_within(own, 0, box);  // without the world's border
  for (DrawShape& shape : own.shapes)
    if (!std::holds_alternative<TextShape>(shape)) list.shapes.push_back(std::move(shape));
  return own.marks;
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
               centred({sample.hi.x + kBeforeWords, sample.center().y}, kQuiet, 0), kQuiet, strip);
  }
}

}  // namespace lantern::draw
