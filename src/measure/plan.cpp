#include "measure/plan.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/error.hpp"
#include "measure/dormand_prince_solver.hpp"
#include "measure/lantern_solver.hpp"
#include "measure/peers.hpp"

namespace lantern {
namespace {

constexpr std::string_view kAdaptive = "dormand_prince";
constexpr int kOwnHalvings = 6;          // of a scenario's own step
constexpr double kFinerReference = 16;   // times finer than the finest measured step
constexpr double kTooLongToRepeat = 10;  // seconds

constexpr TimingRule kQuick{3, 0.002};
constexpr TimingRule kGood{15, 0.05};
constexpr TimingRule kOnce{1, 0};

// What is refused of a scenario gets a place in its file: its [problem], if it has one.
template <class Act>
auto with_place(const Scenario& scenario, const Act& act) {
  try {
    return act();
  } catch (const Refused& refused) {
    const auto where =
        scenario.problem ? scenario.problem->where : SourcePosition{scenario.file, 0, 0};
    throw ScenarioError(diagnose(scenario, where, refused.what()));
  }
}

}  // namespace

bool can_be_measured_by(std::string_view name) {
  return name == kAdaptive || method_named(name).has_value();
}

Plan::Plan(PlanOptions options, const std::function<void(const Scenario&)>& told)
    : options_(std::move(options)), prepared_(options_.scenarios.size()) {
  if (options_.peers) solvers_ = peers(missing_peers_);
  peers_ = solvers_.size();
  adaptive_ = solvers_.size();
  solvers_.push_back(std::make_unique<DormandPrinceSolver>());
  for (std::size_t i = 0; i < options_.scenarios.size(); ++i) {
    told(options_.scenarios[i]);
    with_place(options_.scenarios[i], [&] { prepare(i); });
  }
}

void Plan::prepare(std::size_t index) {
  const Scenario& scenario = options_.scenarios[index];
  Prepared& prepared = prepared_[index];
  prepared.schedule = Schedule::of(scenario);
  prepared.invariants = std::make_unique<Invariants>(scenario);
  if (scenario.problem) make_error_metric(scenario);  // is it the problem that it claims to be?
  const std::vector<double> steps = steps_for(scenario, prepared.schedule);
  prepared.finest = steps.front();
  for (const std::size_t solver : solvers_for(scenario)) {
    const double coarse = steps.front();
    per_step_[{index, solver}] =
        estimated_seconds(scenario, prepared.schedule, *solvers_[solver], coarse) /
        static_cast<double>(prepared.schedule.steps(coarse));
    for (const double step : steps) {
      jobs_.push_back({index, solver, step});
      if (!is_too_long(jobs_.back())) prepared.finest = std::min(prepared.finest, step);
    }
  }
}

std::vector<std::size_t> Plan::solvers_for(const Scenario& scenario) {
  std::vector<Method> methods;
  bool adaptive = options_.methods.empty();
  for (const std::string& name : options_.methods) {
    adaptive = adaptive || name == kAdaptive;
    if (const auto method = method_named(name)) methods.push_back(*method);
  }
  if (options_.methods.empty()) methods = methods_for(scenario);
  std::vector<std::size_t> chosen;
  for (const Method& method : methods) {
    if (!by_name_.contains(method.name)) {
      by_name_[method.name] = solvers_.size();
      solvers_.push_back(std::make_unique<LanternSolver>(method));
    }
    const std::size_t solver = by_name_[method.name];
    if (!solvers_[solver]->cannot(scenario)) chosen.push_back(solver);
  }
  if (adaptive && scenario.problem && !solvers_[adaptive_]->cannot(scenario))
    chosen.push_back(adaptive_);
  for (std::size_t peer = 0; peer < peers_; ++peer)
    if (scenario.problem && !solvers_[peer]->cannot(scenario)) chosen.push_back(peer);
  return chosen;
}

// The coarsest first.
std::vector<double> Plan::steps_for(const Scenario& scenario, const Schedule& schedule) const {
  std::vector<double> wished = options_.steps;
  if (wished.empty()) {
    double step = scenario.problem ? scenario.problem->step : scenario.world.time_step;
    const int halvings = scenario.problem ? scenario.problem->halvings : kOwnHalvings;
    for (int i = 0; i <= halvings; ++i, step /= 2) wished.push_back(step);
  }
  std::ranges::sort(wished, std::greater());
  std::vector<double> steps;
  for (const double step : wished) {
    const double fitted = schedule.fitted_step(step);
    if (steps.empty() || fitted < steps.back()) steps.push_back(fitted);
  }
  return steps;
}

double Plan::longest() const {
  if (options_.longest) return *options_.longest;
  if (options_.effort == Effort::quick) return 0.1;
  if (options_.effort == Effort::normal) return 2;
  return std::numeric_limits<double>::infinity();
}

const TimingRule& Plan::timing(const Job& job) const {
  if (seconds(job) > kTooLongToRepeat) return kOnce;
  return options_.effort == Effort::quick ? kQuick : kGood;
}

double Plan::seconds(const Job& job) const {
  return per_step_.at({job.scenario, job.solver}) *
         static_cast<double>(prepared_[job.scenario].schedule.steps(job.step));
}

double Plan::seconds_with_repeats(const Job& job) const {
  const TimingRule& rule = timing(job);
  return seconds(job) + rule.repeats * std::max(seconds(job), rule.least_seconds);
}

Row Plan::run(const Job& job) {
  Prepared& prepared = prepared_[job.scenario];
  if (!prepared.reference)
    prepared.reference = with_place(scenario(job), [&] {
      return reference_for(scenario(job), prepared.schedule, prepared.finest / kFinerReference);
    });
  Row row = measure(scenario(job), prepared.schedule, solver(job), job.step, *prepared.reference,
                    *prepared.invariants, timing(job));
  if (row.timing.repeats > 0)
    per_step_[{job.scenario, job.solver}] =
        row.timing.median / static_cast<double>(prepared.schedule.steps(job.step));
  return row;
}

}  // namespace lantern
