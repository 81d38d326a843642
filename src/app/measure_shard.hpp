// `lantern measure --shard`: which problems, and the record of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/shard.hpp"
#include "app/shard_record.hpp"
#include "measure/plan.hpp"

namespace lantern::app {

// The problems are dealt out. Each stays whole: its runs are timed in turn, so that what else the
// machine does falls on all alike, and times of two machines would not be comparable.
class MeasureShard {
 public:
  // Leaves in the plan what belongs to the shard; without --shard, all. Throws UsageError for words
  // that name no shard.
  MeasureShard(const MeasureOptions& options, PlanOptions& plan);

  bool is_one() const { return shard_.has_value(); }
  std::string folder() const;  // for its report

  // The folder is there; `here` is how and where it is measured.
  void begin(const Plan& plan, const Circumstances& here);
  // All jobs of the plan have their rows on the disk.
  void finish(const Plan& plan);

 private:
  const MeasureOptions& options_;
  std::optional<Shard> shard_;
  std::vector<ShardInput> all_;
  std::vector<std::size_t> places_;  // among all, of each scenario that is left in the plan
  std::optional<ShardFolder> folder_;
};

}  // namespace lantern::app
