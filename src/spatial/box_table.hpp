// Boxes for the first look: `float`, rounded outward, each bound of all of them in an array of its
// own, so that one instruction compares a box with 4 to 16 others. What `float` cannot decide the
// boxes in `double` decide, so that what is found is exact.
//
//   lo.x | 0.1 | 0.3 | 0.7 | ...     a run: the box at one place, compared with those at the places
//   hi.x | 0.4 | 0.5 | 0.9 | ...     from, from + 1, ..., to - 1
//   lo.y | ...
//
// A structure arranges its bodies so that what a body may meet stands side by side, and hands over
// runs. The width of the vectors is that of the processor on which it runs (Highway chooses); what
// is found, and in which order, does not depend on it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "spatial/structure.hpp"

namespace lantern::spatial {

namespace detail {

// So many floats further: the order of floats is that of their bits, of negative ones turned.
// Without a branch, which would be guessed wrong every other time.
inline float stepped(float x, int by) {
  constexpr std::int32_t kMagnitude = 0x7fff'ffff;
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t sign = bits >> 31;
  const std::int32_t next = (((bits & kMagnitude) ^ sign) - sign) + by;
  const std::int32_t next_sign = next >> 31;
  return std::bit_cast<float>(((next ^ next_sign) - next_sign) | (next_sign & ~kMagnitude));
}

}  // namespace detail

// Some boxes in a row: each bound of all, and their ids.
template <int D>
struct BoxRow {
  static constexpr int kDimension = D;
  const float* lo[D];
  const float* hi[D];
  const std::byte* ids;

  BodyId id(std::size_t place) const {
    BodyId id;
    std::memcpy(&id, ids + place * sizeof id, sizeof id);
    return id;
  }
  BoxRow from(std::size_t place) const {
    BoxRow row = *this;
    for (int i = 0; i < D; ++i) {
      row.lo[i] += place;
      row.hi[i] += place;
    }
    row.ids += place * sizeof(BodyId);
    return row;
  }
};

template <int D>
class BoxTable {
 public:
  // Places beyond the last, which may be read and are never found.
  static constexpr std::size_t kPadding = 64;

  // What the places hold afterwards is not said.
  void resize(std::size_t size);
  std::size_t size() const { return size_; }

  // The box rounded outward.
  void set(std::size_t place, BodyId id, const Box<D>& box) {
    for (int i = 0; i < D; ++i) {
      lo_[i][place] = rounded_down(box.lo[i]);
      hi_[i][place] = rounded_up(box.hi[i]);
    }
    ids_[place] = id;
  }

  BoxRow<D> row(std::size_t first) const {
    BoxRow<D> row;
    for (int i = 0; i < D; ++i) {
      row.lo[i] = lo_[i].data();
      row.hi[i] = hi_[i].data();
    }
    row.ids = reinterpret_cast<const std::byte*>(ids_.data());
    return row.from(first);
  }
  // What stands there will soon be looked at.
  void fetch(std::size_t place) const {
    for (int i = 0; i < D; ++i) {
      __builtin_prefetch(lo_[i].data() + place);
      __builtin_prefetch(hi_[i].data() + place);
    }
    __builtin_prefetch(ids_.data() + place);
  }
  BodyId id(std::size_t place) const { return ids_[place]; }
  const float* lo(int axis) const { return lo_[axis].data(); }
  const float* hi(int axis) const { return hi_[axis].data(); }
  const BodyId* ids() const { return ids_.data(); }
  // Places for which there is memory.
  std::size_t places() const { return ids_.capacity(); }

  // The greatest float that is not above x, and the least that is not below it.
  static float rounded_down(double x) {
    const auto nearest = static_cast<float>(x);
    return detail::stepped(nearest, -(nearest > x));
  }
  static float rounded_up(double x) {
    const auto nearest = static_cast<float>(x);
    return detail::stepped(nearest, nearest < x);
  }

 private:
  std::size_t size_ = 0;
  std::array<std::vector<float>, D> lo_, hi_;
  std::vector<BodyId> ids_;
};

// The box at the place `query` of one table against those at the places from, ..., to - 1 of
// another.
struct ScanRun {
  std::uint32_t query = 0;
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

template <int D>
struct ScanTask {
  const BoxTable<D>& queries;
  const BoxTable<D>& table;
  std::span<const Box<D>> exact;
  std::span<const ScanRun> runs;
};

// Pairs of bodies by their ids, in two lists side by side.
class FoundPairs {
 public:
  // Asked before the lists grow to so many pairs, with a body of the last one: throws if they must
  // not. By default they may. With several threads it is asked on any of them.
  using MayGrow = std::function<void(BodyId body, std::size_t pairs)>;

  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  std::span<const BodyId> first() const { return {first_.data(), size_}; }
  std::span<const BodyId> second() const { return {second_.data(), size_}; }
  std::span<BodyId> first() { return {first_.data(), size_}; }
  std::span<BodyId> second() { return {second_.data(), size_}; }

