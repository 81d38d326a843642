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

using Lanes = hn::CappedTag<float, kRowBlock>;

std::uint32_t MaskBits(hn::Mask<Lanes> mask) {
  std::uint8_t part[8] = {};
  hn::StoreMaskBits(Lanes(), mask, part);
  return part[0] | std::uint32_t{part[1]} << 8;
}

// look(at): the mask of the lanes from place `at` on.
template <class Look>
std::uint32_t BitsOf(Look look) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < kRowBlock; i += static_cast<std::uint32_t>(hn::Lanes(Lanes()))) {
    bits |= MaskBits(look(i)) << i;
  }
  return bits;
}

using Floats = hn::Vec<Lanes>;

// Edges of the boxes from some place of a row on, and edges that their boxes in double reach.
struct Edges {
  Floats lo, hi, sure_lo, sure_hi;
};
template <int D>
Edges EdgesAt(const BoxRow<D>& row, int axis, std::uint32_t at) {
  const Floats lo = hn::LoadU(Lanes(), row.lo[axis] + at),
               hi = hn::LoadU(Lanes(), row.hi[axis] + at);
  return {lo, hi, lo, hi};
}
template <int D>
Edges EdgesAt(const PackedRow<D>& row, int axis, std::uint32_t at) {
  const hn::Rebind<std::uint8_t, Lanes> bytes;
  const hn::Rebind<std::int32_t, Lanes> words;
  const auto origin = hn::Set(Lanes(), row.origin(axis)), step = hn::Set(Lanes(), row.step(axis));
  const auto edge = [&](const std::uint8_t* codes) {
    const auto code = hn::ConvertTo(Lanes(), hn::PromoteTo(words, hn::LoadU(bytes, codes + at)));
    return hn::MulAdd(code, step, origin);
  };
  const Floats lo = edge(row.lo(axis)), hi = edge(row.hi(axis));
  const Edges edges{lo, hi, hn::Add(lo, step), hn::Sub(hi, step)};
  if (HWY_LIKELY(!row.is_endless())) return edges;
  const auto far = hn::Inf(Lanes()), near = hn::Neg(far);
  const auto least = hn::Set(Lanes(), row.edge(axis, row.kLeast));
  const auto most = hn::Set(Lanes(), row.edge(axis, row.kMost));
  const auto below = hn::Lt(lo, least), above = hn::Lt(most, hi);
  return {hn::IfThenElse(below, near, lo), hn::IfThenElse(above, far, hi),
          hn::IfThenElse(below, far, edges.sure_lo), hn::IfThenElse(above, near, edges.sure_hi)};
}

template <class Row, int D = Row::kDimension>
BlockBits Reached(const Row& row, const FloatBox<D>& asked) {
  const auto set = [](float x) { return hn::Set(Lanes(), x); };
  BlockBits bits;
  bits.maybe = BitsOf([&](std::uint32_t at) {
    auto all = hn::FirstN(Lanes(), kRowBlock), sure = all;
    for (int i = 0; i < D; ++i) {
      const Edges edges = EdgesAt(row, i, at);
      all = hn::And(
          all, hn::And(hn::Le(edges.lo, set(asked.hi[i])), hn::Le(set(asked.lo[i]), edges.hi)));
      sure = hn::And(sure, hn::And(hn::Le(edges.sure_lo, set(asked.sure_hi[i])),
                                   hn::Le(set(asked.sure_lo[i]), edges.sure_hi)));
    }
    bits.surely |= MaskBits(sure) << at;
    return all;
  });
  return bits;
}

// How far each box is from the centre, at least and at most, in squares.
template <class Row, int D = Row::kDimension>
BlockBits InBall(const Row& row, const FloatBall<D>& ball, BlockEntries* entries) {
  const auto set = [](float x) { return hn::Set(Lanes(), x); };
  const auto less = set(1 - 0x1p-20f), more = set(1 + 0x1p-20f), none = hn::Zero(Lanes());
  const auto square = set(ball.square);
  BlockBits bits;
  bits.maybe = BitsOf([&](std::uint32_t at) {
    auto least = none, most = none;
    for (int i = 0; i < D; ++i) {
      const auto center = set(ball.center[i]), slack = set(ball.slack[i]);
      const Edges edges = EdgesAt(row, i, at);
      const auto add = [&](auto& squares, auto beside) {
        beside = hn::Max(beside, none);
        squares = hn::Add(squares, hn::Mul(beside, beside));
      };
      const auto gap = [&](auto lo, auto hi) {
        return hn::Max(hn::Sub(lo, center), hn::Sub(center, hi));
      };
      add(least, hn::Sub(hn::Mul(gap(edges.lo, edges.hi), less), slack));
      if (entries == nullptr)
        add(most, hn::Add(hn::Mul(gap(edges.sure_lo, edges.sure_hi), more), slack));
    }
    if (entries != nullptr)
      hn::StoreU(hn::Mul(least, less), Lanes(), entries->data() + at);
    else
      bits.surely |= MaskBits(hn::Le(most, hn::Mul(square, less))) << at;
    return hn::Le(least, hn::Mul(square, more));
  });
  return bits;
}

