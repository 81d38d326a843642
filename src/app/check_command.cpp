#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/terminal.hpp"
#include "app/warned.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/memory.hpp"
#include "draw/in_sight.hpp"
#include "scenario/director.hpp"
#include "scenario/warnings.hpp"

namespace lantern {
namespace {

struct Verdict {
  std::string file;
  int code = kGood;
  DirectorReport report;
  std::vector<Diagnostic> problems;
  std::vector<Diagnostic> warnings;
};

DirectorReport run(const Scenario& scenario, Pace pace, Work& work, RunWatch& watch) {
  Progress progress(scenario.name, extent_of(scenario, pace), work, memory_budget());
  std::uint64_t frames = 0;
  return direct(
      scenario, pace, work,
      [&](const Frame&) {
        progress.done(++frames);
        return true;
      },
      &watch);
}

// Runs one scenario; what is wrong with it goes to standard error.
Verdict check_one(const std::string& file, const CheckOptions& options, Work& work) {
  Verdict verdict{file, kGood, {}, {}, {}};
  try {
    const Scenario scenario = load_scenario(file);
    const Pace pace = options.pace.empty()      ? scenario.pace
                      : options.pace == "event" ? Pace::event
                                                : Pace::step;
    RunWatch watch(scenario, shows_a_body);
    verdict.report = run(scenario, pace, work, watch);
    verdict.problems = verdict.report.unmet;
    if (!verdict.problems.empty()) verdict.code = kFailed;
    complain(verdict.problems);
    const std::vector<Diagnostic> warnings = watch.warnings();
    verdict.code = std::max(verdict.code, tell_warnings(warnings, options.strict));
    auto& list = options.strict ? verdict.problems : verdict.warnings;
    list.insert(list.end(), warnings.begin(), warnings.end());
  } catch (const ScenarioError& e) {
    verdict.code = kBadScenario;
    complain(e);
    verdict.problems = e.diagnostics();
  } catch (const IoError& e) {
    verdict.code = kFailed;
    complain(e.what());
    Diagnostic unreadable;
    unreadable.message = e.what();
    verdict.problems.push_back(unreadable);
  }
  return verdict;
}

void write(JsonWriter& json, const char* key, const std::vector<Diagnostic>& diagnostics) {
  json.key(key).begin_array();
  for (const Diagnostic& d : diagnostics)
    json.begin_object()
        .member("line", d.where.line)
        .member("column", d.where.column)
        .member("message", d.message)
        .member("suggestion", d.suggestion)
        .end_object();
  json.end_array();
}

void write(JsonWriter& json, const Verdict& v) {
  json.line().begin_object().member("file", v.file).member("good", v.code == kGood);
  json.member("frames", v.report.frames).member("expectations", v.report.expectations);
  write(json, "problems", v.problems);
  write(json, "warnings", v.warnings);
  json.end_object();
}

std::string counted(const std::vector<Diagnostic>& warnings) {
  if (warnings.empty()) return "";
  return fmt::format("; {} warning{}", warnings.size(), warnings.size() > 1 ? "s" : "");
}

}  // namespace

int check_command(const CheckOptions& options) {
  Work work;
  JsonWriter json;
  json.begin_object().key("scenarios").begin_array();
  int code = kGood;
  for (const std::string& file : options.files) {
    const Verdict v = check_one(file, options, work);
    code = std::max(code, v.code);
    write(json, v);
    if (v.code == kGood && !options.json)
      say(fmt::format("{}: good; {} frames, {} expectations hold{}", file, v.report.frames,
                      v.report.expectations, counted(v.warnings)));
  }
  json.line().end_array().line().key("work").begin_object();
  for (const auto& [stage, count] : work.listed()) json.member(stage, count);
  json.end_object().line().end_object();
  if (options.json) write_stdout(json.text() + "\n");
  return code;
}

}  // namespace lantern
