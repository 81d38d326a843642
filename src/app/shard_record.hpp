// shard.json: what a shard's folder holds, and of what it is a part.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/frame_folder.hpp"
#include "app/shard.hpp"
#include "base/file.hpp"
#include "scenario/scenario_name.hpp"

namespace lantern::app {

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
// Throws RefusedFile (app/json_members.hpp) for a text that is damaged, or not as to_json wrote it.
ShardRecord read_record(std::string_view json);

// What of the settings a manifest tells, by the same names.
std::map<std::string, std::string> settings_told_by(const Manifest& manifest);
// How a manifest contradicts the record's settings: "theme is \"dark\", the record says \"light\"".
std::optional<std::string> contradiction(const Manifest& manifest, const ShardRecord& record);

// How many digits the numbers of in-betweens have; nothing if the settings do not say it rightly.
std::optional<int> in_between_digits(const ShardRecord& record);

// How two records of one run would differ, as "the size is 160x90 in the first, 320x180 in the
// second"; nothing if they are parts of one run. The number of the shard, and what is in it, may
// differ.
std::optional<std::string> difference(const ShardRecord& a, const ShardRecord& b);

// The record of a shard while it is made: on the disk from the beginning, as not finished.
class ShardFolder {
 public:
  // The folder must be there, and nobody else may write into it meanwhile. Throws IoError.
  ShardFolder(Folder folder, ShardRecord record);

  // To be told of what each input has here, and then, when all of it stands, to be finished.
  ShardInput& input(std::size_t index) { return record_.inputs[index]; }
  void finish();

 private:
  Folder folder_;
  ShardRecord record_;
};

}  // namespace lantern::app
