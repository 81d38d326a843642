#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "draw/body_shapes.hpp"
#include "draw/characters.hpp"
#include "draw/font.hpp"
#include "draw/panels.hpp"

namespace lantern {
namespace {

constexpr double kLeastBand = 22, kMostBand = 44;
constexpr double kAxisHeading = 34, kAxis = 16;

int axis_of(const Frame& frame) {
  for (const int axis : {1, 2})
    if (frame.settings.find(std::string("along ") + "xyz"[axis]) != std::string::npos) return axis;
  return 0;
}

// In the order of their lower ends; ids break ties.
std::vector<const FrameBody*> swept(const Frame& frame, int axis) {
  std::vector<const FrameBody*> order;
  for (const FrameBody& body : frame.bodies)
    if (!is_half_space(body)) order.push_back(&body);
  std::stable_sort(order.begin(), order.end(), [&](const FrameBody* a, const FrameBody* b) {
    return a->box.lo[axis] < b->box.lo[axis];
  });
  return order;
}

}  // namespace

void draw_sweep(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  const int axis = axis_of(frame);
  const Box<2> world{{frame.bounds.lo[axis], 0}, {frame.bounds.hi[axis], 1}};
  std::vector<const FrameBody*> order = swept(frame, axis);
  const double length = world.size().x;
  if (order.empty() || !(length > 0) || panel.size().y < kAxisHeading + 2 * kMostBand) return;
  const TextStyle heading{kLabel, Weight::semibold, Role::quiet_ink};
  const TextStyle note{kLeastLabel + 0.4, Weight::regular, Role::quiet_ink};
  labels.add(
      shortened(fmt::format("intervals along {}, sorted", "xyz"[axis]), panel.size().x, heading),
      {{panel.lo.x, panel.lo.y + 20}, 0}, heading, panel);
  Box<2> area{panel.lo + Vec<2>(kMostBand, kAxisHeading), panel.hi - Vec<2>(14, kAxis + 26)};
  const auto most = static_cast<std::size_t>(std::max(1.0, area.size().y / kLeastBand));
  const std::size_t all = order.size();
  if (all > most) order.resize(most);
  const double row = std::min(kMostBand, area.size().y / static_cast<double>(order.size()));
  area.hi.y = area.lo.y + row * static_cast<double>(order.size());
  const auto x_of = [&](double at) {
    const double share = (at - world.lo.x) / length;
    return area.lo.x + (share > 0 ? std::min(share, 1.0) : 0) * area.size().x;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const FrameBody& body = *order[i];
    const double y = area.lo.y + (static_cast<double>(i) + 0.5) * row;
    const double from = x_of(body.box.lo[axis]), to = x_of(body.box.hi[axis]);
    if (body.lit)
      list.rect({{panel.lo.x, y - row / 2 + 1}, {area.hi.x + 8, y + row / 2 - 1}}, Role::lit_fill,
                {}, 4);
    // A thin line down to where the sweep meets it.
    list.crisp_line({from, y}, {from, area.hi.y}, {Role::rule, 1.4, 4});
    const double half = std::min(0.3 * row, 9.0);
    list.rect({{from, y - half}, {std::max(to, from + 3), y + half}},
              body.dimmed ? Role::panel : body_role(body.color),
              {body.lit ? Role::lit : Role::body_line, 1.6, 0}, 2);
    const double icon = std::min(0.42 * row, 15.0);
    draw_character(body, Box<2>::around({panel.lo.x + icon + 3, y}, Vec<2>(icon)), false, list);
  }
  list.crisp_line({area.lo.x, area.hi.y + 4}, {area.hi.x, area.hi.y + 4}, {Role::ink, 2.0});
  const double below = area.hi.y + kAxis + 12;
  labels.try_add(std::string(1, "xyz"[axis]), {{{area.hi.x, below}, 1}}, note, panel);
  if (all > order.size())
    labels.try_add(fmt::format("and {} more", all - order.size()), {{{area.lo.x, below}, 0}}, note,
                   panel);
}

}  // namespace lantern
