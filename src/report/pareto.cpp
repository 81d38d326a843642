#include "report/pareto.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace lantern::report
