// `merge`: the shards that folders hold, whether they are parts of one run, and their frames as one
// run's folder.
#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/folders/kept_files.hpp"
#include "app/folders/shard.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/json_writer.hpp"
#include "base/number.hpp"
#include "base/stop.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

constexpr std::size_t kMostRecordBytes = std::size_t{16} << 20;
constexpr std::size_t kMostFileBytes = std::size_t{1} << 30;

struct MergeOptions {
  std::string output;                // folder of the whole
  std::vector<std::string> folders;  // that shards wrote into; empty: the same
  bool json = false;
};

Options merge_options(MergeOptions& o) {
  return {{"OUT", &o.output, "folder of the whole", {.required = true}},
          {"IN", &o.folders, "folders that shards wrote into with -o; the default is OUT"},
          json_option(o.json)};
}

// "shard-2-of-4", and not what somebody has written down beside it.
bool is_named_as_a_shard(std::string_view name) {
  for (const std::string_view part : {"shard-", "-of-"}) {
    if (!name.starts_with(part)) return false;
    name.remove_prefix(part.size());
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    if (digits == 0) return false;
    name.remove_prefix(digits);
  }
  return name.empty();
}

struct FoundShard {
  Folder folder;
  ShardRecord record;

  std::string path() const { return folder.path().string(); }
};

class ShardSet {
 public:
  // Looks into each folder: it is a shard's, or holds some (shard-2-of-4). Throws UsageError for a
  // folder with none, for a record that is not as Lantern writes it, for shards of another build
  // than this one, and, naming two folders and what differs, for shards that are no parts of one
  // run.
  explicit ShardSet(const std::vector<std::string>& folders) {
    for (const std::string& folder : folders) look_into(folder);
    require_one_run();
    shards.resize(run().shard.of);
    for (const FoundShard& one : found_) {
      if (!one.record.finished) continue;
      const FoundShard*& place = shards[one.record.shard.number - 1];
      if (place != nullptr)
        twins.emplace_back(place, &one);
      else
        place = &one;
    }
  }

  // By number - 1; none where it is missing or not finished. Of several equal ones the first.
  std::vector<const FoundShard*> shards;
  // Finished ones whose number was there before, behind that one: to be held against each other.
  std::vector<std::pair<const FoundShard*, const FoundShard*>> twins;

  // A record of the run, of some shard.
  const ShardRecord& run() const { return found_.front().record; }
  // Of all its frames, not of some that were chosen.
  bool takes_all() const {
    return run().settings.at("frames").empty() && run().settings.at("at").empty();
  }

  // That the shard of this number is missing or not finished, and what to run.
  std::string missing(std::uint32_t number) const {
    const auto& inputs = run().inputs;
    std::string names = inputs.front().name.text();
    if (inputs.size() > 1) names += fmt::format(" and {} more", inputs.size() - 1);
    const Shard shard{number, run().shard.of};
    const FoundShard* begun = any(shard);
    return fmt::format("shard {} of {} {}: {}", shard.text(), names,
                       begun ? fmt::format("in '{}' is not finished", begun->path()) : "is missing",
                       advice(shard));
  }
  // "run lantern render x.toml --shard 2/4": its own words, if it has begun, whose output may be
  // another one.
  std::string advice(const Shard& shard) const {
    const FoundShard* begun = any(shard);
    return "run " + command_for(begun ? begun->record.words : run().words, shard);
  }

 private:
  void look_into(const std::string& path) {
    bool holds_some = false;
    std::error_code error;
    if (fs::is_directory(path, error)) {
      const Folder folder(path);
      holds_some = take(folder);
      for (const std::string& name : folder.names())
        if (is_named_as_a_shard(name))
          if (const auto inside = folder.find(name)) holds_some |= take(*inside);
    }
    if (!holds_some)
      throw UsageError("'{}' holds no shard; give folders that a run with --shard wrote into",
                       path);
  }

  // Is it a shard's? One that is named twice counts once.
  bool take(const Folder& folder) {
    if (!folder.has(kShardFile)) return false;
    if (std::ranges::any_of(found_, [&](const auto& one) { return one.folder.is(folder); }))
      return true;
    try {
      found_.push_back({folder, read_record(*folder.read(kShardFile, kMostRecordBytes))});
    } catch (const RefusedFile& why) {
      throw UsageError("'{}' is no record of a shard that this Lantern can read: {}",
                       folder.path(kShardFile).string(), why.what());
    }
    return true;
  }

