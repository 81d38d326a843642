#include <algorithm>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands/command.hpp"
#include "app/run_scenario.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"

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

// Frames that nobody looks at.
class NoSink : public FrameSink {
 public:
  void frame(const Frame&) override {}
  void finish(const DirectorReport&) override {}
};

struct Verdict {
  std::string file;
  std::string name;  // empty if it could not be read
  int code = kGood;
  DirectorReport report;
  std::vector<Diagnostic> problems;
  std::vector<Diagnostic> warnings;
  std::vector<std::string> facts;
};

// Runs one scenario; what is wrong with it goes to standard error.
Verdict check_one(const std::string& file, const CheckOptions& options, Work& work) {
  Verdict verdict;
  verdict.file = file == "-" ? kStandardInput : file;
  try {
    const Scenario scenario = load_scenario(scenario_file(file));
    verdict.name = scenario.name;
    NoSink sink;
    const RunResult result = run_scenario(scenario, pace_of(options.pace, scenario), sink, work);
    verdict.code = tell(result, options.strict);
    verdict.report = result.report;
    verdict.facts = result.facts;
    verdict.problems = unmet_of(result);
    auto& list = options.strict ? verdict.problems : verdict.warnings;
    list.insert(list.end(), result.warnings.begin(), result.warnings.end());
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
  json.member("frames", v.report.frames).member("expectations", v.report.expectations);
  write(json, "problems", v.problems);
  write(json, "warnings", v.warnings);
  json.member("facts", v.facts).end_object();
}

std::string joined_facts(const std::vector<std::string>& facts) {
  std::string all;
  for (const std::string& fact : facts) all += "; " + fact;
  return all;
}

// "x.toml: good; 8 frames, 1 expectation holds; 2 warnings"
std::string summary_of(const Verdict& v) {
  const std::uint64_t expectations = v.report.expectations;
  std::string text = fmt::format("{}: good; {}, {} {}{}", v.file, counted(v.report.frames, "frame"),
                                 counted(expectations, "expectation"),
                                 expectations == 1 ? "holds" : "hold", joined_facts(v.facts));
  if (!v.warnings.empty()) text += "; " + counted(v.warnings.size(), "warning");
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

}  // namespace

Command check_command() {
  return command("check", "Run scenarios without drawing, verify expectations", check_scenarios,
                 check_options);
}

}  // namespace lantern::app
