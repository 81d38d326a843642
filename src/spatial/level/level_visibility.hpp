// Which sectors of a level can see which: the visibility matrix that Quake's levels were shipped
// with, exact for a map seen from above.
//
//      +---------+      A portal is the part of two sectors' common border that is no wall. Who
//      | 0  |L   |      looks from sector 0 through portals into sector 2 has all their left ends
//      |    :  1 |      on the left of the line of sight, all their right ends on its right:
//      |    |R   |      sector 2 is visible through them exactly if a line parts the left ends
//      |    +L..R+      from the right ones. The search goes from sector to sector, through all
//      |    | 2  |      portals that such a line still passes together with those before.
//      +---------+
//
// Portals and rows of the matrix: Airey, "Increasing update rates in the building walkthrough
// system with automatic model-space subdivision and potentially visible set calculations" (1990).
// The parting line: Teller, "Visibility computations in densely occluded polyhedral environments"
// (1992). It parts the ends if its normal n has n · (left - right) > 0 for each left and each right
// end: if their differences lie within less than half a turn, which two of them bound.
//
// One-sided walls hide what is behind them; two-sided ones, steps and windows, do not. A beam
// narrower than the level's tolerance does not count: who only touches a corner sees nothing.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "spatial/level/level_bsp.hpp"

namespace lantern::spatial {

// An opening between two sectors.
struct Portal {
  std::uint32_t a = 0;
  std::uint32_t b = 0;  // greater than a
  Segment<2> line;      // a's floor lies on its left, b's on its right
};

// Two sectors that see each other, and a line of sight from the floor of one to that of the other.
struct Sight {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Segment<2> line;  // crosses no one-sided wall
};

struct VisibilityConfig {
  std::uint32_t most_sectors = 4096;
  std::uint64_t most_tests = std::uint64_t{1} << 24;  // of a portal against a view
};

class LevelVisibility {
 public:
  std::uint32_t sectors() const { return sectors_; }
  std::span<const Portal> portals() const { return portals_; }
  std::span<const Sight> sights() const { return sights_; }  // of each pair that sees each other
  // Sectors below this one are done: all that they see is known.
  std::uint32_t done() const { return done_; }
  // Each sector sees itself.
  bool sees(std::uint32_t a, std::uint32_t b) const { return sees_[a * sectors_ + b] != 0; }
  // How often a portal was held against the view through others.
  std::uint64_t portals_tested() const { return portals_tested_; }

 private:
  friend class SightFinder;
  std::uint32_t sectors_ = 0;
  std::uint32_t done_ = 0;
  std::vector<Portal> portals_;
  std::vector<Sight> sights_;
  std::vector<char> sees_;  // row by row
  std::uint64_t portals_tested_ = 0;
};

// Told when the portals are known, before any sector is done, and then after each sector.
using VisibilityObserver = std::function<void(const LevelVisibility&)>;

// The whole matrix. Throws Refused for a level of more sectors, or that needs more tests, than the
// config allows.
LevelVisibility find_visibility(const LevelBsp& level, const VisibilityConfig& config = {},
                                const VisibilityObserver& observer = {});

}  // namespace lantern::spatial
