// Compiled once for each kind of processor, and chosen when it runs: by Highway, which includes
// this file again and again. A vector holds two contacts of a group, or all four; no sum goes from
// one to another, so that all processors find the same bits.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/contact/quick_vectors.cpp"
#include "physics/contact/quick_vectors.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "spatial/vector_targets.hpp"

HWY_BEFORE_NAMESPACE();
namespace lantern::physics::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, kQuickLanes>;
using Vector = hn::Vec<Lanes>;
using Mask = hn::Mask<Lanes>;
constexpr std::size_t kWidth = hn::MaxLanes(Lanes());

HWY_INLINE Vector Get(const Four& from, std::size_t lane) {
  return hn::Load(Lanes(), from.lane.data() + lane);
}
HWY_INLINE void Put(Vector value, Four& to, std::size_t lane) {
  hn::Store(value, Lanes(), to.lane.data() + lane);
}
HWY_INLINE Vector Zero() { return hn::Zero(Lanes()); }

// Turns a square of numbers over: lines become columns.
HWY_INLINE void Transpose([[maybe_unused]] Vector* square) {
#if HWY_TARGET != HWY_SCALAR
  const Vector even = hn::InterleaveLower(Lanes(), square[0], square[1]);
  const Vector odd = hn::InterleaveUpper(Lanes(), square[0], square[1]);
  if constexpr (kWidth == 2) {
    square[0] = even;
    square[1] = odd;
  } else {
    const Vector next_even = hn::InterleaveLower(Lanes(), square[2], square[3]);
    const Vector next_odd = hn::InterleaveUpper(Lanes(), square[2], square[3]);
    square[0] = hn::ConcatLowerLower(Lanes(), next_even, even);
    square[1] = hn::ConcatLowerLower(Lanes(), next_odd, odd);
    square[2] = hn::ConcatUpperUpper(Lanes(), next_even, even);
    square[3] = hn::ConcatUpperUpper(Lanes(), next_odd, odd);
  }
#endif
}

// The motions of one body of each contact: each number of all of them in one vector.
template <int D>
struct Motions {
  Vector at[QuickBody<D>::kNumbers];

  HWY_INLINE void Load(const QuickBody<D>* bodies, const std::uint32_t* places) {
    for (std::size_t i = 0; i < QuickBody<D>::kNumbers; i += kWidth) {
      for (std::size_t k = 0; k < kWidth; ++k)
        at[i + k] = hn::Load(Lanes(), bodies[places[k]].motion.data() + i);
      Transpose(at + i);
    }
  }
  HWY_INLINE void Store(QuickBody<D>* bodies, const std::uint32_t* places) {
    for (std::size_t i = 0; i < QuickBody<D>::kNumbers; i += kWidth) {
      Transpose(at + i);
      for (std::size_t k = 0; k < kWidth; ++k)
        hn::Store(at[i + k], Lanes(), bodies[places[k]].motion.data() + i);
    }
  }
};

// Contacts of a group, from one lane on.
template <int D>
class Contacts {
 public:
  HWY_INLINE Contacts(const QuickGroup<D>& group, std::size_t lane, const QuickBody<D>* bodies)
      : group_(group), lane_(lane) {
    a_.Load(bodies, group.a.data() + lane);
    b_.Load(bodies, group.b.data() + lane);
  }

  // With impulses that have gone on along their way.
  HWY_INLINE void SolveNormal(QuickPoint<D>& p, const QuickSweep& sweep, Vector& largest,
                              Vector& squared) {
    const Vector mass = Get(p.normal_mass, lane_);
    const Vector old = Begin(p.pn, sweep), speed = Speed<0>(group_.normal, p.normal);
    const Vector pushed = Speed<QuickBody<D>::kPushed>(group_.normal, p.normal);
    const Vector pn = hn::Max(old + (Get(p.bias, lane_) - speed) * mass, Zero());
    const Vector old_push = Get(p.push, lane_);
    const Vector push =
        hn::Max(old_push + (Get(p.wanted_push, lane_) - pushed) * mass, hn::Neg(pn));
    End(p.pn, pn, pn - old, mass, largest, squared);
    Put(push, p.push, lane_);
    Apply<0>(group_.normal, p.normal, pn - old);
    Apply<QuickBody<D>::kPushed>(group_.normal, p.normal, push - old_push);
  }

