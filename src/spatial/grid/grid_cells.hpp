// A grid as it is taught: its cells, each with all bodies that reach it.
//
//              root                     Of several levels, root -> level -> cell, the finest level
//       /    |    |    \                first; of a hashed grid, -> bucket -> cell. Only cells that
//     (a)  (a b) (c)  (b)               hold something are nodes.
//
// Made when somebody looks. A body that reaches more cells than kMostOfBody, such as a floor
// without end, is in none of them, but in one leaf for all of these, which is the root's last.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "spatial/grid/grid_table.hpp"

namespace lantern::spatial {

template <int D>
class GridCells : CountsAllocations {
 public:
  static constexpr double kMostOfBody = 1 << 14;

  // The items may be other ones from now on, on other rasters.
  void forget() {
    reach_.clear();
    reached_ = 0;
    limit_ = kMostOfBody;
    empty();
  }

  // At most `most` entries: if there would be more, kMostOfBody is halved until there are not.
  // Since `forget`, items may only have come behind those of the last time, on the same rasters.
  void make(Items<D> items, std::span<const GridRaster<D>> rasters, const GridTable<D>& table,
            bool open, std::uint64_t most) {
    nodes_.clear();
    bodies_.clear();
    look_how_far(items, rasters, most);
    const std::uint32_t first = entries_.empty() ? 0 : entered_;
    const auto before_them = static_cast<std::ptrdiff_t>(entries_.size());
    for (std::uint32_t k = first; k < items.size(); ++k) {
      stop_if_asked();
      enter(reach_[k], {.id = items.id(k), .item = k}, open ? &table : nullptr, entries_);
    }
    entered_ = static_cast<std::uint32_t>(items.size());
    std::sort(entries_.begin() + before_them, entries_.end(), before);
    std::inplace_merge(entries_.begin(), entries_.begin() + before_them, entries_.end(), before);
    append(nodes_, Node{.depth = 0, .leaf = entries_.empty()});
    group(rasters, open);
    number();
  }

  // How the last item comes to its cells: make_child, test and store, node by node in the order of
  // visiting. The same holds as for `make`, which would give the nodes the same handles; but none
  // is looked at that the item does not reach.
  const std::vector<Event>& way_of_last(Items<D> items, std::span<const GridRaster<D>> rasters,
                                        const GridTable<D>& table, bool open, std::uint64_t most) {
    look_how_far(items, rasters, most);
    for (; stored_ < items.size(); ++stored_) {
      way_.clear();
      here_.clear();
      const BodyId id = items.id(stored_);
      enter(reach_[stored_], {.id = id, .item = stored_}, open ? &table : nullptr, here_);
      std::sort(here_.begin(), here_.end(), before);
      const auto come_to = [&](const Place& place) -> Standing& {
        const auto handle = static_cast<NodeHandle>(standing_.size());
        const auto [at, is_new] = standing_.try_emplace(place, Standing{handle, 0});
        if (is_new && handle > 0) append(way_, {Event::Kind::make_child, at->second.handle, id});
        append(way_, {Event::Kind::test, at->second.handle, id});
        return at->second;
      };
      come_to({0, 0, 0, {}});
      const Entry* last = nullptr;
      for (const Entry& e : here_) {
        const bool large = e.level == kGridLarge;
        if (rasters.size() > 1 && !large && !last) come_to({1, e.level, 0, {}});
        if (open && !large && !(last && last->bucket == e.bucket))
          come_to({2, e.level, e.bucket, {}});
        Standing& leaf = come_to({3, e.level, e.bucket, e.cell});
        append(way_, {Event::Kind::store, leaf.handle, id, ++leaf.bodies});
        last = &e;
      }
    }
    return way_;
  }

  std::uint64_t nodes() const { return nodes_.size(); }
  std::uint64_t leaves() const { return leaves_; }
  std::uint64_t depth() const { return nodes_.size() == 1 ? 0 : 1 + above_; }
  std::uint64_t entries() const { return entries_.size(); }
  std::uint64_t allocations() const { return allocations_; }

