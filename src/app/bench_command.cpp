#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/interrupts.hpp"
#include "app/progress.hpp"
#include "app/report_folder.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/stop.hpp"
#include "draw/page.hpp"
#include "embedded/version.hpp"
#include "report/bench_frames.hpp"
#include "scenario/director.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// A folder for the files of the measurement, gone when it ends.
class ScratchFolder {
 public:
  // Nobody else can have made it before.
  ScratchFolder() {
    std::string name = fs::temp_directory_path() / "lantern-bench-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr)
      throw IoError(fmt::format("cannot make the folder '{}': {}", name, std::strerror(errno)));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

constexpr const char* kUsual[] = {"ghost_quadtree", "ghost_maze",  "falling_boxes",
                                  "pong_game",      "spring_rope", "tumbling_box"};

// As it would be typed.
std::string command_text(const BenchOptions& options) {
  std::string text = "lantern bench frames";
  for (const std::string& name : options.scenarios) text += " " + name;
  return text + fmt::format(" --rounds {} --frames {}", options.rounds, options.frames);
}

FrameSequence sequence_of(const std::string& name, const FrameBenchConfig& config) {
  const Scenario scenario = load_scenario(scenario_file(name));
  FrameSequence sequence{scenario.name, {}};
  // Some of the frames equal the one before.
  const std::size_t most = 2 * config.most_frames;
  Work work;
  direct(scenario, Pace::step, work, [&](const Frame& frame) {
    sequence.lists.push_back(draw_frame(frame, page_for(config.width, config.height), work));
    return sequence.lists.size() < most;
  });
  if (sequence.lists.size() < 2)
    throw UsageError(scenario.name +
                     " gives fewer than two frames; choose one in which more moves");
  return sequence;
}

void measure(FrameBenchResult& result, std::vector<FrameSequence> sequences) {
  const ScratchFolder folder;
  Progress progress("bench frames", sequences.size(), "sequences");
  std::vector<std::string> names;
  for (const FrameSequence& sequence : sequences) names.push_back(sequence.name);
  try {
    bench_frames(result, std::move(sequences), folder.path(), [&](std::size_t i) {
      progress.tell(fmt::format("sequence {} of {}, {}", i + 1, names.size(), names[i]));
    });
  } catch (const Stopped&) {
    give_time_to_save();  // sequences that are done are reported
  } catch (const Refused& refused) {
    throw UsageError(refused.what());
  }
}

}  // namespace

int bench_frames_command(const BenchOptions& options) {
  FrameBenchResult result;
  FrameBenchConfig& config = result.config;
  config.rounds = options.rounds;
  config.most_frames = static_cast<std::size_t>(options.frames);
  config.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  config.theme = *theme_named("light");
  result.circumstances = here(kVersion, kSourceHash);
  result.command = command_text(options);
  std::vector<FrameSequence> sequences;
  if (options.scenarios.empty())
    for (const char* name : kUsual) sequences.push_back(sequence_of(name, config));
  for (const std::string& name : options.scenarios) sequences.push_back(sequence_of(name, config));
  ReportFolder folder(options.output, "bench_frames");
  say(fmt::format("{} of {} at {} x {}", counted(config.rounds, "round"),
                  counted(sequences.size(), "sequence"), config.width, config.height));
  measure(result, std::move(sequences));
  if (!result.missing.empty()) say(result.missing);
  folder.write("bench_frames.html", to_html(result));
  folder.write("bench_frames.csv", to_csv(result));
  folder.write("bench_frames.json", to_json(result));
  options.json ? answer(to_json(result)) : print(to_table(result));
  if (interrupted()) {
    complain("interrupted; the sequences that were done have been reported");
    return kInterrupted;
  }
  folder.finish();
  return kGood;
}

}  // namespace lantern::app
