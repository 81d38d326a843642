// Candidate pairs: two bodies that share a leaf.
#pragma once

#include "base/error.hpp"
#include "base/stop.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

struct CandidatePairs {
  std::vector<Pair> pairs;       // each once, in order of ids
  std::uint64_t pair_tests = 0;  // pairs met, leaf by leaf, before duplicates fell out
};

// Millions of them take seconds: the wish to stop is heard.
inline void sort_pairs(std::vector<Pair>& pairs) {
  std::ranges::sort(pairs, [](const Pair& x, const Pair& y) {
    stop_if_asked();
    return x < y;
  });
}

// n(n-1)/2
constexpr std::uint64_t all_pairs(std::uint64_t n) { return n < 2 ? 0 : n * (n - 1) / 2; }

// Those of n bodies that brute force would test: not both of the `never_move` that never do.
constexpr std::uint64_t testable_pairs(std::uint64_t n, std::uint64_t never_move) {
  return all_pairs(n) - all_pairs(never_move);
}

// Throws Refused if more pairs meet than `budget`.
inline void require_within(std::uint64_t met, std::uint64_t budget) {
  if (met > budget)
    throw Refused(
        "{} pairs meet in the leaves, the limit is {}; take fewer bodies, or a structure that "
        "parts them better",
        met, budget);
}

// How many pairs meet in the leaves; needs no memory, so it may be asked before collecting them.
template <int D>
std::uint64_t count_pair_tests(const Structure<D>& structure) {
  std::uint64_t tests = 0;
  structure.visit([&](const NodeView<D>& node) {
    if (node.leaf) tests += all_pairs(node.bodies.size());
    return true;
  });
  return tests;
}

// What the broad phase hands on: the pairs that meet in the leaves and that `wanted(Pair) -> bool`
// lets through, if it is given, each once, in order of ids. A pair is met in each leaf that both
// reach, so duplicates are sorted out. Throws Refused if more than `budget` pairs meet: coincident
// bodies have n(n-1)/2 of them.
template <int D>
CandidatePairs candidate_pairs(const Structure<D>& structure, std::uint64_t budget,
                               FunctionRef<bool(const Pair&)> wanted = {}) {
  CandidatePairs found;
  found.pair_tests = count_pair_tests(structure);
  require_within(found.pair_tests, budget);
  structure.visit([&](const NodeView<D>& node) {
    for (std::size_t i = 0; i < node.bodies.size(); ++i) {
      stop_if_asked();
      for (std::size_t j = i + 1; j < node.bodies.size(); ++j)
        if (const Pair pair{node.bodies[i], node.bodies[j]}; !wanted || wanted(pair))
          found.pairs.push_back(pair);
    }
    return true;
  });
  sort_pairs(found.pairs);
  found.pairs.erase(std::unique(found.pairs.begin(), found.pairs.end()), found.pairs.end());
  return found;
}

}  // namespace lantern::spatial
