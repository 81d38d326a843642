#include "render/masks.hpp"

#include "geometry/closest.hpp"
#include "geometry/ray.hpp"

namespace lantern::render {
namespace {

// How far square ends must reach beyond a corner to close its notch: tan of half the turn times
// half the width, for right turns and sharper ones half the width.
double reach_at_corner(const Vec<2>& in, const Vec<2>& out, double width) {
  const double cosine = glm::dot(in, out);
  if (cosine <= 0) return 0.5 * width;
  const double sine = std::abs(in.x * out.y - in.y * out.x);
  return 0.5 * width * sine / (1 + cosine);
}

std::uint8_t byte(double share) { return static_cast<std::uint8_t>(share * 255 + 0.5); }

// Of a line that runs evenly from x = left to x = right while it crosses one row: the mean share of
// the pixel [0, 1] that lies right of it.
//
//     0    left     right  1       the triangle and what lies to its right
//     |      \  ####|######|
//     |       \ ####|######|
//     |        \####|######|
double share_right_of(double left, double right) {
  const double l = std::clamp(left, 0.0, 1.0), r = std::clamp(right, 0.0, 1.0);
  const double width = right - left;
  if (width < 1e-9) return 1 - 0.5 * (l + r);
  const double outside = std::max(std::min(right, 0.0) - left, 0.0);  // left of the pixel
  return (outside + (r - l) * (1 - 0.5 * (l + r))) / width;
}

// Adds one edge's part of one row to `change`: what each pixel has more than the one to its left.
void add_row(double left, double right, double height, int width, double* change) {
  if (left >= width) return;
  const int first = std::max(0, static_cast<int>(std::floor(left)));
  const int last = std::min(width - 1, static_cast<int>(std::floor(right)));
  double before = 0;
  for (int x = first; x <= last; ++x) {
    const double share = height * share_right_of(left - x, right - x);
    change[x] += share - before;
    before = share;
  }
  const int next = std::max(first, last + 1);
  if (next < width) change[next] += height - before;
}

constexpr int kTile = 64;  // pixels: smaller tiles mean more quads, larger ones more empty pixels

// Is the edge within reach of the circle round the rectangle?
bool is_near(const Edge& e, double reach, const PixelRect& r) {
  const Box<2> box{Vec<2>(r.x0, r.y0), Vec<2>(r.x1, r.y1)};
  const Vec<2> nearest = closest_point(Segment<2>{{e[0], e[1]}, {e[2], e[3]}}, box.center());
  return glm::distance(box.center(), nearest) <= 0.5 * glm::length(box.size()) + reach;
}

// The polygon's part in one tile, with masks where an edge or its line may touch a pixel; elsewhere
// all pixels are inside or outside, as the centre is.
void add_tile(std::span<const Edge> edges, double half_line, const PixelRect& r, MaskStore& store,
              std::vector<PolygonTile>& tiles) {
  int left_of_tile = 0, left_of_center = 0;  // windings
  bool any_near = false;
  std::vector<Edge> kept;  // what is not left of the tile over its whole height, nor beside it
  const double x = 0.5 * (r.x0 + r.x1), y = 0.5 * (r.y0 + r.y1);
  for (const Edge& e : edges) {
    const int turn = e[3] > e[1] ? 1 : -1;
    if ((e[1] <= y) != (e[3] <= y) && e[0] + (y - e[1]) / (e[3] - e[1]) * (e[2] - e[0]) < x)
      left_of_center += turn;
    const double top = std::min(e[1], e[3]), bottom = std::max(e[1], e[3]);
    const bool near = is_near(e, half_line + 1, r);
    any_near |= near;
    if (!near && (bottom <= r.y0 || top >= r.y1 || std::min(e[0], e[2]) >= r.x1)) continue;
    if (!near && std::max(e[0], e[2]) <= r.x0 && top <= r.y0 && bottom >= r.y1)
      left_of_tile += turn;
    else
      kept.push_back(e);
  }
  if (!any_near && left_of_center == 0) return;
  PolygonTile& tile = tiles.emplace_back(PolygonTile{r});
  if (!any_near) return;
  const auto pixels = static_cast<std::size_t>(r.area());
  tile.fill = store.add(pixels);
  fill_coverage(kept, left_of_tile, r, store.at(tile.fill));
  if (half_line <= 0) return;
  tile.stroke = store.add(pixels);
  if (!line_coverage(kept, half_line, r, store.at(tile.stroke))) tile.stroke = 0;
}

constexpr float kFar = 1e12f;

// For each i the least of (i - j)^2 + f[j]: the lower envelope of parabolas, one for each j.
struct Envelope {
  explicit Envelope(int most) : f(most), at(most), from(most + 1) {}

