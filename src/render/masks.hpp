// Coverage masks of polygons and letters, and dashes of lines.
#pragma once

#include <map>
#include <span>
#include <tuple>

#include "draw/font.hpp"
#include "geometry/box.hpp"
#include "render/canvas.hpp"
#include "render/instances.hpp"

namespace lantern::render {

// A straight piece of a dash. Its ends are square; where the dash goes on round a corner, the end
// reaches beyond it so that the two pieces meet without a notch.
struct DashPiece {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
};

// Dashes of length `dash` with gaps as long, from the first point on, of lines `width` wide. Only
// pieces that may touch `visible` are made. `closed` joins the last point to the first.
std::vector<DashPiece> cut_dashes(const std::vector<Vec<2>>& points, bool closed, double dash,
                                  double width, const Box<2>& visible);

// The outline of a box with round corners, clockwise from the upper left corner's right end, where
// SVG starts too. No corner of the polyline is farther from the arc than a tenth of a unit.
std::vector<Vec<2>> outline_of(const Box<2>& box, double radius);

// A directed edge in pixels: x and y of its first point, x and y of its last.
using Edge = std::array<double, 4>;

// The share of each pixel of `rect` to the right of the edges, those going down counting +1, those
// going up -1; exact up to rounding, with 0 ... 1 as 0 ... 255. `winding` is added: edges to the
// left of all of `rect` may be left out for it, those to the right may be left out altogether.
// Self- intersections are filled by the non-zero rule, but not exactly. `mask` holds the rows of
// `rect`.
void fill_coverage(std::span<const Edge> edges, int winding, const PixelRect& rect,
                   std::uint8_t* mask);

// The coverage by a line along the edges, round at the corners, half_line to each side. False if
// none of the pixels is touched; then `mask` is left as it was.
bool line_coverage(std::span<const Edge> edges, double half_line, const PixelRect& rect,
                   std::uint8_t* mask);

// A part of a polygon's bounds: inside, or with masks in the store, row by row.
struct PolygonTile {
  PixelRect rect;
  std::int32_t fill = 0;    // index of the mask; 0 if all pixels are inside
  std::int32_t stroke = 0;  // index of the mask; 0 if the outline touches no pixel
};

class PolygonMasks {
 public:
  explicit PolygonMasks(MaskStore& store) : store_(store) {}
  void forget() { known_.clear(); }

  // Corners in pixels; half_line is half the width of the outline, 0 for none. Only tiles that the
  // polygon touches, in the image of `canvas`; that must be the same one until forget().
  const std::vector<PolygonTile>& tiles(const std::vector<Vec<2>>& corners, double half_line,
                                        const Canvas& canvas);

 private:
  MaskStore& store_;
  std::map<std::vector<double>, std::vector<PolygonTile>> known_;
};

// The coverage of all points within `radius` pixels of `coverage` (width x height, rows from the
// top), in an image that is larger by `margin` on each side. By the exact distance transform of
// Felzenszwalb and Huttenlocher (2012), in time that does not depend on the radius.
std::vector<std::uint8_t> dilated(std::span<const std::uint8_t> coverage, int width, int height,
                                  int margin, double radius);

// Where a letter may stand between two pixels: fine enough that words neither jitter when they move
// nor look unevenly spaced, coarse enough that a letter is drawn once for most of its places.
inline constexpr int kGlyphBits = 4, kGlyphPlaces = 1 << kGlyphBits;

// A mask in the store: `offset` is its first byte, its corner lies at (left, top) from the pixel
// that holds the text's origin, y down. Empty for blanks.
struct Mask {
  std::int32_t offset = 0;
  int left = 0, top = 0, width = 0, height = 0;
};

// A line of text at an em of `pixels`, its origin `place` of kGlyphPlaces parts of a pixel right of
// a whole one. `halo` pixels wide around the letters, or the letters themselves when 0.
struct TextKey {
  std::string text;
  Weight weight = Weight::regular;
  double pixels = 0;
  int place = 0;
  double halo = 0;
  auto tied() const { return std::tie(text, weight, pixels, place, halo); }
  bool operator<(const TextKey& other) const { return tied() < other.tied(); }
};

class TextMasks {
 public:
  explicit TextMasks(MaskStore& store) : store_(store) {}
  void forget();

  const Mask& mask(const TextKey& key);

 private:
  const GlyphBitmap& glyph(int index, Weight weight, double pixels, int place);
  Mask letters(const TextKey& key);
  Mask halo(const TextKey& key);

  MaskStore& store_;
  std::map<std::tuple<int, Weight, double, int>, GlyphBitmap> glyphs_;
  std::map<TextKey, Mask> masks_;
};

}  // namespace lantern::render
