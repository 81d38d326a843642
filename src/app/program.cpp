#include "app/program.hpp"

#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/shard.hpp"
#include "app/interrupts.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"

namespace lantern::app {
namespace {

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
  const Run run = read_command_line(argc, argv);
  if (!run) return kGood;
  enforce_memory_budget();
  out_of_memory = fmt::format("lantern: error: out of memory: the budget is {}; --memory sets it\n",
                              memory_text(memory_budget()));
  return run();
}

}  // namespace

int run_program(int argc, char** argv, std::vector<OwnKind> own, std::vector<OwnPanel> panels) {
  hold_standard_streams();
  keep_freed_memory();
  catch_interrupts();
  const int code = run_and_report([&] {
    remember_command_line(argc, argv);
    try {
      know_own_structures(std::move(own));
      for (OwnPanel& panel : panels) {
        add_panel(panel.kind, std::move(panel.run));
        panel.view.name = panel.kind.name;
        add_panel(panel.view);
      }
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
