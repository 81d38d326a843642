#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "lab/commands.hpp"
#include "language/method.hpp"
#include "measure/plan.hpp"
#include "measure/solvers.hpp"
#include "report/benches.hpp"
#include "report/document.hpp"
#include "report/measure_document.hpp"
#include "report/pages.hpp"

namespace lantern::lab {
namespace {

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
  try {
    scenarios.push_back(load_scenario(scenario_file(word)));
  } catch (const IoError&) {
    const std::string near = suggestion(word, names, 0);
    throw UsageError("there is no problem '{}'; {}", word,
                     near.empty() ? "'lantern measure --list' names them all" : near);
  }
}

bool same(const Circumstances& a, const Circumstances& b) {
  return a.version == b.version && a.sources == b.sources && a.compiler == b.compiler &&
         a.flags == b.flags && a.processor == b.processor && a.effort == b.effort;
}

// What is finished is on the disk every few seconds, and is not run again.
class Measure : public Experiment {
 public:
  const std::vector<std::string>& words() const { return problems_; }
  const std::vector<std::string>& earlier_pages() const { return from_; }
  bool is_full() const { return full_; }

  Options options() override {
    return {{"PROBLEM", &problems_,
             "problems or families by name, or scenario files; the default is all problems; "
             "'broad_phase' measures the trees' settings"},
            {"--method", &methods_, "only these: velocity_verlet, soft:16, impulse:100, ...",
             OptionTraits{.value = "NAME", .one_each = true}},
            {"--step", &steps_, "only these time steps, seconds", {.value = "H", .one_each = true}},
            {"--quick", &quick_, "two minutes: plain problems, few repeats, no long runs"},
            {"--full", &full_, "every run, however long it takes", {.without = "--quick"}},
            longest_option("leave out runs that would take more seconds than this", longest_),
            peers_option("without other engines", peers_),
            {"--list", &list_, "name the problems, measure nothing"},
            {"--from", &from_,
             "measure nothing: report.html of these folders or measure.json files, one a "
             "machine, side by side",
             OptionTraits{.value = "PATH"}}};
  }

  Texts listing() const override {
    if (!list_) return {};
    std::vector<std::vector<std::string>> rows = {{"problem", "family", "variant", "title"}};
    JsonWriter json = answer_of("measure.list");
    json.line().key("problems").begin_array();
    for (const std::string_view name : problem_names()) {
      const Scenario s = known_problem(name);
      const std::string_view family = to_string(s.problem->solution),
                             variant = to_string(s.problem->variant);
      rows.push_back({s.name, std::string(family), std::string(variant), s.title});
      json.line().object("name", s.name, "family", family, "variant", variant, "title", s.title);
    }
    json.line().end_array().line().end_object();
    return {table(rows), "", json.text(), ""};
  }

  void set_circumstances(Circumstances circumstances, std::string /*command*/) override {
    measurement_.circumstances = std::move(circumstances);
    measurement_.circumstances.effort = quick_ ? "quick" : full_ ? "full" : "normal";
  }

  void prepare() override {
    planned_.scenarios = scenarios();
    planned_.effort = quick_ ? Effort::quick : full_ ? Effort::full : Effort::normal;
    planned_.peers = peers_;
    planned_.longest = longest_;
    planned_.methods = methods_;
    planned_.steps = steps_;
    for (const std::string& name : methods_) {
      if (can_be_measured_by(name)) continue;
      if (const auto words = about_peer(name, planned_.scenarios)) throw UsageError(*words);
      throw UsageError(
          with_suggestion(fmt::format("there is no method '{}'", name), name, method_names()));
    }
    for (const double step : steps_)
      if (!std::isfinite(step) || step <= 0)
        throw UsageError("a time step of {} s is not allowed; it must be above 0", step);
  }

  bool resumes() const override { return true; }
  // Rows are taken that were made under the same circumstances.
  std::string resume(const std::optional<std::string>& earlier) override {
    std::string why;
    if (earlier)
      if (auto read = read_measurement(*earlier, &why);
          read && same(read->circumstances, measurement_.circumstances))
        known_ = std::move(read->rows);
    plan_.emplace(std::move(planned_), [](const Scenario&) {});
    measurement_.peers = plan_->peers();
    for (const Job& job : plan_->jobs()) left_ += expected(job);
    return why;
  }

