#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/measure_files.hpp"
#include "app/table.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/suggest.hpp"
#include "embedded/version.hpp"
#include "measure/plan.hpp"
#include "measure/problems.hpp"
#include "report/measure_tables.hpp"
#include "report/sentences.hpp"

namespace lantern {
namespace {

constexpr double kSaveEvery = 5;  // seconds

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 100 * 3600) return fmt::format("{:.0f} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

bool is_file(const std::string& word) {
  return word.ends_with(".toml") || word.find('/') != std::string::npos;
}

// A problem by name, all problems of a family, or a scenario file.
void add_scenarios(const std::string& word, std::vector<Scenario>& scenarios) {
  if (is_file(word)) {
    scenarios.push_back(load_scenario(word));
    return;
  }
  const std::vector<std::string_view> names = problem_names();
  if (std::ranges::find(names, word) != names.end()) {
    scenarios.push_back(known_problem(word));
    return;
  }
  const std::size_t before = scenarios.size();
  for (const std::string_view name : names)
    if (Scenario s = known_problem(name); s.problem && to_string(s.problem->solution) == word)
      scenarios.push_back(std::move(s));
  if (scenarios.size() == before)
    throw UsageError(fmt::format("there is no problem '{}'; {}", word,
                                 suggestion(word, names, 0).empty()
                                     ? "'lantern measure --list' names them all"
                                     : suggestion(word, names, 0)));
}

std::vector<Scenario> scenarios_of(const MeasureOptions& options) {
  std::vector<Scenario> scenarios;
  for (const std::string& word : options.problems) add_scenarios(word, scenarios);
  if (!options.problems.empty()) return scenarios;
  for (const std::string_view name : problem_names()) {
    Scenario scenario = known_problem(name);
    const bool plain = scenario.problem && scenario.problem->variant == ProblemVariant::plain;
    if (!options.quick || plain) scenarios.push_back(std::move(scenario));
  }
  return scenarios;
}

PlanOptions plan_options(const MeasureOptions& options) {
  PlanOptions plan;
  plan.scenarios = scenarios_of(options);
  plan.effort = options.quick ? Effort::quick : options.full ? Effort::full : Effort::normal;
  plan.peers = options.peers;
  plan.longest = options.longest;
  for (const std::string& name : options.methods) {
    if (!method_named(name))
      throw UsageError(
          fmt::format("there is no method '{}'; {}", name, suggestion(name, method_names())));
    plan.methods.push_back(name);
  }
  for (const double step : options.steps) {
    if (!std::isfinite(step) || step <= 0)
      throw UsageError(fmt::format("a time step of {} s is not allowed; it must be above 0", step));
    plan.steps.push_back(step);
  }
  return plan;
}

int list_problems() {
  std::vector<std::vector<std::string>> rows = {{"problem", "family", "variant", "title"}};
  for (const std::string_view name : problem_names()) {
    const Scenario s = known_problem(name);
    rows.push_back({s.name, std::string(to_string(s.problem->solution)),
                    std::string(to_string(s.problem->variant)), s.title});
  }
  write_stdout(table(rows));
  return kGood;
}

// A measurement while it is made. What is finished is on the disk every few seconds.
class Measuring {
 public:
  Measuring(Plan& plan, const MeasureOptions& options) : plan_(plan), files_(options.output) {
    measurement_.circumstances = here(kVersion);
    measurement_.circumstances.effort = options.quick ? "quick" : options.full ? "full" : "normal";
    known_ = files_.finished_rows(measurement_.circumstances);
  }

  void run() {
    double left = 0;
    for (const Job& job : plan_.jobs())
      if (!known(job)) left += plan_.seconds(job);
    announce(left);
    Stopwatch since_saved;
    std::size_t done = 0;
    for (const Job& job : plan_.jobs()) {
      if (interrupted()) break;
      const Row* old = known(job);
      if (!old) left -= plan_.seconds(job);
      std::optional<Row> row = old ? std::optional(*old) : plan_.run(job, interrupted);
      if (!row) break;
      measurement_.rows.push_back(std::move(*row));
      progress_.tell(fmt::format("{} of {} runs, {}, about {} left", ++done, plan_.jobs().size(),
                                 plan_.scenario(job).name, duration_text(left)));
      if (since_saved.seconds() < kSaveEvery) continue;
      files_.save_rows(measurement_);
      since_saved = {};
    }
    files_.save_rows(measurement_);
  }

  const Measurement& measurement() const { return measurement_; }
  MeasureFiles& files() { return files_; }

 private:
  const Row* known(const Job& job) const {
    const Scenario& scenario = plan_.scenario(job);
    const Contestant& contestant = plan_.contestant(job);
    const auto found = std::ranges::find_if(known_, [&](const Row& row) {
      return row.problem == scenario.name && row.text_hash == scenario.text_hash &&
             row.method == contestant.name() && row.version == contestant.version() &&
             row.step == job.step;
    });
    return found == known_.end() ? nullptr : &*found;
  }

  void announce(double seconds) const {
    std::size_t kept = 0;
    for (const Job& job : plan_.jobs()) kept += known(job) != nullptr;
    say(fmt::format("{} runs, about {}{}", plan_.jobs().size() - kept, duration_text(seconds),
                    kept ? fmt::format("; {} are finished from before", kept) : ""));
    for (const std::string& missing : plan_.missing_peers()) say(missing);
    if (plan_.left_out().empty()) return;
    const auto longest =
        std::ranges::max_element(plan_.left_out(), {}, [](const Job& job) { return job.seconds; });
    say(fmt::format(
        "{} runs are left out as too long, the longest ({}, {} at {:.3g} s) would take "
        "{}; --full runs all",
        plan_.left_out().size(), plan_.scenario(*longest).name, plan_.contestant(*longest).name(),
        longest->step, duration_text(longest->seconds)));
  }

  Plan& plan_;
  MeasureFiles files_;
  Measurement measurement_;
  std::vector<Row> known_;
  Progress progress_{"measure", "runs"};
};

}  // namespace

int measure_command(const MeasureOptions& options) {
  if (options.list) return list_problems();
  PlanOptions planned = plan_options(options);
  MeasureFiles::require_writable(options.output);
  try {
    Plan plan(std::move(planned), [](const Scenario&) {});
    if (plan.jobs().empty()) {
      complain(plan.left_out().empty() ? "no method applies to these scenarios"
                                       : fmt::format("every run is too long, the shortest would "
                                                     "take {}; --full runs them all the same",
                                                     duration_text(plan.left_out()[0].seconds)));
      return kFailed;
    }
    Measuring measuring(plan, options);
    measuring.run();
    const Measurement& m = measuring.measurement();
    write_stdout(options.json ? to_json(m) : to_table(m));
    if (!options.json)
      for (const std::string& sentence : sentences(m)) write_stdout(sentence + "\n");
    if (interrupted()) {
      say("interrupted; the same command goes on from here");
      return kInterrupted;
    }
    measuring.files().save_pages(m, options.backend);
    say(fmt::format("the report is in {}", options.output));
    return kGood;
  } catch (const Refused& refused) {
    complain(refused.what());
    return kBadScenario;
  }
}

}  // namespace lantern
