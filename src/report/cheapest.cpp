#include "report/cheapest.hpp"

#include <algorithm>

namespace lantern {
namespace {

struct Priced {
  const Row* row = nullptr;
  double cost = 0;
};

bool is_less(const Priced& a, const Priced& b) {
  return a.cost < b.cost || (a.cost == b.cost && *a.row->error() < *b.row->error());
}

// Each method's cheapest run, in order of their first rows.
std::vector<Priced> best_of_each(std::span<const Row* const> rows, const Cost& cost) {
  std::vector<Priced> best;
  for (const Row* row : rows) {
    const auto price = cost(*row);
    if (!price) continue;
    const Priced one{row, *price};
    const auto known = std::ranges::find_if(
        best, [&](const Priced& other) { return other.row->method == row->method; });
    if (known == best.end())
      best.push_back(one);
    else if (is_less(one, *known))
      *known = one;
  }
  return best;
}

}  // namespace

bool costs_the_same(const Timing& faster, const Timing& slower) {
  return slower.median - faster.median <= std::max(faster.spread(), slower.spread()) &&
         slower.least <= faster.median + faster.spread();
}

std::vector<const Row*> cheapest_rows(std::span<const Row* const> rows, const Cost& cost,
                                      bool timed) {
  std::vector<Priced> best = best_of_each(rows, cost);
  std::ranges::stable_sort(best, is_less);
  std::vector<const Row*> group;
  for (const Priced& one : best) {
    const Priced& first = best[0];
    if (timed ? costs_the_same(first.row->timing, one.row->timing) : one.cost == first.cost)
      group.push_back(one.row);
  }
  return group;
}

}  // namespace lantern
