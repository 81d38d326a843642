#include "draw/plot.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/axis.hpp"
#include "draw/layout_check.hpp"
#include "draw/number_text.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

// Where a mark of that colour is, filled or open.
std::optional<Vec<2>> place_of(const DrawShape& shape, Role role) {
  if (const auto* rect = std::get_if<RectShape>(&shape))
    if (rect->fill == role || rect->stroke.role == role) return rect->box.center();
  const auto* polygon = std::get_if<PolygonShape>(&shape);
  if (!polygon || (polygon->fill != role && polygon->stroke.role != role)) return std::nullopt;
  Vec<2> middle(0.0);
  for (const Vec<2>& p : polygon->points) middle += p / static_cast<double>(polygon->points.size());
  return middle;
}

DrawList drawn(const Plot& plot, const Box<2>& panel = {{0, 0}, {800, 500}}) {
  DrawList list;
  Labels labels(list);
  draw_plot(plot, panel, list, labels);
  return list;
}

// Lines that fall as powers, with some runs that diverged.
Plot random_plot(Random& random) {
  Plot plot;
  plot.title = random.unit() < 0.5 ? "Error against time" : "";
  plot.x_name = random.unit() < 0.7 ? "seconds" : "";
  plot.y_name = random.unit() < 0.7 ? "error (relative)" : "";
  plot.log_x = random.unit() < 0.8;
  plot.log_y = random.unit() < 0.8;
  plot.names = static_cast<PlotNames>(random.whole(0, 2));
  const std::int64_t series = random.whole(0, 14);
  for (std::int64_t s = 0; s < series; ++s) {
    PlotSeries line;
    line.name = fmt::format("contestant {}{}", s, s % 3 == 0 ? " with a rather long name" : "");
    line.look = static_cast<int>(random.whole(0, 60));
    line.is_peer = random.unit() < 0.3;
    const double order = random.between(0, 5), x0 = std::pow(10, random.between(-7, 2));
    const std::int64_t points = random.whole(0, 10);
    for (std::int64_t i = 0; i < points; ++i) {
      PlotPoint p;
      p.at = {x0 * std::pow(2, double(i)), std::pow(2, -order * double(i)) * random.unit()};
      p.beyond = i < 3 && random.unit() < 0.3;
      if (random.unit() < 0.03) p.at[static_cast<int>(random.whole(0, 1))] = kNan;
      if (random.unit() < 0.03) p.at.y = 0;
      if (random.unit() < 0.02) p.at.y = kInfinity;
      if (random.unit() < 0.1) p.note = "note";
      line.points.push_back(p);
    }
    plot.series.push_back(std::move(line));
  }
  if (random.unit() < 0.7) plot.guides.push_back({"floor", {{1e-8, 1e-15}, {1e8, 1e-13}}});
  if (random.unit() < 0.3) plot.guides.push_back({"limit", {{0.01, 1e-30}, {0.01, 1e30}}});
  for (const int order : {1, 2, 4})
    if (random.unit() < 0.6) plot.slopes.push_back({fmt::format("h{}", order), -1.0 * order});
  double x = 1e-6, y = 1;
  for (std::int64_t i = random.whole(0, 8); i > 0; --i)
    plot.front.push_back({x *= random.between(1, 9), y *= random.unit()});
  return plot;
}

TEST(Plot, LabelsAndShapesNeverLeaveTheirPlaceOrCoverEachOther) {
  Random random(11);
  for (int i = 0; i < 600; ++i) {
    Plot plot = random_plot(random);
    plot.size = random.between(17.1, 22);
    const Box<2> panel{{7, 9}, {7 + random.between(240, 900), 9 + random.between(180, 600)}};
    expect_laid_out(drawn(plot, panel), panel, 0.91 * plot.size,
                    fmt::format("random plot {} of {} x {}", i, panel.size().x, panel.size().y));
    if (HasFailure()) return;
  }
}

TEST(Plot, EveryNameIsThere) {
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    Plot plot = random_plot(random);
    plot.names = i % 2 ? PlotNames::ends : PlotNames::legend;
    for (PlotSeries& s : plot.series) s.points = {{{1.0, 1.0}, false, ""}, {{2, 0.5}, false, ""}};
    const DrawList list = drawn(plot, {{0, 0}, {1200, 600}});
    for (const PlotSeries& s : plot.series)
      EXPECT_TRUE(says(list, s.name)) << s.name << " has no name in plot " << i;
  }
}

