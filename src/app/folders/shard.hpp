// `render --shard`: what of a run belongs to a shard, and the record of it, shard.json.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command.hpp"
#include "app/folders/frame_folder.hpp"
#include "app/output/render_job.hpp"
#include "base/file.hpp"
#include "language/scenario.hpp"

namespace lantern::app {

// `--shard 2/4`: the second of four equal parts of a run.
struct Shard {
  static constexpr std::uint32_t kMost = 10'000;

  std::uint32_t number = 1;  // from 1
  std::uint32_t of = 1;

  std::string text() const;  // "2/4"
  bool operator==(const Shard&) const = default;
};

// What stands after --shard; nothing if nothing does. Throws UsageError unless it is "I/N" with
// 1 <= I <= N <= kMost.
std::optional<Shard> parse_shard(const std::string& words);

// Of the frames chosen of one scenario: those that a shard draws.
struct Part {
  std::uint64_t nth = 1, first = 0;  // every nth, from the first on; none if nth is 0

  bool is_all() const { return nth == 1; }
  bool is_none() const { return nth == 0; }
  bool has(std::uint64_t position) const { return nth > 0 && position % nth == first; }
  // Of so many.
  std::uint64_t count(std::uint64_t frames) const;
};

// A part of each of these scenarios, of which is known at most how many frames each gives, if that
// is known. A scenario must be stepped by every shard that draws any of it; so the short ones stay
// whole, the longest first, each with the shard that has least to draw. One that is longer than a
// quarter of a shard's share, or of unknown length, is dealt out frame by frame. The parts of all
// shards have every frame once, whatever the true lengths are.
std::vector<Part> parts_of(const Shard& shard,
                           const std::vector<std::optional<std::uint64_t>>& frames);

// The command line of these words for another shard, "lantern render x.toml --shard 2/4".
std::string command_for(Words words, const Shard& shard);

// One scenario of the whole run.
struct ShardInput {
  ScenarioName name;
  std::string text;          // hash of what it says, 16 digits
  std::uint64_t here = 0;    // of its frames, how many are in this shard
  std::uint64_t chosen = 0;  // and in all shards; 0 if this one did not come to know it
  bool atlas = false;        // its finished atlas is in this shard, too
};

struct ShardRecord {
  Shard shard;
  std::string version, sources;                 // of the program that wrote it
  std::map<std::string, std::string> settings;  // all that the result depends on, by name
  std::vector<ShardInput> inputs;               // of the whole run, in order
  std::vector<std::string> words;               // of the command line
  bool finished = false;
};

inline constexpr const char* kShardFile = "shard.json";

// Of this program and this command line.
ShardRecord new_record(const Shard& shard);

std::string to_json(const ShardRecord& record);
// Throws RefusedFile (app/folders/kept_files.hpp) for a text that is damaged, or not as to_json
// wrote it.
ShardRecord read_record(std::string_view json);

// What of the settings a manifest tells, by the same names.
std::map<std::string, std::string> settings_told_by(const Manifest& manifest);
// How a manifest contradicts the record's settings: "theme is \"dark\", the record says \"light\"".
std::optional<std::string> contradiction(const Manifest& manifest, const ShardRecord& record);

// How many digits the numbers of in-betweens have.
int in_between_digits(const ShardRecord& record);

// How two records of one run would differ, as "the size is 160x90 in the first, 320x180 in the
// second"; nothing if they are parts of one run. The number of the shard, and what is in it, may
// differ.
std::optional<std::string> difference(const ShardRecord& a, const ShardRecord& b);

// The options of a shard: the same, but into the shard's own folder, OUT/shard-2-of-4. Throws
// UsageError for words that name no shard, and for an output that is no folder.
RenderOptions options_of_shard(const RenderOptions& options);

// The folder that the frames' folders stand in: the user's own, or the shard's within it. Made
// where it is missing. Throws IoError, and UsageError for a folder that is kept for something else.
Folder output_folder(const RenderOptions& options);

// A run that may be a shard, and the record of it while it is made: on the disk from the beginning,
// as not finished.
class RenderShard {
 public:
  // Cuts the run, and begins the shard's folder; without --shard all parts are whole and nothing is
  // written. Throws UsageError for frames that a scenario cannot have, and IoError.
  RenderShard(const RenderJob& job, const std::vector<Scenario>& scenarios);

  const Part& part(std::size_t scenario) const { return parts_[scenario]; }
  // So many frames of this scenario stand, of so many chosen; has the folder its atlas?
  void drawn(std::size_t scenario, std::uint64_t here, std::uint64_t chosen, bool atlas);
  // All that belongs to the shard stands.
  void finish();

 private:
  std::vector<Part> parts_;
  std::optional<Folder> folder_;  // of a shard
  std::optional<FolderLock> lock_;
  ShardRecord record_;
};

}  // namespace lantern::app
