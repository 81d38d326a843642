// What the program prints of itself: manual pages, completions, the reference page of the language,
// its pictures, and the schemas.
#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"
#include "draw/page.hpp"
#include "embedded/output_schema.hpp"
#include "embedded/version.hpp"
#include "language/language.hpp"
#include "language/scenario.hpp"
#include "language/words.hpp"
#include "render/png.hpp"
#include "render/renderer.hpp"
#include "render/svg.hpp"
#include "run/director.hpp"

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
  std::string text = bold(path.name(" "));
  if (!path.options.empty()) text += " [" + italic("OPTION") + "...]";
  if (!path.command->commands.empty()) text += " " + italic("COMMAND");
  for (const OptionWords& o : path.options)
    if (o.is_positional()) text += " " + placeholder(o);
  return ".SH SYNOPSIS\n" + text + "\n";
}

// Sentences: what it does, which words it takes, what it is without.
std::string sentences_on(const OptionWords& o) {
  std::string text = o.help;
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  if (!text.empty() && !text.ends_with('.')) text += ".";
  if (!o.words.empty()) text += fmt::format(" One of: {}.", fmt::join(o.words, ", "));
  if (!o.limits.empty()) text += fmt::format(" Allowed: {}.", o.limits);
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

std::string items_of(const CommandPath& path, bool positional, const char* title) {
  std::string text;
  for (const OptionWords& o : path.options)
    if (o.is_positional() == positional) text += manual_item(o);
  return text.empty() ? "" : fmt::format(".SH {}\n", title) + text;
}

std::string reference_to(std::string_view name) { return ".BR " + roff_escaped(name) + " (1)"; }

std::string commands_of(const CommandPath& path) {
  std::string text;
  for (const Command& c : path.command->commands)
    text += fmt::format(".TP\n{}\n{}", reference_to(path.name("-") + "-" + c.name),
                        paragraph(std::string(c.help) + "."));
  return text.empty() ? "" : ".SH COMMANDS\n" + text;
}

std::string exit_status() {
  std::string text = ".SH EXIT STATUS\n";
  for (const ExitMeaning& exit : kExitCodes)
    text += fmt::format(".TP\n.B {}\n{}", exit.code, paragraph(exit.means));
  return text;
}

// What holds for the program as a whole.
std::string surroundings() {
  return ".SH FILES\n.TP\n.I share/lantern/scenarios\n" +
         paragraph(
             "Scenarios that come with Lantern, beside the folder of the program. Where a scenario "
             "file is wanted, their names are enough: lantern render ghost_quadtree. The language "
             "is described in REFERENCE.md there, and by lantern reference.") +
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
std::string see_also(const CommandPath& path, const std::vector<CommandPath>& all) {
  Words others;
  for (const CommandPath& other : all) {
    const bool is_above = path.names.size() == other.names.size() + 1 &&
                          std::equal(other.names.begin(), other.names.end(), path.names.begin());
    const bool is_below = other.names.size() == path.names.size() + 1 &&
                          std::equal(path.names.begin(), path.names.end(), other.names.begin());
    if (is_above || is_below) others.push_back(other.name("-"));
  }
  std::string text = ".SH SEE ALSO\n";
  for (const std::string& name : others)
    text += reference_to(name) + (&name == &others.back() ? "\n" : " ,\n");
  return text;
}

struct ManualOptions {
  Words names;         // of a command; none for the program itself
  std::string folder;  // empty: one page is printed
};

Options manual_options(ManualOptions& o) {
  return {{"COMMAND", &o.names, "the command; the default is all of Lantern"},
          {"--dir", &o.folder, "write every page into this folder instead",
           OptionTraits{.value = "DIR", .without = "COMMAND"}}};
}

int write_manual(const ManualOptions& options) {
  const std::vector<CommandPath> all = all_commands();
  if (!options.folder.empty()) {
    make_folder(options.folder);
    for (const CommandPath& path : all)
      write_file(fs::path(options.folder) / manual_file(path), manual_page(path, all));
    return kGood;
  }
  const std::string name = fmt::format("{}", fmt::join(options.names, " "));
  const std::string whole = all.front().names[0] + (name.empty() ? "" : " ") + name;
  for (const CommandPath& path : all)
    if (path.name(" ") == whole) {
      write_stdout(manual_page(path, all));
      return kGood;
    }
  throw UsageError("there is no '{}'; 'lantern --help' names the commands", whole);
}

struct CompletionsOptions {
  std::string shell;
};

Options completions_options(CompletionsOptions& o) {
  return {{"SHELL", &o.shell, "the shell", {.words = {"bash", "zsh", "fish"}, .required = true}}};
}

int write_completions(const CompletionsOptions& options) {
  write_stdout(completions(options.shell, all_commands()));
  return kGood;
}

// ---- The reference page, its pictures, and the schemas

struct ReferenceOptions {
  std::string pictures;  // folder; empty: the page is printed
  std::string words, texts;
  std::string backend = "auto";
  bool json = false;
};

Options reference_options(ReferenceOptions& o) {
  return {
      {"--pictures", &o.pictures, "draw the page's pictures into this folder instead",
       OptionTraits{.value = "DIR"}},
      {"--words", &o.words, "print the table of fixed words of this language instead, such as de",
       OptionTraits{.value = "LANGUAGE"}},
      {"--texts", &o.texts, "print a table for the texts of this scenario in another language",
       OptionTraits{.value = "FILE"}},
      backend_option(o.backend),
      json_option(o.json)};
}

struct SchemaOptions {
  std::string of = "scenario";
};

Options schema_options(SchemaOptions& o) {
  return {{"--of", &o.of, "scenario files, or what commands print with --json",
           OptionTraits{.words = {"scenario", "output"}}}};
}

int print_schema(const SchemaOptions& o) {
  write_stdout(o.of == "output" ? std::string(output::output_schema_json) : json_schema());
  return kGood;
}

constexpr int kWidth = 320, kHeight = 180;  // pixels

Frame last_frame(const Scenario& scenario) {
  Work work;
  Frame last;
  direct(scenario, scenario.pace, work, [&](const Frame& frame) {
    stop_if_asked();
    last = frame;
    return true;
  });
  return last;
}

// What a picture is made from: the frame, and every shape that is drawn of it.
MadeFrom made_from_all(const Frame& frame, const DrawList& list, const Theme& theme) {
  const auto key = [](std::string_view text) {
    return fmt::format("{:016x}", Hash().add(text).value());
  };
  return {key(to_json(frame)), key(to_svg(list, theme, false, kWidth, kHeight))};
}

// Is it there, as it would be made now?
bool is_right(const fs::path& path, const MadeFrom& from) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 20;
  std::error_code error;
  return fs::is_regular_file(path, error) &&
         made_from(FileKind::png, read_file(path, kMostBytes)) == from;
}

int draw_pictures(const ReferenceOptions& options) {
  const fs::path folder = options.pictures;
  make_folder(folder);
  const Theme theme = *theme_named("light");
  constexpr int kPixelsPerMetre = 6299;
  std::optional<Renderer> renderer;  // made when the first picture is not there yet
  Image image;
  std::set<std::string> names;
  std::size_t drawn = 0;
  for (const ExamplePicture& picture : example_pictures()) {
    const Frame frame = last_frame(parse_scenario(picture.text, picture.name + ".toml"));
    Work work;
    const DrawList list = draw_frame(frame, page_for(kWidth, kHeight), work);
    const MadeFrom from = made_from_all(frame, list, theme);
    const fs::path path = folder / (picture.name + ".png");
    names.insert(path.filename().string());
    if (is_right(path, from)) continue;
    if (!renderer)
      renderer.emplace(Context::create(*backend_named(options.backend)), kWidth, kHeight);
    renderer->draw(list, theme, false, image);
    write_file(path, sealed(FileKind::png, encode_png(image, PngEffort::small, {}, kPixelsPerMetre),
                            from));
    ++drawn;
  }
  if (options.json)
    answer(answer_of("reference")
               .lines("folder", folder.string(), "pictures", names.size(), "drawn", drawn)
               .line()
               .end_object()
               .text());
  else
    print(fmt::format("{}: {}, {} of them new\n", folder.string(), counted(names.size(), "picture"),
                      drawn));
  return kGood;
}

int print_words(const std::string& language) {
  const std::string_view file = language::words_file(language);
  if (file.empty())
    throw UsageError(with_suggestion(fmt::format("there are no words for '{}'", language), language,
                                     language::languages()));
  write_stdout(std::string(file));
  return kGood;
}

int print_texts(const std::string& file) {
  std::string table = "language = \"\"  # such as \"de\"\n\n[texts]\n";
  for (const std::string& text : language::texts_of(load_scenario(scenario_file(file))))
    table += fmt::format("{} = \"\"\n", json_string(text));
  write_stdout(table);
  return kGood;
}

int print_reference(const ReferenceOptions& options) {
  if (!options.words.empty()) return print_words(options.words);
  if (!options.texts.empty()) return print_texts(options.texts);
  if (!options.pictures.empty()) return draw_pictures(options);
  if (options.json)
    answer(answer_of("reference")
               .line()
               .member("markdown", reference_page())
               .line()
               .end_object()
               .text());
  else
    write_stdout(reference_page());
  return kGood;
}

}  // namespace

