#include "draw/panel.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "frame/parts/panels.hpp"

namespace lantern::draw {

// Each is in a file of its own; this is their order in the reference.
PanelEntry world_panel(), tree_panel(), atlas_panel(), chart_panel(), memory_panel(),
    ledger_panel(), pool_panel(), bytes_panel(), sparkline_panel(), difference_panel(),
    axes_panel(), comparison_panel(), clock_panel(), islands_panel(), code_panel(),
    collisions_panel(), matrix_panel(), screen_panel();

namespace {

constexpr PanelEntry (*kPanels[])() = {
    world_panel, tree_panel,    atlas_panel,     chart_panel,      memory_panel, ledger_panel,
    pool_panel,  bytes_panel,   sparkline_panel, difference_panel, axes_panel,   comparison_panel,
    clock_panel, islands_panel, code_panel,      collisions_panel, matrix_panel, screen_panel};

std::vector<PanelView>& views() {
  static std::vector<PanelView> all;
  return all;
}

const bool kAreKnown = [] {
  for (const auto panel : kPanels) add_panel(panel());
  return true;
}();

constexpr double kPanelGap = 44;
constexpr double kLeastForTwo = 460;  // height of a column with two panels
constexpr double kLeastChart = 300;   // height: a flatter one shows no course
constexpr double kStripGap = 30;      // over a strip

bool takes_the_rest(Panel panel) { return !view_of(panel).width; }
bool is_strip(Panel panel) { return view_of(panel).strip; }

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
                            : std::clamp(view_of(panel).width(frame, area.size().y),
                                         0.3 * room / others, 0.6 * room / others);
    widths.push_back(width);
    left -= width;
  }
  std::ranges::replace(widths, 0.0, left / static_cast<double>(flexible));
  return split(area, 0, widths, kPanelGap);
}

// A tree needs rows, so it gets somewhat more height than the others; strips get little.
std::vector<Box<2>> stacked(const std::vector<Panel>& panels, const Box<2>& area) {
  auto weights = mapped(panels, [&](const Panel panel) { return view_of(panel).weight; });
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double room = area.size().y - kPanelGap * (static_cast<double>(panels.size()) - 1);
  const auto least = sum_of<double>(panels, [](Panel panel) { return view_of(panel).least; });
  for (std::size_t i = 0; i < panels.size() && panels.size() > 1; ++i) {
    const double enough = view_of(panels[i]).enough;
    if (enough == 0 || room <= enough + least - view_of(panels[i]).least) continue;
    weights[i] = std::max(weights[i], enough / (room - enough) * (all - weights[i]));
  }
  return split(area, 1, weights, kPanelGap);
}

// A strip lies under all the others, as wide as they are together. The tallest of the group's, so
// that nothing above it moves when the strip grows. Cuts it from the area.
Box<2> cut_strip(const Staging& staging, Panel panel, Box<2>& area) {
  double strip = 0;
  for (const Frame* frame : staging.frames())
    strip = std::max(strip, view_of(panel).strip(*frame, area.size()));
  Box<2> box = area;
  box.lo.y = area.hi.y - strip;
  area.hi.y = box.lo.y - kStripGap;
  return box;
}

double world_width(const Frame& frame) {  // heights
  const Vec<3> size = frame.bounds.size();
  return size.x / std::max(size.y, size.z);
}

// A wide world and what happens in it over time, or the code of one side: one above the other, both
// get larger.
bool is_world_over_another(const Frame& frame) {
  constexpr double kWideWorld = 1.9;
  const bool over_time = frame.get<FrameChart>().over_time && shows(frame.panels, "chart");
  const bool of_side = !frame.get<FrameSide>().name.empty() && shows(frame.panels, "code");
  return frame.panels.size() == 2 && shows(frame.panels, "world") && (over_time || of_side) &&
         world_width(frame) > kWideWorld;
}

