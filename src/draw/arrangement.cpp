#include "draw/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "draw/panels.hpp"
#include "draw/tree_layout.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeast3D = 0.95,
                 kMost3D = 1.35;  // aspects of a 3D world's panel
constexpr double kPanelGap = 44;
constexpr double kLeastForTwo = 460;  // height of a column with two panels
constexpr double kLeastChart = 300;   // height: a flatter one shows no course
constexpr double kStripGap = 30;      // over a strip

// Width over height.
double world_aspect(const Frame& frame) {
  const Vec<3> size = frame.bounds.size();
  if (!(size.y > 0)) return 1;
  if (frame.dimension == 2) return size.x / size.y;
  // Seen from aside, what is wide or deep takes width.
  return std::clamp(std::max(size.x, size.z) / size.y, kLeast3D, kMost3D);
}

// The islands stand where their bodies are in the world.
bool is_like_world(Panel panel) { return panel == Panel::world || panel == Panel::islands; }

// Width that a panel would take at this height if it could choose; 0 takes what is left.
double wanted_width(const Frame& frame, Panel panel, double height) {
  if (panel == Panel::atlas) return atlas_width(frame, height);
  if (panel == Panel::screen) return screen_width(frame, height);
  return is_like_world(panel) ? height * world_aspect(frame) : 0;
}

bool takes_the_rest(Panel panel) {
  return !is_like_world(panel) && panel != Panel::atlas && panel != Panel::screen;
}

std::vector<Box<2>> side_by_side(const Frame& frame, const std::vector<Panel>& panels,
                                 const Box<2>& area) {
  const double room = area.size().x - kPanelGap * static_cast<double>(panels.size() - 1);
  const auto flexible = std::ranges::count_if(panels, takes_the_rest);
  const auto others = static_cast<double>(panels.size()) - static_cast<double>(flexible);
  std::vector<double> widths;
  double left = room;
  for (const Panel panel : panels) {
    double width = 0;
    if (!takes_the_rest(panel))
      width = flexible == 0 ? room / others
                            : std::clamp(wanted_width(frame, panel, area.size().y),
                                         0.3 * room / others, 0.6 * room / others);
    widths.push_back(width);
    left -= width;
  }
  std::ranges::replace(widths, 0.0, left / static_cast<double>(flexible));
  return split(area, 0, widths, kPanelGap);
}

double weight_of(Panel panel) {
  if (panel == Panel::tree) return 1.2;
  if (panel == Panel::ledger) return 1.1;
  if (panel == Panel::code) return 1.3;
  if (panel == Panel::memory) return 0.6;
  if (panel == Panel::pool) return 0.4;
  return panel == Panel::bytes || panel == Panel::sparkline ? 0.28 : 1.0;
}

bool is_strip(Panel panel) {
  return panel == Panel::memory || panel == Panel::pool || panel == Panel::bytes ||
         panel == Panel::sparkline || panel == Panel::collisions;
}

// A tree needs rows, so it gets somewhat more height than the others; strips get little.
std::vector<Box<2>> stacked(const std::vector<Panel>& panels, const Box<2>& area) {
  std::vector<double> weights;
  for (const Panel panel : panels) weights.push_back(weight_of(panel));
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double room = area.size().y - kPanelGap * (static_cast<double>(panels.size()) - 1);
  const auto trees = static_cast<double>(std::ranges::count(panels, Panel::tree));
  const double others =  // that they need; a tree has four rows and their labels
      260 * (static_cast<double>(panels.size()) - 1 - trees) + 320 * trees;
  const auto chart = std::ranges::find(panels, Panel::chart) - panels.begin();
  if (chart < std::ssize(panels) && panels.size() > 1 && room > kLeastChart + others) {
    double& weight = weights[static_cast<std::size_t>(chart)];
    weight = std::max(weight, kLeastChart / (room - kLeastChart) * (all - weight));
  }
  return split(area, 1, weights, kPanelGap);
}

double strip_height(const Frame& frame, Panel panel, const Vec<2>& room) {
  if (panel == Panel::sparkline) return sparkline_height();
  if (panel == Panel::bytes) return bytes_height();
  if (panel == Panel::collisions) return std::min(collisions_height(frame), 0.46 * room.y);
  if (panel == Panel::pool) return std::min(pool_height(frame, room.x), 0.46 * room.y);
  return std::clamp(memory_height(frame, room.x), 0.2 * room.y, 0.46 * room.y);
}

// A strip lies under all the others, as wide as they are together. The tallest of the group's, so
// that nothing above it moves when the strip grows. Cuts it from the area.
Box<2> cut_strip(const Staging& staging, Panel panel, Box<2>& area) {
  double strip = 0;
  for (const Frame* frame : staging.frames())
    strip = std::max(strip, strip_height(*frame, panel, area.size()));
  Box<2> box = area;
  box.lo.y = area.hi.y - strip;
  area.hi.y = box.lo.y - kStripGap;
  return box;
}

// A wide world and what happens in it over time: one above the other, both get larger.
bool is_world_over_time(const Frame& frame) {
  constexpr double kWideWorld = 1.9;  // aspect of a world
  if (!frame.get<FrameChart>().over_time || frame.panels.size() != 2) return false;
  const auto has = [&](Panel panel) { return std::ranges::count(frame.panels, panel) > 0; };
  const Vec<3> size = frame.bounds.size();
  return has(Panel::world) && has(Panel::chart) && size.x > kWideWorld * std::max(size.y, size.z);
}