  // What sticks is not pushed along, either. Counts the rows of points that press.
  HWY_INLINE void SolveFriction(QuickPoint<D>& p, QuickSweep& sweep, Vector& largest,
                                Vector& squared) {
    Vector old[D - 1], wanted[D - 1], hold[D - 1];
    const Vector mass = Get(p.tangent_mass, lane_);
    const Vector most = Get(group_.friction, lane_) * Get(p.pn.now, lane_);
    Vector length = Zero();
    Mask presses = hn::Gt(most, Zero());
    for (std::size_t k = 0; k < D - 1; ++k) {
      old[k] = Begin(p.pt[k], sweep);
      presses = hn::Or(presses, hn::Ne(old[k], Zero()));
      wanted[k] = old[k] - Speed<0>(group_.across[k], p.tangent[k]) * mass;
      hold[k] = hn::Neg(Speed<QuickBody<D>::kPushed>(group_.across[k], p.tangent[k]) * mass);
      length = D == 2 ? hn::Abs(wanted[k]) : length + wanted[k] * wanted[k];
    }
    if constexpr (D == 3) length = hn::Sqrt(length);
    sweep.friction_rows += hn::CountTrue(Lanes(), presses) * (D - 1);
    const Mask sticks = hn::And(hn::Le(length, most), presses);
    for (std::size_t k = 0; k < D - 1; ++k) {
      const Vector kept =
          D == 2 ? hn::Max(hn::Min(wanted[k], most), hn::Neg(most))
                 : hn::IfThenElse(hn::Le(length, most), wanted[k], wanted[k] * (most / length));
      End(p.pt[k], kept, kept - old[k], mass, largest, squared);
      Apply<0>(group_.across[k], p.tangent[k], kept - old[k]);
      Apply<QuickBody<D>::kPushed>(group_.across[k], p.tangent[k],
                                   hn::IfThenElseZero(sticks, hold[k]));
    }
  }

  HWY_INLINE void AddWork(const QuickPoint<D>& p, Vector& before, Vector& after,
                          Vector& wanted) const {
    const auto add = [&](const Four& impulse, const std::array<Four, D>& direction,
                         const QuickRow<D>& row) HWY_ATTR {
      const Vector size = Get(impulse, lane_);
      before = before + size * Speed<0>(direction, row);
      after = after + size * Speed<QuickBody<D>::kPushed>(direction, row);
    };
    wanted = wanted + Get(p.pn.now, lane_) * Get(p.bias, lane_);
    add(p.pn.now, group_.normal, p.normal);
    for (std::size_t k = 0; k < D - 1; ++k) add(p.pt[k].now, group_.across[k], p.tangent[k]);
  }

  HWY_INLINE void Store(QuickBody<D>* bodies) {
    a_.Store(bodies, group_.a.data() + lane_);
    b_.Store(bodies, group_.b.data() + lane_);
  }

 private:
  HWY_INLINE Vector Begin(QuickImpulse& impulse, const QuickSweep& sweep) const {
    if (!sweep.goes_on) {
      Put(Zero(), impulse.way, lane_);
      return Get(impulse.now, lane_);
    }
    const Vector gone =
        hn::Set(Lanes(), sweep.beta) * (Get(impulse.way, lane_) + Get(impulse.moved, lane_));
    Put(gone, impulse.way, lane_);
    return Get(impulse.now, lane_) + gone;
  }
  HWY_INLINE void End(QuickImpulse& impulse, Vector now, Vector moved, Vector mass, Vector& largest,
                      Vector& squared) const {
    Put(now, impulse.now, lane_);
    Put(moved, impulse.moved, lane_);
    largest = hn::Max(largest, hn::Abs(moved) / hn::Max(mass, hn::Set(Lanes(), 1e-300)));
    squared = squared + moved * moved;
  }

