// The table of commands as plain words: what manual pages and completions are made from, so that
// they say what --help says.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace lantern::app {

// What may stand where an option wants a value.
enum class ValueKind {
  none,      // it is a switch
  free,      // nothing that could be guessed: a number, a size
  words,     // one of `choices`
  scenario,  // a scenario file
  folder,
  file,
};

struct OptionWords {
  std::vector<std::string> names;    // "-o", "--output"; none for what stands by itself
  std::string value;                 // "PATH"; empty for a switch
  ValueKind kind = ValueKind::none;  // of the value
  std::vector<std::string> choices;
  std::string limits;      // "INT in [0 - 255]"; empty for none
  std::string help;        // what it does, in a line
  std::string by_default;  // empty for none
  bool is_required = false;
  bool repeats = false;

  bool is_positional() const { return names.empty(); }
};

struct CommandWords {
  std::string name;  // "lantern", "render"; of a command of a command its own, "step"
  std::string help;
  std::vector<OptionWords> options;  // in the order of --help
  std::vector<CommandWords> commands;
};

// Of the whole program: what add_commands() made of `app`, with the options of all commands.
CommandWords words_of(CLI::App& app);

// A command with the names that lead to it, {"lantern", "bench", "step"}.
struct CommandPath {
  std::vector<std::string> names;
  const CommandWords* command = nullptr;
};

// The program itself and all its commands, each before its own; `root` must outlive them.
std::vector<CommandPath> all_commands(const CommandWords& root);

// "lantern bench step", "lantern-bench-step"
std::string joined(const std::vector<std::string>& names, std::string_view between);

}  // namespace lantern::app
