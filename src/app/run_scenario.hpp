// Where scenarios are and how they are named, and one run of one, in one pass: each frame goes to a
// sink when it comes by.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/json_writer.hpp"
#include "base/work.hpp"
#include "language/scenario.hpp"
#include "language/words.hpp"
#include "run/director.hpp"

namespace lantern::app {

// Where the frames of a run go: to files, to standard output, and as this itself is, nowhere.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  // Every frame of the run that it looks at, in order.
  virtual void frame(const Frame& /*frame*/) {}
  virtual Wanted wants() const { return Wanted::all; }
  // After the last one. What is to be whole stands whole from here on.
  virtual void finish(const DirectorReport& /*report*/) {}
  // How many pictures it will have drawn in the end, if that is known.
  virtual std::optional<std::uint64_t> pictures() const { return std::nullopt; }
  // How many of the frames that it was given it has still to deal with; from any thread.
  virtual std::uint64_t waiting() const { return 0; }
};

// The folders that hold Lantern's scenarios, the nearest first: scenarios/ here, beside the program
// (where it is installed: share/lantern/scenarios; where it was built: the repository's), and those
// of $XDG_DATA_DIRS. Only what is there.
std::vector<std::filesystem::path> scenario_folders();

// The file that the user means. A path, a file that is there and "-" are themselves; a bare word
// ("ghost_quadtree") is the scenario of that name in the first of these folders that has it, or a
// problem of that name in problems/ there, and which file that is is said. Throws IoError, with the
// nearest name, if there is none.
std::string scenario_file(const std::string& words);

// The files of all words, in their order: a file as it is, "-" for standard input, and of a folder
// every .toml in it, not those of folders below, in the order of a lecture: by `lecture`, those
// without one behind the others, by name. A .toml that is no scenario is left out, with a warning.
// Throws UsageError for standard input named twice and for a folder without scenarios, IoError for
// one that cannot be listed.
std::vector<std::string> input_files(const std::vector<std::string>& words);

// The same, of none those of the nearest folder of Lantern's; which that is is said.
std::vector<std::string> listed_files(std::vector<std::string> words);

// "step", "event", or nothing for the scenario's own.
Pace pace_of(std::string_view word, const Scenario& scenario);

// The words that the command line asks for in place of the files' own.
language::Wording& wording();

// Nothing if it cannot be read: why is said, and `code` becomes that exit code unless it is worse.
// That goes to `why`, too, if it is wanted.
std::optional<Scenario> load_or_complain(const std::string& file, int& code,
                                         std::string* why = nullptr);

struct RunResult {
  DirectorReport report;
  std::vector<Diagnostic> warnings;
  std::vector<std::string> facts;
};

// Runs the scenario and tells how far it is; `chosen` is how many frames the sink writes at most,
// if that is known, and `in_betweens` how many before each but the first, at most. Throws Stopped,
// and what direct() and the sink throw.
RunResult run_scenario(const Scenario& scenario, Pace pace, FrameSink& sink, Work& work,
                       std::optional<std::uint64_t> chosen = std::nullopt,
                       std::uint64_t in_betweens = 0);

// What did not hold: the first in full, and how many more there are.
std::vector<Diagnostic> unmet_of(const RunResult& result);

// Says on standard error what did not hold and what was warned of, and gives the exit code that it
// deserves; with `strict` a warning is an error of the scenario.
int tell(const RunResult& result, bool strict);

// Of a run that ended with this.
int exit_code_of(const ScenarioError& error);

// The counters of the stages, as an object.
void write(JsonWriter& json, const Work& work);

}  // namespace lantern::app
