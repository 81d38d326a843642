#include <filesystem>

#include <fmt/format.h>
#include <unistd.h>

#include "app/answer.hpp"
#include "app/commands.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/file.hpp"
#include "draw/page.hpp"
#include "report/bench_frames.hpp"
#include "scenario/director.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// A folder for the files of the measurement, gone when it ends.
class ScratchFolder {
 public:
  ScratchFolder() : path_(fs::temp_directory_path() / fmt::format("lantern-bench-{}", ::getpid())) {
    make_folder(path_);
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

}  // namespace

int bench_frames_command(const BenchOptions& options) {
  const Scenario scenario =
      load_scenario(scenario_file(options.scenario.empty() ? "ghost_quadtree" : options.scenario));
  FrameBenchConfig config;
  config.rounds = options.rounds;
  config.theme = *theme_named("light");
  std::vector<DrawList> lists;
  Work work;
  direct(scenario, Pace::step, work, [&](const Frame& frame) {
    lists.push_back(draw_frame(frame, page_for(config.width, config.height), work));
    return true;
  });
  if (lists.size() < 2)
    throw UsageError("the scenario gives fewer than two frames; equal pictures are encoded once");
  say(fmt::format("measuring {} of {} at {} x {}; this takes a minute",
                  counted(config.rounds, "round"), counted(config.frames, "frame"), config.width,
                  config.height));
  const ScratchFolder folder;
  const FrameBenchResult result = bench_frames(lists, folder.path(), config);
  options.json ? answer(to_json(result)) : print(to_table(result));
  return kGood;
}

}  // namespace lantern::app