  // See structure.hpp. `root` is the box of the whole; of an open grid, of what is there.
  template <class F>
  void take(Tour<D>& tour, std::span<const GridRaster<D>> rasters, const Box<D>& root, F& f) const {
    Walk<F> walk{*this, tour, rasters, root, slack(root), f};
    walk.go(0, kNone);
  }

  // Around all cells that are nodes; nothing if there are none.
  Box<D> bounds(std::span<const GridRaster<D>> rasters, const Box<D>& otherwise) const {
    Box<D> all = otherwise;
    bool any = false;
    for (const Node& node : nodes_) {
      if (!node.leaf || node.depth == 0 || node.slot == kGridLarge) continue;
      const Box<D> box = rasters[node.level].box(node.cell);
      all = any ? united(all, box) : box;
      any = true;
    }
    return all;
  }

 private:
  struct Entry {
    std::uint32_t level = 0, bucket = 0;
    GridCell<D> cell{};
    BodyId id = 0;
    std::uint32_t item = 0;  // its place among the items
  };
  // The cells that a body reaches.
  struct Reach {
    Reach(const Box<D>& box, std::span<const GridRaster<D>> rasters) {
      while (level + 1 < rasters.size() && extent_of(box) > rasters[level].side()) ++level;
      from = rasters[level].at(box.lo);
      to = rasters[level].at(box.hi);
      for (std::size_t i = 0; i < D; ++i) cells *= static_cast<double>(to[i] - from[i]) + 1;
    }
    std::uint32_t level = 0;
    GridCell<D> from, to;
    double cells = 1;
  };
  struct Node {
    std::uint32_t depth = 0, slot = 0, level = 0;
    bool leaf = false;
    GridCell<D> cell{};
    std::uint32_t first = 0, count = 0;  // of a leaf, in bodies_
    std::uint32_t end = 0;               // the first node behind all that lie below it
    std::uint32_t first_item = 0, handle = 0;
  };

  // Rows from the top, left to right; of a solid grid from the back.
  static auto order(const Entry& e) {
    if constexpr (D == 2)
      return std::tuple(e.level, e.bucket, -e.cell[1], e.cell[0]);
    else
      return std::tuple(e.level, e.bucket, e.cell[2], -e.cell[1], e.cell[0]);
  }
  static bool before(const Entry& a, const Entry& b) {
    const auto x = order(a), y = order(b);
    return x < y || (x == y && a.id < b.id);
  }

  // Which cells the items reach that came since, and how many a body may reach so that all reach no
  // more than `most` together.
  void look_how_far(Items<D> items, std::span<const GridRaster<D>> rasters, std::uint64_t most) {
    const auto counted = [&](const Reach& reach) {
      return reach.cells <= limit_ ? reach.cells : 1;
    };
    while (reach_.size() < items.size()) {
      append(reach_, Reach(items.box(reach_.size()), rasters));
      reached_ += counted(reach_.back());
    }
    while (limit_ >= 1 && reached_ > static_cast<double>(most)) {
      limit_ /= 2;
      reached_ = 0;
      for (const Reach& reach : reach_) reached_ += counted(reach);
      empty();
    }
  }

  void empty() {
    entries_.clear();
    standing_.clear();
    stored_ = 0;
  }

  void enter(const Reach& reach, Entry entry, const GridTable<D>* hash,
             std::vector<Entry>& entries) {
    entry.level = reach.level;
    if (reach.cells > limit_) {
      entry.level = kGridLarge;
      return append(entries, entry);
    }
    entry.cell = reach.from;
    for (;;) {
      if (hash) entry.bucket = hash->level(entry.level).bucket(entry.cell);
      append(entries, entry);
      std::size_t i = 0;
      for (; i < D && entry.cell[i] == reach.to[i]; ++i) entry.cell[i] = reach.from[i];
      if (i == D) return;
      ++entry.cell[i];
    }
  }