  void require_one_run() const {
    const FoundShard& first = found_.front();
    for (const FoundShard& one : found_)
      if (const auto words = difference(first.record, one.record))
        throw UsageError("'{}' and '{}' are no parts of one run: {}", first.path(), one.path(),
                         *words);
    const auto require_ours = [&](const char* what, std::string_view theirs,
                                  std::string_view ours) {
      if (theirs != ours)
        throw UsageError(
            "'{}' was made by another Lantern: its {} is {}, this one's {}; merge with the Lantern "
            "that made it, or make it again",
            first.path(), what, theirs, ours);
    };
    require_ours("version", run().version, kVersion);
    require_ours("source hash", run().sources, kSourceHash);
  }

  // The first of this number, finished or not; null if there is none.
  const FoundShard* any(const Shard& shard) const {
    const auto found = std::ranges::find_if(
        found_, [&](const FoundShard& one) { return one.record.shard == shard; });
    return found == found_.end() ? nullptr : &*found;
  }

  std::vector<FoundShard> found_;
};

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

// That a shard says it is finished, but is not as it was written.
[[noreturn]] void refuse(const ShardSet& set, const FoundShard& shard, const std::string& what) {
  throw std::runtime_error(fmt::format("shard {} in '{}': {}: {}", shard.record.shard.text(),
                                       shard.path(), what, set.advice(shard.record.shard)));
}

Folder folder_in_part(const ShardSet& set, const FoundShard& shard, const ScenarioName& scenario) {
  if (auto folder = shard.folder.find(scenario.text())) return *folder;
  refuse(set, shard, fmt::format("there is no folder '{}'", scenario.text()));
}

// Its bytes, if they are as the shard wrote them.
std::optional<std::string> whole_bytes(const Folder& folder, const ShardFile& file) try {
  std::optional<std::string> bytes = folder.read(file.name, kMostFileBytes);
  return bytes && made_from(file.kind, *bytes) == file.from ? std::move(bytes) : std::nullopt;
} catch (const IoError&) {
  return std::nullopt;
}

// What the shard's manifest says; refused unless it says it of this input.
Manifest manifest_of(const ShardSet& set, const FoundShard& shard, const ShardInput& input) {
  const Folder folder = folder_in_part(set, shard, input.name);
  std::string why;
  try {
    const auto bytes = folder.read(kManifest, kMostFileBytes);
    if (!bytes) throw RefusedFile("it is missing");
    Manifest m = read_manifest(*bytes);
    if (m.scenario != input.name)
      throw RefusedFile("scenario is \"{}\", the record names '{}'", m.scenario.text(),
                        input.name.text());
    if (!m.finished) throw RefusedFile("finished is false");
    if (m.frames.size() != input.here)
      throw RefusedFile("it lists {} frames, the record {}", m.frames.size(), input.here);
    if (fmt::format("{:016x}", m.scenario_hash) != input.text)
      throw RefusedFile("scenario_hash is another than {}", input.text);
    if (const auto words = contradiction(m, shard.record)) throw RefusedFile(*words);
    m.in_between_digits = in_between_digits(set.run());
    return m;
  } catch (const std::runtime_error& e) {  // an IoError or a RefusedFile
    why = e.what();
  }
  refuse(set, shard,
         fmt::format("'{}' is not what the shard wrote: {}", folder.path(kManifest).string(), why));
}

