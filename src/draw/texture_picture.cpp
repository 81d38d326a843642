#include "draw/texture_picture.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

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
    std::vector<Vec<2>> points;
    for (const Vec<2>& corner : corners) points.push_back(at(corner));
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
    const double x = 16 * std::pow(std::sin(t), 3);
    const double y = 13 * std::cos(t) - 5 * std::cos(2 * t) - 2 * std::cos(3 * t) - std::cos(4 * t);
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

}  // namespace

void draw_texture(const FrameTexture& texture, const Box<2>& rect, double scale, int most_parts,
                  DrawList& list, bool turned) {
  if (texture.picture == Picture::pattern || most_parts < 1)
    return draw_pattern(texture.id, texture.color, rect, scale, most_parts, list, turned);
  list.rect(rect, body_role(texture.color));
  Easel easel(texture, rect, turned, list);
  switch (texture.picture) {
    case Picture::pattern:
      return;
    case Picture::heart:
      return paint_heart(easel);
    case Picture::sword:
      return paint_sword(easel);
    case Picture::potion:
      return paint_potion(easel);
    case Picture::coin:
      return paint_coin(easel);
    case Picture::map:
      return paint_map(easel);
  }
}

}  // namespace lantern::draw
