#include "render/polygon_masks.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "geometry/closest.hpp"

namespace lantern::render {
namespace {

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

}  // namespace

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

}  // namespace lantern::render
