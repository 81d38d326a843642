// How large a grid's cells should be for the bodies at hand.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "spatial/grid_table.hpp"

namespace lantern::spatial {

// Half again as large as nearly all bodies (19 of 20) are, so that few are larger than a cell and
// each meets the bodies of three or four cells; but where sizes differ much, three times the
// median, and not so small that most cells would be empty. Measured on worlds of 1e3 to 1e6 bodies.
// Does not depend on the order of the items. `room` is scratch memory. Time: O(n).
template <int D>
double side_for(std::span<const Item<D>> items, std::vector<double>& room) {
  // Extents by their leading bits: eight of the exponent and two of the fraction.
  constexpr int kShift = 21;
  std::array<std::uint32_t, 2048> histogram{};
  for (const Item<D>& item : items) {
    const auto extent = static_cast<float>(std::clamp(extent_of(item.box), 0.0, 1e38));
    ++histogram[std::bit_cast<std::uint32_t>(extent) >> kShift];
  }
  // No less than this part of the extents.
  const auto quantile = [&](double part) {
    const auto wanted = static_cast<std::uint64_t>(part * static_cast<double>(items.size()));
    std::uint64_t seen = 0;
    std::uint32_t bin = 0;
    while (bin + 1 < 1024 && (seen += histogram[bin]) <= wanted) ++bin;
    return bin == 0 ? 0.0 : double{std::bit_cast<float>((bin + 1) << kShift)};
  };
  const double half = quantile(0.5), most = quantile(0.95);
  double side = std::min(1.5 * most, 3 * half);
  if (most > 4 * half || most == 0) {
    // Half of how far apart the bodies are, from where the middle half of them is.
    double volume = 1;
    for (int i = 0; i < D; ++i) {
      room.clear();
      for (const Item<D>& item : items) room.push_back(item.box.lo[i]);
      const auto at = [&](std::size_t place) {
        if (room.empty()) return 0.0;
        std::nth_element(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(place),
                         room.end());
        return room[place];
      };
      const double low = at(room.size() / 4),
                   high = at(room.size() - room.size() / 4 - !room.empty());
      volume *= std::pow(std::max(2 * (high - low), 0.0), 1.0 / D);
    }
    side = std::max(side, volume / std::pow(static_cast<double>(items.size() + 1), 1.0 / D) / 2);
  }
  return side > 0 ? std::clamp(side, 1e-100, 1e100) : 1;
}

}  // namespace lantern::spatial
