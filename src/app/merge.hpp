// What `lantern merge` does with shards that are all there, finished.
#pragma once

#include <stdexcept>
#include <string>

#include "app/shard_set.hpp"
#include "base/json_writer.hpp"

namespace lantern::app {

// A shard that says it is finished, but is not as it was written.
class UnfitShard : public std::runtime_error {
 public:
  UnfitShard(const ShardSet& set, const FoundShard& shard, const std::string& what);
};

// Makes in the folder `into` what one run without --shard would have made, and gives the exit code
// of that run; `json` gets members of what was done. Nothing is written before all that the shards
// say of themselves was found right: throws UsageError for the same shard twice with other
// contents, UnfitShard for one that is not whole.
int merge_frames(const ShardSet& set, const std::string& into, JsonWriter& json);

}  // namespace lantern::app
