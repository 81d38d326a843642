#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/random.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/panels.hpp"

namespace lantern::draw::samples {
namespace {

Frame alone(Panel panel, std::string title) {
  Frame frame;
  frame.scenario = "sample";
  frame.title = std::move(title);
  frame.step = 3;
  frame.steps = 9;
  frame.panels = {panel};
  return frame;
}

FrameChart growth(bool logarithmic, int points) {
  FrameChart chart;
  chart.x_name = "bodies";
  chart.y_name = "pairs to test";
  chart.logarithmic = logarithmic;
  chart.series = {{"brute force", {}}, {"quadtree", {}}, {"sort and sweep", {}}};
  for (int i = 1; i <= points; ++i) {
    const double n = logarithmic ? 10.0 * std::round(std::pow(1.6, i)) : 50.0 * i;
    chart.series[0].points.push_back({n, n * (n - 1) / 2});
    chart.series[1].points.push_back({n, std::round(n * std::log(n) * 0.6)});
    chart.series[2].points.push_back({n, std::round(0.05 * std::pow(n, 1.55))});
  }
  return chart;
}

Frame chart_of(std::string title, FrameChart chart) {
  Frame frame = alone(panel_named("chart"), std::move(title));
  frame.add<FrameChart>() = std::move(chart);
  frame.caption = "The work of testing every pair grows with the square of the bodies.";
  return frame;
}

FrameChart bars(bool logarithmic) {
  FrameChart chart;
  chart.y_name = "pairs to test";
  chart.logarithmic = logarithmic;
  chart.bars = {{"brute force", 499500, 0},
                {"quadtree", 3120, 0},
                {"BSP", 5311, 0},
                {"kD-tree", 2890, 0},
                {"sort and sweep", 20533, 0}};
  return chart;
}

FrameChart grouped() {
  FrameChart chart;
  chart.y_name = "calls for memory";
  for (int group = 0; group < 3; ++group)
    for (const char* name : {"a list a leaf", "one array"})
      chart.bars.push_back({name, name[0] == 'o' ? 1.0 : 12.0 + 9 * group, group});
  return chart;
}

FrameChart many_series() {
  FrameChart chart;
  chart.x_name = "step";
  chart.y_name = "kinetic energy, joule";
  for (int s = 0; s < 15; ++s) {
    chart.series.push_back({fmt::format("integrator number {} of them", s), {}});
    for (int i = 0; i < 3000; ++i)
      chart.series.back().points.push_back({double(i), std::sin(0.01 * i) * s + 0.3 * s});
  }
  return chart;
}

FrameChart extreme() {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  FrameChart chart;
  chart.series = {{"huge", {{0, 1e300}, {1e308, -1e308}, {1, 3}}},
                  {"", {{-1, 0}}},
                  {"none", {}},
                  {"broken", {{std::nan(""), 1}, {1, kInf}, {2, 2}}}};
  return chart;
}

FrameChart one_series(std::vector<Vec<2>> points) {
  FrameChart chart;
  chart.x_name = "seconds";
  chart.y_name = "total energy, J";
  chart.series = {{"total energy", std::move(points)}};
  return chart;
}

// The leaves of a quadtree in one array, each with some slots to spare.
void store_in_array(Frame& frame, std::uint32_t spare, std::uint32_t behind) {
  std::uint32_t at = 0;
  std::int64_t used = 0;
  for (FrameNode& node : frame.nodes) {
    if (!node.leaf || node.bodies.empty()) continue;
    node.first = at;
    node.room = static_cast<std::uint32_t>(node.bodies.size()) + spare;
    at += node.room;
    used += static_cast<std::int64_t>(node.bodies.size());
  }
  frame.add<FrameStructure>().array_size = at + behind;
  frame.counts.emplace_back("allocations", 1);
  frame.panels = {panel_named("world"), panel_named("tree"), panel_named("memory")};
}

Frame memory_only(std::uint32_t slots) {
  Frame frame = alone(panel_named("memory"), "An array");
  frame.add<FrameStructure>().array_size = slots;
  return frame;
}

}  // namespace

Named charts() {
  Named frames;
  frames.emplace_back("chart_lines", chart_of("Growth", growth(false, 12)));
  frames.emplace_back("chart_log", chart_of("Growth, logarithmic", growth(true, 14)));
  frames.emplace_back("chart_bars", chart_of("Five ways", bars(false)));
  frames.emplace_back("chart_barslog", chart_of("Five ways, logarithmic", bars(true)));
  frames.emplace_back("chart_grouped", chart_of("Calls for memory", grouped()));
  frames.emplace_back("chart_none", chart_of("Nothing yet", {}));
  frames.emplace_back("chart_one", chart_of("One point", one_series({{2, 17.25}})));
  frames.emplace_back("chart_flat", chart_of("Kept", one_series({{0, 40}, {1, 40}, {2, 40}})));
  frames.emplace_back("chart_drift",
                      chart_of("Drift", one_series({{0, 40}, {1, 40.001}, {2, 40.0035}})));
  frames.emplace_back("chart_zero", chart_of("Zero", one_series({{0, 0}, {1, 0}})));
  frames.emplace_back("chart_many", chart_of("Many lines", many_series()));
  frames.emplace_back("chart_extreme", chart_of("Extremes", extreme()));
  FrameChart log_extreme = extreme();
  log_extreme.logarithmic = true;
  frames.emplace_back("chart_logextreme", chart_of("Extremes", log_extreme));
  FrameChart odd_bars = bars(true);
  odd_bars.bars.push_back({"zero", 0, 1});
  odd_bars.bars.push_back({"negative", -5, 1});
  odd_bars.bars.push_back({"huge", 1e200, 2});
  odd_bars.bars.push_back({"broken", std::nan(""), 2});
  odd_bars.bars.push_back({std::string(80, 'n'), 12345678, 2});
  frames.emplace_back("chart_oddbarslog", chart_of("Odd bars", odd_bars));
  odd_bars.logarithmic = false;
  frames.emplace_back("chart_oddbars", chart_of("Odd bars", odd_bars));
  FrameChart hundred;
  for (int i = 0; i < 100; ++i) hundred.bars.push_back({fmt::format("step {}", i), i * 1.5, i / 4});
  frames.emplace_back("chart_hundred", chart_of("A hundred bars", hundred));
  Frame beside = crowd(60, 1.4);
  beside.add<FrameChart>() = growth(true, 9);
  beside.panels = {panel_named("world"), panel_named("chart")};
  frames.emplace_back("chart_beside", beside);
  beside.panels = {panel_named("world"), panel_named("tree"), panel_named("chart")};
  frames.emplace_back("chart_under", beside);
  store_in_array(beside, 1, 8);
  beside.panels = {panel_named("world"), panel_named("tree"), panel_named("chart"),
                   panel_named("memory")};
  frames.emplace_back("chart_all", beside);
  return frames;
}

Named memories() {
  Named frames;
  Frame few = ghosts(4);
  store_in_array(few, 2, 6);
  frames.emplace_back("memory_ghosts", few);
  few.panels = {panel_named("world"), panel_named("memory")};
  frames.emplace_back("memory_beside", few);
  few.panels = {panel_named("memory")};
  frames.emplace_back("memory_alone", few);
  Frame more = crowd(60, 1.4);
  store_in_array(more, 1, 12);
  frames.emplace_back("memory_crowd", more);
  Frame many = crowd(900, 0.6);
  store_in_array(many, 1, 0);
  many.add<FrameStructure>().array_size = 10000;
  frames.emplace_back("memory_many", many);
  many.panels = {panel_named("memory")};
  frames.emplace_back("memory_manyalone", many);
  for (const std::uint32_t slots : {0u, 1u, 24u, 10000u, 4000000000u})
    frames.emplace_back(fmt::format("memory{}", slots), memory_only(slots));
  Frame wrong = memory_only(4);  // a leaf that reaches beyond the array
  FrameNode node;
  node.first = 3;
  node.room = 4000000000u;
  node.bodies = {7, 8, 9};
  node.label = "root";
  wrong.nodes.push_back(node);
  frames.emplace_back("memory_beyond", wrong);
  return frames;
}

}  // namespace lantern::draw::samples
