#include <cmath>

#include "draw/marks.hpp"
#include "geometry/polygon.hpp"

namespace lantern {

void Marks::dot(const Vec<3>& at, double radius, Role fill, const Stroke& stroke) const {
  if (const auto page = projection_.seen(at)) over().dot(*page, radius, fill, stroke);
}

void Marks2D::line(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double casing) {
  over().line(view_.to_page(from), view_.to_page(to), stroke, casing);
}

void Marks2D::arrow(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke, double head,
                    double casing) {
  over().arrow(view_.to_page(from), view_.to_page(to), stroke, head, casing);
}

void Marks2D::spring(const Vec<3>& from, const Vec<3>& to, const Stroke& stroke) {
  over().path(spring_bends(view_.to_page(from), view_.to_page(to)), false, stroke);
}

void Marks2D::box(const Box<3>& box, const Stroke& stroke) {
  const Box<2> page = view_.to_page(box);
  if (holds(place_, page))
    list_.rect(page, Role::none, stroke);
  else
    over().path(polygon_of(page), true, stroke);
}

// With a cross at its centre.
void Marks2D::ball(const Vec<3>& center, double radius, const Stroke& stroke) {
  constexpr double kArm = 6;
  const Vec<2> page = view_.to_page(center);
  const double reach = radius * view_.scale();
  Pen pen = over();
  if (holds(place_, Box<2>::around(page, Vec<2>(reach))))
    list_.disc(page, reach, Role::none, stroke);
  else if (std::isfinite(reach))
    pen.path(ring_of(page, reach, 60), true, {stroke.role, stroke.width});
  for (const Vec<2>& arm : {Vec<2>(kArm, 0), Vec<2>(0, kArm)})
    pen.line(page - arm, page + arm, {stroke.role, 2.2});
}

}  // namespace lantern
