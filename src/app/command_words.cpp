#include "app/command_words.hpp"

#include <algorithm>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/option_words.hpp"

namespace lantern::app {
namespace {

// CLI11 describes a choice as TEXT:{a,b}, limits as INT:INT in [0 - 255].
void read_type(std::string_view type, OptionWords& o) {
  const auto colon = type.find(':');
  o.value = std::string(type.substr(0, colon));
  if (colon == std::string_view::npos) return;
  const std::string_view rest = type.substr(colon + 1);
  if (!rest.starts_with('{')) {
    o.limits = std::string(rest);
    return;
  }
  std::istringstream words(std::string(rest.substr(1, rest.find('}') - 1)));
  for (std::string word; std::getline(words, word, ',');) o.choices.push_back(word);
  if (o.value == "TEXT") o.value = "WORD";
}

ValueKind kind_of(const OptionWords& o) {
  if (!o.choices.empty()) return ValueKind::words;
  if (o.value.empty()) return ValueKind::none;
  if (o.is_positional() && (o.value == "FILE" || o.value == "PROBLEM")) return ValueKind::scenario;
  if (o.value == "DIR") return ValueKind::folder;
  for (const char* word : {"PATH", "FILE", "EXPECTED", "ACTUAL"})
    if (o.value == word) return ValueKind::file;
  return ValueKind::free;
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords o;
  for (const std::string& name : option.get_snames()) o.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) o.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) read_type(option.get_type_name(), o);
  if (option.get_positional()) o.value = option.get_name(true);
  o.kind = kind_of(o);
  o.help = option.get_description();
  o.by_default = option.get_default_str();
  o.is_required = option.get_required();
  o.repeats = option.get_items_expected_max() > 1;
  return o;
}

CommandWords command_of(CLI::App& app, std::string name) {
  CommandWords c{std::move(name), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) c.options.push_back(words_of(*option));
  for (CLI::App* command : complete_commands(app))
    if (!command->get_group().empty())
      c.commands.push_back(command_of(*command, command->get_name()));
  return c;
}

// What wants the name of a command gets their names.
void offer_commands(CommandWords& command, const std::vector<std::string>& names) {
  for (OptionWords& o : command.options) {
    if (!o.is_positional() || o.value != "COMMAND" || !o.choices.empty()) continue;
    o.choices = names;
    o.kind = ValueKind::words;
  }
  for (CommandWords& c : command.commands) offer_commands(c, names);
}

void add_all(const CommandWords& command, std::vector<std::string> names,
             std::vector<CommandPath>& all) {
  names.push_back(command.name);
  all.push_back({names, &command});
  for (const CommandWords& c : command.commands) add_all(c, names, all);
}

}  // namespace

CommandWords words_of(CLI::App& app) {
  CommandWords root = command_of(app, "lantern");
  std::vector<std::string> names;
  for (const CommandWords& c : root.commands) names.push_back(c.name);
  offer_commands(root, names);
  return root;
}

std::vector<CommandPath> all_commands(const CommandWords& root) {
  std::vector<CommandPath> all;
  add_all(root, {}, all);
  return all;
}

std::string joined(const std::vector<std::string>& names, std::string_view between) {
  return fmt::format("{}", fmt::join(names, between));
}

}  // namespace lantern::app
