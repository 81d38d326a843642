// A step cut into sub-steps. Each one is a whole small step, with few sweeps over the constraints,
// whose impulses begin where the sub-step before has left them. For the same work this mends far
// more than many sweeps in one large step (Macklin et al., "Small Steps in Physics Simulation",
// 2019; Catto, "Solver2D", 2024: soft step).
//
//   v += kick            forces
//   v += J p / m         impulses: begin with the old ones, then sweep until they hold
//   u  = v + drift / h   mean velocity, in which penetration is pushed out
//   x += h u             v knows nothing of that: no energy comes from it
//
// The integrator's drift says how far the mean velocity of a sub-step is from the new one: for
// velocity Verlet -h kick / 2. Impulses of constraints act through the sub-step just as forces do,
// so they lag by the same share; a block at rest then has no drift at all, and friction stops a
// block where the closed form says.
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/stop.hpp"
#include "physics/direct_solve.hpp"
#include "physics/free_rotation.hpp"
#include "physics/island.hpp"

namespace lantern {
namespace {

// Sweeps in a sub-step of the soft method, if they do not end earlier: more for small islands.
constexpr int kFewestSweeps = 24, kMostSweeps = 256;
constexpr int kMostSolved = 2048;    // pairs times sweeps
constexpr double kGoodGuess = 0.05;  // changes by less than this part of the largest impulse
constexpr double kPresses = 0.01;    // of the largest impulse

// Sweeps end at a change of so small a part of the largest impulse. In a stack of n boxes the last
// change stands for an error of (2n / pi)^2 times as much; the motion that it leaves is a blow to
// the next direct solve, which would push as much the other way, and so on.
constexpr double kSweepTolerance = 1e-12;
constexpr double kSettledTolerance = 1e-7;  // once all rows were solved at once
constexpr double kCarriedTolerance = 1e-3;  // of the largest push out of penetration

constexpr double kBounceSteps = 2;     // slower than gravity makes in so many sub-steps: no bounce
constexpr double kTouchingWay = 1e-4;  // of the way that forces make in a sub-step: so near touches

// Which part of the new velocity's change the mean velocity lags behind: 0 for semi-implicit
// Euler, 1/2 for velocity Verlet.
template <int D>
double lag_of(const Increment<D>& increment, double h) {
  const double kick = glm::dot(increment.kick, increment.kick);
  if (kick == 0) return 0;
  return std::clamp(-glm::dot(increment.drift, increment.kick) / (h * kick), 0.0, 1.0);
}

// Impulses of what presses go with time, those of a blow do not. A blow in the shortest of
// sub-steps must not be taken for a force, so a guess is only ever made smaller.
double rescaled(double seconds, double old) { return std::min(seconds / old, 1.0); }

template <int D>
void look_for_contacts(Island<D>& island, double scale_to, WorldWork& work) {
  for (IslandPair<D>& pair : island.pairs) {
    ContactRows<D>& rows = pair.rows;
    stop_if_asked();
    rows.count = 0;
    if (!pair.pressed) continue;
    const Body<D>& a = island.bodies[rows.a];
    const Body<D>& b = island.bodies[rows.b];
    ++work.narrow_tests;
    const auto manifold = collide(Placed<D>{a.shape, a.position, a.orientation},
                                  Placed<D>{b.shape, b.position, b.orientation}, pair.reach);
    if (!manifold) continue;
    const double scale = pair.seconds > 0 ? rescaled(scale_to, pair.seconds) : 0;
    set_points(rows, *manifold, a, b, pair.remembered ? &pair.memory : nullptr, scale);
    renew_record(pair.record, *manifold);
    work.contact_points += static_cast<std::uint64_t>(rows.count);
  }
}

template <int D>
struct SubStep {
  Island<D>& island;
  const WorldConfig<D>& config;
  double h;
  WorldWork& work;
  DirectSolve<D>& direct;
  bool settled = false;  // by the direct solve
  double pressing = 0;   // the largest impulse

  bool impulse_method() const { return config.contacts == ContactMethod::impulse; }
  int most_sweeps() const {
    if (impulse_method()) return config.iterations;
    const auto rows = static_cast<int>(island.pairs.size() + island.joints.size());
    return std::clamp(kMostSolved / rows, kFewestSweeps, kMostSweeps);
  }

  template <class F>
  void each_pair(F&& f) {
    for (IslandPair<D>& pair : island.pairs) {
      stop_if_asked();
      if (pair.rows.count > 0) f(pair.rows, island.movers[pair.rows.a], island.movers[pair.rows.b]);
    }
  }
  // Every other sweep goes backwards, so that neither end of a stack, nor side of a box, is
  // preferred.
  template <class F>
  void each_pair_in_turn(int turn, F&& f) {
    for (std::size_t i = 0; i < island.pairs.size(); ++i) {
      stop_if_asked();
      ContactRows<D>& rows = island.pairs[turn % 2 == 0 ? i : island.pairs.size() - 1 - i].rows;
      if (rows.count > 0) f(rows, island.movers[rows.a], island.movers[rows.b]);
    }
  }
  template <class F>
  void each_joint(F&& f) {
    for (JointRows<D>& rows : island.joints) {
      stop_if_asked();
      f(rows, island.movers[rows.a], island.movers[rows.b]);
    }
  }

