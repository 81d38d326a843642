#include <algorithm>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/goldens.hpp"
#include "app/folders/kept_files.hpp"
#include "app/progress.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

struct GoldenOptions {
  GoldenOptions() { as.size = "640x360", as.png = "small"; }

  RenderOptions as;               // how frames are drawn, and which
  std::string folder = "golden";  // the golden frames are in folder/<scenario>
  bool update = false;            // today's frames become the golden ones
  std::string report;             // an HTML file, or a folder for golden.html; empty: the usual one
  std::string junit;              // an XML file; empty for none
  Allowance allowance;            // by how much they may differ
};

Options golden_options(GoldenOptions& o) {
  return {{"FILE", &o.as.files, "scenario files", {.required = true}},
          {"--update", &o.update, "make today's frames the golden ones: writes what changed"},
          {"--dir", &o.folder, "the golden frames are in DIR/<scenario>", {.value = "DIR"}},
          {"--report", &o.report,
           "page of what differs, with pictures side by side: a file, or a folder for "
           "golden.html; without it output/golden.html, made only if something differs",
           OptionTraits{.value = "PATH", .without = "--update"}},
          {"--junit", &o.junit, "findings as JUnit's XML, for whatever builds and tests",
           OptionTraits{.value = "FILE", .without = "--update"}},
          tolerance_option(o.allowance.tolerance),
          fraction_option(o.allowance.fraction),
          {"--size", &o.as.size, "pixels", {.value = "WxH"}},
          {"--theme", &o.as.theme, "colours", {.words = kThemes}},
          pace_option(o.as.pace),
          {"--frames", &o.as.frames, "as for render", {.value = "A-B"}},
          {"--at", &o.as.at, "as for render", {.value = "EVENT|TIME"}},
          backend_option(o.as.backend),
          language_option(),
          words_option(),
          memory_option(),
          json_option(o.as.json)};
}

constexpr std::size_t kMostShown = 30;  // frames whose pictures the page holds
constexpr const char* kUsualReport = "output/golden.html";

// What the options must say so that frames are made as the goldens were; empty if they are.
std::string other_words(const GoldenList::MadeWith& golden, const GoldenList::MadeWith& now) {
  std::string words;
  if (golden.size != now.size) words += " --size " + golden.size;
  if (golden.theme != now.theme) words += " --theme " + golden.theme;
  if (golden.pace != now.pace) words += " --pace " + golden.pace;
  return words;
}

// One run of the command.
class GoldenRun {
 public:
  explicit GoldenRun(const GoldenOptions& options) : options_(options), job_(options.as) {}

  int run() {
    make_ready();
    load();
    require_free(report_file());
    if (!options_.junit.empty()) {
      require_free(options_.junit);
      make_folder(folder_of(options_.junit));
    }
    json_.line().key("scenarios").begin_array();
    for (auto& [suite, scenario] : loaded_) {
      if (scenario) try_one(suite, *scenario);
      tell_of(suite);
      suites_.push_back(std::move(suite));
    }
    json_.line().end_array();
    const std::string report = write_reports();
    tell_end(report);
    if (!report.empty()) json_.line().member("report", report);
    json_.line().key("work");
    app::write(json_, work_);
    json_.line().end_object();
    if (options_.as.json) answer(json_.text());
    return code_;
  }

 private:
  void make_ready() const {
    std::error_code none;
    const auto resolved = [&](const fs::path& file) {
      return fs::weakly_canonical(fs::absolute(file, none), none);
    };
    if (!options_.junit.empty() && resolved(options_.junit) == resolved(report_file()))
      throw UsageError("--junit and --report name the same file");
    for (const fs::path& file : {fs::path(options_.junit), report_file()})
      if (file == "-") throw UsageError("--junit and --report write files, not standard output");
  }

  fs::path report_file() const {
    if (options_.report.empty()) return kUsualReport;
    const fs::path path = options_.report;
    std::error_code error;
    const bool folder = !path.has_filename() || fs::is_directory(path, error);
    return folder ? path / "golden.html" : path;
  }

