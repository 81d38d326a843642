// Compiled once for each kind of processor, and chosen when it runs: by Highway, which includes
// this file again and again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spatial/box_scan.cpp"
#include "spatial/box_scan.hpp"

// clang-format off: before Highway's own
#include "spatial/vector_target.hpp"
// clang-format on

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lantern::spatial::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A box against as many as a vector holds. Two boxes overlap if no bound of one lies beyond the
// other's. Both are rounded outward by less than one float: so they certainly overlap if they still
// do after one of them has been made two floats smaller on each side.
template <int D>
class Look {
  using Floats = hn::ScalableTag<float>;
  using Vector = hn::Vec<Floats>;

 public:
  using Mask = hn::Mask<Floats>;

  Look(const BoxTable<D>& queries, std::uint32_t place) {
    for (int i = 0; i < D; ++i) {
      const float lo = queries.lo(i)[place], hi = queries.hi(i)[place];
      lo_[i] = hn::Set(Floats(), lo);
      hi_[i] = hn::Set(Floats(), hi);
      sure_lo_[i] = hn::Set(Floats(), detail::stepped(lo, 2));
      sure_hi_[i] = hn::Set(Floats(), detail::stepped(hi, -2));
    }
  }

  // Of the lanes of `which`, at `place` and behind: `maybe` overlap, `surely` do.
  void at(const BoxTable<D>& table, std::size_t place, Mask& maybe, Mask& surely) const {
    for (int i = 0; i < D; ++i) {
      const Vector lo = hn::LoadU(Floats(), table.lo(i) + place);
      const Vector hi = hn::LoadU(Floats(), table.hi(i) + place);
      maybe = hn::And(maybe, hn::And(hn::Le(lo_[i], hi), hn::Le(lo, hi_[i])));
      surely = hn::And(surely, hn::And(hn::Le(sure_lo_[i], hi), hn::Le(lo, sure_hi_[i])));
    }
  }

 private:
  Vector lo_[D], hi_[D], sure_lo_[D], sure_hi_[D];
};

template <int D>
std::size_t OneRun(const ScanTask<D>& task, const ScanRun& run, const ScanRoom& room,
                   std::size_t pairs) {
  const hn::ScalableTag<float> floats;
  const hn::RebindToUnsigned<decltype(floats)> words;
  const std::size_t lanes = hn::Lanes(floats);
  const Look<D> look(task.queries, run.query);
  const BodyId asking = task.queries.id(run.query);
  const BodyId* ids = task.table.ids();
  const auto asking_lanes = hn::Set(words, asking);
  for (std::size_t at = run.from; at < run.to; at += lanes) {
    auto maybe = hn::FirstN(floats, run.to - at), surely = maybe;
    look.at(task.table, at, maybe, surely);
    if (HWY_UNLIKELY(!hn::AllFalse(floats, hn::AndNot(surely, maybe)))) {
      const Box<D>& box = task.exact[asking].box;
      for (std::size_t place = at; place < run.to && place < at + lanes; ++place) {
        room.first[pairs] = asking;
        room.second[pairs] = ids[place];
        pairs += overlap(box, task.exact[ids[place]].box);
      }
      continue;
    }
    hn::StoreU(asking_lanes, words, room.first + pairs);
    pairs += hn::CompressStore(hn::LoadU(words, ids + at), hn::RebindMask(words, maybe), words,
                               room.second + pairs);
  }
  return pairs;
}

template <int D>
ScanDone ScanRuns(const ScanTask<D>& task, const ScanRoom& room, std::size_t pairs,
                  std::size_t end) {
  std::size_t done = 0;
  for (; done < task.runs.size(); ++done) {
    const ScanRun& run = task.runs[done];
    if (pairs + (run.to - run.from) > end) break;
    pairs = OneRun(task, run, room, pairs);
  }
  return {done, pairs};
}

ScanDone ScanRuns2(const ScanTask<2>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end) {
  return ScanRuns(task, room, begin, end);
}
ScanDone ScanRuns3(const ScanTask<3>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end) {
  return ScanRuns(task, room, begin, end);
}

}  // namespace lantern::spatial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lantern::spatial {

ScanDone scan_runs(const ScanTask<2>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end) {
  static const auto best = LANTERN_BEST(ScanRuns2);
  return best(task, room, begin, end);
}
ScanDone scan_runs(const ScanTask<3>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end) {
  static const auto best = LANTERN_BEST(ScanRuns3);
  return best(task, room, begin, end);
}

}  // namespace lantern::spatial
#endif
