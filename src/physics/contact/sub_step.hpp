// A part of a step in which the rows of an island are solved once: what solvers share that solve
// rows.
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
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/function_ref.hpp"
#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/body.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/joint/constrained_motion.hpp"

namespace lantern::physics {

template <int D>
class SubStep {
 public:
  SubStep(const IslandMove<D>& move, double seconds)
      : island(move.island), config(move.config), h(seconds), work(move.work) {}

  Island<D>& island;
  const WorldConfig<D>& config;
  const double h;
  WorldWork& work;

  // Forces act, rows are made where bodies are, and begin with the impulses that they have.
  void begin() {
    find_motion();
    each_pair([&](auto& rows, auto&, auto&) { refresh(rows); });
    each_joint([&](JointRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b) {
      rows.refresh(island.bodies[rows.a], island.bodies[rows.b], a, b);
    });
    touches_ = std::ranges::any_of(island.pairs, &IslandPair<D>::may_press);
    joints_at_once_ = island.joint_block.refresh(island.joints, island.solver_bodies);
    for (std::size_t i = 0; i < island.kicked.size(); ++i)
      static_cast<Motion<D>&>(island.solver_bodies[i]) = island.kicked[i];
    each_joint([](auto& rows, auto& a, auto& b) { rows.warm_start(a, b); });
    each_pair([](auto& rows, auto& a, auto& b) { rows.warm_start(a, b); });
  }

  // The bodies as constraints see them, and how forces kick them.
  void find_motion() {
    stop_if_asked();
    find_increments_if_any<D>(config, island.bodies, island.forces, h, island.increments, work);
    take_half_way();
    island.set_solver_bodies();
    island.kicked.assign(island.solver_bodies.begin(), island.solver_bodies.end());
    for (std::size_t i = 0; i < island.kicked.size(); ++i) {
      island.kicked[i].velocity += island.increments[i].kick;
      island.kicked[i].spin += island.solver_bodies[i].inverse_inertia * island.increments[i].twist;
    }
  }

  void refresh(ContactRows<D>& rows) {
    const Vec<D> kick_a = island.increments[rows.a].kick, kick_b = island.increments[rows.b].kick;
    const double way = h * std::max(glm::length(kick_a), glm::length(kick_b));
    rows.refresh(island.bodies[rows.a], island.bodies[rows.b], island.axes[rows.a],
                 island.axes[rows.b], island.solver_bodies[rows.a], island.solver_bodies[rows.b],
                 kRowSettings.bounce_steps * glm::length(kick_b - kick_a),
                 kRowSettings.touching_way * way, h, lag_of(rows.a), lag_of(rows.b));
  }

  // Once over all rows, joints last. Every other `turn` goes backwards, so that neither end of a
  // stack, nor side of a box, is preferred. Where nothing but sweeps follows (`alone`), pairs keep
  // their order, so that what one sweep leaves undone lies where the next one finds it, and only
  // the points of each go backwards.
  Sweep sweep_velocities(int turn, bool alone = false) {
    Sweep sweep{&work};
    if (!joints_at_once_)
      each_joint([&](auto& rows, auto& a, auto& b) { rows.solve_velocities(a, b, sweep); });
    const bool back = turn % 2 != 0;
    for (std::size_t i = 0; i < island.pairs.size(); ++i) {
      stop_if_asked();
      ContactRows<D>& rows = island.pairs[back && !alone ? island.pairs.size() - 1 - i : i].rows;
      if (rows.count > 0)
        rows.solve_velocities(island.solver_bodies[rows.a], island.solver_bodies[rows.b], h, sweep,
                              back && alone);
    }
    if (joints_at_once_)
      island.joint_block.solve_velocities(island.joints, island.solver_bodies, sweep, work);
    if (joints_at_once_ && !touches_) sweep.change = 0;
    return sweep;
  }

