// The frames of shards, as one run's folder.
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folder_sink.hpp"
#include "app/frame_folder.hpp"
#include "app/json_members.hpp"
#include "app/kept_files.hpp"
#include "app/merge.hpp"
#include "app/terminal.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/stop.hpp"

namespace lantern::app {
namespace {

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

// Of one scenario in a shard. Throws UnfitShard if it is not there.
Folder folder_in_part(const ShardSet& set, const FoundShard& shard, const ScenarioName& scenario) {
  if (auto folder = shard.folder.find(scenario.text())) return *folder;
  throw UnfitShard(set, shard, fmt::format("there is no folder '{}'", scenario.text()));
}

// Its bytes, if they are as the shard wrote them.
std::optional<std::string> whole_bytes(const Folder& folder, const ShardFile& file) try {
  std::optional<std::string> bytes = folder.read(file.name, kMostFileBytes);
  return bytes && made_from(file.kind, *bytes) == file.from ? std::move(bytes) : std::nullopt;
} catch (const IoError&) {
  return std::nullopt;
}

// What the shard's manifest says, if it says it of this input. Throws UnfitShard.
Manifest manifest_of(const ShardSet& set, const FoundShard& shard, const ShardInput& input) {
  const Folder folder = folder_in_part(set, shard, input.name);
  const auto refuse = [&](const std::string& why) {
    throw UnfitShard(
        set, shard,
        fmt::format("'{}' is not what the shard wrote: {}", folder.path(kManifest).string(), why));
  };
  std::optional<Manifest> manifest;
  try {
    const auto bytes = folder.read(kManifest, kMostFileBytes);
    if (!bytes) refuse("it is missing");
    manifest = read_manifest(*bytes);
  } catch (const IoError& why) {
    refuse(why.what());
  } catch (const RefusedFile& why) {
    refuse(why.what());
  }
  if (manifest->scenario != input.name)
    refuse(fmt::format("scenario is \"{}\", the record names '{}'", manifest->scenario.text(),
                       input.name.text()));
  if (!manifest->finished) refuse("finished is false");
  if (manifest->frames.size() != input.here)
    refuse(fmt::format("it lists {} frames, the record {}", manifest->frames.size(), input.here));
  if (fmt::format("{:016x}", manifest->scenario_hash) != input.text)
    refuse(fmt::format("scenario_hash is another than {}", input.text));
  if (const auto words = contradiction(*manifest, shard.record)) refuse(*words);
  manifest->in_between_digits = *in_between_digits(set.run());
  return std::move(*manifest);
}

std::vector<ShardFile> files_of(const FoundShard& shard, const Manifest& m, bool atlas) {
  std::vector<ShardFile> files;
  for (const auto& [index, frame] : m.frames) {
    const MadeFrom from = m.frame_from(index);
    files.push_back({&shard,
                     frame_file(m.scenario, index, FileKind::json),
                     FileKind::json,
                     {from.facts, from.facts}});
    files.push_back({&shard, frame_file(m.scenario, index, m.format), m.format, from});
    for (std::uint64_t k = 1; k <= frame.in_betweens; ++k)
      files.push_back(
          {&shard, in_between_file(m, index, k), m.format, m.in_between_from(index, k)});
  }
  if (atlas) {
    files.push_back({&shard, atlas_file(m.scenario, m.format), m.format, m.atlas_from()});
    files.push_back(
        {&shard, atlas_file(m.scenario, FileKind::json), FileKind::json, m.atlas_from()});
  }
  return files;
}

// Do the facts of a frame say of it what the manifest says? They begin with what it lists.
bool say_the_same(std::string_view facts, const Manifest& m, std::uint32_t index) {
  const ListedFrame& frame = m.frames.at(index);
  JsonWriter listed;
  listed.begin_object().lines("scenario", m.scenario.text(), "frame", index, "time", frame.time,
                              "step", frame.step, "event", frame.event, "caption", frame.caption,
                              "seed", m.seed);
  return facts.find(std::string_view(listed.text()).substr(1)) != facts.npos &&
         facts.rfind(fmt::format("\n\"hash\": \"{:016x}\"", frame.hash)) != facts.npos;
}

// Throws UnfitShard unless each of the files is whole, and tells what the manifest does.
void require_whole(const ShardSet& set, const FoundShard& shard, const Manifest& m,
                   const std::vector<ShardFile>& files) {
  const Folder folder = folder_in_part(set, shard, m.scenario);
  std::vector<std::string> bad;
  for (const ShardFile& file : files) {
    stop_if_asked();
    const auto bytes = whole_bytes(folder, file);
    if (!bytes) bad.push_back(file.name);
    if (!bytes || file.kind != FileKind::json) continue;
    const auto index = frame_of(file.name, m.scenario.text());
    if (index && !say_the_same(*bytes, m, *index))
      throw UnfitShard(
          set, shard,
          fmt::format("{} and {} do not say the same of frame {}", kManifest, file.name, *index));
  }
  if (bad.empty()) return;
  const std::string more =
      bad.size() > 1 ? fmt::format(" and {} more are", bad.size() - 1) : std::string(" is");
  throw UnfitShard(set, shard, fmt::format("{}{} missing or not as Lantern made it", bad[0], more));
}

// What lies in the shard's folder and is not its own stays there, and is named.
void tell_of_others(const FoundShard& shard, const Folder& folder,
                    const std::vector<ShardFile>& files) {
  std::vector<std::string> others;
  std::set<std::string> own = {kManifest};
  for (const ShardFile& file : files) own.insert(file.name);
  for (const std::string& name : folder.names())
    if (!own.contains(name)) others.push_back(name);
  const std::string what = "not of shard " + shard.record.shard.text() + ", left where it is";
  if (!others.empty()) say(about_files(folder.path().filename().string(), what.c_str(), others));
}

// Throws UsageError for two parts that tell of different runs.
void require_same_run(Manifest a, Manifest b, const FoundShard& shard) {
  a.frames.clear();
  b.frames.clear();
  if (to_json(a) != to_json(b))
    throw UsageError(fmt::format("'{}' in '{}' tells of another run than the other shards",
                                 a.scenario.text(), shard.folder.path().string()));
}

// Nothing if no frame of it was chosen by anybody.
std::optional<MergedSequence> gather(const ShardSet& set, std::size_t index) {
  std::optional<MergedSequence> whole;
  for (const FoundShard* shard : set.shards()) {
    const ShardInput& input = shard->record.inputs[index];
    if (input.here == 0) continue;
    Manifest part = manifest_of(set, *shard, input);
    std::vector<ShardFile> files = files_of(*shard, part, input.atlas);
    require_whole(set, *shard, part, files);
    tell_of_others(*shard, folder_in_part(set, *shard, input.name), files);
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

// How many frames the run chose of a scenario, as the parts that stepped it say, and none is
// missing. Throws UnfitShard for a part that says otherwise than there is.
void require_all_frames(const ShardSet& set, std::size_t index, std::size_t frames) {
  for (const FoundShard* shard : set.shards()) {
    const ShardInput& input = shard->record.inputs[index];
    if (input.chosen != 0 ? input.chosen == frames : frames > 0 || !set.takes_all()) continue;
    throw UnfitShard(
        set, *shard,
        fmt::format("inputs[{}].chosen is {} in {}: of '{}' the parts have {}", index, input.chosen,
                    kShardFile, input.name.text(), counted(frames, "frame")));
  }
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
      const Folder one = folder_in_part(set, *twins.first, first.name);
      const Folder other = folder_in_part(set, *twins.second, first.name);
      for (const ShardFile& file : files_of(*twins.first, m, first.atlas))
        same = same && whole_bytes(one, file) == whole_bytes(other, file);
    }
    if (!same)
      throw UsageError(fmt::format("'{}' and '{}' are both shard {}, but differ in '{}'",
                                   twins.first->folder.path().string(),
                                   twins.second->folder.path().string(),
                                   twins.first->record.shard.text(), first.name.text()));
  }
}

struct Counted {
  std::size_t written = 0, kept = 0;
};

// As a run does it: a manifest of nothing first, that of all frames last.
Counted write_whole(const ShardSet& set, const Folder& output, MergedSequence& whole,
                    bool all_frames) {
  Manifest finished = whole.manifest;
  whole.manifest.frames.clear();
  whole.manifest.finished = false;
  const FrameFolder folder(output, whole.manifest, all_frames);
  const std::string& name = finished.scenario.text();
  folder.remove_old();
  const auto write_manifest = [&](const Manifest& m) {
    write_file({folder.folder(), kManifest}, to_json(m));
  };
  write_manifest(whole.manifest);
  Counted counted;
  std::set<std::string> written = {kManifest};
  for (const ShardFile& file : whole.files) {
    stop_if_asked();
    if (folder.stands(file.name)) {
      ++counted.kept;
      continue;
    }
    const auto bytes = whole_bytes(folder_in_part(set, *file.shard, finished.scenario), file);
    if (!bytes) throw IoError(fmt::format("'{}' has changed meanwhile", file.name));
    write_file({folder.folder(), file.name}, *bytes);
    written.insert(file.name);
    ++counted.written;
  }
  tell_of_strange(name, folder, written);
  write_manifest(finished);
  folder.folder().settle();
  return counted;
}

}  // namespace

int merge_frames(const ShardSet& set, const std::string& into, JsonWriter& json) {
  for (const ShardSet::Twins& twins : set.twins()) require_equal(set, twins);
  std::vector<MergedSequence> sequences;
  for (std::size_t i = 0; i < set.run().inputs.size(); ++i) {
    auto whole = gather(set, i);
    require_all_frames(set, i, whole ? whole->manifest.frames.size() : 0);
    if (whole) sequences.push_back(std::move(*whole));
  }
  std::uint64_t unmet = 0;
  const Folder output = Folder::made(into);
  require_kept_for(KeptFor::frames, output);
  json.line().key("scenarios").begin_array();
  for (MergedSequence& whole : sequences) {
    const std::size_t frames = whole.manifest.frames.size();
    const std::string& name = whole.manifest.scenario.text();
    const std::string path = output.path(name).string();
    const Counted counted = write_whole(set, output, whole, set.takes_all());
    unmet += whole.manifest.unmet;
    json.line().begin_object().members("scenario", name, "folder", path, "frames", frames,
                                       "written", counted.written, "kept", counted.kept);
    json.end_object();
    say(fmt::format(
        "{}: {} frames of {} shards in {}{}", name, frames, set.run().shard.of, path,
        counted.kept > 0 ? fmt::format(", {} files of them there already", counted.kept) : ""));
  }
  json.line().end_array();
  if (unmet > 0) complain(fmt::format("{} expectations did not hold", unmet));
  return unmet > 0 ? kFailed : kGood;
}

}  // namespace lantern::app
