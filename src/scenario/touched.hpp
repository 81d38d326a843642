// What the current step did to nodes, by handle.
#pragma once

#include <set>

#include "scenario/frame.hpp"

namespace lantern {

struct Touched {
  std::set<NodeHandle> lit;
  std::set<NodeHandle> passed;

  Mark mark_of(NodeHandle node) const {
    if (lit.contains(node)) return Mark::lit;
    return passed.contains(node) ? Mark::passed : Mark::quiet;
  }
};

}  // namespace lantern
