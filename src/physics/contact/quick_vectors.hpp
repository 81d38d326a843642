// Contacts of a large island, four by four, as vectors sweep over them: what a sweep reads lies in
// one piece, and nothing else. The four of a group share no body that can be moved, so each is
// solved as if it were alone.
//
// One sweep solves two problems, which know nothing of each other, so that a processor works at
// both at a time: impulses that stop bodies, and pushes that move them out of each other (split
// impulses).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/manifold.hpp"

namespace lantern::physics {

inline constexpr std::size_t kQuickLanes = 4;
struct alignas(kQuickLanes * sizeof(double)) Four {  // of each contact in the group one number
  std::array<double, kQuickLanes> lane;
  double sum() const { return (lane[0] + lane[1]) + (lane[2] + lane[3]); }
};

// A body's velocity and spin, twice: those that it has, and those that push it out of others; in
// 2D each with one number more, so that a vector holds it.
template <int D>
struct QuickBody {
  static constexpr std::size_t kSpin = D == 2 ? 1 : 3;      // numbers of a spin,
  static constexpr std::size_t kInertia = D == 2 ? 1 : 6;   // of an inertia: xx yy zz xy xz yz
  static constexpr std::size_t kPushed = D == 2 ? 4 : 6;    // where what pushes begins
  static constexpr std::size_t kNumbers = D == 2 ? 8 : 12;  // in all
  alignas(Four) std::array<double, kNumbers> motion{};
};

struct QuickImpulse {
  Four now;
  Four way;  // by the last sweep, and by going on before it
};
template <int D>
struct QuickPoint {
  std::array<Four, D> arm_a, arm_b;
  Four normal_mass, tangent_mass;  // effective; 0 where there is no such row
  Four bias;                       // wanted speed of parting
  Four wanted_push, push;
  QuickImpulse pn;
  std::array<QuickImpulse, D - 1> pt;
};
template <int D>
struct QuickGroup {
  static constexpr std::size_t kMostPoints = Manifold<D>::kMostPoints;

  QuickGroup() {}  // NOLINT: what nobody reads is not cleared, it is much

  std::array<std::uint32_t, kQuickLanes> a, b;  // bodies
  std::size_t points;                           // of the contact that has most
  bool rubs;                                    // any of them has friction
  Four friction, inverse_mass_a, inverse_mass_b;
  std::array<Four, QuickBody<D>::kInertia> inertia_a, inertia_b;  // inverse
  std::array<Four, D> normal;
  std::array<std::array<Four, D>, D - 1> across;
  std::array<QuickPoint<D>, kMostPoints> room;
};

// What a sweep is told, and what it finds.
struct QuickSweep {
  // Whether impulses, before the sweep, go on as they have moved, and by how much of that.
  bool goes_on = false;
  double beta = 0;
  Four largest{};  // change of a relative speed
  Four squared{};  // change of impulses
  std::uint64_t friction_rows = 0;
};
// Work of all impulses, in proportion: by the relative velocities before them, after them, and
// those that are wanted.
struct QuickWork {
  Four before{}, after{}, wanted{};
};

template <int D>
struct QuickVectors {
  // Solves each row once, from the first group to the last.
  void (*sweep)(std::span<QuickGroup<D>> groups, QuickBody<D>* bodies, QuickSweep& sweep);
  // Bodies have their motion before impulses, and after them where otherwise they are pushed.
  void (*work)(std::span<const QuickGroup<D>> groups, const QuickBody<D>* bodies, QuickWork& work);
};
// One for each kind of vectors that this processor has, the best first. All find the same bits.
template <int D>
const std::vector<QuickVectors<D>>& quick_vectors();

}  // namespace lantern::physics