  // How much there is to do, how long it will take, and what is left out.
  std::vector<std::string> announcement() const override {
    // Of all problems some suit no other engine: only who asks for a few is told.
    std::vector<std::string> lines = unsuited_words(plan_->unsuited(), !problems_.empty());
    std::size_t kept = 0, long_ones = 0;
    const Job* longest = nullptr;
    for (const Job& job : plan_->jobs()) {
      const bool is_kept = finished(job) != nullptr;
      kept += is_kept;
      if (is_kept || !plan_->is_too_long(job)) continue;
      ++long_ones;
      if (!longest || plan_->seconds(job) > plan_->seconds(*longest)) longest = &job;
    }
    lines.push_back(fmt::format("{}, about {}{}", counted(stages() - kept - long_ones, "run"),
                                duration_text(left_),
                                kept ? fmt::format("; {} are finished from before", kept) : ""));
    std::ranges::copy(plan_->missing_peers(), std::back_inserter(lines));
    if (longest)
      lines.push_back(
          fmt::format("{} left out as too long, by estimate; the longest ({}, {} at {:.3g} s) "
                      "would take {:.2g} s. --full runs them all",
                      long_ones == 1 ? "1 run is" : fmt::format("{} runs are", long_ones),
                      plan_->scenario(*longest).name, plan_->solver(*longest).name(), longest->step,
                      plan_->seconds(*longest)));
    return lines;
  }

  std::string unit() const override { return "runs"; }
  std::size_t stages() const override { return plan_->jobs().size(); }

  void run(const std::function<void(const std::string&)>& tell) override {
    try {
      while (done_ < stages()) measure_next_problem(tell);
    } catch (const Stopped&) {
      // Rows of an earlier run that this one did not come to are kept.
      for (const Job& job : std::span(plan_->jobs()).subspan(done_))
        if (const Row* old = known(job)) measurement_.rows.push_back(*old);
      throw;
    }
    measurement_.circumstances.load_at_end = load_of_machine();
    if (problems_.empty()) bars_ = measured_bars();  // they belong to the whole
  }

  std::string so_far() const override { return was_run() ? to_json(measurement_) : ""; }

  // The tables of all, and all on one web page; of one that was cut what the next goes on from.
  Texts texts() const override {
    if (!is_good()) return {};
    const Measurement& m = measurement_;
    if (done_ < stages()) return {to_table(m), "", so_far(), ""};
    return {to_table(m),
            to_csv(m),
            to_json(m),
            "",
            {{"drift.csv", drift_csv(m)},
             {"circumstances.csv", to_csv(m.circumstances)},
             {"peers.csv", to_csv(m.peers)},
             {"report.html", to_html(document_of(std::span(&m, 1), bars_))}}};
  }

  // A page of plots for each problem, and the overview.
  std::vector<Picture> pages() const override {
    const Measurement& m = measurement_;
    if (!was_run()) return {};
    std::vector<Picture> pages = {{"overview", draw_overview(m, bars_)}};
    for (const ProblemRows& problem : by_problem(m.rows)) {
      pages.push_back({problem.problem + "_slide", draw_slide(problem, m)});
      pages.push_back({problem.problem, draw_problem(problem, m)});
      if (auto drift = draw_drift(problem, m))
        pages.push_back({problem.problem + "_drift", std::move(*drift)});
    }
    if (!m.peers.empty()) pages.push_back({"peers", draw_peers(m)});
    return pages;
  }

  std::string picture_to_show() const override {
    const std::vector<Row>& rows = measurement_.rows;
    const bool one = was_run() && std::ranges::all_of(rows, [&](const Row& row) {
                       return row.problem == rows[0].problem;
                     });
    return one ? rows[0].problem + "_slide" : "";
  }

  bool is_good() const override { return was_run() || done_ < stages(); }
  std::string complaint() const override {
    return is_good() ? ""
                     : "nothing was measured: no method applies, or every run is too long (--full)";
  }

