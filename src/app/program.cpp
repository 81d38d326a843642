#include "app/program.hpp"

#include <algorithm>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/command_line.hpp"
#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/shard.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/stop.hpp"
#include "base/suggest.hpp"

namespace lantern::app {
namespace {

// A misspelt command gets the nearest one.
std::string usage_hint(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return "see 'lantern --help'";
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end())
    return "see 'lantern " + word + " --help'";
  const std::vector<std::string_view> known(names.begin(), names.end());
  return "there is no command '" + word + "'; " + suggestion(word, known);
}

// Made before it is needed, when there may be no room for it.
std::string out_of_memory = "lantern: error: out of memory\n";

// What a run throws is told, and becomes its exit code.
int run_and_report(const Run& run) noexcept {
  try {
    return run();
  } catch (const UsageError& e) {
    complain(e.what());
    return kUsage;
  } catch (const ScenarioError& e) {
    complain(e);
    return kBadScenario;
  } catch (const BackendError& e) {
    complain(e);
    return kNoBackend;
  } catch (const ReaderGone&) {
    return kFailed;
  } catch (const Stopped&) {
    say("interrupted");
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    write_stderr(out_of_memory);  // and needs none
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0)
      throw UsageError(std::string(e.what()) + "; " + usage_hint(app, argc, argv));
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

int run_program(int argc, char** argv) {
  hold_standard_streams();
  keep_freed_memory();
  catch_interrupts();
  remember_command_line(argc, argv);
  return run_and_report([&] { return run_words(argc, argv); });
}

}  // namespace lantern::app
