#include "run/counters.hpp"

#include "language/counts.hpp"
#include "run/structure_picture.hpp"
#include "run/world_picture.hpp"

namespace lantern::run {

using Rows = std::span<const CountDoc>;

Rows engine_counts(), step_counts(), answer_counts(), narrow_counts(), level_counts(),
    atlas_counts(), step_measures(), narrow_measures();

namespace {

// In the order of the reference.
const bool kAreKnown = [] {
  for (const Rows rows :
       {engine_counts(), Rows(kStructureCounts), step_counts(), Rows(kWorldCounts), answer_counts(),
        narrow_counts(), level_counts(), atlas_counts()})
    add_counts(rows);
  for (const Rows rows :
       {Rows(kStructureMeasures), Rows(kWorldMeasures), step_measures(), narrow_measures()})
    add_measures(rows);
  return true;
}();

}  // namespace

bool counts_are_known() { return kAreKnown; }

}  // namespace lantern::run
