#include "atlas/atlas.hpp"

#include <numeric>

#include "base/check.hpp"
#include "base/error.hpp"

namespace lantern::atlas {
namespace {

constexpr int kLargest = 65536;  // pixels on one side

// Do they share a pixel?
bool share_pixels(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

std::vector<std::size_t> layers_of(const std::vector<ScreenElement>& elements) {
  std::vector<std::size_t> layers(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (std::size_t under = 0; under < i; ++under)
      if (share_pixels(elements[i].place, elements[under].place))
        layers[i] = std::max(layers[i], layers[under] + 1);
  return layers;
}

}  // namespace

Atlas::Atlas(int width, int height) {
  if (width < 1 || width > kLargest || height < 1 || height > kLargest)
    throw Refused("an atlas of {} x {} pixels: both must be from 1 to {}", width, height, kLargest);
  add_leaf({0, 0, width, height}, kNoNode);
}

void Atlas::require_size(TextureId id, int width, int height) {
  if (width < 1 || height < 1)
    throw Refused("texture {} of {} x {} pixels: both must be at least 1", id, width, height);
}

bool Atlas::is_second(std::uint32_t node) const {
  return node != 0 && nodes_[nodes_[node].parent].first_child != node;
}

std::uint32_t Atlas::after_branch(std::uint32_t node) const {
  while (is_second(node)) node = nodes_[node].parent;
  return node == 0 ? kNoNode : node + 1;
}

void Atlas::add_leaf(const Rect& rect, std::uint32_t parent) {
  Node& leaf = nodes_.emplace_back();
  leaf.rect = rect;
  leaf.parent = parent;
  leaf.free_width = rect.width;
  leaf.free_height = rect.height;
}

std::uint32_t Atlas::cut_at(std::uint32_t leaf, bool vertically, int pixels) {
  const auto [x, y, wide, high] = nodes_[leaf].rect;
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[leaf].first_child = first;
  nodes_[leaf].cut_vertically = vertically;
  add_leaf(vertically ? Rect{x, y, pixels, high} : Rect{x, y, wide, pixels}, leaf);
  add_leaf(vertically ? Rect{x + pixels, y, wide - pixels, high}
                      : Rect{x, y + pixels, wide, high - pixels},
           leaf);
  return first;
}

void Atlas::take(std::uint32_t leaf, TextureId id) {
  nodes_[leaf].texture = id;
  nodes_[leaf].free_width = nodes_[leaf].free_height = 0;
  used_area_ += std::int64_t{nodes_[leaf].rect.width} * nodes_[leaf].rect.height;
  gather_free(nodes_[leaf].parent);
}

void Atlas::gather_free(std::uint32_t node) {
  for (; node != kNoNode; node = nodes_[node].parent) {
    Node& n = nodes_[node];
    const Node& a = nodes_[n.first_child];
    const Node& b = nodes_[n.first_child + 1];
    const int free_width = std::max(a.free_width, b.free_width);
    const int free_height = std::max(a.free_height, b.free_height);
    if (free_width == n.free_width && free_height == n.free_height) break;  // so are all above
    n.free_width = free_width;
    n.free_height = free_height;
  }
}

std::vector<std::uint32_t> Atlas::free_leaves() const {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t node = 0; node != kNoNode;) {
    const Node& n = nodes_[node];
    if (n.is_leaf() && !n.texture) leaves.push_back(node);
    node = n.is_leaf() ? after_branch(node) : n.first_child;
  }
  return leaves;
}

std::vector<std::size_t> sorted_by_image(const std::vector<ScreenElement>& elements) {
  const std::vector<std::size_t> layers = layers_of(elements);
  std::vector<std::size_t> order(elements.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::pair(layers[i], elements[i].image); });
  return order;
}

bool Binder::bind(std::uint32_t image) {
  if (bound == image) return false;
  bound = image;
  ++bindings;
  return true;
}

void Binder::draw() {
  LANTERN_CHECK(bound.has_value(), ==, true);
  ++draws;
}

}  // namespace lantern::atlas
