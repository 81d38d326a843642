// How a grid holds its bodies: each once, in the cell of its lower corner, all in one array in the
// order of cells (a counting sort).
//
//     +-----+-----+-----+      row 1 | row 0
//     |  c  | d   |     |      cells:  0 1 2 | 3 4 5       places of cell 3: from start[3] up to
//     |     |  +--+--+  |      start:  0 1 3 | 3 4 5 5     start[4], and so on
//     +-----+--|--+--|--+      bodies: a b e | c d
//     | a   | b|  |e |  |
//     |     |  +--+--+  |      What b can meet lies in its own row from b on, in the rows above it
//     +-----+-----+-----+      from one cell to its left: a run of places in each row.
//
// No body is larger than a cell of its level (in a grid of several levels, the finest whose cells
// are as large as it is), so that a cell's bodies reach the next one or two cells at most. Those
// that are larger than any cell are held apart, in order of x, and ask all levels. Each coarse
// body asks the finer levels. So no pair is compared twice.
//
// Where the cells in use span too many for the bodies, they are counted modulo a prime on the
// longest axes: the world is folded to a torus (a spatial hash; Teschner, Heidelberger, Müller,
// Pomeranets, Gross: "Optimized Spatial Hashing for Collision Detection of Deformable Objects",
// 2003, mix primes by exclusive or instead, which tears rows apart). What meets in a bucket though
// its cells are far apart is told apart by the boxes. A body's cells and those that ask for it lie
// in fewer buckets on an axis than there are, so that no pair is met from both sides.
//
// Levels as Mirtich: "Impulse-based Dynamic Simulation", 1996, and Ericson: "Real-Time Collision
// Detection", 2004, 7.2.
#pragma once

#include "spatial/box_table.hpp"
#include "spatial/structure_of.hpp"

namespace lantern::spatial {

// Which cell of a grid a point lies in. The cells are cubes that begin at the lower corner of the
// bounds; those at the upper rim end with the bounds.
//
// One function says it for everything that is held, asked or shown, and it is monotone: a larger
// coordinate never lies in an earlier cell, however it was rounded. So of two boxes that share a
// point both reach that point's cell, and no pair is lost by rounding.

// Counted from the corner of the bounds; in an open grid also backwards.
template <int D>
using GridCell = std::array<std::int64_t, D>;

template <int D>
class GridRaster {
 public:
  GridRaster() = default;

  // `side` is positive and a normal number, as its inverse is. Closed: what lies outside of the
  // bounds lies in the cells at the rim. Open: cells go on without end; beyond 2^52 of them, where
  // numbers are no finer than cells, there are no others.
  GridRaster(const Box<D>& bounds, double side, bool open)
      : bounds_(bounds), side_(side), inverse_(1 / side), open_(open) {
    for (int i = 0; i < D; ++i) {
      first_[i] = open ? -kFar : 0;
      // A cell that only rounding makes would be too thin to see.
      const double cells = std::ceil((bounds.hi[i] - bounds.lo[i]) * inverse_ * (1 - 1e-12));
      last_[i] = open ? kFar : std::clamp(cells - 1, 0.0, kFar);
    }
  }

  double side() const { return side_; }

  // How many sides beyond the corner of the bounds, where there are cells.
  double sides(double x, int axis) const {
    return std::clamp((x - bounds_.lo[axis]) * inverse_, first_[axis], last_[axis]);
  }
  std::int64_t at(double x, int axis) const {
    const double t = sides(x, axis);
    const auto cell = static_cast<std::int64_t>(t);
    return cell - (static_cast<double>(cell) > t);
  }
  GridCell<D> at(const Vec<D>& point) const {
    GridCell<D> cell;
    for (int i = 0; i < D; ++i) cell[static_cast<std::size_t>(i)] = at(point[i], i);
    return cell;
  }

  // Where the cells from this one on begin; without end at the rim, beyond which its cells reach.
  double begin(std::int64_t cell, int axis) const {
    const auto k = static_cast<double>(cell);
    if (k <= first_[axis] || k > last_[axis]) return k > last_[axis] ? kInfinity : -kInfinity;
    return bounds_.lo[axis] + k * side_;
  }

