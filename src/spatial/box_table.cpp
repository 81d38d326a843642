#include "spatial/box_table.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/stop.hpp"
#include "spatial/box_scan.hpp"

namespace lantern::spatial {

template <int D>
void BoxTable<D>::resize(std::size_t size) {
  size_ = size;
  if (size + kPadding <= ids_.size()) return;
  for (int i = 0; i < D; ++i) {
    lo_[i].resize(size + kPadding);
    hi_[i].resize(size + kPadding);
  }
  ids_.resize(size + kPadding);
}

void FoundPairs::reserve(std::size_t pairs, BodyId body) {
  if (pairs <= first_.size()) return;
  const std::size_t size = std::max({pairs, 2 * first_.size(), std::size_t{512}});
  if (may_grow_) may_grow_(body, size);
  first_.resize(size);
  second_.resize(size);
}

// Room is made for what all runs of a few might find, but no more than is likely at once: a run
// that would not fit waits for more room.
template <int D>
void scan(const BoxTable<D>& queries, const BoxTable<D>& table, std::span<const Item<D>> exact,
          std::span<const ScanRun> runs, FoundPairs& found) {
  while (!runs.empty()) {
    stop_if_asked();
    const std::size_t next = runs.front().to - runs.front().from;
    found.reserve(found.size() + next + BoxTable<D>::kPadding, queries.id(runs.front().query));
    const ScanTask<D> task{queries, table, exact, runs};
    const ScanDone done = scan_runs(task, {found.first().data(), found.second().data()},
                                    found.size(), found.reserved() - BoxTable<D>::kPadding);
    found.resize(done.pairs);
    runs = runs.subspan(done.runs);
  }
}

template class BoxTable<2>;
template class BoxTable<3>;
template void scan(const BoxTable<2>&, const BoxTable<2>&, std::span<const Item<2>>,
                   std::span<const ScanRun>, FoundPairs&);
template void scan(const BoxTable<3>&, const BoxTable<3>&, std::span<const Item<3>>,
                   std::span<const ScanRun>, FoundPairs&);

}  // namespace lantern::spatial
