#include "app/manual.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include <fmt/format.h>

#include "app/command_line.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

// What roff would take for its own. A minus is one that can be copied into a shell.
std::string roff_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

// Lines of at most 78 columns, none of which roff takes for a request.
std::string paragraph(std::string_view text) {
  constexpr std::size_t kWidth = 78;
  std::istringstream words{std::string(text)};
  std::string out, line;
  for (std::string word; words >> word;) {
    std::string next = roff_escaped(word);
    if (next.starts_with('.') || next.starts_with('\'')) next = "\\&" + next;
    if (!line.empty() && line.size() + 1 + next.size() > kWidth) {
      out += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + next;
  }
  return out + line + (line.empty() ? "" : "\n");
}

std::string bold(std::string_view text) { return "\\fB" + roff_escaped(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff_escaped(text) + "\\fR"; }

// "FILE...", "[DIR...]"
std::string placeholder(const OptionWords& o) {
  const std::string word = italic(o.value) + (o.repeats ? "..." : "");
  return o.is_required ? word : "[" + word + "]";
}

std::string synopsis_of(const CommandPath& path) {
  std::string text = bold(joined(path.names, " "));
  if (!path.command->options.empty()) text += " [" + italic("OPTION") + "...]";
  if (!path.command->commands.empty()) text += " " + italic("COMMAND");
  for (const OptionWords& o : path.command->options)
    if (o.is_positional()) text += " " + placeholder(o);
  return ".SH SYNOPSIS\n" + text + "\n";
}

// CLI11 says NONNEGATIVE, POSITIVE, INT in [0 - 255].
std::string limits_in_words(std::string_view limits) {
  if (limits == "NONNEGATIVE") return "0 or more";
  if (limits == "POSITIVE") return "above 0";
  const auto from = limits.find('['), dash = limits.find(" - ");
  if (from == std::string_view::npos || dash == std::string_view::npos) return std::string(limits);
  return fmt::format("{} to {}", limits.substr(from + 1, dash - from - 1),
                     limits.substr(dash + 3, limits.find(']') - dash - 3));
}

// Sentences: what it does, which words it takes, what it is without.
std::string sentences_on(const OptionWords& o) {
  std::string text = o.help;
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  if (!text.empty() && !text.ends_with('.')) text += ".";
  if (!o.choices.empty()) text += fmt::format(" One of: {}.", fmt::join(o.choices, ", "));
  if (!o.limits.empty()) text += fmt::format(" Allowed: {}.", limits_in_words(o.limits));
  if (!o.by_default.empty()) text += fmt::format(" The default is {}.", o.by_default);
  if (o.repeats && !o.is_positional()) text += " May be given several times.";
  return text;
}

std::string manual_item(const OptionWords& o) {
  std::string head;
  for (const std::string& name : o.names) head += (head.empty() ? "" : ", ") + bold(name);
  if (o.is_positional())
    head = italic(o.value);
  else if (!o.value.empty())
    head += " " + italic(o.value);
  return ".TP\n" + head + "\n" + paragraph(sentences_on(o));
}

std::string options_of(const CommandWords& command, bool positional, const char* title) {
  std::string text;
  for (const OptionWords& o : command.options)
    if (o.is_positional() == positional) text += manual_item(o);
  return text.empty() ? "" : fmt::format(".SH {}\n", title) + text;
}

std::string reference_to(const std::vector<std::string>& names) {
  return ".BR " + roff_escaped(joined(names, "-")) + " (1)";
}

std::string commands_of(const CommandPath& path) {
  std::string text;
  for (const CommandWords& c : path.command->commands) {
    std::vector<std::string> names = path.names;
    names.push_back(c.name);
    text += ".TP\n" + reference_to(names) + "\n" + paragraph(c.help + ".");
  }
  return text.empty() ? "" : ".SH COMMANDS\n" + text;
}

std::string exit_status() {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : exit_codes())
    text += fmt::format(".TP\n.B {}\n{}", exit.code, paragraph(exit.means));
  return text;
}

// What holds for the program as a whole.
std::string surroundings() {
  return ".SH FILES\n.TP\n.I share/lantern/scenarios\n" +
         paragraph(
             "Scenarios that come with Lantern, beside the folder of the program. Where a "
             "scenario file is wanted, their names are enough: lantern render "
             "ghost_quadtree. The language is described in REFERENCE.md there, and by "
             "lantern reference.") +
         ".SH ENVIRONMENT\n.TP\n.B NO_COLOR\n" + paragraph("If set, messages have no colours.") +
         ".TP\n.B XDG_DATA_DIRS\n" +
         paragraph(
             "Folders in which lantern/scenarios is looked for, too; if not set, "
             "/usr/local/share and /usr/share.") +
         ".SH EXAMPLES\n.nf\n" +
         roff_escaped(
             "lantern list\nlantern render ghost_quadtree --at four\nlantern check first.toml") +
         "\n.fi\n";
}

// The pages above and below.
std::string see_also(const CommandPath& path, const CommandWords& root) {
  std::vector<std::vector<std::string>> others;
  for (const CommandPath& other : all_commands(root)) {
    const bool is_above = path.names.size() == other.names.size() + 1 &&
                          std::equal(other.names.begin(), other.names.end(), path.names.begin());
    const bool is_below = other.names.size() == path.names.size() + 1 &&
                          std::equal(path.names.begin(), path.names.end(), other.names.begin());
    if (is_above || is_below) others.push_back(other.names);
  }
  std::string text = ".SH SEE ALSO\n";
  for (const auto& names : others)
    text += reference_to(names) + (&names == &others.back() ? "\n" : " ,\n");
  return text;
}

}  // namespace

std::string manual_file(const CommandPath& path) { return joined(path.names, "-") + ".1"; }

std::string manual_page(const CommandPath& path, const CommandWords& root) {
  const CommandWords& command = *path.command;
  const bool is_root = path.names.size() == 1;
  std::string title = joined(path.names, "-");
  std::string upper = title;
  std::ranges::transform(upper, upper.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string help = command.help;
  if (help.ends_with('.')) help.pop_back();
  std::string text = fmt::format(".TH {} 1 \"\" \"Lantern {}\" \"User Commands\"\n",
                                 roff_escaped(upper), kVersion);
  text +=
      ".SH NAME\n" + roff_escaped(title) + " \\- " + roff_escaped(help) + "\n" + synopsis_of(path);
  text += ".SH DESCRIPTION\n" + paragraph(help + ".");
  text += options_of(command, true, "ARGUMENTS") + options_of(command, false, "OPTIONS");
  text += commands_of(path);
  if (is_root) text += surroundings();
  return text + exit_status() + see_also(path, root);
}

}  // namespace lantern::app
