#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/axis.hpp"
#include "draw/layout_check.hpp"
#include "draw/number_text.hpp"
#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/panels.hpp"

namespace lantern::draw {
namespace {

using samples::page_of;

Frame charted(FrameChart chart) {
  Frame frame;
  frame.panels = {panel_named("chart")};
  frame.add<FrameChart>() = std::move(chart);
  return frame;
}

TEST(NumberText, ThousandsStandApart) {
  EXPECT_EQ(number_text(1234567), "1\u2009234\u2009567");
  EXPECT_EQ(number_text(9999), "9999") << "four figures are one group";
  EXPECT_EQ(number_text(-12345), "−12\u2009345");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(-0.0), "0") << "there is no minus nothing";
  EXPECT_EQ(number_text(0.25, 2), "0.25");
  EXPECT_EQ(number_text(2.5, 4), "2.5") << "zeros at the end say nothing";
  EXPECT_EQ(number_text(1.2e15), "1.2·10¹⁵");
  EXPECT_EQ(number_text(1e300), "10³⁰⁰");
  EXPECT_EQ(number_text(-1e150), "−10¹⁵⁰");
  EXPECT_EQ(number_text(std::nan("")), "–");
  EXPECT_EQ(short_number(17.25), "17.2");
  EXPECT_EQ(short_number(40.0035), "40");
  EXPECT_EQ(short_number(0.0123456), "0.0123");
}

TEST(NumberText, ABodyIsCalledByItsLabel) {
  Frame frame;
  FrameBody& body = frame.bodies.emplace_back();
  body.name = "kaefer", body.label = "Käfer";
  EXPECT_EQ(count_words(frame, "speed.kaefer", 2), "speed: Käfer");
  EXPECT_EQ(count_words(frame, "speed.other", 2), "speed: other");
  EXPECT_EQ(count_words(frame, "pairs", 1), "candidate pair");
}

TEST(Axis, LinearOneHoldsItsValuesAndHasFewTicks) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    double a = random.between(-1, 1) * std::pow(10, random.between(-12, 12));
    double b = random.between(-1, 1) * std::pow(10, random.between(-12, 12));
    if (a > b) std::swap(a, b);
    const int most = static_cast<int>(random.whole(2, 10));
    const Axis axis = Axis::linear(a, b, most);
    ASSERT_GE(axis.ticks().size(), 2u) << a << " to " << b;
    EXPECT_LE(axis.ticks().size(), static_cast<std::size_t>(most) + 2) << a << " to " << b;
    EXPECT_LE(axis.ticks().front().value, a + 1e-9 * std::abs(a)) << a << " to " << b;
    EXPECT_GE(axis.ticks().back().value, b - 1e-9 * std::abs(b)) << a << " to " << b;
    EXPECT_LE(axis.share(a), axis.share(b));
    for (const Axis::Tick& tick : axis.ticks()) EXPECT_TRUE(std::isfinite(tick.value));
  }
}

TEST(Axis, TicksOfOneAxisReadDifferently) {
  for (const double high : {1.0, 7.0, 0.03, 1234.0, 2.5e6, 40.004}) {
    const Axis axis = Axis::linear(high > 40 && high < 41 ? 40 : 0, high, 6);
    for (std::size_t i = 1; i < axis.ticks().size(); ++i)
      EXPECT_NE(axis.ticks()[i].text, axis.ticks()[i - 1].text) << "up to " << high;
  }
}

TEST(Axis, LogarithmicOneSpansWholeDecades) {
  const Axis axis = Axis::logarithmic(20, 52000, 9);
  ASSERT_EQ(axis.ticks().size(), 5u);
  EXPECT_EQ(axis.ticks().front().text, "10");
  EXPECT_EQ(axis.ticks().back().text, "100\u2009000");
  EXPECT_NEAR(axis.share(1000), 0.5, 1e-12);
  EXPECT_EQ(axis.share(0), 0) << "what has no logarithm lies at the lower end";
  EXPECT_EQ(axis.share(-3), 0);
  EXPECT_LE(Axis::logarithmic(1e-150, 1e150, 5).ticks().size(), 7u);
}

TEST(Axis, OneValueGetsARangeAllTheSame) {
  for (const double value : {0.0, 5.0, -5.0, 1e300, -1e300}) {
    const Axis axis = Axis::linear(value, value, 5);
    const double share = axis.share(value);
    EXPECT_TRUE(share >= 0 && share <= 1) << value;
    EXPECT_GE(axis.ticks().size(), 2u) << value;
  }
}

