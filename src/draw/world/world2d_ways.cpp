// Where bodies come from and go to: trails, and the looks for the moment of an impact.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/number_text.hpp"
#include "draw/world/world2d_parts.hpp"
#include "frame/parts/motion.hpp"

namespace lantern::draw {
namespace {

using frame::FrameLook;
using frame::FramePlace;

// The body's outline where it stands then.
Polygon outline_at(const FrameBody& body, const FramePlace& place, const View2D& map) {
  constexpr int kRound = 40;
  const Vec<2> middle = map.to_page(place.position);
  if (const auto* ball = std::get_if<Sphere>(&body.shape))
    return ring_of(middle, ball->radius * map.scale(), kRound);
  const Box<2> box = Box<2>::around(middle, flat(body.box.size()) * (map.scale() / 2));
  FrameBody there;
  there.shape = body.shape;
  there.box = body.box;
  there.angle = place.angle;
  const Polygon turned = turned_outline(there, box);
  return turned.empty() ? polygon_of(box) : turned;
}

// A step that is about to be taken shows where it would end.
bool looks_ahead(const Frame& frame) {
  using enum frame::StepPhase;
  return frame.phase == broad || frame.phase == boxes || frame.phase == narrow;
}

void draw_trail(const FrameBody& body, const View2D& map, Pen& pen) {
  std::vector<Vec<2>> way;
  for (const frame::FrameStop& stop : body.trail) way.push_back(map.to_page(stop.position));
  way.push_back(map.to_page(body.position));
  draw_way(way, pen);
  for (const frame::FrameStop& stop : body.trail)
    pen.polygon(outline_at(body, stop, map), Role::none,
                stop.impact ? Stroke{Role::contact, kTrailStroke.width} : kTrailStroke);
}

// The gap that a look found, from surface to surface.
void draw_gap(const World2D& w, const FrameLook& look, Pen& pen) {
  constexpr double kLeast = 30;  // page units: a shorter one has no room for its number
  const Vec<2> a = w.map.to_page(look.on_a), b = w.map.to_page(look.on_b);
  if (!(look.gap > 0)) return;
  pen.line(a, b, {Role::lit, 3.4}, 1.6);
  for (const Vec<2>& end : {a, b}) pen.dot(end, 4.5, Role::lit, {Role::panel, 1.4});
  if (glm::distance(a, b) < kLeast) return;
  const TextStyle style{kLeastLabel, Weight::semibold, Role::lit_ink, Role::panel};
  const Vec<2> middle = (a + b) / 2.0;
  w.labels.try_add(say("gap {:.2g}", look.gap),
                   {{{middle.x, middle.y - 10}, 0.5},
                    {{middle.x, middle.y + 28}, 0.5},
                    {{middle.x + 14, middle.y + 8}, 0}},
                   style, w.map.panel());
}

constexpr double kFromEdge = 22;  // of a cell, to a mark in its corner

// Places for a mark in a cell: its corners, the upper right one first, then its middle.
std::vector<Vec<2>> places_in(const Box<2>& cell) {
  const Box<2> corners = shrunk(cell, kFromEdge);
  if (corners.lo.x >= corners.hi.x || corners.lo.y >= corners.hi.y) return {cell.center()};
  return {{corners.hi.x, corners.lo.y},
          corners.hi,
          {corners.lo.x, corners.hi.y},
          corners.lo,
          cell.center()};
}

// Draws at the first place that is free of bodies and of labels.
bool at_free_place(const Box<2>& cell, double radius, const std::vector<Box<2>>& bodies,
                   const Box<2>& room, Labels& labels, const auto& draw) {
  for (const Vec<2>& at : places_in(cell)) {
    const Box<2> box = Box<2>::around(at, Vec<2>(radius));
    if (touches(bodies, box) || !labels.is_free(box, room) || !draw(at)) continue;
    labels.block(box);
    return true;
  }
  return false;
}

}  // namespace

void draw_way(const std::vector<Vec<2>>& points, Pen& pen) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    pen.line(points[i], points[i + 1], {Role::quiet_ink, 1.8});
}

void draw_trails(const World2D& w) {
  Pen pen(w.list, mark_limit(w.map));
  for (const FrameBody& body : w.frame.bodies) {
    if (body.trail.empty() && !(body.ahead && looks_ahead(w.frame))) continue;
    const DrawList::Scope scope(w.list, body_key("world/trail", body));
    if (!body.trail.empty()) {
      draw_trail(body, w.map, pen);
      w.list.marks.add(MarkKind::trail);
    }
    if (!body.ahead || !looks_ahead(w.frame)) continue;
    pen.line(w.map.to_page(body.position), w.map.to_page(body.ahead->position),
             {Role::quiet_ink, 1.8, kAheadStroke.dash});
    pen.path(outline_at(body, *body.ahead, w.map), true, kAheadStroke);
    w.list.marks.add(MarkKind::ahead);
  }
}