  // Takes back so much of all impulses, in proportion, that together they do no work but what
  // bounces and closing gaps ask for. Sweeps that end early may leave them too large, and energy
  // would come of it. After the last sweep over velocities. Impulses p change the kinetic energy by
  // p.(u0 + u) / 2, with relative velocities u0 before them and u = u0 + K p after. Those that
  // solve all rows have p.(u - wanted) = 0: they are the best of their ray s p, and what is wanted
  // is never more than what came in, u0, turned round. Since the cone of friction is one, s p stays
  // within it.
  void do_no_work() {
    double before = 0, after = 0, wanted = 0;
    const auto add = [&](const auto& rows, const auto& point, const Vec<D>& impulse) {
      const SolverBody<D>&a = island.solver_bodies[rows.a], &b = island.solver_bodies[rows.b];
      before += glm::dot(impulse, relative_velocity(island.kicked[rows.a], point.arm_a,
                                                    island.kicked[rows.b], point.arm_b));
      after += glm::dot(impulse, relative_velocity(a, point.arm_a, b, point.arm_b));
    };
    for (const JointRows<D>& rows : island.joints) add(rows, rows, rows.impulse);
    for (const IslandPair<D>& pair : island.pairs)
      for (const ContactPoint<D>& p : pair.rows.points()) {
        add(pair.rows, p, pair.rows.normal * p.pn + p.pt);
        wanted += p.pn * (p.bounce - p.gap / h);
      }
    const double share = share_without_work(before, after, wanted);
    if (share == 1) return;
    for (std::size_t i = 0; i < island.solver_bodies.size(); ++i) {
      SolverBody<D>& body = island.solver_bodies[i];
      const auto& [velocity, spin] = island.kicked[i];
      body.velocity = velocity + (body.velocity - velocity) * share;
      body.spin = spin + (body.spin - spin) * share;
      body.twist *= share;
    }
    for (JointRows<D>& rows : island.joints) rows.impulse *= share;
    for (IslandPair<D>& pair : island.pairs)
      for (ContactPoint<D>& p : pair.rows.points()) {
        p.pn *= share;
        p.pt *= share;
      }
  }

  // Of impulses whose work is in proportion to the sum of both.
  static double share_without_work(double before, double after, double wanted) {
    const double changed = after - before;
    wanted = std::min(wanted, std::max(-before, 0.0));
    if (!(after - wanted > kRowSettings.work_by_rounding * changed)) return 1;
    return std::clamp((wanted - before) / changed, 0.0, 1.0);
  }

  void find_mean_velocities() {
    const auto& increments = island.increments;
    for (std::size_t i = 0; i < island.solver_bodies.size(); ++i) {
      SolverBody<D>& body = island.solver_bodies[i];
      const double lag = lag_of(i);
      const Vec<D> pressed = body.velocity - island.kicked[i].velocity;
      body.mean.velocity = body.velocity + increments[i].drift / h - pressed * lag;
      body.lag = increments[i].lag;
      if (turns_alike(island.bodies[i])) body.lag -= body.twist * lag;
      body.mean.spin = body.turning_spin = body.spin + body.inverse_inertia * body.lag;
    }
  }

  // From the velocities found follow mean velocities, and what is wanted of them.
  void begin_position_correction() {
    do_no_work();
    Sweep sweep{&work};  // a part of all impulses would let joints part
    if (joints_at_once_)
      island.joint_block.solve_velocities(island.joints, island.solver_bodies, sweep, work);
    find_mean_velocities();
    each_pair([&](auto& rows, auto& a, auto& b) {
      rows.begin_correction(a, b, lag_of(rows.a), lag_of(rows.b), island.kicked[rows.a],
                            island.kicked[rows.b]);
    });
  }

  Sweep sweep_positions(bool alone = false) {
    Sweep sweep{&work};
    if (!joints_at_once_)
      each_joint([&](auto& rows, auto& a, auto& b) { rows.correct_positions(a, b, sweep); });
    each_pair([&](auto& rows, auto& a, auto& b) { rows.correct_positions(a, b, h, alone, sweep); });
    if (joints_at_once_)
      island.joint_block.correct_positions(island.joints, island.solver_bodies, sweep, work);
    if (joints_at_once_ && !touches_) sweep.change = 0;
    return sweep;
  }

