// What all painters of draw lists have in common.
#pragma once

#include "base/error.hpp"
#include "draw/draw_list.hpp"
#include "draw/theme.hpp"
#include "render/instances.hpp"

namespace lantern::render {

// Red, green, blue and opacity, not multiplied; opacity 0 is not painted at all.
using Paint = std::array<std::uint8_t, 4>;

// Opaque unless it is tinted. `other` is the role of the tint that is mixed in: of its fill or its
// line. A role that is none has no colour, only less opacity.
inline Paint tinted(const Theme& theme, Role role, const Tint* tint, Role Tint::*other) {
  const auto color = [&](Role of) { return of == Role::none ? Color{} : theme[of]; };
  const Color own = color(role);
  if (!tint) return {own.r, own.g, own.b, static_cast<std::uint8_t>(role == Role::none ? 0 : 255)};
  const Color far = color(tint->*other);
  const double mine = role == Role::none ? 0 : 1 - tint->share;
  const double theirs = tint->*other == Role::none ? 0 : tint->share;
  const double all = mine + theirs;
  const auto whole = [](double x) { return static_cast<std::uint8_t>(std::floor(x + 0.5)); };
  const std::uint8_t opacity = whole(255 * tint->opacity * all);
  if (opacity == 0) return {};
  const auto mixed = [&](std::uint8_t a, std::uint8_t b) {
    return whole((a * mine + b * theirs) / all);
  };
  return {mixed(own.r, far.r), mixed(own.g, far.g), mixed(own.b, far.b), opacity};
}

// Throws Refused, naming the shape's number, if a coordinate, size or width is not finite or is
// beyond a million page units, or if the page has no area, or if some shapes have a tint and others
// none.
inline void check_draw_list(const DrawList& list) {
  constexpr double kMost = 1e6;                                     // page units
  const auto sane = [](double x) { return std::abs(x) <= kMost; };  // false for NaN

  if (!sane(list.page.x) || !sane(list.page.y) || list.page.x <= 0 || list.page.y <= 0)
    throw Refused("a draw list's page must have a finite size above zero");
  if (!list.tints.empty() && list.tints.size() != list.shapes.size())
    throw Refused("a draw list of {} shapes has {} tints", list.shapes.size(), list.tints.size());
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    bool good = true;
    const auto look_at = [&](double measure) { good &= sane(measure); };
    std::visit([&](const auto& s) { for_each_measure(s, look_at); }, list.shapes[i]);
    if (const auto* text = std::get_if<TextShape>(&list.shapes[i])) look_at(text->align);
    if (!good)
      throw Refused(
          "shape {} of the draw list has a coordinate or size that is not finite or beyond {}", i,
          kMost);
  }
}

// Half upwards, on every machine and in every rounding mode.
inline double rounded(double x) { return std::floor(x + 0.5); }

// Snapped lines are a whole number of pixels wide, at least one.
inline double snapped_width(double pixels) { return std::max(1.0, rounded(pixels)); }

// The first pixel of a snapped line about x. Two shapes with an edge at the same x put their lines
// on the same pixels.
inline double first_pixel(double x, double width) { return rounded(x - 0.5 * width); }

// The centre of a snapped line about x.
inline double snapped(double x, double width) { return first_pixel(x, width) + 0.5 * width; }

// One uniform scale; the page is centred in the image.
struct Canvas {
  int width = 0, height = 0;  // pixels
  double scale = 1;           // pixels a page unit
  Vec<2> origin{0.0};         // of the page, pixels

  Canvas() = default;
  Canvas(const Vec<2>& page, int w, int h)
      : width(w), height(h), scale(std::min(w / page.x, h / page.y)) {
    origin = (Vec<2>(w, h) - page * scale) * 0.5;
  }
  Vec<2> pixel(const Vec<2>& p) const { return origin + p * scale; }
  Box<2> pixels(const Box<2>& b) const { return {pixel(b.lo), pixel(b.hi)}; }

  // The pixels of a snapped line that is upright or level.
  Box<2> snapped_line(const LineShape& line) const {
    const double wide = snapped_width(line.stroke.width * scale);
    const Box<2> ends = pixels({glm::min(line.from, line.to), glm::max(line.from, line.to)});
    Box<2> box;
    for (int i = 0; i < 2; ++i) {
      box.lo[i] = first_pixel(ends.lo[i], wide);
      box.hi[i] = first_pixel(ends.hi[i], wide) + wide;
    }
    return box;
  }

  // The part of the image that can hold pixels of a box.
  PixelRect around(const Box<2>& b) const {
    const auto whole = [](double x, int most) {
      return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
    };
    return {whole(std::floor(b.lo.x), width), whole(std::floor(b.lo.y), height),
            whole(std::ceil(b.hi.x), width), whole(std::ceil(b.hi.y), height)};
  }
};

}  // namespace lantern::render
