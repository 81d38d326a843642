#include "app/shard_render.hpp"

#include <utility>

#include <fmt/format.h>

#include "app/destination.hpp"
#include "app/forecast.hpp"
#include "app/kept_files.hpp"
#include "app/run_scenario.hpp"
#include "app/selection.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"

namespace lantern::app {
namespace {

// How many frames of each are chosen, at most; nothing where only the run can tell.
std::vector<std::optional<std::uint64_t>> chosen_frames(const RenderOptions& options,
                                                        const std::vector<Scenario>& scenarios) {
  std::vector<std::optional<std::uint64_t>> frames;
  for (const Scenario& scenario : scenarios) {
    const auto extent = extent_of(scenario, pace_of(options.pace, scenario)).frames;
    const Selection selection(options.frames, options.at, extent);
    frames.push_back(selection.most() ? selection.most() : extent);
  }
  return frames;
}

// What the folder of one run would depend on: as its manifest says it, and the choice of frames.
std::map<std::string, std::string> settings_of(const RenderJob& job, const Scenario& scenario) {
  const Manifest m = job.manifest(scenario, pace_of(job.options.pace, scenario));
  std::map<std::string, std::string> settings = settings_told_by(m);
  settings["frames"] = job.options.frames;
  settings["at"] = job.options.at;
  settings["pace"] = job.options.pace;
  settings["tween digits"] = std::to_string(m.in_between_digits);
  return settings;
}

}  // namespace

RenderOptions options_of_shard(const RenderOptions& options) {
  const auto shard = parse_shard(options.shard);
  if (!shard) return options;
  if (Destination(options.output, !options.sheet.empty()).kind() != OutputKind::folder)
    throw UsageError(
        fmt::format("--shard divides a folder of frames, and -o {} is none; make the file "
                    "on one machine, without --shard",
                    options.output));
  RenderOptions of_shard = options;
  of_shard.output = shard->folder_in(options.output).string();
  return of_shard;
}

Folder output_folder(const RenderOptions& options) {
  const std::filesystem::path path = options.output;
  const bool is_shard = !options.shard.empty();
  const Folder folder = is_shard ? Folder::made(path.parent_path()).inside(path.filename().string())
                                 : Folder::made(path);
  require_kept_for(is_shard ? KeptFor::shard : KeptFor::frames, folder);
  return folder;
}

RenderShard::RenderShard(const RenderJob& job, const std::vector<Scenario>& scenarios)
    : parts_(scenarios.size()) {
  const auto shard = parse_shard(job.options.shard);
  if (!shard || scenarios.empty()) return;
  parts_ = parts_of(*shard, chosen_frames(job.options, scenarios));
  ShardRecord record = new_record(*shard);
  record.settings = settings_of(job, scenarios.front());
  for (const Scenario& s : scenarios)
    record.inputs.push_back({name_of(s), fmt::format("{:016x}", s.text_hash)});
  const Folder folder = output_folder(job.options);
  lock_.emplace(folder);
  folder.remove_leftovers();
  folder_.emplace(folder, std::move(record));
}

void RenderShard::drawn(std::size_t scenario, const FolderSink& sink) {
  if (!folder_) return;
  folder_->input(scenario).here = sink.drawn() + sink.kept();
  folder_->input(scenario).chosen = sink.chosen();
  folder_->input(scenario).atlas = sink.has_atlas();
}

void RenderShard::finish() {
  if (folder_) folder_->finish();
}

}  // namespace lantern::app
