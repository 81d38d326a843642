// The shards that folders hold: whether they are parts of one run, and which are missing.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/shard_record.hpp"

namespace lantern::app {

struct FoundShard {
  Folder folder;
  ShardRecord record;
};

class ShardSet {
 public:
  // Looks into each folder: it is a shard's, or holds some (shard-2-of-4). Throws UsageError for a
  // folder with none, for a record that is not as Lantern writes it, for shards of another build
  // than this one, and, naming two folders and what differs, for shards that are no parts of one
  // run.
  explicit ShardSet(const std::vector<std::string>& folders);

  // A record of the run, of some shard.
  const ShardRecord& run() const { return found_.front().record; }
  // Of all its frames, not of some that were chosen.
  bool takes_all() const {
    return run().settings.at("frames").empty() && run().settings.at("at").empty();
  }
  // By number - 1; none where it is missing or not finished. Of several equal ones the first.
  const std::vector<const FoundShard*>& shards() const { return shards_; }
  // Finished ones whose number was there before, beside that one: to be held against each other.
  struct Twins {
    const FoundShard* first = nullptr;
    const FoundShard* second = nullptr;
  };
  const std::vector<Twins>& twins() const { return twins_; }

  // For each shard that is missing or not finished a sentence that says so, and what to run.
  std::vector<std::string> missing() const;
  // "run lantern render x.toml --shard 2/4"
  std::string advice(const Shard& shard) const;

 private:
  void look_into(const std::string& path);
  void take(const Folder& folder);
  void require_one_run() const;
  void sort_by_number();
  std::string names() const;

  std::vector<FoundShard> found_;
  std::vector<const FoundShard*> shards_;
  std::vector<Twins> twins_;
};

}  // namespace lantern::app
