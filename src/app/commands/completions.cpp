#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "base/check.hpp"

namespace lantern::app {
namespace {

std::string spaced(const Words& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::string names_of_commands(const CommandPath& path) {
  Words names;
  for (const Command& c : path.command->commands) names.emplace_back(c.name);
  return spaced(names);
}

// "bench step"; nothing for the program itself.
std::string below_root(const CommandPath& path) {
  return spaced({path.names.begin() + 1, path.names.end()});
}

// What an option, or a word by itself, may be, as the shells offer it: bash calls a function, zsh
// has an action, fish has flags. {} are the words.
struct Offer {
  ValueKind kind;
  const char *bash, *zsh, *fish;
};
constexpr Offer kOffers[] = {
    {ValueKind::none, "return", " ", ""},
    {ValueKind::free, "return", " ", ""},
    {ValueKind::words, "_lantern_words {}", "({})", " -a {}"},
    {ValueKind::scenario, "_lantern_scenarios", "_lantern_scenarios",
     " -k -a '(__fish_complete_suffix .toml; lantern list --names 2>/dev/null)'"},
    {ValueKind::folder, "_lantern_folders", "_files -/", " -a '(__fish_complete_directories)'"},
    {ValueKind::file, "_lantern_files", "_files", " -F"},
};

std::string offer(const char* Offer::*shell, const OptionWords& o, const std::string& words) {
  const auto row = std::ranges::find(kOffers, o.kind, &Offer::kind);
  return fmt::format(fmt::runtime(row->*shell), words);
}

// ---- bash

std::string bash_offer(const OptionWords& o) {
  return offer(&Offer::bash, o, in_quotes(spaced(o.words)));
}

std::string bash_values(const CommandPath& path) {
  std::string text;
  for (const OptionWords& o : path.options) {
    if (o.is_positional() || o.kind == ValueKind::none) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : o.names)
      patterns.push_back(in_quotes(below_root(path) + " " + name));
    const std::string offer = o.kind == ValueKind::free ? "" : bash_offer(o) + "; ";
    text += fmt::format("    {}) {}return ;;\n", fmt::join(patterns, " | "), offer);
  }
  return text;
}

std::string bash_rest(const CommandPath& path) {
  std::string otherwise = "return";
  Words names;
  for (const OptionWords& o : path.options) {
    if (o.is_positional() && otherwise == "return") otherwise = bash_offer(o);
    names.insert(names.end(), o.names.begin(), o.names.end());
  }
  if (!path.command->commands.empty())
    otherwise = "_lantern_words " + in_quotes(names_of_commands(path));
  return fmt::format("    {})\n      if [[ $cur == -* ]]; then _lantern_words {}; else {}; fi ;;\n",
                     in_quotes(below_root(path)), in_quotes(spaced(names)), otherwise);
}

constexpr const char* kBashHead =
    R"bash(# Completion for bash: put it where bash-completion looks, or source it.
_lantern_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }
_lantern_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -- "$cur")
}
_lantern_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$cur")
}
_lantern_scenarios() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$cur"; compgen -d -- "$cur"
    [[ -z $cur || $cur == */* ]] || compgen -W "$("${COMP_WORDS[0]}" list --names 2>/dev/null)" -- "$cur")
}
_lantern() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command="" i
  COMPREPLY=()
  # --theme=dark comes as three words.
  if [[ $cur == "=" ]]; then cur=""; elif [[ $prev == "=" ]]; then prev=${COMP_WORDS[COMP_CWORD-2]}; fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$command ${COMP_WORDS[i]}" in
)bash";

std::string for_bash(const std::vector<CommandPath>& all) {
  std::string text = kBashHead;
  for (const CommandPath& path : all) {
    if (path.names.size() == 1) continue;
    const std::string above = spaced({path.names.begin() + 1, path.names.end() - 1});
    text += fmt::format("      {}) command={} ;;\n", in_quotes(above + " " + path.names.back()),
                        in_quotes(below_root(path)));
  }
  text += "    esac\n  done\n  case \"$command $prev\" in\n";
  for (const CommandPath& path : all) text += bash_values(path);
  text += "  esac\n  case $command in\n";
  for (const CommandPath& path : all) text += bash_rest(path);
  return text + "  esac\n}\ncomplete -F _lantern lantern\n";
}

// ---- zsh

std::string zsh_function(const CommandPath& path) { return "_" + path.name("_"); }

// Brackets and colons divide a line of _arguments.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_option(const OptionWords& o) {
  std::string text;
  const std::string value = o.kind == ValueKind::none ? ""
                                                      : ":" + zsh_text(o.value) + ":" +
                                                            offer(&Offer::zsh, o, spaced(o.words));
  for (const std::string& name : o.names) {
    const std::string others = o.repeats ? "*" : fmt::format("({})", fmt::join(o.names, " "));
    const bool takes_equals = !value.empty() && name.starts_with("--");  // --theme=dark
    const std::string spec =
        fmt::format("{}{}{}[{}]{}", others, name, takes_equals ? "=" : "", zsh_text(o.help), value);
    text += " \\\n    " + in_quotes(spec);
  }
  return text;
}

std::string zsh_arguments(const CommandPath& path, const char* flags) {
  std::string text = std::string("  _arguments ") + flags;
  for (const OptionWords& o : path.options)
    if (!o.is_positional()) text += zsh_option(o);
  for (const OptionWords& o : path.options)
    if (o.is_positional())
      text +=
          " \\\n    " + in_quotes(fmt::format("{}:{}:{}", o.repeats ? "*" : "", zsh_text(o.value),
                                              offer(&Offer::zsh, o, spaced(o.words))));
  return text;
}

// A command that has commands of its own: their names, then whatever they take.
std::string zsh_branches(const CommandPath& path) {
  std::string names, branches;
  for (const Command& c : path.command->commands) {
    names += "\n    " + in_quotes(zsh_text(c.name) + ":" + zsh_text(c.help));
    branches += fmt::format("        {}) {}_{} ;;\n", c.name, zsh_function(path), c.name);
  }
  return fmt::format(
      "  local state line\n  local -a commands=({})\n{} \\\n    ': :->command' '*:: :->rest'\n"
      "  case $state in\n    command) _describe command commands ;;\n    rest)\n"
      "      case $words[1] in\n{}      esac ;;\n  esac\n",
      names,
      std::string("  local curcontext=$curcontext\n") + zsh_arguments(path, "-s -S -A \"-*\" -C"),
      branches);
}

std::string for_zsh(const std::vector<CommandPath>& all) {
  std::string text =
      "#compdef lantern\n_lantern_scenarios() {\n  local -a names=(${(f)\"$(lantern list --names "
      "2>/dev/null)\"})\n  _alternative 'files:file:_files -g \"*.toml\"' "
      "'names:scenario:compadd -a names'\n}\n";
  for (const CommandPath& path : all)
    text += fmt::format(
        "{}() {{\n{}}}\n", zsh_function(path),
        path.command->commands.empty() ? zsh_arguments(path, "-s -S") + "\n" : zsh_branches(path));
  return text + "_lantern \"$@\"\n";
}

// ---- fish

// When these words are of this command, and of none below it.
std::string fish_condition(const CommandPath& path) {
  std::vector<std::string> parts;
  for (std::size_t i = 1; i < path.names.size(); ++i)
    parts.push_back("__fish_seen_subcommand_from " + path.names[i]);
  if (!path.command->commands.empty())
    parts.push_back("not __fish_seen_subcommand_from " + names_of_commands(path));
  return in_quotes(fmt::format("{}", fmt::join(parts, "; and ")));
}

std::string fish_line(const CommandPath& path, const OptionWords& o) {
  std::string names;
  for (const std::string& name : o.names)
    names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const bool takes = !o.is_positional() && o.kind != ValueKind::none;
  return fmt::format("complete -c lantern -n {}{}{}{} -d {}\n", fish_condition(path), names,
                     takes ? (o.kind == ValueKind::file ? " -r" : " -x") : "",
                     offer(&Offer::fish, o, in_quotes(spaced(o.words))), in_quotes(o.help));
}

std::string for_fish(const std::vector<CommandPath>& all) {
  std::string text = "complete -c lantern -f\n";
  for (const CommandPath& path : all) {
    for (const Command& c : path.command->commands)
      text += fmt::format("complete -c lantern -n {} -a {} -d {}\n", fish_condition(path), c.name,
                          in_quotes(c.help));
    for (const OptionWords& o : path.options)
      if (!o.is_positional() || o.kind != ValueKind::free) text += fish_line(path, o);
  }
  return text;
}

}  // namespace

std::string completions(std::string_view shell, const std::vector<CommandPath>& all) {
  if (shell == "bash") return for_bash(all);
  if (shell == "zsh") return for_zsh(all);
  LANTERN_CHECK(shell, ==, "fish");
  return for_fish(all);
}

}  // namespace lantern::app
