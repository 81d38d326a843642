// The frames of shards, as one run's folder.
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/folder_sink.hpp"
#include "app/frame_folder.hpp"
#include "app/merge.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/stop.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFileBytes = std::size_t{1} << 30;

// A file of a shard that the whole has, too.
struct ShardFile {
  const FoundShard* shard = nullptr;
  std::string name;
  FileKind kind = FileKind::png;
  MadeFrom from;
};

// One scenario of the run: what of it each shard has.
struct MergedSequence {
  Manifest manifest;
  std::vector<ShardFile> files;
};

// Its bytes, if they are as the shard wrote them.
std::optional<std::string> whole_bytes(const fs::path& folder, const ShardFile& file) try {
  std::string bytes = read_file(folder / file.name, kMostFileBytes);
  return made_from(file.kind, bytes) == file.from ? std::optional(std::move(bytes)) : std::nullopt;
} catch (const IoError&) {
  return std::nullopt;
}

Manifest manifest_of(const ShardSet& set, const FoundShard& shard, const ShardInput& input) {
  const fs::path path = shard.path / input.name / "manifest.json";
  std::optional<Manifest> manifest;
  try {
    manifest = read_manifest(read_file(path, kMostFileBytes));
  } catch (const IoError&) {
    // told as one that cannot be read
  }
  if (!manifest || !manifest->finished || manifest->frames.size() != input.here ||
      fmt::format("{:016x}", manifest->scenario_hash) != input.text)
    throw UnfitShard(set, shard, fmt::format("'{}' is not what the shard wrote", path.string()));
  const auto digits = set.run().settings.find("tween digits");
  if (digits != set.run().settings.end()) manifest->in_between_digits = std::stoi(digits->second);
  return std::move(*manifest);
}

std::vector<ShardFile> files_of(const FoundShard& shard, const Manifest& m, bool atlas) {
  const FileKind picture = m.format == "svg" ? FileKind::svg : FileKind::png;
  std::vector<ShardFile> files;
  for (const auto& [index, frame] : m.frames) {
    const MadeFrom from = m.frame_from(index);
    files.push_back(
        {&shard, frame_file(m.scenario, index, "json"), FileKind::json, {from.facts, from.facts}});
    files.push_back({&shard, frame_file(m.scenario, index, m.format), picture, from});
    for (std::uint64_t k = 1; k <= frame.in_betweens; ++k)
      files.push_back({&shard, in_between_file(m, index, k), picture, m.in_between_from(index, k)});
  }
  if (atlas) {
    files.push_back({&shard, atlas_file(m.scenario, m.format), picture, m.atlas_from()});
    files.push_back({&shard, atlas_file(m.scenario, "json"), FileKind::json, m.atlas_from()});
  }
  return files;
}

// Throws UnfitShard unless each of the files is whole.
void require_whole(const ShardSet& set, const FoundShard& shard, const std::string& scenario,
                   const std::vector<ShardFile>& files) {
  std::vector<std::string> bad;
  for (const ShardFile& file : files) {
    stop_if_asked();
    if (!whole_bytes(shard.path / scenario, file)) bad.push_back(file.name);
  }
  if (bad.empty()) return;
  const std::string more =
      bad.size() > 1 ? fmt::format(" and {} more are", bad.size() - 1) : std::string(" is");
  throw UnfitShard(set, shard, fmt::format("{}{} missing or not as Lantern made it", bad[0], more));
}

// What lies in the shard's folder and is not its own stays there, and is named.
void tell_of_others(const FoundShard& shard, const std::string& scenario,
                    const std::vector<ShardFile>& files) {
  std::vector<std::string> others;
  std::error_code error;
  for (fs::directory_iterator it(shard.path / scenario, error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name != "manifest.json" && std::ranges::find(files, name, &ShardFile::name) == files.end())
      others.push_back(name);
  }
  std::ranges::sort(others);
  const std::string what = "not of shard " + shard.record.shard.text() + ", left where it is";
  if (!others.empty()) say(about_files(scenario, what.c_str(), others));
}

// Throws UsageError for two parts that tell of different runs.
void require_same_run(Manifest a, Manifest b, const FoundShard& shard) {
  a.frames.clear();
  b.frames.clear();
  if (to_json(a) != to_json(b))
    throw UsageError(fmt::format("'{}' in '{}' tells of another run than the other shards",
                                 a.scenario, shard.path.string()));
}

