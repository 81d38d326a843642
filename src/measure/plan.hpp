// The runs of a measurement: which solver runs which scenario at which steps, and what is left out.
#pragma once

#include "measure/run.hpp"

namespace lantern::measure {

// The problems that Lantern carries with it: scenarios whose answer is known.
// Names of the files of scenarios/problems/ and of its crowds/, in alphabetical order.
std::vector<std::string_view> problem_names();

// One of them; it must be there.
Scenario known_problem(std::string_view name);

enum class Effort {
  quick,   // two minutes: plain problems, few repeats, no long runs
  normal,  // all problems, timed well, no long runs
  full,    // all that there is
};

// A method of Lantern's, or "dormand_prince:adaptive", the reference of smooth problems.
bool can_be_measured_by(std::string_view name);

// Why the solver does not run the scenario; nothing if it does. The one place where this is
// decided: beside what a solver cannot do, engines and the adaptive method are run on problems
// only, since without a known answer there is nothing to hold them to.
std::optional<std::string> why_not(const Solver& solver, const Scenario& scenario);

struct PlanOptions {
  std::vector<Scenario> scenarios;
  Effort effort = Effort::normal;
  std::vector<std::string> methods;  // names; empty for those of each scenario
  std::vector<double> steps;         // seconds; empty for those of each scenario
  std::optional<double> longest;     // processor seconds of one run; longer ones are left out
  bool peers = true;
};

struct Job {
  std::size_t scenario = 0;  // of the plan's
  std::size_t solver = 0;
  double step = 0;  // fitted
};

// Who does not run a scenario, though it was asked for or is an engine that is there.
struct Unsuited {
  std::string problem, solver, reason;
  bool is_peer = false;
};

class Plan {
 public:
  // Estimates every run, for which each solver runs for some milliseconds; `told` is called
  // before each scenario. Throws ScenarioError, pointing at the [problem] if there is one, for a
  // scenario that cannot be measured and for a step that is not allowed.
  Plan(PlanOptions options, const std::function<void(const Scenario&)>& told);

  const std::vector<Job>& jobs() const { return jobs_; }  // those of a scenario stand together
  // Processor seconds of one run of it, estimated: from its first milliseconds, and, once one was
  // run, from the last run of the same solver on the same scenario.
  double seconds(const Job& job) const;
  double seconds_with_repeats(const Job& job) const;
  double longest() const;  // processor seconds that a run may take
  bool is_too_long(const Job& job) const { return seconds(job) > longest(); }
  const std::vector<std::string>& missing_peers() const { return missing_peers_; }
  std::vector<PeerRecord> peers() const;  // those that have jobs
  const std::vector<Unsuited>& unsuited() const { return unsuited_; }

  const Scenario& scenario(const Job& job) const { return options_.scenarios[job.scenario]; }
  const Solver& solver(const Job& job) const { return *solvers_[job.solver]; }

  // A row for each of these jobs, which must be of one scenario, in their order: each is run once,
  // then all are timed in turn. What is too long becomes a row that is left out. `told` is called
  // after each run with the seconds that were planned for it. After Stopped the jobs can be run
  // again. Throws ScenarioError if there is nothing to hold them against.
  std::vector<Row> run(
      std::span<const Job> jobs, const std::function<void(double)>& told = [](double) {});

 private:
  struct Prepared {
    Schedule schedule;
    std::unique_ptr<Invariants> invariants;
    std::optional<Reference> reference;
    double finest = 0;  // step that is run
  };

  void prepare(std::size_t scenario);
  std::vector<std::size_t> solvers_for(const Scenario& scenario);
  std::vector<double> steps_for(const Scenario& scenario, const Schedule& schedule) const;
  TimingRule timing(const Job& job) const;
  double& per_step(const Job& job) { return per_step_[{job.scenario, job.solver}]; }

  PlanOptions options_;
  std::vector<Prepared> prepared_;
  std::vector<std::unique_ptr<Solver>> solvers_;
  std::map<std::string, std::size_t> by_name_;
  std::size_t peers_ = 0;  // the first solvers
  std::size_t adaptive_ = 0;
  std::vector<std::string> missing_peers_;
  std::vector<Unsuited> unsuited_;
  std::vector<Job> jobs_;
  std::map<std::pair<std::size_t, std::size_t>, double> per_step_;  // seconds, by scenario, solver
};

}  // namespace lantern::measure