TEST(Plot, NamesStandAtTheEndsWhereThereIsRoom) {
  Plot plot;
  for (int s = 0; s < 3; ++s)
    plot.series.push_back({fmt::format("line {}", s),
                           {{{1, 1}, false, ""}, {{100, std::pow(10, -3.0 * s)}, false, ""}},
                           s});
  const DrawList list = drawn(plot, {{0, 0}, {800, 500}});
  for (const PlotSeries& s : plot.series) {
    const auto found = std::find_if(list.labels.begin(), list.labels.end(),
                                    [&](const LabelBox& l) { return l.text == s.name; });
    ASSERT_NE(found, list.labels.end());
    EXPECT_LT(found->box.hi.y, 480) << s.name << " went to a legend though its end was free";
  }
}

TEST(Plot, WhiskersReachFromTheLeastToTheMostAndStayInside) {
  Plot plot;
  plot.log_x = false;
  PlotPoint point{{2, 0.1}, false, ""};
  point.spread = Box<2>{{1, 1e-3}, {4, 10}};
  plot.series.push_back({"line", {point, {{3, 1}, false, ""}}, 0});
  const auto reach = [](const DrawList& list, int axis) {
    double most = 0;
    for (const DrawShape& shape : list.shapes)
      if (const auto* line = std::get_if<LineShape>(&shape);
          line && line->stroke.role == plot_role(0) && line->from[1 - axis] == line->to[1 - axis])
        most = std::max(most, std::abs(line->to[axis] - line->from[axis]));
    return most;
  };
  const DrawList with = drawn(plot);
  EXPECT_GT(reach(with, 0), 200);
  EXPECT_GT(reach(with, 1), 200);
  expect_laid_out(with, {{0, 0}, {800, 500}}, 0.91 * plot.size, "whiskers");
  // Along x nothing to draw and nothing to break; along y a logarithm has no 0.
  plot.series[0].points[0].spread = Box<2>{{kNan, 0}, {kInfinity, 1e-3}};
  expect_laid_out(drawn(plot), {{0, 0}, {800, 500}}, 0.91 * plot.size, "whiskers without an end");
  plot.series[0].points[0].spread = std::nullopt;
  EXPECT_EQ(reach(drawn(plot), 0), 0);
}

TEST(Plot, WhatIsNotFiniteIsLeftOut) {
  Plot plot;
  plot.names = PlotNames::none;
  plot.series = {{"a",
                  {{{1, 1}, false, ""},
                   {{kNan, 1}, false, ""},
                   {{2, kInfinity}, false, ""},
                   {{-1, 1}, false, ""},
                   {{10, 0.1}, false, ""}},
                  0}};
  std::size_t marks = 0;
  for (const DrawShape& shape : drawn(plot).shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape)) marks += rect->fill == plot_role(0);
  EXPECT_EQ(marks, 2u) << "NaN, infinity and, on a logarithmic axis, -1 are no places";
}

TEST(Plot, DivergedRunsAreOpenMarksAtTheUpperEdge) {
  Plot plot;
  plot.names = PlotNames::none;
  plot.series = {{"a", {{{1, kNan}, true, ""}, {{2, 1}, false, ""}, {{4, 0.1}, false, ""}}, 0}};
  const DrawList list = drawn(plot);
  double highest = 1e9, open = 1e9;
  for (const DrawShape& shape : list.shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape)) {
      const double y = rect->box.center().y;
      if (rect->fill == plot_role(0)) highest = std::min(highest, y);
      if (rect->stroke.role == plot_role(0)) open = std::min(open, y);
    }
  EXPECT_LT(open, highest - 10) << "no open mark stands above all others";
  EXPECT_TRUE(says(list, "diverged"));
  plot.series[0].points[0].beyond = false;
  EXPECT_FALSE(says(drawn(plot), "diverged")) << "a strip for nothing";
}

TEST(Plot, AnErrorOfZeroHasItsOwnPlaceBelowTheScale) {
  Plot plot;
  plot.names = PlotNames::none;
  plot.series = {{"a", {{{1, 1e-3}, false, ""}, {{2, 1e-15}, false, ""}, {{4, 0}, false, ""}}, 0}};
  plot.front = {{1, 1e-3}, {2, 1e-15}, {4, 0}};
  const DrawList list = drawn(plot);
  std::vector<double> heights;
  for (const DrawShape& shape : list.shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape); rect && rect->fill == plot_role(0))
      heights.push_back(rect->box.center().y);
  ASSERT_EQ(heights.size(), 3u);
  EXPECT_GT(heights[2], heights[1] + 10) << "0 cannot be told from 1e-15";
  EXPECT_TRUE(says(list, "0"));
  plot.series[0].points.pop_back();
  EXPECT_FALSE(says(drawn(plot), "0"));
}

