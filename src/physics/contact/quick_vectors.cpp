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
    Vector way;
    const Vector old = Begin(p.pn, sweep, way), speed = Along(group_.normal, Slip<0>(p));
    const Vector pushed = Along(group_.normal, Slip<QuickBody<D>::kPushed>(p));
    const Vector pn = hn::Max(old + (Get(p.bias, lane_) - speed) * mass, Zero());
    const Vector old_push = Get(p.push, lane_);
    const Vector push =
        hn::Max(old_push + (Get(p.wanted_push, lane_) - pushed) * mass, hn::Neg(pn));
    End(p.pn, pn, pn - old, way, mass, largest, squared);
    Put(push, p.push, lane_);
    Apply<0>(p, Times(group_.normal, pn - old));
    Apply<QuickBody<D>::kPushed>(p, Times(group_.normal, push - old_push));
  }

  // What sticks is not pushed along, either. Counts the rows of points that press.
  HWY_INLINE void SolveFriction(QuickPoint<D>& p, QuickSweep& sweep, Vector& largest,
                                Vector& squared) {
    Vector old[D - 1], way[D - 1], wanted[D - 1], hold[D - 1];
    const Vector mass = Get(p.tangent_mass, lane_);
    const Vector most = Get(group_.friction, lane_) * Get(p.pn.now, lane_);
    Vector length = Zero();
    Mask presses = hn::Gt(most, Zero());
    const Arrow slip = Slip<0>(p), pushed = Slip<QuickBody<D>::kPushed>(p);
    for (std::size_t k = 0; k < D - 1; ++k) {
      old[k] = Begin(p.pt[k], sweep, way[k]);
      presses = hn::Or(presses, hn::Ne(old[k], Zero()));
      wanted[k] = old[k] - Along(group_.across[k], slip) * mass;
      hold[k] = hn::Neg(Along(group_.across[k], pushed) * mass);
      length = D == 2 ? hn::Abs(wanted[k]) : length + wanted[k] * wanted[k];
    }
    if constexpr (D == 3) length = hn::Sqrt(length);
    sweep.friction_rows += hn::CountTrue(Lanes(), presses) * (D - 1);
    const Mask sticks = hn::And(hn::Le(length, most), presses);
    Arrow by{}, by_push{};
    for (std::size_t k = 0; k < D - 1; ++k) {
      const Vector kept =
          D == 2 ? hn::Max(hn::Min(wanted[k], most), hn::Neg(most))
                 : hn::IfThenElse(hn::Le(length, most), wanted[k], wanted[k] * (most / length));
      End(p.pt[k], kept, kept - old[k], way[k], mass, largest, squared);
      AddTo(by, group_.across[k], kept - old[k]);
      AddTo(by_push, group_.across[k], hn::IfThenElseZero(sticks, hold[k]));
    }
    Apply<0>(p, by);
    Apply<QuickBody<D>::kPushed>(p, by_push);
  }

  HWY_INLINE void AddWork(const QuickPoint<D>& p, Vector& before, Vector& after,
                          Vector& wanted) const {
    wanted = wanted + Get(p.pn.now, lane_) * Get(p.bias, lane_);
    Arrow impulse = Times(group_.normal, Get(p.pn.now, lane_));
    for (std::size_t k = 0; k < D - 1; ++k)
      AddTo(impulse, group_.across[k], Get(p.pt[k].now, lane_));
    const Arrow slip = Slip<0>(p), pushed = Slip<QuickBody<D>::kPushed>(p);
    for (std::size_t i = 0; i < D; ++i) {
      before = before + impulse.at[i] * slip.at[i];
      after = after + impulse.at[i] * pushed.at[i];
    }
  }

  HWY_INLINE void Store(QuickBody<D>* bodies) {
    a_.Store(bodies, group_.a.data() + lane_);
    b_.Store(bodies, group_.b.data() + lane_);
  }

 private:
  struct Arrow {  // of each contact one
    Vector at[D];
  };
  HWY_INLINE Arrow Times(const std::array<Four, D>& direction, Vector size) const {
    Arrow product;
    for (std::size_t i = 0; i < D; ++i) product.at[i] = Get(direction[i], lane_) * size;
    return product;
  }
  HWY_INLINE void AddTo(Arrow& sum, const std::array<Four, D>& direction, Vector size) const {
    for (std::size_t i = 0; i < D; ++i) sum.at[i] = sum.at[i] + Get(direction[i], lane_) * size;
  }

  HWY_INLINE Vector Begin(const QuickImpulse& impulse, const QuickSweep& sweep, Vector& way) const {
    const Vector now = Get(impulse.now, lane_);
    way = sweep.goes_on ? hn::Set(Lanes(), sweep.beta) * Get(impulse.way, lane_) : Zero();
    return sweep.goes_on ? now + way : now;
  }
  HWY_INLINE void End(QuickImpulse& impulse, Vector now, Vector moved, Vector way, Vector mass,
                      Vector& largest, Vector& squared) const {
    Put(now, impulse.now, lane_);
    Put(way + moved, impulse.way, lane_);
    largest = hn::Max(largest, hn::Abs(moved) / hn::Max(mass, hn::Set(Lanes(), 1e-300)));
    squared = squared + moved * moved;
  }

  HWY_INLINE Vector Along(const std::array<Four, D>& direction, const Arrow& v) const {
    Vector sum = v.at[0] * Get(direction[0], lane_);
    for (std::size_t i = 1; i < D; ++i) sum = sum + v.at[i] * Get(direction[i], lane_);
    return sum;
  }

  // The velocity of a point of a body.
  HWY_INLINE Arrow VelocityAt(const Vector* motion, const std::array<Four, D>& arm) const {
    const Vector* spin = motion + D;
    const Vector x = Get(arm[0], lane_), y = Get(arm[1], lane_);
    if constexpr (D == 2) {
      return {{motion[0] - spin[0] * y, motion[1] + spin[0] * x}};
    } else {
      const Vector z = Get(arm[2], lane_);
      return {{motion[0] + (spin[1] * z - spin[2] * y), motion[1] + (spin[2] * x - spin[0] * z),
               motion[2] + (spin[0] * y - spin[1] * x)}};
    }
  }
  template <std::size_t kFrom>
  HWY_INLINE Arrow Slip(const QuickPoint<D>& p) const {
    const Arrow a = VelocityAt(a_.at + kFrom, p.arm_a), b = VelocityAt(b_.at + kFrom, p.arm_b);
    Arrow slip;
    for (std::size_t i = 0; i < D; ++i) slip.at[i] = b.at[i] - a.at[i];
    return slip;
  }

  // How an impulse at a point changes the motion of a body.
  HWY_INLINE void Move(Vector* motion, const std::array<Four, D>& arm, const Four& inverse_mass,
                       const std::array<Four, QuickBody<D>::kInertia>& inertia,
                       const Arrow& by) const {
    const auto inverse = [&](std::size_t i) HWY_ATTR { return Get(inertia[i], lane_); };
    for (std::size_t i = 0; i < D; ++i) motion[i] = motion[i] + by.at[i] * Get(inverse_mass, lane_);
    Vector* spin = motion + D;
    const Vector x = Get(arm[0], lane_), y = Get(arm[1], lane_);
    const Vector turn = x * by.at[1] - y * by.at[0];
    if constexpr (D == 2) {
      spin[0] = spin[0] + inverse(0) * turn;
    } else {
      const Vector z = Get(arm[2], lane_);
      const Vector turn_x = y * by.at[2] - z * by.at[1], turn_y = z * by.at[0] - x * by.at[2];
      spin[0] = spin[0] + (inverse(0) * turn_x + inverse(3) * turn_y + inverse(4) * turn);
      spin[1] = spin[1] + (inverse(3) * turn_x + inverse(1) * turn_y + inverse(5) * turn);
      spin[2] = spin[2] + (inverse(4) * turn_x + inverse(5) * turn_y + inverse(2) * turn);
    }
  }
  // An impulse upon b, and the opposite one upon a.
  template <std::size_t kFrom>
  HWY_INLINE void Apply(const QuickPoint<D>& p, const Arrow& by) {
    Arrow back;
    for (std::size_t i = 0; i < D; ++i) back.at[i] = hn::Neg(by.at[i]);
    Move(a_.at + kFrom, p.arm_a, group_.inverse_mass_a, group_.inertia_a, back);
    Move(b_.at + kFrom, p.arm_b, group_.inverse_mass_b, group_.inertia_b, by);
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