  void refresh_rows() {
    island.movers.clear();
    for (const Body<D>& body : island.bodies) island.movers.push_back(mover_of(body));
    const auto& kicks = island.increments;
    each_pair([&](ContactRows<D>& rows, Mover<D>& a, Mover<D>& b) {
      const Vec<D> kick_a = kicks[rows.a].kick, kick_b = kicks[rows.b].kick;
      const double way = h * std::max(glm::length(kick_a), glm::length(kick_b));
      refresh(rows, island.bodies[rows.a], island.bodies[rows.b], a, b,
              kBounceSteps * glm::length(kick_b - kick_a), kTouchingWay * way);
    });
    each_joint([&](JointRows<D>& rows, Mover<D>& a, Mover<D>& b) {
      refresh(rows, island.bodies[rows.a], island.bodies[rows.b], a, b);
    });
  }

  void apply_forces() {
    for (std::size_t i = 0; i < island.movers.size(); ++i) {
      Mover<D>& mover = island.movers[i];
      mover.velocity += island.increments[i].kick;
      mover.spin += mover.inverse_inertia * island.increments[i].twist;
    }
    island.kicked.clear();
    for (const Mover<D>& mover : island.movers) island.kicked.push_back(mover.velocity);
  }

  void count(const Sweep& sweep) {
    work.constraint_rows += sweep.rows;
    work.friction_rows += sweep.friction_rows;
  }

  // All at once after 2, 4, 8 ... sweeps, never last. Where something slips, a guess that is good
  // already is left alone: friction that lags behind would only spoil it. Of four corners of a face
  // three are enough, so that one may press next to nothing and slip: that does not count.
  bool wants_direct(int done, const Sweep& sweep) {
    if (impulse_method() || done == 0 || done + 1 >= most_sweeps()) return false;
    if (!std::has_single_bit(static_cast<unsigned>(done + 1))) return false;
    bool slips = false;
    each_pair([&](const ContactRows<D>& rows, auto&, auto&) {
      for (const ContactPoint<D>& p : rows.points())
        slips |= rows.friction > 0 && p.pn > kPresses * sweep.largest && !p.sticks;
    });
    return !slips || sweep.change > kGoodGuess * sweep.largest;
  }

  void solve_velocities() {
    each_joint([](auto& rows, auto& a, auto& b) { warm_start(rows, a, b); });
    each_pair([](auto& rows, auto& a, auto& b) { warm_start(rows, a, b); });
    settled = false;
    for (int i = 0; i < most_sweeps(); ++i) {
      Sweep sweep;
      each_joint([&](auto& rows, auto& a, auto& b) { sweep_velocities(rows, a, b, sweep); });
      each_pair_in_turn(
          i, [&](auto& rows, auto& a, auto& b) { sweep_velocities(rows, a, b, h, sweep); });
      count(sweep);
      pressing = sweep.largest;
      if (sweep.change <= (settled ? kSettledTolerance : kSweepTolerance) * sweep.largest) break;
      if (!wants_direct(i, sweep)) continue;
      Sweep all;
      settled = direct.settle_velocities(island, h, all);
      count(all);
    }
  }

  void solve_carriage() {
    for (std::size_t i = 0; i < island.movers.size(); ++i) {
      Mover<D>& mover = island.movers[i];
      const Increment<D>& increment = island.increments[i];
      const Vec<D> pressed = mover.velocity - island.kicked[i];
      mover.mean_velocity = mover.velocity + increment.drift / h - pressed * lag_of(increment, h);
      mover.mean_spin = mover.spin;
    }
    const auto& increments = island.increments;
    each_pair([&](auto& rows, auto& a, auto& b) {
      begin_carrying(rows, a, b, lag_of(increments[rows.a], h), lag_of(increments[rows.b], h));
    });
    Sweep all;
    const bool done = settled && direct.settle_carriage(island, h, true, all);
    double largest = 0;
    for (int i = 0; !done && i < most_sweeps(); ++i) {
      Sweep sweep;
      each_joint([&](auto& rows, auto& a, auto& b) { sweep_carriage(rows, a, b, h, sweep); });
      each_pair([&](auto& rows, auto& a, auto& b) { sweep_carriage(rows, a, b, h, sweep); });
      count(sweep);
      largest = std::max(largest, sweep.change);
      if (sweep.change <= std::max(kCarriedTolerance * largest, kSettledTolerance * pressing))
        break;
      // Two did not do: all at once. What slips is done with already and does not matter here.
      if (i == 1 && !impulse_method() && direct.settle_carriage(island, h, false, all)) break;
    }
    count(all);
  }

