#include "measure/plan.hpp"

#include "embedded/problems.hpp"
#include "measure/solvers.hpp"

namespace lantern::measure {
namespace {

constexpr int kOwnHalvings = 6;          // of a scenario's own step
constexpr int kDoublings = 4;            // of a problem's step, as far as its looks allow them
constexpr double kFinerReference = 16;   // times finer than the finest measured step
constexpr double kTooLongToRepeat = 10;  // seconds

constexpr TimingRule kQuick{Timing::kFewest, 0.001, 9};
constexpr TimingRule kGood{15, 0.05, 45};
constexpr TimingRule kOnce{1, 0};
const std::optional<std::string> kNoProblem = "it has no [problem]";

// What is refused of a scenario gets a place in its file: its [problem], if it has one.
auto with_place(const Scenario& scenario, const auto& act) {
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

std::optional<std::string> why_not(const Solver& solver, const Scenario& scenario) {
  if (!scenario.problem && (solver.is_peer() || solver.name() == kAdaptive)) return kNoProblem;
  return solver.cannot(scenario);
}

Plan::Plan(PlanOptions options, const std::function<void(const Scenario&)>& told)
    : options_(std::move(options)), prepared_(options_.scenarios.size()) {
  const auto wanted = [&](std::string_view engine) {
    std::vector<Unsuited> reasons;
    for (const Scenario& scenario : options_.scenarios) {
      const auto reason = scenario.problem ? engine_cannot(engine, scenario) : kNoProblem;
      if (!reason) return true;
      reasons.push_back({scenario.name, std::string(engine), *reason, true});
    }
    std::ranges::move(reasons, std::back_inserter(unsuited_));
    return false;
  };
  if (options_.peers) solvers_ = load_peers(missing_peers_, wanted);
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
  // Is it the problem that it claims to be?
  if (scenario.problem) prepared.reference = reference_for(scenario, prepared.schedule, 0);
  const std::vector<double> steps = steps_for(scenario, prepared.schedule);
  // Larger ones are there to see methods fail; the tolerance of the adaptive one has its largest
  // here.
  const double usual = scenario.problem ? prepared.schedule.fitted_step(scenario.problem->step)
                                        : std::numeric_limits<double>::infinity();
  const auto found = std::ranges::find_if(steps, [&](double step) { return step <= usual; });
  const double sound = found == steps.end() ? steps.back() : *found;
  prepared.finest = steps.front();
  for (const std::size_t solver : solvers_for(scenario)) {
    per_step({index, solver}) =
        estimated_seconds(scenario, prepared.schedule, *solvers_[solver], sound) /
        static_cast<double>(prepared.schedule.steps(sound));
    for (const double step : steps) {
      if (solver == adaptive_ && options_.steps.empty() && step > usual) continue;
      jobs_.push_back({index, solver, step});
      if (!is_too_long(jobs_.back())) prepared.finest = std::min(prepared.finest, step);
    }
  }
}

// Who was asked for and does not suit is remembered with the reason.
std::vector<std::size_t> Plan::solvers_for(const Scenario& scenario) {
  std::vector<std::size_t> chosen;
  const auto consider = [&](std::size_t i, bool was_asked) {
    const Solver& solver = *solvers_[i];
    if (const auto reason = why_not(solver, scenario); !reason)
      chosen.push_back(i);
    else if (was_asked)
      unsuited_.push_back({scenario.name, solver.name(), *reason, solver.is_peer()});
  };
  const auto consider_method = [&](const Method& method) {
    const auto [known, fresh] = by_name_.try_emplace(method.name, solvers_.size());
    if (fresh) solvers_.push_back(std::make_unique<LanternSolver>(method));
    consider(known->second, true);
  };
  if (options_.methods.empty()) {
    for (const Method& method : methods_for(scenario)) consider_method(method);
    consider(adaptive_, false);
  }
  for (const std::string& name : options_.methods)
    if (const auto method = method_named(name)) consider_method(*method);
  if (std::ranges::find(options_.methods, kAdaptive) != options_.methods.end())
    consider(adaptive_, true);
  for (std::size_t peer = 0; peer < peers_; ++peer) consider(peer, true);
  return chosen;
}

// The coarsest first.
std::vector<double> Plan::steps_for(const Scenario& scenario, const Schedule& schedule) const {
  std::vector<double> wished = options_.steps;
  if (wished.empty()) {
    const double step = scenario.problem ? scenario.problem->step : scenario.world.time_step;
    const int halvings = scenario.problem ? scenario.problem->halvings : kOwnHalvings;
    for (int i = scenario.problem ? -kDoublings : 0; i <= halvings; ++i)
      wished.push_back(std::ldexp(step, -i));
  }
  std::ranges::sort(wished, std::greater());
  std::vector<double> steps;
  for (const double step : wished) {
    const double fitted = schedule.fitted_step(step);
    if (steps.empty() || fitted < steps.back()) steps.push_back(fitted);
  }
  return steps;
}

std::vector<PeerRecord> Plan::peers() const {
  std::vector<PeerRecord> records;
  for (std::size_t i = 0; i < peers_; ++i)
    if (std::ranges::find(jobs_, i, &Job::solver) != jobs_.end())
      records.push_back({solvers_[i]->name(), solvers_[i]->version(), solvers_[i]->settings()});
  return records;
}

double Plan::longest() const {
  if (options_.longest) return *options_.longest;
  if (options_.effort == Effort::quick) return 0.03;
  if (options_.effort == Effort::normal) return 2;
  return std::numeric_limits<double>::infinity();
}

TimingRule Plan::timing(const Job& job) const {
  if (seconds(job) > kTooLongToRepeat) return kOnce;
  return options_.effort == Effort::quick ? kQuick : kGood;
}

double Plan::seconds(const Job& job) const {
  return per_step_.at({job.scenario, job.solver}) *
         static_cast<double>(prepared_[job.scenario].schedule.steps(job.step));
}

double Plan::seconds_with_repeats(const Job& job) const {
  const TimingRule rule = timing(job);
  return seconds(job) + rule.repeats * std::max(seconds(job), rule.least_seconds);
}

std::vector<Row> Plan::run(std::span<const Job> jobs, const std::function<void(double)>& told) {
  std::vector<Row> rows;
  if (jobs.empty()) return rows;
  const Scenario& s = scenario(jobs.front());
  Prepared& prepared = prepared_[jobs.front().scenario];
  if (!prepared.reference)
    prepared.reference = with_place(
        s, [&] { return reference_for(s, prepared.schedule, prepared.finest / kFinerReference); });
  const Trials trials{s, prepared.schedule, *prepared.invariants, *prepared.reference};
  for (const Job& job : jobs) {
    const double expected = seconds(job);
    if (expected > longest()) {
      rows.push_back(blank_row(s, solver(job), job.step));
      rows.back().status = Status::left_out;
      rows.back().reason =
          fmt::format("would take about {:.2g} s, the limit is {:.2g} s", expected, longest());
      continue;
    }
    double took = expected;
    rows.push_back(evaluated(trials, solver(job), job.step, &took));
    per_step(job) = took / static_cast<double>(prepared.schedule.steps(job.step));
    told(expected);
  }
  std::vector<TimedRun> runs;
  std::vector<double> expected;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (rows[i].status != Status::ok) continue;
    runs.push_back({&solver(jobs[i]), &rows[i], timing(jobs[i])});
    expected.push_back(std::max(seconds(jobs[i]), runs.back().rule.least_seconds));
  }
  time_in_turn(trials, runs, [&](std::size_t i) { told(expected[i]); });
  return rows;
}

std::vector<std::string_view> problem_names() {
  auto names =
      mapped(problem::files(), [](const auto& file) { return std::string_view(file.first); });
  std::ranges::sort(names);
  return names;
}

Scenario known_problem(std::string_view name) {
  for (const auto& [known, text] : problem::files())
    if (known == name) return parse_scenario(text, fmt::format("scenarios/problems/{}.toml", name));
  LANTERN_CHECK(name, ==, std::string_view("a known problem"));
  return Scenario(ScenarioSpec());
}

}  // namespace lantern::measure
