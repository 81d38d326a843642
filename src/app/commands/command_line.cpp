#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/terminal.hpp"
#include "base/suggest.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

// An empty word is most often a shell variable that was never set.
std::string require_some(const std::string& word) {
  return word.empty() ? "must not be empty" : std::string();
}

// CLI11's own checks of a number let NaN pass.
std::string require_finite(const std::string& word) {
  double number = 0;
  const bool is_number = CLI::detail::lexical_cast(word, number);
  return is_number && !std::isfinite(number) ? "must be a finite number" : std::string();
}

void add_limits(CLI::Option& made, const OptionTraits& is, auto number) {
  using Number = decltype(number);
  if (is.above_0) made.check(CLI::PositiveNumber);
  if (is.least < is.most)
    made.check(CLI::Range(static_cast<Number>(is.least), static_cast<Number>(is.most)));
  if (std::is_same_v<Number, double> && (is.above_0 || is.least < is.most))
    made.check(require_finite);
}

CLI::Option* add_to(CLI::App& app, const Option& o, bool* to) {
  return app.add_flag(o.names, *to, o.help);
}

CLI::Option* add_to(CLI::App& app, const Option& o, void (*to)()) {
  return app.add_flag_callback(o.names, to, o.help)->trigger_on_parse();
}

CLI::Option* add_to(CLI::App& app, const Option& o,
                    std::optional<std::string> (*read)(const std::string&)) {
  return app.add_option_function<std::string>(
      o.names,
      [read](const std::string& word) {
        if (const auto wrong = read(word)) throw CLI::ValidationError(*wrong);
      },
      o.help);
}

template <class Value>
CLI::Option* add_to(CLI::App& app, const Option& o, Value* to) {
  using Taken = typename TakenBy<Value>::Type;
  CLI::Option* made = app.add_option(o.names, *to, o.help);
  if constexpr (std::is_arithmetic_v<Taken>) add_limits(*made, o.is, Taken());
  if constexpr (std::is_arithmetic_v<Value>) made->capture_default_str();
  if constexpr (std::is_same_v<Value, std::string>)
    if (!to->empty()) made->capture_default_str();
  return made;
}

void add(CLI::App& app, const Option& o) {
  CLI::Option* made = std::visit([&](auto to) { return add_to(app, o, to); }, o.to);
  if (!o.is.words.empty()) made->check(CLI::IsMember(o.is.words));
  if (*o.is.value != '\0') made->type_name(o.is.value);
  if (o.is.required) made->required();
  if (o.is.one_each) made->allow_extra_args(false);
  for (const std::string& other : CLI::detail::split(o.is.without, ','))
    if (!other.empty()) made->excludes(app.get_option(other));
  if (o.is.given != nullptr)
    made->each([given = o.is.given](const std::string&) { *given = true; });
  if (made->get_items_expected_max() > 0) made->check(require_some);
}

// A command that is no more than its name and help until words name it or its help is told: to make
// the options of all thirty takes longer than most of what the one asked for does.
class Parser : public CLI::App {
 public:
  Parser(const Command& row, Run& run) : CLI::App(row.help, row.name, nullptr) {
    preparse_callback([this, &row, &run](std::size_t) {
      const CLI::Option& parents_help = *get_parent()->get_help_ptr();
      set_help_flag(parents_help.get_name(false, true), parents_help.get_description());
      footer(get_parent()->get_footer());
      add_row(*this, row, run);
    });
  }
  // Adds its options and commands if they are not there yet. Parsing does so by itself.
  void complete() { _trigger_pre_parse(0); }

  static void add_row(CLI::App& app, const Command& row, Run& run) {
    if (const std::string why = row.missing ? row.missing() : ""; !why.empty()) {
      app.prefix_command();  // whatever its options would be
      app.footer(why + ".");
      app.callback([&run, why] { run = [why]() -> int { throw UsageError(why); }; });
      return;
    }
    Options options;
    const Run begun = row.begin ? row.begin(options) : nullptr;
    std::ranges::move(manners(), std::back_inserter(options));
    for (const Option& option : options) add(app, option);
    for (const Command& below : row.commands)
      app.add_subcommand(std::make_shared<Parser>(below, run));
    if (!row.commands.empty()) app.require_subcommand(1);
    if (begun) app.callback([&run, begun] { run = begun; });
  }
};

// The command of `app` that is called so, with its options; null if there is none.
CLI::App* command_of(CLI::App& app, const std::string& name) {
  const auto found =
      app.get_subcommands([&](const CLI::App* one) { return one->get_name() == name; });
  if (found.empty()) return nullptr;
  static_cast<Parser*>(found.front())->complete();
  return found.front();
}

// That `parent` has no command of this name, and which it has.
std::string no_command(const CLI::App& parent, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* one : parent.get_subcommands(nullptr)) names.push_back(one->get_name());
  const std::vector<std::string_view> known(names.begin(), names.end());
  return fmt::format("there is no command '{}'; {}", word,
                     known.empty() ? "see 'lantern help'" : suggestion(word, known, known.size()));
}

