// `check` and `explain`: runs of scenarios of which nothing is drawn.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/progress.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/json_writer.hpp"
#include "base/memory.hpp"
#include "base/number.hpp"
#include "run/tally.hpp"

namespace lantern::app {
namespace {

struct CheckOptions {
  std::vector<std::string> files;
  std::string pace;
  bool strict = false, json = false;
};

Options check_options(CheckOptions& o) {
  return {{"FILE", &o.files, kFilesHelp, {.required = true}},
          pace_option(o.pace),
          memory_option(),
          {"--strict", &o.strict, "turn warnings into errors (exit code 3)"},
          json_option(o.json)};
}

struct Verdict {
  std::string file;
  std::string name;  // empty if it could not be read
  int code = kGood;
  RunResult result;
  std::vector<Diagnostic> problems;
};

// Runs one scenario; what is wrong with it goes to standard error.
Verdict check_one(const std::string& file, const CheckOptions& options, Work& work) {
  Verdict verdict;
  verdict.file = file == "-" ? kStandardInput : file;
  try {
    const Scenario scenario = load_scenario(scenario_file(file));
    verdict.name = scenario.name;
    FrameSink nobody;
    verdict.result = run_scenario(scenario, pace_of(options.pace, scenario), nobody, work);
    verdict.code = tell(verdict.result, options.strict);
    verdict.problems = unmet_of(verdict.result);
    if (options.strict)
      std::ranges::move(std::exchange(verdict.result.warnings, {}),
                        std::back_inserter(verdict.problems));
  } catch (const ScenarioError& e) {
    verdict.code = exit_code_of(e);
    complain(e);
    verdict.problems = e.diagnostics();
  } catch (const IoError& e) {
    verdict.code = kFailed;
    complain(e.what());
    verdict.problems.emplace_back().message = e.what();
  }
  return verdict;
}

void write(JsonWriter& json, const char* key, const std::vector<Diagnostic>& diagnostics) {
  json.key(key).begin_array();
  for (const Diagnostic& d : diagnostics)
    json.begin_object()
        .members("line", d.where.line, "column", d.where.column, "message", d.message, "suggestion",
                 d.suggestion)
        .end_object();
  json.end_array();
}

void write(JsonWriter& json, const Verdict& v) {
  json.line().begin_object().member("file", v.file).key("name");
  v.name.empty() ? json.null() : json.value(v.name);
  json.member("good", v.code == kGood);
  json.member("frames", v.result.report.frames)
      .member("expectations", v.result.report.expectations);
  write(json, "problems", v.problems);
  write(json, "warnings", v.result.warnings);
  json.member("facts", v.result.facts).end_object();
}

// "x.toml: good; 8 frames, 1 expectation holds; 2 warnings"
std::string summary_of(const Verdict& v) {
  const std::uint64_t expectations = v.result.report.expectations;
  std::string text =
      fmt::format("{}: good; {}, {} {}", v.file, counted(v.result.report.frames, "frame"),
                  counted(expectations, "expectation"), expectations == 1 ? "holds" : "hold");
  for (const std::string& fact : v.result.facts) text += "; " + fact;
  if (!v.result.warnings.empty()) text += "; " + counted(v.result.warnings.size(), "warning");
  return text;
}

int check_scenarios(const CheckOptions& options) {
  Work work;
  JsonWriter json = answer_of("check");
  json.line().key("scenarios").begin_array();
  int code = kGood;
  for (const std::string& file : input_files(options.files)) {
    const Verdict v = check_one(file, options, work);
    code = std::max(code, v.code);
    write(json, v);
    if (v.code == kGood && !options.json) say(summary_of(v));
  }
  json.line().end_array().line().key("work");
  app::write(json, work);
  json.line().end_object();
  if (options.json) answer(json.text());
  return code;
}

struct ExplainOptions {
  std::string file;
  bool json = false;
};

Options explain_options(ExplainOptions& o) {
  return {{"FILE", &o.file, "scenario file; - is standard input", {.required = true}},
          memory_option(),
          json_option(o.json)};
}

// "60 searches, 1 candidate pair; 10.3 s passed": of amounts behind the first only what there is.
std::string told(const StageTally& stage) {
  std::string text;
  for (const Amount& a : stage.amounts)
    if (a.n > 0 || &a == &stage.amounts.front())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", lantern::grouped(a.n, " "),
                          a.n == 1 ? a.name : a.many);
  return text + (stage.note.empty() ? "" : "; ") + stage.note;
}

std::string json_of(const Scenario& scenario, const std::vector<StageTally>& stages,
                    std::uint64_t frames, double seconds) {
  JsonWriter json = answer_of("explain");
  json.line().member("scenario", scenario.name).member("frames", frames);
  json.member("seconds", seconds).line().key("stages").begin_array();
  for (const StageTally& stage : stages) {
    json.line().begin_object().member("stage", stage.stage).member("used", stage.used());
    json.key("counts").begin_object();
    for (const Amount& a : stage.amounts) json.member(a.many, a.n);
    json.end_object().member("note", stage.note).end_object();
  }
  json.line().end_array().line().end_object();
  return json.text();
}

int explain_scenario(const ExplainOptions& options) {
  const Scenario scenario = load_scenario(scenario_file(options.file));
  Work work;
  Tally tally(scenario, work);
  const Stopwatch watch;
  std::optional<Progress> progress;
  progress.emplace(scenario.name, extent_of(scenario, scenario.pace), work, memory_budget());
  std::uint64_t frames = 0;
  const DirectorReport report = direct(scenario, scenario.pace, work, [&](const Frame& frame) {
    tally.see(frame);
    progress->done(++frames);
    return true;
  });
  progress.reset();
  const double seconds = watch.seconds();
  const std::vector<StageTally> stages = tally.stages(report);
  if (options.json) {
    answer(json_of(scenario, stages, report.frames, seconds));
    return kGood;
  }
  std::vector<std::vector<std::string>> rows;
  for (const StageTally& stage : stages)
    rows.push_back({stage.used() ? "uses" : "leaves out", stage.stage, told(stage)});
  print(fmt::format("{}: {}\n\n{}\nCounted in a run without pixels: {} in {:.2g} s.\n",
                    scenario.name, scenario.title, table(rows), counted(report.frames, "frame"),
                    seconds));
  return kGood;
}

}  // namespace

Command check_command() {
  return command("check", "Run scenarios without drawing, verify expectations", check_scenarios,
                 check_options);
}

Command explain_command() {
  return command("explain", "Run a scenario without pixels, tell what each stage did",
                 explain_scenario, explain_options);
}

}  // namespace lantern::app