TEST(Chart, SaysTheNewestNumberOfEachLine) {
  FrameChart chart;
  chart.x_name = "bodies";
  chart.y_name = "pairs";
  chart.series = {{"brute force", {{10, 45}, {1000, 499500}}},
                  {"quadtree", {{10, 9}, {1000, 312}}}};
  for (const bool logarithmic : {false, true}) {
    chart.logarithmic = logarithmic;
    const DrawList list = page_of(charted(chart));
    for (const char* text : {"pairs", "brute force", "quadtree", "499\u2009500", "312"})
      EXPECT_TRUE(says(list, text)) << text << " is missing";
  }
}

TEST(Chart, ASmallDriftIsNotRoundedAway) {
  FrameChart chart;
  chart.series = {{"energy", {{0, 40}, {1, 40.0035}}}};
  EXPECT_TRUE(says(page_of(charted(chart)), "40.0035"));
}

// A line that grows tenfold with each second, and one that shrinks.
FrameChart diverging() {
  FrameChart chart;
  chart.x_name = "time";
  chart.y_name = "energy";
  chart.y_unit = "J";
  chart.over_time = true;
  chart.logarithmic = true;
  chart.seconds = 30;
  chart.least = 0.01;
  chart.most = 1000;
  chart.series = {{"grows", {}, 1}, {"shrinks", {}, 4}, {"stays", {}, 5}};
  double grown = 1, shrunk = 1;
  for (int i = 0; i < 20; ++i, grown *= 10, shrunk /= 10) {
    chart.series[0].points.push_back({double(i), grown});
    chart.series[1].points.push_back({double(i), shrunk});
    chart.series[2].points.push_back({double(i), 1.0});
  }
  return chart;
}

TEST(Chart, LinesThatDivergeLeaveThePictureAtItsEdge) {
  const DrawList list = page_of(charted(diverging()));
  const RectShape* ground = nullptr;
  for (const DrawShape& shape : list.shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape); rect && rect->fill == Role::panel)
      ground = rect;
  ASSERT_TRUE(ground) << "a chart has a ground";
  const Box<2> room{ground->box.lo - Vec<2>(3, 3), ground->box.hi + Vec<2>(3, 3)};
  double highest = 1e9, lowest = 0, longest = 0;
  for (const DrawShape& shape : list.shapes) {
    const auto* line = std::get_if<LineShape>(&shape);
    if (!line || line->stroke.role < Role::body_1 || line->stroke.role > Role::body_8) continue;
    for (const Vec<2>& end : {line->from, line->to})
      EXPECT_TRUE(overlap(room, Box<2>{end, end})) << end.x << ", " << end.y;
    if (line->stroke.role == body_role(1)) highest = std::min(highest, line->to.y);
    if (line->stroke.role == body_role(4)) lowest = std::max(lowest, line->to.y);
    if (line->stroke.role == body_role(5)) longest = std::max(longest, line->to.x);
  }
  EXPECT_NEAR(highest, ground->box.lo.y, 3) << "it leaves at the top";
  EXPECT_NEAR(lowest, ground->box.hi.y, 3) << "and at the bottom";
  const double share = (longest - ground->box.lo.x) / ground->box.size().x;
  EXPECT_NEAR(share, 19.0 / 30, 0.01) << "time is linear, and its axis is as long as the run";
  for (const char* text : {"0.01", "1000", "time, s", "energy, J  (logarithmic)", "grows", "30"})
    EXPECT_TRUE(says(list, text)) << text << " is missing";
}

TEST(Axis, CutEndsKeepOnlyTheTicksBetween) {
  const Axis axis = Axis::linear(0, 4.6, 6).cut_to(0, 4.6);
  EXPECT_EQ(axis.ticks().back().text, "4");
  EXPECT_EQ(axis.place(4.6), 1);
  EXPECT_EQ(axis.place(9.2), 2) << "beyond its end";
  EXPECT_EQ(axis.share(9.2), 1);
  const Axis logarithmic = Axis::logarithmic(1e-9, 1e9, 6).cut_to(0.1, 100);
  EXPECT_NEAR(logarithmic.place(1), 1.0 / 3, 1e-12);
}

TEST(Chart, NamesOfLinesThatEndTogetherAreMovedApart) {
  FrameChart chart;
  for (int i = 0; i < 9; ++i)
    chart.series.push_back({"line " + std::to_string(i), {{0, 0}, {1, 5.0 + 0.001 * i}}});
  const DrawList list = page_of(charted(chart));
  for (const FrameSeries& series : chart.series)
    EXPECT_TRUE(says(list, series.name)) << series.name << " has no name";
}

