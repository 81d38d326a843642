// The rows of one problem, and what is read from them: who took part, how errors shrink with steps,
// which work is counted.
#pragma once

#include "draw/plot.hpp"
#include "measure/row.hpp"

namespace lantern::report {

// Rows that stand together in a measurement and are of one problem.
struct ProblemRows {
  std::string problem, family, variant;
  std::vector<Row> rows;
};
std::vector<ProblemRows> by_problem(std::span<const Row> rows);

inline constexpr double kRounding = 0x1p-52;  // an error that says no more than that

// It chooses its steps itself, and moves the bodies without the world's step.
inline bool is_adaptive(std::string_view method) { return method == kAdaptive; }

// An order, and how far the slopes between neighbouring rows lie from it, at most; where they only
// rise or only fall as steps shrink, the first and the last: then the order is still on its way.
struct Order {
  double exponent = 0, spread = 0;
  std::optional<std::pair<double, double>> trend = {};
  std::string words() const {
    if (trend) return fmt::format("{:.2f}→{:.2f}", trend->first, trend->second);
    return fmt::format("{:.2f}±{:.2f}", exponent, spread);
  }
};

// From the first to the last of some rows errors scatter below the largest of them: which of them a
// run ends with is chance.
struct Floor {
  std::size_t first = 0, last = 0;
  double largest = 0;
};

// The same of one method, the largest step first.
struct MethodRows {
  std::string method;
  bool is_peer = false;
  std::string version;
  std::vector<Row> rows;
  std::optional<Floor> floor;
  std::optional<Order> order;  // of the rows before it
  // What each run vouches for: the largest of its error, of those of all runs at smaller steps and
  // of the floor, since an error may be small by chance. Nothing for what was not run, for runs
  // that failed, and where one at a smaller step did.
  std::vector<std::optional<double>> assured;
  std::string name() const;  // "explicit Euler", "Bullet:10 3.24"
};
std::vector<MethodRows> by_method(const ProblemRows& problem);

// "explicit Euler" of "explicit_euler", "soft contacts (16 sub-steps)" of "soft:16"; a peer's name
// stays as it is.
std::string method_words(std::string_view method);

// What a norm measures: "state" of "traj". Others stay as they are.
std::string norm_words(std::string_view norm);

// The name of the problem's main norm; empty if no row has one.
std::string main_norm(const ProblemRows& problem);

// Whether every error is a whole number of what is counted, not measured: a run is right or wrong,
// and there is nothing between. False if no run has an error.
bool has_whole_errors(const ProblemRows& problem);

// A look for each method: those that are known have always the same, others in order of their
// first row, peers from kFirstPeerLook on.
using Looks = std::map<std::string, int>;
Looks looks_of(std::span<const Row> rows);

// p in error ~ step^p: least squares through the logarithms of the rows above the rounding floor,
// where the error has begun to shrink evenly. Nothing for fewer than three such rows, or if no even
// piece is there or it ends more than one slope before the last, or if the error grows as steps
// shrink. An adaptive method has none: its steps are tolerances.
std::optional<Order> observed_order(std::span<const Row> rows);

// The rows, the largest step first, to which errors fell, and on which they shrink after the
// largest of them more slowly than by half the observed order (of half a power where there is
// none); two rows are none if the second is less. Of rounding or of the method. None of an adaptive
// method, of errors that have not begun to shrink, or of 0.
std::optional<Floor> observed_floor(std::span<const Row> rows);

// What rounding alone leaves after so many steps if each rounds once, as a random walk: 2^-52 times
// their square root (Henrici, "Discrete Variable Methods", 1962). Relative. Steps of many stages
// round more often, and errors in the phase grow faster: what is observed lies above it.
double rounding_floor(double steps);

// The count that says best how much work a problem's runs are: constraint rows if there are any,
// else force evaluations, else steps.
struct WorkCount {
  std::string name;  // "force evaluations"
  std::uint64_t Counted::*count = nullptr;
  std::optional<double> of(const Row& row) const;  // nothing for 0
};
WorkCount work_count(const ProblemRows& problem);

// Methods whose errors agree in every run that two of them share, and in two runs at least: in
// everything that the problem asks of them they are the same. Agreement is to a billionth, since
// they round differently. Names, two or more a group, in order of their first rows.
std::vector<std::vector<std::string>> equal_methods(const ProblemRows& problem);

// The line for a student: to be off by at most so much, which method of fixed steps is the
// quickest, and how the next one compares; of many changes the three that hold for most. Errors are
// decades, or 0 where they are whole numbers. What a method takes for an error is read between the
// two neighbouring runs that vouch for more and for less (MethodRows::assured), by the straight
// line of the plot. Decades are told at which none but the quickest is so good at its largest step
// already: of others larger ones might cost less. Whom another measurement might rank otherwise
// tie. Who does not do the world's step is left out. Where nothing is told so: who is off least at
// the largest step and all smaller ones; or why there is no such line.
std::string who_is_quickest(const ProblemRows& problem);

// What a reader must know beside the numbers: what the main norm is, how good its reference is, and
// who is measured otherwise than the rest. A sentence each.
std::vector<std::string> notes_on(const ProblemRows& problem);

// --- which runs no other run beats ---

// What a run costs; nothing for one that cannot be compared.
using Cost = std::function<std::optional<double>(const Row&)>;

// Indices of the points of which no other has both an error and a cost that are not larger, and one
// of them less; ascending in cost. Of equal points the first. Points that are not finite are out.
std::vector<std::size_t> pareto_front(std::span<const Vec<2>> cost_and_error);

// The same of a problem's runs that have a cost, by what they vouch for, and that do the world's
// step, so that like stands beside like: the points themselves.
std::vector<Vec<2>> pareto_front(const ProblemRows& problem, const Cost& cost);

// Processor seconds of a whole run; nothing for a row that was not timed.
std::optional<double> seconds_of(const Row& row);

// One plot of a problem: its methods as series, the observed order behind each name if
// `with_orders`, runs that failed at the upper edge if they have a cost, the estimated rounding
// floor, the Pareto front. `looks` must hold every method (looks_of).
Plot cost_plot(const ProblemRows& problem, const Cost& cost, const Looks& looks, bool with_orders);

// The two plots of a problem: error against seconds and against counted work. Runs that are only
// right or wrong are shown by their outcome, and what they cost against the step: in seconds, or
// where none is timed in work. Their series are in the order of by_method.
std::pair<Plot, Plot> plots_of(const ProblemRows& problem, const Looks& looks);

// "oscillator, stiff" of oscillator_stiff; only the name where the variant is plain.
std::string problem_words(const ProblemRows& problem);

// The scenario's file, without its folder.
std::string file_name(const ProblemRows& problem);

// A method as a line of a plot, without points. `looks` must hold it (looks_of).
PlotSeries series_of(const MethodRows& method, const Looks& looks);

// Of a plot whose errors are whole numbers: bands "exact", "off by 1", "off by 2 to 9", ..., as
// many as its points need, each wrong point with its number beside it.
void put_into_bands(Plot& plot);

// A value of each run against its step: its seconds, say. Nothing is left out, what is not finite
// goes to the upper edge. Where errors are whole numbers, wrong runs are open marks. `looks` must
// hold every method (looks_of).
Plot step_plot(const ProblemRows& problem, const Cost& value, const Looks& looks);

// How runs of a problem go astray with time, of runs with one step: that which most methods share,
// of several the finest. Series are in the order of by_method, without points for who has no such
// run; the adaptive method has none: its steps are tolerances.
struct DriftPlots {
  Plot error;   // the main norm so far, against seconds since the start
  Plot energy;  // its drift so far; without points where the problem does not keep it
};
// Nothing if no run of a fixed step has samples.
std::optional<DriftPlots> drift_plots(const ProblemRows& problem, const Looks& looks);

}  // namespace lantern::report
