// What a loop over a range makes of it, in its order.
#pragma once

#include <algorithm>
#include <functional>
#include <ranges>
#include <type_traits>
#include <vector>

namespace lantern {

// f of each, as values of its own type or of the one that is asked for.
template <class T = void, class Range, class F>
auto mapped(Range&& range, const F& f) {
  using Value = std::decay_t<std::invoke_result_t<F, std::ranges::range_reference_t<Range>>>;
  std::vector<std::conditional_t<std::is_void_v<T>, Value, T>> all;
  for (auto&& one : range) all.push_back(std::invoke(f, one));
  return all;
}

// The sum of f of each.
template <class T, class Range, class F>
T sum_of(Range&& range, const F& f) {
  T sum{};
  for (auto&& one : range) sum += std::invoke(f, one);
  return sum;
}

// The greatest f of each, or `least` if that is greater.
template <class T, class Range, class F>
T greatest_of(T least, Range&& range, const F& f) {
  for (auto&& one : range) least = std::max<T>(least, std::invoke(f, one));
  return least;
}

}  // namespace lantern
