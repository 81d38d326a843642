// What the options of several commands have in common.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/command_line.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "base/suggest.hpp"

namespace lantern::app {

// An empty word is most often a shell variable that was never set.
inline const CLI::Validator kNotEmpty(
    [](const std::string& word) { return word.empty() ? "must not be empty" : std::string(); }, "");

// CLI11's own checks of a number let NaN pass.
inline const CLI::Validator kFinite(
    [](const std::string& word) {
      double number = 0;
      const bool is_number = CLI::detail::lexical_cast(word, number);
      return is_number && !std::isfinite(number) ? "must be a finite number" : std::string();
    },
    "");

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

inline void add_shard(CLI::App& command, std::string& words) {
  command
      .add_option("--shard", words,
                  "only the I-th of N parts, into DIR/shard-I-of-N; 'lantern merge' makes one of "
                  "them")
      ->type_name("I/N");
}

inline void add_seed(CLI::App& command, std::uint64_t& seed, const char* help) {
  command.add_option("--seed", seed, help)
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 53))
      ->type_name("S")
      ->capture_default_str();
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

// That `parent` has no command of this name, and which it has.
inline std::string no_command(const CLI::App& parent, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* one : parent.get_subcommands(nullptr)) names.push_back(one->get_name());
  const std::vector<std::string_view> known(names.begin(), names.end());
  return fmt::format("there is no command '{}'; {}", word,
                     known.empty() ? "see 'lantern help'" : suggestion(word, known, known.size()));
}

// On the program and on each of its commands: before and after the command's name.
inline void add_manners(CLI::App& app) {
  app.add_flag_callback("--quiet", be_quiet, "say nothing but errors and warnings")
      ->trigger_on_parse();
  app.add_option_function<std::string>(
         "--color",
         [](const std::string& when) {
           set_colour(when == "always"  ? ColourMode::always
                      : when == "never" ? ColourMode::never
                                        : ColourMode::automatic);
         },
         "colour in messages; auto asks the terminal, NO_COLOR and CLICOLOR_FORCE")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->trigger_on_parse()
      ->type_name("WHEN");
}

// A command that is no more than its name and help until words name it or its help is told: to make
// the options of all thirty takes longer than most of what the one asked for does.
class Command : public CLI::App {
 public:
  Command(const char* name, const char* help, std::function<void(CLI::App*)> add_options)
      : CLI::App(help, name, nullptr) {
    preparse_callback([this, add = std::move(add_options)](std::size_t) {
      const CLI::Option& parents_help = *get_parent()->get_help_ptr();
      set_help_flag(parents_help.get_name(false, true), parents_help.get_description());
      footer(get_parent()->get_footer());
      add(this);
      add_manners(*this);
      for (CLI::Option* one : get_options())
        if (one->get_items_expected_max() > 0) one->check(kNotEmpty);
    });
  }
  // Adds its options and commands if they are not there yet. Parsing does so by itself.
  void complete() { _trigger_pre_parse(0); }
};

inline void add_command(CLI::App& app, const char* name, const char* help,
                        std::function<void(CLI::App*)> add_options) {
  app.add_subcommand(std::make_shared<Command>(name, help, std::move(add_options)));
}

// Its options live as long as it can be run.
template <class Options>
void add_command(CLI::App& app, Run& run, const char* name, const char* help,
                 int (*start)(const Options&), void (*add_options)(CLI::App*, Options&)) {
  add_command(app, name, help, [&run, start, add_options](CLI::App* c) {
    const auto options = std::make_shared<Options>();
    add_options(c, *options);
    c->callback([&run, options, start] { run = [options, start] { return start(*options); }; });
  });
}

// The commands of `app` that are called so, or all of them; each with its options.
inline std::vector<CLI::App*> complete_commands(CLI::App& app,
                                                const std::optional<std::string>& name = {}) {
  const auto commands =
      app.get_subcommands([&](const CLI::App* one) { return !name || one->get_name() == *name; });
  for (CLI::App* one : commands) static_cast<Command*>(one)->complete();
  return commands;
}

}  // namespace lantern::app
