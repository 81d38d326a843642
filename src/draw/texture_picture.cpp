#include "draw/texture_picture.hpp"

#include <numbers>
#include <utility>
#include <vector>

#include "draw/pen.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
namespace {

using run::Picture;

// A rectangle whose points count from its upper left corner (0, 0) to its lower right one (1, 1);
// turned by 90 degrees with the texture.
class Easel {
 public:
  Easel(const FrameTexture& texture, const Box<2>& rect, bool turned, DrawList& list)
      : rect_(rect),
        turned_(turned),
        ground_(body_role(texture.color)),
        mark_(body_mark_role(texture.color)),
        least_(std::min(rect.size().x, rect.size().y)),
        list_(list) {}

  void polygon(const std::vector<Vec<2>>& corners) {
    std::vector<Vec<2>> points = mapped(corners, [&](const Vec<2>& corner) { return at(corner); });
    list_.polygon(std::move(points), mark_);
  }
  void line(const Vec<2>& from, const Vec<2>& to, double width, double dash = 0) {
    list_.line(at(from), at(to), {mark_, width * least_, dash * least_});
  }
  // Of the texture's ground or of its mark; the radius is a share of the smaller side.
  void disc(const Vec<2>& center, double radius, bool of_ground) {
    list_.disc(at(center), radius * least_, of_ground ? ground_ : mark_);
  }

 private:
  Vec<2> at(const Vec<2>& p) const {
    return rect_.lo + rect_.size() * (turned_ ? Vec<2>(1 - p.y, p.x) : p);
  }

  Box<2> rect_;
  bool turned_;
  Role ground_, mark_;
  double least_;
  DrawList& list_;
};

// The heart curve of sines and cosines (Weisstein, "Heart Curve", MathWorld).
void paint_heart(Easel& easel) {
  constexpr int kCorners = 40;
  std::vector<Vec<2>> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double t = 2 * std::numbers::pi * i / kCorners;
    const double x = 16 * geometry::pow(geometry::sin(t), 3);
    const double y = 13 * geometry::cos(t) - 5 * geometry::cos(2 * t) - 2 * geometry::cos(3 * t) -
                     geometry::cos(4 * t);
    outline.emplace_back(0.5 + 0.024 * x, 0.46 - 0.024 * y);
  }
  easel.polygon(outline);
}

void paint_sword(Easel& easel) {
  easel.polygon({{0.88, 0.12}, {0.85, 0.29}, {0.42, 0.71}, {0.29, 0.58}, {0.71, 0.15}});
  easel.line({0.20, 0.50}, {0.50, 0.80}, 0.09);
  easel.line({0.33, 0.67}, {0.18, 0.82}, 0.11);
}

void paint_potion(Easel& easel) {
  easel.polygon({{0.40, 0.24},
                 {0.60, 0.24},
                 {0.60, 0.42},
                 {0.85, 0.82},
                 {0.79, 0.90},
                 {0.21, 0.90},
                 {0.15, 0.82},
                 {0.40, 0.42}});
  easel.line({0.36, 0.15}, {0.64, 0.15}, 0.10);
  easel.disc({0.44, 0.72}, 0.06, true);
  easel.disc({0.59, 0.64}, 0.05, true);
}

void paint_coin(Easel& easel) {
  easel.disc({0.5, 0.5}, 0.39, false);
  easel.disc({0.5, 0.5}, 0.29, true);
  easel.line({0.5, 0.37}, {0.5, 0.63}, 0.11);
}

// Its folds, a way, and the cross at its end.
void paint_map(Easel& easel) {
  for (const double fold : {1.0 / 3, 2.0 / 3}) easel.line({fold, 0.04}, {fold, 0.96}, 0.025);
  const std::vector<Vec<2>> way{{0.12, 0.82}, {0.26, 0.62}, {0.5, 0.78}, {0.84, 0.68}};
  for (std::size_t i = 1; i < way.size(); ++i) easel.line(way[i - 1], way[i], 0.05, 0.07);
  easel.line({0.10, 0.16}, {0.24, 0.36}, 0.06);
  easel.line({0.24, 0.16}, {0.10, 0.36}, 0.06);
}

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

void draw_texture(const FrameTexture& texture, const Box<2>& rect, double scale, int most_parts,
                  DrawList& list, bool turned) {
  if (texture.picture == Picture::pattern || most_parts < 1)
    return draw_pattern(texture.id, texture.color, rect, scale, most_parts, list, turned);
  list.rect(rect, body_role(texture.color));
  Easel easel(texture, rect, turned, list);
  // In the order of Picture, without patterns.
  static constexpr void (*kPaint[])(Easel&) = {paint_heart, paint_sword, paint_potion, paint_coin,
                                               paint_map};
  kPaint[static_cast<std::size_t>(texture.picture) - 1](easel);
}

}  // namespace lantern::draw