std::vector<ShardFile> files_of(const FoundShard& shard, const Manifest& m, bool atlas) {
  std::vector<ShardFile> files;
  for (const auto& [index, frame] : m.frames) {
    const MadeFrom from = m.frame_from(index), facts{from.facts, from.facts};
    const std::string json = frame_file(m.scenario, index, FileKind::json);
    files.push_back({&shard, json, FileKind::json, facts});
    files.push_back({&shard, frame_file(m.scenario, index, m.format), m.format, from});
    for (std::uint64_t k = 1; k <= frame.in_betweens; ++k)
      files.push_back(
          {&shard, in_between_file(m, index, k), m.format, m.in_between_from(index, k)});
  }
  if (atlas)
    for (const FileKind kind : {m.format, FileKind::json})
      files.push_back({&shard, atlas_file(m.scenario, kind), kind, m.atlas_from()});
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

// Each of the files must be whole, and tell what the manifest does. What else lies in the shard's
// folder stays there, and is named.
void require_whole(const ShardSet& set, const FoundShard& shard, const Manifest& m,
                   const std::vector<ShardFile>& files) {
  const Folder folder = folder_in_part(set, shard, m.scenario);
  std::vector<std::string> bad, others;
  std::set<std::string> own = {kManifest};
  for (const ShardFile& file : files) {
    stop_if_asked();
    own.insert(file.name);
    const auto bytes = whole_bytes(folder, file);
    if (!bytes) bad.push_back(file.name);
    if (!bytes || file.kind != FileKind::json) continue;
    const auto index = frame_of(file.name, m.scenario.text());
    if (index && !say_the_same(*bytes, m, *index))
      refuse(
          set, shard,
          fmt::format("{} and {} do not say the same of frame {}", kManifest, file.name, *index));
  }
  if (!bad.empty())
    refuse(set, shard,
           fmt::format("{}{} missing or not as Lantern made it", bad[0],
                       bad.size() > 1 ? fmt::format(" and {} more are", bad.size() - 1) : " is"));
  for (const std::string& name : folder.names())
    if (!own.contains(name)) others.push_back(name);
  const std::string what = "not of shard " + shard.record.shard.text() + ", left where it is";
  if (!others.empty()) say(about_files(m.scenario.text(), what.c_str(), others));
}

// Without their frames: two parts of one run must not differ in them.
std::string head_of(Manifest m) {
  m.frames.clear();
  return to_json(m);
}

// Nothing if no frame of it was chosen by anybody.
std::optional<MergedSequence> gather(const ShardSet& set, std::size_t index) {
  std::optional<MergedSequence> whole;
  for (const FoundShard* shard : set.shards) {
    const ShardInput& input = shard->record.inputs[index];
    if (input.here == 0) continue;
    Manifest part = manifest_of(set, *shard, input);
    std::vector<ShardFile> files = files_of(*shard, part, input.atlas);
    require_whole(set, *shard, part, files);
    if (!whole) {
      whole = MergedSequence{std::move(part), std::move(files)};
      continue;
    }
    if (head_of(whole->manifest) != head_of(part))
      throw UsageError("'{}' in '{}' tells of another run than the other shards",
                       part.scenario.text(), shard->path());
    whole->manifest.frames.merge(part.frames);
    std::ranges::move(files, std::back_inserter(whole->files));
  }
  // As the parts that stepped it say, none of those that were chosen is missing.
  const std::size_t frames = whole ? whole->manifest.frames.size() : 0;
  for (const FoundShard* shard : set.shards) {
    const ShardInput& input = shard->record.inputs[index];
    if (input.chosen != 0 ? input.chosen == frames : frames > 0 || !set.takes_all()) continue;
    refuse(set, *shard,
           fmt::format("inputs[{}].chosen is {} in {}: of '{}' the parts have {}", index,
                       input.chosen, kShardFile, input.name.text(), counted(frames, "frame")));
  }
  return whole;
}

// Where both have a shard, they must have the same.
void require_equal(const ShardSet& set, const FoundShard& a, const FoundShard& b) {
  for (std::size_t i = 0; i < set.run().inputs.size(); ++i) {
    const ShardInput &first = a.record.inputs[i], &second = b.record.inputs[i];
    bool same = first.here == second.here && first.atlas == second.atlas;
    if (same && first.here > 0) {
      const Manifest m = manifest_of(set, a, first);
      same = to_json(m) == to_json(manifest_of(set, b, second));
      const Folder one = folder_in_part(set, a, first.name);
      const Folder other = folder_in_part(set, b, first.name);
      for (const ShardFile& file : files_of(a, m, first.atlas))
        same = same && whole_bytes(one, file) == whole_bytes(other, file);
    }
    if (!same)
      throw UsageError("'{}' and '{}' are both shard {}, but differ in '{}'", a.path(), b.path(),
                       a.record.shard.text(), first.name.text());
  }
}

// As a run does it: a manifest of nothing first, that of all frames last. How many of its files
// were there already.
std::size_t write_whole(const ShardSet& set, const Folder& output, const MergedSequence& whole) {
  Manifest begun = whole.manifest;
  begun.frames.clear();
  begun.finished = false;
  const FrameFolder folder(output, begun, set.takes_all());
  folder.remove_old();
  const auto write = [&](const std::string& name, const std::string& bytes) {
    write_file({folder.folder(), name}, bytes);
  };
  write(kManifest, to_json(begun));
  std::size_t kept = 0;
  std::set<std::string> written = {kManifest};
  for (const ShardFile& file : whole.files) {
    stop_if_asked();
    if (folder.stands(file.name)) {
      ++kept;
      continue;
    }
    const auto bytes = whole_bytes(folder_in_part(set, *file.shard, begun.scenario), file);
    if (!bytes) throw IoError("'{}' has changed meanwhile", file.name);
    write(file.name, *bytes);
    written.insert(file.name);
  }
  folder.tell_of_strange(written);
  write(kManifest, to_json(whole.manifest));
  folder.folder().settle();
  return kept;
}

// Makes in the folder `into` what one run without --shard would have made, and gives the exit code
// of that run; `json` gets members of what was done. Nothing is written before all that the shards
// say of themselves was found right.
int merge_frames(const ShardSet& set, const std::string& into, JsonWriter& json) {
  for (const auto& [first, second] : set.twins) require_equal(set, *first, *second);
  std::vector<MergedSequence> sequences;
  for (std::size_t i = 0; i < set.run().inputs.size(); ++i)
    if (auto whole = gather(set, i)) sequences.push_back(std::move(*whole));
  std::uint64_t unmet = 0;
  const Folder output = Folder::made(into);
  require_kept_for(KeptFor::frames, output);
  json.line().key("scenarios").begin_array();
  for (const MergedSequence& whole : sequences) {
    const std::size_t frames = whole.manifest.frames.size();
    const std::string& name = whole.manifest.scenario.text();
    const std::string path = output.path(name).string();
    const std::size_t kept = write_whole(set, output, whole);
    unmet += whole.manifest.unmet;
    json.line().object("scenario", name, "folder", path, "frames", frames, "written",
                       whole.files.size() - kept, "kept", kept);
    say(fmt::format("{}: {} frames of {} shards in {}{}", name, frames, set.run().shard.of, path,
                    kept > 0 ? fmt::format(", {} files of them there already", kept) : ""));
  }
  json.line().end_array();
  if (unmet > 0) complain(fmt::format("{} expectations did not hold", unmet));
  return unmet > 0 ? kFailed : kGood;
}

int merge_parts(const MergeOptions& options) {
  const ShardSet set(options.folders.empty() ? std::vector{options.output} : options.folders);
  std::vector<std::uint32_t> numbers;  // of those that are missing
  std::error_code none;
  const bool is_there = fs::is_directory(options.output, none);
  for (std::uint32_t i = 0; i < set.shards.size(); ++i) {
    const FoundShard* shard = set.shards[i];
    if (shard == nullptr) numbers.push_back(i + 1);
    // The whole would stand where a part of it does.
    if (shard != nullptr && is_there && shard->folder.is(Folder(options.output)))
      throw UsageError("'{}' is the folder of shard {}; give another one for the whole",
                       options.output, shard->record.shard.text());
  }
  for (const std::uint32_t number : numbers) complain(set.missing(number));
  JsonWriter json = answer_of("merge");
  json.lines("command", "render", "shards", set.run().shard.of, "merged", numbers.empty());
  json.line().member("missing", numbers);
  const int code = numbers.empty() ? merge_frames(set, options.output, json) : int{kFailed};
  json.line().end_object();
  if (options.json) answer(json.text());
  return code;
}

}  // namespace

std::vector<Command> merge_commands() {
  return {command("merge", "Make one folder of the parts that --shard has made", merge_parts,
                  merge_options)};
}

}  // namespace lantern::app
