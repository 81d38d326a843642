// The inner loop of all candidate pairs; see box_table.hpp for its door.
#pragma once

#include <cstddef>
#include <span>

#include "spatial/box_table.hpp"

namespace lantern::spatial {

template <int D>
struct ScanTask {
  const BoxTable<D>& queries;
  const BoxTable<D>& table;
  std::span<const Item<D>> exact;
  std::span<const ScanRun> runs;
};

struct ScanRoom {
  BodyId* first;
  BodyId* second;
};

struct ScanDone {
  std::size_t runs = 0;   // of the task, from its first
  std::size_t pairs = 0;  // that the lists hold now
};

// Writes behind `begin` pairs, and ends before a run that might find more than up to `end`. What
// lies up to BoxTable::kPadding places behind the last pair is overwritten.
ScanDone scan_runs(const ScanTask<2>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end);
ScanDone scan_runs(const ScanTask<3>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end);

}  // namespace lantern::spatial
