// Which runs no other run beats.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "measure/row.hpp"

namespace lantern::report {

// What a run costs; nothing for one that cannot be compared.
using Cost = std::function<std::optional<double>(const Row&)>;

// Indices of the points of which no other has both an error and a cost that are not larger, and one
// of them less; ascending in cost. Of equal points the first. Points that are not finite are out.
std::vector<std::size_t> pareto_front(std::span<const Vec<2>> cost_and_error);

// The same of rows, which should be of one problem: those that are ok, with an error and a cost.
std::vector<std::size_t> pareto_front(std::span<const Row> rows, const Cost& cost);

// Seconds of a whole run; nothing for a row that was not timed.
std::optional<double> seconds_of(const Row& row);

}  // namespace lantern::report
