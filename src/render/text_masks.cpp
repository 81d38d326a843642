#include "render/text_masks.hpp"

#include <algorithm>
#include <cmath>

#include "render/canvas.hpp"

namespace lantern::render {
namespace {

constexpr float kFar = 1e12f;

// For each i the least of (i - j)^2 + f[j]: the lower envelope of parabolas, one for each j.
struct Envelope {
  explicit Envelope(int most) : f(most), at(most), from(most + 1) {}

  std::vector<float> f;  // to be filled before solve()
  std::vector<int> at;
  std::vector<float> from;

  template <class Store>
  void solve(int n, Store store) {
    int last = -1;  // index of the envelope's last parabola
    for (int j = 0; j < n; ++j) {
      if (f[j] >= kFar) continue;
      float meet = -kFar;  // where parabola j gets below the last one
      while (last >= 0) {
        const int k = at[last];
        meet = (f[j] - f[k] + static_cast<float>(j * j - k * k)) / static_cast<float>(2 * (j - k));
        if (meet > from[last]) break;
        --last;
        meet = -kFar;
      }
      ++last;
      at[last] = j;
      from[last] = meet;
    }
    for (int i = 0, k = 0; i < n; ++i) {
      while (k < last && from[k + 1] < static_cast<float>(i)) ++k;
      const int d = last < 0 ? 0 : i - at[k];
      store(i, last < 0 ? kFar : static_cast<float>(d * d) + f[at[k]]);
    }
  }
};

}  // namespace

std::vector<std::uint8_t> dilated(std::span<const std::uint8_t> coverage, int width, int height,
                                  int margin, double radius) {
  const int w = width + 2 * margin, h = height + 2 * margin;
  std::vector<float> square(static_cast<std::size_t>(w) * h, kFar);  // of the distance
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int c = coverage[static_cast<std::size_t>(y) * width + x];
      // The shape's edge lies about this far from the centre of a pixel that it half covers.
      const float off = 1 - static_cast<float>(c) / 255;
      if (c > 0) square[static_cast<std::size_t>(y + margin) * w + x + margin] = off * off;
    }
  Envelope envelope(std::max(w, h));
  std::vector<float>& f = envelope.f;
  for (int x = 0; x < w; ++x) {
    for (int y = 0; y < h; ++y) f[y] = square[static_cast<std::size_t>(y) * w + x];
    envelope.solve(h, [&](int y, float d) { square[static_cast<std::size_t>(y) * w + x] = d; });
  }
  std::vector<std::uint8_t> result(square.size());
  const auto reach = static_cast<float>(radius + 0.5);
  for (int y = 0; y < h; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * w;
    std::copy_n(square.begin() + static_cast<std::ptrdiff_t>(row), w, f.begin());
    envelope.solve(w, [&](int x, float d) {
      const float c = std::clamp(reach - std::sqrt(d), 0.0f, 1.0f);
      result[row + x] = static_cast<std::uint8_t>(c * 255 + 0.5f);
    });
  }
  return result;
}

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
  std::ranges::copy(wide, store_.at(mask.offset));
  return mask;
}

}  // namespace lantern::render