  template <std::size_t kFrom>
  HWY_INLINE Vector Speed(const std::array<Four, D>& direction, const QuickRow<D>& row) const {
    Vector along = (b_.at[kFrom] - a_.at[kFrom]) * Get(direction[0], lane_);
    for (std::size_t i = 1; i < D; ++i)
      along = along + (b_.at[kFrom + i] - a_.at[kFrom + i]) * Get(direction[i], lane_);
    Vector turning_b = Get(row.turn_b[0], lane_) * b_.at[kFrom + D];
    Vector turning_a = Get(row.turn_a[0], lane_) * a_.at[kFrom + D];
    for (std::size_t i = 1; i < QuickBody<D>::kSpin; ++i) {
      turning_b = turning_b + Get(row.turn_b[i], lane_) * b_.at[kFrom + D + i];
      turning_a = turning_a + Get(row.turn_a[i], lane_) * a_.at[kFrom + D + i];
    }
    return along + (turning_b - turning_a);
  }

  template <std::size_t kFrom>
  HWY_INLINE void Apply(const std::array<Four, D>& direction, const QuickRow<D>& row,
                        Vector impulse) {
    const Vector share_a = impulse * Get(group_.inverse_mass_a, lane_);
    const Vector share_b = impulse * Get(group_.inverse_mass_b, lane_);
    for (std::size_t i = 0; i < D; ++i) {
      a_.at[kFrom + i] = a_.at[kFrom + i] - Get(direction[i], lane_) * share_a;
      b_.at[kFrom + i] = b_.at[kFrom + i] + Get(direction[i], lane_) * share_b;
    }
    for (std::size_t i = 0; i < QuickBody<D>::kSpin; ++i) {
      a_.at[kFrom + D + i] = a_.at[kFrom + D + i] - Get(row.gained_a[i], lane_) * impulse;
      b_.at[kFrom + D + i] = b_.at[kFrom + D + i] + Get(row.gained_b[i], lane_) * impulse;
    }
  }

  const QuickGroup<D>& group_;
  std::size_t lane_;
  Motions<D> a_, b_;
};

template <int D>
void Sweep(std::span<QuickGroup<D>> groups, QuickBody<D>* bodies, QuickSweep& sweep) {
  for (QuickGroup<D>& group : groups)
    for (std::size_t lane = 0; lane < kQuickLanes; lane += kWidth) {
      Contacts<D> contacts(group, lane, bodies);
      Vector largest = Get(sweep.largest, lane), squared = Get(sweep.squared, lane);
      for (std::size_t i = 0; i < group.points; ++i)
        contacts.SolveNormal(group.room[i], sweep, largest, squared);
      if (group.rubs)
        for (std::size_t i = 0; i < group.points; ++i)
          contacts.SolveFriction(group.room[i], sweep, largest, squared);
      contacts.Store(bodies);
      Put(largest, sweep.largest, lane);
      Put(squared, sweep.squared, lane);
    }
}

template <int D>
void Work(std::span<const QuickGroup<D>> groups, const QuickBody<D>* bodies, QuickWork& work) {
  for (const QuickGroup<D>& group : groups)
    for (std::size_t lane = 0; lane < kQuickLanes; lane += kWidth) {
      const Contacts<D> contacts(group, lane, bodies);
      Vector before = Get(work.before, lane), after = Get(work.after, lane);
      Vector wanted = Get(work.wanted, lane);
      for (std::size_t i = 0; i < group.points; ++i)
        contacts.AddWork(group.room[i], before, after, wanted);
      Put(before, work.before, lane);
      Put(after, work.after, lane);
      Put(wanted, work.wanted, lane);
    }
}

}  // namespace lantern::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lantern::physics {

template <int D>
const std::vector<QuickVectors<D>>& quick_vectors() {
  static const std::vector<QuickVectors<D>> all = [] {
    const auto sweeps = LANTERN_ALL(Sweep<D>);
    const auto works = LANTERN_ALL(Work<D>);
    std::vector<QuickVectors<D>> made;
    for (std::size_t i = 0; i < sweeps.size(); ++i) made.push_back({sweeps[i], works[i]});
    return made;
  }();
  return all;
}
template const std::vector<QuickVectors<2>>& quick_vectors();
template const std::vector<QuickVectors<3>>& quick_vectors();

}  // namespace lantern::physics
#endif
