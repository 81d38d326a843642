#include "lab/experiment_run.hpp"

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands/command.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/terminal.hpp"
#include "base/stop.hpp"

namespace lantern::lab {

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
    if (interrupted()) {
      complain(
          fmt::format("interrupted; the {} that were done have been reported", experiment.unit()));
      return kInterrupted;
    }
    if (folder.wanted()) {
      std::vector<app::ReportPage> pages;
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

}  // namespace lantern::lab