  // Whether a sweep over positions was the last that is needed; `largest` impulse of velocities.
  bool is_corrected(const Sweep& sweep, double largest) {
    largest_push_ = std::max(largest_push_, sweep.change);
    return sweep.change <=
           std::max(kRowSettings.push * largest_push_, kRowSettings.no_matter * largest);
  }

  // Moves the bodies, and notes what touched and how hard.
  void end() {
    move_bodies();
    if (joints_at_once_) hold_joints();
    for (IslandPair<D>& pair : island.pairs) {
      stop_if_asked();
      note_touch(pair);
    }
  }

  static void note_touch(IslandPair<D>& pair) {
    pair.record_impulses();
    for (const ContactPoint<D>& p : pair.rows.points())
      if (p.pn > 0 || p.separation <= 0) pair.touched = true;
  }

  void move_bodies() {
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
      Body<D>& body = island.bodies[i];
      const SolverBody<D>& solved = island.solver_bodies[i];
      const Increment<D>& increment = island.increments[i];
      if (!body.is_dynamic()) {
        fly(body, increment, h, config.rotation, work);
        continue;
      }
      body.velocity = solved.velocity;
      body.angular_momentum += increment.twist + solved.twist;
      body.position += solved.mean.velocity * h;
      if (body.inverse_inertia == Spin<D>(0.0)) continue;
      const Spin<D> pushed = solved.mean.spin - solved.turning_spin;
      const bool turns = turn_on(body, increment, solved.lag, h, config.rotation);
      if (pushed != Spin<D>(0.0)) turn_with_momentum(body, Spin<D>(pushed * h));
      work.rotations_integrated += turns || pushed != Spin<D>(0.0);
    }
  }

  // Where the bodies have come to the joints hold otherwise than where they were: links in a line
  // give way across it, until they have done so. First velocities no longer part them, which takes
  // energy, if any; then the gaps are closed.
  void hold_joints() {
    island.set_solver_bodies();
    each_joint([&](JointRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b) {
      rows.refresh(island.bodies[rows.a], island.bodies[rows.b], a, b);
    });
    if (!island.joint_block.refresh(island.joints, island.solver_bodies)) return;
    Sweep sweep{&work};
    island.joint_block.solve_velocities(island.joints, island.solver_bodies, sweep, work);
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
      if (!island.bodies[i].is_pushed()) continue;
      island.bodies[i].velocity = island.solver_bodies[i].velocity;
      island.bodies[i].angular_momentum += island.solver_bodies[i].twist;
    }
    island.joint_block.close_gaps(island.joints, island.bodies, h, work);
  }

  // f(rows, a, b) of those that may press
  template <class F>
  void each_pair(F&& f) {
    for (IslandPair<D>& pair : island.pairs) {
      stop_if_asked();
      if (pair.rows.count > 0)
        f(pair.rows, island.solver_bodies[pair.rows.a], island.solver_bodies[pair.rows.b]);
    }
  }

 private:
  template <class F>
  void each_joint(F&& f) {
    for (JointRows<D>& rows : island.joints) {
      stop_if_asked();
      f(rows, island.solver_bodies[rows.a], island.solver_bodies[rows.b]);
    }
  }

  // No force upon a ball that touches only what stands still changes on its way through a sub-step:
  // its mean velocity is half way, by an integrator of first order, too. (Of what turns on its
  // corners, or on what moves, that would be energy from nothing.)
  void take_half_way() {
    const Forces<D>& forces = island.forces;
    if (!island.joints.empty() || !forces.springs.empty() || forces.gravitation > 0) return;
    const auto may = [&](const Body<D>& body) {
      return std::holds_alternative<Sphere>(body.shape) && body.is_dynamic() &&
             integration(body.integrator.value_or(config.integrator)).lag < 0.5 &&
             !(body.linear_drag > 0) && !(body.angular_drag > 0);
    };
    if (std::ranges::none_of(island.bodies, may)) return;
    Scratch<int> touched(island.bodies.size());  // 1: by what stands still, 2: by what moves
    for (const IslandPair<D>& pair : island.pairs) {
      if (pair.rows.count == 0) continue;
      touched[pair.rows.a] |= island.bodies[pair.rows.b].moves() ? 2 : 1;
      touched[pair.rows.b] |= island.bodies[pair.rows.a].moves() ? 2 : 1;
    }
    for (std::size_t i = 0; i < touched.size(); ++i) {
      if (touched[i] != 1 || !may(island.bodies[i])) continue;
      Increment<D>& increment = island.increments[i];
      increment.drift = -h / 2 * increment.kick;
      increment.lag = -0.5 * increment.twist;
    }
  }

  // Which part of the new velocity's change the mean velocity lags behind: 0 for semi-implicit
  // Euler, 1/2 for velocity Verlet. Where there is no force, as the method would lag.
  double lag_of(std::size_t i) const {
    const Increment<D>& increment = island.increments[i];
    const double kick = glm::dot(increment.kick, increment.kick);
    if (kick > 0)
      return std::clamp(-glm::dot(increment.drift, increment.kick) / (h * kick), 0.0, 1.0);
    return integration(island.bodies[i].integrator.value_or(config.integrator)).lag;
  }

  double largest_push_ = 0;
  bool joints_at_once_ = false;  // after which, if nothing touches, nothing is left to be done
  bool touches_ = false;
};

