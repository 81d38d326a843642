#include "render/dilate.hpp"

#include <algorithm>
#include <cmath>

namespace lantern {
namespace {

constexpr float kFar = 1e12f;

// For each i the least of (i - j)^2 + f[j]: the lower envelope of parabolas, one for each j.
class Envelope {
 public:
  explicit Envelope(int most) : f_(most), at_(most), from_(most + 1) {}

  std::vector<float>& values() { return f_; }  // f, to be filled before solve()

  template <class Store>
  void solve(int n, Store store) {
    int last = -1;  // index of the envelope's last parabola
    for (int j = 0; j < n; ++j) {
      if (f_[j] >= kFar) continue;
      float meet = -kFar;  // where parabola j gets below the last one
      while (last >= 0) {
        const int k = at_[last];
        meet =
            (f_[j] - f_[k] + static_cast<float>(j * j - k * k)) / static_cast<float>(2 * (j - k));
        if (meet > from_[last]) break;
        --last;
        meet = -kFar;
      }
      ++last;
      at_[last] = j;
      from_[last] = meet;
    }
    for (int i = 0, k = 0; i < n; ++i) {
      while (k < last && from_[k + 1] < static_cast<float>(i)) ++k;
      const int d = last < 0 ? 0 : i - at_[k];
      store(i, last < 0 ? kFar : static_cast<float>(d * d) + f_[at_[k]]);
    }
  }

 private:
  std::vector<float> f_;
  std::vector<int> at_;
  std::vector<float> from_;
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
  std::vector<float>& f = envelope.values();
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

}  // namespace lantern
