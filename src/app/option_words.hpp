// What the options of several commands have in common.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/command_line.hpp"
#include "base/memory.hpp"

namespace lantern::app {

// An empty word is most often a shell variable that was never set.
inline const CLI::Validator kNotEmpty(
    [](const std::string& word) { return word.empty() ? "must not be empty" : std::string(); }, "");

inline const std::vector<std::string> kThemes = {"light", "dark", "print"};
inline const std::vector<std::string> kBackends = {"auto", "osmesa", "egl"};

inline void add_json(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "print JSON instead of a table");
}

// One of some words.
inline CLI::Option& add_choice(CLI::App& command, const char* name, std::string& word,
                               const char* help, const std::vector<std::string>& words) {
  return *command.add_option(name, word, help)->check(CLI::IsMember(words))->capture_default_str();
}

// Before a command, and after one that runs a scenario.
inline void add_memory(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--memory",
          [](const std::string& words) {
            const auto bytes = memory_size(words);
            if (!bytes)
              throw CLI::ValidationError(
                  fmt::format("--memory: '{}' is no size from {} on; write 800M or 4G", words,
                              memory_text(kLeastBudget)));
            set_memory_budget(*bytes);
          },
          "memory to take at most, such as 800M or 4G; the default is half of the machine's")
      ->type_name("SIZE");
}

// A command and its options, which live as long as it can be run.
template <class Options>
std::pair<CLI::App*, Options&> command(CLI::App& app, Run& run, const char* name, const char* help,
                                       int (*start)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* c = app.add_subcommand(name, help);
  c->callback([&run, options, start] { run = [options, start] { return start(*options); }; });
  return {c, *options};
}

}  // namespace lantern::app
