// The module build/lantern_lab.so: what the program asks of it.
#include "app/lab.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/scenario_folder.hpp"
#include "base/check.hpp"
#include "embedded/version.hpp"
#include "lab/commands.hpp"
#include "lab/experiment_run.hpp"
#include "measure/peers.hpp"
#include "measure/row.hpp"
#include "report/benches.hpp"

namespace lantern::lab {
namespace {

Option folder_option(std::string& folder, const char* help) {
  return {"-o,--output", &folder, help, {.value = "DIR"}};
}

Options measure_options(MeasureOptions& o) {
  return {
      {"PROBLEM", &o.problems,
       "problems or families by name, or scenario files; the default is all problems; "
       "'broad_phase' measures the trees' settings"},
      folder_option(o.output, "folder for tables, plots and the overview page"),
      {"--method",
       &o.methods,
       "only these: velocity_verlet, soft:16, impulse:100, ...",
       {.value = "NAME", .one_each = true}},
      {"--step", &o.steps, "only these time steps, seconds", {.value = "H", .one_each = true}},
      {"--quick", &o.quick, "about a minute: plain problems, few repeats"},
      {"--full", &o.full, "every run, however long it takes", {.without = "--quick"}},
      longest_option("leave out runs that would take more seconds than this", o.longest),
      peers_option("without other engines", o.peers),
      {"--theme", &o.theme, "colours of the plots", {.words = kThemes}},
      backend_option(o.backend, "off-screen OpenGL, for the PNG files"),
      {"--list", &o.list, "name the problems, measure nothing"},
      {"--from",
       &o.from,
       "measure nothing: report.html of these folders or measure.json files, one a "
       "machine, side by side",
       {.value = "PATH"}},
      memory_option(),
      json_option(o.json),
  };
}

Options stress_options(StressOptions& o) {
  return {
      {"CASE", &o.cases, "names of cases; the default is all that are not slow"},
      folder_option(o.output, "folder for stress.csv, stress.json, stability_map.png and .svg"),
      {"--theme", &o.theme, "colours of the stability map", {.words = kThemes}},
      backend_option(o.backend),
      {"--list", &o.list, "list the cases and exit"},
      {"--full", &o.full, "run the slow cases, too"},
      memory_option(),
      json_option(o.json),
  };
}

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
  rows.push_back(app::memory_option());
  rows.push_back(app::json_option(bench->run.json));
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
  if (name == "measure") return command("", "", measure_command, measure_options).begin(rows);
  if (name == "stress") return command("", "", stress_command, stress_options).begin(rows);
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