  // Of a closed grid: on an axis, and in all; at most 2^52, rounded.
  std::uint64_t cells(int axis) const { return static_cast<std::uint64_t>(last_[axis]) + 1; }
  double cells() const {
    double all = 1;
    for (int i = 0; i < D; ++i) all *= last_[i] + 1;
    return all;
  }

  // The cell, but for what of the world beyond the rim belongs to it.
  Box<D> box(const GridCell<D>& cell) const {
    Box<D> box;
    for (int i = 0; i < D; ++i) {
      const auto k = static_cast<double>(cell[static_cast<std::size_t>(i)]);
      box.lo[i] = bounds_.lo[i] + k * side_;
      box.hi[i] = !open_ && k == last_[i] ? bounds_.hi[i] : bounds_.lo[i] + (k + 1) * side_;
    }
    return box;
  }

 private:
  static constexpr double kFar = 0x1p52;

  Box<D> bounds_;
  double side_ = 1, inverse_ = 1;
  Vec<D> first_{0.0}, last_{0.0};
  bool open_ = false;
};

// One level of a grid as it is held: which cells are in use, and how they lie in memory.
template <int D>
struct GridLevel {
  GridRaster<D> raster;
  Box<D> corners;  // the smallest box around its bodies' lower corners
  double widest = 0;
  GridCell<D> base{};  // of the cells in use the first, on each axis
  GridCell<D> last{};
  std::array<std::int64_t, D> fold{};  // slots on each axis
  std::int64_t reach = 1;              // how many cells a body reaches beyond its first, at most
  bool folded = false;
  std::uint32_t first_slot = 0, slots = 0;
  std::uint32_t first = 0, count = 0;  // places

  std::int64_t fold_of(std::int64_t u, std::size_t axis) const {
    return folded ? u % fold[axis] : u;
  }

  // Of a cell in use.
  std::uint32_t slot(const GridCell<D>& cell) const {
    std::int64_t slot = 0;
    for (std::size_t i = D; i-- > 0;) slot = slot * fold[i] + fold_of(cell[i] - base[i], i);
    return static_cast<std::uint32_t>(slot);
  }

  // How many cells in use a body reaches beyond its first, on each axis: two bits, since it is no
  // larger than a cell and so reaches two at most.
  std::uint8_t span(const GridCell<D>& from, const Vec<D>& hi) const {
    std::uint32_t span = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const auto axis = static_cast<int>(i);
      const auto next = static_cast<double>(from[i] + 1);
      const double to = std::min(raster.sides(hi[axis], axis), static_cast<double>(last[i]));
      span |= static_cast<std::uint32_t>((to >= next) + (to >= next + 1)) << 2 * i;
    }
    return static_cast<std::uint8_t>(span);
  }

  // A cell in use as it is counted from the base.
  GridCell<D> counted(GridCell<D> cell) const {
    for (std::size_t i = 0; i < D; ++i) cell[i] -= base[i];
    return cell;
  }

  // The first slot of a row, whose cells are counted from the base.
  std::uint32_t row(std::int64_t y, std::int64_t z) const {
    const std::int64_t row = D == 3 ? fold_of(z, D - 1) * fold[1] + fold_of(y, 1) : fold_of(y, 1);
    return first_slot + static_cast<std::uint32_t>(row * fold[0]);
  }

  std::int64_t buckets(std::size_t axis) const { return std::max(fold[axis], kLeastFold); }

  // Which bucket any cell belongs to, from 0; while the level is not folded the cells in use have
  // one each.
  std::uint32_t bucket(const GridCell<D>& cell) const {
    std::int64_t bucket = 0;
    for (std::size_t i = D; i-- > 0;) {
      const std::int64_t u = (cell[i] - base[i]) % buckets(i);
      bucket = bucket * buckets(i) + (u < 0 ? u + buckets(i) : u);
    }
    return static_cast<std::uint32_t>(bucket);
  }

