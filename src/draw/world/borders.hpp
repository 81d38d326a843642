// The lines of a grid of cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "draw/draw_list.hpp"

namespace lantern::draw {

// Borders of many cells as few long lines: pieces on one line that touch are joined.
class Borders {
 public:
  // `node` tells whose border it is.
  void add(const Box<2>& cell, std::uint32_t depth, std::uint32_t node) {
    pieces_.push_back({depth, 0, rounded(cell.lo.y), cell.lo.x, cell.hi.x, node, Side::upper});
    pieces_.push_back({depth, 0, rounded(cell.hi.y), cell.lo.x, cell.hi.x, node, Side::lower});
    pieces_.push_back({depth, 1, rounded(cell.lo.x), cell.lo.y, cell.hi.y, node, Side::left});
    pieces_.push_back({depth, 1, rounded(cell.hi.x), cell.lo.y, cell.hi.y, node, Side::right});
  }

  // Only what lies within the place.
  void add_inside(const Box<2>& place, const Box<2>& cell, std::uint32_t depth) {
    for (int axis = 0; axis < 2; ++axis) {
      const int across = 1 - axis;  // a line along `axis` is at one place across it
      const double from = std::max(cell.lo[axis], place.lo[axis]);
      const double to = std::min(cell.hi[axis], place.hi[axis]);
      for (const double at : {cell.lo[across], cell.hi[across]})
        if (place.lo[across] < at && at < place.hi[across])
          pieces_.push_back({depth, axis, rounded(at), from, to, 0, Side::upper});
    }
  }

  // Deep ones first, so that the stronger lines of the upper levels lie on top. When there are too
  // many, whole levels are left out from the deepest on, and the answer is false. A line is the
  // first node's on it: key_of(node) with the side added. A new one unfolds, as one would draw it.
  template <class StrokeOf, class KeyOf>
  bool draw(const StrokeOf& stroke_of, const KeyOf& key_of, DrawList& list) {
    return draw_each([&](const Piece& p, const Vec<2>& from, const Vec<2>& to) {
      constexpr std::array<const char*, 4> kSides{"/upper", "/lower", "/left", "/right"};
      const std::string key = key_of(p.node) + kSides[static_cast<std::size_t>(p.side)];
      const DrawList::Scope scope(list, key, key);
      list.crisp_line(from, to, stroke_of(p.depth));
    });
  }
  // The lines alone, as a part of what is being shown.
  bool draw_plainly(const Stroke& stroke, DrawList& list) {
    return draw_each([&](const Piece&, const Vec<2>& from, const Vec<2>& to) {
      list.crisp_line(from, to, stroke);
    });
  }

 private:
  enum class Side { upper, lower, left, right };

  bool draw_each(const auto& line) {
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
      line(p, from, to);
    }
    return count == pieces_.size();
  }

  static constexpr std::size_t kMost = 800;
  struct Piece {
    std::uint32_t depth;
    int axis;  // 0 level, 1 upright
    double at, from, to;
    std::uint32_t node;
    Side side;
    auto key() const { return std::tie(depth, axis, at, from, to, node, side); }
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
