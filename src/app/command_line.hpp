// The commands and their options, as tables: what the program reads, and what help, manual pages
// and completions are made from.
#pragma once

#include <functional>
#include <span>
#include <string_view>

namespace CLI {
class App;
}

namespace lantern::app {

// What the command line asks for; gives the exit code.
using Run = std::function<int()>;

// Every command of Lantern, in the order of the help. Parsing adds the options of the commands that
// it comes by, and sets `run`; both must outlive it.
void add_commands(CLI::App& app, Run& run);

// Of these: measure, bench and stress.
void add_lab_commands(CLI::App& app, Run& run);

// Of these: man and completions, which are made from all of them.
void add_manual_commands(CLI::App& app, Run& run);

// What the program ends with, and what it means.
struct ExitMeaning {
  int code;
  std::string_view means;
};
std::span<const ExitMeaning> exit_codes();

}  // namespace lantern::app
