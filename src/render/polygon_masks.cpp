#include "render/polygon_masks.hpp"

#include <algorithm>

#include "render/coverage.hpp"

namespace lantern {
namespace {

constexpr int kTile = 64;  // pixels: smaller tiles mean more quads, larger ones more empty pixels

struct Node {
  PixelRect rect;
  int winding = 0;          // of the edges left of the node, over its whole height
  std::vector<Edge> edges;  // the others that matter
};

// A quadtree over the polygon's bounds: a node that no edge comes near is one solid tile or none,
// the others split down to the tile size.
class Tiler {
 public:
  Tiler(double half_line, const PixelRect& seen, MaskStore& store, std::vector<PolygonTile>& tiles)
      : half_line_(half_line), seen_(seen), store_(store), tiles_(tiles) {}

  void cover(const Node& parent, int x0, int y0, int size) {
    const PixelRect rect{std::max(x0, seen_.x0), std::max(y0, seen_.y0),
                         std::min(x0 + size, seen_.x1), std::min(y0 + size, seen_.y1)};
    if (rect.empty()) return;
    Node node{rect, parent.winding, {}};
    bool any_near = false;
    for (const Edge& e : parent.edges) any_near |= keep(e, node);
    if (!any_near) return add_inside(node);
    if (size <= kTile) return add_tile(node);
    const int half = size / 2;
    for (const int y : {y0, y0 + half})
      for (const int x : {x0, x0 + half}) cover(node, x, y, half);
  }

 private:
  // Sorts an edge into the node; true if it or its line may touch a pixel there.
  bool keep(const Edge& e, Node& node) const {
    const PixelRect& r = node.rect;
    const double left = std::min(e[0], e[2]), right = std::max(e[0], e[2]);
    const double top = std::min(e[1], e[3]), bottom = std::max(e[1], e[3]);
    if (is_near(e, r)) {
      node.edges.push_back(e);
      return true;
    }
    if (bottom <= r.y0 || top >= r.y1 || left >= r.x1) return false;
    if (right <= r.x0 && top <= r.y0 && bottom >= r.y1)
      node.winding += e[3] > e[1] ? 1 : -1;
    else
      node.edges.push_back(e);
    return false;
  }

  // Is the edge within reach of the circle round the node?
  bool is_near(const Edge& e, const PixelRect& r) const {
    const Vec<2> half(0.5 * (r.x1 - r.x0), 0.5 * (r.y1 - r.y0));
    const Vec<2> to_center = Vec<2>(r.x0, r.y0) + half - Vec<2>(e[0], e[1]);
    const Vec<2> way(e[2] - e[0], e[3] - e[1]);
    const double t = std::clamp(glm::dot(to_center, way) / glm::dot(way, way), 0.0, 1.0);
    return glm::length(to_center - way * t) <= glm::length(half) + half_line_ + 1;
  }

  // No edge is near: all pixels are inside or outside, as the centre is.
  void add_inside(const Node& node) {
    const PixelRect& r = node.rect;
    const double x = 0.5 * (r.x0 + r.x1), y = 0.5 * (r.y0 + r.y1);
    int winding = node.winding;
    for (const Edge& e : node.edges) {
      if ((e[1] <= y) == (e[3] <= y)) continue;
      const double at = e[0] + (y - e[1]) / (e[3] - e[1]) * (e[2] - e[0]);
      if (at < x) winding += e[3] > e[1] ? 1 : -1;
    }
    if (winding != 0) tiles_.push_back({r, 0, 0});
  }

  void add_tile(const Node& node) {
    const auto pixels = static_cast<std::size_t>(node.rect.area());
    PolygonTile tile{node.rect, store_.add(pixels), 0};
    fill_coverage(node.edges, node.winding, node.rect, store_.at(tile.fill));
    if (half_line_ > 0) {
      tile.stroke = store_.add(pixels);
      if (!line_coverage(node.edges, half_line_, node.rect, store_.at(tile.stroke)))
        tile.stroke = 0;
    }
    tiles_.push_back(tile);
  }

  double half_line_;
  PixelRect seen_;
  MaskStore& store_;
  std::vector<PolygonTile>& tiles_;
};

}  // namespace

const std::vector<PolygonTile>& PolygonMasks::tiles(const std::vector<Vec<2>>& corners,
                                                    double half_line, const Canvas& canvas) {
  std::vector<double> key{half_line};
  for (const Vec<2>& p : corners) key.insert(key.end(), {p.x, p.y});
  const auto [it, fresh] = known_.try_emplace(std::move(key));
  if (!fresh || corners.empty()) return it->second;

  Node all;
  Box<2> bounds{corners[0], corners[0]};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<2>& a = corners[i];
    const Vec<2>& b = corners[(i + 1) % corners.size()];
    bounds = united(bounds, {a, a});
    if (a != b) all.edges.push_back({a.x, a.y, b.x, b.y});
  }
  const Vec<2> margin(half_line > 0 ? half_line + 0.5 : 0.0);
  const PixelRect seen = canvas.around({bounds.lo - margin, bounds.hi + margin});
  if (all.edges.empty()) return it->second;
  int size = kTile;
  while (seen.x0 + size < seen.x1 || seen.y0 + size < seen.y1) size *= 2;
  Tiler(half_line, seen, store_, it->second).cover(all, seen.x0, seen.y0, size);
  return it->second;
}

}  // namespace lantern
