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
// to it, all is made anew when that changes; else handles last.
#pragma once

#include <array>
#include <bit>
#include <type_traits>

#include "geometry/elementary.hpp"
#include "spatial/grid/grid_cells.hpp"
#include "spatial/grid/grid_table.hpp"

namespace lantern::spatial {

// How large its cells should be for the bodies at hand: half again as large as nearly all bodies
// (19 of 20) are, so that few are larger than a cell and each meets the bodies of three or four
// cells; but where sizes differ much, three times the median, and not so small that most cells
// would be empty. Measured on worlds of 1e3 to 1e6 bodies. Does not depend on the order of the
// items.
template <int D>
class SideRule {
 public:
  void clear() { histogram_.fill(0); }
  void add(const Box<D>& box) {
    const auto extent = static_cast<float>(std::clamp(extent_of(box), 0.0, 1e38));
    ++histogram_[std::bit_cast<std::uint32_t>(extent) >> kShift];
  }

  // For these boxes, which were added. Time: O(n), but where sizes differ little the same for any
  // n.
  double side(std::span<const Box<D>> boxes) {
    const double half = quantile(0.5, boxes.size()), most = quantile(0.95, boxes.size());
    double side = std::min(1.5 * most, 3 * half);
    if (most > 4 * half || most == 0) {
      // Half of how far apart the bodies are, from where the middle half of them is.
      double volume = 1;
      for (int i = 0; i < D; ++i) {
        room_.clear();
        for (const Box<D>& box : boxes) room_.push_back(box.lo[i]);
        const auto at = [&](std::size_t place) {
          if (room_.empty()) return 0.0;
          std::nth_element(room_.begin(), room_.begin() + static_cast<std::ptrdiff_t>(place),
                           room_.end());
          return room_[place];
        };
        const double low = at(room_.size() / 4),
                     high = at(room_.size() - room_.size() / 4 - !room_.empty());
        volume *= geometry::pow(std::max(2 * (high - low), 0.0), 1.0 / D);
      }
      side = std::max(side,
                      volume / geometry::pow(static_cast<double>(boxes.size() + 1), 1.0 / D) / 2);
    }
    return side > 0 ? std::clamp(side, 1e-100, 1e100) : 1;
  }

 private:
  // Extents by their leading bits: eight of the exponent and two of the fraction.
  static constexpr int kShift = 21;

  // No less than this part of the extents.
  double quantile(double part, std::size_t count) const {
    const auto wanted = static_cast<std::uint64_t>(part * static_cast<double>(count));
    std::uint64_t seen = 0;
    std::uint32_t bin = 0;
    while (bin + 1 < 1024 && (seen += histogram_[bin]) <= wanted) ++bin;
    return bin == 0 ? 0.0 : double{std::bit_cast<float>((bin + 1) << kShift)};
  }

  std::array<std::uint32_t, 2048> histogram_{};
  std::vector<double> room_;  // scratch
};

template <int D>
class Grid final : public StructureOf<Grid<D>, D>, CountsAllocations {
 public:
  static constexpr Zones kZones = Zones::rounded_rim;
  static constexpr bool kFindsLeaves = true;
  static constexpr std::uint32_t kMostLevels = 16;
  static constexpr double kMostCells = 0x1p31;  // of a closed level: they are numbered

  // Reads bounds, cell, levels, open and most_entries. Throws Refused for bounds that are not
  // valid, a cell that is negative, not finite, or out of 1e-100 ... 1e100, for no level or more
  // than kMostLevels, and for a closed grid of more than kMostCells cells.
  explicit Grid(const StructureConfig<D>& config) : config_(config) {
    if (!is_valid(config_.bounds)) throw Refused("grid: its bounds are not finite or inverted");
    if (config_.cell != 0 && !(config_.cell >= 1e-100 && config_.cell <= 1e100))
      throw Refused("grid: cell is {}, must be 0 (as suits the bodies) or 1e-100 ... 1e100",
                    config_.cell);
    if (config_.levels == 0 || config_.levels > kMostLevels)
      throw Refused("grid: levels is {}, must be 1 ... {}", config_.levels, kMostLevels);
    cut(config_.cell == 0 ? 1 : config_.cell);
    if (config_.cell != 0 && !config_.open && rasters_[0].cells() > kMostCells)
      throw Refused("grid: {:.3g} cells of {} are too many; take larger ones, or an open grid",
                    rasters_[0].cells(), config_.cell);
  }

