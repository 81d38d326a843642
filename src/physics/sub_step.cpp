#include "physics/sub_step.hpp"

#include <algorithm>
#include <cmath>

#include "base/stop.hpp"
#include "physics/constrained_motion.hpp"
#include "physics/free_rotation.hpp"

namespace lantern::physics {
namespace {

// Which part of the new velocity's change the mean velocity lags behind: 0 for semi-implicit
// Euler, 1/2 for velocity Verlet. Where there is no force, as the method would lag.
template <int D>
double lag_of(const Island<D>& island, std::size_t i, const WorldConfig<D>& config, double h) {
  const Increment<D>& increment = island.increments[i];
  const double kick = glm::dot(increment.kick, increment.kick);
  if (kick > 0)
    return std::clamp(-glm::dot(increment.drift, increment.kick) / (h * kick), 0.0, 1.0);
  switch (island.bodies[i].integrator.value_or(config.integrator)) {
    case Integrator::explicit_euler:
      return 1;
    case Integrator::semi_implicit_euler:
    case Integrator::implicit_euler:
      return 0;
    case Integrator::velocity_verlet:
    case Integrator::runge_kutta_4:
    case Integrator::implicit_midpoint:
      return 0.5;
  }
  return 0;
}

// Impulses of what presses go with time, those of a blow do not. A blow in the shortest of
// sub-steps must not be taken for a force, so a guess is only ever made smaller.
double rescaled(double seconds, double old) { return std::min(seconds / old, 1.0); }

template <int D>
void look_for_contacts(Island<D>& island, double scale_to, WorldWork& work) {
  island.find_axes();
  for (IslandPair<D>& pair : island.pairs) {
    stop_if_asked();
    pair.rows.count = 0;
    if (!pair.pressed) {
      pair.seen = nullptr;  // it is about to move
      continue;
    }
    const double scale = pair.seconds > 0 ? rescaled(scale_to, pair.seconds) : 0;
    island.find_points(pair, pair.reach, pair.remembered ? &pair.memory : nullptr, scale, work);
  }
}

// Joints begin with impulses of the step's last sub-step, or else with those remembered from the
// step before, as if these were from none shorter than this step has.
template <int D>
void scale_joint_impulses(Island<D>& island, double sub_step, double longest, bool warm_start) {
  const bool first = island.joint_seconds == 0;
  const double scale = warm_start ? rescaled(sub_step, first ? 1 : island.joint_seconds) : 0;
  for (JointRows<D>& rows : island.joints) {
    if (first && rows.seconds > 0) rows.impulse /= std::max(rows.seconds, longest);
    rows.impulse *= scale;
  }
}

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

// How fast the tension of joints, by impulses of `seconds`, swings what they hold.
template <int D>
double swing_of(const Island<D>& island, double seconds) {
  double most = 0;
  for (const JointRows<D>& rows : island.joints)
    most = std::max(most, rows.swing_squared(island.bodies[rows.a], island.bodies[rows.b],
                                             glm::length(rows.impulse) / seconds));
  return std::sqrt(most);
}

// Into how many sub-steps the seconds that are left are cut: so short as is asked for, and as the
// joints' swinging needs.
template <int D>
double parts_of(const Island<D>& island, double left, double asked, double whole, double last) {
  const double needed = kJointSettings.most_swing / std::max(swing_of(island, last), 1e-300);
  const double seconds =
      std::max(std::min(asked, needed), kJointSettings.shortest_sub_step * whole);
  return std::ceil(left / std::min(asked, seconds) - 1e-9);
}

// As `in_sub_steps`, where joints hold bodies that others touch.
template <int D>
void in_swinging_sub_steps(Island<D>& island, const WorldConfig<D>& config, double h, double asked,
                           double whole, WorldWork& work,
                           const std::function<void(SubStep<D>&)>& solve) {
  double last = asked;
  for (double left = h; left > 0;) {
    const double parts = std::max(1.0, parts_of(island, left, asked, whole, last));
    const double seconds = left / parts;
    for (JointRows<D>& rows : island.joints) rows.impulse *= rescaled(seconds, last);
    for (IslandPair<D>& pair : island.pairs)
      for (ContactPoint<D>& p : pair.rows.points()) {
        p.pn *= rescaled(seconds, last);
        p.pt *= rescaled(seconds, last);
      }
    SubStep<D> part(island, config, seconds, work);
    part.begin();
    solve(part);
    part.end();
    if (seconds < h) ++work.sub_steps;
    last = seconds;
    left = parts > 1 ? left - seconds : 0;
  }
  remember(island, last);
}

}  // namespace

template <int D>
template <class F>
void SubStep<D>::each_joint(F&& f) {
  for (JointRows<D>& rows : island.joints) {
    stop_if_asked();
    f(rows, island.solver_bodies[rows.a], island.solver_bodies[rows.b]);
  }
}

template <int D>
void SubStep<D>::begin() {
  stop_if_asked();
  find_increments_if_any<D>(config, island.bodies, island.forces, h, island.increments, work);
  island.set_solver_bodies();
  const auto& kicks = island.increments;
  each_pair([&](ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b) {
    const Vec<D> kick_a = kicks[rows.a].kick, kick_b = kicks[rows.b].kick;
    const double way = h * std::max(glm::length(kick_a), glm::length(kick_b));
    rows.refresh(island.bodies[rows.a], island.bodies[rows.b], island.axes[rows.a],
                 island.axes[rows.b], a, b,
                 kRowSettings.bounce_steps * glm::length(kick_b - kick_a),
                 kRowSettings.touching_way * way);
  });
  each_joint([&](JointRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b) {
    rows.refresh(island.bodies[rows.a], island.bodies[rows.b], a, b);
  });
  touches_ = std::any_of(island.pairs.begin(), island.pairs.end(),
                         [](const IslandPair<D>& pair) { return pair.rows.count > 0; });
  joints_at_once_ = island.joint_block.refresh(island.joints, island.solver_bodies);
  for (std::size_t i = 0; i < island.solver_bodies.size(); ++i) {
    SolverBody<D>& body = island.solver_bodies[i];
    body.velocity += island.increments[i].kick;
    body.spin += body.inverse_inertia * island.increments[i].twist;
  }
  island.kicked.clear();
  island.kicked_spins.clear();
  for (const SolverBody<D>& body : island.solver_bodies) {
    island.kicked.push_back(body.velocity);
    island.kicked_spins.push_back(body.spin);
  }
  each_joint([](auto& rows, auto& a, auto& b) { rows.warm_start(a, b); });
  each_pair([](auto& rows, auto& a, auto& b) { rows.warm_start(a, b); });
}

template <int D>
Sweep SubStep<D>::sweep_velocities(int turn) {
  Sweep sweep;
  if (!joints_at_once_)
    each_joint([&](auto& rows, auto& a, auto& b) { rows.solve_velocities(a, b, sweep); });
  for (std::size_t i = 0; i < island.pairs.size(); ++i) {
    stop_if_asked();
    ContactRows<D>& rows = island.pairs[turn % 2 == 0 ? i : island.pairs.size() - 1 - i].rows;
    if (rows.count > 0)
      rows.solve_velocities(island.solver_bodies[rows.a], island.solver_bodies[rows.b], h, sweep);
  }
  if (joints_at_once_)
    island.joint_block.solve_velocities(island.joints, island.solver_bodies, sweep, work);
  if (joints_at_once_ && !touches_) sweep.change = 0;
  count(sweep, work);
  return sweep;
}

// Impulses p change the kinetic energy by p.(u0 + u) / 2, with relative velocities u0 before them
// and u = u0 + K p after. Those that solve all rows have p.(u - wanted) = 0: they are the best of
// their ray s p, and what is wanted is never more than what came in, u0, turned round. Since the
// cone of friction is one, s p stays within it.
template <int D>
void SubStep<D>::do_no_work() {
  double before = 0, after = 0, wanted = 0;
  const auto before_of = [&](std::uint32_t i, const Vec<D>& arm) {
    return island.kicked[i] + cross(island.kicked_spins[i], arm);
  };
  const auto add = [&](const auto& rows, const auto& point, const Vec<D>& impulse) {
    const SolverBody<D>&a = island.solver_bodies[rows.a], &b = island.solver_bodies[rows.b];
    before += glm::dot(impulse, before_of(rows.b, point.arm_b) - before_of(rows.a, point.arm_a));
    after += glm::dot(impulse, relative_velocity(a, point.arm_a, b, point.arm_b));
  };
  for (const JointRows<D>& rows : island.joints) add(rows, rows, rows.impulse);
  for (const IslandPair<D>& pair : island.pairs)
    for (const ContactPoint<D>& p : pair.rows.points()) {
      add(pair.rows, p, pair.rows.normal * p.pn + p.pt);
      wanted += p.pn * (p.bounce - p.gap / h);
    }
  const double changed = after - before;
  wanted = std::min(wanted, std::max(-before, 0.0));
  if (!(after - wanted > kRowSettings.work_by_rounding * changed)) return;
  const double share = std::clamp((wanted - before) / changed, 0.0, 1.0);
  for (std::size_t i = 0; i < island.solver_bodies.size(); ++i) {
    SolverBody<D>& body = island.solver_bodies[i];
    body.velocity = island.kicked[i] + (body.velocity - island.kicked[i]) * share;
    body.spin = island.kicked_spins[i] + (body.spin - island.kicked_spins[i]) * share;
    body.twist *= share;
  }
  for (JointRows<D>& rows : island.joints) rows.impulse *= share;
  for (IslandPair<D>& pair : island.pairs)
    for (ContactPoint<D>& p : pair.rows.points()) {
      p.pn *= share;
      p.pt *= share;
    }
}

template <int D>
void SubStep<D>::find_mean_velocities() {
  const auto& increments = island.increments;
  for (std::size_t i = 0; i < island.solver_bodies.size(); ++i) {
    SolverBody<D>& body = island.solver_bodies[i];
    const double lag = lag_of(island, i, config, h);
    const Vec<D> pressed = body.velocity - island.kicked[i];
    body.mean_velocity = body.velocity + increments[i].drift / h - pressed * lag;
    body.lag = increments[i].lag;
    if (turns_alike(island.bodies[i])) body.lag -= body.twist * lag;
    body.mean_spin = body.turning_spin = body.spin + body.inverse_inertia * body.lag;
  }
}

template <int D>
void SubStep<D>::begin_position_correction() {
  do_no_work();
  find_mean_velocities();
  each_pair([&](auto& rows, auto& a, auto& b) {
    rows.begin_correction(a, b, lag_of(island, rows.a, config, h),
                          lag_of(island, rows.b, config, h));
  });
}

template <int D>
Sweep SubStep<D>::sweep_positions() {
  Sweep sweep;
  if (!joints_at_once_)
    each_joint([&](auto& rows, auto& a, auto& b) { rows.correct_positions(a, b, sweep); });
  each_pair([&](auto& rows, auto& a, auto& b) { rows.correct_positions(a, b, h, sweep); });
  if (joints_at_once_)
    island.joint_block.correct_positions(island.joints, island.solver_bodies, sweep, work);
  if (joints_at_once_ && !touches_) sweep.change = 0;
  count(sweep, work);
  return sweep;
}

template <int D>
bool SubStep<D>::is_corrected(const Sweep& sweep, double largest) {
  largest_push_ = std::max(largest_push_, sweep.change);
  return sweep.change <=
         std::max(kRowSettings.push * largest_push_, kRowSettings.no_matter * largest);
}

template <int D>
void SubStep<D>::end() {
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    Body<D>& body = island.bodies[i];
    const SolverBody<D>& solved = island.solver_bodies[i];
    const Increment<D>& increment = island.increments[i];
    if (body.kind != BodyKind::dynamic_body) {
      fly(body, increment, h, config.rotation, work);
      continue;
    }
    body.velocity = solved.velocity;
    body.angular_momentum += increment.twist + solved.twist;
    body.position += solved.mean_velocity * h;
    if (body.inverse_inertia == Spin<D>(0.0)) continue;
    const Spin<D> turning = body.angular_momentum + solved.lag;
    const Spin<D> pushed = solved.mean_spin - solved.turning_spin;
    if (turning == Spin<D>(0.0) && pushed == Spin<D>(0.0)) continue;
    turn_freely(body, h, body.rotation.value_or(config.rotation), solved.lag);
    if (pushed != Spin<D>(0.0)) turn_with_momentum(body, Spin<D>(pushed * h));
    ++work.rotations_integrated;
  }
  if (joints_at_once_) island.joint_block.close_gaps(island.joints, island.bodies, h, work);
  for (IslandPair<D>& pair : island.pairs) {
    stop_if_asked();
    pair.record_impulses();
    for (const ContactPoint<D>& p : pair.rows.points())
      if (p.pn > 0 || p.separation <= 0) pair.touched = true;
  }
}

