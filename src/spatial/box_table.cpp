#include "spatial/box_table.hpp"

#include <utility>

#include "base/parallel.hpp"
#include "base/stop.hpp"

namespace lantern::spatial {

template <int D>
void BoxTable<D>::resize(std::size_t size) {
  size_ = size;
  if (size + kPadding <= ids_.size()) return;
  const std::size_t places = size + size / 4 + kPadding;  // the next time it may be a little larger
  for (int i = 0; i < D; ++i) {
    lo_[i].resize(places);
    hi_[i].resize(places);
  }
  ids_.resize(places);
}

void FoundPairs::reserve(std::size_t pairs, BodyId body) {
  if (pairs <= first_.size()) return;
  const std::size_t size = std::max({pairs, 2 * first_.size(), std::size_t{512}});
  if (may_grow_) may_grow_(body, size);
  first_.resize(size);
  second_.resize(size);
}

std::size_t FoundPairs::places() const {
  std::size_t all = first_.capacity() + second_.capacity() + runs_.capacity();
  for (const FoundPairs& part : parts_) all += part.places();
  return all;
}

void FoundPairs::append(const FoundPairs& other) {
  if (other.size_ == 0) return;
  reserve(size_ + other.size_ + BoxTable<2>::kPadding, other.first_.front());
  std::copy_n(other.first_.begin(), other.size_,
              first_.begin() + static_cast<std::ptrdiff_t>(size_));
  std::copy_n(other.second_.begin(), other.size_,
              second_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += other.size_;
}

namespace {

// Room is made for the next run at least; a run that does not fit waits for more.
template <int D>
void scan_part(ScanTask<D> task, FoundPairs& found) {
  while (!task.runs.empty()) {
    stop_if_asked();
    const ScanRun& next = task.runs.front();
    found.reserve(found.size() + (next.to - next.from) + BoxTable<D>::kPadding,
                  task.queries.id(next.query));
    const ScanDone done = scan_runs(task, {found.first().data(), found.second().data()},
                                    found.size(), found.reserved() - BoxTable<D>::kPadding);
    found.resize(done.pairs);
    task.runs = task.runs.subspan(done.runs);
  }
}

// Of a run: what it costs beside its comparisons is that of some sixteen of them.
std::uint64_t work_of(const ScanRun& run) { return 16 + (run.to - run.from); }

constexpr std::size_t kShortRow = 24;
constexpr std::size_t kWorthThreads = 1 << 18;  // pairs

bool is_in_order(const FoundPairs& found) {
  const auto a = found.first(), b = found.second();
  for (std::size_t i = 0; i < found.size(); ++i)
    if (a[i] >= b[i] || (i > 0 && (a[i - 1] > a[i] || (a[i - 1] == a[i] && b[i - 1] >= b[i]))))
      return false;
  return true;
}

std::pair<std::size_t, std::size_t> share(std::size_t size, std::size_t part, std::size_t parts) {
  return {size * part / parts, size * (part + 1) / parts};
}

}  // namespace

template <int D>
void scan(const ScanTask<D>& task, FoundPairs& found) {
  const std::span<const ScanRun> runs = task.runs;
  constexpr std::uint64_t kWorthAThread = 1 << 20;  // to start one costs some of this
  std::uint64_t work = 0;
  if (found.threads() > 1)
    for (const ScanRun& run : runs) work += work_of(run);
  if (work < kWorthAThread) return scan_part(task, found);
  std::vector<std::size_t> begins{0};  // of each part, of as much work as the others
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (sum * found.threads() >= work * begins.size() && begins.size() < found.threads())
      begins.push_back(i);
    sum += work_of(runs[i]);
  }
  begins.resize(found.threads() + 1, runs.size());
  for (FoundPairs& part : found.parts_) {
    part.clear();
    part.may_grow_ = found.may_grow_;
  }
  in_parallel(found.threads(), [&](unsigned i) {
    ScanTask<D> part = task;
    part.runs = runs.subspan(begins[i], begins[i + 1] - begins[i]);
    scan_part(part, i == 0 ? found : found.parts_[i - 1]);
  });
  for (const FoundPairs& part : found.parts_) found.append(part);
}

template class BoxTable<2>;
template class BoxTable<3>;
template void scan(const ScanTask<2>&, FoundPairs&);
template void scan(const ScanTask<3>&, FoundPairs&);

void PairOrder::order(FoundPairs& found, std::size_t numbers, std::span<const BodyId> names,
                      std::vector<Pair>& ordered) {
  ordered.reserve(found.reserved());  // as found grows: seldom
  ordered.resize(found.size());
  if (is_in_order(found)) {
    for (std::size_t i = 0; i < found.size(); ++i)
      ordered[i] = {id_at(names, found.first()[i]), id_at(names, found.second()[i])};
    return;
  }
  parts_.resize(found.size() < kWorthThreads ? 1 : found.threads());
  for (Part& part : parts_) part.begin.assign(numbers, 0);
  end_.resize(numbers);
  if (partners_.size() < found.size()) partners_.resize(found.reserved());
  fill_rows(found);
  share_rows(found.size());
  in_parallel(static_cast<unsigned>(parts_.size()),
              [&](unsigned i) { order_rows(parts_[i], names, ordered.data()); });
  // Where pairs were told more than once, each part has left a gap behind its own.
  std::size_t size = 0;
  for (const Part& part : parts_) {
    const auto from = ordered.begin() + (part.first_row == 0 ? 0 : end_[part.first_row - 1]);
    std::copy_n(from, part.ordered, ordered.begin() + static_cast<std::ptrdiff_t>(size));
    size += part.ordered;
  }
  ordered.resize(size);
}

// Each part counts, then puts down, its share of the pairs; in a row those of the first part first.
void PairOrder::fill_rows(FoundPairs& found) {
  const std::span<BodyId> lower = found.first(), higher = found.second();
  const auto parts = static_cast<unsigned>(parts_.size());
  in_parallel(parts, [&](unsigned p) {
    const auto [from, to] = share(found.size(), p, parts);
    for (std::size_t i = from; i < to; ++i) {
      const auto [low, high] = std::minmax({lower[i], higher[i]});
      lower[i] = low;
      higher[i] = high;
      ++parts_[p].begin[low];
    }
  });
  std::uint32_t next = 0;
  for (std::size_t row = 0; row < end_.size(); ++row) {
    for (Part& part : parts_) next += std::exchange(part.begin[row], next);
    end_[row] = next;
  }
  in_parallel(parts, [&](unsigned p) {
    const auto [from, to] = share(found.size(), p, parts);
    std::vector<std::uint32_t>& begin = parts_[p].begin;
    for (std::size_t i = from; i < to; ++i) partners_[begin[lower[i]]++] = higher[i];
  });
}

void PairOrder::share_rows(std::size_t pairs) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const auto row_at = [&](std::size_t pair) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(end_, pair) - end_.begin());
    };
    const auto [from, to] = share(pairs, p, parts_.size());
    parts_[p].first_row = p == 0 ? 0 : row_at(from);
    parts_[p].end_row =
        p + 1 == parts_.size() ? static_cast<std::uint32_t>(end_.size()) : row_at(to);
  }
}

