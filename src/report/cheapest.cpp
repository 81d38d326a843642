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

// Each contestant's cheapest run, in order of their first rows.
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

std::vector<const Row*> cheapest_rows(std::span<const Row* const> rows, const Cost& cost,
                                      bool timed) {
  std::vector<Priced> best = best_of_each(rows, cost);
  std::ranges::stable_sort(best, is_less);
  std::vector<const Row*> group;
  for (const Priced& one : best) {
    const double spread =
        timed ? std::max(one.row->timing.spread, best[0].row->timing.spread) : 0.0;
    if (one.cost - best[0].cost <= spread || &one == &best[0]) group.push_back(one.row);
  }
  return group;
}

}  // namespace lantern
