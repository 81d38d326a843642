// Sorting by comparisons that are the same everywhere.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lantern {

// Merges runs of twice the length each time: n log2 n comparisons at most, and always the same
// ones, since they are counted. Those of std::sort are up to the library.
template <class T, class Before>
void merge_sort(std::vector<T>& list, const Before& before) {
  const std::size_t count = list.size();
  std::vector<T> merged;
  merged.reserve(count);
  for (std::size_t run = 1; run < count; run *= 2) {
    merged.clear();
    for (std::size_t low = 0; low < count; low += 2 * run) {
      const std::size_t middle = std::min(low + run, count), end = std::min(low + 2 * run, count);
      for (std::size_t a = low, b = middle; a < middle || b < end;)
        merged.push_back(a == middle || (b < end && before(list[b], list[a])) ? list[b++]
                                                                              : list[a++]);
    }
    list.swap(merged);
  }
}

// What is nearly in order is put in order by moving each a little; else, after `most` moves, by
// sorting it. How many moves it took.
template <class T, class Before>
std::size_t sort_nearly_sorted(std::vector<T>& list, std::size_t most, const Before& before) {
  std::size_t moves = 0;
  for (std::size_t i = 1; i < list.size(); ++i) {
    const T one = list[i];
    std::size_t hole = i;
    for (; hole > 0 && moves < most && before(one, list[hole - 1]); --hole, ++moves)
      list[hole] = list[hole - 1];
    list[hole] = one;
    if (moves < most) continue;
    merge_sort(list, before);
    break;
  }
  return moves;
}

}  // namespace lantern