  // Nodes in the order of visiting, out of the entries in theirs.
  void group(std::span<const GridRaster<D>> rasters, bool open) {
    const bool levels = rasters.size() > 1;
    above_ = levels + open;
    leaves_ = entries_.empty();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const Entry& e = entries_[i];
      append(bodies_, e.id);
      const Entry* last = i == 0 ? nullptr : &entries_[i - 1];
      const bool large = e.level == kGridLarge, same_level = last && last->level == e.level;
      const bool same_bucket = same_level && last->bucket == e.bucket;
      if (levels && !large && !same_level) add(1, e.level, e, false);
      if (open && !large && !same_bucket) add(1 + levels, e.bucket, e, false);
      if (!same_bucket || last->cell != e.cell) {
        const std::uint32_t rank = same_bucket && open ? nodes_.back().slot + 1 : 0;
        const std::uint32_t slot = large  ? kGridLarge
                                   : open ? rank
                                          : slot_of(rasters[e.level], e.cell);
        add(large ? 1 : 1 + static_cast<std::uint32_t>(above_), slot, e, true);
        nodes_.back().first = static_cast<std::uint32_t>(i);
        ++leaves_;
      }
      ++nodes_.back().count;
      nodes_.back().first_item = std::min(nodes_.back().first_item, e.item);
    }
  }
  void add(std::uint32_t depth, std::uint32_t slot, const Entry& e, bool leaf) {
    append(nodes_, Node{.depth = depth,
                        .slot = slot,
                        .level = large_free(e.level),
                        .leaf = leaf,
                        .cell = e.cell,
                        .first_item = e.item});
  }
  static std::uint32_t large_free(std::uint32_t level) { return level == kGridLarge ? 0 : level; }

  // Its place among all cells of a closed grid, or among those shown, where these are too many.
  std::uint32_t slot_of(const GridRaster<D>& raster, const GridCell<D>& cell) const {
    if (raster.cells() > 0x1p31) return static_cast<std::uint32_t>(nodes_.size());
    std::uint64_t slot = D == 3 ? static_cast<std::uint64_t>(cell[D - 1]) : 0;
    slot = slot * raster.cells(1) + raster.cells(1) - 1 - static_cast<std::uint64_t>(cell[1]);
    return static_cast<std::uint32_t>(slot * raster.cells(0) + static_cast<std::uint64_t>(cell[0]));
  }

