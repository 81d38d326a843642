// The lab's commands: what each is told, and its exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/command.hpp"

namespace lantern::lab {

struct MeasureOptions {
  std::vector<std::string> problems;  // names, families or files; empty for all
  std::string output = "output/measure";
  std::vector<std::string> methods;  // empty for those of each problem
  std::vector<double> steps;         // seconds; empty for those of each problem
  std::vector<std::string> from;     // earlier measurements: only their page is made
  bool quick = false;
  bool full = false;
  std::optional<double> longest;  // processor seconds of one run; longer ones are left out
  bool peers = true;
  std::string theme = "light";
  std::string backend = "auto";
  bool list = false;
  bool json = false;
};
int measure_command(const MeasureOptions& options);

struct StressOptions {
  std::vector<std::string> cases;  // names; empty for all that are not slow
  std::string output;              // folder; empty for none
  std::string theme = "light";
  std::string backend = "auto";  // auto, osmesa, egl
  bool list = false;
  bool full = false;  // the slow ones, too
  bool json = false;
};
int stress_command(const StressOptions& options);

}  // namespace lantern::lab
