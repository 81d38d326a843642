// Sort and sweep (Baraff 1992; Cohen, Lin, Manocha, Ponamgi: I-COLLIDE, 1995): the boxes are sorted
// by where they begin on one axis, and swept once. A box is compared only with those that begin
// before it ends.
//
//     a |--------|
//     b     |----------|        compared: a with b, a with c, b with c
//     c        |-----|          d begins after all others have ended
//     d                   |---|
//     ----------------------------> the axis on which the centres vary the most
//
// Boxes move little from one sweep to the next, so the order of the last sweep is nearly right and
// an insertion sort finishes it in nearly linear time; where that takes too many moves, a merge
// sort takes over. The order does not depend on which of the two made it.
#pragma once

#include "base/merge_sort.hpp"
#include "geometry/shape.hpp"
#include "spatial/structure_of.hpp"

namespace lantern::spatial {

template <int D>
class SortAndSweep final : public StructureOf<SortAndSweep<D>, D>, CountsAllocations {
 public:
  static constexpr Zones kZones = Zones::fitted;

  explicit SortAndSweep(const StructureConfig<D>& config = {}) : wanted_axis_(config.sweep_axis) {}

  // Tells `store` only.
  template <class Observer>
  void add(const Item<D>& item, Observer&& observer) {
    append(items_, item);
    box_ = items_.size() == 1 ? item.box : united(box_, item.box);
    sorted_ = false;
    observer(Event{Event::Kind::store, 0, item.id, static_cast<std::uint32_t>(items_.size()), 0});
  }

  // The order of the last sweep is kept for the next one, if it has as many items.
  void clear() override {
    items_.clear();
    box_ = {};
    sort_tests_ = 0;
    sorted_ = false;
  }

  // Their boxes must be valid.
  void make(Items<D> items) {
    clear();
    for (const Item<D>& item : items) {
      append(items_, item);
      box_ = items_.size() == 1 ? item.box : united(box_, item.box);
    }
    sort();
  }

  // Chooses the axis and sorts. Needed before `meet`, and for `near` to be fast.
  void sort() override {
    if (sorted_) return;
    axis_ = wanted_axis_.value_or(widest_axis());
    if (order_.size() != items_.size()) {
      order_.clear();
      for (std::uint32_t i = 0; i < items_.size(); ++i) append(order_, i);
    }
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      ++sort_tests_;
      const double x = items_[a].box.lo[axis_], y = items_[b].box.lo[axis_];
      return x < y || (x == y && items_[a].id < items_[b].id);
    };
    swaps_ = sort_nearly_sorted(order_, 8 * order_.size(), before);
    ends_.clear();
    for (const std::uint32_t i : order_) {
      const double end = items_[i].box.hi[axis_];
      append(ends_, ends_.empty() ? end : std::max(ends_.back(), end));
    }
    sorted_ = true;
  }

  std::unique_ptr<Structure<D>> sorted() const override {
    auto copy = std::make_unique<SortAndSweep>(*this);
    copy->sort();
    return copy;
  }

  // f(id, id) for each pair that is compared: they overlap on the axis, and at least one is awake;
  // once, in the order of the sweep. Two that sleep are never compared. Returns how many bodies
  // stand behind the last one that a body is compared with.
  std::uint64_t meet(FunctionRef<bool(BodyId)> awake, FunctionRef<void(BodyId, BodyId)> f) const {
    std::vector<std::uint32_t> watchful;  // places in order_ of those awake
    for (std::uint32_t at = 0; at < order_.size(); ++at)
      if (awake(items_[order_[at]].id)) watchful.push_back(at);
    std::uint64_t ends = 0;
    const auto meet = [&](const Item<D>& a, std::uint32_t other) {
      const Item<D>& b = items_[order_[other]];
      if (b.box.lo[axis_] > a.box.hi[axis_]) {
        ++ends;
        return false;
      }
      f(a.id, b.id);
      return true;
    };
    std::size_t next = 0;  // the first of the watchful that stands behind `at`
    for (std::uint32_t at = 0; at < order_.size(); ++at) {
      stop_if_asked();
      const Item<D>& a = items_[order_[at]];
      if (next < watchful.size() && watchful[next] == at) {
        ++next;
        for (std::uint32_t i = at + 1; i < order_.size() && meet(a, i); ++i) {
        }
      } else {
        for (std::size_t i = next; i < watchful.size() && meet(a, watchful[i]); ++i) {
        }
      }
    }
    return ends;
  }