// Impulses of what presses go with time, those of a blow do not. A blow in the shortest of
// sub-steps must not be taken for a force, so a guess is only ever made smaller.
inline double rescaled(double seconds, double old) { return std::min(seconds / old, 1.0); }

template <int D>
class SubSteps {
 public:
  SubSteps(const IslandMove<D>& move, FunctionRef<void(SubStep<D>&)> make)
      : move_(move), island_(move.island), make_(make) {}

  void run(int sub_steps) {
    const double h = move_.h, whole = move_.whole;
    const int count = std::max(1, static_cast<int>(std::ceil(h / whole * sub_steps - 1e-9)));
    const double seconds = h / count;
    look_for_contacts(move_.config.warm_start ? seconds : 0);
    const bool pressed = std::ranges::any_of(island_.pairs, &IslandPair<D>::may_press);
    if (!pressed && !island_.joints.empty() && move_constrained(move_)) return remember(h);
    if (!pressed && island_.joints.empty()) {
      fly_all();
      return remember(h);
    }
    if (!island_.joints.empty()) {
      scale_joint_impulses(seconds, whole / sub_steps);
      return swing(seconds);
    }
    if (sub_steps > 1) move_.work.sub_steps += static_cast<std::uint64_t>(count);
    for (int i = 0; i < count; ++i) make(seconds);
    remember(seconds);
  }

 private:
  void make(double seconds) {
    SubStep<D> part(move_, seconds);
    make_(part);
  }

  void fly_all() {
    find_increments_if_any<D>(move_.config, island_.bodies, island_.forces, move_.h,
                              island_.increments, move_.work);
    for (std::size_t i = 0; i < island_.bodies.size(); ++i)
      fly(island_.bodies[i], island_.increments[i], move_.h, move_.config.rotation, move_.work);
  }

  void look_for_contacts(double scale_to) {
    island_.find_axes();
    for (IslandPair<D>& pair : island_.pairs) {
      stop_if_asked();
      pair.rows.count = 0;
      if (!pair.pressed) {
        pair.seen = nullptr;  // it is about to move
        continue;
      }
      const double seconds = pair.seconds;
      const double scale = seconds > 0 ? rescaled(scale_to, seconds) : 0;
      island_.find_points(pair, pair.reach, seconds > 0 ? &pair.remembered() : nullptr, scale,
                          move_.work);
    }
  }

