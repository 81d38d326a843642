#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <span>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "lab/commands.hpp"
#include "lab/experiment_run.hpp"
#include "lab/measure_unsuited.hpp"
#include "language/method.hpp"
#include "measure/run.hpp"
#include "report/benches.hpp"
#include "report/measure_document.hpp"
#include "report/pages.hpp"

namespace lantern::lab {
namespace {

namespace fs = std::filesystem;

constexpr double kSaveEvery = 5;                                   // seconds
constexpr std::size_t kMostMeasureBytes = std::size_t{256} << 20;  // of an earlier measure.json

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
    if (!can_be_measured_by(name)) {
      if (const auto words = about_peer(name, plan.scenarios)) throw UsageError(*words);
      throw UsageError(
          with_suggestion(fmt::format("there is no method '{}'", name), name, method_names()));
    }
    plan.methods.push_back(name);
  }
  for (const double step : options.steps) {
    if (!std::isfinite(step) || step <= 0)
      throw UsageError(fmt::format("a time step of {} s is not allowed; it must be above 0", step));
    plan.steps.push_back(step);
  }
  return plan;
}

int list_problems(bool as_json) {
  std::vector<std::vector<std::string>> rows = {{"problem", "family", "variant", "title"}};
  JsonWriter json = answer_of("measure.list");
  json.line().key("problems").begin_array();
  for (const std::string_view name : problem_names()) {
    const Scenario s = known_problem(name);
    const std::string_view family = to_string(s.problem->solution);
    const std::string_view variant = to_string(s.problem->variant);
    rows.push_back({s.name, std::string(family), std::string(variant), s.title});
    json.line().begin_object().members("name", s.name, "family", family, "variant", variant,
                                       "title", s.title);
    json.end_object();
  }
  json.line().end_array().line().end_object();
  as_json ? answer(json.text()) : print(table(rows));
  return kGood;
}

bool same(const Circumstances& a, const Circumstances& b) {
  return a.version == b.version && a.sources == b.sources && a.compiler == b.compiler &&
         a.flags == b.flags && a.processor == b.processor && a.effort == b.effort;
}

// Rows of an earlier run under the same circumstances; none if there are none, or, which is told,
// if its file is damaged.
std::vector<Row> finished_rows(const ReportFolder& folder, const Circumstances& circumstances) {
  std::string why;
  try {
    const auto text = folder.earlier("measure.json", kMostMeasureBytes);
    if (!text) return {};
    auto earlier = read_measurement(*text, &why);
    if (earlier && same(earlier->circumstances, circumstances)) return std::move(earlier->rows);
  } catch (const IoError& e) {
    why = e.what();
  }
  if (!why.empty())
    warn(fmt::format("nothing is taken over from '{}': {}",
                     (folder.path() / "measure.json").string(), why));
  return {};
}

// A measurement while it is made. What is finished is on the disk every few seconds.
class Measuring {
 public:
  Measuring(Plan& plan, ReportFolder& folder, const MeasureOptions& options)
      : plan_(plan), folder_(folder), progress_("measure", plan.jobs().size(), "runs") {
    measurement_.circumstances = here();
    measurement_.peers = plan.peers();
    measurement_.circumstances.effort = options.quick ? "quick" : options.full ? "full" : "normal";
    known_ = finished_rows(folder_, measurement_.circumstances);
  }

  void run() {
    for (const Job& job : plan_.jobs()) left_ += expected(job);
    announce();
    Stopwatch since_saved;
    try {
      while (done_ < plan_.jobs().size()) {
        measure_next_problem();
        if (since_saved.seconds() < kSaveEvery) continue;
        save();
        since_saved = {};
      }
    } catch (const Stopped&) {
      give_time_to_save();
      keep_what_was_known();
    }
    save();
  }

  const Measurement& measurement() const { return measurement_; }

 private:
  void save() {
    if (std::ranges::any_of(measurement_.rows, &Row::was_run))
      folder_.write("measure.json", report::to_json(measurement_));
  }

  // Rows of an earlier run that this one did not come to.
  void keep_what_was_known() {
    for (std::size_t i = done_; i < plan_.jobs().size(); ++i)
      if (const Row* old = known(plan_.jobs()[i])) measurement_.rows.push_back(*old);
  }

  const Row* known(const Job& job) const {
    const Scenario& scenario = plan_.scenario(job);
    const Solver& solver = plan_.solver(job);
    const auto found = std::ranges::find_if(known_, [&](const Row& row) {
      return row.problem == scenario.name && row.text_hash == scenario.text_hash &&
             row.method == solver.name() && row.version == solver.version() && row.step == job.step;
    });
    return found == known_.end() ? nullptr : &*found;
  }

  // What was left out before may have its time now.
  const Row* finished(const Job& job) const {
    const Row* row = known(job);
    return row && row->status != Status::left_out ? row : nullptr;
  }

  double expected(const Job& job) const {
    return finished(job) || plan_.is_too_long(job) ? 0 : plan_.seconds_with_repeats(job);
  }

  // All of its runs, but for those that are finished: they are timed in turn.
  void measure_next_problem() {
    stop_if_asked();
    const std::span<const Job> rest = std::span(plan_.jobs()).subspan(done_);
    std::vector<Job> jobs;
    std::size_t count = 0;
    for (; count < rest.size() && rest[count].scenario == rest[0].scenario; ++count)
      if (!finished(rest[count])) jobs.push_back(rest[count]);
    const std::string& name = plan_.scenario(rest[0]).name;
    double left = left_;
    std::vector<Row> rows = plan_.run(jobs, [&](double seconds) {
      left = std::max(0.0, left - seconds);
      progress_.tell(fmt::format("{} of {} runs done, now {}, about {} left", done_,
                                 plan_.jobs().size(), name, duration_text(left)));
    });
    auto next = std::make_move_iterator(rows.begin());
    for (const Job& job : rest.first(count)) {
      const Row* old = finished(job);
      measurement_.rows.push_back(old ? *old : Row(*next++));
    }
    done_ += count;
    left_ = 0;
    for (const Job& job : rest.subspan(count)) left_ += expected(job);
  }

