#include <algorithm>

#include <fmt/format.h>

#include "draw/labels.hpp"
#include "draw/pen.hpp"
#include "draw/tween.hpp"

namespace lantern::draw {
namespace {

int number_of(Role role) { return static_cast<int>(role); }

std::string style_of(const Stroke& stroke) {
  return fmt::format("{},{}", number_of(stroke.role), stroke.dash > 0);
}

TextStyle style_of(const TextShape& s) { return {s.size, s.weight, s.role, s.halo}; }

bool blends(const RectShape& a, const RectShape& b) {
  return (a.stroke.dash > 0) == (b.stroke.dash > 0);
}
bool blends(const LineShape& a, const LineShape& b) {
  return (a.stroke.dash > 0) == (b.stroke.dash > 0);
}
bool blends(const PolygonShape& a, const PolygonShape& b) {
  return a.points.size() == b.points.size() && (a.stroke.dash > 0) == (b.stroke.dash > 0);
}
bool blends(const TextShape& a, const TextShape& b) {
  return a.text == b.text && a.weight == b.weight && a.align == b.align;
}

Vec<2> mix(const Vec<2>& a, const Vec<2>& b, double share) { return a + (b - a) * share; }

// One that comes or goes has the other's width and dashes meanwhile.
Stroke mix(const Stroke& a, const Stroke& b, double share) {
  if (a.role == Role::none) return b;
  if (b.role == Role::none) return {Role::none, a.width, a.dash};
  return {b.role, draw::mix(a.width, b.width, share), draw::mix(a.dash, b.dash, share)};
}

// What moves is not put on whole pixels, or it would go in jerks.
void move(const RectShape& a, RectShape& b, double share) {
  b.snapped = b.snapped && a.box == b.box;
  b.box = draw::mix(a.box, b.box, share);
  b.radius = draw::mix(a.radius, b.radius, share);
  b.stroke = mix(a.stroke, b.stroke, share);
}

// Along itself a crisp line may grow.
bool runs_along(const LineShape& a, const LineShape& b) {
  return (a.from.y == b.from.y && a.to.y == b.to.y) || (a.from.x == b.from.x && a.to.x == b.to.x);
}

void move(LineShape a, LineShape& b, double share) {
  const auto way = [&](const LineShape& s) {
    return glm::distance(s.from, b.from) + glm::distance(s.to, b.to);
  };
  LineShape turned = a;
  std::swap(turned.from, turned.to);
  if (way(turned) < way(a)) a = turned;
  b.snapped = b.snapped && runs_along(a, b);
  b.from = mix(a.from, b.from, share);
  b.to = mix(a.to, b.to, share);
  b.stroke = mix(a.stroke, b.stroke, share);
}

void move(const PolygonShape& a, PolygonShape& b, double share) {
  for (std::size_t i = 0; i < b.points.size(); ++i)
    b.points[i] = mix(a.points[i], b.points[i], share);
  b.stroke = mix(a.stroke, b.stroke, share);
}

void move(const TextShape& a, TextShape& b, double share) {
  b.at = mix(a.at, b.at, share);
  b.size = draw::mix(a.size, b.size, share);
}

}  // namespace

Box<2> extent_of(const DrawShape& shape) {
  if (const auto* rect = std::get_if<RectShape>(&shape)) return rect->box;
  if (const auto* line = std::get_if<LineShape>(&shape))
    return {glm::min(line->from, line->to), glm::max(line->from, line->to)};
  if (const auto* text = std::get_if<TextShape>(&shape))
    return Labels::extent(text->text, {text->at, text->align}, style_of(*text));
  const auto& points = std::get<PolygonShape>(shape).points;
  if (points.empty()) return {};
  return box_of(points);
}

std::string style_of(const DrawShape& shape) {
  std::string text = fmt::format("{}:", shape.index());
  std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.fill; }) text += fmt::format("{} ", number_of(s.fill));
        if constexpr (requires { s.stroke; }) text += style_of(s.stroke);
        if constexpr (requires { s.points; }) text += fmt::format(" {}", s.points.size());
        if constexpr (requires { s.snapped; }) text += s.snapped ? " crisp" : "";
        if constexpr (requires { s.text; })
          text += fmt::format("{} {} {} {} {}", number_of(s.role), number_of(s.halo),
                              static_cast<int>(s.weight), s.align, s.text);
      },
      shape);
  return text;
}

bool can_blend(const DrawShape& a, const DrawShape& b) {
  if (a.index() != b.index()) return false;
  return std::visit(
      [&](const auto& from) { return blends(from, std::get<std::decay_t<decltype(from)>>(b)); }, a);
}

std::pair<DrawShape, Tint> blend(const DrawShape& a, const DrawShape& b, double share) {
  std::pair<DrawShape, Tint> result{b, {}};
  Tint& tint = result.second;
  std::visit(
      [&](auto& to) {
        const auto& from = std::get<std::decay_t<decltype(to)>>(a);
        tint.share = 1 - share;
        if constexpr (requires { to.fill; }) tint.fill = from.fill;
        if constexpr (requires { to.stroke; }) tint.line = from.stroke.role;
        if constexpr (requires { to.text; }) tint.fill = from.role, tint.line = from.halo;
        move(from, to, share);
      },
      result.first);
  return result;
}

DrawShape put(DrawShape shape, const Box<2>& from, const Box<2>& to) {
  if (from == to) return shape;
  Vec<2> scale{1.0};
  for (int i = 0; i < 2; ++i)
    if (from.size()[i] > 1e-9) scale[i] = to.size()[i] / from.size()[i];
  const auto place = [&](Vec<2>& p) { p = to.center() + (p - from.center()) * scale; };
  const double size = std::min(scale.x, scale.y);
  std::visit(
      [&](auto& s) {
        if constexpr (requires { s.box; }) place(s.box.lo), place(s.box.hi), s.radius *= size;
        if constexpr (requires { s.to; }) {
          const LineShape before = s;
          place(s.from), place(s.to);
          s.snapped = s.snapped && runs_along(before, s);
        }
        if constexpr (requires { s.points; })
          for (Vec<2>& p : s.points) place(p);
        if constexpr (requires { s.text; }) place(s.at), s.size *= std::min(size, 1.0);
        if constexpr (requires { s.box; }) s.snapped = false;
      },
      shape);
  return shape;
}

}  // namespace lantern::draw
