// The module build/lantern_lab.so: what the program asks of it.
#include "app/lab.hpp"

#include <utility>

#include <fmt/format.h>

#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/check.hpp"
#include "base/stop.hpp"
#include "embedded/version.hpp"
#include "lab/commands.hpp"
#include "measure/peers.hpp"
#include "measure/row.hpp"
#include "report/benches.hpp"

namespace lantern::lab {

Option folder_option(std::string& folder, const char* help) {
  return {"-o,--output", &folder, help, {.value = "DIR"}};
}

int run_experiment(Experiment& experiment, const ExperimentRun& as) {
  try {
    experiment.set_circumstances(here(), "lantern " + as.command + as.typed);
    experiment.prepare();
    ReportFolder folder(as.output, as.file);
    if (const std::string words = experiment.announcement(); !words.empty()) say(words);
    try {
      Progress progress(as.command, experiment.stages(), experiment.unit());
      experiment.run([&](const std::string& words) { progress.tell(words); });
    } catch (const Stopped&) {
      give_time_to_save();  // stages that are done are reported
    }
    for (const std::string& missing : experiment.missing()) say(missing);
    const Texts texts = experiment.texts();
    folder.write(as.file + ".html", texts.html);
    folder.write(as.file + ".csv", texts.csv);
    if (as.text) folder.write(as.file + ".txt", texts.table);
    folder.write(as.file + ".json", texts.json);
    as.json ? answer(texts.json) : print(texts.table);
    if (stop_asked()) {
      complain(
          fmt::format("interrupted; the {} that were done have been reported", experiment.unit()));
      return kInterrupted;
    }
    if (folder.wanted()) {
      std::vector<ReportPage> pages;
      for (auto& [name, list] : experiment.pages()) pages.push_back({name, std::move(list)});
      folder.draw(pages, as.theme);
    }
    folder.finish();
    if (!experiment.complaint().empty()) complain(experiment.complaint());
    return experiment.is_good() ? kGood : kFailed;
  } catch (const Refused& refused) {
    throw UsageError(refused.what());
  }
}

namespace {

// A bench registers its own options; all are run, reported and ended alike.
app::Run begin_bench(const std::string& name, std::unique_ptr<Experiment> experiment,
                     Options& rows) {
  struct Bench {
    std::unique_ptr<Experiment> experiment;
    ExperimentRun run;
    std::string folder_help;
    Options options;
  };
  const auto bench = std::make_shared<Bench>();
  bench->experiment = std::move(experiment);
  bench->run = {"bench " + name, "bench_" + name};
  bench->folder_help = fmt::format("folder for {0}.html, {0}.csv and {0}.json", bench->run.file);
  rows = bench->options = bench->experiment->options();
  rows.push_back(folder_option(bench->run.output, bench->folder_help.c_str()));
  rows.push_back(memory_option());
  rows.push_back(json_option(bench->run.json));
  return [bench] {
    bench->run.typed = as_typed(bench->options);
    return run_experiment(*bench->experiment, bench->run);
  };
}

// The commands, as the program names them.
app::Run begin(std::string_view name, Options& rows) {
  if (name == "bench frames") return begin_bench("frames", frames_bench(scenario_file), rows);
  if (name == "bench pairs") return begin_bench("pairs", pairs_bench(), rows);
  if (name == "bench atlas") return begin_bench("atlas", atlas_bench(), rows);
  if (name == "bench step") return begin_bench("step", step_bench(), rows);
  if (name == "measure") return begin_measure(rows);
  if (name == "stress") return begin_stress(rows);
  LANTERN_CHECK(name, ==, std::string_view("a command of the lab"));
  return nullptr;
}

std::vector<std::string> engines(std::vector<std::string>& missing) {
  std::vector<std::string> found;
  for (const auto& peer : load_peers(missing))
    found.push_back(peer->name() + " " + peer->version());
  return found;
}

constexpr Lab kLab{kSourceHash, begin, engines, box_peer_names, require_problem};

}  // namespace
}  // namespace lantern::lab

extern "C" const lantern::app::Lab* lantern_lab() { return &lantern::lab::kLab; }
