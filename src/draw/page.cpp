#include "draw/page.hpp"

#include <algorithm>
#include <cmath>

#include "draw/arrangement.hpp"
#include "draw/font.hpp"
#include "draw/labels.hpp"
#include "draw/legend.hpp"
#include "draw/notes.hpp"
#include "draw/panel.hpp"
#include "draw/panels.hpp"
#include "draw/sides_view.hpp"

namespace lantern::draw {
namespace {

constexpr double kTop = 90;  // of the panels
constexpr double kTopWithoutTitle = 30;
constexpr double kTitleLine = 52;  // baseline
constexpr double kTitleRule = 70;  // under it
constexpr double kOverFooter = 20;
constexpr double kMostEnlarged = 1.45;
constexpr double kStackBelow = 1.2;  // aspect of a page whose panels stand one above the other

void add_rule(DrawList& list, double y, double margin) {
  list.crisp_line({margin, y}, {list.page.x - margin, y}, {Role::rule, 1.6});
}

// "step 4 of 9" from the right, each number in cells for as many digits as the last step has.
// Gives the left end.
double draw_step(const Frame& frame, const Box<2>& band, Labels& labels) {
  if (frame.steps == 0) return band.hi.x;
  const TextStyle style{kLabel, Weight::regular, Role::quiet_ink};
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
  const Box<2> band{{margin, 16}, {list.page.x - margin, kTitleRule - 2}};
  const double right = draw_step(frame, band, labels) - 36;
  const TextStyle bold{26, Weight::semibold, Role::ink};
  const TextStyle quiet{24, Weight::regular, Role::quiet_ink};
  const std::string title = shortened(frame.title, right - margin, bold);
  labels.add(title, {{margin, kTitleLine}, 0}, bold, band);
  const double end = margin + text_width(title, bold) + 11;
  if (!frame.part.empty())
    labels.add(shortened("·  " + frame.part, right - end, quiet), {{end, kTitleLine}, 0}, quiet,
               band);
  add_rule(list, kTitleRule, margin);
}

// `arranged_for`: with what the panels' places are chosen; of a side it is that of all sides.
void draw_panels(const Frame& frame, const Staging& staging, const Staging& arranged_for,
                 const Box<2>& area, DrawList& list, Labels& labels, Work& work) {
  if (frame.panels.empty()) return;
  if (!frame.sides.empty())
    return draw_sides(frame, staging, area,
                      {{area.lo.x, area.hi.y + kOverFooter}, {area.hi.x, list.page.y - 12}}, list,
                      labels, [&](const Frame& side, const Box<2>& place) {
                        draw_panels(side, staging.of_side(side.get<FrameSide>().name),
                                    staging.largest_side(), place, list, labels, work);
                        draw_notes(side, place, list, labels);
                        labels.forget_places();  // the next side has bodies of the same names
                      });
  const Vec<2> whole = frame.get<FrameSide>().name.empty() ? list.page : area.size();
  const bool tall = whole.x / whole.y < kStackBelow;
  const std::vector<Box<2>> boxes = arranged(frame, arranged_for, area, tall);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    work.world_layouts += is(frame.panels[i], "world");
    work.tree_layouts += is(frame.panels[i], "tree");
    view_of(frame.panels[i]).draw(frame, staging, boxes[i], list, labels);
  }
}

bool has_foot(const Frame& frame) { return frame.display.caption || frame.display.counters; }

// A strip at the area's lower end for the marks that the panels are going to draw: they are drawn
// once to see which. Cuts it from the area.
Box<2> cut_legend(const Frame& frame, const Staging& staging, const DrawList& page, Box<2>& area) {
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
    draw_panels(frame, staging, staging, rest, trial, labels, work);
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
DrawList draw_frame(const Frame& frame, const Staging& staging, const Vec<2>& page, Work& work) {
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
  const Box<2> strip = cut_legend(frame, staging, list, area);
  draw_panels(frame, staging, staging, area, list, labels, work);
  if (frame.display.legend) draw_legend(list.marks, strip, list, labels);
  if (frame.sides.empty())
    draw_notes(frame, {area.lo - Vec<2>(margin - 20, 12), {list.page.x - 20, bottom - 6}}, list,
               labels);
  list.page = page;
  if (k == 1) return list;
  const auto enlarge = [&](double& measure) { measure *= k; };
  for (DrawShape& shape : list.shapes)
    std::visit([&](auto& s) { for_each_measure(s, enlarge); }, shape);
  for (WorldMap& map : list.maps) {
    map.picture = {map.picture.lo * k, map.picture.hi * k};
    map.origin *= k;
    map.scale *= k;
  }
  for (LabelBox& label : list.labels)
    for (Box<2>* box : {&label.box, &label.panel}) *box = {box->lo * k, box->hi * k};
  return list;
}

DrawList draw_frame(const Frame& frame, const Vec<2>& page, Work& work) {
  return draw_frame(frame, Staging(frame), page, work);
}

}  // namespace lantern::draw
