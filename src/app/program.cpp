#include "app/program.hpp"

#include <algorithm>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/option_words.hpp"
#include "app/run_scenario.hpp"
#include "app/shard.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern::app {
namespace {

// The commands that the words name, from the outermost: "bench", "step". What stands before them
// are options and their values.
std::vector<CLI::App*> commands_of(CLI::App& app, int argc, char** argv, std::string& unknown) {
  std::vector<CLI::App*> commands = {&app};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with('-')) {
      const auto options = commands.back()->get_options(  // get_option_no_throw may run out of room
          [&](const CLI::Option* one) { return one->check_name(word); });
      if (!options.empty() && options.front()->get_items_expected_max() > 0) ++i;
      continue;
    }
    if (commands.back()->get_subcommands(nullptr).empty()) break;
    const auto known = complete_commands(*commands.back(), word);
    if (known.empty()) {
      unknown = word;
      break;
    }
    commands.push_back(known.front());
  }
  return commands;
}

// The names of these, without the program's own.
std::string names_of(const std::vector<CLI::App*>& commands, std::string_view between) {
  std::string names;
  for (std::size_t i = 1; i < commands.size(); ++i)
    names += (names.empty() ? "" : std::string(between)) + commands[i]->get_name();
  return names;
}

// A misspelt command gets the nearest one; other mistakes are told as the parser has found them.
std::string usage_mistake(CLI::App& app, int argc, char** argv, const std::string& found) {
  std::string unknown;
  const auto commands = commands_of(app, argc, argv, unknown);
  if (unknown.empty()) {
    const std::string names = names_of(commands, " ");
    return found + "; see 'lantern " + names + (names.empty() ? "" : " ") + "--help'";
  }
  return no_command(*commands.back(), unknown);
}

// A wish for JSON holds even if the other words make no sense.
void owe_answer_if_wanted(CLI::App& app, int argc, char** argv) {
  const auto end = std::find(argv, argv + argc, std::string_view("--"));
  const auto wants_json = [](std::string_view word) {
    return word == "--json" || word == "--json=true" || word == "--json=1";
  };
  if (std::none_of(argv, end, wants_json)) return;
  std::string unknown;
  const std::string names = names_of(commands_of(app, argc, argv, unknown), ".");
  owe_answer(names.empty() || !unknown.empty() ? "error" : names);
}

// Made before it is needed, when there may be no room for it.
std::string out_of_memory = "lantern: error: out of memory\n";

// What a run throws is told, and becomes its exit code.
template <class Callable>  // no std::function, which may need memory before anybody listens
int run_and_report(const Callable& run) noexcept {
  try {
    return run();
  } catch (const UsageError& e) {
    complain(e.what());
    return kUsage;
  } catch (const ScenarioError& e) {
    complain(e);
    return exit_code_of(e);
  } catch (const BackendError& e) {
    complain(e);
    return kNoBackend;
  } catch (const ReaderGone&) {
    return kFailed;
  } catch (const Stopped&) {
    complain("interrupted");
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    write_stderr(out_of_memory);  // and needs none
    write_answer_without_memory();
    return kFailed;
  } catch (const std::filesystem::filesystem_error& e) {
    complain(
        fmt::format("cannot look at '{}': {}", printable(e.path1().string()), e.code().message()));
    return kFailed;
  } catch (const std::exception& e) {
    complain(e.what());
    return kFailed;
  } catch (...) {
    complain("something that is no std::exception was thrown");
    return kFailed;
  }
}

// Reads the command line and runs what it asks for.
int run_words(int argc, char** argv) {
  CLI::App app;
  Run run;
  add_commands(app, run);
  owe_answer_if_wanted(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) throw UsageError(usage_mistake(app, argc, argv, e.what()));
    owe_no_answer();
    std::ostringstream text;  // --help, --version
    app.exit(e, text, text);
    print(text.str());
    return kGood;
  }
  enforce_memory_budget();
  out_of_memory = fmt::format("lantern: error: out of memory: the budget is {}; --memory sets it\n",
                              memory_text(memory_budget()));
  return run();
}

}  // namespace

int run_program(int argc, char** argv, std::vector<OwnKind> own) {
  hold_standard_streams();
  keep_freed_memory();
  catch_interrupts();
  const int code = run_and_report([&] {
    remember_command_line(argc, argv);
    try {
      know_own_structures(std::move(own));
    } catch (const Refused& refused) {
      throw UsageError(refused.what());
    }
    return run_words(argc, argv);
  });
  return run_and_report([&] {
    write_answer(code);
    return code;
  });
}

}  // namespace lantern::app
