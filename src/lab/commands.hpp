// The lab's commands, and how every experiment of the lab is run, reported and ended.
#pragma once

#include <string>

#include "app/commands/command.hpp"
#include "report/experiment.hpp"

namespace lantern::lab {

// As Command::begin: they give their options, and what runs with their values.
app::Run begin_measure(Options& rows);
app::Run begin_stress(Options& rows);

Option folder_option(std::string& folder, const char* help);

struct ExperimentRun {
  std::string command;      // "bench atlas"
  std::string file;         // of its files, without an ending: "bench_atlas"
  std::string typed = "";   // its options, each with a space before it
  std::string output = "";  // folder; empty for none
  bool json = false;
  std::string theme = "light";  // of its pictures
  bool text = false;            // the table as a file, too
};

// Gives the exit code. After an interruption what was done is reported.
int run_experiment(Experiment& experiment, const ExperimentRun& as);

}  // namespace lantern::lab