  std::vector<float> f;  // to be filled before solve()
  std::vector<int> at;
  std::vector<float> from;

  void solve(int n, auto store) {
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

std::vector<DashPiece> cut_dashes(const std::vector<Vec<2>>& points, bool closed, double dash,
                                  double width, const Box<2>& visible) {
  std::vector<DashPiece> pieces;
  std::vector<Vec<2>> corners;  // without repeated points
  for (const Vec<2>& p : points)
    if (corners.empty() || corners.back() != p) corners.push_back(p);
  if (closed && corners.size() > 1 && corners.front() != corners.back())
    corners.push_back(corners.front());
  const std::size_t segments = corners.empty() ? 0 : corners.size() - 1;
  const auto direction = [&](std::size_t i) { return glm::normalize(corners[i + 1] - corners[i]); };
  const Box<2> near{visible.lo - Vec<2>(width), visible.hi + Vec<2>(width)};
  const double period = 2 * dash;
  double start = 0;  // way along the outline to the segment's first point
  for (std::size_t i = 0; i < segments; ++i) {
    const Vec<2> from = corners[i], to = corners[i + 1], along = direction(i);
    const double length = glm::length(to - from);
    const RaySpan seen = span_in(Ray<2>{from, to - from, 1}, near).value_or(RaySpan{1, 0});
    const double before = i > 0 ? reach_at_corner(direction(i - 1), along, width) : 0;
    const double after = i + 1 < segments ? reach_at_corner(along, direction(i + 1), width) : 0;
    double number = std::floor((start + seen.from * length) / period);
    for (; seen.from <= seen.to && number * period < start + seen.to * length; ++number) {
      const double a = number * period - start, b = a + dash;  // from the segment's first point
      if (b <= 0 || a >= length) continue;
      const double first = a < 0 ? -before : a;
      const double last = b > length ? length + after : b;
      pieces.push_back({from + along * first, from + along * last});
    }
    start += length;
  }
  return pieces;
}

std::vector<Vec<2>> outline_of(const Box<2>& box, double radius) {
  std::vector<Vec<2>> points;
  // A chord over an angle t leaves the arc by r t^2 / 8.
  const int steps = radius <= 0 ? 0 : 1 + static_cast<int>(std::sqrt(3.1 * std::min(radius, 1e4)));
  const Vec<2> lo = box.lo + Vec<2>(radius), hi = box.hi - Vec<2>(radius);
  const Vec<2> centers[] = {{hi.x, lo.y}, {hi.x, hi.y}, {lo.x, hi.y}, {lo.x, lo.y}};
  Vec<2> from{0, -1}, to{1, 0};
  for (const Vec<2>& center : centers) {
    for (int i = 0; i <= steps; ++i) {
      // The quarter circle by its rational parameter: sines differ from one C library to the next.
      const double t = steps == 0 ? 0 : static_cast<double>(i) / steps;
      const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
      points.push_back(center + radius * (c * from + s * to));
    }
    from = to;
    to = {-to.y, to.x};
  }
  return points;
}

void fill_coverage(std::span<const Edge> edges, int winding, const PixelRect& rect,
                   std::uint8_t* mask) {
  const int width = rect.x1 - rect.x0, height = rect.y1 - rect.y0;
  std::vector<double> change(static_cast<std::size_t>(width) * height);
  for (const Edge& e : edges) {
    const bool down = e[3] > e[1];
    const double x0 = (down ? e[0] : e[2]) - rect.x0, y0 = (down ? e[1] : e[3]) - rect.y0;
    const double x1 = (down ? e[2] : e[0]) - rect.x0, y1 = (down ? e[3] : e[1]) - rect.y0;
    if (y0 == y1) continue;
    const double slope = (x1 - x0) / (y1 - y0);
    const auto x_at = [&](double y) {
      return std::clamp(x0 + (y - y0) * slope, std::min(x0, x1), std::max(x0, x1));
    };
    const int first = static_cast<int>(std::floor(std::max(y0, 0.0)));
    const int last = static_cast<int>(std::ceil(std::min<double>(y1, height))) - 1;
    for (int y = first; y <= last; ++y) {
      const double top = std::max<double>(y, y0), bottom = std::min<double>(y + 1, y1);
      const double xa = x_at(top), xb = x_at(bottom);
      add_row(std::min(xa, xb), std::max(xa, xb), down ? bottom - top : top - bottom, width,
              change.data() + static_cast<std::ptrdiff_t>(y) * width);
    }
  }
  const double* next = change.data();
  for (int y = 0; y < height; ++y) {
    double sum = winding;
    for (int x = 0; x < width; ++x) *mask++ = byte(std::min(std::abs(sum += *next++), 1.0));
  }
}

bool line_coverage(std::span<const Edge> edges, double half_line, const PixelRect& rect,
                   std::uint8_t* mask) {
  const int width = rect.x1 - rect.x0, height = rect.y1 - rect.y0;
  const double reach = half_line + 0.5;
  std::vector<double> nearest(static_cast<std::size_t>(width) * height, reach * reach);
  for (const Edge& e : edges) {
    // From here on relative to the centre of rect's first pixel.
    const double ax = e[0] - rect.x0 - 0.5, ay = e[1] - rect.y0 - 0.5;
    const double wx = e[2] - e[0], wy = e[3] - e[1], square = wx * wx + wy * wy;
    const auto whole = [](double v, int most) {
      return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(most)));
    };
    const int x0 = whole(std::ceil(std::min(ax, ax + wx) - reach), width);
    const int x1 = whole(std::floor(std::max(ax, ax + wx) + reach) + 1, width);
    const int y0 = whole(std::ceil(std::min(ay, ay + wy) - reach), height);
    const int y1 = whole(std::floor(std::max(ay, ay + wy) + reach) + 1, height);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const double px = x - ax, py = y - ay;
        const double t = square > 0 ? std::clamp((px * wx + py * wy) / square, 0.0, 1.0) : 0;
        const double dx = px - t * wx, dy = py - t * wy;
        double& d = nearest[static_cast<std::size_t>(y) * width + x];
        d = std::min(d, dx * dx + dy * dy);
      }
  }
  const double untouched = reach * reach;
  if (std::ranges::all_of(nearest, [&](double d) { return d >= untouched; })) return false;
  for (const double square : nearest) {
    // Of the line's two sides, closer than a pixel when it is thin, each takes away its part.
    const double d = std::sqrt(square);
    *mask++ = byte(std::clamp(reach - d, 0.0, 1.0) - std::clamp(0.5 - half_line - d, 0.0, 1.0));
  }
  return true;
}

const std::vector<PolygonTile>& PolygonMasks::tiles(const std::vector<Vec<2>>& corners,
                                                    double half_line, const Canvas& canvas) {
  std::vector<double> key{half_line};
  for (const Vec<2>& p : corners) key.insert(key.end(), {p.x, p.y});
  const auto [it, fresh] = known_.try_emplace(std::move(key));
  if (!fresh || corners.empty()) return it->second;

  std::vector<Edge> edges;
  Box<2> bounds{corners[0], corners[0]};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<2>& a = corners[i];
    const Vec<2>& b = corners[(i + 1) % corners.size()];
    bounds = united(bounds, {a, a});
    if (a != b) edges.push_back({a.x, a.y, b.x, b.y});
  }
  const Vec<2> margin(half_line > 0 ? half_line + 0.5 : 0.0);
  const PixelRect seen = canvas.around({bounds.lo - margin, bounds.hi + margin});
  for (int y = seen.y0; y < seen.y1; y += kTile)
    for (int x = seen.x0; x < seen.x1; x += kTile)
      add_tile(edges, half_line, {x, y, std::min(x + kTile, seen.x1), std::min(y + kTile, seen.y1)},
               store_, it->second);
  return it->second;
}

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
