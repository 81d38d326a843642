#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "scenario/director.hpp"

namespace lantern {
namespace {

struct Verdict {
  std::string file;
  int code = kGood;
  DirectorReport report;
  std::vector<Diagnostic> problems;
};

// Runs one scenario; what is wrong with it goes to standard error.
Verdict check_one(const std::string& file, const std::string& pace, Work& work) {
  Verdict verdict{file, kGood, {}, {}};
  try {
    const Scenario scenario = load_scenario(file);
    const Pace chosen = pace.empty() ? scenario.pace : pace == "event" ? Pace::event : Pace::step;
    verdict.report = direct(scenario, chosen, work, [](const Frame&) { return true; });
    if (!verdict.report.unmet.empty()) {
      verdict.code = kFailed;
      complain(ScenarioError(verdict.report.unmet));
      verdict.problems = verdict.report.unmet;
    }
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

void write(JsonWriter& json, const Verdict& v) {
  json.line().begin_object().member("file", v.file).member("good", v.code == kGood);
  json.member("frames", v.report.frames).member("expectations", v.report.expectations);
  json.key("problems").begin_array();
  for (const Diagnostic& d : v.problems)
    json.begin_object()
        .member("line", d.where.line)
        .member("column", d.where.column)
        .member("message", d.message)
        .member("suggestion", d.suggestion)
        .end_object();
  json.end_array().end_object();
}

}  // namespace

int check_command(const CheckOptions& options) {
  Work work;
  JsonWriter json;
  json.begin_object().key("scenarios").begin_array();
  int code = kGood;
  for (const std::string& file : options.files) {
    const Verdict v = check_one(file, options.pace, work);
    code = std::max(code, v.code);
    write(json, v);
    if (v.code == kGood && !options.json)
      say(fmt::format("{}: good; {} frames, {} expectations hold", file, v.report.frames,
                      v.report.expectations));
  }
  json.line().end_array().line().key("work").begin_object();
  for (const auto& [stage, count] : work.listed()) json.member(stage, count);
  json.end_object().line().end_object();
  if (options.json) write_stdout(json.text() + "\n");
  return code;
}

}  // namespace lantern
