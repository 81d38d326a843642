// Lines of text, and their halos, as coverage masks, made on the CPU and kept from frame to frame.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "draw/font.hpp"
#include "render/instances.hpp"

namespace lantern::render {

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
