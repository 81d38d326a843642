// What is done with several boxes by one instruction. Compiled once for each kind of processor, and
// chosen when it runs: by Highway, which includes this file again and again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spatial/box_vectors.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "spatial/box_row.hpp"
#include "spatial/vector_targets.hpp"

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
      const Box<D>& box = task.exact[asking];
      for (std::size_t place = at; place < run.to && place < at + lanes; ++place) {
        room.first[pairs] = asking;
        room.second[pairs] = ids[place];
        pairs += overlap(box, task.exact[ids[place]]);
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

// --- boxes, balls and rays among the boxes of a row ---

using Lanes = hn::CappedTag<float, kAabbBlock>;

std::uint32_t MaskBits(hn::Mask<Lanes> mask) {
  std::uint8_t part[8] = {};
  hn::StoreMaskBits(Lanes(), mask, part);
  return part[0] | std::uint32_t{part[1]} << 8;
}

// look(at): the mask of the lanes from place `at` on.
template <class Look>
std::uint32_t BitsOf(Look look) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < kAabbBlock; i += static_cast<std::uint32_t>(hn::Lanes(Lanes()))) {
    bits |= MaskBits(look(i)) << i;
  }
  return bits;
}

template <int D>
BlockBits Reached(const BoxRow<D>& row, const FloatBox<D>& asked) {
  const auto bits = [&](int smaller) {
    return BitsOf([&](std::uint32_t at) {
      auto all = hn::FirstN(Lanes(), kAabbBlock);
      for (int i = 0; i < D; ++i) {
        const auto lo = hn::Set(Lanes(), detail::stepped(asked.lo[i], smaller));
        const auto hi = hn::Set(Lanes(), detail::stepped(asked.hi[i], -smaller));
        all = hn::And(all, hn::And(hn::Le(hn::LoadU(Lanes(), row.lo[i] + at), hi),
                                   hn::Le(lo, hn::LoadU(Lanes(), row.hi[i] + at))));
      }
      return all;
    });
  };
  return {bits(0), bits(2)};
}

// How far each box is from the centre, at least and at most, in squares.
template <int D>
BlockBits InBall(const BoxRow<D>& row, const FloatBall<D>& ball, BlockEntries& entries) {
  const auto set = [](float x) { return hn::Set(Lanes(), x); };
  const auto less = set(1 - 0x1p-20f), more = set(1 + 0x1p-20f), none = hn::Zero(Lanes());
  const auto bits = [&](bool at_most) {
    return BitsOf([&](std::uint32_t at) {
      auto squares = none;
      for (int i = 0; i < D; ++i) {
        const auto center = set(ball.center[i]), slack = set(ball.slack[i]);
        const auto lo = hn::LoadU(Lanes(), row.lo[i] + at);
        const auto hi = hn::LoadU(Lanes(), row.hi[i] + at);
        const auto gap = hn::Max(hn::Sub(lo, center), hn::Sub(center, hi));
        const auto wide =
            at_most ? hn::Add(hn::Mul(gap, more), slack) : hn::Sub(hn::Mul(gap, less), slack);
        const auto beside = hn::Max(wide, none);
        squares = hn::Add(squares, hn::Mul(beside, beside));
      }
      if (!at_most) hn::StoreU(hn::Mul(squares, less), Lanes(), entries.data() + at);
      return hn::Le(squares, hn::Mul(set(ball.square), at_most ? less : more));
    });
  };
  return {bits(false), bits(true)};
}

// The slab method (geometry/ray.hpp), each span once widened and once narrowed by what float may
// have lost.
template <int D>
BlockBits Met(const BoxRow<D>& row, const FloatRay<D>& ray, float limit, BlockEntries& entries) {
  const auto set = [](float x) { return hn::Set(Lanes(), x); };
  const auto less = set(1 - 0x1p-21f), more = set(1 + 0x1p-21f);
  BlockBits bits;
  bits.maybe = BitsOf([&](std::uint32_t at) {
    auto from = set(0), to = set(limit), sure_from = from, sure_to = hn::Mul(to, less);
    auto all = hn::FirstN(Lanes(), kAabbBlock), sure = all;
    for (int i = 0; i < D; ++i) {
      const auto lo = hn::LoadU(Lanes(), row.lo[i] + at);
      const auto hi = hn::LoadU(Lanes(), row.hi[i] + at);
      if (ray.stands[i]) {
        const auto above = set(ray.above[i]), below = set(ray.below[i]);
        all = hn::And(all, hn::And(hn::Le(lo, above), hn::Le(below, hi)));
        sure = hn::And(sure, hn::And(hn::Lt(lo, below), hn::Lt(above, hi)));
        continue;
      }
      const auto inverse = set(ray.inverse[i]), origin = set(ray.origin[i]);
      const auto slack = set(ray.slack[i]);
      const auto a = hn::Mul(hn::Sub(lo, origin), inverse);
      const auto b = hn::Mul(hn::Sub(hi, origin), inverse);
      const auto begin = hn::Min(a, b), end = hn::Max(a, b);
      const auto late = hn::Add(begin, slack), soon = hn::Sub(end, slack);
      const auto last = hn::Add(end, slack);
      from = hn::Max(from, hn::Mul(hn::Sub(begin, slack), less));
      to = hn::Min(to, hn::Max(hn::Mul(last, less), hn::Mul(last, more)));
      sure_from = hn::Max(sure_from, hn::Mul(late, more));
      sure_to = hn::Min(sure_to, hn::Min(hn::Mul(soon, less), hn::Mul(soon, more)));
    }
    hn::StoreU(from, Lanes(), entries.data() + at);
    sure = hn::And(sure, hn::And(hn::Le(sure_from, sure_to), hn::Lt(sure_from, set(1e30f))));
    bits.surely |= MaskBits(sure) << at;
    return hn::And(all, hn::Le(from, to));
  });
  return bits;
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
BlockBits reached_in_block(const BoxRow<D>& row, const FloatBox<D>& asked) {
  static const auto best = LANTERN_BEST(Reached<D>);
  return best(row, asked);
}
template <int D>
BlockBits reached_in_block(const BoxRow<D>& row, const FloatBall<D>& ball, BlockEntries& entries) {
  static const auto best = LANTERN_BEST(InBall<D>);
  return best(row, ball, entries);
}
template <int D>
BlockBits met_in_block(const BoxRow<D>& row, const FloatRay<D>& ray, float limit,
                       BlockEntries& entries) {
  static const auto best = LANTERN_BEST(Met<D>);
  return best(row, ray, limit, entries);
}

template ScanDone scan_runs(const ScanTask<2>&, const ScanRoom&, std::size_t, std::size_t);
template ScanDone scan_runs(const ScanTask<3>&, const ScanRoom&, std::size_t, std::size_t);
template BlockBits reached_in_block(const BoxRow<2>&, const FloatBox<2>&);
template BlockBits reached_in_block(const BoxRow<3>&, const FloatBox<3>&);
template BlockBits reached_in_block(const BoxRow<2>&, const FloatBall<2>&, BlockEntries&);
template BlockBits reached_in_block(const BoxRow<3>&, const FloatBall<3>&, BlockEntries&);
template BlockBits met_in_block(const BoxRow<2>&, const FloatRay<2>&, float, BlockEntries&);
template BlockBits met_in_block(const BoxRow<3>&, const FloatRay<3>&, float, BlockEntries&);

}  // namespace lantern::spatial
#endif
