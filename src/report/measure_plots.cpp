

#include "report/document.hpp"
#include "report/problem_rows.hpp"
#include "run/event_text.hpp"

namespace lantern::report {
namespace {

constexpr const char* kSeconds = "processor seconds of a run: median, its 95 % interval";
constexpr double kNearOrder = 0.25;  // an order of 3.4 is no h³
constexpr double kFarOff = 1e3;      // errors beyond are at the edge, or the others would be a line

PlotPoint point_of(const Row& row, double cost) {
  const auto error = row.error();
  PlotPoint point;
  point.beyond = !error || !std::isfinite(*error);
  point.at = {cost, point.beyond ? 0 : *error};
  if (cost == seconds_of(row))
    point.spread = Box<2>{{row.processor.low, point.at.y}, {row.processor.high, point.at.y}};
  return point;
}

// "error: state (“traj”), against: closed form", with the unit of what is not relative.
std::string error_words(const ProblemRows& problem) {
  const std::string norm = main_norm(problem);
  std::string words = norm.empty() ? "error" : "error: " + norm_words(norm);
  if (!norm.empty() && norm_words(norm) != norm) words += " (“" + norm + "”)";
  const auto with_norm = std::ranges::find_if(
      problem.rows, [](const Row& row) { return !row.norms.empty() && row.norms[0].unit != "1"; });
  if (with_norm != problem.rows.end()) words += ", " + with_norm->norms[0].unit;
  for (const Row& row : problem.rows)
    if (!row.reference.empty())
      return words + ", against: " + row.reference.substr(0, row.reference.find(';'));
  return words;
}

// Whether a count of work is the same for all runs that have it, so that nothing is to be seen.
bool is_one_count(const ProblemRows& problem, const WorkCount& work) {
  std::set<double> counts;
  for (const Row& row : problem.rows)
    if (const auto count = work.of(row)) counts.insert(*count);
  return counts.size() == 1;
}

// Far-off values go to the upper edge too, if there are others.
void send_far_ones_off(Plot& plot) {
  const auto far = [](const PlotPoint& p) { return p.at.y > kFarOff; };
  bool any_near = false, any_far = false;
  for (const PlotSeries& s : plot.series)
    for (const PlotPoint& p : s.points)
      if (!p.beyond) (far(p) ? any_far : any_near) = true;
  if (!any_near || !any_far) return;
  for (PlotSeries& s : plot.series)
    for (PlotPoint& p : s.points) p.beyond = p.beyond || far(p);
  plot.beyond += ", or beyond 1000";
}

// What a step costs, the middle of all rows: turns a floor by steps into one by cost.
std::optional<double> cost_of_step(std::span<const Row> rows, const Cost& cost) {
  std::vector<double> ratios;
  for (const Row& row : rows)
    if (const auto price = cost(row); price && !row.is_peer() && row.counted.steps > 0)
      ratios.push_back(*price / static_cast<double>(row.counted.steps));
  if (ratios.empty()) return std::nullopt;
  std::ranges::sort(ratios);
  return ratios[ratios.size() / 2];
}

void add_floor(const ProblemRows& problem, const Cost& cost, double least, double most,
               Plot& plot) {
  const auto per_step = cost_of_step(problem.rows, cost);
  if (!per_step || *per_step <= 0) return;
  PlotGuide guide{"rounding, as a random walk", {}};
  for (const double x : {least, most}) guide.points.push_back({x, rounding_floor(x / *per_step)});
  plot.guides.push_back(std::move(guide));
}

// A slope for each order that was seen: work goes as 1 / h.
void add_slopes(const std::set<int>& orders, Plot& plot) {
  constexpr const char* kPowers[] = {"h", "h²", "h³", "h⁴", "h⁵", "h⁶"};
  for (const int order : orders) plot.slopes.push_back({kPowers[order - 1], -1.0 * order});
}

// What the strip at the edge is called: by how runs failed.
std::string failure_words(const ProblemRows& problem) {
  const auto any = [&](Status status) {
    return std::ranges::find(problem.rows, status, &Row::status) != problem.rows.end();
  };
  if (!any(Status::collapsed)) return "diverged";
  return any(Status::diverged) || any(Status::nan) ? "diverged or collapsed" : "collapsed";
}

Plot left_plot(const ProblemRows& problem, const Looks& looks) {
  Plot plot = cost_plot(problem, seconds_of, looks, true);
  plot.title = "Error against time";
  plot.x_name = kSeconds;
  plot.y_name = error_words(problem);
  plot.empty = "no run was timed";
  return plot;
}

Plot right_plot(const ProblemRows& problem, const Looks& looks) {
  const WorkCount work = work_count(problem);
  Plot plot;
  if (is_one_count(problem, work)) {  // nothing to be seen: what does the step do?
    plot = step_plot(
        problem, [](const Row& row) { return row.error(); }, looks);
    send_far_ones_off(plot);
    plot.title = "Error against step";
    plot.empty = "no run has an error";
  } else {
    plot = cost_plot(
        problem, [&](const Row& row) { return work.of(row); }, looks, true);
    plot.title = "Error against " + work.name;
    plot.x_name = work.name + " in the whole run";
    plot.empty = "no work was counted";
    const auto tells_none = [](const PlotSeries& s) { return s.is_peer && s.points.empty(); };
    if (std::ranges::any_of(plot.series, tells_none)) plot.x_name += " (not told by peers)";
  }
  plot.y_name = error_words(problem);
  return plot;
}

// Nothing if no run of a fixed step has samples.
std::optional<double> shared_step(const ProblemRows& problem) {
  std::map<double, std::size_t> runs;  // of each step
  for (const Row& row : problem.rows)
    if (!row.samples.empty() && !is_adaptive(row.method)) ++runs[row.step];
  const auto most = std::ranges::max_element(
      runs, {}, [](const auto& entry) { return std::pair(entry.second, -entry.first); });
  return most == runs.end() ? std::nullopt : std::optional(most->first);
}

// The value of a sample; nothing for one that has none.
using SampleValue = std::optional<double> (*)(const DriftSample&);
constexpr SampleValue kError = [](const DriftSample& s) { return std::optional(s.error); };
constexpr SampleValue kEnergy = [](const DriftSample& s) { return s.energy; };

Plot drift_plot(const ProblemRows& problem, const Looks& looks, double step, SampleValue value) {
  Plot plot;
  plot.x_name = fmt::format("seconds since the start, in steps of {} s", figure(step));
  for (const MethodRows& method : by_method(problem)) {
    PlotSeries& series = plot.series.emplace_back(series_of(method, looks));
    const auto row = std::ranges::find(method.rows, step, &Row::step);
    if (row == method.rows.end() || is_adaptive(method.method)) continue;
    for (const DriftSample& sample : row->samples)
      if (const auto y = value(sample)) {
        PlotPoint point{{sample.time, *y}};
        point.beyond = !std::isfinite(*y);
        series.points.push_back(point);
      }
  }
  send_far_ones_off(plot);
  return plot;
}

}  // namespace

std::pair<Plot, Plot> plots_of(const ProblemRows& problem, const Looks& looks) {
  if (!has_whole_errors(problem)) return {left_plot(problem, looks), right_plot(problem, looks)};
  const WorkCount work = work_count(problem);
  const bool timed =
      std::ranges::any_of(problem.rows, [](const Row& row) { return seconds_of(row).has_value(); });
  const Cost cost = timed ? Cost(seconds_of) : [&](const Row& row) { return work.of(row); };
  const std::string cost_name = timed ? kSeconds : work.name + " in the whole run";
  Plot outcome = cost_plot(problem, cost, looks, false), price = step_plot(problem, cost, looks);
  outcome.names = PlotNames::ends;
  outcome.title = timed ? "Outcome against time" : "Outcome against " + work.name;
  outcome.x_name = cost_name;
  outcome.y_name = error_words(problem);
  price.title = timed ? "Time against step" : capitalised(work.name) + " against step";
  price.y_name = cost_name + "; open marks: a wrong outcome";
  outcome.empty = price.empty = "no run has a cost";
  return {outcome, price};
}

// "_stiff" and what follows it stands behind a comma.
std::string problem_words(const ProblemRows& problem) {
  std::string words = problem.problem;
  const std::size_t variant = words.find("_" + problem.variant);
  if (!problem.variant.empty() && variant != std::string::npos) words.replace(variant, 1, ", ");
  std::ranges::replace(words, '_', ' ');
  return capitalised(words);
}

std::string file_name(const ProblemRows& problem) {
  const std::string& path = problem.rows.empty() ? problem.problem : problem.rows.front().file;
  const std::string name = path.substr(path.rfind('/') + 1);
  return name.empty() ? problem.problem + ".toml" : name;
}

Plot cost_plot(const ProblemRows& problem, const Cost& cost, const Looks& looks, bool with_orders) {
  Plot plot;
  plot.beyond = failure_words(problem);
  std::set<int> orders;
  double least = 1e300, most = 0;
  std::map<std::string, std::string> twins;  // to the first method with the same errors
  for (const std::vector<std::string>& group : equal_methods(problem))
    for (std::size_t i = 1; i < group.size(); ++i) twins[group[i]] = group[0];
  for (const MethodRows& c : by_method(problem)) {
    PlotSeries series = series_of(c, looks);
    for (const Row& row : c.rows)
      if (const auto price = cost(row); price && row.status != Status::refused) {
        series.points.push_back(point_of(row, *price));
        least = std::min(least, *price);
        most = std::max(most, *price);
      }
    const auto& order = c.order;
    const auto twin = twins.find(c.method);
    if (with_orders && twin != twins.end())
      series.name += ": errors equal those of " + method_words(twin->second);
    else if (with_orders && order)
      series.name += ": order " + order->words();
    if (order) {
      const int nearest = static_cast<int>(std::lround(order->exponent));
      const bool is_near = std::abs(order->exponent - nearest) <= kNearOrder;
      if (!c.is_peer && is_near && nearest >= 1 && nearest <= 6 && !series.points.empty())
        orders.insert(nearest);
    }
    plot.series.push_back(std::move(series));
    const auto end = c.floor ? cost(c.rows[c.floor->last]) : std::nullopt;
    if (end)
      plot.guides.push_back({plot.guides.empty() ? "scatters below" : "",
                             {{*end, c.floor->largest}, {4 * *end, c.floor->largest}}});
  }
  const auto reference = greatest_of<double>(0, problem.rows, &Row::reference_error);
  if (reference > kRounding && most > 0)
    plot.guides.push_back({"the reference's own error", {{least, reference}, {most, reference}}});
  const bool whole = has_whole_errors(problem);
  if (!whole) send_far_ones_off(plot);
  add_slopes(orders, plot);
  if (most > 0) add_floor(problem, cost, least, most, plot);
  plot.front = pareto_front(problem, cost);
  plot.front_name = "front, borne out";
  if (whole) put_into_bands(plot);
  return plot;
}

// --- where error against work says little: what is right or wrong, and work that does not depend
// on the step ---

void put_into_bands(Plot& plot) {
  double most = 0;
  for (PlotSeries& series : plot.series)
    for (PlotPoint& p : series.points) {
      if (p.beyond) continue;
      most = std::max(most, p.at.y);
      if (p.at.y > 1) p.note = figure(p.at.y);
    }
  plot.bands = {{"exact", 0, 0}, {"off by 1", 1, 1}};
  for (double from = 2, to = 9; from <= most && to < 1e3; from = to + 1, to = 10 * to + 9)
    plot.bands.push_back({fmt::format("off by {} to {}", from, to), from, to});
  if (most >= 1e3) plot.bands.push_back({"off by 1000 or more", 1e3, most});
  plot.guides.clear();
  plot.slopes.clear();
  plot.front_name = "cheapest";
}

PlotSeries series_of(const MethodRows& method, const Looks& looks) {
  return {method.name(), {}, looks.at(method.method), method.is_peer};
}

Plot step_plot(const ProblemRows& problem, const Cost& value, const Looks& looks) {
  Plot plot;
  const bool whole = has_whole_errors(problem);
  for (const MethodRows& c : by_method(problem)) {
    PlotSeries series = series_of(c, looks);
    for (const Row& row : c.rows)
      if (const auto y = value(row)) {
        PlotPoint point{{row.step, *y}, !std::isfinite(*y), "", false, {}};
        point.open = whole && row.error() > 0.0;
        if (y == seconds_of(row))
          point.spread = Box<2>{{row.step, row.processor.low}, {row.step, row.processor.high}};
        series.points.push_back(point);
      }
    plot.series.push_back(std::move(series));
  }
  plot.x_name = "step h, seconds";
  return plot;
}

// --- how error and energy go with time ---

std::optional<DriftPlots> drift_plots(const ProblemRows& problem, const Looks& looks) {
  const auto step = shared_step(problem);
  if (!step) return std::nullopt;
  DriftPlots plots{drift_plot(problem, looks, *step, kError),
                   drift_plot(problem, looks, *step, kEnergy)};
  plots.error.title = "Error so far against time";
  plots.error.y_name = error_words(problem);
  plots.energy.title = "Drift of the energy against time";
  plots.energy.y_name =
      "change of the energy so far, over the kinetic and elastic at first, or what has fallen";
  plots.energy.empty = "the problem does not keep its energy";
  return plots;
}

}  // namespace lantern::report