  void move_bodies() {
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
      Body<D>& body = island.bodies[i];
      const Mover<D>& mover = island.movers[i];
      const Increment<D>& increment = island.increments[i];
      if (body.kind != BodyKind::dynamic_body) {
        fly(body, increment, h, config.rotation, work);
        continue;
      }
      body.velocity = mover.velocity;
      body.angular_momentum += increment.twist + mover.twist;
      body.position += mover.mean_velocity * h;
      if (body.inverse_inertia == Spin<D>(0.0)) continue;
      const Spin<D> turning = body.angular_momentum + increment.lag;
      const Spin<D> pushed = mover.mean_spin - mover.spin;
      if (turning == Spin<D>(0.0) && pushed == Spin<D>(0.0)) continue;
      turn_freely(body, increment.lag, h, body.rotation.value_or(config.rotation));
      if (pushed != Spin<D>(0.0)) body.orientation = turned(body.orientation, pushed * h);
      ++work.rotations_integrated;
    }
  }

  void record() {
    for (IslandPair<D>& pair : island.pairs) {
      stop_if_asked();
      for (int i = 0; i < pair.rows.count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const ContactPoint<D>& p = pair.rows.room[at];
        pair.record.normal_impulses[at] += p.pn;
        pair.record.friction_impulses[at] += p.pt;
        if (p.pn > 0 || p.separation <= 0) pair.touched = true;
      }
    }
  }

  void run() {
    stop_if_asked();
    find_increments_if_any<D>(config, island.bodies, island.forces, h, island.increments, work);
    refresh_rows();
    apply_forces();
    solve_velocities();
    solve_carriage();
    move_bodies();
    record();
  }
};

// What the next sub-step, perhaps of another step, begins with.
template <int D>
void remember(Island<D>& island, double h) {
  for (IslandPair<D>& pair : island.pairs) {
    stop_if_asked();
    pair.remembered = pair.rows.count > 0;
    if (!pair.remembered) continue;
    pair.seconds = h;
    pair.memory.manifold = pair.record.manifold;
    for (std::size_t i = 0; i < static_cast<std::size_t>(pair.rows.count); ++i) {
      pair.memory.normal_impulses[i] = pair.rows.room[i].pn;
      pair.memory.friction_impulses[i] = pair.rows.room[i].pt;
    }
  }
  island.joint_seconds = h;
}

}  // namespace

template <int D>
void move_island(Island<D>& island, const WorldConfig<D>& config, double h, double whole,
                 WorldWork& work) {
  const bool soft = config.contacts != ContactMethod::impulse;
  const double share = h / whole * (soft ? config.sub_steps : 1);
  const int count = std::max(1, static_cast<int>(std::ceil(share - 1e-9)));
  const double sub_step = h / count;
  look_for_contacts(island, config.warm_start ? sub_step : 0, work);
  const bool bound =
      !island.joints.empty() || std::any_of(island.pairs.begin(), island.pairs.end(),
                                            [](const auto& pair) { return pair.rows.count > 0; });
  if (!bound) {
    find_increments_if_any<D>(config, island.bodies, island.forces, h, island.increments, work);
    for (std::size_t i = 0; i < island.bodies.size(); ++i)
      fly(island.bodies[i], island.increments[i], h, config.rotation, work);
    remember(island, h);
    return;
  }
  const double old = island.joint_seconds;
  const double scale = config.warm_start && old > 0 ? rescaled(sub_step, old) : 0;
  for (JointRows<D>& rows : island.joints) rows.impulse *= scale;
  DirectSolve<D> direct;
  for (int i = 0; i < count; ++i) SubStep<D>{island, config, sub_step, work, direct}.run();
  remember(island, sub_step);
}

template <int D>
void renew_record(Contact<D>& record, const Manifold<D>& manifold) {
  Contact<D> renewed;
  renewed.a = record.a;
  renewed.b = record.b;
  renewed.manifold = manifold;
  for (std::size_t i = 0; i < static_cast<std::size_t>(record.manifold.count); ++i) {
    std::size_t to = 0;
    for (std::size_t j = 0; j < static_cast<std::size_t>(manifold.count); ++j)
      if (manifold.room[j].feature == record.manifold.room[i].feature) to = j;
    renewed.normal_impulses[to] += record.normal_impulses[i];
    renewed.friction_impulses[to] += record.friction_impulses[i];
  }
  record = renewed;
}

#define LANTERN_INSTANTIATE(D)                                                              \
  template void move_island(Island<D>&, const WorldConfig<D>&, double, double, WorldWork&); \
  template void renew_record(Contact<D>&, const Manifold<D>&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern
