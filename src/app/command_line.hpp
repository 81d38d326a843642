// The commands and their options, as tables: what the program reads, and what help, manual pages
// and completions are made from.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace lantern::app {

// What the command line asks for; gives the exit code.
using Run = std::function<int()>;

// Every command of Lantern, in the order of the help. Parsing sets `run`; both must outlive it.
void add_commands(CLI::App& app, Run& run);

// Of these: measure, bench and stress.
void add_lab_commands(CLI::App& app, Run& run);

}  // namespace lantern::app
