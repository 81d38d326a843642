#include "app/commands/command.hpp"

#include <iterator>
#include <sstream>
#include <type_traits>

#include <fmt/format.h>

#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"

namespace lantern::app {
namespace {

std::optional<std::string> read_memory(const std::string& words) {
  const auto bytes = memory_size(words);
  if (!bytes)
    return fmt::format("--memory: '{}' is no size from {} on; write 800M or 4G", words,
                       memory_text(kLeastBudget));
  set_memory_budget(*bytes);
  return std::nullopt;
}

std::optional<std::string> read_colour(const std::string& when) {
  set_colour(when == "always"  ? ColourMode::always
             : when == "never" ? ColourMode::never
                               : ColourMode::automatic);
  return std::nullopt;
}

template <class Value>
constexpr bool is_vector = false;
template <class Value>
constexpr bool is_vector<std::vector<Value>> = true;

// As CLI11 calls the type of what is taken.
template <class Value>
const char* type_of(Value* /*to*/) {
  using Taken = typename TakenBy<Value>::Type;
  return std::is_same_v<Taken, int>             ? "INT"
         : std::is_same_v<Taken, double>        ? "FLOAT"
         : std::is_same_v<Taken, std::uint64_t> ? "UINT"
                                                : "TEXT";
}

// Only words that are there and numbers are told; so is a switch's state not.
template <class Value>
std::string default_of(Value* to) {
  if constexpr (std::is_same_v<Value, std::string>) return *to;
  if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>)
    return fmt::format("{}", *to);
  return "";
}

ValueKind kind_of(const OptionWords& o) {
  if (!o.words.empty()) return ValueKind::words;
  if (o.value.empty()) return ValueKind::none;
  if (o.is_positional() && (o.value == "FILE" || o.value == "PROBLEM")) return ValueKind::scenario;
  if (o.value == "DIR") return ValueKind::folder;
  for (const char* word : {"PATH", "FILE", "EXPECTED", "ACTUAL"})
    if (o.value == word) return ValueKind::file;
  return ValueKind::free;
}

OptionWords words_of(const Option& option) {
  OptionWords o;
  o.help = option.help;
  o.words = option.is.words;
  o.is_required = option.is.required;
  o.repeats = std::visit([]<class T>(T* /*to*/) { return is_vector<T>; }, option.to);
  const bool is_switch =
      std::holds_alternative<bool*>(option.to) || std::holds_alternative<void (*)()>(option.to);
  const std::string_view names = option.names;
  if (names.starts_with('-') || names.starts_with('!')) {
    std::istringstream each(option.names + names.starts_with('!'));
    for (std::string name; std::getline(each, name, ',');) o.names.push_back(name);
    o.value = *option.is.value != '\0'
                  ? option.is.value
                  : std::visit([](auto* to) { return type_of(to); }, option.to);
    if (o.value == "TEXT" && !o.words.empty()) o.value = "WORD";
  } else {
    o.value = names;
  }
  if (is_switch) o.value.clear();
  if (names == "COMMAND")
    for (const Command& one : whole_program().commands) o.words.emplace_back(one.name);
  if (option.is.above_0) o.limits = "above 0";
  if (option.is.least < option.is.most)
    o.limits = fmt::format("{} to {}", option.is.least, option.is.most);
  o.by_default = std::visit([](auto* to) { return default_of(to); }, option.to);
  o.kind = kind_of(o);
  return o;
}

void add_all(const Command& command, Words names, std::vector<CommandPath>& all) {
  names.emplace_back(command.name);
  Options rows = {{"-h,--help", +[] {}, "Print this help message and exit"}};
  if (all.empty())
    rows.push_back({"--version", +[] {}, "Display program version information and exit"});
  Options own;
  const Run run = command.begin ? command.begin(own) : nullptr;  // holds what they read into
  for (const Options& more : {own, manners()}) rows.insert(rows.end(), more.begin(), more.end());
  CommandPath& path = all.emplace_back(CommandPath{names, &command});
  for (const Option& row : rows) path.options.push_back(words_of(row));
  for (const Command& below : command.commands) add_all(below, names, all);
}

std::string for_a_shell(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == word.npos) return word;
  return in_quotes(word);
}

}  // namespace

Option json_option(bool& json) { return {"--json", &json, "print JSON instead of a table"}; }

Option backend_option(std::string& backend, const char* help) {
  return {"--backend", &backend, help, {.words = kBackends}};
}

Option pace_option(std::string& pace, const char* help) {
  return {"--pace", &pace, help, {.words = {"step", "event"}}};
}

Option engine_option(std::string& file) {
  return {"--engine", &file,
          "the engine of live pages; the default is lantern.wasm, beside the program or installed",
          OptionTraits{.value = "FILE"}};
}

Option memory_option() {
  return {"--memory", &read_memory,
          "memory to take at most, such as 800M or 4G; the default is half of the machine's",
          OptionTraits{.value = "SIZE"}};
}

Option language_option() {
  return {"--language", &wording().language,
          "language of a picture's fixed words in place of the scenario's, such as de",
          OptionTraits{.value = "LANGUAGE"}};
}

Option words_option() {
  return {"--words", &wording().words, "file with the words of another language",
          OptionTraits{.value = "FILE"}};
}

Option tolerance_option(int& tolerance) {
  return {"--tolerance", &tolerance, "by how many levels a channel may differ", {.most = 255}};
}

Option fraction_option(double& fraction) {
  return {"--fraction", &fraction, "fraction of the pixels that may differ", {.most = 1}};
}

Options manners() {
  return {{"--quiet", &be_quiet, "say nothing but errors and warnings"},
          {"--color", &read_colour,
           "colour in messages; auto asks the terminal, NO_COLOR and CLICOLOR_FORCE",
           OptionTraits{.value = "WHEN", .words = {"auto", "always", "never"}}}};
}

Words& command_line_words() {
  static Words words;
  return words;
}

std::string in_quotes(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string command_text(const Words& words) {
  std::string text = "lantern";
  for (const std::string& word : words) text += " " + for_a_shell(word);
  return text;
}

const Command& whole_program() {
  static const Command program = [] {
    Command all{"lantern",
                "Lantern renders lecture scenarios about spatial partitioning as pictures.",
                [](Options& rows) -> Run {
                  rows = {memory_option()};
                  return nullptr;
                }};
    for (std::vector<Command> (*some)() :
         {drawing_commands, playground_commands, merge_commands, inspecting_commands,
          golden_commands, compare_commands, structure_commands, lab_commands, manual_commands,
          help_commands})
      std::ranges::move(some(), std::back_inserter(all.commands));
    return all;
  }();
  return program;
}

std::string CommandPath::name(std::string_view between) const {
  return fmt::format("{}", fmt::join(names, between));
}

std::vector<CommandPath> all_commands() {
  std::vector<CommandPath> all;
  add_all(whole_program(), {}, all);
  return all;
}

}  // namespace lantern::app
