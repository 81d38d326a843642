#include "report/settled.hpp"

#include <algorithm>

#include "draw/font.hpp"
#include "render/canvas.hpp"

namespace lantern::report {
namespace {

class Settler {
 public:
  Settler(const DrawList& list, int width, int height) : canvas_(list.page, width, height) {
    settled_.page = list.page;
    for (const DrawShape& shape : list.shapes) std::visit([&](const auto& s) { add(s); }, shape);
  }
  DrawList settled_;

 private:
  Vec<2> unit(const Vec<2>& pixel) const { return (pixel - canvas_.origin) / canvas_.scale; }
  bool has_line(const Stroke& stroke) const {
    return stroke.role != Role::none && stroke.width > 0;
  }

  // A dash of less than a pixel is drawn unbroken.
  Stroke seen(Stroke stroke) const {
    if (stroke.dash * canvas_.scale < 1) stroke.dash = 0;
    return stroke;
  }

  void add(RectShape shape) {
    shape.stroke = seen(shape.stroke);
    if (!shape.snapped) return keep(shape);
    shape.snapped = false;
    if (has_line(shape.stroke)) return add_framed(shape);
    Box<2> box = canvas_.pixels(shape.box);
    for (int i = 0; i < 2; ++i) {
      const bool flat = !(box.hi[i] > box.lo[i]);
      box.lo[i] = rounded(box.lo[i]);
      box.hi[i] = rounded(box.hi[i]);
      if (!flat) box.hi[i] = std::max(box.hi[i], box.lo[i] + 1);
    }
    shape.box = {unit(box.lo), unit(box.hi)};
    keep(shape);
  }

  // With a line around it. Behind a broken line, the ground ends on whole pixels by itself.
  void add_framed(RectShape shape) {
    const double width = snapped_width(shape.stroke.width * canvas_.scale);
    Box<2> box = canvas_.pixels(shape.box);
    for (Vec<2>* corner : {&box.lo, &box.hi})
      *corner = {snapped(corner->x, width), snapped(corner->y, width)};
    shape.stroke.width = width / canvas_.scale;
    shape.box = {unit(box.lo), unit(box.hi)};
    if (shape.stroke.dash > 0) {
      RectShape ground = shape;
      ground.stroke = {};
      ground.box = {unit({rounded(box.lo.x), rounded(box.lo.y)}),
                    unit({rounded(box.hi.x), rounded(box.hi.y)})};
      keep(ground);
      shape.fill = Role::none;
    }
    keep(shape);
  }

  void add(LineShape shape) {
    shape.stroke = seen(shape.stroke);
    const bool upright = shape.from.x == shape.to.x || shape.from.y == shape.to.y;
    if (!shape.snapped || !upright || shape.stroke.dash > 0 || !has_line(shape.stroke)) {
      shape.snapped = false;
      return keep(shape);
    }
    const Box<2> box = canvas_.snapped_line(shape);
    keep(RectShape{{unit(box.lo), unit(box.hi)}, 0, shape.stroke.role, {}, false});
  }

  void add(PolygonShape shape) {
    shape.stroke = seen(shape.stroke);
    keep(std::move(shape));
  }

  void add(TextShape shape) {
    shape.at.y = unit({0, rounded(canvas_.pixel(shape.at).y)}).y;
    keep(std::move(shape));
  }

  void keep(DrawShape shape) { settled_.shapes.push_back(std::move(shape)); }

  Canvas canvas_;
};

Box<2> reach_of(const RectShape& s) {
  return {s.box.lo - s.stroke.width, s.box.hi + s.stroke.width};
}
Box<2> reach_of(const LineShape& s) {
  return {glm::min(s.from, s.to) - s.stroke.width, glm::max(s.from, s.to) + s.stroke.width};
}
Box<2> reach_of(const PolygonShape& s) {
  Box<2> box{Vec<2>(1e9), Vec<2>(-1e9)};
  for (const Vec<2>& p : s.points) box = {glm::min(box.lo, p), glm::max(box.hi, p)};
  return {box.lo - s.stroke.width, box.hi + s.stroke.width};
}
Box<2> reach_of(const TextShape& s) {
  const double width = text_width(s.text, s.size, s.weight);
  const double left = s.at.x - s.align * width, spare = 6 + s.size;
  return {{left - spare, s.at.y - s.size - spare}, {left + width + spare, s.at.y + spare}};
}

void shift(RectShape& s, const Vec<2>& by) { s.box = {s.box.lo + by, s.box.hi + by}; }
void shift(LineShape& s, const Vec<2>& by) {
  s.from += by;
  s.to += by;
}
void shift(PolygonShape& s, const Vec<2>& by) {
  for (Vec<2>& p : s.points) p += by;
}
void shift(TextShape& s, const Vec<2>& by) { s.at += by; }

}  // namespace

DrawList settled(const DrawList& list, int width, int height) {
  return Settler(list, width, height).settled_;
}

DrawList window_of(const DrawList& list, const Box<2>& window) {
  DrawList part;
  part.page = window.size();
  const Box<2> near{window.lo - 2.0, window.hi + 2.0};
  for (const DrawShape& shape : list.shapes) {
    if (!std::visit([&](const auto& s) { return overlap(reach_of(s), near); }, shape)) continue;
    part.shapes.push_back(shape);
    std::visit([&](auto& s) { shift(s, -window.lo); }, part.shapes.back());
  }
  return part;
}

}  // namespace lantern::report
