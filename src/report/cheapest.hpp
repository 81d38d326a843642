// Who gets there for the least. The one place where a winner is chosen.
#pragma once

#include <span>
#include <vector>

#include "report/pareto.hpp"

namespace lantern {

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

}  // namespace lantern