 private:
  std::vector<Scenario> scenarios() const {
    std::vector<Scenario> scenarios;
    for (const std::string& word : problems_) add_scenarios(word, scenarios);
    if (!problems_.empty()) return scenarios;
    for (const std::string_view name : problem_names()) {
      Scenario scenario = known_problem(name);
      const bool plain = scenario.problem && scenario.problem->variant == ProblemVariant::plain;
      if (!quick_ || plain) scenarios.push_back(std::move(scenario));
    }
    return scenarios;
  }

  bool was_run() const { return std::ranges::any_of(measurement_.rows, &Row::was_run); }

  const Row* known(const Job& job) const {
    const Scenario& scenario = plan_->scenario(job);
    const Solver& solver = plan_->solver(job);
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
    return finished(job) || plan_->is_too_long(job) ? 0 : plan_->seconds_with_repeats(job);
  }

  // All of its runs, but for those that are finished: they are timed in turn.
  void measure_next_problem(const std::function<void(const std::string&)>& tell) {
    stop_if_asked();
    const std::span<const Job> rest = std::span(plan_->jobs()).subspan(done_);
    std::vector<Job> jobs;
    std::size_t count = 0;
    for (; count < rest.size() && rest[count].scenario == rest[0].scenario; ++count)
      if (!finished(rest[count])) jobs.push_back(rest[count]);
    const std::string& name = plan_->scenario(rest[0]).name;
    double left = left_;
    std::vector<Row> rows = plan_->run(jobs, [&](double seconds) {
      left = std::max(0.0, left - seconds);
      tell(fmt::format("{} of {} runs done, now {}, about {} left", done_, stages(), name,
                       duration_text(left)));
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

  std::vector<std::string> problems_;  // names, families or files; empty for all
  std::vector<std::string> methods_;   // empty for those of each problem
  std::vector<double> steps_;          // seconds; empty for those of each problem
  std::vector<std::string> from_;      // earlier measurements: only their page is made
  bool quick_ = false, full_ = false, peers_ = true, list_ = false;
  std::optional<double> longest_;  // processor seconds of one run; longer ones are left out

  PlanOptions planned_;
  std::optional<Plan> plan_;
  Measurement measurement_;
  std::vector<Bar> bars_;
  std::vector<Row> known_;  // of an earlier run
  std::size_t done_ = 0;    // jobs whose rows are there
  double left_ = 0;         // seconds that the others will take
};

// One web page of what was measured before, here or elsewhere.
int page_of_earlier(const std::vector<std::string>& from, const ExperimentRun& as) {
  std::vector<Measurement> measurements;
  for (const std::string& word : from) {
    const fs::path path = fs::is_directory(word) ? fs::path(word) / kMeasurement : fs::path(word);
    std::string why;
    auto read = read_measurement(read_input(path, kMostEarlierBytes), &why);
    if (!read)
      throw UsageError("'{}' is no measurement that 'lantern measure' has written: {}",
                       path.string(), why);
    measurements.push_back(std::move(*read));
  }
  ReportFolder folder(as.output, "measure_page");
  folder.write("report.html", to_html(document_of(measurements, {})));
  folder.finish();
  const std::string page = (folder.path() / "report.html").string();
  say(fmt::format("the page is {}", page));
  if (as.json)
    answer(answer_of("measure.page").line().member("file", page).line().end_object().text());
  return kGood;
}

}  // namespace

app::Run begin_measure(Options& rows) {
  struct Begun {
    Measure measure;
    ExperimentRun as{.command = "measure",
                     .file = "measure",
                     .output = "output/measure",
                     .folder_help = "folder for tables, plots and the overview page",
                     .draws = true};
  };
  const auto begun = std::make_shared<Begun>();
  rows = begun->measure.options();
  std::ranges::move(report_options(begun->as), std::back_inserter(rows));
  return [begun] {
    auto& [measure, as] = *begun;
    const std::vector<std::string>& words = measure.words();
    if (!measure.earlier_pages().empty()) return page_of_earlier(measure.earlier_pages(), as);
    if (words.empty() || words[0] != "broad_phase") return run_experiment(measure, as);
    const auto trees =
        broad_phases(mapped(std::span(words).subspan(1), scenario_file), measure.is_full());
    as.command = "measure broad_phase";
    as.file = "broad_phase";
    as.typed = as_typed(trees->options());
    as.text = true;
    return run_experiment(*trees, as);
  };
}

}  // namespace lantern::lab