template <int D>
void in_sub_steps(Island<D>& island, const WorldConfig<D>& config, double h, double whole,
                  int sub_steps, WorldWork& work, const std::function<void(SubStep<D>&)>& solve) {
  const int count = std::max(1, static_cast<int>(std::ceil(h / whole * sub_steps - 1e-9)));
  const double seconds = h / count;
  look_for_contacts(island, config.warm_start ? seconds : 0, work);
  const bool pressed = std::any_of(island.pairs.begin(), island.pairs.end(),
                                   [](const auto& pair) { return pair.rows.count > 0; });
  if (!pressed && !island.joints.empty() && move_constrained(island, config, h, work)) {
    remember(island, h);
    return;
  }
  if (!pressed && island.joints.empty()) {
    find_increments_if_any<D>(config, island.bodies, island.forces, h, island.increments, work);
    for (std::size_t i = 0; i < island.bodies.size(); ++i)
      fly(island.bodies[i], island.increments[i], h, config.rotation, work);
    remember(island, h);
    return;
  }
  if (!island.joints.empty()) {
    scale_joint_impulses(island, seconds, whole / sub_steps, config.warm_start);
    return in_swinging_sub_steps(island, config, h, seconds, whole, work, solve);
  }
  if (sub_steps > 1) work.sub_steps += static_cast<std::uint64_t>(count);
  for (int i = 0; i < count; ++i) {
    SubStep<D> part(island, config, seconds, work);
    part.begin();
    solve(part);
    part.end();
  }
  remember(island, seconds);
}

#define LANTERN_INSTANTIATE(D)                                                                   \
  template class SubStep<D>;                                                                     \
  template void in_sub_steps(Island<D>&, const WorldConfig<D>&, double, double, int, WorldWork&, \
                             const std::function<void(SubStep<D>&)>&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
