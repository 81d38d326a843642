// A uniform grid: the world is cut into equal cells, and a body is in each cell that its box
// reaches. Bodies of one size that fill the world are parted in linear time.
//
//     +-----+-----+-----+     b reaches two cells; whoever meets it is in one of them, or in the
//     |     |  c  |     |     grid as it is held (grid_table.hpp), in one of the rows that it
//     +-----+-----+-----+     reaches.
//     | a   | b|--|  d  |
//     +-----+-----+-----+     What lies outside of the bounds is in the cells at the rim.
//
// What is shown (visit, queries) are the cells with all bodies that reach them (grid_cells.hpp);
// what works holds each body once. Of several levels each has cells twice as large as the one
// before, and a body is on the finest whose cells are as large as it is. An open grid has no rim:
// its cells go on without end, and are hashed into buckets.
//
// The finished grid does not depend on the order of insertion. Where the side of the cells is left
// to it, all is made anew with each body; else handles last.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "spatial/grid_cells.hpp"
#include "spatial/grid_side.hpp"
#include "spatial/grid_table.hpp"
#include "spatial/tour.hpp"

namespace lantern::spatial {

struct GridExtent {
  double side = 0;  // of a cell
  std::uint64_t columns = 0, rows = 0;
};

template <int D>
class Grid : public Visitable<Grid<D>, D>, CountsAllocations {
 public:
  static constexpr Zones kZones = Zones::rounded_rim;
  static constexpr StructureTraits kTraits{
      .words = "grid",
      .settings = bits_of({Setting::cell, Setting::levels, Setting::open}),
      .meets_in_leaves = false,
      .splits = false,
      .names = NodeNames::cells,
      .tells = bits_of({EventKind::make_child, EventKind::test, EventKind::store})};
  static constexpr std::uint32_t kMostLevels = 16;
  static constexpr double kMostCells = 0x1p31;  // of a closed level: they are numbered

  static Grid made(const StructureConfig<D>& config) { return Grid(config); }

  // Reads bounds, cell, levels, open and most_entries. Throws Refused for bounds that are not
  // valid, a cell that is negative, not finite, or out of 1e-100 ... 1e100, for no level or more
  // than kMostLevels, and for a closed grid of more than kMostCells cells.
  explicit Grid(const StructureConfig<D>& config)
      : bounds_(config.bounds),
        cell_(config.cell),
        levels_(config.levels),
        open_(config.open),
        most_entries_(config.most_entries) {
    if (!is_valid(bounds_)) throw Refused("grid: its bounds are not finite or inverted");
    if (cell_ != 0 && !(cell_ >= 1e-100 && cell_ <= 1e100))
      throw Refused(fmt::format(
          "grid: cell is {}, must be 0 (as suits the bodies) or 1e-100 ... 1e100", cell_));
    if (levels_ == 0 || levels_ > kMostLevels)
      throw Refused(fmt::format("grid: levels is {}, must be 1 ... {}", levels_, kMostLevels));
    cut(cell_ == 0 ? 1 : cell_);
    if (cell_ != 0 && !open_ && rasters_[0].cells() > kMostCells)
      throw Refused(
          fmt::format("grid: {:.3g} cells of {} are too many; take larger ones, or an open grid",
                      rasters_[0].cells(), cell_));
  }

  // Throws Refused for a box that is not valid; nothing changes then. Tells make_child, test and
  // store of the cells that the body reaches: whoever is told looks at all cells each time.
  template <class Observer = NoObserver>
  void insert(const Item<D>& item, Observer&& observer = {}) {
    require_valid(item);
    append(items_, item);
    held_ = shown_ = false;
    if constexpr (!std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>) {
      show();
      tell(item.id, observer);
    }
  }

  void clear() {
    items_.clear();
    cells_.forget();
    placed_ = 0;
    held_ = shown_ = false;
  }

  // These items, instead of what was there; memory is used again. Throws Refused for a box that is
  // not valid, after which it is empty. Time: O(n).
  void build(std::span<const Item<D>> items) {
    clear();
    for (const Item<D>& item : items) require_valid(item);
    allocations_ += items.size() > items_.capacity();
    items_.assign(items.begin(), items.end());
    sort();
  }

  // Puts the bodies into their cells, if some came since; whoever asks does so, too. Nothing else
  // changes, but it must not be done by two threads at once.
  void sort() const {
    if (held_) return;
    if (cell_ == 0) cut(side_for<D>(items_, room_));
    table_.build(items_, rasters());
    placed_ += items_.size();
    held_ = true;
  }

  // See structure.hpp. `exact` are the items, and their ids their places.
  std::uint64_t pair(std::span<const Item<D>> exact, FoundPairs& found) {
    sort();
    RunScanner<D> runs(table_.table(), table_.table(), exact, found);
    table_.each_run(items_, [&](std::uint32_t asks, std::uint32_t from, std::uint32_t to) {
      runs.add(asks, from, to);
    });
    runs.finish();
    return runs.compared();
  }