std::string manual_file(const CommandPath& path) { return path.name("-") + ".1"; }

std::string manual_page(const CommandPath& path, const std::vector<CommandPath>& all) {
  const std::string title = path.name("-");
  std::string upper = title;
  std::ranges::transform(upper, upper.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string help = path.command->help;
  if (help.ends_with('.')) help.pop_back();
  return fmt::format(".TH {} 1 \"\" \"Lantern {}\" \"User Commands\"\n", roff_escaped(upper),
                     kVersion) +
         ".SH NAME\n" + roff_escaped(title) + " \\- " + roff_escaped(help) + "\n" +
         synopsis_of(path) + ".SH DESCRIPTION\n" + paragraph(help + ".") +
         items_of(path, true, "ARGUMENTS") + items_of(path, false, "OPTIONS") + commands_of(path) +
         (path.names.size() == 1 ? surroundings() : "") + exit_status() + see_also(path, all);
}

std::vector<Command> manual_commands() {
  return {command("reference", "Print the scenario language's reference page (Markdown)",
                  print_reference, reference_options),
          command("schema", "Print a JSON Schema", print_schema, schema_options),
          command("man", "Print a command's manual page, or write all of them", write_manual,
                  manual_options),
          command("completions", "Print the completions of a shell", write_completions,
                  completions_options)};
}

}  // namespace lantern::app
