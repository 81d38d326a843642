#include "draw/marks.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/keys.hpp"
#include "draw/world/world3d_parts.hpp"
#include "geometry/plane.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostPairs = 900;
constexpr double kCasing = 2;  // of the panel's tone, on both sides of a link

// Those that are drawn; half-spaces, which are ground, always are.
BodiesById drawn_of(const Frame& frame, const std::vector<Body3D>& bodies) {
  BodiesById found;
  for (const Body3D& b : bodies) found.emplace(b.body->id, b.body);
  for (const FrameBody& body : frame.bodies)
    if (is_half_space(body) && !bodies.empty()) found.emplace(body.id, &body);
  return found;
}

}  // namespace

void tell_marks(const FrameBody& body, DrawList& list) {
  if (body.asleep) list.marks.add(MarkKind::sleeping_body);
  if (body.dimmed) list.marks.add(MarkKind::ruled_out);
  if (body.refused) list.marks.add(MarkKind::refused);
  if (body.is_static && !is_character(body)) list.marks.add(MarkKind::static_body);
}

void Marks::dot(const Vec<3>& at, double radius, Role fill, const Stroke& stroke) const {
  if (const auto page = projection_.seen(at)) over().dot(*page, radius, fill, stroke);
}

void Marks::overlap_mark(const Vec<3>& at) const {
  constexpr double kHalf = 6;
  const auto page = projection_.seen(at);
  const Box<2> box = page ? Box<2>::around(*page, Vec<2>(kHalf)) : Box<2>();
  if (page && holds(shrunk(place_, 3), box)) draw_overlap(box, list_);
}

void Marks::line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double casing) {
  over().line(to_page(from), to_page(to), stroke, casing);
}

void Marks::arrow(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double head,
                  double casing) {
  over().arrow(to_page(from), to_page(to), stroke, head, casing);
}

void Marks::spring(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke) {
  over().path(spring_bends(to_page(from), to_page(to)), false, stroke);
}

void Marks::box(const Box<3>& box, const Stroke& stroke) {
  const Box<2> page{View2D::in_reach(to_page({box.lo.x, box.hi.y, 0})),
                    View2D::in_reach(to_page({box.hi.x, box.lo.y, 0}))};
  if (holds(place_, page))
    list_.rect(page, Role::none, stroke);
  else
    over().path(polygon_of(page), true, stroke);
}

// With a cross at its centre.
void Marks::ball(const Vec<3>& center, double radius, const Stroke& stroke) {
  const Vec<2> page = to_page(center);
  const double reach = radius * projection_.scale_at(center);
  Pen pen = over();
  if (holds(place_, Box<2>::around(page, Vec<2>(reach))))
    list_.disc(page, reach, Role::none, stroke);
  else if (std::isfinite(reach))
    pen.path(ring_of(page, reach, 60), true, {stroke.role, stroke.width});
  draw_centre(page, pen);
  tell(MarkKind::centre);
}

void Marks3D::add(const Convex& space, Outline outline, std::vector<DrawShape> shapes) {
  pieces.push_back({space, std::move(outline), true, false, std::move(shapes)});
  KeyedRun shown = list_.shown();
  pieces.back().key = std::move(shown.key);
  pieces.back().from = std::move(shown.from);
}

void Marks3D::paint() {
  draw::paint(std::move(pieces), view, list_);
  for (KeyedRun& run : above_.runs) {
    run.first += list_.shapes.size();
    list_.begin_run(std::move(run));
  }
  std::ranges::move(above_.shapes, std::back_inserter(list_.shapes));
  over_ = &list_;
}

void Marks3D::add_part(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double casing) {
  const auto seen = view.in_sight(from, to);
  const auto page = view.segment(from, to);
  if (!seen || !page) return;
  std::vector<DrawShape> shapes;
  if (casing > 0)
    shapes.emplace_back(
        LineShape{page->first, page->second, {Role::panel, stroke.width + 2 * casing}});
  shapes.emplace_back(LineShape{page->first, page->second, stroke});
  add(Convex::line(seen->first, seen->second), {page->first, page->second}, std::move(shapes));
}