// The slab method (geometry/ray.hpp), each span once widened and once narrowed by what float may
// have lost.
template <class Row, int D = Row::kDimension>
BlockBits Met(const Row& row, const FloatRay<D>& ray, float limit, BlockEntries* entries) {
  const auto set = [](float x) { return hn::Set(Lanes(), x); };
  const auto less = set(1 - 0x1p-21f), more = set(1 + 0x1p-21f);
  BlockBits bits;
  bits.maybe = BitsOf([&](std::uint32_t at) {
    auto from = set(0), to = set(limit), sure_from = from, sure_to = hn::Mul(to, less);
    auto all = hn::FirstN(Lanes(), kRowBlock), sure = all;
    for (int i = 0; i < D; ++i) {
      Edges edges = EdgesAt(row, i, at);
      if (ray.stands[i]) {
        const auto above = set(ray.above[i]), below = set(ray.below[i]);
        all = hn::And(all, hn::And(hn::Le(edges.lo, above), hn::Le(below, edges.hi)));
        sure = hn::And(sure, hn::And(hn::Lt(edges.sure_lo, below), hn::Lt(above, edges.sure_hi)));
        continue;
      }
      if (ray.inverse[i] < 0) {
        std::swap(edges.lo, edges.hi);
        std::swap(edges.sure_lo, edges.sure_hi);
      }
      const auto inverse = set(ray.inverse[i]), origin = set(ray.origin[i]);
      const auto slack = set(ray.slack[i]);
      const auto when = [&](auto edge) { return hn::Mul(hn::Sub(edge, origin), inverse); };
      const auto last = hn::Add(when(edges.hi), slack);
      from = hn::Max(from, hn::Mul(hn::Sub(when(edges.lo), slack), less));
      to = hn::Min(to, hn::Max(hn::Mul(last, less), hn::Mul(last, more)));
      if (entries != nullptr) continue;
      const auto late = hn::Add(when(edges.sure_lo), slack);
      const auto soon = hn::Sub(when(edges.sure_hi), slack);
      sure_from = hn::Max(sure_from, hn::Mul(late, more));
      sure_to = hn::Min(sure_to, hn::Min(hn::Mul(soon, less), hn::Mul(soon, more)));
    }
    if (entries != nullptr) {
      hn::StoreU(from, Lanes(), entries->data() + at);
    } else {
      sure = hn::And(sure, hn::And(hn::Le(sure_from, sure_to), hn::Lt(sure_from, set(1e30f))));
      bits.surely |= MaskBits(sure) << at;
    }
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
template <class Row, int D>
BlockBits reached_in_block(const Row& row, const FloatBox<D>& asked) {
  static const auto best = LANTERN_BEST(Reached<Row>);
  return best(row, asked);
}
template <class Row, int D>
BlockBits reached_in_block(const Row& row, const FloatBall<D>& ball, BlockEntries* entries) {
  static const auto best = LANTERN_BEST(InBall<Row>);
  return best(row, ball, entries);
}
template <class Row, int D>
BlockBits met_in_block(const Row& row, const FloatRay<D>& ray, float limit, BlockEntries* entries) {
  static const auto best = LANTERN_BEST(Met<Row>);
  return best(row, ray, limit, entries);
}

template ScanDone scan_runs(const ScanTask<2>&, const ScanRoom&, std::size_t, std::size_t);
template ScanDone scan_runs(const ScanTask<3>&, const ScanRoom&, std::size_t, std::size_t);
#define LANTERN_IN_BLOCK(ROW, D)                                                          \
  template BlockBits reached_in_block(const ROW<D>&, const FloatBox<D>&);                 \
  template BlockBits reached_in_block(const ROW<D>&, const FloatBall<D>&, BlockEntries*); \
  template BlockBits met_in_block(const ROW<D>&, const FloatRay<D>&, float, BlockEntries*);
LANTERN_IN_BLOCK(BoxRow, 2)
LANTERN_IN_BLOCK(BoxRow, 3)
LANTERN_IN_BLOCK(PackedRow, 2)
LANTERN_IN_BLOCK(PackedRow, 3)

}  // namespace lantern::spatial
#endif