  // How the cells lie, when all bodies are counted. If there are more than eight a body or than so
  // many slots, the longest axes are folded.
  void lay_out(double most_slots) {
    if (count == 0) return;
    base = raster.at(corners.lo);
    last = raster.at(corners.hi);
    double cells = 1;
    bool sharp = widest <= 0.999 * raster.side();
    for (std::size_t i = 0; i < D; ++i) {
      fold[i] = last[i] - base[i] + 1;
      cells *= static_cast<double>(fold[i]);
      sharp = sharp && std::abs(base[i]) < kSharp && std::abs(last[i]) < kSharp;
    }
    reach = sharp ? 1 : 2;
    const double most = std::min(64 + 8.0 * count, most_slots);
    folded = cells > most;
    while (cells > most) {
      std::int64_t& longest = *std::ranges::max_element(fold);
      if (longest <= kLeastFold) break;
      const std::int64_t less =
          prime_up_to(std::max(kLeastFold, std::min(longest / 2, std::int64_t{16} * count)));
      cells = cells / static_cast<double>(longest) * static_cast<double>(less);
      longest = less;
    }
    slots = static_cast<std::uint32_t>(cells + 0.5);
  }

 private:
  static constexpr std::int64_t kLeastFold = 7;  // more than twice as far as a body reaches
  // Cells so near to the bounds' corner that what is a thousandth smaller than a cell reaches the
  // next one at most, however it is rounded.
  static constexpr std::int64_t kSharp = std::int64_t{1} << 40;

  static std::int64_t prime_up_to(std::int64_t n) {
    const auto is_prime = [](std::int64_t p) {
      for (std::int64_t d = 2; d * d <= p; ++d)
        if (p % d == 0) return false;
      return true;
    };
    while (!is_prime(n)) --n;
    return n;
  }
};

inline constexpr double kGridRatio = 2;  // of the cells of a level to those of the one below

template <int D>
class GridTable : CountsAllocations {
 public:
  // Holds these instead of what was there. The rasters are those of the levels, the finest first.
  // What is held names bodies by their places in `boxes`.
  void build(std::span<const Box<D>> boxes, std::span<const GridRaster<D>> rasters) {
    set_up(rasters);
    deal(boxes);
    const double most = kMostSlots / static_cast<double>(levels_.size());
    for (Level& level : levels_) level.lay_out(most);
    count(boxes);
    place(boxes);
  }

  // f(place, from, to) for all runs of places that must be compared with one that asks; some are
  // empty: to tell which costs as much as to write one down.
  template <class F>
  void each_run(std::span<const Box<D>> boxes, F&& f) const {
    for (const Level& level : levels_) {
      if (level.count == 0) continue;
      runs_within(level, boxes, f);
      for (const Level& finer : levels_) {
        if (&finer == &level) break;
        for (std::uint32_t p = level.first; p < level.first + level.count; ++p)
          ask(finer, boxes[table_.id(p)],
              [&](std::uint32_t from, std::uint32_t to) { f(p, from, to); });
      }
    }
    runs_of_large(boxes, f);
  }

  // f(from, to) for the runs of places whose bodies may reach the box.
  template <class F>
  void each_near(const Box<D>& box, F&& f) const {
    for (const Level& level : levels_)
      ask(level, box, [&](std::uint32_t from, std::uint32_t to) {
        if (from < to) f(from, to);
      });
    if (first_large_ < table_.size()) f(first_large_, static_cast<std::uint32_t>(table_.size()));
  }