std::vector<Box<2>> over_its_chart(const Frame& frame, const Box<2>& area) {
  constexpr double kShare = 0.56;  // of the height, for the world
  const double height = area.size().y, least = std::min(kLeastChart, 0.6 * height);
  const double middle = area.hi.y - std::max((1 - kShare) * height, least + kPanelGap / 4);
  const Box<2> world{area.lo, {area.hi.x, middle - kPanelGap / 4}};
  const Box<2> chart{{area.lo.x, middle + kPanelGap / 4}, area.hi};
  return frame.panels[0] == Panel::world ? std::vector{world, chart} : std::vector{chart, world};
}

// On a wide page, above the strips. What takes the rest of the width stands in one column beside
// the world, so that nothing gets narrow.
std::vector<Box<2>> in_columns(const Frame& frame, const std::vector<Panel>& panels,
                               const Box<2>& area) {
  std::vector<Box<2>> boxes(panels.size());
  const bool shares = area.size().y >= kLeastForTwo && !std::ranges::all_of(panels, takes_the_rest);
  // The first panel of each column, and all of the column of those that take the rest.
  std::vector<std::size_t> firsts, shared;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const bool joins = shares && takes_the_rest(panels[i]);
    if (joins) shared.push_back(i);
    if (!joins || shared.size() == 1) firsts.push_back(i);
  }
  const auto panels_of = [&](const std::vector<std::size_t>& some) {
    std::vector<Panel> found;
    for (const std::size_t i : some) found.push_back(panels[i]);
    return found;
  };
  const std::vector<Box<2>> places = side_by_side(frame, panels_of(firsts), area);
  for (std::size_t c = 0; c < firsts.size(); ++c) boxes[firsts[c]] = places[c];
  if (shared.size() < 2) return boxes;
  const std::vector<Box<2>> cut = stacked(panels_of(shared), boxes[shared[0]]);
  for (std::size_t k = 0; k < cut.size(); ++k) boxes[shared[k]] = cut[k];
  return boxes;
}

// How large a world gets in a box: the side of a square as large as its picture.
double size_in(const Frame& frame, const Box<2>& box) {
  const Vec<2> size = box.size();
  const double width = std::min(size.x, size.y * world_aspect(frame));
  return std::sqrt(width * width / world_aspect(frame));
}

// A world and a tree: of all ways to cut the area in two the one in which both are large.
std::vector<Box<2>> world_and_tree(const std::vector<Panel>& panels, const Frame& frame,
                                   const Staging& staging, const Box<2>& area) {
  constexpr double kLeastShare = 0.3, kMostShare = 0.7, kStep = 0.025;
  // A level is read on its map, whose sectors have numbers and bodies in them.
  const double weight = frame.get<FrameLevel>().walls.empty() ? 1 : 1.5;
  std::vector<Box<2>> best;
  double most = -1;
  const bool world_first = panels[0] == Panel::world;
  for (const int axis : {0, 1})
    for (double share = kLeastShare; share < kMostShare + kStep / 2; share += kStep) {
      std::vector<Box<2>> cut =
          split(area, axis, {world_first ? share : 1 - share, world_first ? 1 - share : share},
                kPanelGap);
      const double world = size_in(frame, cut[world_first ? 0 : 1]);
      const Box<2>& other = cut[world_first ? 1 : 0];
      // A grid's table takes what it gets, whatever the cells of the moment are.
      const double tree = frame.get<FrameStructure>().grid_levels.empty()
                              ? tree_size_in(staging, other)
                              : std::sqrt(other.size().x * other.size().y);
      // Beside each other is what a hall is used to: one above the other must gain something.
      const double gain = std::pow(world, weight) * tree * (axis == 0 ? 1.1 : 1.0);
      if (gain <= most + 1e-9) continue;
      most = gain;
      best = std::move(cut);
    }
  return best;
}

bool is_world_and_tree(const std::vector<Panel>& panels) {
  return panels.size() == 2 && std::ranges::count(panels, Panel::world) == 1 &&
         std::ranges::count(panels, Panel::tree) == 1;
}

// All but strips.
std::vector<Box<2>> without_strips(const Frame& frame, const Staging& staging,
                                   const std::vector<Panel>& panels, const Box<2>& area) {
  if (panels.size() == 1) return {area};
  return is_world_and_tree(panels) ? world_and_tree(panels, frame, staging, area)
                                   : in_columns(frame, panels, area);
}

// Strips below, the others above them.
std::vector<Box<2>> over_strips(const Frame& frame, const Staging& staging, Box<2> area) {
  std::vector<Box<2>> boxes(frame.panels.size());
  std::vector<Panel> others;
  for (std::size_t i = frame.panels.size(); i-- > 0;)
    if (is_strip(frame.panels[i])) boxes[i] = cut_strip(staging, frame.panels[i], area);
  std::ranges::remove_copy_if(frame.panels, std::back_inserter(others), is_strip);
  const std::vector<Box<2>> places = without_strips(frame, staging, others, area);
  std::size_t next = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (!is_strip(frame.panels[i])) boxes[i] = places[next++];
  return boxes;
}

}  // namespace

std::vector<Box<2>> arranged(const Frame& frame, const Staging& staging, const Box<2>& area,
                             bool tall) {
  if (frame.panels.size() == 1) return {area};
  if (tall || std::ranges::all_of(frame.panels, is_strip)) return stacked(frame.panels, area);
  if (is_world_over_time(frame)) return over_its_chart(frame, area);
  return staging.once<std::vector<Box<2>>>("panels", area,
                                           [&] { return over_strips(frame, staging, area); });
}

}  // namespace lantern::draw
