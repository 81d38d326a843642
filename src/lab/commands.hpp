// The lab's commands, and how every experiment of the lab is run, reported and ended.
#pragma once

#include <string>

#include "app/commands/command.hpp"
#include "report/experiment.hpp"

namespace lantern::lab {

inline constexpr std::size_t kMostEarlierBytes = std::size_t{256} << 20;  // of a run's JSON

struct ExperimentRun {
  std::string command;      // "bench atlas"
  std::string file;         // of its files, without an ending: "bench_atlas"
  std::string typed = "";   // its options, each with a space before it
  std::string output = "";  // folder; empty for none
  std::string folder_help = "folder for tables, plots and pages";
  bool json = false;
  bool draws = false;  // it has pictures
  std::string theme = "light", backend = "auto";
  bool text = false;  // the table as a file, too
};

// As Command::begin, they give their options, and what runs with their values.
app::Run begin_measure(Options& rows);
app::Run begin_experiment(std::unique_ptr<Experiment> experiment, ExperimentRun as, Options& rows);
std::unique_ptr<Experiment> stress_experiment();

// The options of every experiment: where its files go, how it draws, what it prints.
Options report_options(ExperimentRun& as);

// Gives the exit code. After an interruption what was done is reported.
int run_experiment(Experiment& experiment, const ExperimentRun& as);

}  // namespace lantern::lab