// In several pieces, between the bodies that it passes through: what lies inside of them cannot be
// seen.
void Marks3D::line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double casing) {
  if (view.lost(from) || view.lost(to)) return;
  const Box<3> reach{glm::min(from, to), glm::max(from, to)};
  std::vector<std::pair<double, double>> hidden;
  for (const Body3D& b : bodies) {
    if (!overlap(b.body->box, reach)) continue;
    if (const auto part = inside_of(b.space, from, to)) hidden.push_back(*part);
  }
  std::ranges::sort(hidden);
  double start = 0;
  const auto add_until = [&](double end) {
    if (end - start > 1e-6)
      add_part(from + (to - from) * start, from + (to - from) * end, stroke, casing);
  };
  for (const auto& [first, last] : hidden) {
    add_until(first);
    start = std::max(start, last);
  }
  add_until(1);
}

void Marks3D::arrow(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double head,
                    double casing) {
  const auto tail = view.seen(from), tip = view.seen(to);
  const double length = tail && tip ? glm::distance(*tail, *tip) : 0;
  const bool has_head = length > 1e-6;
  head = std::min(head, 0.8 * length);
  line(from, has_head ? to - (to - from) * (0.7 * head / length) : to, stroke, casing);
  if (!has_head) return;
  Outline outline = arrow_head(*tail, *tip, head);
  if (!holds(view.panel(), box_of(outline))) return;
  const Outline hull = hull_of(outline);
  add(Convex::line(to, to), hull,
      {PolygonShape{std::move(outline), stroke.role,
                    casing > 0 ? Stroke{Role::panel, 1.2} : Stroke{}}});
}

// Its turns stand across its line on the page.
void Marks3D::spring(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke) {
  if (view.lost(from) || view.lost(to)) return;
  const auto page = view.segment(from, to);
  const auto seen = view.in_sight(from, to);
  if (!page || !seen) return;
  const Outline bends = spring_bends(page->first, page->second);
  if (bends.empty() || !holds(view.panel(), box_of(bends))) return add_part(from, to, stroke, 0);
  std::vector<DrawShape> shapes;
  for (std::size_t i = 0; i + 1 < bends.size(); ++i)
    shapes.emplace_back(LineShape{bends[i], bends[i + 1], stroke});
  add(Convex::line(seen->first, seen->second), hull_of(bends), std::move(shapes));
}

// Its twelve edges.
void Marks3D::box(const Box<3>& box, const Stroke& stroke) {
  const std::vector<Vec<3>> c = corners_of(box);
  for (unsigned i = 0; i < 8; ++i)
    for (const unsigned bit : {1u, 2u, 4u})
      if ((i & bit) == 0) line(c[i], c[i + bit], stroke);
}

// As the eye sees it, over the edges of the box around it.
void Marks3D::ball(const Vec<3>& center, double radius, const Stroke& stroke) {
  box(Box<3>::around(center, Vec<3>(radius)), {stroke.role, 1.4, stroke.dash});
  if (view.lost(center)) return;
  Outline rim = cut_to(view.ball_cap(center, radius, view.light(), -1), view.panel());
  if (rim.size() < 3) return;
  const Outline hull = rim;
  add(Convex::line(center, center), hull,
      {PolygonShape{std::move(rim), Role::none, {stroke.role, stroke.width}}});
}

bool add_pairs(const Frame& frame, Marks3D& marks) {
  const BodiesById bodies = drawn_of(frame, marks.bodies);
  const std::vector<bool> full = full_links(frame);
  const frame::PairStates states(frame);
  std::size_t count = 0;
  const auto add = [&](bool in_full) {
    for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
      const FramePair& pair = frame.pairs[i];
      const auto a = bodies.find(pair.pair.a), b = bodies.find(pair.pair.b);
      if (full[i] != in_full || a == bodies.end() || b == bodies.end()) continue;
      if (++count > kMostPairs) return false;
      const LinkLook look{states.state_of(pair.pair), in_full, pair.lit};
      if (look.state == frame::PairState::contact ||
          (!in_full && look.state != frame::PairState::candidate))
        continue;
      const std::string key = pair_key("world/pair", *a->second, *b->second);
      const Marks::Scope scope(marks, key, key);
      marks.line(link_end(*a->second, *b->second), link_end(*b->second, *a->second),
                 stroke_of(look), in_full ? 2 : 0);
      marks.tell(kind_of(look));
    }
    return true;
  };
  const bool complete = add(false) && add(true);
  if (complete) marks.depict("pairs");
  return complete;
}

