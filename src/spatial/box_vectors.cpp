// What is done with several boxes by one instruction. Compiled once for each kind of processor, and
// chosen when it runs: by Highway, which includes this file again and again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spatial/box_vectors.cpp"
#include "spatial/trees/aabb_walk.hpp"
#include "spatial/vector_targets.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lantern::spatial::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// --- pairs ---

// A box against as many as a vector holds. Two boxes overlap if no bound of one lies beyond the
// other's. Both are rounded outward by less than one float: so they certainly overlap if they still
// do after one of them has been made at least two floats smaller on each side.
template <int D>
class Look {
  using Floats = hn::ScalableTag<float>;
  using Vector = hn::Vec<Floats>;

 public:
  using Mask = hn::Mask<Floats>;

  Look(const BoxTable<D>& queries, std::uint32_t place) {
    // By four to eight floats; where they lie closest, by more. What is beyond all floats may lie
    // right behind the last.
    const Vector below = hn::Set(Floats(), 1 - 0x1p-21f), above = hn::Set(Floats(), 1 + 0x1p-21f);
    const Vector least = hn::Set(Floats(), 0x1p-120f);
    const Vector last = hn::Set(Floats(), hwy::HighestValue<float>());
    for (int i = 0; i < D; ++i) {
      lo_[i] = hn::Set(Floats(), queries.lo(i)[place]);
      hi_[i] = hn::Set(Floats(), queries.hi(i)[place]);
      const Vector lo = hn::Max(lo_[i], hn::Neg(last)), hi = hn::Min(hi_[i], last);
      sure_lo_[i] = hn::Add(hn::Max(hn::Mul(lo, below), hn::Mul(lo, above)), least);
      sure_hi_[i] = hn::Sub(hn::Min(hn::Mul(hi, below), hn::Mul(hi, above)), least);
    }
  }

  // Of the lanes of `which`, at `place` and behind: `maybe` overlap, `surely` do.
  void at(const BoxTable<D>& table, std::size_t place, Mask& maybe, Mask& surely) const {
    for (int i = 0; i < D; ++i) {
      const Vector lo = hn::LoadU(Floats(), table.lo(i) + place);
      const Vector hi = hn::LoadU(Floats(), table.hi(i) + place);
      maybe = hn::And(maybe, hn::And(hn::Le(lo_[i], hi), hn::Le(lo, hi_[i])));
      surely = hn::And(surely, hn::And(hn::Lt(sure_lo_[i], hi), hn::Lt(lo, sure_hi_[i])));
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

// --- boxes and rays in a block of an AABB tree ---

using Lanes = hn::CappedTag<float, kAabbBlock>;

// look(at): the mask of the lanes from place `at` on.
template <class Look>
std::uint32_t BitsOf(std::uint32_t first, Look look) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < kAabbBlock; i += static_cast<std::uint32_t>(hn::Lanes(Lanes()))) {
    std::uint8_t part[8] = {};
    hn::StoreMaskBits(Lanes(), look(first + i), part);
    bits |= (part[0] | std::uint32_t{part[1]} << 8) << i;
  }
  return bits;
}

template <int D>
BlockBits Reached(const BoxTable<D>& table, std::uint32_t first, const AabbNode<D>& asked) {
  const auto bits = [&](int smaller) {
    return BitsOf(first, [&](std::uint32_t at) {
      auto all = hn::FirstN(Lanes(), kAabbBlock);
      for (int i = 0; i < D; ++i) {
        const auto lo = hn::Set(Lanes(), detail::stepped(asked.lo[i], smaller));
        const auto hi = hn::Set(Lanes(), detail::stepped(asked.hi[i], -smaller));
        all = hn::And(all, hn::And(hn::Le(hn::LoadU(Lanes(), table.lo(i) + at), hi),
                                   hn::Le(lo, hn::LoadU(Lanes(), table.hi(i) + at))));
      }
      return all;
    });
  };
  return {bits(0), bits(2)};
}

// The slab method (geometry/ray.hpp), each span widened by what float may have lost.
template <int D>
std::uint32_t Met(const BoxTable<D>& table, std::uint32_t first, const FloatRay<D>& ray,
                  float limit) {
  const auto set = [](float x) { return hn::Set(Lanes(), x); };
  const auto less = set(1 - 0x1p-21f), more = set(1 + 0x1p-21f);
  return BitsOf(first, [&](std::uint32_t at) {
    auto from = set(0), to = set(limit);
    auto all = hn::FirstN(Lanes(), kAabbBlock);
    for (int i = 0; i < D; ++i) {
      const auto lo = hn::LoadU(Lanes(), table.lo(i) + at);
      const auto hi = hn::LoadU(Lanes(), table.hi(i) + at);
      if (ray.stands[i]) {
        all = hn::And(all, hn::And(hn::Le(lo, set(ray.above[i])), hn::Le(set(ray.below[i]), hi)));
        continue;
      }
      const auto inverse = set(ray.inverse[i]), origin = set(ray.origin[i]);
      const auto a = hn::Mul(hn::Sub(lo, origin), inverse);
      const auto b = hn::Mul(hn::Sub(hi, origin), inverse);
      const auto begin = hn::Sub(hn::Min(a, b), set(ray.slack[i]));
      const auto end = hn::Add(hn::Max(a, b), set(ray.slack[i]));
      from = hn::Max(from, hn::Mul(begin, less));
      to = hn::Min(to, hn::Max(hn::Mul(end, less), hn::Mul(end, more)));
    }
    return hn::And(all, hn::Le(from, to));
  });
}

}  // namespace lantern::spatial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lantern::spatial {

template <int D>
ScanDone scan_runs(const ScanTask<D>& task, const ScanRoom& room, std::size_t begin,
                   std::size_t end) {
  static const auto best = LANTERN_BEST(ScanRuns<D>);
  return best(task, room, begin, end);
}
template <int D>
BlockBits reached_in_block(const BoxTable<D>& table, std::uint32_t first,
                           const AabbNode<D>& asked) {
  static const auto best = LANTERN_BEST(Reached<D>);
  return best(table, first, asked);
}
template <int D>
std::uint32_t met_in_block(const BoxTable<D>& table, std::uint32_t first, const FloatRay<D>& ray,
                           float limit) {
  static const auto best = LANTERN_BEST(Met<D>);
  return best(table, first, ray, limit);
}

template ScanDone scan_runs(const ScanTask<2>&, const ScanRoom&, std::size_t, std::size_t);
template ScanDone scan_runs(const ScanTask<3>&, const ScanRoom&, std::size_t, std::size_t);
template BlockBits reached_in_block(const BoxTable<2>&, std::uint32_t, const AabbNode<2>&);
template BlockBits reached_in_block(const BoxTable<3>&, std::uint32_t, const AabbNode<3>&);
template std::uint32_t met_in_block(const BoxTable<2>&, std::uint32_t, const FloatRay<2>&, float);
template std::uint32_t met_in_block(const BoxTable<3>&, std::uint32_t, const FloatRay<3>&, float);

}  // namespace lantern::spatial
#endif