void PairOrder::order_rows(Part& part, std::span<const BodyId> names, Pair* ordered) {
  std::uint32_t begin = part.first_row == 0 ? 0 : end_[part.first_row - 1];
  Pair* const first = ordered + begin;
  Pair* next = first;
  for (std::uint32_t row = part.first_row; row < part.end_row; ++row) {
    const std::uint32_t end = end_[row];
    if (begin == end) continue;
    stop_if_asked();
    const BodyId name = id_at(names, row);
    for (const std::uint32_t b : in_order(std::span(partners_).subspan(begin, end - begin), part))
      *next++ = {name, id_at(names, b)};
    begin = end;
  }
  part.ordered = static_cast<std::size_t>(next - first);
}

// Each once.
std::span<std::uint32_t> PairOrder::in_order(std::span<std::uint32_t> row, Part& part) {
  if (row.size() > kShortRow) return by_bits(row, part);
  std::size_t size = 0;
  for (const std::uint32_t value : row) {
    std::size_t at = size;
    while (at > 0 && row[at - 1] > value) --at;
    if (at > 0 && row[at - 1] == value) continue;
    for (std::size_t i = size++; i > at; --i) row[i] = row[i - 1];
    row[at] = value;
  }
  return row.first(size);
}

// Where the numbers of a row lie far apart there would be more words to look at than it is worth.
std::span<std::uint32_t> PairOrder::by_bits(std::span<std::uint32_t> row, Part& part) {
  const auto [least, most] = std::ranges::minmax(row);
  const std::size_t first = least / 64, last = most / 64;
  if (last - first > 8 * row.size()) {
    std::ranges::sort(row);
    return row.first(static_cast<std::size_t>(std::ranges::unique(row).begin() - row.begin()));
  }
  if (part.bits.size() <= last) part.bits.resize(last + 1);
  for (const std::uint32_t value : row) part.bits[value / 64] |= std::uint64_t{1} << value % 64;
  std::size_t size = 0;
  for (std::size_t word = first; word <= last; ++word)
    for (std::uint64_t bits = std::exchange(part.bits[word], 0); bits != 0; bits &= bits - 1)
      row[size++] = static_cast<std::uint32_t>(64 * word + std::countr_zero(bits));
  return row.first(size);
}

std::size_t PairOrder::places() const {
  std::size_t all = parts_.capacity() + end_.capacity() + partners_.capacity();
  for (const Part& part : parts_) all += part.begin.capacity() + part.bits.capacity();
  return all;
}

}  // namespace lantern::spatial