  void load() {
    std::map<std::string, std::string> files;
    for (const std::string& file : input_files(options_.as.files)) {
      GoldenSuite suite;
      suite.scenario = suite.file = file;
      auto scenario = load_or_complain(file, code_, &suite.error);
      if (scenario) suite.scenario = scenario->name;
      if (scenario && !files.emplace(scenario->name, file).second)
        throw UsageError(
            "'{}' and '{}' are both scenarios named '{}'; they would have the same golden frames",
            files[scenario->name], file, scenario->name);
      loaded_.emplace_back(std::move(suite), std::move(scenario));
    }
  }

  // An error of this scenario lets the others run.
  void try_one(GoldenSuite& suite, const Scenario& scenario) {
    const auto note = [&](const std::exception& e, int code) {
      suite.error = e.what();
      code_ = std::max(code_, code);
    };
    try {
      one(suite, scenario);
    } catch (const ScenarioError& e) {
      complain(e);
      note(e, kBadScenario);
    } catch (const IoError& e) {
      complain(e.what());
      note(e, kFailed);
    }
    if (!suite.good()) code_ = std::max<int>(code_, kFailed);
  }

  void one(GoldenSuite& suite, const Scenario& scenario) {
    const ScenarioName name = name_of(scenario);
    const fs::path output = options_.folder;
    std::error_code none;
    const auto folder =
        fs::is_directory(output, none) ? Folder(output).find(name.text()) : std::nullopt;
    if (folder) require_kept_for(KeptFor::goldens, *folder);
    const Pace pace = pace_of(options_.as.pace, scenario);
    Selection selection(options_.as.frames, options_.as.at, extent_of(scenario, pace).frames);
    const auto list = folder ? read_list(*folder, selection) : std::nullopt;
    const Goldens goldens{
        job_, scenario, pace, selection, work_, name, output, folder, list.value_or(GoldenList())};
    const std::string words = list ? other_words(list->made_with, goldens.made_with()) : "";
    if (options_.update) return update(suite, goldens, words);
    if (!list) {
      suite.findings.push_back(
          fmt::format("there are no golden frames in '{}'; --update makes them",
                      (output / name.text()).string()));
    } else if (!words.empty()) {
      suite.findings.push_back(fmt::format(
          "the golden frames were made with{}; compare so, or --update makes others", words));
    } else {
      compare(suite, goldens);
    }
  }

  // A damaged list is no hindrance for a new one of all frames.
  std::optional<GoldenList> read_list(const Folder& folder, const Selection& selection) const try {
    return read_golden_list(folder);
  } catch (const DamagedGoldens&) {
    if (!options_.update || !selection.takes_all()) throw;
    return std::nullopt;
  }

  void compare(GoldenSuite& suite, const Goldens& goldens) {
    const GoldenList::MadeWith then = goldens.list.made_with, now = goldens.made_with();
    if (then.facts != now.facts)
      suite.findings.push_back(fmt::format(
          "the golden facts are {}, those of today {}; look at the pictures, then --update",
          then.facts, now.facts));
    run_it(suite, goldens,
           *make_golden_comparison(goldens, options_.allowance, suite, shown_left_));
    if (suite.first() != nullptr && then.version != now.version)
      suite.findings.push_back(fmt::format("the golden frames are of Lantern {}, this is {}",
                                           then.version, now.version));
  }

  void update(GoldenSuite& suite, const Goldens& goldens, const std::string& words) {
    if (!words.empty() && !goldens.selection.takes_all())
      throw UsageError("{}: the golden frames were made with{}; --update all frames",
                       goldens.scenario.name, words);
    GoldenChanges changes;
    run_it(suite, goldens, *make_golden_update(goldens, changes));
    changes_ = std::move(changes);
    for (const auto& [what, names] :
         {std::pair{"written", changes_.written}, std::pair{"removed", changes_.removed},
          std::pair{"left alone, since it is not as Lantern made it", changes_.strange}})
      if (!names.empty()) say(about_files(suite.scenario, what, names));
    if (changes_.written.empty() && changes_.removed.empty())
      say(fmt::format("{}: the golden frames are as they were", suite.scenario));
  }