  // Joints begin with impulses of the step's last sub-step, or else with those remembered from the
  // step before, as if these were from none shorter than this step has.
  void scale_joint_impulses(double sub_step, double longest) {
    const bool first = island_.joint_seconds == 0;
    const double scale =
        move_.config.warm_start ? rescaled(sub_step, first ? 1 : island_.joint_seconds) : 0;
    for (JointRows<D>& rows : island_.joints) {
      if (first && rows.seconds > 0) rows.impulse /= std::max(rows.seconds, longest);
      rows.impulse *= scale;
    }
  }

  // What the next sub-step, perhaps of another step, begins with.
  void remember(double h) {
    for (IslandPair<D>& pair : island_.pairs) {
      stop_if_asked();
      auto& [record, memory, seconds, crushes] = static_cast<Touch<D>&>(pair);
      seconds = pair.rows.count > 0 ? h : 0;
      if (pair.rows.count == 0) continue;
      pair.renewed = true;
      memory.manifold = record.manifold;
      for (std::size_t i = 0; i < pair.rows.points().size(); ++i) {
        memory.normal_impulses[i] = pair.rows.room[i].pn;
        memory.friction_impulses[i] = pair.rows.room[i].pt;
      }
    }
    island_.joint_seconds = h;
  }

  // How fast the tension of joints, by impulses of `seconds`, swings what they hold.
  double swing_of(double seconds) const {
    double most = 0;
    for (const JointRows<D>& rows : island_.joints)
      most = std::max(most, rows.swing_squared(island_.bodies[rows.a], island_.bodies[rows.b],
                                               glm::length(rows.impulse) / seconds));
    return std::sqrt(most);
  }

  // Into how many sub-steps the seconds that are left are cut: so short as is asked for, and as the
  // joints' swinging needs.
  double parts_of(double left, double asked, double last) const {
    const double needed = kJointSettings.most_swing / std::max(swing_of(last), 1e-300);
    const double seconds =
        std::max(std::min(asked, needed), kJointSettings.shortest_sub_step * move_.whole);
    return std::ceil(left / std::min(asked, seconds) - 1e-9);
  }

  // Where joints hold bodies that others touch.
  void swing(double asked) {
    double last = asked;
    for (double left = move_.h; left > 0;) {
      const double parts = std::max(1.0, parts_of(left, asked, last));
      const double seconds = left / parts;
      for (JointRows<D>& rows : island_.joints) rows.impulse *= rescaled(seconds, last);
      for (IslandPair<D>& pair : island_.pairs)
        for (ContactPoint<D>& p : pair.rows.points()) {
          p.pn *= rescaled(seconds, last);
          p.pt *= rescaled(seconds, last);
        }
      make(seconds);
      if (seconds < move_.h) ++move_.work.sub_steps;
      last = seconds;
      left = parts > 1 ? left - seconds : 0;
    }
    remember(last);
  }

  const IslandMove<D>& move_;
  Island<D>& island_;
  FunctionRef<void(SubStep<D>&)> make_;
};

// Moves the island in parts of which `sub_steps` make a whole step. Contacts are looked at once;
// `make` makes a part. If nothing touches, there are no parts: all fly, or move as their joints let
// them (joint/constrained_motion.hpp).
template <int D>
void made_in_sub_steps(const IslandMove<D>& move, int sub_steps,
                       FunctionRef<void(SubStep<D>&)> make) {
  SubSteps<D>(move, make).run(sub_steps);
}

// `solve` finds the impulses of a part and corrects positions, between its begin and its end.
template <int D>
void in_sub_steps(const IslandMove<D>& move, int sub_steps, FunctionRef<void(SubStep<D>&)> solve) {
  made_in_sub_steps<D>(move, sub_steps, [&](SubStep<D>& part) {
    part.begin();
    solve(part);
    part.end();
  });
}

// The same, in which all rows of a part are solved at once (direct_solve.cpp); without `sub_steps`
// those of the whole step.
template <int D>
void solve_directly(const IslandMove<D>& move, std::optional<int> sub_steps);

}  // namespace lantern::physics