std::vector<Box<2>> over_another(const Frame& frame, const Box<2>& area) {
  constexpr double kShare = 0.56;  // of the height, for the world
  const double height = area.size().y, least = std::min(kLeastChart, 0.6 * height);
  double middle = area.hi.y - std::max((1 - kShare) * height, least + kPanelGap / 4);
  if (!shows(frame.panels, "chart"))  // code takes the height that the world does not need
    middle = std::min(middle, area.lo.y + area.size().x / world_width(frame) + kPanelGap);
  const Box<2> world{area.lo, {area.hi.x, middle - kPanelGap / 4}};
  const Box<2> other{{area.lo.x, middle + kPanelGap / 4}, area.hi};
  return is(frame.panels[0], "world") ? std::vector{world, other} : std::vector{other, world};
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
    return mapped(some, [&](std::size_t i) { return panels[i]; });
  };
  const std::vector<Box<2>> places = side_by_side(frame, panels_of(firsts), area);
  for (std::size_t c = 0; c < firsts.size(); ++c) boxes[firsts[c]] = places[c];
  if (shared.size() < 2) return boxes;
  const std::vector<Box<2>> cut = stacked(panels_of(shared), boxes[shared[0]]);
  for (std::size_t k = 0; k < cut.size(); ++k) boxes[shared[k]] = cut[k];
  return boxes;
}

// Two panels that know how large they get: of all ways to cut the area in two the one in which both
// are large.
std::vector<Box<2>> both_large(const std::vector<Panel>& panels, const Frame& frame,
                               const Staging& staging, const Box<2>& area) {
  constexpr double kLeastShare = 0.3, kMostShare = 0.7, kStep = 0.025;
  std::vector<Box<2>> best;
  double most = -1;
  // The world's share is tried from the least on.
  const bool first = view_of(panels[0]).width;
  for (const int axis : {0, 1})
    for (double share = kLeastShare; share < kMostShare + kStep / 2; share += kStep) {
      std::vector<Box<2>> cut =
          split(area, axis, {first ? share : 1 - share, first ? 1 - share : share}, kPanelGap);
      // Beside each other is what a hall is used to: one above the other must gain something.
      const double gain = view_of(panels[0]).size(frame, staging, cut[0]) *
                          view_of(panels[1]).size(frame, staging, cut[1]) * (axis == 0 ? 1.1 : 1.0);
      if (gain <= most + 1e-9) continue;
      most = gain;
      best = std::move(cut);
    }
  return best;
}

// All but strips.
std::vector<Box<2>> without_strips(const Frame& frame, const Staging& staging,
                                   const std::vector<Panel>& panels, const Box<2>& area) {
  if (panels.size() == 1) return {area};
  const auto knows_its_size = [](Panel panel) { return view_of(panel).size != nullptr; };
  return panels.size() == 2 && std::ranges::all_of(panels, knows_its_size)
             ? both_large(panels, frame, staging, area)
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

const PanelView& view_of(Panel panel) { return views().at(static_cast<std::size_t>(panel)); }

void add_panel(PanelEntry panel) {
  frame::add_panel(std::move(panel.kind), std::move(panel.run));
  views().push_back(std::move(panel.view));
}

bool panels_are_known() { return kAreKnown; }

void draw_panel(Panel panel, const Frame& frame, const Staging& staging, const Box<2>& box,
                DrawList& list, Labels& labels) {
  const PanelView& view = view_of(panel);
  const Box<2> place = shrunk(box, view.inset);
  const Vec<2> size = place.size();
  if (size.x < view.smallest.x || size.y < view.smallest.y) return void(++list.left_out);
  view.draw(frame, staging, place, list, labels);
}

std::vector<Box<2>> arranged(const Frame& frame, const Staging& staging, const Box<2>& area,
                             bool tall) {
  if (frame.panels.size() == 1) return {area};
  if (tall || std::ranges::all_of(frame.panels, is_strip)) return stacked(frame.panels, area);
  if (is_world_over_another(frame)) return over_another(frame, area);
  return staging.once<std::vector<Box<2>>>("panels", area,
                                           [&] { return over_strips(frame, staging, area); });
}

}  // namespace lantern::draw
