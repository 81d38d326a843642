#include "spatial/box_table.hpp"

#include <algorithm>
#include <limits>

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
void scan_part(const BoxTable<D>& queries, const BoxTable<D>& table, std::span<const Item<D>> exact,
               std::span<const ScanRun> runs, FoundPairs& found) {
  while (!runs.empty()) {
    stop_if_asked();
    const std::size_t next = runs.front().to - runs.front().from;
    found.reserve(found.size() + next + BoxTable<D>::kPadding, queries.id(runs.front().query));
    const ScanTask<D> task{queries, table, exact, runs};
    const ScanDone done = scan_runs(task, {found.first().data(), found.second().data()},
                                    found.size(), found.reserved() - BoxTable<D>::kPadding);
    found.resize(done.pairs);
    runs = runs.subspan(done.runs);
  }
}

// Of a run: what it costs beside its comparisons is that of some sixteen of them.
std::uint64_t work_of(const ScanRun& run) { return 16 + (run.to - run.from); }

}  // namespace

template <int D>
void scan(const BoxTable<D>& queries, const BoxTable<D>& table, std::span<const Item<D>> exact,
          std::span<const ScanRun> runs, FoundPairs& found) {
  constexpr std::uint64_t kWorthAThread = 1 << 20;  // to start one costs some of this
  std::uint64_t work = 0;
  if (found.threads() > 1)
    for (const ScanRun& run : runs) work += work_of(run);
  if (work < kWorthAThread) return scan_part(queries, table, exact, runs, found);
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
    scan_part(queries, table, exact, runs.subspan(begins[i], begins[i + 1] - begins[i]),
              i == 0 ? found : found.parts_[i - 1]);
  });
  for (const FoundPairs& part : found.parts_) found.append(part);
}

template class BoxTable<2>;
template class BoxTable<3>;
template void scan(const BoxTable<2>&, const BoxTable<2>&, std::span<const Item<2>>,
                   std::span<const ScanRun>, FoundPairs&);
template void scan(const BoxTable<3>&, const BoxTable<3>&, std::span<const Item<3>>,
                   std::span<const ScanRun>, FoundPairs&);

}  // namespace lantern::spatial
