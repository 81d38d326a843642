// The lines of a grid of cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "draw/draw_list.hpp"

namespace lantern::draw {

// Borders of many cells as few long lines: pieces on one line that touch are joined.
class Borders {
 public:
  void add(const Box<2>& cell, std::uint32_t depth) {
    for (const double y : {cell.lo.y, cell.hi.y})
      pieces_.push_back({depth, 0, rounded(y), cell.lo.x, cell.hi.x});
    for (const double x : {cell.lo.x, cell.hi.x})
      pieces_.push_back({depth, 1, rounded(x), cell.lo.y, cell.hi.y});
  }

  // Only what lies within the place.
  void add_inside(const Box<2>& place, const Box<2>& cell, std::uint32_t depth) {
    for (int axis = 0; axis < 2; ++axis) {
      const int across = 1 - axis;  // a line along `axis` is at one place across it
      const double from = std::max(cell.lo[axis], place.lo[axis]);
      const double to = std::min(cell.hi[axis], place.hi[axis]);
      for (const double at : {cell.lo[across], cell.hi[across]})
        if (place.lo[across] < at && at < place.hi[across])
          pieces_.push_back({depth, axis, rounded(at), from, to});
    }
  }

  // Deep ones first, so that the stronger lines of the upper levels lie on top. When there are too
  // many, whole levels are left out from the deepest on, and the answer is false.
  template <class StrokeOf>
  bool draw(const StrokeOf& stroke_of, DrawList& list) {
    join();
    std::size_t count = 0;
    while (count < pieces_.size() && count < kMost) {
      const auto level_end =
          std::find_if(pieces_.begin() + static_cast<std::ptrdiff_t>(count), pieces_.end(),
                       [&](const Piece& p) { return p.depth != pieces_[count].depth; });
      const auto end = static_cast<std::size_t>(level_end - pieces_.begin());
      if (count > 0 && end > kMost) break;
      count = end;
    }
    count = std::min(count, kMost);
    for (std::size_t i = count; i-- > 0;) {
      const Piece& p = pieces_[i];
      const bool upright = p.axis == 1;
      const Vec<2> from = upright ? Vec<2>(p.at, p.from) : Vec<2>(p.from, p.at);
      const Vec<2> to = upright ? Vec<2>(p.at, p.to) : Vec<2>(p.to, p.at);
      list.crisp_line(from, to, stroke_of(p.depth));
    }
    return count == pieces_.size();
  }

 private:
  static constexpr std::size_t kMost = 800;
  struct Piece {
    std::uint32_t depth;
    int axis;  // 0 level, 1 upright
    double at, from, to;
    auto key() const { return std::tie(depth, axis, at, from, to); }
  };
  // Neighbours compute the same border by different sums; a 64th of a unit is below any pixel.
  static double rounded(double x) { return std::round(x * 64) / 64; }

  void join() {
    std::ranges::sort(pieces_, {}, &Piece::key);
    std::vector<Piece> joined;
    for (const Piece& p : pieces_) {
      Piece* const last = joined.empty() ? nullptr : &joined.back();
      if (last && std::tie(last->depth, last->axis, last->at) == std::tie(p.depth, p.axis, p.at) &&
          p.from <= last->to + 1.0 / 64)
        last->to = std::max(last->to, p.to);
      else
        joined.push_back(p);
    }
    pieces_ = std::move(joined);
  }

  std::vector<Piece> pieces_;
};

}  // namespace lantern::draw
