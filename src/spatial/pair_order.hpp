// Pairs in order of their lower, then their higher number, without comparing them with each other:
// counted into one row for each lower number; short rows are put in order by insertion, long ones
// by a bit for each number. To put millions of pairs in order by comparisons takes longer than to
// find them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "spatial/box_table.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

class PairOrder {
 public:
  // The pairs, each once, with `names[number]` for each number, instead of what `ordered` held. The
  // names ascend. `found` may name a pair in both ways, and more than once; it is used as scratch,
  // and by as many threads as may scan for it.
  void order(FoundPairs& found, std::span<const BodyId> names, std::vector<Pair>& ordered);

  // Places for which there is memory.
  std::size_t places() const;

 private:
  // What one thread works on: some of the pairs that were found, later some of the rows.
  struct Part {
    std::vector<std::uint32_t> begin;  // of each row in partners_: where its own pairs go
    std::vector<std::uint64_t> bits;   // all zero between rows
    std::uint32_t first_row = 0, end_row = 0;
    std::size_t ordered = 0;  // how many pairs of its rows there are, each once
  };

  void fill_rows(FoundPairs& found);
  void share_rows(std::size_t pairs);
  void order_rows(Part& part, std::span<const BodyId> names, Pair* ordered);
  static std::span<std::uint32_t> in_order(std::span<std::uint32_t> row, Part& part);
  static std::span<std::uint32_t> by_bits(std::span<std::uint32_t> row, Part& part);

  std::vector<Part> parts_;
  std::vector<std::uint32_t> end_;       // of each row
  std::vector<std::uint32_t> partners_;  // the higher numbers, row by row
};

}  // namespace lantern::spatial