  void run_it(GoldenSuite& suite, const Goldens& goldens, FrameSink& sink) {
    const RunResult result =
        run_scenario(goldens.scenario, goldens.pace, sink, work_, goldens.selection.most());
    code_ = std::max(code_, tell(result, false));
    suite.unmet_count = result.report.unmet.count();
    for (const Diagnostic& d : unmet_of(result)) suite.unmet.push_back(to_string(d));
  }

  void tell_of(const GoldenSuite& suite) {
    json_.line().begin_object().members("scenario", suite.scenario, "file", suite.file, "good",
                                        suite.good(), "frames", suite.cases.size(), "differing",
                                        suite.differing(), "unmet", suite.unmet_count);
    if (!suite.error.empty()) json_.member("error", suite.error);
    json_.member("findings", suite.findings);
    json_.line().key("frames_that_differ").begin_array();
    for (const GoldenCase& c : suite.cases)
      if (!c.findings.empty()) tell_of(c);
    json_.end_array();
    if (options_.update) {
      json_.members("written", changes_.written, "removed", changes_.removed);
      changes_ = {};
    }
    json_.end_object();
    std::string line;
    if (const GoldenCase* first = suite.first()) {
      line = fmt::format("{}, first {}: ", differing_of(suite.differing(), suite.cases.size()),
                         name_of(*first));
      for (const std::string& text : first->findings)
        line += (&text == &first->findings.front() ? "" : "; ") + text;
    }
    for (const std::string& text : suite.findings) line += (line.empty() ? "" : "; ") + text;
    if (!line.empty()) complain(fmt::format("{}: {}", suite.scenario, line));
  }

  void tell_of(const GoldenCase& c) {
    json_.line().begin_object().members("frame", c.frame, "event", c.event);
    json_.member("findings", c.findings);
    json_.key("facts").begin_array();
    for (const FactsDifference& d : c.facts.differences) {
      json_.begin_object();
      json_.members("path", d.path, "expected", d.expected, "found", d.actual).end_object();
    }
    json_.end_array().end_object();
  }

  // The page is made if frames differ or it is asked for. Its file, if there is one.
  std::string write_reports() const {
    if (!options_.junit.empty()) write_file(options_.junit, golden_junit(suites_));
    const auto differs = [](const GoldenSuite& s) { return s.first() != nullptr; };
    if (options_.report.empty() && std::ranges::none_of(suites_, differs)) return {};
    const fs::path page = report_file();
    make_folder(folder_of(page));
    write_file(page, golden_page(suites_, fmt::format("Lantern {}", kVersion)));
    return page.string();
  }

  void tell_end(const std::string& report) const {
    if (options_.update) return;
    std::size_t frames = 0;
    for (const GoldenSuite& s : suites_) frames += s.cases.size();
    const auto bad = std::ranges::count_if(suites_, [](const auto& s) { return !s.good(); });
    const std::string place = report.empty() ? "" : fmt::format("; see {}", report);
    say(fmt::format("{} of {} {}as expected{}",
                    bad == 0 ? counted(frames, "frame") : fmt::format("{}", bad),
                    counted(suites_.size(), "scenario"), bad == 0 ? "" : "not ", place));
  }

  const GoldenOptions& options_;
  RenderJob job_;
  std::vector<std::pair<GoldenSuite, std::optional<Scenario>>> loaded_;
  std::vector<GoldenSuite> suites_;
  std::size_t shown_left_ = kMostShown;
  GoldenChanges changes_;  // of the scenario that was updated last
  Work work_;
  JsonWriter json_ = answer_of("golden");
  int code_ = kGood;
};

}  // namespace

std::vector<Command> golden_commands() {
  return {command(
      "golden", "Compare scenarios' pictures and facts with golden ones, or update those",
      +[](const GoldenOptions& options) { return GoldenRun(options).run(); }, golden_options)};
}

}  // namespace lantern::app
