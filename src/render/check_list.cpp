#include "render/check_list.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern {
namespace {

constexpr double kMost = 1e6;  // page units

bool sane(double x) { return std::abs(x) <= kMost; }  // false for NaN
bool sane(const Vec<2>& p) { return sane(p.x) && sane(p.y); }
bool sane(const Stroke& s) { return sane(s.width) && sane(s.dash); }
bool sane(const RectShape& s) {
  return sane(s.box.lo) && sane(s.box.hi) && sane(s.radius) && sane(s.stroke);
}
bool sane(const LineShape& s) { return sane(s.from) && sane(s.to) && sane(s.stroke); }
bool sane(const PolygonShape& s) {
  return sane(s.stroke) &&
         std::all_of(s.points.begin(), s.points.end(), [](const Vec<2>& p) { return sane(p); });
}
bool sane(const TextShape& s) { return sane(s.at) && sane(s.size) && sane(s.align); }

}  // namespace

void check_draw_list(const DrawList& list) {
  if (!sane(list.page) || list.page.x <= 0 || list.page.y <= 0)
    throw Refused("a draw list's page must have a finite size above zero");
  for (std::size_t i = 0; i < list.shapes.size(); ++i)
    if (!std::visit([](const auto& s) { return sane(s); }, list.shapes[i]))
      throw Refused(fmt::format(
          "shape {} of the draw list has a coordinate or size that is not finite or beyond {}", i,
          kMost));
}

}  // namespace lantern
