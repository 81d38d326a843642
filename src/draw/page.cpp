#include "draw/page.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "draw/font.hpp"
#include "draw/labels.hpp"
#include "draw/legend.hpp"
#include "draw/notes.hpp"
#include "draw/panels.hpp"
#include "draw/sides_view.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeast3D = 0.95,
                 kMost3D = 1.35;  // aspects of a 3D world's panel
constexpr double kTop = 104;      // of the panels
constexpr double kTopWithoutTitle = 34;
constexpr double kTitleLine = 58;  // baseline
constexpr double kPanelGap = 44;
constexpr double kOverFooter = 26;    // under the panels
constexpr double kLeastForTwo = 460;  // height of a column with two panels
constexpr double kLeastChart = 300;   // height: a flatter one shows no course
constexpr double kStripGap = 30;      // over the strip of an array
constexpr double kMostEnlarged = 1.45;
constexpr double kStackBelow = 1.2;  // aspect of a page whose panels stand one above the other

void add_rule(DrawList& list, double y, double margin) {
  list.crisp_line({margin, y}, {list.page.x - margin, y}, {Role::rule, 1.6});
}

// "step 4 of 9" from the right, each number in cells for as many digits as the last step has.
// Gives the left end.
double draw_step(const Frame& frame, const Box<2>& band, Labels& labels) {
  if (frame.steps == 0) return band.hi.x;
  const TextStyle style{21, Weight::regular, Role::quiet_ink};
  const auto digits = static_cast<std::int64_t>(std::to_string(frame.steps).size());
  const double number = Labels::number_width(digits, style);
  const double space = text_width(" ", style);
  double x = band.hi.x;
  for (const auto& [word, count] : {std::pair{"of", std::int64_t{frame.steps}},
                                    std::pair{"step", frame.step + std::int64_t{1}}}) {
    labels.add_number(count, {x, kTitleLine}, style, band);
    x -= number + space;
    labels.add(word, {{x, kTitleLine}, 1}, style, band);
    x -= text_width(word, style) + space;
  }
  return x + space;
}

void draw_title(const Frame& frame, double margin, DrawList& list, Labels& labels) {
  const Box<2> band{{margin, 20}, {list.page.x - margin, 76}};
  const double right = draw_step(frame, band, labels) - 36;
  const TextStyle bold{26, Weight::semibold, Role::ink};
  const TextStyle quiet{24, Weight::regular, Role::quiet_ink};
  const std::string title = shortened(frame.title, right - margin, bold);
  labels.add(title, {{margin, kTitleLine}, 0}, bold, band);
  const double end = margin + text_width(title, bold) + 11;
  if (!frame.part.empty())
    labels.add(shortened("·  " + frame.part, right - end, quiet), {{end, kTitleLine}, 0}, quiet,
               band);
  add_rule(list, 78, margin);
}

// Width that a panel would take at this height if it could choose; 0 takes what is left.
double wanted_width(const Frame& frame, Panel panel, double height) {
  if (panel == Panel::atlas) return atlas_width(frame, height);
  if (panel != Panel::world) return 0;
  if (frame.dimension == 3) {
    // Seen from aside, what is wide or deep takes width.
    const Vec<3> size = frame.bounds.size();
    const double aspect = size.y > 0 ? std::max(size.x, size.z) / size.y : 1;
    return height * std::clamp(aspect, kLeast3D, kMost3D);
  }
  const Vec<2> size = frame.bounds.size();
  return size.y > 0 ? height * size.x / size.y : height;
}

bool takes_the_rest(Panel panel) { return panel != Panel::world && panel != Panel::atlas; }

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
  if (panel == Panel::tree || panel == Panel::ledger) return 1.1;
  if (panel == Panel::memory) return 0.6;
  if (panel == Panel::pool) return 0.4;
  return panel == Panel::bytes || panel == Panel::sparkline ? 0.28 : 1.0;
}

bool is_strip(Panel panel) {
  return panel == Panel::memory || panel == Panel::pool || panel == Panel::bytes ||
         panel == Panel::sparkline;
}

// A tree needs rows, so it gets somewhat more height than the others; strips get little.
std::vector<Box<2>> stacked(const std::vector<Panel>& panels, const Box<2>& area) {
  std::vector<double> weights;
  for (const Panel panel : panels) weights.push_back(weight_of(panel));
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double room = area.size().y - kPanelGap * (static_cast<double>(panels.size()) - 1);
  const double others = 260 * (static_cast<double>(panels.size()) - 1);  // that they need
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
  if (panel == Panel::pool) return std::min(pool_height(frame, room.x), 0.46 * room.y);
  return std::clamp(memory_height(frame, room.x), 0.2 * room.y, 0.46 * room.y);
}

// A strip lies under all the others, as wide as they are together. Cuts it from the area.
Box<2> cut_strip(const Frame& frame, Panel panel, Box<2>& area) {
  const double strip = strip_height(frame, panel, area.size());
  Box<2> box = area;
  box.lo.y = area.hi.y - strip;
  area.hi.y = box.lo.y - kStripGap;
  return box;
}