TEST(Chart, EveryBarHasItsNameAndNumber) {
  for (const auto& [name, frame] : samples::charts()) {
    if (name != "chart_bars" && name != "chart_barslog" && name != "chart_grouped") continue;
    const DrawList list = page_of(frame);
    for (const FrameBar& bar : frame.get<FrameChart>().bars) {
      EXPECT_TRUE(says(list, bar.label)) << name << ": " << bar.label;
      EXPECT_TRUE(says(list, number_text(bar.value))) << name << ": " << bar.value;
    }
  }
}

TEST(Chart, BarsAreAsLongAsTheirNumbers) {
  FrameChart chart;
  chart.bars = {{"one", 100, 0}, {"two", 200, 0}, {"none", 0, 0}};
  std::vector<double> lengths;
  for (const DrawShape& shape : page_of(charted(chart)).shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape);
        rect && rect->fill >= Role::body_1 && rect->fill <= Role::body_8)
      lengths.push_back(rect->box.size().x);
  ASSERT_EQ(lengths.size(), 2u) << "a bar of 0 has no length";
  EXPECT_NEAR(lengths[1], 2 * lengths[0], 1e-9);
}

// A logarithmic axis begins anywhere: there a length would say nothing.
TEST(Chart, OnALogarithmicAxisBarsAreDots) {
  FrameChart chart;
  chart.logarithmic = true;
  chart.bars = {{"one", 10, 0}, {"two", 1000, 0}, {"none", 0, 0}};
  std::vector<Box<2>> dots;
  for (const DrawShape& shape : page_of(charted(chart)).shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape);
        rect && rect->fill >= Role::body_1 && rect->fill <= Role::body_8)
      dots.push_back(rect->box);
  ASSERT_EQ(dots.size(), 2u) << "nothing stands where 0 has no place";
  for (const Box<2>& dot : dots) EXPECT_NEAR(dot.size().x, dot.size().y, 1e-9);
  EXPECT_GT(dots[1].lo.x, dots[0].hi.x);
}

TEST(Chart, OfBarsThatAreToComeHasNoAxes) {
  FrameChart chart;
  chart.y_name = "pairs";
  const DrawList list = page_of(charted(chart));
  EXPECT_TRUE(says(list, "candidate pairs"));
  for (const LabelBox& label : list.labels) EXPECT_NE(label.text, "0") << "a tick of nothing";
}

// Ticks and their places, as the labels left of the picture.
std::vector<std::pair<std::string, double>> ticks_of(const DrawList& list, double left_of) {
  std::vector<std::pair<std::string, double>> ticks;
  for (const LabelBox& label : list.labels)
    if (label.box.hi.x < left_of && label.box.lo.y < 700)
      ticks.emplace_back(label.text, label.box.lo.y);
  return ticks;
}

TEST(Chart, AxesOfASequenceStandStill) {
  FrameChart chart;
  chart.y_name = "pairs";
  chart.over_time = true;
  chart.seconds = 4;
  chart.series = {{"pairs", {{0, 3}}}};
  Frame first = charted(chart);
  chart.series[0].points.push_back({4, 900});
  Frame last = charted(chart);
  last.add<FrameTrace>().points = {{0, 3}, {4, 900}};
  AxisRanges ranges;
  for (const Frame& frame : {first, last}) ranges.see(frame);
  const auto ticks = [&](const Frame& frame) {
    return ticks_of(samples::page_of(frame, ranges), 150);
  };
  EXPECT_EQ(ticks(first), ticks(last));
  EXPECT_EQ(ranges.trace(), 900);
  EXPECT_EQ(ranges.seconds_of(first.part), 4);
}

TEST(Chart, NamesStandAtTheirLinesEnds) {
  FrameChart chart;
  chart.over_time = true;
  chart.seconds = 10;
  chart.series = {{"early", {{0, 1}, {2, 8}}}, {"late", {{0, 1}, {2, 2}}}};
  const DrawList list = page_of(charted(chart));
  double longest = 0;
  for (const DrawShape& shape : list.shapes)
    if (const auto* line = std::get_if<LineShape>(&shape);
        line && line->stroke.role >= Role::body_1 && line->stroke.role <= Role::body_8)
      longest = std::max(longest, line->to.x);
  for (const LabelBox& label : list.labels)
    if (label.text == "early" || label.text == "late") {
      EXPECT_LT(label.box.lo.x, longest + 90) << label.text << ": a leader would cross the plot";
      EXPECT_GE(label.box.size().y, 20);
    }
}

