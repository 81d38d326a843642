#include "report/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace lantern::report {
// A sweep in order of cost: a point is on the front if it has less error than all cheaper ones
// (Kung, Luccio, Preparata, "On Finding the Maxima of a Set of Vectors", 1975, for two dimensions).
std::vector<std::size_t> pareto_front(std::span<const Vec<2>> cost_and_error) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cost_and_error.size(); ++i)
    if (std::isfinite(cost_and_error[i].x) && std::isfinite(cost_and_error[i].y))
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Vec<2>&p = cost_and_error[a], &q = cost_and_error[b];
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || cost_and_error[i].y < cost_and_error[front.back()].y) front.push_back(i);
  return front;
}

std::vector<std::size_t> pareto_front(std::span<const Row> rows, const Cost& cost) {
  std::vector<Vec<2>> points;
  for (const Row& row : rows) {
    const auto error = row.error(), price = cost(row);
    points.push_back(error && price ? Vec<2>{*price, *error} : Vec<2>(std::nan("")));
  }
  return pareto_front(points);
}

std::optional<double> seconds_of(const Row& row) {
  if (row.timing.repeats < 1 || !std::isfinite(row.timing.median)) return std::nullopt;
  return row.timing.median;
}

bool costs_the_same(const Timing& faster, const Timing& slower) {
  return slower.median - faster.median <= std::max(faster.spread(), slower.spread()) &&
         slower.least <= faster.median + faster.spread();
}

std::vector<const Row*> cheapest_rows(std::span<const Row* const> rows, const Cost& cost,
                                      bool timed) {
  struct Priced {
    const Row* row = nullptr;
    double cost = 0;
  };
  std::vector<Priced> all;
  for (const Row* row : rows)
    if (const auto price = cost(*row)) all.push_back({row, *price});
  std::ranges::stable_sort(all, {},
                           [](const Priced& p) { return std::pair(p.cost, *p.row->error()); });
  std::set<std::string> methods;  // each by its cheapest run
  std::vector<const Row*> group;
  for (const auto& [row, price] : all)
    if (methods.insert(row->method).second &&
        (timed ? costs_the_same(all[0].row->timing, row->timing) : price == all[0].cost))
      group.push_back(row);
  return group;
}

}  // namespace lantern::report
