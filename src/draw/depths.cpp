#include "draw/depths.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lantern {
namespace {

constexpr std::size_t kMostDepths = 60;
constexpr double kNumberBeside = 16;  // between a contact's outermost point and its number

struct Depth {
  double depth = 0;
  Box<2> points;  // of the contact, on the page
};

std::vector<Depth> depths_of(const Frame& frame, const ToPage& to_page) {
  std::vector<Depth> found;
  for (const FrameContact& contact : frame.contacts) {
    Depth d;
    bool seen = false;
    for (const FrameContact::Point& point : contact.points) {
      const auto at = to_page(point.position);
      if (!at) continue;
      d.points =
          seen ? Box<2>{glm::min(d.points.lo, *at), glm::max(d.points.hi, *at)} : Box<2>{*at, *at};
      d.depth = std::max(d.depth, -point.separation);
      seen = true;
    }
    if (seen) found.push_back(d);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Depth& a, const Depth& b) { return a.depth > b.depth; });
  if (found.size() > kMostDepths) found.resize(kMostDepths);
  return found;
}

}  // namespace

std::string depth_text(double depth) {
  if (!(depth >= 0.995e-9)) return "0";  // rounding of places, not depth
  static constexpr struct {
    double size;
    double from;  // depths, so that nothing is rounded up to the next unit
    const char* name;
  } kUnits[] = {{1, 0.995, "m"},
                {0.01, 0.0995, "cm"},
                {1e-3, 0.995e-4, "mm"},
                {1e-6, 0.995e-6, "µm"},
                {1e-9, 0, "nm"}};
  for (const auto& unit : kUnits) {
    if (depth < unit.from) continue;
    const double number = depth / unit.size;
    const int decimals = number < 0.995 ? 2 : number < 9.95 ? 1 : 0;
    return fmt::format("{:.{}f} {}", number, decimals, unit.name);
  }
  return "0";
}

void write_depths(const Frame& frame, const ToPage& to_page, const std::vector<Box<2>>& bodies,
                  const Box<2>& panel, Labels& labels) {
  if (!frame.show_depths) return;
  const TextStyle style{kLabel, Weight::semibold, Role::contact, Role::panel};
  const Box<2> room{panel.lo + Vec<2>(4, 4), panel.hi - Vec<2>(4, 4)};
  for (const Depth& d : depths_of(frame, to_page)) {
    const std::string text = depth_text(d.depth);
    // Above the line on which one lies on the other, or else below it, or across it.
    const double above = d.points.center().y - 7, below = d.points.center().y + style.size;
    const double middle = d.points.center().y + 0.36 * style.size;
    const double right = d.points.hi.x + kNumberBeside, left = d.points.lo.x - kNumberBeside;
    double far_right = right, far_left = left;  // beside the bodies that touch there
    for (const Box<2>& body : bodies) {
      if (!overlap(body, d.points)) continue;
      far_right = std::max(far_right, body.hi.x + kNumberBeside);
      far_left = std::min(far_left, body.lo.x - kNumberBeside);
    }
    const Anchor anchors[] = {{{right, above}, 0},      {{left, above}, 1},     {{right, below}, 0},
                              {{left, below}, 1},       {{right, middle}, 0},   {{left, middle}, 1},
                              {{far_right, middle}, 0}, {{far_left, middle}, 1}};
    const auto place = [&](bool clear) {
      for (const Anchor& anchor : anchors) {
        const Box<2> extent = Labels::extent(text, anchor, style);
        const bool covers = std::any_of(bodies.begin(), bodies.end(),
                                        [&](const Box<2>& body) { return overlap(body, extent); });
        if ((clear && covers) || !labels.is_free(extent, room)) continue;
        labels.add(text, anchor, style, panel);
        return true;
      }
      return false;
    };
    if (!place(true)) place(false);
  }
}

}  // namespace lantern