  // Sorts first.
  std::uint64_t find_pairs(std::span<const Box<D>> exact, FoundPairs& found) {
    sort();
    const std::size_t before = table_.places();
    table_.resize(order_.size());
    for (std::size_t at = 0; at < order_.size(); ++at)
      table_.set(at, items_[order_[at]].id, items_[order_[at]].box);
    allocations_ += table_.places() != before;
    RunScanner<D> runs(table_, table_, exact, found);
    for (std::uint32_t at = 0; at < order_.size(); ++at) runs.add(at, at + 1, end_of(at));
    runs.finish();
    return runs.compared();
  }

  // One leaf; its box is the smallest one that holds all bodies.
  template <class F>
  void take(Tour<D> tour, F&& f) const {
    tour.ids.clear();
    for (const Item<D>& item : items_) tour.ids.push_back(item.id);
    std::ranges::sort(tour.ids);
    f(NodeView<D>{.box = box_, .bodies = tour.ids});
  }

  // Those that the box reaches on the axis of the sweep; all, if `sort` was not called.
  std::uint64_t near(const Box<D>& box, std::vector<BodyId>& ids) const override {
    if (!sorted_) {
      for (const Item<D>& item : items_) ids.push_back(item.id);
      return 0;
    }
    // All that stand before the first end beyond box.lo have ended.
    const auto first = std::lower_bound(ends_.begin(), ends_.end(), box.lo[axis_]);
    std::uint64_t tests = static_cast<std::uint64_t>(std::bit_width(ends_.size()));  // to find it
    for (auto i = static_cast<std::size_t>(first - ends_.begin()); i < order_.size(); ++i) {
      const Item<D>& item = items_[order_[i]];
      const bool begins_later = item.box.lo[axis_] > box.hi[axis_];
      const bool has_ended = item.box.hi[axis_] < box.lo[axis_];
      tests += begins_later || has_ended;
      if (begins_later) break;
      if (!has_ended) ids.push_back(item.id);
    }
    return tests;
  }

  Arrangement arrangement() const override { return {.axis = axis_}; }

  // `box_tests` counts bodies compared with bodies while sorting.
  Counters counters() const override {
    return {.nodes = 1,
            .leaves = 1,
            .entries = items_.size(),
            .box_tests = sort_tests_,
            .allocations = allocations_,
            .swaps = swaps_};
  }

 private:
  // The largest variance of centres; endless boxes, whose centres mean nothing, do not count.
  int widest_axis() const {
    int widest = 0;
    double most = -1;
    for (int axis = 0; axis < D; ++axis) {
      double sum = 0, squares = 0, count = 0;
      for (const Item<D>& item : items_) {
        const double lo = item.box.lo[axis], hi = item.box.hi[axis];
        if (lo <= -kEndless || hi >= kEndless) continue;
        // Measured from the first box, so that a world far from the origin keeps its digits.
        const double x = 0.5 * lo + 0.5 * hi - items_.front().box.lo[axis];
        sum += x;
        squares += x * x;
        ++count;
      }
      if (const double variance = squares - sum * sum / std::max(count, 1.0); variance > most) {
        most = variance;
        widest = axis;
      }
    }
    return widest;
  }

  // The first place in the order, behind this one, that begins after it has ended.
  std::uint32_t end_of(std::uint32_t at) const {
    const double end = items_[order_[at]].box.hi[axis_];
    const auto last =
        std::partition_point(order_.begin() + at + 1, order_.end(),
                             [&](std::uint32_t i) { return items_[i].box.lo[axis_] <= end; });
    return static_cast<std::uint32_t>(last - order_.begin());
  }

  std::vector<Item<D>> items_;
  std::vector<std::uint32_t> order_;  // places in items_, by the lower end on the axis
  std::vector<double> ends_;          // the farthest upper end so far, in that order
  BoxTable<D> table_;                 // in that order
  Box<D> box_;
  int axis_ = 0;
  std::optional<int> wanted_axis_;
  std::uint64_t swaps_ = 0;  // of the last sort, as far as it was by insertion
  bool sorted_ = false;
  std::uint64_t sort_tests_ = 0;
};

}  // namespace lantern::spatial