// A wide world and what happens in it over time: one above the other, both get larger.
bool wants_stack(const Frame& frame) {
  constexpr double kWideWorld = 1.9;  // aspect of a world
  if (!frame.chart.over_time || frame.panels.size() != 2) return false;
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

// On a wide page. What takes the rest of the width stands in one column beside the world, so that
// nothing gets narrow.
std::vector<Box<2>> arranged(const Frame& frame, Box<2> area) {
  const std::vector<Panel>& panels = frame.panels;
  std::vector<Box<2>> boxes(panels.size());
  const bool only_strips = std::ranges::all_of(panels, is_strip);
  if (only_strips) return stacked(panels, area);
  for (std::size_t i = panels.size(); i-- > 0;)
    if (is_strip(panels[i])) boxes[i] = cut_strip(frame, panels[i], area);
  const bool shares =
      area.size().y >= kLeastForTwo && !std::ranges::all_of(panels, [](Panel panel) {
        return takes_the_rest(panel) || is_strip(panel);
      });
  // The first panel of each column, and all of the column of those that take the rest.
  std::vector<std::size_t> firsts, shared;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (is_strip(panels[i])) continue;
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

void draw_panels(const Frame& frame, const Box<2>& area, DrawList& list, Labels& labels,
                 Work& work) {
  if (frame.panels.empty()) return;
  if (!frame.sides.empty())
    return draw_sides(frame, area,
                      {{area.lo.x, area.hi.y + kOverFooter}, {area.hi.x, list.page.y - 12}}, list,
                      labels, [&](const Frame& side, const Box<2>& place) {
                        draw_panels(side, place, list, labels, work);
                        draw_notes(side, place, list, labels);
                        labels.forget_places();  // the next side has bodies of the same names
                      });
  const Vec<2> whole = frame.side.empty() ? list.page : area.size();
  const bool tall = whole.x / whole.y < kStackBelow;
  const std::vector<Box<2>> boxes = tall                 ? stacked(frame.panels, area)
                                    : wants_stack(frame) ? over_its_chart(frame, area)
                                                         : arranged(frame, area);
  using Draw = void (*)(const Frame&, const Box<2>&, DrawList&, Labels&);
  constexpr Draw kDraw[] = {draw_world,  draw_tree, draw_atlas, draw_chart,    draw_memory,
                            draw_ledger, draw_pool, draw_bytes, draw_sparkline};  // by Panel
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Panel panel = frame.panels[i];
    work.world_layouts += panel == Panel::world;
    work.tree_layouts += panel == Panel::tree;
    kDraw[static_cast<std::size_t>(panel)](frame, boxes[i], list, labels);
  }
}

bool has_foot(const Frame& frame) { return frame.display.caption || frame.display.counters; }

// A strip at the area's lower end for the marks that the panels are going to draw: they are drawn
// once to see which. Cuts it from the area.
Box<2> cut_legend(const Frame& frame, const DrawList& page, Box<2>& area) {
  constexpr double kAboveLegend = 14;
  Box<2> strip = area;
  strip.lo.y = area.hi.y;
  if (!frame.display.legend) return strip;
  double height = 0;
  for (int i = 0; i < 2; ++i) {  // the second time with the strip cut off
    DrawList trial;
    trial.page = page.page;
    Labels labels(trial);
    Work work;
    Box<2> rest = area;
    if (height > 0) rest.hi.y -= height + kAboveLegend;
    draw_panels(frame, rest, trial, labels, work);
    height = std::max(height, legend_height(trial.marks, area.size().x));
  }
  if (height == 0) return strip;
  strip.lo.y = area.hi.y - height;
  area.hi.y = strip.lo.y - kAboveLegend;
  return strip;
}

}  // namespace

Vec<2> page_for(int width, int height) {
  const double pixels = std::min(width / 1600.0, height / 900.0);  // a unit
  return {width / pixels, height / pixels};
}

// The layout is made for a page about 900 units high and then scaled, so that type keeps its part
// of the page's height on squarer pages. On tall ones that would leave too little width for the
// panels, so it stops at kMostEnlarged.
DrawList draw_frame(const Frame& frame, const Vec<2>& page, Work& work) {
  const double k = std::clamp(page.y / 900, 1.0, kMostEnlarged);
  DrawList list;
  list.page = page / k;
  Labels labels(list);
  const double margin = list.page.x < 1000 ? 40 : 60;
  const bool notes = !frame.notes.empty() || std::ranges::any_of(frame.sides, [](const Frame& f) {
    return !f.notes.empty();
  });
  if (notes) labels.expect_notes();
  double bottom = 0;
  {
    const DrawList::Scope words(list, "page/words");
    if (frame.display.title) draw_title(frame, margin, list, labels);
    bottom = draw_footer(frame, margin, list, labels);
    if (has_foot(frame)) add_rule(list, bottom, margin);
  }
  Box<2> area{{margin, frame.display.title ? kTop : kTopWithoutTitle},
              {list.page.x - margin, bottom - (has_foot(frame) ? kOverFooter : 14)}};
  const Box<2> strip = cut_legend(frame, list, area);
  draw_panels(frame, area, list, labels, work);
  if (frame.display.legend) draw_legend(list.marks, strip, list, labels);
  if (frame.sides.empty())
    draw_notes(frame, {area.lo - Vec<2>(margin - 20, 12), {list.page.x - 20, bottom - 6}}, list,
               labels);
  list.page = page;
  if (k == 1) return list;
  const auto enlarge = [&](double& measure) { measure *= k; };
  for (DrawShape& shape : list.shapes)
    std::visit([&](auto& s) { for_each_measure(s, enlarge); }, shape);
  for (LabelBox& label : list.labels)
    for (Box<2>* box : {&label.box, &label.panel}) *box = {box->lo * k, box->hi * k};
  return list;
}

}  // namespace lantern::draw
