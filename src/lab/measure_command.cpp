#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "lab/commands.hpp"
#include "language/method.hpp"
#include "measure/peers.hpp"
#include "measure/run.hpp"
#include "report/benches.hpp"
#include "report/document.hpp"
#include "report/measure_document.hpp"
#include "report/pages.hpp"

namespace lantern::lab {
namespace {

namespace fs = std::filesystem;

struct MeasureOptions {
  std::vector<std::string> problems;  // names, families or files; empty for all
  std::string output = "output/measure";
  std::vector<std::string> methods;  // empty for those of each problem
  std::vector<double> steps;         // seconds; empty for those of each problem
  std::vector<std::string> from;     // earlier measurements: only their page is made
  bool quick = false;
  bool full = false;
  std::optional<double> longest;  // processor seconds of one run; longer ones are left out
  bool peers = true;
  std::string theme = "light";
  std::string backend = "auto";
  bool list = false;
  bool json = false;
};

Options measure_options(MeasureOptions& o) {
  return {{"PROBLEM", &o.problems,
           "problems or families by name, or scenario files; the default is all problems; "
           "'broad_phase' measures the trees' settings"},
          folder_option(o.output, "folder for tables, plots and the overview page"),
          {"--method", &o.methods, "only these: velocity_verlet, soft:16, impulse:100, ...",
           OptionTraits{.value = "NAME", .one_each = true}},
          {"--step", &o.steps, "only these time steps, seconds", {.value = "H", .one_each = true}},
          {"--quick", &o.quick, "about a minute: plain problems, few repeats"},
          {"--full", &o.full, "every run, however long it takes", {.without = "--quick"}},
          longest_option("leave out runs that would take more seconds than this", o.longest),
          peers_option("without other engines", o.peers),
          {"--theme", &o.theme, "colours of the plots", {.words = kThemes}},
          backend_option(o.backend, "off-screen OpenGL, for the PNG files"),
          {"--list", &o.list, "name the problems, measure nothing"},
          {"--from", &o.from,
           "measure nothing: report.html of these folders or measure.json files, one a "
           "machine, side by side",
           OptionTraits{.value = "PATH"}},
          memory_option(),
          json_option(o.json)};
}

constexpr double kSaveEvery = 5;                                   // seconds
constexpr std::size_t kMostMeasureBytes = std::size_t{256} << 20;  // of an earlier measure.json

// ---- Who was asked for and is not run, and why: nobody is left out in silence

using Names = std::vector<std::string>;

// Those who do not run some problems, for one and the same reason.
struct Group {
  Names problems, solvers;
  std::string reason;
};

// Adds it to the group that has the same reason and the same `same`: that takes its `others`, too.
void add(std::vector<Group>& groups, Group one, Names Group::*same, Names Group::*others) {
  const auto found = std::ranges::find_if(groups, [&](const Group& group) {
    return group.*same == one.*same && group.reason == one.reason;
  });
  if (found == groups.end())
    groups.push_back(std::move(one));
  else
    ((*found).*others).push_back((one.*others)[0]);
}

// First solvers with one reason for a problem, then problems with the same solvers and reason.
std::vector<Group> grouped(std::span<const Unsuited> unsuited) {
  std::vector<Group> of_one, all;
  for (const Unsuited& one : unsuited)
    add(of_one, {{one.problem}, {one.solver}, one.reason}, &Group::problems, &Group::solvers);
  for (Group& one : of_one) add(all, std::move(one), &Group::solvers, &Group::problems);
  return all;
}

std::string words_of(const Group& group) {
  return fmt::format("{} {} not run by {}: {}", listed(group.problems),
                     group.problems.size() > 1 ? "are" : "is", listed(group.solvers), group.reason);
}

// What a name is before its colon, in small letters: "bullet" of "Bullet:10".
std::string engine_of(const std::string& name) {
  std::string engine = name.substr(0, name.find(':'));
  for (char& c : engine)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return engine;
}

// A line for each reason: "kepler is not run by MuJoCo:Euler and MuJoCo:RK4: MuJoCo has no forces
// between two bodies but tendons". Of other engines only if `with_peers`.
std::vector<std::string> unsuited_words(std::span<const Unsuited> unsuited, bool with_peers) {
  std::vector<Unsuited> told(unsuited.begin(), unsuited.end());
  if (!with_peers) std::erase_if(told, [](const Unsuited& one) { return one.is_peer; });
  Names lines;
  for (const Group& group : grouped(told)) lines.push_back(words_of(group));
  return lines;
}

// If `name` is that of another engine, in whatever letters: that it is no method, and which of the
// scenarios it does not run.
std::optional<std::string> about_peer(const std::string& name,
                                      const std::vector<Scenario>& scenarios) {
  Names missing;
  std::vector<std::unique_ptr<Solver>> same = load_peers(missing);
  std::erase_if(same, [&](const auto& peer) { return engine_of(peer->name()) != engine_of(name); });
  for (const std::string& line : missing)
    if (engine_of(line) == engine_of(name))
      return fmt::format("'{}' is no method but another engine. {}", name, line);
  if (same.empty()) return std::nullopt;
  std::vector<Unsuited> unsuited;
  for (const Scenario& scenario : scenarios)
    for (const auto& peer : same)
      if (const auto reason = why_not(*peer, scenario))
        unsuited.push_back({scenario.name, peer->name(), *reason, true});
  std::string text = fmt::format(
      "'{}' is no method but another engine: it is run beside the methods where it can", name);
  for (const Group& group : grouped(unsuited)) text += "; " + words_of(group);
  return text;
}

// ---- What is asked for

// A problem by name, all problems of a family, or a scenario file.
void add_scenarios(const std::string& word, std::vector<Scenario>& scenarios) {
  const std::vector<std::string_view> names = problem_names();
  const std::size_t before = scenarios.size();
  if (word.ends_with(".toml") || word.find('/') != std::string::npos)
    scenarios.push_back(load_scenario(word));
  else if (std::ranges::find(names, word) != names.end())
    scenarios.push_back(known_problem(word));
  else
    for (const std::string_view name : names)
      if (Scenario s = known_problem(name); s.problem && to_string(s.problem->solution) == word)
        scenarios.push_back(std::move(s));
  if (scenarios.size() > before) return;
  const std::string near = suggestion(word, names, 0);
  throw UsageError(fmt::format("there is no problem '{}'; {}", word,
                               near.empty() ? "'lantern measure --list' names them all" : near));
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
  plan.methods = options.methods;
  plan.steps = options.steps;
  for (const std::string& name : plan.methods) {
    if (can_be_measured_by(name)) continue;
    if (const auto words = about_peer(name, plan.scenarios)) throw UsageError(*words);
    throw UsageError(
        with_suggestion(fmt::format("there is no method '{}'", name), name, method_names()));
  }
  for (const double step : plan.steps)
    if (!std::isfinite(step) || step <= 0)
      throw UsageError(fmt::format("a time step of {} s is not allowed; it must be above 0", step));
  return plan;
}

int list_problems(bool as_json) {
  std::vector<std::vector<std::string>> rows = {{"problem", "family", "variant", "title"}};
  JsonWriter json = answer_of("measure.list");
  json.line().key("problems").begin_array();
  for (const std::string_view name : problem_names()) {
    const Scenario s = known_problem(name);
    const std::string_view family = to_string(s.problem->solution),
                           variant = to_string(s.problem->variant);
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
    const auto text = folder.earlier(kMeasurement, kMostMeasureBytes);
    if (!text) return {};
    auto earlier = read_measurement(*text, &why);
    if (earlier && same(earlier->circumstances, circumstances)) return std::move(earlier->rows);
  } catch (const IoError& e) {
    why = e.what();
  }
  if (!why.empty())
    warn(fmt::format("nothing is taken over from '{}': {}", (folder.path() / kMeasurement).string(),
                     why));
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
      // Rows of an earlier run that this one did not come to are kept.
      for (const Job& job : std::span(plan_.jobs()).subspan(done_))
        if (const Row* old = known(job)) measurement_.rows.push_back(*old);
    }
    save();
  }

