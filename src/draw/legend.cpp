#include <utility>
#include <vector>

#include "base/words.hpp"
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
  using Draw = void(const Sample&);
  using Make = void(Frame& world, const Vec<3>& middle);
  constexpr MarkRow(MarkKind k, std::string_view w, Draw* d) : kind(k), words(w), draw(d) {}
  constexpr MarkRow(MarkKind k, std::string_view w, Make* m) : kind(k), words(w), make(m) {}

  MarkKind kind;
  std::string_view words;
  Draw* draw = nullptr;
  Make* make = nullptr;
};

// By MarkKind.
constexpr MarkRow kRows[] = {
    {MarkKind::lit, "in question", [](Frame& f, const Vec<3>&) { add_marked(f, Mark::lit); }},
    {MarkKind::passed, "passed", [](Frame& f, const Vec<3>&) { add_marked(f, Mark::passed); }},
    {MarkKind::not_made, "not made",
     [](Frame& f, const Vec<3>&) {
       f.structure = StructureKind::quadtree;
       // its lower right quarter fills the picture, and is not made
       FrameNode& node = add_cell(f, kNone);
       node.leaf = false;
       node.box.lo.x -= f.bounds.size().x;
       node.box.hi.y += f.bounds.size().y;
     }},
    {MarkKind::sleeping_cell, "asleep: not searched",
     [](Frame& f, const Vec<3>&) {
       FrameNode& node = add_cell(f, kNone);
       node.awake = false;
       node.bodies = {0};
     }},
    {MarkKind::static_body, "never moves",
     [](Frame& f, const Vec<3>&) {
       FrameBody& body = add_ball(f, 12);
       body.look = Look::box;
       body.shape = AxisBox<3>{{12, 12, 0}};
       body.is_static = true;
     }},
    {MarkKind::sleeping_body, "asleep",
     [](Frame& f, const Vec<3>&) { add_ball(f, 13).asleep = true; }},
    {MarkKind::ruled_out, "not found",
     [](Frame& f, const Vec<3>&) { add_ball(f, 13).dimmed = true; }},
    {MarkKind::refused, "tested: no hit",
     [](Frame& f, const Vec<3>&) { add_ball(f, 13).refused = true; }},
    {MarkKind::candidate, "a candidate pair", draw_linked<PairState::candidate>},
    {MarkKind::faint_pair, "one among many", draw_linked<PairState::candidate, false>},
    {MarkKind::boxes_apart, "apart by box", draw_linked<PairState::boxes_apart>},
    {MarkKind::shapes_apart, "apart by shape", draw_linked<PairState::shapes_apart>},
    {MarkKind::box_overlap, "box overlap",
     [](const Sample& s) {
       draw_overlap(Box<2>::around(s.c, {14, 9}), s.list);
     }},
    {MarkKind::missed, "missed",
     [](const Sample& s) {
       draw_missed(Box<2>::around(s.c, {14, 11}), s.pen);
     }},
    {MarkKind::contact, "contact",
     [](const Sample& s) {
       draw_contact(s.c, {0, -1}, 1, s.pen);
     }},
    {MarkKind::contact_begins, "contact begins",
     [](const Sample& s) {
       draw_contact(s.c, {0, -1}, 1, s.pen);
       draw_beginning(s.c, 1, s.pen);
     }},
    {MarkKind::impulse, "impulse",
     [](const Sample& s) {
       draw_impulse(s.left + Vec<2>(8, 0), s.right - Vec<2>(8, 0), 1, s.pen);
     }},
    {MarkKind::velocity, "velocity",
     [](const Sample& s) { s.pen.arrow(s.left, s.right, kVelocityStroke, kVelocityHead, 1.2); }},
    {MarkKind::spin, "spin",
     [](const Sample& s) {
       s.pen.line(s.left, s.right, kSpinStroke, 1.2);
       s.pen.arrow({s.b.x, s.b.y + 12}, {s.b.x, s.b.y - 12}, kSpinStroke, kSpinHead, 1.2);
     }},
    {MarkKind::longest_axis, "longest axis",
     [](const Sample& s) { s.pen.line(s.left, s.right, own_axis_stroke(0)); }},
    {MarkKind::middle_axis, "middle axis",
     [](const Sample& s) { s.pen.line(s.left, s.right, own_axis_stroke(1)); }},
    {MarkKind::shortest_axis, "shortest axis",
     [](const Sample& s) { s.pen.line(s.left, s.right, own_axis_stroke(2)); }},
    {MarkKind::force, "force",
     [](const Sample& s) { s.pen.arrow(s.left, s.right, kForceStroke, kForceHead, 1.6); }},
    {MarkKind::ruler, "length",
     [](const Sample& s) {
       draw_ruler(s.left, s.right, {Role::ink, 2.2}, s.pen);
     }},
    {MarkKind::box, "box",
     [](Frame& f, const Vec<3>&) {
       add_ball(f, 11);
       f.display.boxes = true;
     }},
    {MarkKind::ray, "ray",
     [](Frame& f, const Vec<3>& c) {
       f.add<FrameFinding>().rays.push_back({c - kHalfWay, c + kHalfWay, {}});
     }},
    {MarkKind::ray_hit, "hit",
     [](const Sample& s) {
       s.pen.line(s.left, s.right, {Role::ray, 3.6});
       s.pen.dot(s.c, 7, Role::panel, {Role::ray, 2.8});
     }},
    {MarkKind::met, "order of cells",
     [](const Sample& s) {
       s.list.rect(Box<2>::around(s.c, {11, 11}), Role::panel, {Role::ray, 2}, 3);
       s.pen.line(s.c + Vec<2>(0, -5), s.c + Vec<2>(0, 5), {Role::ray, 2});
     }},
    {MarkKind::view, "view",
     [](Frame& f, const Vec<3>& c) {
       f.add<FrameFinding>().views.push_back(
           {c - kHalfWay, {c - kHalfWay, c + Vec<3>(22, -12, 0), c + Vec<3>(22, 12, 0)}});
     }},
    {MarkKind::region, "region",
     [](Frame& f, const Vec<3>& c) {
       f.add<FrameFinding>().queries.push_back({{c - Vec<3>(20, 10, 0), c + Vec<3>(20, 10, 0)}, 0});
     }},
    {MarkKind::found, "found", [](const Sample& s) { draw_tick(s.c, s.list); }},
    {MarkKind::skipped, "skipped, with all below",
     [](const Sample& s) { draw_skipped(s.c, s.list); }},
    {MarkKind::centre, "centre", [](const Sample& s) { draw_centre(s.c, s.pen); }},
    {MarkKind::spring, "spring",
     [](Frame& f, const Vec<3>&) { add_link(f, FrameLink::Kind::spring); }},
    {MarkKind::rod, "rod", [](Frame& f, const Vec<3>&) { add_link(f, FrameLink::Kind::distance); }},
    {MarkKind::pin, "pin", [](const Sample& s) { draw_pin(s.c, s.pen); }},
    {MarkKind::shadow, "reach along the axis",
     [](const Sample& s) { draw_shadow(s.left, s.right, body_role(4), s.pen); }},
    {MarkKind::shadow_gap, "gap", [](const Sample& s) { draw_gap(s.a, s.b, s.pen); }},
    {MarkKind::shadow_overlap, "overlap along the axis",
     [](const Sample& s) { draw_shared_shadow(s.a, s.b, s.pen); }},
    {MarkKind::support, "farthest point", [](const Sample& s) { draw_support(s.c, s.pen); }},
    {MarkKind::simplex, "points kept",
     [](const Sample& s) {
       draw_simplex({s.a, s.b}, s.pen);
     }},
    {MarkKind::origin, "origin", [](const Sample& s) { draw_origin(s.c, s.pen); }},
    {MarkKind::portal, "portal", [](const Sample& s) { draw_portal(s.left, s.right, s.pen); }},
    {MarkKind::sight, "line of sight", [](const Sample& s) { draw_sight(s.left, s.right, s.pen); }},
    {MarkKind::trail, "step before step",
     [](const Sample& s) {
       draw_way({s.left + Vec<2>(6, 0), s.right}, s.pen);
       s.pen.dot(s.left + Vec<2>(6, 0), 9, Role::none, kTrailStroke);
     }},
    {MarkKind::ahead, "next, if it meets nothing",
     [](const Sample& s) { s.pen.path(ring_of(s.c, 10, 24), true, kAheadStroke); }},
    {MarkKind::look, "a look within the step",
     [](const Sample& s) { s.pen.dot(s.c, 10, Role::none, kLookStroke); }},
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
    const double needed = kSampleWide + kBeforeWords + text_width(noun(words_of(kind), 1), kQuiet);
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
    labels.add(noun(words_of(entry.kind), 1),
               centred({sample.hi.x + kBeforeWords, sample.center().y}, kQuiet, 0), kQuiet, strip);
  }
}

}  // namespace lantern::draw