// Nothing if no frame of it was chosen by anybody.
std::optional<MergedSequence> gather(const ShardSet& set, std::size_t index) {
  std::optional<MergedSequence> whole;
  for (const FoundShard* shard : set.shards()) {
    const ShardInput& input = shard->record.inputs[index];
    if (input.here == 0) continue;
    Manifest part = manifest_of(set, *shard, input);
    std::vector<ShardFile> files = files_of(*shard, part, input.atlas);
    require_whole(set, *shard, input.name, files);
    tell_of_others(*shard, input.name, files);
    if (!whole) {
      whole = MergedSequence{std::move(part), std::move(files)};
      continue;
    }
    require_same_run(whole->manifest, part, *shard);
    whole->manifest.frames.merge(part.frames);
    std::ranges::move(files, std::back_inserter(whole->files));
  }
  return whole;
}

// Where both have a shard, they must have the same.
void require_equal(const ShardSet& set, const ShardSet::Twins& twins) {
  for (std::size_t i = 0; i < set.run().inputs.size(); ++i) {
    const ShardInput& first = twins.first->record.inputs[i];
    const ShardInput& second = twins.second->record.inputs[i];
    bool same = first.here == second.here && first.atlas == second.atlas;
    if (same && first.here > 0) {
      const Manifest m = manifest_of(set, *twins.first, first);
      same = to_json(m) == to_json(manifest_of(set, *twins.second, second));
      for (const ShardFile& file : files_of(*twins.first, m, first.atlas))
        same = same && whole_bytes(twins.first->path / first.name, file) ==
                           whole_bytes(twins.second->path / first.name, file);
    }
    if (!same)
      throw UsageError(fmt::format("'{}' and '{}' are both shard {}, but differ in '{}'",
                                   twins.first->path.string(), twins.second->path.string(),
                                   twins.first->record.shard.text(), first.name));
  }
}

struct Counted {
  std::size_t written = 0, kept = 0;
};

// As a run does it: a manifest of nothing first, that of all frames last.
Counted write_whole(const fs::path& path, MergedSequence& whole, bool all_frames) {
  Manifest finished = whole.manifest;
  whole.manifest.frames.clear();
  whole.manifest.finished = false;
  const FrameFolder folder(path, whole.manifest, all_frames);
  if (!folder.removed().empty())
    say(about_files(finished.scenario, "removed what an earlier run has left", folder.removed()));
  const auto write_manifest = [&](const Manifest& m) {
    write_file(path / "manifest.json", to_json(m));
  };
  write_manifest(whole.manifest);
  Counted counted;
  std::set<std::string> written;
  for (const ShardFile& file : whole.files) {
    stop_if_asked();
    if (folder.stands(file.name)) {
      ++counted.kept;
      continue;
    }
    const auto bytes = whole_bytes(file.shard->path / finished.scenario, file);
    if (!bytes) throw IoError(fmt::format("'{}' has changed meanwhile", file.name));
    write_file(path / file.name, *bytes);
    written.insert(file.name);
    ++counted.written;
  }
  tell_of_strange(finished.scenario, folder, written);
  write_manifest(finished);
  make_durable(path);
  return counted;
}

}  // namespace

int merge_frames(const ShardSet& set, const MergeOptions& options, JsonWriter& json) {
  for (const ShardSet::Twins& twins : set.twins()) require_equal(set, twins);
  std::vector<MergedSequence> sequences;
  for (std::size_t i = 0; i < set.run().inputs.size(); ++i)
    if (auto whole = gather(set, i)) sequences.push_back(std::move(*whole));
  const auto chosen = [&](const char* name) { return !set.run().settings.at(name).empty(); };
  const bool all_frames = !chosen("frames") && !chosen("at");
  std::uint64_t unmet = 0;
  json.line().key("scenarios").begin_array();
  for (MergedSequence& whole : sequences) {
    const std::size_t frames = whole.manifest.frames.size();
    const fs::path path = fs::path(options.output) / whole.manifest.scenario;
    const Counted counted = write_whole(path, whole, all_frames);
    unmet += whole.manifest.unmet;
    json.line().begin_object().members("scenario", whole.manifest.scenario, "folder", path.string(),
                                       "frames", frames, "written", counted.written, "kept",
                                       counted.kept);
    json.end_object();
    say(fmt::format(
        "{}: {} frames of {} shards in {}{}", whole.manifest.scenario, frames, set.run().shard.of,
        path.string(),
        counted.kept > 0 ? fmt::format(", {} files of them there already", counted.kept) : ""));
  }
  json.line().end_array();
  if (unmet > 0) complain(fmt::format("{} expectations did not hold", unmet));
  return unmet > 0 ? kFailed : kGood;
}

}  // namespace lantern::app