  const Measurement& measurement() const { return measurement_; }

 private:
  void save() {
    if (std::ranges::any_of(measurement_.rows, &Row::was_run))
      folder_.write(kMeasurement, report::to_json(measurement_));
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
      const bool is_kept = finished(job) != nullptr;
      kept += is_kept;
      if (is_kept || !plan_.is_too_long(job)) continue;
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
  const std::vector<Bar> bars = options.problems.empty() ? measured_bars() : std::vector<Bar>();
  folder.write("report.html", to_html(document_of(std::span(&m, 1), bars)));
  std::vector<ReportPage> pages = {{"overview", draw_overview(m, bars)}};
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
  if (is_nothing && !stop_asked()) {
    complain("nothing was measured: no method applies, or every run is too long (--full)");
    return kFailed;
  }
  options.json ? answer(report::to_json(m)) : print(to_table(m));
  if (stop_asked()) {
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
    const fs::path path = fs::is_directory(word) ? fs::path(word) / kMeasurement : fs::path(word);
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

int measure(const MeasureOptions& options) {
  if (options.list) return list_problems(options.json);
  if (!options.from.empty()) return page_of_earlier(options);
  const std::vector<std::string>& words = options.problems;
  if (words.empty() || words[0] != "broad_phase") return measure_problems(options);
  const auto experiment = broad_phases({words.begin() + 1, words.end()}, options.full);
  return run_experiment(*experiment,
                        {"measure broad_phase", "broad_phase", as_typed(experiment->options()),
                         options.output, options.json, options.theme, true});
}

}  // namespace

app::Run begin_measure(Options& rows) {
  return command("", "", measure, measure_options).begin(rows);
}

}  // namespace lantern::lab
