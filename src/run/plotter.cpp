#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/ranges.h>

#include "base/error.hpp"
#include "language/counts.hpp"
#include "run/shown.hpp"

namespace lantern::run {
namespace {

std::string before_dot(const std::string& name) { return name.substr(0, name.find('.')); }

// "energy" of "kinetic_energy" and "energy.bob".
std::string last_word(const std::string& name) {
  const std::string whole = before_dot(name);
  return whole.substr(whole.rfind('_') + 1);
}

std::string unit_of(const std::string& name) {
  const CountDoc* doc = find_in(known_body_measures(), before_dot(name));
  if (name.find('.') == std::string::npos) doc = find_count(name);
  return doc ? std::string(doc->unit) : "";
}

// f(name) if all agree on it, else nothing.
std::string agreed(const std::vector<std::string>& names, const auto& f) {
  const bool all = std::ranges::all_of(names, [&](const auto& n) { return f(n) == f(names[0]); });
  return all && !names.empty() ? f(names[0]) : "";
}

// "energy and angular_momentum": each once.
std::string list_of_kinds(const std::vector<std::string>& names) {
  std::vector<std::string> kinds;
  for (const std::string& name : names)
    if (std::ranges::find(kinds, before_dot(name)) == kinds.end())
      kinds.push_back(before_dot(name));
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    text += (i == 0 ? "" : i + 1 == kinds.size() ? " and " : ", ") + kinds[i];
  return text;
}

}  // namespace

std::optional<double> script_seconds(const Scenario& scenario, const std::string* only) {
  double seconds = 0;
  std::string part;
  for (const Step& step : scenario.steps) {
    if (!step.part.empty()) part = step.part;
    if (only && part != *only) continue;
    if (const auto* run = std::get_if<Run>(&step.verb)) seconds += run->seconds;
    if (std::holds_alternative<Wait>(step.verb)) return std::nullopt;
  }
  return seconds > 0 ? std::optional(seconds) : std::nullopt;
}

Plotter::Plotter(const Scenario& scenario) : scenario_(scenario), spec_(*scenario.chart) {
  chart_.x_name = spec_.x;
  chart_.over_time = spec_.over_time();
  chart_.logarithmic = spec_.logarithmic;
  chart_.least = spec_.least;
  chart_.most = spec_.most;
  if (over_time()) chart_.seconds = script_seconds(scenario, spec_.each_part ? &part_ : nullptr);
  if (scenario.sides.empty() && spec_.x.empty())
    chart_.y_name = spec_.y[0], chart_.y_unit = unit_of(spec_.y[0]);
  else if (!name_by_sides(scenario))
    name_series(scenario);
  chart_.pieces = spec_.labels.empty() ? spec_.pieces : spec_.labels;
  if (spec_.pieces.empty()) chart_.pieces.clear();
  if (!scenario.sides.empty() && !chart_.y_name.empty()) return;  // sides keep their names
  for (std::size_t i = 0; i < std::min(spec_.labels.size(), chart_.series.size()); ++i)
    chart_.series[i].label = spec_.labels[i];
}

// Where all lines tell the same of different sides, each has its side's name; so do bars.
bool Plotter::name_by_sides(const Scenario& scenario) {
  if (scenario.sides.empty()) return false;
  const auto after_dot = [](const std::string& name) { return name.substr(name.find('.') + 1); };
  const bool same = std::ranges::all_of(
      spec_.y, [&](const std::string& name) { return after_dot(name) == after_dot(spec_.y[0]); });
  if (same) chart_.y_name = after_dot(spec_.y[0]);
  if (same) chart_.y_unit = unit_of(chart_.y_name);
  if (!spec_.x.empty())
    for (const std::string& name : spec_.y)
      chart_.series.emplace_back().name = same ? before_dot(name) : name;
  return true;
}

// Of the side that the line is of.
std::optional<double> Plotter::x_of(const std::string& y, const Frame& frame) const {
  return frame.number(frame.sides.empty() ? spec_.x : before_dot(y) + "." + spec_.x);
}

// Where all lines tell the same of different bodies, each has its body's name and colour.
void Plotter::name_series(const Scenario& scenario) {
  const auto of_body = [&](const std::string& name) -> const BodySpec* {
    for (const BodyMeasureSpec& asked : scenario.body_measures)
      if (asked.name == name) return &scenario.bodies[asked.body];
    return nullptr;
  };
  std::set<int> colors;
  std::set<const BodySpec*> bodies;
  bool same = !spec_.y.empty();
  for (const std::string& name : spec_.y) {
    const BodySpec* body = of_body(name);
    same = same && body && before_dot(name) == before_dot(spec_.y[0]);
    if (body) colors.insert(body->color), bodies.insert(body);
  }
  // One hue a body, whatever is measured of it.
  const bool distinct = colors.size() == bodies.size();
  for (const std::string& name : spec_.y) {
    FrameSeries series;
    series.name = same ? of_body(name)->name : name;
    if (distinct && of_body(name)) series.color = of_body(name)->color;
    chart_.series.push_back(std::move(series));
  }
  chart_.y_name = same ? before_dot(spec_.y[0]) : spec_.y.size() == 1 ? spec_.y[0] : "";
  if (chart_.y_name.empty()) chart_.y_name = agreed(spec_.y, last_word);
  if (chart_.y_name.empty()) chart_.y_name = list_of_kinds(spec_.y);
  chart_.y_unit = agreed(spec_.y, unit_of);
  chart_.x_unit = unit_of(spec_.x);
  // On an axis of several units each line says its own.
  for (std::size_t i = 0; i < spec_.y.size() && chart_.y_unit.empty(); ++i)
    if (const std::string unit = unit_of(spec_.y[i]); !unit.empty())
      chart_.series[i].name += " (" + unit + ")";
}

void Plotter::begin_part(const std::string& part, double time) {
  if (!spec_.each_part || part == part_) return;
  part_ = part;
  if (!over_time()) {
    if (!chart_.bars.empty()) ++chart_.part;
    chart_.bars.clear();
    return;
  }
  begun_ = time;
  chart_.seconds = script_seconds(scenario_, &part_);
  for (FrameSeries& series : chart_.series) series.points.clear();
}

void Plotter::add(const std::string& label, const std::string& part, const Frame& frame) {
  if (!chart_.bars.empty() && part != part_) ++group_;
  begin_part(part, 0);
  part_ = part;
  if (spec_.x.empty()) {
    for (std::size_t i = 0; i < spec_.y.size(); ++i) {
      const auto y = frame.number(spec_.y[i]);
      if (!y) continue;
      const std::string side = frame.sides.empty() ? "" : before_dot(spec_.y[i]);
      chart_.bars.push_back(
          {side.empty() ? label : label + ", " + side, *y, group_, static_cast<int>(i)});
      add_pieces(side.empty() ? "" : side + ".", frame);
    }
    return;
  }
  for (std::size_t i = 0; i < chart_.series.size(); ++i)
    if (const auto x = x_of(spec_.y[i], frame), y = frame.number(spec_.y[i]); x && y)
      chart_.series[i].points.push_back({*x, *y});
}

// Of the newest bar.
void Plotter::add_pieces(const std::string& side, const Frame& frame) {
  FrameBar& bar = chart_.bars.back();
  double sum = 0;
  for (const std::string& name : spec_.pieces) {
    bar.pieces.push_back(frame.number(side + name).value_or(0));
    sum += bar.pieces.back();
  }
  if (!spec_.pieces.empty() && std::abs(sum - bar.value) > 1e-9 * std::abs(bar.value))
    throw Refused("chart: the pieces {} make {}, but {} is {}", fmt::join(spec_.pieces, ", "), sum,
                  spec_.y[static_cast<std::size_t>(bar.line)], bar.value);
}

void Plotter::add_moment(const Frame& frame) {
  for (std::size_t i = 0; i < chart_.series.size(); ++i) {
    std::vector<Vec<2>>& points = chart_.series[i].points;
    const auto y = frame.number(spec_.y[i]);
    if (!y) continue;
    const Frame* side = frame.side_named(before_dot(spec_.y[i]));
    const Vec<2> point{(side ? side->time : frame.time) - begun_, *y};
    if (points.empty() || points.back() != point) points.push_back(point);
  }
}

}  // namespace lantern::run
