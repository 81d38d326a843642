// shard.json: what a shard's folder holds, and of what it is a part.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/shard.hpp"

namespace lantern::app {

// One scenario, problem or case of the whole run.
struct ShardInput {
  std::string name;
  std::string text;        // hash of what it says, 16 digits; empty for a case of the program's own
  std::uint64_t here = 0;  // of its frames, rows or cases, how many are in this shard
  bool atlas = false;      // its finished atlas is in this shard, too
};

struct ShardRecord {
  std::string command;  // "render", "measure", "stress"
  Shard shard;
  std::string version, sources;                 // of the program that wrote it
  std::map<std::string, std::string> settings;  // all that the result depends on, by name
  std::vector<ShardInput> inputs;               // of the whole run, in order
  std::vector<std::string> words;               // of the command line
  bool finished = false;
};

inline constexpr const char* kShardFile = "shard.json";

// Of this program and this command line.
ShardRecord new_record(std::string command, const Shard& shard);

std::string to_json(const ShardRecord& record);
// Nothing for a text that is damaged or of another format.
std::optional<ShardRecord> read_record(std::string_view json);

// How two records of one run would differ, as "the size is 160x90 in the first, 320x180 in the
// second"; nothing if they are parts of one run. The number of the shard, and what is in it, may
// differ.
std::optional<std::string> difference(const ShardRecord& a, const ShardRecord& b);

// The record of a shard while it is made: on the disk from the beginning, as not finished.
class ShardFolder {
 public:
  // The folder must be there, and nobody else may write into it meanwhile. Throws IoError.
  ShardFolder(const std::filesystem::path& path, ShardRecord record);

  // To be told of what each input has here, and then, when all of it stands, to be finished.
  ShardInput& input(std::size_t index) { return record_.inputs[index]; }
  void finish();

 private:
  std::filesystem::path path_;
  ShardRecord record_;
};

}  // namespace lantern::app