  // Tells make_child, test and store of the cells that the body reaches.
  template <class Observer>
  void add(const Item<D>& item, Observer&& observer) {
    const std::size_t places = items_.places();
    items_.push_back(item);
    allocations_ += items_.places() != places;
    side_rule_.add(item.box);
    held_ = shown_ = false;
    if constexpr (!std::is_same_v<std::remove_cvref_t<Observer>, NoObserver>) {
      config_.open ? hold_anew() : fit();
      for (const Event& event :
           cells_.way_of_last(items_, rasters(), table_, config_.open, config_.most_entries))
        observer(event);
    }
  }

  void clear() override {
    items_.clear();
    side_rule_.clear();
    cells_.forget();
    placed_ = 0;
    held_ = shown_ = false;
  }

  // Throws Refused for a box that is not valid, after which it is empty. Time: O(n).
  void make(Items<D> items) {
    clear();
    require_all_valid(items);
    const std::size_t places = items_.places();
    items_.assign(items);
    allocations_ += items_.places() != places;
    for (const Box<D>& box : items_.boxes) side_rule_.add(box);
    hold();
  }

  void sort() override { hold(); }
  std::unique_ptr<Structure<D>> sorted() const override {
    auto copy = std::make_unique<Grid>(config_);
    copy->make(items_);
    return copy;
  }
  // Puts the bodies into their cells, if some came since; whoever asks does so, too. Nothing else
  // changes, but it must not be done by two threads at once.
  void hold() const {
    if (held_) return;
    fit();
    table_.build(items_.boxes, rasters());
    placed_ += items_.boxes.size();
    held_ = true;
  }

  // `exact` are the boxes of the items, whose ids are their places.
  std::uint64_t find_pairs(std::span<const Box<D>> exact, FoundPairs& found) {
    hold();
    RunScanner<D> runs(table_.table(), table_.table(), exact, found);
    table_.each_run(items_.boxes, [&](std::uint32_t asks, std::uint32_t from, std::uint32_t to) {
      runs.add(asks, from, to);
    });
    runs.finish();
    return runs.compared();
  }

  // Returns the rows of cells that bodies ask.
  std::uint64_t meet(FunctionRef<bool(BodyId)> awake, FunctionRef<void(BodyId, BodyId)> f) const {
    hold();
    std::uint64_t rows = 0;
    table_.each_run(items_.boxes, [&](std::uint32_t asks, std::uint32_t from, std::uint32_t to) {
      stop_if_asked();
      rows += from < to;
      const BodyId a = items_.id(table_.table().id(asks));
      const bool stirs = awake(a);
      for (std::uint32_t place = from; place < to; ++place) {
        const BodyId b = items_.id(table_.table().id(place));
        if (stirs || awake(b)) f(a, b);
      }
    });
    return rows;
  }

  template <class F>
  void take(Tour<D> tour, F&& f) const {
    show();
    cells_.take(tour, rasters(),
                config_.open ? cells_.bounds(rasters(), config_.bounds) : config_.bounds, f);
  }

  // Those that the box overlaps, each once.
  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const override {
    hold();
    const std::size_t before = ids.size();
    const VolumeProbe<D, Box> probe(box);
    auto near = [&](std::uint32_t place, bool is_sure) {
      if (is_sure || overlap(items_.boxes[place], box)) ids.push_back(items_.id(place));
    };
    WalkCounts counts;
    table_.each_near(box, look(probe, kNoLimit, kNothingSoon, near, counts));
    return counts.visited + counts.compared - (ids.size() - before);  // in vain
  }

  // --- asked by rows, see query_walk.hpp ---

  bool has_rows() const { return true; }
  template <template <int> class Volume, class Limit, class Soon, class F>
  WalkCounts each_met(const VolumeProbe<D, Volume>& probe, Limit& limit, Soon& soon, F& f) const {
    hold();
    WalkCounts counts;
    thread_local std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
    runs.clear();
    table_.each_near(probe.around(), [&](std::uint32_t from, std::uint32_t to) {
      runs.push_back({from, to});
      table_.table().fetch(from);
    });
    const auto looks = look_named(probe, limit, soon, f, counts);
    for (const auto& [from, to] : runs) looks(from, to);
    return counts;
  }
  template <bool kOrdered, class Limit, class Soon, class F>
  WalkCounts each_met(const RayProbe<D, kOrdered>& probe, Limit& limit, Soon& soon, F& f) const {
    hold();
    WalkCounts counts;
    table_.each_along(probe, limit, look_named(probe, limit, soon, f, counts));
    return counts;
  }
  // What lies within a cube around the point, and if the nearest of it, or nothing, lies farther
  // away than the cube reaches, within a larger one.
  template <class Limit, class Soon, class F>
  WalkCounts each_met(const PointProbe<D>& probe, Limit& limit, Soon& soon, F& f) const {
    hold();
    WalkCounts counts;
    for (double reach = rasters_[0].side(); !items_.boxes.empty();) {
      table_.each_near({probe.point() - reach, probe.point() + reach},
                       look_named(probe, limit, soon, f, counts));
      if (limit() <= reach * reach || reach == kInfinity) break;
      constexpr double kFar = 1e150;
      reach = limit() < kFar ? std::sqrt(limit()) * (1 + 1e-15) : 2 * reach;
      if (!(reach < kFar)) reach = kInfinity;
    }
    return counts;
  }

