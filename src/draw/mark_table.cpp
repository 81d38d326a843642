// The marks that mean one thing each, drawn here and nowhere else, and their samples for a legend.
#include <cmath>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/marks.hpp"
#include "draw/world/narrow_marks.hpp"

namespace lantern::draw {
namespace {

constexpr double kCasing = 2;  // of the panel's tone, on both sides of a link

// What a question has found, and where things are held.
bool draw_finding(MarkKind kind, const Vec<2>& c, const Vec<2>& left, const Vec<2>& right, Pen& pen,
                  DrawList& list) {
  switch (kind) {
    case MarkKind::ray_hit:
      pen.line(left, right, {Role::ray, 3.6});
      pen.dot(c, 7, Role::panel, {Role::ray, 2.8});
      return true;
    case MarkKind::found:
      draw_tick(c, list);
      return true;
    case MarkKind::skipped:
      draw_skipped(c, list);
      return true;
    case MarkKind::met:
      list.rect(Box<2>::around(c, {11, 11}), Role::panel, {Role::ray, 2}, 3);
      pen.line(c + Vec<2>(0, -5), c + Vec<2>(0, 5), {Role::ray, 2});
      return true;
    case MarkKind::portal:
      draw_portal(left, right, pen);
      return true;
    case MarkKind::sight:
      draw_sight(left, right, pen);
      return true;
    case MarkKind::pin:
      pen.dot(c, 7.5, Role::panel, {Role::ink, 2.6});
      pen.dot(c, 2, Role::ink);
      return true;
    case MarkKind::trail:
      draw_way({left + Vec<2>(6, 0), right}, pen);
      pen.dot(left + Vec<2>(6, 0), 9, Role::none, kTrailStroke);
      return true;
    case MarkKind::ahead:
      pen.path(ring_of(c, 10, 24), true, kAheadStroke);
      return true;
    case MarkKind::look:
      pen.dot(c, 10, Role::none, kLookStroke);
      return true;
    case MarkKind::centre:
      for (const Vec<2>& arm : {Vec<2>(6, 0), Vec<2>(0, 6)})
        pen.line(c - arm, c + arm, {Role::frustum, 2.2});
      return true;
    default:
      return draw_narrow_sample(kind, left, right, pen);
  }
}

}  // namespace

bool draw_mark(MarkKind kind, const Box<2>& place, DrawList& list) {
  using State = frame::PairState;
  const Vec<2> c = place.center();
  const Vec<2> left{place.lo.x + 4, c.y}, right{place.hi.x - 4, c.y};
  Pen pen(list, place);
  switch (kind) {
    case MarkKind::candidate:
      draw_link(left, right, {}, pen);
      return true;
    case MarkKind::faint_pair:
      draw_link(left, right, {State::candidate, false, false}, pen);
      return true;
    case MarkKind::boxes_apart:
      draw_link(left, right, {State::boxes_apart, true, false}, pen);
      return true;
    case MarkKind::shapes_apart:
      draw_link(left, right, {State::shapes_apart, true, false}, pen);
      return true;
    case MarkKind::box_overlap:
      draw_overlap(Box<2>::around(c, {14, 9}), list);
      return true;
    case MarkKind::contact:
    case MarkKind::contact_begins:
      draw_contact(c, {0, -1}, 1, pen);
      if (kind == MarkKind::contact_begins) draw_beginning(c, 1, pen);
      return true;
    case MarkKind::impulse:
      draw_impulse(left + Vec<2>(8, 0), right - Vec<2>(8, 0), 1, pen);
      return true;
    case MarkKind::velocity:
      pen.arrow(left, right, kVelocityStroke, kVelocityHead, 1.2);
      return true;
    case MarkKind::force:
      pen.arrow(left, right, kForceStroke, kForceHead, 1.6);
      return true;
    case MarkKind::ruler:
      draw_ruler(left, right, {Role::ink, 2.2}, pen);
      return true;
    default:
      return draw_finding(kind, c, left, right, pen, list);
  }
}

MarkKind kind_of(const LinkLook& look) {
  using State = frame::PairState;
  if (!look.full) return MarkKind::faint_pair;
  if (look.state == State::boxes_apart) return MarkKind::boxes_apart;
  return look.state == State::shapes_apart ? MarkKind::shapes_apart : MarkKind::candidate;
}

Stroke stroke_of(const LinkLook& look) {
  if (!look.full) return {Role::faint_pair, 1.8};
  if (look.state != frame::PairState::candidate) return {Role::rejected_pair, 2.6, 5};
  return {Role::pair, look.lit ? 4.4 : 3.0};
}

void draw_cross(const Vec<2>& at, Role role, Pen& pen) {
  constexpr double kArm = 7.5;
  for (const double casing : {kCasing, 0.0})
    for (const Vec<2>& arm : {Vec<2>(kArm, kArm), Vec<2>(kArm, -kArm)})
      pen.line(at - arm, at + arm,
               {casing > 0 ? Role::panel : role, casing > 0 ? 3 + 2 * casing : 3.0});
}

void draw_link(const Vec<2>& from, const Vec<2>& to, const LinkLook& look, Pen& pen) {
  if (look.state == frame::PairState::contact) return;
  pen.line(from, to, stroke_of(look), look.full ? kCasing : 0);
  if (look.full && look.state == frame::PairState::shapes_apart)
    draw_cross((from + to) / 2.0, Role::rejected_pair, pen);
}

void draw_portal(const Vec<2>& from, const Vec<2>& to, Pen& pen) {
  pen.line(from, to, {Role::panel, 7});
  pen.line(from, to, {Role::frustum, 4.4, 9});
}

void draw_sight(const Vec<2>& from, const Vec<2>& to, Pen& pen) {
  pen.line(from, to, {Role::ray, 2.4}, 1.2);
  for (const Vec<2>& end : {from, to}) pen.dot(end, 5, Role::ray, {Role::panel, 1.6});
}

void draw_overlap(const Box<2>& common, DrawList& list) {
  constexpr double kLeast = 7;  // half its side
  const Box<2> box = Box<2>::around(common.center(), glm::max(common.size() / 2.0, Vec<2>(kLeast)));
  list.rect(box, Role::none, {Role::panel, 5});
  list.rect(box, Role::none, {Role::pair, 2.4});
  list.marks.add(MarkKind::box_overlap);
}

void draw_skipped(const Vec<2>& at, DrawList& list) {
  constexpr double kArm = 4.2;
  list.disc(at, kSkipRadius, Role::panel, {Role::quiet_ink, 2});
  for (const Vec<2>& arm : {Vec<2>(kArm, kArm), Vec<2>(kArm, -kArm)})
    list.line(at - arm, at + arm, {Role::quiet_ink, 2.2});
  list.marks.add(MarkKind::skipped);
}

bool draw_met(std::uint32_t place, const Vec<2>& at, const Box<2>& room, DrawList& list,
              Labels& labels) {
  const TextStyle style{kLabel, Weight::semibold, Role::ray};
  const std::string number = fmt::format("{}", place + 1);
  const Box<2> plate = plate_of(number, at, style, {6, 5});
  if (!labels.is_free(plate, room)) return false;
  list.rect(plate, Role::panel, {Role::ray, 2}, 3);
  labels.add(number, centred(at, style), style, room);
  labels.block(plate);
  list.marks.add(MarkKind::met);
  return true;
}

void draw_tick(const Vec<2>& at, DrawList& list) {
  list.disc(at, 9.5, Role::panel, {Role::frustum, 2});
  const Vec<2> foot = at + Vec<2>(-1.2, 4);
  list.line(at + Vec<2>(-4.6, 0.4), foot, {Role::frustum, 2.6});
  list.line(foot, at + Vec<2>(5, -3.8), {Role::frustum, 2.6});
  list.marks.add(MarkKind::found);
}

std::vector<bool> full_links(const Frame& frame) {
  const std::size_t n = frame.pairs.size();
  if (n <= kMostFullLinks) return std::vector<bool>(n, true);
  std::vector<bool> full(n);
  const BodiesById bodies = by_id(frame.bodies);
  const auto is_lit = [&](BodyId id) {
    const auto found = bodies.find(id);
    return found != bodies.end() && found->second->lit;
  };
  std::size_t left = kMostFullLinks;
  for (const bool about : {true, false})
    for (std::size_t i = 0; i < n && left > 0; ++i) {
      const FramePair& p = frame.pairs[i];
      const bool wanted = about ? is_lit(p.pair.a) || is_lit(p.pair.b) : p.lit;
      if (full[i] || !wanted) continue;
      full[i] = true;
      --left;
    }
  return full;
}

}  // namespace lantern::draw