TEST(Chart, WhatHasNoRoomIsSaid) {
  FrameChart chart;
  for (int i = 0; i < 100; ++i) chart.bars.push_back({"bar " + std::to_string(i), 1.0 * i, 0});
  const DrawList list = page_of(charted(chart));
  EXPECT_TRUE(std::any_of(list.labels.begin(), list.labels.end(), [](const LabelBox& label) {
    return label.text.starts_with("and ") && label.text.ends_with(" more");
  }));
}

TEST(Chart, NeitherTheLargestBarNorTheNewestIsLeftOut) {
  FrameChart chart;
  for (int i = 0; i < 100; ++i)
    chart.bars.push_back({"bar " + std::to_string(i), i == 60 ? 12345.0 : 1.0 + i, i / 20});
  const DrawList list = page_of(charted(chart));
  for (const char* name : {"bar 0", "bar 60", "bar 99"}) EXPECT_TRUE(says(list, name)) << name;
}

// A chart alone on a panel of that size.
DrawList chart_in(const FrameChart& chart, const Vec<2>& size) {
  DrawList list;
  list.page = {1600, 900};
  Labels labels(list);
  const Frame frame = charted(chart);
  draw_panel(frame.panels[0], frame, Staging(frame), {{40, 40}, Vec<2>{40, 40} + size}, list,
             labels);
  return list;
}

TEST(Chart, RowsAndGapsShrinkBeforeABarIsLeftOut) {
  FrameChart chart;
  chart.y_name = "nodes";
  for (int i = 0; i < 6; ++i) chart.bars.push_back({"limit " + std::to_string(i), 1.0 + i, i / 3});
  const DrawList list = chart_in(chart, {500, 236});
  for (const FrameBar& bar : chart.bars) EXPECT_TRUE(says(list, bar.label)) << bar.label;
  expect_laid_out(list, {{0, 0}, {1600, 900}}, 0, "six bars");
}

std::set<Role> hues_of(const FrameChart& chart) {
  std::set<Role> hues;
  for (const DrawShape& shape : page_of(charted(chart)).shapes)
    if (const auto* rect = std::get_if<RectShape>(&shape);
        rect && rect->fill >= Role::body_1 && rect->fill <= Role::body_8)
      hues.insert(rect->fill);
  return hues;
}

TEST(Chart, BarsOfOneQuantityHaveOneHueAndStructuresTheirOwn) {
  FrameChart chart;
  chart.bars = {{"limit 2", 9, 0}, {"limit 4", 29, 0}, {"parted", 5, 1}};
  EXPECT_EQ(hues_of(chart).size(), 1u);
  chart.bars = {{"one", 9, 0, 0}, {"other", 29, 0, 1}};
  EXPECT_EQ(hues_of(chart).size(), 2u) << "of two sides";
  chart.bars = {{"quadtree", 9, 0}};
  const std::set<Role> alone = hues_of(chart);
  chart.bars = {{"kd_tree", 9, 0}, {"quadtree", 8, 0}};
  const std::set<Role> both = hues_of(chart);
  EXPECT_EQ(both.size(), 2u);
  EXPECT_TRUE(both.contains(*alone.begin())) << "beside others, too";
}

TEST(Chart, ThreeNamesFitALowPanel) {
  FrameChart chart;
  chart.y_name = "penetration";
  chart.over_time = true;
  chart.seconds = 10;
  chart.series = {{"ten sweeps", {{0, 0}, {10, 0}}},
                  {"thousand sweeps", {{0, 0}, {10, 0}}},
                  {"all at once", {{0, 0}, {10, 0.7}}}};
  const DrawList list = chart_in(chart, {1500, 190});
  for (const FrameSeries& series : chart.series)
    EXPECT_TRUE(says(list, series.name)) << series.name << " has no name";
  EXPECT_FALSE(says_part(list, " more"));
  expect_laid_out(list, {{0, 0}, {1600, 900}}, 0, "three lines");
}

TEST(Chart, ALongLineKeepsItsPeaks) {
  FrameChart chart;
  chart.series = {{"energy", {}}};
  for (int i = 0; i < 20000; ++i)
    chart.series[0].points.push_back({1.0 * i, i == 7777 ? 9.0 : 1.0});
  double highest = 1e9, lowest = 0;
  for (const DrawShape& shape : page_of(charted(chart)).shapes)
    if (const auto* line = std::get_if<LineShape>(&shape);
        line && line->stroke.role >= Role::body_1 && line->stroke.role <= Role::body_8) {
      highest = std::min({highest, line->from.y, line->to.y});
      lowest = std::max({lowest, line->from.y, line->to.y});
    }
  EXPECT_GT(lowest - highest, 200) << "the one high point was thinned out";
}

}  // namespace
}  // namespace lantern::draw
