// From page units to pixels.
#pragma once

#include <algorithm>
#include <cmath>

#include "draw/draw_list.hpp"
#include "render/instances.hpp"

namespace lantern::render {

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
