#include "draw/pattern.hpp"

#include <cmath>

#include "draw/draw_list.hpp"
#include "draw/pen.hpp"

namespace lantern::draw {
namespace {

// A rectangle under the pattern's pen. Columns and rows are counted so that whole cells fill it.
class Swatch {
 public:
  Swatch(const Box<2>& rect, Role role, double cell, int most, DrawList& list)
      : rect_(rect), size_(rect.size()), role_(role), cell_(cell), most_(most), list_(list) {}

  // Bars across one axis: every second of an odd number of equal strips.
  void bars(int axis) {
    const int strips = 2 * count(size_[axis] / (2 * cell_), most_) + 1;
    const double step = size_[axis] / strips;
    for (int i = 1; i < strips; i += 2) {
      Box<2> bar = rect_;
      bar.lo[axis] = rect_.lo[axis] + i * step;
      bar.hi[axis] = rect_.lo[axis] + (i + 1) * step;
      add(bar);
    }
  }

  // Bars at 45 degrees, leaning right (1) or left (-1).
  void diagonals(int lean) {
    const double reach = size_.x + size_.y;
    const int n = count(reach / (2.8 * cell_), most_);
    const double step = reach / n;
    for (int i = 0; i < n; ++i) {
      const double from = rect_.lo.x + (i + 0.25) * step, to = from + 0.5 * step;
      const auto lower = [&](double x) { return x - size_.y; };
      std::vector<Vec<2>> bar{
          {lower(from), rect_.hi.y}, {lower(to), rect_.hi.y}, {to, rect_.lo.y}, {from, rect_.lo.y}};
      if (lean < 0)
        for (Vec<2>& p : bar) p.x = rect_.lo.x + rect_.hi.x - p.x;
      bar = cut_to(std::move(bar), rect_);
      if (bar.size() >= 3) list_.polygon(std::move(bar), role_);
    }
  }

  enum class Part { square, disc, diamond };

  // One part in each cell of a grid, or in every second one as on a chessboard.
  void grid(Part part, double radius, bool chess) {
    int columns = count(size_.x / (1.7 * cell_), most_);
    int rows = count(size_.y / (1.7 * cell_), most_);
    while (columns * rows > (chess ? 2 * most_ - 1 : most_)) (columns > rows ? columns : rows) -= 1;
    const Vec<2> cell{size_.x / columns, size_.y / rows};
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        if (chess && (row + column) % 2 == 1) continue;
        const Vec<2> center = rect_.lo + Vec<2>((column + 0.5) * cell.x, (row + 0.5) * cell.y);
        const double r = radius * std::min(cell.x, cell.y);
        if (part == Part::square) add(Box<2>::around(center, cell * 0.5));
        if (part == Part::disc) list_.disc(center, r, role_);
        if (part == Part::diamond)
          list_.polygon({center - Vec<2>(r, 0), center - Vec<2>(0, r), center + Vec<2>(r, 0),
                         center + Vec<2>(0, r)},
                        role_);
      }
  }

  // Frames inside frames, each a stroke.
  void frames() {
    const double least = std::min(size_.x, size_.y);
    const int n = count(least / (4 * cell_), std::min(most_, 6));
    const double width = least / (4 * n + 1.0);
    for (int i = 0; i < n; ++i)
      list_.rect(shrunk(rect_, width * (2 * i + 1.5)), Role::none, {role_, width});
  }

 private:
  static int count(double wanted, int most) {
    return std::clamp(static_cast<int>(std::min(wanted, 1e6)), 1, most);
  }
  void add(const Box<2>& box) { list_.rect(box, role_); }

  Box<2> rect_;
  Vec<2> size_;
  Role role_;
  double cell_;
  int most_;
  DrawList& list_;
};

}  // namespace

void draw_pattern(std::uint32_t id, int color, const Box<2>& rect, double scale, int most_parts,
                  DrawList& list, bool turned) {
  list.rect(rect, body_role(color));
  if (most_parts < 1) return;
  Swatch swatch(rect, body_mark_role(color), 6.5 * scale, std::min(most_parts, kMostPatternParts),
                list);
  using Part = Swatch::Part;
  // Shifted once a round, so that equal colours eight textures apart get different patterns.
  const auto pattern = (id + id / kPatterns) % kPatterns;
  if (pattern == 0) swatch.diagonals(turned ? -1 : 1);
  if (pattern == 1) swatch.grid(Part::disc, 0.28, false);
  if (pattern == 2) swatch.bars(turned ? 1 : 0);
  if (pattern == 3) swatch.grid(Part::square, 0.5, true);
  if (pattern == 4) swatch.bars(turned ? 0 : 1);
  if (pattern == 5) swatch.grid(Part::diamond, 0.36, false);
  if (pattern == 6) swatch.diagonals(turned ? 1 : -1);
  if (pattern == 7) swatch.frames();
}

}  // namespace lantern::draw
