#include <algorithm>

#include "draw/solid_parts.hpp"

namespace lantern {

void add_piece(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, const Stroke& casing,
               const SolidView& view, std::vector<Piece>& pieces) {
  const auto seen = view.in_sight(from, to);
  const auto page = view.segment(from, to);
  if (!seen || !page) return;
  Piece piece{
      Convex::line(seen->first, seen->second), {page->first, page->second}, true, false, {}};
  if (casing.width > 0)
    piece.shapes.emplace_back(LineShape{page->first, page->second, casing, false});
  piece.shapes.emplace_back(LineShape{page->first, page->second, stroke, false});
  pieces.push_back(std::move(piece));
}

void add_line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, const Stroke& casing,
              const std::vector<SolidBody>& bodies, const SolidView& view,
              std::vector<Piece>& pieces) {
  if (view.lost(from) || view.lost(to)) return;
  const Box<3> reach{glm::min(from, to), glm::max(from, to)};
  std::vector<std::pair<double, double>> hidden;
  for (const SolidBody& b : bodies) {
    if (!overlap(b.body->box, reach)) continue;
    if (const auto part = inside_of(b.space, from, to)) hidden.push_back(*part);
  }
  std::sort(hidden.begin(), hidden.end());
  double start = 0;
  const auto add = [&](double end) {
    if (end - start > 1e-6)
      add_piece(from + (to - from) * start, from + (to - from) * end, stroke, casing, view, pieces);
  };
  for (const auto& [first, last] : hidden) {
    add(first);
    start = std::max(start, last);
  }
  add(1);
}

void add_head(const Vec<3>& from, const Vec<3>& to, double size, Role role, const SolidView& view,
              std::vector<Piece>& pieces) {
  if (!view.in_front(from) || !view.in_front(to)) return;
  const Vec<2> tip = view.to_page(to), way = tip - view.to_page(from);
  const double length = glm::length(way);
  if (!(length > size)) return;
  const Vec<2> along = way / length, side{-along.y, along.x};
  const Vec<2> back = tip - along * size;
  Outline head{tip, back + side * (0.45 * size), back - side * (0.45 * size)};
  if (!holds(view.panel(), box_of(head))) return;
  Piece piece{Convex::line(to, to), hull_of(head), true, false, {}};
  piece.shapes.emplace_back(PolygonShape{std::move(head), role, {}});
  pieces.push_back(std::move(piece));
}

void add_box(const Box<3>& box, const Stroke& stroke, const std::vector<SolidBody>& bodies,
             const SolidView& view, std::vector<Piece>& pieces) {
  const std::vector<Vec<3>> c = corners_of(box);
  for (unsigned i = 0; i < 8; ++i)
    for (const unsigned bit : {1u, 2u, 4u})
      if ((i & bit) == 0) add_line(c[i], c[i + bit], stroke, {}, bodies, view, pieces);
}

void draw_spot(const Vec<3>& at, double radius, Role role, const SolidView& view, DrawList& list) {
  if (view.lost(at) || !view.in_front(at)) return;
  const Vec<2> page = view.to_page(at);
  if (!holds(view.panel(), Box<2>::around(page, Vec<2>(radius + 2)))) return;
  list.disc(page, radius, role, {Role::panel, 2});
}

}  // namespace lantern