  // Where branches end, and handles in the order in which the nodes came to be.
  void number() {
    path_.clear();
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      for (; !path_.empty() && nodes_[path_.back()].depth >= nodes_[i].depth; path_.pop_back())
        nodes_[path_.back()].end = i;
      for (const std::uint32_t above : path_)
        nodes_[above].first_item = std::min(nodes_[above].first_item, nodes_[i].first_item);
      append(path_, i);
    }
    for (const std::uint32_t i : path_) nodes_[i].end = static_cast<std::uint32_t>(nodes_.size());
    path_.clear();  // from here on: of each item, the handle of the next node that it brought
    for (std::size_t i = 0; i <= reach_.size(); ++i) append(path_, 0);
    for (std::size_t i = 1; i < nodes_.size(); ++i) ++path_[nodes_[i].first_item + 1];
    path_[0] = 1;
    for (std::size_t i = 1; i < path_.size(); ++i) path_[i] += path_[i - 1];
    for (std::size_t i = 1; i < nodes_.size(); ++i)
      nodes_[i].handle = path_[nodes_[i].first_item]++;
  }

  // How far a box in a cell may lie beyond the cell's edges, by rounding.
  static double slack(const Box<D>& root) {
    double most = 0;
    for (int i = 0; i < D; ++i) most = std::max({most, std::abs(root.lo[i]), std::abs(root.hi[i])});
    return std::min(0x1p-49 * most, std::numeric_limits<double>::max());
  }

  template <class F>
  struct Walk {
    const GridCells& cells;
    Tour<D>& tour;
    std::span<const GridRaster<D>> rasters;
    const Box<D>& root;
    double slack;
    F& f;

    // The node and all below it.
    void go(std::uint32_t i, std::uint32_t parent) {
      stop_if_asked();
      const Node& node = cells.nodes_[i];
      NodeView<D> view =
          tour.view(node.handle, parent, node.slot, node.depth, node.leaf, box_of(i));
      view.slack = slack;
      view.bodies = std::span(cells.bodies_).subspan(node.first, node.leaf ? node.count : 0);
      if (!f(std::as_const(view)) || node.leaf) return;
      const bool in_order = tour.toward == Vec<D>(0.0) || !cells.nodes_[i + 1].leaf;
      std::uint32_t end = node.end;
      const bool has_large = cells.nodes_[end - 1].slot == kGridLarge && node.depth == 0;
      end -= has_large;
      if (in_order)
        for (std::uint32_t child = i + 1; child < end; child = cells.nodes_[child].end)
          go(child, view.id);
      else
        along(i + 1, end, D - 1, view.id);
      if (has_large) go(end, view.id);
    }

    // Leaves of one level, in the order in which a ray meets them: slices across one axis, in each
    // those across the next.
    void along(std::uint32_t from, std::uint32_t to, int axis, std::uint32_t parent) {
      if (axis < 0) {
        for (; from < to; ++from) go(from, parent);
        return;
      }
      const bool stored_up = axis != 1;
      const auto at = [&](std::uint32_t i) {
        return cells.nodes_[i].cell[static_cast<std::size_t>(axis)];
      };
      const bool up = tour.toward[axis] == 0 ? stored_up : tour.toward[axis] > 0;
      while (from < to) {
        if (up == stored_up) {
          std::uint32_t end = from + 1;
          while (end < to && at(end) == at(from)) ++end;
          along(from, end, axis - 1, parent);
          from = end;
        } else {
          std::uint32_t begin = to - 1;
          while (begin > from && at(begin - 1) == at(to - 1)) --begin;
          along(begin, to, axis - 1, parent);
          to = begin;
        }
      }
    }

    // Of a bucket, around its cells.
    Box<D> box_of(std::uint32_t i) const {
      const Node& node = cells.nodes_[i];
      if (node.depth < cells.above_ || node.depth == 0 || node.slot == kGridLarge) return root;
      if (node.leaf) return rasters[node.level].box(node.cell);
      Box<D> all = rasters[node.level].box(cells.nodes_[i + 1].cell);
      for (std::uint32_t k = i + 2; k < node.end; ++k)
        all = united(all, rasters[node.level].box(cells.nodes_[k].cell));
      return all;
    }
  };

  // A node while bodies come one after another: what it is called, and how many a leaf holds.
  struct Standing {
    NodeHandle handle = 0;
    std::uint32_t bodies = 0;
  };
  // Its kind (root, level, bucket, cell), level, bucket and cell.
  using Place = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, GridCell<D>>;

  std::vector<Reach> reach_;  // of each item
  double reached_ = 0;        // cells by all of them
  std::vector<Entry> entries_;
  std::vector<Node> nodes_;  // in the order of visiting
  std::vector<BodyId> bodies_;
  std::vector<std::uint32_t> path_;  // scratch
  std::uint32_t entered_ = 0;        // so many items have their entries
  std::map<Place, Standing> standing_;
  std::uint32_t stored_ = 0;  // so many items are in these
  std::vector<Entry> here_;   // of one item
  std::vector<Event> way_;
  double limit_ = kMostOfBody;
  std::uint64_t leaves_ = 0;
  std::uint32_t above_ = 0;  // levels of nodes between the root and the cells
};

}  // namespace lantern::spatial
