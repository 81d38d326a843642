// `lantern render --shard`: which frames of which scenario, and the record of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/folder_sink.hpp"
#include "app/render_job.hpp"
#include "app/shard.hpp"
#include "app/shard_record.hpp"
#include "base/file.hpp"
#include "base/folder_lock.hpp"

namespace lantern::app {

// The options of a shard: the same, but into the shard's own folder. Throws UsageError for words
// that name no shard, and for an output that is no folder.
RenderOptions options_of_shard(const RenderOptions& options);

// The folder that the frames' folders stand in: the user's own, or the shard's within it. Made
// where it is missing. Throws IoError, and UsageError for a folder that is kept for something else.
Folder output_folder(const RenderOptions& options);

class RenderShard {
 public:
  // Cuts the run, and begins the shard's folder; without --shard all parts are whole and nothing is
  // written. Throws UsageError for frames that a scenario cannot have, and IoError.
  RenderShard(const RenderJob& job, const std::vector<Scenario>& scenarios);

  const Part& part(std::size_t scenario) const { return parts_[scenario]; }
  // The frames of this scenario stand.
  void drawn(std::size_t scenario, const FolderSink& sink);
  // All that belongs to the shard stands.
  void finish();

 private:
  std::vector<Part> parts_;
  std::optional<FolderLock> lock_;
  std::optional<ShardFolder> folder_;
};

}  // namespace lantern::app
