// The module build/lantern_lab.so: what the program asks of it.
#include "app/lab.hpp"

#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/check.hpp"
#include "base/clock.hpp"
#include "base/file.hpp"
#include "base/stop.hpp"
#include "embedded/version.hpp"
#include "lab/commands.hpp"
#include "measure/row.hpp"
#include "measure/solvers.hpp"
#include "report/benches.hpp"

namespace lantern::lab {

Options report_options(ExperimentRun& as) {
  Options options = {{"-o,--output", &as.output, as.folder_help.c_str(), {.value = "DIR"}}};
  if (as.draws) {
    options.push_back({"--theme", &as.theme, "colours of the pictures", {.words = kThemes}});
    options.push_back(backend_option(as.backend, "off-screen OpenGL, for the PNG files"));
  }
  options.push_back(memory_option());
  options.push_back(json_option(as.json));
  return options;
}

namespace {

constexpr double kSaveEvery = 5;  // seconds

// A damaged file is told of, and not used.
void go_on_from(const ReportFolder& folder, const std::string& file, Experiment& experiment) {
  std::string why;
  std::optional<std::string> earlier;
  try {
    earlier = folder.earlier(file, kMostEarlierBytes);
  } catch (const IoError& e) {
    why = e.what();
  }
  if (const std::string unread = experiment.resume(earlier); why.empty()) why = unread;
  if (!why.empty())
    warn(fmt::format("nothing is taken over from '{}': {}", (folder.path() / file).string(), why));
}

void tell(const Texts& texts, bool as_json) {
  if (const std::string& text = as_json ? texts.json : texts.table; !text.empty())
    as_json ? answer(text) : print(text);
}

void write(const Texts& texts, const std::string& name, ReportFolder& folder) {
  for (const auto& [ending, text] :
       {std::pair{".html", &texts.html}, {".csv", &texts.csv}, {".json", &texts.json}})
    if (!text->empty()) folder.write(name + ending, *text);
  for (const auto& [file, text] : texts.more) folder.write(file, text);
}

app::Run begin_bench(const std::string& name, std::unique_ptr<Experiment> experiment,
                     Options& rows) {
  ExperimentRun as{"bench " + name, "bench_" + name};
  as.folder_help = fmt::format("folder for {0}.html, {0}.csv and {0}.json", as.file);
  return begin_experiment(std::move(experiment), std::move(as), rows);
}

// The commands, as the program names them.
app::Run begin(std::string_view name, Options& rows) {
  if (name == "bench frames") return begin_bench("frames", frames_bench(scenario_file), rows);
  if (name == "bench pairs") return begin_bench("pairs", pairs_bench(), rows);
  if (name == "bench atlas") return begin_bench("atlas", atlas_bench(), rows);
  if (name == "bench step") return begin_bench("step", step_bench(), rows);
  if (name == "measure") return begin_measure(rows);
  if (name == "stress")
    return begin_experiment(stress_experiment(),
                            {.command = "stress",
                             .file = "stress",
                             .folder_help = "folder for stress.csv, stress.json and the map",
                             .draws = true},
                            rows);
  LANTERN_CHECK(name, ==, std::string_view("a command of the lab"));
  return nullptr;
}

std::vector<std::string> engines(std::vector<std::string>& missing) {
  return mapped(load_peers(missing),
                [](const auto& peer) { return peer->name() + " " + peer->version(); });
}

constexpr Lab kLab{kSourceHash, begin, engines, box_peer_names, require_problem};

}  // namespace

int run_experiment(Experiment& experiment, const ExperimentRun& as) {
  try {
    if (const Texts listing = experiment.listing(); !listing.table.empty()) {
      tell(listing, as.json);
      return kGood;
    }
    experiment.set_circumstances(here(), "lantern " + as.command + as.typed);
    experiment.prepare();
    ReportFolder folder(as.output, as.file);
    const std::string kept = as.file + ".json";
    if (experiment.resumes()) go_on_from(folder, kept, experiment);
    for (const std::string& words : experiment.announcement()) say(words);
    try {
      Progress progress(as.command, experiment.stages(), experiment.unit());
      Stopwatch since_saved;
      experiment.run([&](const std::string& words) {
        progress.tell(words);
        if (since_saved.seconds() < kSaveEvery) return;
        if (const std::string rows = experiment.so_far(); !rows.empty()) folder.write(kept, rows);
        since_saved = {};
      });
    } catch (const Stopped&) {
      give_time_to_save();  // stages that are done are reported
    }
    for (const std::string& missing : experiment.missing()) say(missing);
    const Texts texts = experiment.texts();
    const bool some = std::ranges::count(texts.csv, '\n') != 1;  // behind the names of columns
    if (some) write(texts, as.file, folder);
    if (some && as.text) folder.write(as.file + ".txt", texts.table);
    tell(texts, as.json);
    if (stop_asked()) {
      complain(
          fmt::format("interrupted{}", experiment.resumes() ? "; the same command goes on from here"
                                       : some               ? "; what was done has been reported"
                                              : " before any work was done; nothing is written"));
      return kInterrupted;
    }
    if (folder.wanted() && as.draws) {
      const auto page = [](auto& one) { return ReportPage{one.name, std::move(one.list)}; };
      folder.draw(mapped(experiment.pages(), page), as.theme, as.backend);
    }
    folder.finish();
    if (!experiment.complaint().empty()) complain(experiment.complaint());
    if (folder.wanted() && experiment.is_good()) say("the report is in " + as.output);
    if (folder.wanted() && !experiment.picture_to_show().empty())
      say(fmt::format("to show it: {}/{}.png", as.output, experiment.picture_to_show()));
    return experiment.is_good() ? kGood : kFailed;
  } catch (const Refused& refused) {
    throw UsageError(refused.what());
  }
}

app::Run begin_experiment(std::unique_ptr<Experiment> experiment, ExperimentRun as, Options& rows) {
  struct Begun {
    std::unique_ptr<Experiment> experiment;
    ExperimentRun as;
    Options options;
  };
  const auto begun = std::make_shared<Begun>(std::move(experiment), std::move(as));
  rows = begun->options = begun->experiment->options();
  std::ranges::move(report_options(begun->as), std::back_inserter(rows));
  return [begun] {
    begun->as.typed = as_typed(begun->options);
    return run_experiment(*begun->experiment, begun->as);
  };
}

}  // namespace lantern::lab

extern "C" const lantern::app::Lab* lantern_lab() { return &lantern::lab::kLab; }