// The commands that the words name, from the outermost: "bench", "step". What stands before them
// are options and their values.
struct Named {
  std::vector<CLI::App*> commands;
  std::string unknown;  // a word in a command's place that is none

  // Their names, without the program's own.
  std::string names(const char* between) const {
    Words words;
    for (const CLI::App* one : commands) words.push_back(one->get_name());
    return fmt::format("{}", fmt::join(words.begin() + 1, words.end(), between));
  }
};

Named named_by(CLI::App& app, int argc, const char* const* argv) {
  Named named{{&app}, ""};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    CLI::App& last = *named.commands.back();
    if (word.starts_with('-')) {
      const auto options = last.get_options(  // get_option_no_throw may run out of room
          [&](const CLI::Option* one) { return one->check_name(word); });
      if (!options.empty() && options.front()->get_items_expected_max() > 0) ++i;
      continue;
    }
    if (last.get_subcommands(nullptr).empty()) break;
    CLI::App* next = command_of(last, word);
    if (next == nullptr) {
      named.unknown = word;
      break;
    }
    named.commands.push_back(next);
  }
  return named;
}

// A misspelt command or option gets the nearest one; others are told as the parser found them.
std::string usage_mistake(const Named& named, std::string found) {
  if (!named.unknown.empty()) return no_command(*named.commands.back(), named.unknown);
  const std::vector<std::string> left = named.commands.front()->remaining(true);
  std::vector<std::string_view> known;
  for (const CLI::Option* one : named.commands.back()->get_options())
    known.insert(known.end(), one->get_lnames().begin(), one->get_lnames().end());
  if (!left.empty() && left[0].starts_with("--"))
    if (const auto near = nearest_name(left[0].substr(2, left[0].find('=') - 2), known))
      found += "; did you mean --" + *near + "?";
  const std::string names = named.names(" ");
  return found + "; see 'lantern " + names + (names.empty() ? "" : " ") + "--help'";
}

// A wish for JSON holds even if the other words make no sense.
void owe_answer_if_wanted(const Named& named, int argc, const char* const* argv) {
  const auto end = std::find(argv, argv + argc, std::string_view("--"));
  const auto wants_json = [](std::string_view word) {
    return word == "--json" || word == "--json=true" || word == "--json=1";
  };
  if (std::none_of(argv, end, wants_json)) return;
  const std::string names = named.names(".");
  owe_answer(names.empty() || !named.unknown.empty() ? "error" : names);
}

// What to do first, for whoever has given no word.
constexpr const char* kFirst[] = {
    "lantern list                                  the scenarios that there are",
    "lantern render ghost_quadtree                 one of them as pictures, into output/",
    "lantern render ghost_quadtree -o lesson.html  as a page to step through in a browser",
    "lantern watch my.toml -o my.html              one of your own, drawn again when saved",
    "lantern help                                  all commands; lantern help render, one of them"};

struct HelpOptions {
  Words names;
};

Options help_options(HelpOptions& o) {
  return {{"COMMAND", &o.names, "its name, such as: bench step; without one, all commands"}};
}

int print_help(const HelpOptions& options) {
  print(help_text(options.names));
  return kGood;
}

}  // namespace

void add_commands(CLI::App& app, Run& run) {
  Words codes;
  for (const ExitMeaning& exit : kExitCodes)
    codes.push_back(fmt::format("{} {}", exit.code, exit.means));
  app.name(whole_program().name);
  app.description(whole_program().help);
  app.set_version_flag("--version", std::string(kVersion));
  app.footer(fmt::format("Exit codes: {}.\nStart with: lantern render ghost_quadtree",
                         fmt::join(codes, ", ")));
  Parser::add_row(app, whole_program(), run);
}

Run read_command_line(int argc, const char* const* argv) {
  CLI::App app;
  Run run;
  add_commands(app, run);
  if (argc < 2)
    return [] {
      for (const char* line : kFirst) say(line);
      return int{kUsage};
    };
  const Named named = named_by(app, argc, argv);
  owe_answer_if_wanted(named, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) throw UsageError(usage_mistake(named, e.what()));
    owe_no_answer();
    std::ostringstream text;  // --help, --version
    app.exit(e, text, text);
    print(text.str());
    return nullptr;
  }
  return run;
}

std::string help_text(const Words& names) {
  CLI::App app;
  Run run;
  add_commands(app, run);
  CLI::App* command = &app;
  std::string before;  // the words before the command's own name
  for (const std::string& word : names) {
    CLI::App* next = command_of(*command, word);
    if (next == nullptr) throw UsageError(no_command(*command, word));
    before += (before.empty() ? "" : " ") + command->get_name();
    command = next;
  }
  const std::string name = (before.empty() ? "" : before + " ") + command->get_name();
  return command->get_formatter()->make_help(command, name, CLI::AppFormatMode::Normal);
}

std::vector<Command> help_commands() {
  return {
      command("help", "Print the help of a command, as its --help does", print_help, help_options)};
}

}  // namespace lantern::app