  // The same of those whose bodies a ray may meet before `limit()`: of each row of cells, about as
  // the ray comes to them, one run, from the first cell in which the ray is within the row to the
  // last. These are the cells that Amanatides and Woo ("A Fast Voxel Traversal Algorithm for Ray
  // Tracing", 1987) walk through one by one, and those beside them from which bodies reach in.
  template <bool kOrdered, class Limit, class F>
  void each_along(const RayProbe<D, kOrdered>& probe, Limit& limit, F&& f) const {
    for (const Level& level : levels_) {
      if (level.count == 0) continue;
      Box<D> all{level.corners.lo, level.corners.hi + Vec<D>(level.widest)};
      Vec<D> slack;
      for (int i = 0; i < D; ++i) {
        slack[i] = 0x1p-48 * std::max({std::abs(all.lo[i]), std::abs(all.hi[i]),
                                       std::abs(probe.origin()[i]), level.raster.side()});
        all.lo[i] -= slack[i];  // sums are rounded
        all.hi[i] += slack[i];
      }
      const auto part = probe.in_box(all);
      if (!part) continue;
      double rows = 1;
      for (int i = 1; i < D; ++i) {
        const auto [from, to] = cells_of(level, probe, *part, i, slack[i]);
        rows *= static_cast<double>(to - from + 1);
      }
      // So far through a folded world that it would meet most slots again and again.
      if (rows < static_cast<double>(level.slots) && is_finite(slack))
        rows_along<D - 1>(level, probe, *part, slack, 0, limit, f);
      else
        f(level.first, level.first + level.count);
    }
    if (first_large_ < table_.size()) f(first_large_, static_cast<std::uint32_t>(table_.size()));
  }

  const GridLevel<D>& level(std::size_t level) const { return levels_[level]; }
  const BoxTable<D>& table() const { return table_; }
  std::uint64_t allocations() const { return allocations_; }

 private:
  using Level = GridLevel<D>;
  // Where a body is: the slot of its first cell, until that is known its level; and in the last
  // bits how far it reaches beyond, see GridLevel::span.
  using Spot = std::uint32_t;
  static constexpr int kSpanBits = 6;
  static constexpr Spot kLarge = (1 << kSpanBits) - 1;  // no body reaches three cells beyond
  static constexpr double kMostSlots = 1 << (32 - kSpanBits);

  void set_up(std::span<const GridRaster<D>> rasters) {
    if (levels_.size() != rasters.size()) {
      ++allocations_;
      levels_.resize(rasters.size());
    }
    for (std::size_t i = 0; i < rasters.size(); ++i)
      levels_[i] = {.raster = rasters[i], .corners = {Vec<D>(kInfinity), Vec<D>(-kInfinity)}};
  }

  template <class T>
  void make_room(std::vector<T>& list, std::size_t size) {
    allocations_ += size > list.capacity();
    list.resize(size);
  }

