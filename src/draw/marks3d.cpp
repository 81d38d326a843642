#include <algorithm>
#include <iterator>

#include "draw/clip.hpp"
#include "draw/world3d_parts.hpp"

namespace lantern {

void Marks3D::add(const Convex& space, Outline outline, std::vector<DrawShape> shapes) {
  pieces.push_back({space, std::move(outline), true, false, std::move(shapes)});
}

void Marks3D::paint() {
  lantern::paint(std::move(pieces), view, list_);
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
  std::sort(hidden.begin(), hidden.end());
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

}  // namespace lantern