  void add(BodyId a, BodyId b) {
    if (size_ == first_.size()) reserve(size_ + 1, a);
    first_[size_] = a;
    second_[size_++] = b;
  }
  // Makes room for so many pairs in all.
  void reserve(std::size_t pairs, BodyId body);
  // Of the reserved ones, so many are there now.
  void resize(std::size_t size) { size_ = size; }
  std::size_t reserved() const { return first_.size(); }
  void ask_before_growing(MayGrow may_grow) { may_grow_ = std::move(may_grow); }

  // How many threads may scan for these pairs; what is found, and its order, does not depend on it.
  void set_threads(unsigned threads) { parts_.resize(threads < 2 ? 0 : threads - 1); }
  unsigned threads() const { return static_cast<unsigned>(parts_.size()) + 1; }

  // Places for which there is memory.
  std::size_t places() const;

 private:
  template <int D>
  friend void scan(const ScanTask<D>& task, FoundPairs& found);
  template <int D>
  friend class RunScanner;

  void append(const FoundPairs& other);

  std::size_t size_ = 0;
  std::vector<BodyId> first_, second_;
  MayGrow may_grow_;
  std::vector<FoundPairs> parts_;  // of the other threads, while they scan
  std::vector<ScanRun> runs_;      // that wait to be scanned
};

// Adds (id of the query, id of the place) for each place of each run whose box overlaps the
// query's, in the order of runs and places. `exact[id]` is the box of the body with that id, in
// both tables.
template <int D>
void scan(const ScanTask<D>& task, FoundPairs& found);

// Collects runs of one table against itself or another, and scans them some thousands at a time.
template <int D>
class RunScanner {
 public:
  RunScanner(const BoxTable<D>& queries, const BoxTable<D>& table, std::span<const Box<D>> exact,
             FoundPairs& found)
      : queries_(queries), table_(table), exact_(exact), found_(found) {
    // For one thread as many as stay in its nearest cache, for several enough to share out.
    found_.runs_.resize(found_.threads() == 1 ? 1024 : 32'768);
  }

  // Of an empty run, from == to, nothing comes: half of those of a grid are, and no branch could
  // guess which.
  void add(std::uint32_t query, std::uint32_t from, std::uint32_t to) {
    compared_ += to - from;
    found_.runs_[count_] = {query, from, to};
    count_ += from < to;
    if (count_ == found_.runs_.size()) finish();
  }
  // To be called after the last run.
  void finish() {
    scan<D>({queries_, table_, exact_, std::span(found_.runs_).first(count_)}, found_);
    count_ = 0;
  }
  // Boxes with boxes, so far.
  std::uint64_t compared() const { return compared_; }

 private:
  const BoxTable<D>& queries_;
  const BoxTable<D>& table_;
  std::span<const Box<D>> exact_;
  FoundPairs& found_;
  std::size_t count_ = 0;
  std::uint64_t compared_ = 0;
};

// --- the inner loop of all candidate pairs (box_vectors.cpp) ---

struct ScanRoom {
  BodyId* first;
  BodyId* second;
};

struct ScanDone {
  std::size_t runs = 0;   // of the task, from its first
  std::size_t pairs = 0;  // that the lists hold now
};

// Writes behind `begin` pairs, and ends before a run that might find more than up to `end`. What
// lies up to BoxTable::kPadding places behind the last pair is overwritten.
template <int D>
ScanDone scan_runs(const ScanTask<D>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end);

// Pairs in order of their lower, then their higher number, without comparing them with each other:
// counted into one row for each lower number; short rows are put in order by insertion, long ones
// by a bit for each number. To put millions of pairs in order by comparisons takes longer than to
// find them.
class PairOrder {
 public:
  // The pairs of so many numbers, each once, by the names of the numbers, if there are any, instead
  // of what `ordered` held. The names ascend. `found` may name a pair in both ways, and more than
  // once; it is used as scratch, and by as many threads as may scan for it.
  void order(FoundPairs& found, std::size_t numbers, std::span<const BodyId> names,
             std::vector<Pair>& ordered);

  // Places for which there is memory.
  std::size_t places() const;

 private:
  // What one thread works on: some of the pairs that were found, later some of the rows.
  struct Part {
    std::vector<std::uint32_t> begin;  // of each row in partners_: where its own pairs go
    std::vector<std::uint64_t> bits;   // all zero between rows
    std::uint32_t first_row = 0, end_row = 0;
    std::size_t ordered = 0;  // how many pairs of its rows there are, each once
  };

  void fill_rows(FoundPairs& found);
  void share_rows(std::size_t pairs);
  void order_rows(Part& part, std::span<const BodyId> names, Pair* ordered);
  static std::span<std::uint32_t> in_order(std::span<std::uint32_t> row, Part& part);
  static std::span<std::uint32_t> by_bits(std::span<std::uint32_t> row, Part& part);

  std::vector<Part> parts_;
  std::vector<std::uint32_t> end_;       // of each row
  std::vector<std::uint32_t> partners_;  // the higher numbers, row by row
};

}  // namespace lantern::spatial