  // Of each level, the finest first: the array that its cells, or the buckets of an open grid, are
  // numbered in, as rows of so many; a solid grid's slices follow one another.
  Arrangement arrangement() const override {
    hold();
    Arrangement all;
    for (std::size_t level = 0; level < config_.levels; ++level) {
      const auto count = [&](std::size_t axis) {
        return config_.open ? static_cast<std::uint64_t>(table_.level(level).buckets(axis))
                            : rasters_[level].cells(static_cast<int>(axis));
      };
      all.levels.push_back(
          {rasters_[level].side(), count(0), count(1) * (D == 3 ? count(D - 1) : 1)});
    }
    return all;
  }

  // Of the grid as it is held: one node.
  Counters work() const override {
    return {.nodes = 1,
            .leaves = 1,
            .entries = items_.boxes.size(),
            .box_tests = placed_,
            .allocations = allocations_ + table_.allocations() + cells_.allocations()};
  }

  // Of the cells as they are shown; `box_tests` counts bodies put into their cells.
  Counters counters() const override {
    show();
    return {.nodes = cells_.nodes(),
            .leaves = cells_.leaves(),
            .depth = cells_.depth(),
            .entries = cells_.entries(),
            .box_tests = placed_,
            .allocations = work().allocations};
  }

 private:
  // A run of places, a block after the other, as the probe comes to them; told of places of items.
  template <class Probe, class Limit, class Soon, class F>
  auto look(const Probe& probe, Limit& limit, Soon soon, F f, WalkCounts& counts) const {
    return [=, this, &probe, &limit, &counts, back = probe.high_first(0, 0)](std::uint32_t from,
                                                                             std::uint32_t to) {
      ++counts.visited;
      counts.compared += to - from;
      for (std::uint32_t i = from; i < to; i += kRowBlock) {
        const std::uint32_t count = std::min(kRowBlock, to - i);
        const std::uint32_t first = back ? to - (i - from) - count : i;
        each_in_block(table_.table().row(first), count, probe, limit, soon, f);
      }
    };
  }

  // The same told of bodies.
  template <class Probe, class Limit, class Soon, class F>
  auto look_named(const Probe& probe, Limit& limit, Soon& soon, F& f, WalkCounts& counts) const {
    return look(
        probe, limit, [&](std::uint32_t place) { soon(items_.id(place)); },
        [&](std::uint32_t place, bool is_sure) { f(items_.id(place), is_sure); }, counts);
  }

  std::span<const GridRaster<D>> rasters() const {
    return std::span(rasters_).first(config_.levels);
  }

  void cut(double side) const {
    for (std::uint32_t level = 0; level < config_.levels; ++level, side *= kGridRatio)
      rasters_[level] = GridRaster<D>(config_.bounds, side, config_.open);
  }

  // Cells as suit the bodies, where that is left to it.
  void fit() const {
    if (config_.cell != 0) return;
    const double side = side_rule_.side(items_.boxes);
    if (side == rasters_[0].side()) return;
    cut(side);
    cells_.forget();
  }

  // The buckets of an open grid may be others with each body.
  void hold_anew() const {
    hold();
    cells_.forget();
  }

  void show() const {
    if (shown_) return;
    if (config_.open) hold_anew();
    if (config_.cell == 0) hold();
    cells_.make(items_, rasters(), table_, config_.open, config_.most_entries);
    shown_ = true;
  }

  StructureConfig<D> config_;
  KeptItems<D> items_;

  // Made of the items when they are asked for.
  mutable std::array<GridRaster<D>, kMostLevels> rasters_;
  mutable GridTable<D> table_;
  mutable GridCells<D> cells_;
  mutable SideRule<D> side_rule_;  // of the items; unused where the side is given
  mutable std::uint64_t placed_ = 0;
  mutable bool held_ = false, shown_ = false;
};

}  // namespace lantern::spatial