TEST(Plot, NoErrorOfZeroHidesAnother) {
  Plot plot;
  plot.names = PlotNames::none;
  for (int s = 0; s < 3; ++s)
    plot.series.push_back({fmt::format("{}", s), {{{1, 0}, false, ""}, {{9, 1}, false, ""}}, s});
  std::set<double> heights;
  for (const DrawShape& shape : drawn(plot).shapes)
    for (int s = 0; s < 3; ++s) {
      const auto at = place_of(shape, plot_role(s));
      if (at && at->x < 400) heights.insert(at->y);
    }
  EXPECT_EQ(heights.size(), 3u) << "marks of three series lie on one another";
}

Plot banded_plot() {
  Plot plot;
  plot.bands = {{"exact", 0, 0}, {"off by 1", 1, 1}, {"off by 2 to 9", 2, 9}};
  plot.series = {{"a", {{{1, 0}, false, ""}, {{10, 0}, false, ""}}, 0},
                 {"b", {{{1, 0}, false, ""}, {{20, 5}, false, "5"}}, 1},
                 {"c", {{{2, kNan}, true, ""}, {{3, 0.5}, false, ""}}, 2}};
  return plot;
}

TEST(BandedPlot, HasALaneForEachSeriesInEachBand) {
  const DrawList list = drawn(banded_plot());
  for (const char* text : {"exact", "off by 2 to 9", "diverged", "a", "b", "c", "5"})
    EXPECT_TRUE(says(list, text)) << text;
  EXPECT_FALSE(says(list, "off by 1")) << "nothing is in it";
  std::map<std::string, double> height;  // of names
  for (const LabelBox& label : list.labels) height[label.text] = label.box.center().y;
  EXPECT_LT(height["diverged"], height["off by 2 to 9"]);
  EXPECT_LT(height["off by 2 to 9"], height["exact"]) << "what is right is at the lower edge";
  std::size_t marks = 0;
  for (const DrawShape& shape : list.shapes)
    for (int s = 0; s < 3; ++s) marks += place_of(shape, plot_role(s)).has_value();
  EXPECT_EQ(marks, 5u) << "every point has a mark but 0.5, which is in no band";
  expect_laid_out(list, {{0, 0}, {800, 500}}, 17, "bands");
}

TEST(BandedPlot, IsLaidOutAtAnySize) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Plot plot = random_plot(random);
    plot.bands = banded_plot().bands;
    for (PlotSeries& s : plot.series)
      for (PlotPoint& p : s.points)
        if (random.unit() < 0.8) p.at.y = static_cast<double>(random.whole(0, 9));
    plot.size = random.between(17.1, 22);
    const Box<2> panel{{7, 9}, {7 + random.between(240, 900), 9 + random.between(180, 600)}};
    expect_laid_out(drawn(plot, panel), panel, 0.91 * plot.size,
                    fmt::format("banded plot {} of {} x {}", i, panel.size().x, panel.size().y));
    if (HasFailure()) return;
  }
}

TEST(Plot, NoMarkHidesAnotherOfTheSamePlace) {
  Plot plot;
  plot.names = PlotNames::none;
  for (int s = 0; s < 2; ++s)
    plot.series.push_back({"a", {{{1, 1}, false, ""}, {{100, s ? 1e-3 : 1e-2}, false, ""}}, 6});
  std::vector<double> sizes;
  for (const DrawShape& shape : drawn(plot).shapes)
    if (place_of(shape, plot_role(6))) sizes.push_back(reach_of(shape).size().x);
  ASSERT_EQ(sizes.size(), 4u);
  EXPECT_GT(sizes[0], 1.2 * sizes[2]) << "the first mark is under the third and cannot be seen";
  EXPECT_EQ(sizes[1], sizes[3]) << "marks by themselves are of one size";
}

TEST(Plot, AnEmptyOneSaysSo) {
  Plot plot;
  plot.empty = "no run was timed";
  EXPECT_TRUE(says(drawn(plot), "no run was timed"));
  plot.series = {{"a", {{{kNan, 1}, false, ""}}, 0}};
  EXPECT_TRUE(says(drawn(plot), "no run was timed"));
}

TEST(Plot, OnlyDivergedRunsAreAPlotToo) {
  Plot plot;
  plot.series = {{"a", {{{1, kNan}, true, ""}, {{2, kNan}, true, ""}}, 0}};
  const DrawList list = drawn(plot);
  EXPECT_TRUE(says(list, "a"));
  expect_laid_out(list, {{0, 0}, {800, 500}}, 17, "only diverged");
}

TEST(Plot, PeersAreDashed) {
  for (const bool peer : {false, true}) {
    Plot plot;
    plot.names = PlotNames::none;
    plot.series = {{"a", {{{1, 1}, false, ""}, {{10, 0.1}, false, ""}}, 0, peer}};
    for (const DrawShape& shape : drawn(plot).shapes)
      if (const auto* line = std::get_if<LineShape>(&shape);
          line && line->stroke.role == plot_role(0)) {
        EXPECT_EQ(line->stroke.dash > 0, peer);
      }
  }
}

