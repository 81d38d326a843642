#include "draw/world/ledger_marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "draw/pen.hpp"

namespace lantern::draw {
namespace {

using frame::PairState;

// Three lines that lean right, on a grid of the cell's own.
void hatch_cell(const Box<2>& cell, const Stroke& stroke, DrawList& list) {
  const Vec<2> size = cell.size();
  for (const double share : {0.55, 1.0, 1.45}) {
    const double sum = share * size.x;  // where x and the height above the lower edge add up to it
    const double a = std::max(0.0, sum - size.x), b = std::min(size.x, sum);
    list.line({cell.lo.x + a, cell.lo.y + sum - a}, {cell.lo.x + b, cell.lo.y + sum - b}, stroke);
  }
}

// A square of bins, its lower left half.
class Density {
 public:
  static constexpr std::size_t kBins = 32;

  explicit Density(const Frame& frame) {
    std::size_t n = 0;
    for (const FrameBody& body : frame.bodies) {
      const std::size_t bin = n++ * kBins / frame.bodies.size();
      bin_of_[body.id] = bin;
      ++bodies_[bin];
      statics_[bin] += body.is_static;
    }
    for (const FramePair& p : frame.pairs) add(p.pair);
  }

  // Of the pairs that a broad phase could hand on, how many it did; none: there are no such pairs.
  double share(std::size_t row, std::size_t column) const {
    const double all = pairs_in(bodies_, row, column) - pairs_in(statics_, row, column);
    return all > 0 ? handed_on_[row * kBins + column] / all : 0;
  }

 private:
  using Numbers = std::array<double, kBins>;

  static double pairs_in(const Numbers& of, std::size_t row, std::size_t column) {
    return row == column ? of[row] * (of[row] - 1) / 2 : of[row] * of[column];
  }
  void add(const Pair& pair) {
    const auto a = bin_of_.find(pair.a), b = bin_of_.find(pair.b);
    if (a == bin_of_.end() || b == bin_of_.end()) return;
    const auto [column, row] = std::minmax(a->second, b->second);
    ++handed_on_[row * kBins + column];
  }

  std::unordered_map<BodyId, std::size_t> bin_of_;
  Numbers bodies_{}, statics_{};
  std::array<double, kBins * kBins> handed_on_{};
};

// The side of the square goes with the logarithm: trees hand on a few pairs in a hundred or in ten
// thousand.
void draw_share(const Vec<2>& center, double share, double cell, DrawList& list) {
  constexpr double kDecades = 3.5;
  if (!(share > 0)) return;
  const double size = 1 + std::log10(std::min(1.0, share)) / kDecades;
  const double half = 0.46 * cell * std::max(0.12, size);
  list.rect(Box<2>::around(center, Vec<2>(half)), Role::pair);
}

}  // namespace

void draw_pair_mark(PairState state, bool is_new, const Box<2>& cell, DrawList& list) {
  const double size = cell.size().x, width = std::clamp(0.07 * size, 0.9, 3.2);
  const Stroke strong{Role::pair, width}, weak{Role::rejected_pair, 0.8 * width};
  const Role ground = is_new ? Role::lit_fill : Role::panel;
  switch (state) {
    case PairState::untestable:
      return list.disc(cell.center(), std::max(0.8, 0.05 * size), Role::cell_line_3);
    case PairState::ruled_out:
      return list.rect(cell, Role::free_space, {Role::rule, std::min(width, 1.4)}, 0.06 * size);
    case PairState::candidate:
      list.rect(cell, ground, strong, 0.06 * size);
      break;
    case PairState::boxes_apart:
      list.rect(cell, ground, weak, 0.06 * size);
      hatch_cell(shrunk(cell, width / 2), weak, list);
      break;
    case PairState::shapes_apart: {
      list.rect(cell, ground, strong, 0.06 * size);
      const Box<2> inner = shrunk(cell, 0.2 * size);
      list.line(inner.lo, inner.hi, strong);
      list.line({inner.lo.x, inner.hi.y}, {inner.hi.x, inner.lo.y}, strong);
      break;
    }
    case PairState::contact:
      list.rect(cell, Role::contact, {Role::contact, width}, 0.06 * size);
      break;
  }
  if (is_new)
    list.rect(shrunk(cell, -0.6 * width), Role::none, {Role::lit, 1.2 * width}, 0.1 * size);
}

void draw_pair_density(const Frame& frame, const Box<2>& place, DrawList& list, Labels& labels) {
  const TextStyle style{24, Weight::regular, Role::ink};
  const double cell = std::floor(std::min(place.size().x, place.size().y) / Density::kBins);
  if (cell < 3 || frame.bodies.empty()) return;
  const Density density(frame);
  const auto center = [&](std::size_t row, std::size_t column) {
    return place.lo + (Vec<2>(static_cast<double>(column), static_cast<double>(row)) + 0.5) * cell;
  };
  const double side = cell * Density::kBins;
  list.polygon({place.lo, place.lo + Vec<2>(side, side), place.lo + Vec<2>(0, side)}, Role::panel,
               {Role::rule, 1.4});
  for (std::size_t row = 0; row < Density::kBins; ++row)
    for (std::size_t column = 0; column <= row; ++column)
      draw_share(center(row, column), density.share(row, column), cell, list);
  // In the free corner, right of the edge that goes down beside it.
  constexpr double kScales[] = {1.0, 0.1, 0.01, 0.001}, kLine = 34, kWidth = 130;
  const double x = place.lo.x + kLine * 5 + 24;
  if (x + kWidth > place.hi.x) return;
  double y = place.lo.y + 24;
  labels.try_add("tested", {{{x, y}, 0}}, style, place);
  for (const double share : kScales) {
    y += kLine;
    draw_share({x + 12, y - 8}, share, 24, list);
    labels.try_add(fmt::format("{:g} %", 100 * share), {{{x + 36, y}, 0}}, style, place);
  }
}

}  // namespace lantern::draw