void draw_looks(const World2D& w) {
  if (w.frame.get<FrameLooks>().looks.empty()) return;
  const DrawList::Scope scope(w.list, "world/looks");
  Pen pen(w.list, mark_limit(w.map));
  const BodiesById bodies = by_id(w.frame.bodies);
  const FrameLook& last = w.frame.get<FrameLooks>().looks.back();
  for (const FrameLook& look : w.frame.get<FrameLooks>().looks) {
    const bool now = &look == &last;
    for (const auto& [id, place] :
         {std::pair(look.pair.a, look.a), std::pair(look.pair.b, look.b)}) {
      const auto body = bodies.find(id);
      if (body == bodies.end() || body->second->is_static) continue;
      const Polygon outline = outline_at(*body->second, place, w.map);
      const Role meets = look.meets ? Role::contact : Role::lit;
      pen.path(outline, true, now ? Stroke{meets, 3.6} : kLookStroke);
      const TextStyle style{kLeastLabel, Weight::semibold, now ? Role::lit_ink : Role::ray,
                            Role::panel};
      const Box<2> box = box_of(outline);
      const Vec<2> c = box.center();
      w.labels.try_add(fmt::format("{:.2f}", look.time),
                       {{{c.x, box.hi.y + 24}, 0.5},
                        {{c.x, box.lo.y - 8}, 0.5},
                        {{box.hi.x + 8, c.y + 8}, 0},
                        {{box.lo.x - 8, c.y + 8}, 1}},
                       style, w.map.panel());
    }
  }
  draw_gap(w, last, pen);
  w.list.marks.add(MarkKind::look);
  for (const char* name : {"impact_looks", "time_of_impact"}) w.list.referents.emplace(name);
}

// What a ray, view or region left out of a 2D world and in which order a ray meets its cells, and
// the coordinates of the way down.

void mark_walk(const World2D& w) {
  constexpr std::size_t kMostMarks = 80;
  const Box<2> room = shrunk(w.map.picture(), 3);
  std::size_t drawn = 0;
  bool all = true;
  for (const FrameNode& node : w.frame.nodes) {
    const bool skipped = is_topmost_skipped(node, w.frame);
    if (!skipped && node.met == kNone) continue;
    if (++drawn > kMostMarks) return;
    const Box<2> cell = w.map.to_page(node.box);
    if (skipped)
      all &= at_free_place(cell, kSkipRadius + 1, w.covered, room, w.labels, [&](const Vec<2>& at) {
        draw_skipped(at, w.list);
        return true;
      });
    else
      at_free_place(cell, 1, w.covered, room, w.labels, [&](const Vec<2>& at) {
        return draw_met(node.met, at, room, w.list, w.labels);
      });
  }
  if (drawn > 0 && all) w.list.referents.emplace("nodes_skipped");
}

void draw_coordinates(const World2D& w) {
  if (!w.frame.display.coordinates) return;
  const TextStyle style{std::max(kLabel, 22.0), Weight::semibold, Role::lit_ink, Role::panel};
  const Box<2>& picture = w.map.picture();
  constexpr double kTick = 12;
  std::set<double> done[2];
  for (const bool root : {true, false})
    for (const FrameNode& node : w.frame.nodes) {
      if ((node.depth == 0) != root || (!root && node.mark == Mark::quiet)) continue;
      for (int axis = 0; axis < 2; ++axis)
        for (const double at : {node.box.lo[axis], node.box.hi[axis]}) {
          if (!done[axis].insert(at).second) continue;
          const Vec<2> p = w.map.in_reach(w.map.to_page(axis == 0 ? Vec<2>(at, 0) : Vec<2>(0, at)));
          const std::string text = short_number(at);
          if (axis == 0) {
            const double y = picture.hi.y, align = p.x < picture.lo.x + 8   ? 0
                                                   : p.x > picture.hi.x - 8 ? 1
                                                                            : 0.5;
            w.list.line({p.x, y - kTick}, {p.x, y}, {Role::lit, 3.4});
            const double inwards = align == 0 ? 8 : align == 1 ? -8 : 0;
            w.labels.try_add(text, {{{p.x + inwards, y - kTick - 5}, align}}, style, picture);
          } else {
            const double x = picture.lo.x;
            const double below = p.y < picture.lo.y + 8   ? style.size
                                 : p.y > picture.hi.y - 8 ? -2 * style.size
                                                          : 0.36 * style.size;
            w.list.line({x, p.y}, {x + kTick, p.y}, {Role::lit, 3.4});
            w.labels.try_add(text, {{{x + kTick + 5, p.y + below}, 0}}, style, picture);
          }
        }
    }
}

}  // namespace lantern::draw