TEST(FittedAxis, LogarithmicTicksArePowersOfTenOrPartsWithinTheAxis) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double least = std::pow(10, random.between(-20, 10));
    const double most = least * std::pow(10, random.between(0, 18));
    const int ticks = static_cast<int>(random.whole(2, 10));
    const Axis scale = Axis::fitted(least, most, ticks);
    ASSERT_GE(scale.ticks().size(), 2u) << least << " to " << most;
    EXPECT_LE(scale.ticks().size(), static_cast<std::size_t>(std::max(4, ticks)));
    EXPECT_GE(scale.place(least), 0);
    EXPECT_LE(scale.place(most), 1);
    int powers = 0;
    for (const Axis::Tick& tick : scale.ticks()) {
      const double power = std::floor(std::log10(tick.value) + 1e-9);
      const double part = tick.value / std::pow(10, power);
      const bool is_power = std::abs(part - 1) < 1e-9;
      powers += is_power;
      EXPECT_TRUE(is_power || std::abs(part - 2) < 1e-9 || std::abs(part - 5) < 1e-9) << tick.value;
      if (is_power) {
        EXPECT_EQ(tick.text, power_of_ten(static_cast<int>(std::lround(power))));
      }
      EXPECT_GE(scale.place(tick.value), -1e-9) << least << " to " << most;
      EXPECT_LE(scale.place(tick.value), 1 + 1e-9) << least << " to " << most;
    }
    if (powers > 1) {
      EXPECT_EQ(static_cast<std::size_t>(powers), scale.ticks().size())
          << "parts are only for axes with fewer than two powers of ten";
    }
  }
  const Axis parts = Axis::fitted(1.5e-3, 8e-3, 8);
  ASSERT_EQ(parts.ticks().size(), 2u);
  EXPECT_EQ(parts.ticks()[0].text, "2·10⁻³");
  EXPECT_NEAR(parts.place(1.5e-3), 0.09, 0.04) << "the axis is much longer than its values need";
  EXPECT_EQ(power_of_ten(-12), "10⁻¹²");
  EXPECT_EQ(power_of_ten(0), "1");
  EXPECT_EQ(power_of_ten(1), "10");
}

TEST(FittedAxis, WhatHasNoLogarithmIsAtTheLowerEnd) {
  const Axis scale = Axis::fitted(1e-6, 1, 6);
  EXPECT_EQ(scale.place(0), 0);
  EXPECT_EQ(scale.place(-3), 0);
}

TEST(PlotMarks, LooksAreUnlike) {
  std::set<std::string> seen;
  for (int look = 0; look < 56; ++look) {
    DrawList list;
    draw_plot_mark({look}, {0, 0}, 10, false, list);
    std::string text = fmt::format("{}", static_cast<int>(plot_role(look)));
    for (const DrawShape& shape : list.shapes)
      if (const auto* polygon = std::get_if<PolygonShape>(&shape))
        for (const Vec<2>& p : polygon->points) text += fmt::format(" {:.3f} {:.3f}", p.x, p.y);
    EXPECT_TRUE(seen.insert(text).second) << "look " << look << " is that of another";
  }
}

TEST(PlotLegend, WhatHasNoRoomIsSaid) {
  std::vector<LegendEntry> entries;
  for (int i = 0; i < 30; ++i) entries.push_back({fmt::format("contestant {}", i), i, false});
  DrawList list;
  Labels labels(list);
  const Box<2> place{{0, 0}, {400, 120}};
  draw_plot_legend(entries, place, 19, list, labels);
  expect_laid_out(list, place, 17, "a crowded legend");
  std::size_t named = 0;
  for (const LabelBox& label : list.labels) named += label.text.starts_with("contestant");
  EXPECT_TRUE(says(list, fmt::format("and {} more", 30 - named)));
}

TEST(PlotLegend, TakesTheHeightItSays) {
  std::vector<LegendEntry> entries;
  for (int i = 0; i < 17; ++i) entries.push_back({fmt::format("contestant {}", i), i, i > 9});
  for (const double width : {100.0, 300.0, 900.0, 1500.0}) {
    const double height = plot_legend_height(entries, width, 18);
    DrawList list;
    Labels labels(list);
    draw_plot_legend(entries, {{0, 0}, {width, height}}, 18, list, labels);
    expect_laid_out(list, {{0, 0}, {width, height}}, 17, fmt::format("legend {} wide", width));
    if (width > 200) {
      EXPECT_EQ(list.labels.size(), entries.size()) << "names are missing at " << width;
    }
  }
}

}  // namespace
}  // namespace lantern::draw
