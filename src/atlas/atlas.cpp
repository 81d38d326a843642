#include "atlas/atlas.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern {
namespace {

constexpr int kLargest = 65536;  // pixels on one side

}  // namespace

Atlas::Atlas(int width, int height) {
  if (width < 1 || width > kLargest || height < 1 || height > kLargest)
    throw Refused(fmt::format("an atlas of {} x {} pixels: both must be from 1 to {}", width,
                              height, kLargest));
  Node root;
  root.rect = {0, 0, width, height};
  root.free_width = width;
  root.free_height = height;
  nodes_.push_back(root);
}

void Atlas::require_size(TextureId id, int width, int height) {
  if (width < 1 || height < 1)
    throw Refused(
        fmt::format("texture {} of {} x {} pixels: both must be at least 1", id, width, height));
}

bool Atlas::is_second(std::uint32_t node) const {
  return node != 0 && nodes_[nodes_[node].parent].first_child != node;
}

std::uint32_t Atlas::after_branch(std::uint32_t node) const {
  while (is_second(node)) node = nodes_[node].parent;
  return node == 0 ? kNoNode : node + 1;
}

std::uint32_t Atlas::cut(std::uint32_t leaf, int width, int height) {
  const Rect whole = nodes_[leaf].rect;
  const bool vertically = whole.width - width > whole.height - height;
  Node fitted, rest;
  fitted.parent = rest.parent = leaf;
  fitted.rect = rest.rect = whole;
  if (vertically) {
    fitted.rect.width = width;
    rest.rect.x += width;
    rest.rect.width -= width;
  } else {
    fitted.rect.height = height;
    rest.rect.y += height;
    rest.rect.height -= height;
  }
  for (Node* half : {&fitted, &rest}) {
    half->free_width = half->rect.width;
    half->free_height = half->rect.height;
  }
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(fitted);
  nodes_.push_back(rest);
  nodes_[leaf].first_child = first;
  nodes_[leaf].cut_vertically = vertically;
  return first;
}

void Atlas::take(std::uint32_t leaf, TextureId id) {
  nodes_[leaf].texture = id;
  nodes_[leaf].free_width = nodes_[leaf].free_height = 0;
  used_area_ += std::int64_t{nodes_[leaf].rect.width} * nodes_[leaf].rect.height;
  for (std::uint32_t node = nodes_[leaf].parent; node != kNoNode; node = nodes_[node].parent) {
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

}  // namespace lantern
