#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands/command.hpp"
#include "app/progress.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/clock.hpp"
#include "base/json_writer.hpp"
#include "base/memory.hpp"
#include "base/number.hpp"
#include "run/tally.hpp"

namespace lantern::app {
namespace {

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
  DirectorReport report;
  const Stopwatch watch;
  {
    Progress progress(scenario.name, extent_of(scenario, scenario.pace), work, memory_budget());
    std::uint64_t frames = 0;
    report = direct(scenario, scenario.pace, work, [&](const Frame& frame) {
      tally.see(frame);
      progress.done(++frames);
      return true;
    });
  }
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

Command explain_command() {
  return command("explain", "Run a scenario without pixels, tell what each stage did",
                 explain_scenario, explain_options);
}

}  // namespace lantern::app