  // `besides` counts the rows of cells that bodies ask.
  template <class Awake, class F>
  std::uint64_t compare(Awake&& awake, F&& f, std::uint64_t* besides = nullptr) {
    sort();
    std::uint64_t tests = 0, rows = 0;
    table_.each_run(items_, [&](std::uint32_t asks, std::uint32_t from, std::uint32_t to) {
      stop_if_asked();
      ++rows;
      const Item<D>& a = items_[table_.table().id(asks)];
      const bool stirs = awake(a.id);
      for (std::uint32_t place = from; place < to; ++place) {
        const Item<D>& b = items_[table_.table().id(place)];
        if (!stirs && !awake(b.id)) continue;
        ++tests;
        f(a, b);
      }
    });
    if (besides) *besides += rows;
    return tests;
  }

  template <class F>
  void take(Tour<D> tour, F&& f) const {
    show();
    cells_.take(tour, rasters(), open_ ? cells_.bounds(rasters(), bounds_) : bounds_, f);
  }

  // Those that the box overlaps, each once.
  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const {
    sort();
    std::uint64_t tests = 0;  // of rows, and of bodies in vain
    table_.each_near(box, [&](std::uint32_t from, std::uint32_t to) {
      ++tests;
      for (std::uint32_t place = from; place < to; ++place) {
        const Item<D>& item = items_[table_.table().id(place)];
        const bool is_near = overlap(item.box, box);
        tests += !is_near;
        if (is_near) ids.push_back(item.id);
      }
    });
    return tests;
  }

  // Of each level, the finest first: the array that its cells, or the buckets of an open grid, are
  // numbered in, as rows of so many; a solid grid's slices follow one another.
  std::vector<GridExtent> extents() const {
    sort();
    std::vector<GridExtent> all;
    for (std::size_t level = 0; level < levels_; ++level) {
      const auto count = [&](std::size_t axis) {
        return open_ ? table_.buckets(level, axis) : rasters_[level].cells(static_cast<int>(axis));
      };
      all.push_back({rasters_[level].side(), count(0), count(1) * (D == 3 ? count(D - 1) : 1)});
    }
    return all;
  }

  // Of the cells, the finest; of none that has no bodies yet, if it is to suit them.
  double side() const {
    sort();
    return rasters_[0].side();
  }

  // Of the grid as it is held: one node.
  Counters work() const {
    return {.nodes = 1,
            .leaves = 1,
            .entries = items_.size(),
            .box_tests = placed_,
            .allocations = allocations_ + table_.allocations() + cells_.allocations()};
  }

  // Of the cells as they are shown; `box_tests` counts bodies put into their cells.
  Counters counters() const {
    show();
    return {.nodes = cells_.nodes(),
            .leaves = cells_.leaves(),
            .depth = cells_.depth(),
            .entries = cells_.entries(),
            .box_tests = placed_,
            .allocations = work().allocations};
  }

 private:
  std::span<const GridRaster<D>> rasters() const { return std::span(rasters_).first(levels_); }

  void cut(double side) const {
    for (std::uint32_t level = 0; level < levels_; ++level, side *= kGridRatio)
      rasters_[level] = GridRaster<D>(bounds_, side, open_);
  }

  void show() const {
    if (shown_) return;
    if (cell_ == 0 || open_) {  // other cells, or buckets
      sort();
      cells_.forget();
    }
    cells_.make(items_, rasters(), table_, open_, most_entries_);
    shown_ = true;
  }

  // A cell that holds it alone was made for it, and so was what lies above and holds nothing else.
  template <class Observer>
  void tell(BodyId id, Observer& observer) const {
    using Kind = Event::Kind;
    std::vector<NodeView<D>> nodes;
    std::vector<std::uint32_t> others;  // bodies below each node, besides
    std::vector<std::uint32_t> count;
    std::vector<bool> holds;
    this->visit([&](const NodeView<D>& node) {
      nodes.push_back(node);
      others.push_back(static_cast<std::uint32_t>(node.bodies.size()));
      count.push_back(others.back());
      holds.push_back(std::ranges::binary_search(node.bodies, id));
      if (holds.back()) --others.back();
      return true;
    });
    for (std::size_t i = nodes.size(); i-- > 1;) {
      others[nodes[i].parent] += others[i];
      if (holds[i]) holds[nodes[i].parent] = true;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!holds[i]) continue;
      const NodeHandle handle = nodes[i].handle;
      if (i > 0 && others[i] == 0) observer(Event{Kind::make_child, handle, id, 0, 0});
      observer(Event{Kind::test, handle, id, 0, 0});
      if (nodes[i].leaf) observer(Event{Kind::store, handle, id, count[i], 0});
    }
  }

  Box<D> bounds_;
  double cell_;
  std::uint32_t levels_;
  bool open_;
  std::uint64_t most_entries_;
  std::vector<Item<D>> items_;

  // Made of the items when they are asked for.
  mutable std::array<GridRaster<D>, kMostLevels> rasters_;
  mutable GridTable<D> table_;
  mutable GridCells<D> cells_;
  mutable std::vector<double> room_;
  mutable std::uint64_t placed_ = 0;
  mutable bool held_ = false, shown_ = false;
};

}  // namespace lantern::spatial