  // Each body to the finest level whose cells are as large as it is.
  void deal(std::span<const Box<D>> boxes) {
    make_room(spot_of_, boxes.size());
    make_room(spot_at_, boxes.size());
    large_.clear();
    const std::size_t levels = levels_.size();
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const Box<D>& box = boxes[k];
      const double extent = extent_of(box);
      std::size_t l = 0;
      while (l < levels && extent > levels_[l].raster.side()) ++l;
      if (l == levels) {
        spot_of_[k] = kLarge;
        append(large_, static_cast<std::uint32_t>(k));
        continue;
      }
      spot_of_[k] = static_cast<Spot>(l) << kSpanBits;
      Level& level = levels_[l];
      ++level.count;
      level.corners.lo = glm::min(level.corners.lo, box.lo);
      level.corners.hi = glm::max(level.corners.hi, box.lo);
      level.widest = std::max(level.widest, extent);
    }
  }

  void count(std::span<const Box<D>> boxes) {
    std::uint32_t slots = 0, places = 0;
    for (Level& level : levels_) {
      level.first_slot = slots;
      level.first = places;
      slots += level.slots;
      places += level.count;
    }
    first_large_ = places;
    allocations_ += slots + 2 > start_.capacity();
    start_.assign(slots + 2, 0);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      Spot& spot = spot_of_[k];
      if (spot == kLarge) continue;
      const Level& level = levels_[spot >> kSpanBits];
      const GridCell<D> from = level.raster.at(boxes[k].lo);
      const std::uint32_t slot = level.first_slot + level.slot(from);
      spot = slot << kSpanBits | level.span(from, boxes[k].hi);
      ++start_[slot + 2];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& s : start_) s = sum += s;
  }

  // start_[s + 1] runs from where the bodies of slot s begin to where they end.
  void place(std::span<const Box<D>> boxes) {
    const std::size_t places = table_.places();
    table_.resize(boxes.size());
    allocations_ += table_.places() != places;
    for (std::uint32_t k = 0; k < boxes.size(); ++k) {
      if (spot_of_[k] == kLarge) continue;
      const std::uint32_t p = start_[(spot_of_[k] >> kSpanBits) + 1]++;
      table_.set(p, k, boxes[k]);
      spot_at_[p] = spot_of_[k];
    }
    std::ranges::sort(large_, [&](std::uint32_t a, std::uint32_t b) {
      const double x = boxes[a].lo[0], y = boxes[b].lo[0];
      return x < y || (x == y && a < b);
    });
    for (std::uint32_t i = 0; i < large_.size(); ++i)
      table_.set(first_large_ + i, large_[i], boxes[large_[i]]);
  }

  // f(from, to) for the bodies of the level that may reach the box.
  template <class F>
  void ask(const Level& level, const Box<D>& box, F&& f) const {
    if (level.count == 0) return;
    GridCell<D> from, to;
    for (int i = 0; i < D; ++i) {
      const auto a = static_cast<std::size_t>(i);
      from[a] =
          std::max<std::int64_t>(level.raster.at(box.lo[i], i) - level.reach - level.base[a], 0);
      to[a] = std::min(level.raster.at(box.hi[i], i), level.last[a]) - level.base[a];
      if (to[a] < from[a]) return;
      if (to[a] - from[a] >= level.fold[a]) {
        from[a] = 0;  // all slots, each once
        to[a] = level.fold[a] - 1;
      }
    }
    const std::int64_t depth = D == 3 ? from[D - 1] : 0, depth_to = D == 3 ? to[D - 1] : 0;
    for (std::int64_t z = depth; z <= depth_to; ++z)
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
        row_runs(level, level.row(y, z), from[0], to[0], f);
  }

  // On an axis, the cells whose bodies the part of a ray may meet, counted from the base.
  template <class Probe>
  static std::pair<std::int64_t, std::int64_t> cells_of(const Level& level, const Probe& probe,
                                                        const RaySpan& part, int axis,
                                                        double slack) {
    const auto a = static_cast<std::size_t>(axis);
    const auto [least, most] = std::minmax({probe.at(part.from, axis), probe.at(part.to, axis)});
    const std::int64_t from = level.raster.at(least - slack, axis) - level.reach;
    const std::int64_t to = std::min(level.raster.at(most + slack, axis), level.last[a]);
    return {std::max<std::int64_t>(from - level.base[a], 0), to - level.base[a]};
  }

  // `row` is the first slot of those with the cells that were chosen on the axes above.
  template <int axis, class Probe, class Limit, class F>
  void rows_along(const Level& level, const Probe& probe, const RaySpan& part, const Vec<D>& slack,
                  std::uint32_t row, Limit& limit, F& f) const {
    constexpr std::size_t a{axis};
    const auto [from, to] = cells_of(level, probe, part, axis, slack[axis]);
    if (from > to) return;
    if constexpr (axis == 0) {
      const std::int64_t last = std::min(to, from + level.fold[0] - 1);  // all slots, each once
      row_runs(level, level.first_slot + row * static_cast<std::uint32_t>(level.fold[0]), from,
               last, f);
    } else {
      const bool down = probe.high_first(axis, 0);
      for (std::int64_t i = from; i <= to; ++i) {
        const std::int64_t cell = down ? to - (i - from) : i;
        const std::int64_t at = cell + level.base[a];
        auto its = probe.beside(part, axis, level.raster.begin(at, axis) - slack[axis], true);
        if (its)
          its = probe.beside(*its, axis,
                             level.raster.begin(at + level.reach + 1, axis) + slack[axis], false);
        if (!its) continue;
        if (probe.entry(*its) > limit()) return;
        const auto fold = static_cast<std::uint32_t>(level.fold[a]);
        rows_along<axis - 1>(level, probe, *its, slack,
                             row * fold + static_cast<std::uint32_t>(level.fold_of(cell, a)), limit,
                             f);
      }
    }
  }

  // The cells x0 to x1 of a row, fewer than there are slots; two runs where they wrap.
  template <class F>
  void row_runs(const Level& level, std::uint32_t row, std::int64_t x0, std::int64_t x1,
                F&& f) const {
    const auto a = static_cast<std::uint32_t>(level.fold_of(x0, 0));
    const auto b = static_cast<std::uint32_t>(level.fold_of(x1, 0));
    if (a <= b) return f(start_[row + a], start_[row + b + 1]);
    f(start_[row + a], start_[row + static_cast<std::uint32_t>(level.fold[0])]);
    f(start_[row], start_[row + b + 1]);
  }

  // Each body with those behind it in its row, and with those in the rows behind that it reaches.
  template <class F>
  void runs_within(const Level& level, std::span<const Box<D>> boxes, F& f) const {
    const auto width = static_cast<std::uint32_t>(level.fold[0]);
    std::int64_t y = 0, z = 0;
    for (std::uint32_t row = level.first_slot; row < level.first_slot + level.slots; row += width) {
      stop_if_asked();
      const std::uint32_t end = start_[row + width];
      for (std::uint32_t p = start_[row]; p < end; ++p) {
        GridCell<D> from{(spot_at_[p] >> kSpanBits) - row, y};
        if constexpr (D == 3) from[2] = z;
        if (level.folded) from = level.counted(level.raster.at(boxes[table_.id(p)].lo));
        runs_of(level, p, row, from, f);
      }
      if (++y == level.fold[1]) {
        y = 0;
        ++z;
      }
    }
  }

  template <class F>
  void runs_of(const Level& level, std::uint32_t p, std::uint32_t row, const GridCell<D>& from,
               F& f) const {
    const auto tell = [&](std::uint32_t first, std::uint32_t end) { f(p, first, end); };
    const auto before = [&](std::size_t axis) {
      return std::max<std::int64_t>(from[axis] - level.reach, 0);
    };
    const auto to = [&](std::size_t axis) { return from[axis] + (spot_at_[p] >> 2 * axis & 3); };
    const std::int64_t x0 = before(0), x1 = to(0), y1 = to(1);
    own_row(level, p, row, from[0], x1, f);
    for (std::int64_t y = from[1] + 1; y <= y1; ++y)
      row_runs(level, level.row(y, D == 3 ? from[D - 1] : 0), x0, x1, tell);
    if constexpr (D == 3) {
      const std::int64_t y0 = before(1), z1 = to(2);
      for (std::int64_t z = from[2] + 1; z <= z1; ++z)
        for (std::int64_t y = y0; y <= y1; ++y) row_runs(level, level.row(y, z), x0, x1, tell);
    }
  }

  template <class F>
  void own_row(const Level& level, std::uint32_t p, std::uint32_t row, std::int64_t x0,
               std::int64_t x1, F& f) const {
    const auto last = static_cast<std::uint32_t>(level.fold_of(x1, 0));
    std::uint32_t end = start_[row + last + 1];
    if (level.folded && last < level.fold_of(x0, 0)) {
      f(p, start_[row], end);
      end = start_[row + static_cast<std::uint32_t>(level.fold[0])];
    }
    f(p, p + 1, end);
  }

  // Among themselves they are swept along x.
  template <class F>
  void runs_of_large(std::span<const Box<D>> boxes, F& f) const {
    const auto n = static_cast<std::uint32_t>(table_.size());
    for (std::uint32_t p = first_large_; p < n; ++p) {
      stop_if_asked();
      const Box<D>& box = boxes[table_.id(p)];
      std::uint32_t end = p + 1;
      while (end < n && boxes[table_.id(end)].lo[0] <= box.hi[0]) ++end;
      f(p, p + 1, end);
      for (const Level& level : levels_)
        ask(level, box, [&](std::uint32_t from, std::uint32_t to) { f(p, from, to); });
    }
  }

  std::vector<Level> levels_;
  BoxTable<D> table_;
  std::vector<std::uint32_t> start_;     // of each slot, the first place; one more behind the last
  std::vector<Spot> spot_of_, spot_at_;  // of each item, and of each place
  std::vector<std::uint32_t> large_;
  std::uint32_t first_large_ = 0;  // their first place
};

}  // namespace lantern::spatial
