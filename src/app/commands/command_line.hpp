// Reading the command line by the table of commands. Only this unit knows CLI11.
#pragma once

#include <string>

#include "app/commands/command.hpp"

namespace CLI {
class App;
}

namespace lantern::app {

// What the words ask for; nothing if they ask for help or the version, which is then printed. If
// they ask for JSON, an answer is owed from here on (app/answer.hpp). Throws UsageError.
Run read_command_line(int argc, const char* const* argv);

// The help of the command that these words name, of the program for none: as its --help prints it.
// Throws UsageError if there is none.
std::string help_text(const Words& names);

// Every command, for CLI11. Parsing adds the options of the commands that it comes by, and sets
// `run`; both must outlive it.
void add_commands(CLI::App& app, Run& run);

}  // namespace lantern::app
