// A tree written down as plain values, to be compared; and the tree that the definition asks for,
// found slowly and in another way than the engine's.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spatial/trees/orthtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial::testing {

template <int D>
struct PictureNode {
  std::string path;  // the slots from the root: "", "1", "13"
  bool leaf = true;
  Box<D> box;
  std::vector<BodyId> bodies;
  bool operator==(const PictureNode&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const PictureNode& n) {
    return out << fmt::format("root{}{} {}", n.path, n.leaf ? "" : " inner", n.bodies);
  }
};

template <int D>
using Picture = std::vector<PictureNode<D>>;

template <int D, class Structure>
Picture<D> picture_of(const Structure& structure) {
  Picture<D> picture;
  structure.visit([&](const NodeView<D>& view) {
    const std::string above = view.parent == kNone ? "" : picture[view.parent].path;
    picture.push_back({view.parent == kNone ? "" : above + fmt::format("{}", view.slot),
                       view.leaf,
                       view.box,
                       {view.bodies.begin(), view.bodies.end()}});
    return true;
  });
  return picture;
}

template <int D>
Picture<D> without_empty_leaves(Picture<D> picture) {
  std::erase_if(picture, [](const auto& n) { return n.leaf && n.bodies.empty() && n.path != ""; });
  return picture;
}

// Where the children lie, written out: -1 is the low side, +1 the high one, of x, y and z.
inline constexpr std::array<std::array<int, 3>, 8> kSides = {{{-1, +1, -1},
                                                              {+1, +1, -1},
                                                              {-1, -1, -1},
                                                              {+1, -1, -1},
                                                              {-1, +1, +1},
                                                              {+1, +1, +1},
                                                              {-1, -1, +1},
                                                              {+1, -1, +1}}};

// The definition, from all bodies at once: each cell has a zone, which is its box but without end
// where the box lies at the world's rim, and holds the bodies that overlap the zone.
template <int D>
class ReferenceTree {
 public:
  using Config = TreeConfig<D>;

  // Gives up once it knows that the tree has more than config.most_entries nodes or entries.
  ReferenceTree(const Config& config, const std::vector<Item<D>>& items) : config_(config) {
    const double infinity = std::numeric_limits<double>::infinity();
    grow("", config.bounds, {Vec<D>(-infinity), Vec<D>(infinity)}, items);
  }

  const Picture<D>& picture() const { return picture_; }
  bool too_large() const {
    return picture_.size() > config_.most_entries || entries_ > config_.most_entries;
  }

 private:
  bool is_split(std::size_t depth, const Box<D>& box, const std::vector<Item<D>>& items) const {
    if (items.size() <= config_.capacity || depth >= config_.max_depth) return false;
    for (int i = 0; i < D; ++i) {
      const double middle = std::midpoint(box.lo[i], box.hi[i]);
      if (middle <= box.lo[i] || middle >= box.hi[i]) return false;
    }
    if (!config_.no_progress_stop) return true;
    // Boxes share a point exactly when each two of them do (Helly's theorem for boxes).
    for (const Item<D>& a : items)
      for (const Item<D>& b : items)
        if (!overlap(a.box, b.box)) return true;
    return false;
  }

  void grow(const std::string& path, const Box<D>& box, const Box<D>& zone,
            const std::vector<Item<D>>& items) {
    if (too_large()) return;
    const bool split = is_split(path.size(), box, items);
    picture_.push_back({path, !split, box, {}});
    if (!split) {
      for (const Item<D>& item : items) picture_.back().bodies.push_back(item.id);
      std::sort(picture_.back().bodies.begin(), picture_.back().bodies.end());
      entries_ += items.size();
      return;
    }
    for (std::uint32_t slot = 0; slot < (1u << D); ++slot) {
      Box<D> child_box = box, child_zone = zone;
      for (int i = 0; i < D; ++i) {
        const double middle = std::midpoint(box.lo[i], box.hi[i]);
        const bool high = kSides[slot][static_cast<std::size_t>(i)] > 0;
        (high ? child_box.lo : child_box.hi)[i] = middle;
        (high ? child_zone.lo : child_zone.hi)[i] = middle;
      }
      std::vector<Item<D>> inside;
      for (const Item<D>& item : items)
        if (overlap(item.box, child_zone)) inside.push_back(item);
      if (!inside.empty() || config_.eager_children)
        grow(path + fmt::format("{}", slot), child_box, child_zone, inside);
    }
  }

  Config config_;
  Picture<D> picture_;
  std::uint64_t entries_ = 0;
};

}  // namespace lantern::spatial::testing
