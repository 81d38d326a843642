#include "spatial/pair_order.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "base/stop.hpp"

namespace lantern::spatial {
namespace {

constexpr std::size_t kShortRow = 24;

bool is_in_order(const FoundPairs& found) {
  const auto a = found.first(), b = found.second();
  for (std::size_t i = 0; i < found.size(); ++i)
    if (a[i] >= b[i] || (i > 0 && (a[i - 1] > a[i] || (a[i - 1] == a[i] && b[i - 1] >= b[i]))))
      return false;
  return true;
}

}  // namespace

void PairOrder::order(FoundPairs& found, std::span<const BodyId> names,
                      std::vector<Pair>& ordered) {
  ordered.resize(found.size());
  Pair* next = ordered.data();
  if (is_in_order(found)) {
    for (std::size_t i = 0; i < found.size(); ++i)
      *next++ = {names[found.first()[i]], names[found.second()[i]]};
    return;
  }
  count_rows(found, names.size());
  for (std::uint32_t a = 0, begin = 0; a < names.size(); begin = begin_[a++]) {
    const std::uint32_t end = begin_[a];  // the rows were filled: each began where it ends now
    if (begin == end) continue;
    stop_if_asked();
    const BodyId name = names[a];
    for (const std::uint32_t b : in_order(std::span(partners_).subspan(begin, end - begin)))
      *next++ = {name, names[b]};
  }
  ordered.resize(static_cast<std::size_t>(next - ordered.data()));
}

void PairOrder::count_rows(FoundPairs& found, std::size_t numbers) {
  const std::span<BodyId> lower = found.first(), higher = found.second();
  begin_.assign(numbers + 1, 0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto [low, high] = std::minmax({lower[i], higher[i]});
    lower[i] = low;
    higher[i] = high;
    ++begin_[low];
  }
  std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), 0u);
  if (partners_.size() < found.size()) partners_.resize(std::max(found.size(), found.reserved()));
  for (std::size_t i = 0; i < found.size(); ++i) partners_[begin_[lower[i]]++] = higher[i];
}

// Each once.
std::span<std::uint32_t> PairOrder::in_order(std::span<std::uint32_t> row) {
  if (row.size() > kShortRow) return by_bits(row);
  std::size_t size = 0;
  for (const std::uint32_t value : row) {
    std::size_t at = size;
    while (at > 0 && row[at - 1] > value) --at;
    if (at > 0 && row[at - 1] == value) continue;
    std::copy_backward(row.begin() + at, row.begin() + size, row.begin() + size + 1);
    row[at] = value;
    ++size;
  }
  return row.first(size);
}

// Where the numbers of a row lie far apart there would be more words to look at than it is worth.
std::span<std::uint32_t> PairOrder::by_bits(std::span<std::uint32_t> row) {
  const auto [least, most] = std::ranges::minmax(row);
  const std::size_t first = least / 64, last = most / 64;
  if (last - first > 8 * row.size()) {
    std::ranges::sort(row);
    return row.first(static_cast<std::size_t>(std::ranges::unique(row).begin() - row.begin()));
  }
  if (bits_.size() <= last) bits_.resize(last + 1);
  for (const std::uint32_t value : row) bits_[value / 64] |= std::uint64_t{1} << value % 64;
  std::size_t size = 0;
  for (std::size_t word = first; word <= last; ++word)
    for (std::uint64_t bits = std::exchange(bits_[word], 0); bits != 0; bits &= bits - 1)
      row[size++] = static_cast<std::uint32_t>(64 * word + std::countr_zero(bits));
  return row.first(size);
}

void order_pairs(std::vector<Pair>& pairs, std::uint32_t numbers) {
  FoundPairs found;
  found.reserve(pairs.size(), 0);
  for (const Pair& pair : pairs) found.add(pair.a, pair.b);
  std::vector<BodyId> names(numbers);
  std::iota(names.begin(), names.end(), BodyId{0});
  PairOrder().order(found, names, pairs);
}

}  // namespace lantern::spatial