void draw_joints(const Frame& frame, const Marks3D& marks) {
  const BodiesById bodies = drawn_of(frame, marks.bodies);
  const std::vector<bool> full = full_links(frame);
  const frame::PairStates states(frame);
  Pen pen = marks.over();
  for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
    const FramePair& pair = frame.pairs[i];
    const auto a = bodies.find(pair.pair.a), b = bodies.find(pair.pair.b);
    const frame::PairState state = states.state_of(pair.pair);
    if (!full[i] || a == bodies.end() || b == bodies.end() || state == frame::PairState::contact)
      continue;
    const std::string key = pair_key("world/joint", *a->second, *b->second);
    const Marks::Scope scope(marks, key, key);
    const Vec<3> from = link_end(*a->second, *b->second), to = link_end(*b->second, *a->second);
    if (state == frame::PairState::shapes_apart)
      if (const auto at = marks.projection().seen((from + to) * 0.5))
        draw_cross(*at, Role::rejected_pair, pen);
    if (!overlap(a->second->box, b->second->box)) continue;
    const Box<3> common = common_part(a->second->box, b->second->box);
    const bool grounded = is_half_space(*a->second) || is_half_space(*b->second);
    const Vec<3> middle = !grounded ? common.center() : is_half_space(*a->second) ? from : to;
    marks.overlap_mark(middle);
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

void draw_missed(const Box<2>& common, Pen& pen) {
  for (const Stroke& stroke : {Stroke{Role::panel, 7}, Stroke{Role::warning, 3.4}}) {
    pen.path(polygon_of(common), true, stroke);
    pen.line(common.lo, common.hi, stroke);
    pen.line({common.lo.x, common.hi.y}, {common.hi.x, common.lo.y}, stroke);
  }
}

void mark_missed(const Frame& frame, const Marks& marks, Labels& labels) {
  const TextStyle style{kLabel, Weight::semibold, Role::warning, Role::panel};
  Pen pen = marks.over();
  for (const Pair& pair : frame::missed_pairs(frame)) {
    const FrameBody &a = *frame.body_of(pair.a), &b = *frame.body_of(pair.b);
    const Box<3> common = common_part(a.box, b.box);
    const auto at = marks.projection().seen(common.center());
    if (!at || !contains(marks.place(), *at)) continue;
    const Vec<2> size = flat(common.size()) * marks.projection().scale_at(common.center());
    const Box<2> box = Box<2>::around(*at, glm::max(size / 2.0, Vec<2>(9)));
    const std::string key = pair_key("world/missed", a, b);
    const Marks::Scope scope(marks, key, key);
    draw_missed(box, pen);
    Box<2> both = box;
    for (const FrameBody* body : {&a, &b})
      for (const Vec<3>& corner : corners_of(body->box))
        if (const auto seen = marks.projection().seen(corner)) both = united(both, {*seen, *seen});
    const auto places = anchors_around(both, 6, style);
    labels.try_add(word("missed"), {places[1], places[0], places[4], places[5], places[2]}, style,
                   marks.place());
    labels.block(box);
    marks.tell(MarkKind::missed);
  }
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

std::vector<Stack> stacks_of(std::span<const FrameBody* const> bodies) {
  const auto coincide = [](const FrameBody& a, const FrameBody& b) {
    const Vec<3> size = a.box.size();
    const double slip = 1e-6 * std::max({size.x, size.y, size.z});
    return glm::all(glm::lessThanEqual(glm::abs(a.box.lo - b.box.lo), Vec<3>(slip))) &&
           glm::all(glm::lessThanEqual(glm::abs(a.box.hi - b.box.hi), Vec<3>(slip)));
  };
  std::vector<Stack> stacks;
  for (const FrameBody* body : bodies) {
    const auto same = std::ranges::find_if(
        stacks, [&](const Stack& stack) { return coincide(*stack.front(), *body); });
    (same == stacks.end() ? stacks.emplace_back() : *same).push_back(body);
  }
  std::erase_if(stacks, [](const Stack& stack) { return stack.size() < 2; });
  return stacks;
}

namespace {

void draw_stack(const Stack& stack, const Box<2>& box, bool with_faces,
                const std::vector<Box<2>>& covered, const Box<2>& panel, DrawList& list,
                Labels& labels) {
  constexpr double kFace = 24, kApart = 4, kRim = 10;
  constexpr int kWays = 16;
  const std::string text = fmt::format("×{}", stack.size());
  const double width = with_faces ? static_cast<double>(stack.size()) * (kFace + kApart) : 0;
  const Vec<2> half = Vec<2>(2 * kRim + width + text_width(text, kStrong), kFace + 8) / 2.0;
  const Vec<2> c = box.center(), beside = box.size() / 2.0 + half + kApart;
  const Vec<2> corner = glm::clamp(Vec<2>(box.hi.x, box.lo.y), panel.lo + half, panel.hi - half);
  std::vector<Vec<2>> places = {corner, box.lo, box.hi, {box.lo.x, box.hi.y}};
  for (const Vec<2>& way : {Vec<2>(1, 0), {-1, 0}, {0, -1}, {0, 1}})
    places.push_back(c + way * beside);
  const auto near = std::ssize(places);
  for (const double ring : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0})
    for (const Vec<2>& way : ring_of({0, 0}, ring, kWays, 0))
      places.push_back(corner + way * half.y * 2.0);
  const auto is_free = [&](const Vec<2>& at) {
    return labels.is_free(Box<2>::around(at, half), panel);
  };
  auto at = std::find_if(places.begin(), places.begin() + near, [&](const Vec<2>& place) {
    return is_free(place) && !touches(covered, Box<2>::around(place, half));
  });
  if (at == places.begin() + near) at = std::ranges::find_if(places, is_free);
  if (at == places.end()) return;
  const Box<2> pill = Box<2>::around(*at, half);
  if (at - places.begin() >= near) list.line(corner, *at, {Role::quiet_ink, 1.6});
  list.rect(pill, Role::paper, {Role::quiet_ink, 1.6}, half.y);
  double x = pill.lo.x + kRim;
  for (std::size_t i = 0; with_faces && i < stack.size(); ++i, x += kFace + kApart)
    draw_icon(stack[i], Box<2>::around({x + kFace / 2, at->y}, Vec<2>(kFace / 2)), list);
  labels.add(text, centred({x, at->y}, kStrong, 0), kStrong, panel);
  labels.block(pill);
}

}  // namespace

void draw_stacks(const std::vector<std::pair<Stack, Box<2>>>& stacks,
                 const std::vector<Box<2>>& covered, const Box<2>& panel, DrawList& list,
                 Labels& labels) {
  constexpr std::size_t kMostFaces = 4, kFew = 6;
  for (const auto& [stack, box] : stacks) {
    const DrawList::Scope scope(list, body_key("world/stack", *stack.front()));
    std::vector<Box<2>> others = covered;
    std::erase_if(others,
                  [&](const Box<2>& other) { return overlap(shrunk(other, 1), shrunk(box, 1)); });
    const bool with_faces = stacks.size() <= kFew && stack.size() <= kMostFaces;
    draw_stack(stack, box, with_faces, others, panel, list, labels);
  }
}

void draw_tick(const Vec<2>& at, DrawList& list) {
  list.disc(at, 9.5, Role::panel, {Role::frustum, 2});
  const Vec<2> foot = at + Vec<2>(-1.2, 4);
  list.line(at + Vec<2>(-4.6, 0.4), foot, {Role::frustum, 2.6});
  list.line(foot, at + Vec<2>(5, -3.8), {Role::frustum, 2.6});
  list.marks.add(MarkKind::found);
}

void mark_passed(Mark mark, const Box<2>& box, DrawList& list, double radius) {
  if (mark != Mark::passed) return;
  const double inset = std::min(kPassedInset, std::min(box.size().x, box.size().y) / 5);
  list.rect(shrunk(box, inset), Role::none, kPassedStroke, std::max(0.0, radius - inset));
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
  // All pairs of what the frame is about, or none: some would look as if there were no others.
  for (const bool about : {true, false}) {
    std::vector<bool> more = full;
    for (std::size_t i = 0; i < n; ++i) {
      const FramePair& p = frame.pairs[i];
      if (about ? is_lit(p.pair.a) || is_lit(p.pair.b) : p.lit) more[i] = true;
    }
    if (std::ranges::count(more, true) <= std::ptrdiff_t{kMostFullLinks}) full = std::move(more);
  }
  return full;
}

void draw_centre(const Vec<2>& at, Pen& pen) {
  for (const Vec<2>& arm : {Vec<2>(6, 0), Vec<2>(0, 6)})
    pen.line(at - arm, at + arm, {Role::frustum, 2.2});
}

void draw_pin(const Vec<2>& at, Pen& pen) {
  pen.dot(at, 7.5, Role::panel, {Role::ink, 2.6});
  pen.dot(at, 2, Role::ink);
}

}  // namespace lantern::draw