  // Before it starts: how much there is to do, how long it will take, and what is left out.
  void announce() const {
    std::size_t kept = 0, long_ones = 0;
    const Job* longest = nullptr;
    for (const Job& job : plan_.jobs()) {
      if (finished(job)) {
        ++kept;
        continue;
      }
      if (!plan_.is_too_long(job)) continue;
      ++long_ones;
      if (!longest || plan_.seconds(job) > plan_.seconds(*longest)) longest = &job;
    }
    say(fmt::format("{}, about {}{}", counted(plan_.jobs().size() - kept - long_ones, "run"),
                    duration_text(left_),
                    kept ? fmt::format("; {} are finished from before", kept) : ""));
    for (const std::string& missing : plan_.missing_peers()) say(missing);
    if (longest)
      say(
          fmt::format("{} left out as too long; the longest ({}, {} at {:.3g} s) would "
                      "take {}. --full runs them all",
                      long_ones == 1 ? "1 run is" : fmt::format("{} runs are", long_ones),
                      plan_.scenario(*longest).name, plan_.solver(*longest).name(), longest->step,
                      duration_text(plan_.seconds(*longest))));
  }

  Plan& plan_;
  ReportFolder& folder_;
  Measurement measurement_;
  std::vector<Row> known_;
  std::size_t done_ = 0;  // jobs whose rows are there
  double left_ = 0;       // seconds that the others will take
  Progress progress_;
};

// The tables of all, a page of plots for each problem, the overview, and all on one web page; of
// all problems the bars that belong to the whole, too.
void save_pages(ReportFolder& folder, const Measurement& m, const MeasureOptions& options) {
  folder.write("measure.csv", to_csv(m));
  folder.write("drift.csv", drift_csv(m));
  folder.write("circumstances.csv", to_csv(m.circumstances));
  folder.write("peers.csv", to_csv(m.peers));
  std::vector<ReportPage> pages;
  const std::vector<Bar> bars = options.problems.empty() ? measured_bars() : std::vector<Bar>();
  folder.write("report.html", to_html(document_of(std::span(&m, 1), bars)));
  pages.push_back({"overview", draw_overview(m, bars)});
  for (const ProblemRows& problem : by_problem(m.rows)) {
    pages.push_back({problem.problem, draw_problem(problem, m)});
    if (std::ranges::any_of(problem.rows, [](const Row& row) { return !row.samples.empty(); }))
      pages.push_back({problem.problem + "_drift", draw_drift(problem, m)});
  }
  if (!m.peers.empty()) pages.push_back({"peers", draw_peers(m)});
  folder.draw(pages, options.theme, options.backend);
}

int measure_problems(const MeasureOptions& options) {
  PlanOptions planned = plan_options(options);
  ReportFolder folder(options.output, "measure");
  Plan plan(std::move(planned), [](const Scenario&) {});
  // Of all problems some suit no other engine: only who asks for a few is told.
  for (const std::string& line : unsuited_words(plan.unsuited(), !options.problems.empty()))
    say(line);
  Measuring measuring(plan, folder, options);
  const Measurement& m = measuring.measurement();
  measuring.run();
  const bool is_nothing = std::ranges::none_of(m.rows, &Row::was_run);
  if (is_nothing && !interrupted()) {
    complain("nothing was measured: no method applies, or every run is too long (--full)");
    return kFailed;
  }
  options.json ? answer(report::to_json(m)) : print(to_table(m));
  if (interrupted()) {
    complain("interrupted; the same command goes on from here");
    return kInterrupted;
  }
  save_pages(folder, m, options);
  folder.finish();
  say(fmt::format("the report is in {}", options.output));
  return kGood;
}

// One web page of what was measured before, here or elsewhere.
int page_of_earlier(const MeasureOptions& options) {
  std::vector<Measurement> measurements;
  for (const std::string& word : options.from) {
    const fs::path path = fs::is_directory(word) ? fs::path(word) / "measure.json" : fs::path(word);
    std::string why;
    auto read = read_measurement(read_input(path, kMostMeasureBytes), &why);
    if (!read)
      throw UsageError(fmt::format("'{}' is no measurement that 'lantern measure' has written: {}",
                                   path.string(), why));
    measurements.push_back(std::move(*read));
  }
  ReportFolder folder(options.output, "measure_page");
  folder.write("report.html", to_html(document_of(measurements, {})));
  folder.finish();
  const std::string page = (folder.path() / "report.html").string();
  say(fmt::format("the page is {}", page));
  if (options.json)
    answer(answer_of("measure.page").line().member("file", page).line().end_object().text());
  return kGood;
}

}  // namespace

int measure_command(const MeasureOptions& options) {
  if (options.list) return list_problems(options.json);
  if (!options.from.empty()) return page_of_earlier(options);
  const std::vector<std::string>& words = options.problems;
  if (words.empty() || words[0] != "broad_phase") return measure_problems(options);
  const auto experiment = broad_phases({words.begin() + 1, words.end()}, options.full);
  return run_experiment(*experiment,
                        {"measure broad_phase", "broad_phase", as_typed(experiment->options()),
                         options.output, options.json, options.theme, true});
}

}  // namespace lantern::lab
