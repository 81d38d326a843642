// Pairs in order of their lower, then their higher number, without comparing them with each other:
// counted into one row for each lower number; short rows are put in order by insertion, long ones
// by a bit for each number. To put millions of pairs in order by comparisons takes longer than to
// find them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "spatial/box_table.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

class PairOrder {
 public:
  // The pairs, each once, with `names[number]` for each number; instead of what `ordered` held. The
  // names ascend. `found` may name a pair in both ways, and more than once; it is used as scratch.
  void order(FoundPairs& found, std::span<const BodyId> names, std::vector<Pair>& ordered);

  // Places for which there is memory.
  std::size_t places() const { return begin_.capacity() + partners_.capacity() + bits_.capacity(); }

 private:
  void count_rows(FoundPairs& found, std::size_t numbers);
  std::span<std::uint32_t> in_order(std::span<std::uint32_t> row);
  std::span<std::uint32_t> by_bits(std::span<std::uint32_t> row);

  std::vector<std::uint32_t> begin_;     // of each row in partners_
  std::vector<std::uint32_t> partners_;  // the higher numbers
  std::vector<std::uint64_t> bits_;      // all zero between rows
};

// The same of pairs of numbers below `numbers`, for who has no need to keep the memory.
void order_pairs(std::vector<Pair>& pairs, std::uint32_t numbers);

}  // namespace lantern::spatial
