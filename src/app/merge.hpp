// What `lantern merge` does with the shards of each command. Each makes in options.output what one
// run without --shard would have made, gives the exit code of that run, and throws UsageError for
// the same shard twice with other contents; UnfitShard for one that is not whole. All shards are
// there, finished.
#pragma once

#include <stdexcept>

#include "app/commands.hpp"
#include "app/shard_set.hpp"
#include "base/json_writer.hpp"

namespace lantern::app {

// A shard that says it is finished, but is not as it was written.
class UnfitShard : public std::runtime_error {
 public:
  UnfitShard(const ShardSet& set, const FoundShard& shard, const std::string& what);
};

// `json` gets members of what was done.
int merge_frames(const ShardSet& set, const MergeOptions& options, JsonWriter& json);
int merge_measurements(const ShardSet& set, const MergeOptions& options, JsonWriter& json);
int merge_stress(const ShardSet& set, const MergeOptions& options, JsonWriter& json);

}  // namespace lantern::app
