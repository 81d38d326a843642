// Which runs no other run beats, and who gets there for the least: the one place where a winner is
// chosen.
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

// Whether `slower` cost as much as `faster`, as far as their timings tell: their medians differ by
// no more than the larger of their spreads (interquartile range), and the slower one was once as
// fast as the faster one mostly is. The latter because a few repeats may be spread by what else the
// machine does.
bool costs_the_same(const Timing& faster, const Timing& slower);

// The cheapest run of each of those that cost as little as the cheapest: it first, then ascending
// in cost, one a method. Empty if no row has a cost. Those that were timed cost the same if
// costs_the_same; work is counted, so there only equal counts are. Of equal ones that with less
// error comes first. Rows must have an error.
std::vector<const Row*> cheapest_rows(std::span<const Row* const> rows, const Cost& cost,
                                      bool timed);

}  // namespace lantern::report
