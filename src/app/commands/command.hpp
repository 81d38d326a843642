// The table of commands: what the program reads its command line by, and what help, manual pages
// and completions are made from. A command is a row of it and a function.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/option.hpp"

namespace CLI {
class App;
}

namespace lantern::app {

// What a run of the program ends with.
enum ExitCode {
  kGood = 0,
  kFailed = 1,  // an expectation, a comparison, a file; silently, if nobody reads the output
  kUsage = 2,
  kBadScenario = 3,
  kNoBackend = 4,
  kInterrupted = 130,
};

// What the command line asks for; gives the exit code.
using Run = std::function<int()>;

struct Command {
  const char* name;
  const char* help;                    // in a line
  std::function<Run(Options&)> begin;  // gives its options, and what runs with their values
  std::vector<Command> commands = {};  // below it; then it does not run itself
  // Why it cannot be had, whatever stands behind it; empty if it can.
  std::function<std::string()> missing = {};
};

// A command whose options are read into `Values`.
template <class Values>
Command command(const char* name, const char* help, int (*run)(const Values&),
                Options (*options)(Values&)) {
  return {name, help, [run, options](Options& rows) -> Run {
            const auto values = std::make_shared<Values>();
            rows = options(*values);
            return [run, values] { return run(*values); };
          }};
}

// ---- Options of several commands

inline const Words kThemes = {"light", "dark", "print"};
inline const Words kBackends = {"auto", "osmesa", "egl"};
inline constexpr const char* kFilesHelp =
    "scenario files, folders of them (by 'lecture', then by name), or - for standard input";

Option json_option(bool& json);
// Of a command that has no other.
struct JsonOnly {
  bool json = false;
};
inline Options json_only(JsonOnly& o) { return {json_option(o.json)}; }
Option backend_option(std::string& backend, const char* help = "off-screen OpenGL");
Option pace_option(std::string& pace, const char* help = "as for render");
Option engine_option(std::string& file);
// Before a command, and after one that runs a scenario.
Option memory_option();
// The language of what is drawn, and a file of words for it.
Option language_option();
Option words_option();
// How much pictures may differ.
Option tolerance_option(int& tolerance);
Option fraction_option(double& fraction);

// Of the program and of each command: before and after its name.
Options manners();

// ---- The commands, a list of each source

std::vector<Command> drawing_commands();  // render and watch
std::vector<Command> playground_commands();
std::vector<Command> merge_commands();
std::vector<Command> inspecting_commands();  // check, list, explain and doctor
std::vector<Command> golden_commands();
std::vector<Command> compare_commands();
std::vector<Command> structure_commands();
std::vector<Command> lab_commands();     // measure, bench and stress (app/lab.hpp)
std::vector<Command> manual_commands();  // reference, schema, man and completions
std::vector<Command> help_commands();

// The words of this process's command line, without the program's name.
Words& command_line_words();
// Such words as they would be typed: "lantern bench step --pile boxes2d:500".
std::string command_text(const Words& words);
// In single quotes, as shells read them.
std::string in_quotes(std::string_view text);

// The program itself, with every command in the order of the help.
const Command& whole_program();

// What may stand where an option wants a value.
enum class ValueKind {
  none,      // it is a switch
  free,      // nothing that could be guessed: a number, a size
  words,     // one of `words`
  scenario,  // a scenario file
  folder,
  file,
};

// An option in words, for manual pages and completions.
struct OptionWords {
  Words names;        // "-o", "--output"; none for what stands by itself
  std::string value;  // "PATH"; empty for a switch
  ValueKind kind = ValueKind::none;
  Words words;             // of which one must be chosen
  std::string limits;      // "0 to 255"; empty for none
  std::string help;        // what it does, in a line
  std::string by_default;  // empty for none
  bool is_required = false, repeats = false;

  bool is_positional() const { return names.empty(); }
};

// A command with the names that lead to it, {"lantern", "bench", "step"}, and all options that its
// --help has, in that order.
struct CommandPath {
  Words names;
  const Command* command = nullptr;
  std::vector<OptionWords> options = {};

  // "lantern bench step", "lantern-bench-step"
  std::string name(std::string_view between) const;
};
// The program itself and all its commands, each before its own.
std::vector<CommandPath> all_commands();

// ---- Manual pages, in the macros of man(7), and completions for shells: they say what --help says

// "lantern.1", "lantern-bench-step.1"
std::string manual_file(const CommandPath& path);
// The page of one of all commands, or of the program itself, the first of them.
std::string manual_page(const CommandPath& path, const std::vector<CommandPath>& all);
// A script for "bash", "zsh" or "fish" that completes commands, options, and what may stand behind
// them; another word is a broken invariant.
std::string completions(std::string_view shell, const std::vector<CommandPath>& all);

// ---- Reading the command line (command_line.cpp: only there CLI11 is known)

// What the words ask for; nothing if they ask for help or the version, which is then printed. If
// they ask for JSON, an answer is owed from here on (app/terminal.hpp). Throws UsageError.
Run read_command_line(int argc, const char* const* argv);
// The help of the command that these words name, of the program for none: as its --help prints it.
// Throws UsageError if there is none.
std::string help_text(const Words& names);
// Every command, for CLI11. Parsing adds the options of the commands that it comes by, and sets
// `run`; both must outlive it.
void add_commands(CLI::App& app, Run& run);

// What the program ends with, and what it means.
struct ExitMeaning {
  int code;
  std::string_view means;
};
inline constexpr ExitMeaning kExitCodes[] = {
    {kGood, "good"},
    {kFailed, "failed"},
    {kUsage, "usage"},
    {kBadScenario, "scenario error"},
    {kNoBackend, "no graphics backend"},
    {kInterrupted, "interrupted"},
};

}  // namespace lantern::app
