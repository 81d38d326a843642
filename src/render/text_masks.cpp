#include "render/text_masks.hpp"

#include <algorithm>
#include <cmath>

#include "render/canvas.hpp"
#include "render/dilate.hpp"

namespace lantern {
void TextMasks::forget() {
  masks_.clear();
  glyphs_.clear();
}

const GlyphBitmap& TextMasks::glyph(int index, Weight weight, double pixels, int place) {
  const auto [it, fresh] = glyphs_.try_emplace({index, weight, pixels, place});
  if (fresh)
    it->second = rasterise_glyph(index, weight, pixels, static_cast<double>(place) / kGlyphPlaces);
  return it->second;
}

const Mask& TextMasks::mask(const TextKey& key) {
  const auto it = masks_.find(key);
  if (it != masks_.end()) return it->second;
  const Mask made = key.halo > 0 ? halo(key) : letters(key);
  return masks_.emplace(key, made).first->second;
}

Mask TextMasks::letters(const TextKey& key) {
  struct Placed {
    const GlyphBitmap* bitmap;
    int left, top;
  };
  std::vector<Placed> placed;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  for (const PlacedGlyph& g : shape_text(key.text, key.pixels, key.weight)) {
    const int x = static_cast<int>(rounded(kGlyphPlaces * g.x)) + key.place;
    const GlyphBitmap& bitmap = glyph(g.glyph, key.weight, key.pixels, x & (kGlyphPlaces - 1));
    if (bitmap.width == 0 || bitmap.height == 0) continue;
    const Placed p{&bitmap, (x >> kGlyphBits) + bitmap.left, bitmap.top};
    const bool first = placed.empty();
    x0 = first ? p.left : std::min(x0, p.left);
    y0 = first ? p.top : std::min(y0, p.top);
    x1 = first ? p.left + bitmap.width : std::max(x1, p.left + bitmap.width);
    y1 = first ? p.top + bitmap.height : std::max(y1, p.top + bitmap.height);
    placed.push_back(p);
  }
  const auto size = static_cast<std::size_t>(x1 - x0) * (y1 - y0);
  const Mask mask{store_.add(size), x0, y0, x1 - x0, y1 - y0};
  for (const Placed& p : placed) {
    const std::uint8_t* from = p.bitmap->coverage.data();
    for (int y = 0; y < p.bitmap->height; ++y) {
      std::uint8_t* to =
          store_.at(mask.offset) + std::ptrdiff_t{p.top - y0 + y} * mask.width + (p.left - x0);
      for (int x = 0; x < p.bitmap->width; ++x, ++from, ++to) *to = std::max(*to, *from);
    }
  }
  return mask;
}

Mask TextMasks::halo(const TextKey& key) {
  TextKey plain = key;
  plain.halo = 0;
  const Mask inner = mask(plain);
  if (inner.width == 0 || inner.height == 0) return inner;
  const int margin = static_cast<int>(std::ceil(key.halo + 0.5));
  const std::vector<std::uint8_t> wide =
      dilated({store_.at(inner.offset), static_cast<std::size_t>(inner.width) * inner.height},
              inner.width, inner.height, margin, key.halo);
  const Mask mask{store_.add(wide.size()), inner.left - margin, inner.top - margin,
                  inner.width + 2 * margin, inner.height + 2 * margin};
  std::copy(wide.begin(), wide.end(), store_.at(mask.offset));
  return mask;
}

}  // namespace lantern
