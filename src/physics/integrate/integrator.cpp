#include "physics/integrate/integrator.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "physics/integrate/dormand_prince.hpp"
#include "physics/integrate/implicit_stage.hpp"
#include "physics/integrate/smooth_system.hpp"
#include "physics/joint/constrained_motion.hpp"

namespace lantern::physics {

namespace {

// --- the methods that look at forces where bodies are already ---
//
// Forces are evaluated once a step, or as often as a method says; a step that is too long for the
// stiffest spring blows up.

// Explicit Euler: everything by what it was at the start of the step. A warning: an undamped spring
// gains energy at every step, however short.
template <int D>
void explicit_euler(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  const Pull<D> pull = system.evaluate(system.start());
  for (const std::size_t i : system.movers()) {
    const Vec<D> kick = h * pull.acceleration[i];
    const Spin<D> twist = h * pull.torque[i];
    out[i] = {kick, -h * kick, twist, -twist};  // flies with the velocity before the kick
  }
}
constexpr Integration kExplicitEuler = {
    .name = "explicit_euler",
    .lag = 1,
    .gains_energy = true,
    .increments = {explicit_euler<2>, explicit_euler<3>},
    .with_joints = {constrained_explicit_euler<2>, constrained_explicit_euler<3>}};

// Semi-implicit (symplectic) Euler: forces of the start change the velocity, and the new velocity
// moves the body. As cheap as explicit Euler, yet the energy of a spring stays bounded. With joints
// it would rise and fall by some percent: what they hold is moved by half a step of this and half a
// step of its adjoint, which is velocity Verlet (Hairer, Lubich, Wanner, II.4 and VII.1).
template <int D>
void semi_implicit_euler(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  const Pull<D> pull = system.evaluate(system.start());
  for (const std::size_t i : system.movers())
    out[i] = {h * pull.acceleration[i], Vec<D>(0.0), h * pull.torque[i], Spin<D>(0.0)};
}
constexpr Integration kSemiImplicitEuler = {
    .name = "semi_implicit_euler",
    .increments = {semi_implicit_euler<2>, semi_implicit_euler<3>},
    .with_joints = {constrained_verlet<2>, constrained_verlet<3>}};

// Drag over a step of `h` seconds, by the mean velocity (see drag_share) that it and the first
// half-kick of the other forces lead to: that of `way`. All of the drag is added to `state`. In
// space the mean spin is about the axes as they lie half way.
template <int D>
void brake(const SmoothSystem<D>& system, double h, SmoothState<D>& state, SmoothState<D>& way) {
  const auto kept = [](double z) { return 1 / (1 + drag_share(z) * z); };
  const auto let = [&](double z) { return mean_gain(z) * kept(z); };
  for (const std::size_t i : system.movers()) {
    const Body<D>& body = system.bodies()[i];
    if (const double z = system.drag_part(i, h); z > 0) {
      const Vec<D> mean = kept(z) * body.velocity + let(z) * state.kick[i];
      way.kick[i] = mean - body.velocity;
      state.kick[i] -= z * mean;
    }
    if (!(body.angular_drag > 0) || !system.turns(i)) continue;
    const Spin<D> start = body.angular_momentum, half = state.twist[i];
    Rotation<D> at = body.orientation;
    for (int look = 0; look < 2; ++look) {
      const Spin<D> mean =
          system.by_drag(i, at, start, h, kept) + system.by_drag(i, at, half, h, let);
      way.twist[i] = mean - start;
      state.twist[i] = half - system.by_drag(i, at, mean, h, [](double z) { return z; });
      at = freely_turned(body, mean, h / 2);
    }
  }
}

// Velocity Verlet: half a kick, fly, half a kick (Swope and others, J. Chem. Phys. 76, 1982). Two
// looks at the forces a step: what happens between steps would make the last useless for the next.
//
// The damping of springs needs the velocity that the second half-kick is about to make. Taken from
// before it it would cost an order and stability; so that half is implicit in the velocity alone.
// Forces are linear in it, so one system of linear equations does. Drag is taken by `brake`. The
// only limit left is that of the springs, omega h < 2.
template <int D>
void velocity_verlet(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  SmoothState<D> state = system.start();
  system.leave_drag();
  system.kick(state, system.evaluate(state), h / 2);
  SmoothState<D> way = state;
  brake(system, h, state, way);
  system.fly(state, way, h);
  if (system.any_damping()) {
    damped_kick(system, state, h / 2);
  } else {
    const Pull<D> pull = system.evaluate(state);
    for (const std::size_t i : system.movers()) {
      state.kick[i] += h / 2 * pull.acceleration[i];
      state.twist[i] += h / 2 * pull.torque[i];
    }
  }
  for (const std::size_t i : system.movers())
    out[i] = {state.kick[i], h * (way.kick[i] - state.kick[i]), state.twist[i],
              way.twist[i] - state.twist[i]};
}
constexpr Integration kVelocityVerlet = {
    .name = "velocity_verlet",
    .order = 2,
    .lag = 0.5,
    .increments = {velocity_verlet<2>, velocity_verlet<3>},
    .with_joints = {constrained_verlet<2>, constrained_verlet<3>}};

// The classical method of Runge and Kutta (Kutta 1901): four looks at the forces, at the start, two
// in the middle and one at the end, each from where the one before leads.
//
// The places where it looks are those of free flights between kicks,
//
//   x3 = x0 + h/2 (v0 + h/2 a1)                     h/2 a1 at the start
//   x4 = x0 + h/2 v0 + h/2 (v0 + h a2)              h a2 half way
//   x1 = x0 + h/2 (v0 + h/6 a1) + h/2 (v0 + h/6 a1 + h/3 (a2 + a3))
//
// and h/6 a4 at the end. In space, where a change of angular momentum does not turn a body in
// proportion, its orientations are found just so, by free turns, which are exact: kicks at two
// times commute up to the fifth power of h, so order 4 holds.
template <int D>
void runge_kutta_4(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  SmoothState<D> state = system.start();
  // A look from `time` after the start, on the way that the last state and its pull show.
  const auto look = [&](const Pull<D>& pull, double time) {
    system.fly(state, state, time);  // with the last velocities, before they are kicked anew
    system.kick(state, pull, time);
    return system.evaluate(state);
  };
  const Pull<D> one = system.evaluate(state);
  const Pull<D> two = look(one, h / 2);
  const Scratch<Rotation<D>> half_way = state.orientation;  // without a kick
  const Pull<D> three = look(two, h / 2);
  system.fly(state, state, h);
  const auto turned_on = [&](std::size_t i, const Rotation<D>& from, const Spin<D>& twist) {
    const Body<D>& body = system.bodies()[i];
    return freely_turned(body, from, body.angular_momentum + twist, h / 2);
  };
  for (const std::size_t i : system.movers())
    if (D == 3 && system.turns(i))
      state.orientation[i] = turned_on(i, half_way[i], h * two.torque[i]);
  system.kick(state, three, h);
  const Pull<D> four = system.evaluate(state);

  // x1 = x0 + h v0 + h^2/6 (a1 + a2 + a3) and v1 = v0 + h/6 (a1 + 2 a2 + 2 a3 + a4), so that x1 -
  // x0 - h v1 = -h^2/6 (a2 + a3 + a4).
  for (const std::size_t i : system.movers()) {
    const Vec<D> later = two.acceleration[i] + three.acceleration[i] + four.acceleration[i];
    const Spin<D> later_torque = two.torque[i] + three.torque[i] + four.torque[i];
    out[i].kick = h / 6 *
                  (one.acceleration[i] + 2.0 * (two.acceleration[i] + three.acceleration[i]) +
                   four.acceleration[i]);
    out[i].drift = -h * h / 6 * later;
    out[i].twist =
        h / 6 * (one.torque[i] + 2.0 * (two.torque[i] + three.torque[i]) + four.torque[i]);
    out[i].lag = -h / 6 * later_torque;
    if constexpr (D == 3) {
      if (out[i].twist == Vec<3>(0.0) && out[i].lag == Vec<3>(0.0)) continue;
      const Body<3>& body = system.bodies()[i];
      const Rotation<3> half = turned_on(i, body.orientation, h / 6 * one.torque[i]);
      const Rotation<3> end = turned_on(i, half, out[i].twist - h / 6 * four.torque[i]);
      const Vec<3> mean = body.angular_momentum + out[i].twist + out[i].lag;
      out[i].turn = turn_between(freely_turned(body, mean, h), end);
    }
  }
}
constexpr Integration kRungeKutta4 = {
    .name = "runge_kutta_4",
    .order = 4,
    .lag = 0.5,
    .increments = {runge_kutta_4<2>, runge_kutta_4<3>},
    .with_joints = {constrained_runge_kutta_4<2>, constrained_runge_kutta_4<3>}};

// --- the methods for forces that follow from places alone ---

// The increments that lead to `end`.
template <int D>
void lead_to(const SmoothSystem<D>& system, const SmoothState<D>& end, double h,
             std::span<Increment<D>> out) {
  for (const std::size_t i : system.movers()) {
    const Body<D>& body = system.bodies()[i];
    out[i] = {end.kick[i], end.shift[i] - h * system.velocity(end, i), end.twist[i]};
    if (system.turns(i))
      out[i].turn = turn_between(freely_turned(body, body.angular_momentum + end.twist[i], h),
                                 end.orientation[i]);
  }
}

// Seventeen steps of Verlet, some of them back in time, whose errors cancel (Kahan and Li, Math.
// Comp. 66, 1997, s17odr8a; Hairer, Lubich, Wanner, V.3.2): a flight, a kick half way, and a flight
// that goes on into the next. Symplectic and reversible as each of them; and since free turns are
// exact, also where torques turn bodies.
template <int D>
void kahan_li_8(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  constexpr double kParts[] = {
      0.13020248308889008087881763, 0.56116298177510838456196441,  -0.38947496264484728640807860,
      0.15884190655515560089621075, -0.39590389413323757733623154, 0.18453964097831570709183254,
      0.25837438768632204729397911, 0.29501172360931029887096624,  -0.60550853383003451169892108};
  SmoothState<D> state = system.start();
  double before = 0;
  for (int step = 0; step < 17; ++step) {
    const double part = h * kParts[std::min(step, 16 - step)];
    system.fly(state, state, (before + part) / 2, true);
    const Pull<D> pull = system.evaluate(state);
    for (const std::size_t i : system.movers()) {
      state.kick[i] += part * pull.acceleration[i];
      state.twist[i] += part * pull.torque[i];
    }
    before = part;
  }
  system.fly(state, state, before / 2, true);
  lead_to<D>(system, state, h, out);
}
constexpr Integration kKahanLi8 = {.name = "kahan_li_8",
                                   .order = 8,
                                   .of_places = true,
                                   .increments = {kahan_li_8<2>, kahan_li_8<3>}};

// How fast the numbers change that an orientation is written by; and some of them, as one.
Rotation<2> rate_of(const Rotation<2>&, double spin) { return {spin}; }
Rotation<3> rate_of(const Rotation<3>& r, const Vec<3>& spin) {
  return {glm::dquat(0, spin / 2.0) * r.q};
}
void add_to(Rotation<2>& r, double time, const Rotation<2>& rate) { r.angle += time * rate.angle; }
void add_to(Rotation<3>& r, double time, const Rotation<3>& rate) { r.q += time * rate.q; }
void mend(Rotation<2>&) {}
void mend(Rotation<3>& r) { r.q = glm::normalize(r.q); }

// The solution of fifth order of Dormand and Prince's pair (dormand_prince.hpp), by six looks.
template <int D>
void dormand_prince(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  const SmoothState<D> start = system.start();
  SmoothState<D> state = start, rates[6];
  for (int stage = 0; stage < 6; ++stage) {
    const Pull<D> pull = system.evaluate(state);
    rates[stage] = state;
    for (const std::size_t i : system.movers()) {
      rates[stage].shift[i] = system.velocity(state, i);
      rates[stage].orientation[i] =
          rate_of(state.orientation[i], system.angular_velocity(state, i));
    }
    rates[stage].kick = pull.acceleration;
    rates[stage].twist = pull.torque;
    system.fly(state, start, h * time_of_stage<double>(stage));  // what no force moves
    for (const std::size_t i : system.movers()) {
      state.shift[i] = state.kick[i] = Vec<D>(0.0);
      state.twist[i] = Spin<D>(0.0);
      if (system.turns(i)) state.orientation[i] = start.orientation[i];
      for (int k = 0; k <= stage; ++k) {
        const double time = h * kDormandPrince[stage][k] / kDormandPrince[stage][6];
        state.shift[i] += time * rates[k].shift[i];
        state.kick[i] += time * rates[k].kick[i];
        state.twist[i] += time * rates[k].twist[i];
        if (system.turns(i)) add_to(state.orientation[i], time, rates[k].orientation[i]);
      }
      if (system.turns(i)) mend(state.orientation[i]);
    }
  }
  lead_to<D>(system, state, h, out);
}
constexpr Integration kDormandPrince5 = {.name = "dormand_prince",
                                         .order = 5,
                                         .of_places = true,
                                         .increments = {dormand_prince<2>, dormand_prince<3>}};

// --- the methods whose forces are those of a moment that is still to be found ---

// Implicit midpoint: the forces are those halfway between the start and the end of the step. The
// first half is a step of implicit Euler, the second repeats its kick. Symplectic and stable at any
// step; the energy of linear springs is kept to rounding (Hairer, Lubich, Wanner, IV.2 and VI.4).
// Velocities, and the way to the middle, are the mean ones where drag is strong (see drag_share).
template <int D>
void implicit_midpoint(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  system.take_means(h);
  const SmoothState<D> middle = implicit_stage(system, h / 2, "implicit_midpoint", h);
  for (const std::size_t i : system.movers()) {
    const Vec<D> half = middle.kick[i];
    const Spin<D> half_twist = middle.twist[i];
    out[i] = {2.0 * half, h * (system.gained(i) - 2) * half, 2.0 * half_twist,
              system.gained_twist(middle, i) - 2.0 * half_twist};
  }
}
constexpr Integration kImplicitMidpoint = {
    .name = "implicit_midpoint",
    .order = 2,
    .lag = 0.5,
    .implicit = true,
    .increments = {implicit_midpoint<2>, implicit_midpoint<3>},
    .with_joints = {constrained_implicit_midpoint<2>, constrained_implicit_midpoint<3>}};

// Implicit Euler: the forces are those at the end of the step. Stable at any step, but it eats the
// energy of every spring (Baraff and Witkin, "Large steps in cloth simulation", 1998; they stop
// after one Newton iteration, this does not).
template <int D>
void implicit_euler(SmoothSystem<D>& system, double h, std::span<Increment<D>> out) {
  const SmoothState<D> end = implicit_stage(system, h, "implicit_euler", h);
  for (const std::size_t i : system.movers())
    out[i] = {end.kick[i], Vec<D>(0.0), end.twist[i], Spin<D>(0.0)};
}
constexpr Integration kImplicitEuler = {
    .name = "implicit_euler",
    .implicit = true,
    .increments = {implicit_euler<2>, implicit_euler<3>},
    .with_joints = {constrained_implicit_euler<2>, constrained_implicit_euler<3>}};

// --- all methods ---

MethodList<Integrator, Integration>& methods() {
  static MethodList<Integrator, Integration> list = {
      &kExplicitEuler,    &kSemiImplicitEuler, &kVelocityVerlet, &kRungeKutta4,
      &kImplicitMidpoint, &kImplicitEuler,     &kKahanLi8,       &kDormandPrince5};
  return list;
}

// Those of the dynamic bodies, each once; the world's own if there are none.
template <int D>
Scratch<Integrator> integrators_of(const WorldConfig<D>& config, std::span<const Body<D>> bodies) {
  Scratch<Integrator> used;
  for (const Body<D>& body : bodies) {
    if (!body.is_dynamic()) continue;
    const Integrator its = body.integrator.value_or(config.integrator);
    if (std::ranges::find(used, its) == used.end()) used.push_back(its);
  }
  if (used.empty()) used.push_back(config.integrator);
  return used;
}

// Whether there is a force, and a body that it could move.
template <int D>
bool any_force(std::span<const Body<D>> bodies, const Forces<D>& forces) {
  const bool on_any = forces.gravity != Vec<D>(0.0) || forces.gravitation > 0 ||
                      !forces.springs.empty() || !forces.pushes.empty();
  return std::ranges::any_of(bodies, [&](const Body<D>& body) {
    if (!body.is_pushed()) return false;
    return on_any || body.linear_drag > 0 || body.angular_drag > 0;
  });
}

}  // namespace

const Integration& integration(Integrator integrator) { return methods()[integrator]; }
Integrator add_integrator(const Integration& method) { return methods().add(method); }
std::string_view to_string(Integrator integrator) { return integration(integrator).name; }
std::optional<Integrator> integrator_named(std::string_view name) { return methods().named(name); }
std::vector<std::string_view> integrator_names() { return methods().names(); }

template <int D>
void find_increments(Integrator integrator, std::span<const Body<D>> bodies,
                     const Forces<D>& forces, double h, Scratch<Increment<D>>& out,
                     std::uint64_t& evaluations) {
  if (!std::isfinite(h) || !(h > 0)) throw Refused(fmt::format("time step {} is not allowed", h));
  SmoothSystem<D> system(bodies, forces, evaluations);
  if (integration(integrator).of_places && system.any_damping())
    throw Refused(fmt::format("{} knows neither drag nor damping", to_string(integrator)));
  out.assign(bodies.size(), Increment<D>{});
  integration(integrator).increments.in<D>()(system, h, out);
}

template <int D>
void find_increments_if_any(const WorldConfig<D>& config, std::span<const Body<D>> bodies,
                            const Forces<D>& forces, double h, Scratch<Increment<D>>& out,
                            WorldWork& work) {
  out.assign(bodies.size(), {});
  if (!any_force(bodies, forces)) return;
  const auto find = [&](Integrator by, std::span<const Body<D>> of, Scratch<Increment<D>>& found) {
    try {
      find_increments<D>(by, of, forces, h, found, work.force_evaluations);
    } catch (const Refused& refused) {
      throw Refused(fmt::format("{} in step {}", refused.what(), work.steps + 1));
    }
  };
  const Scratch<Integrator> used = integrators_of(config, bodies);
  if (used.size() == 1) return find(used[0], bodies, out);
  // No spring ties bodies of different methods (World::add_spring), so those of one method are all
  // that it needs to know: the others stand still meanwhile, as if they slept.
  Scratch<Increment<D>> some;
  for (const Integrator integrator : used) {
    Scratch<Body<D>> its(bodies.begin(), bodies.end());
    for (Body<D>& body : its)
      if (body.is_dynamic() && body.integrator.value_or(config.integrator) != integrator)
        body.asleep = true;
    find(integrator, its, some);
    for (std::size_t i = 0; i < its.size(); ++i)
      if (its[i].is_dynamic() && !its[i].asleep) out[i] = some[i];
  }
}

#define LANTERN_INSTANTIATE(D)                                                                  \
  template void find_increments(Integrator, std::span<const Body<D>>, const Forces<D>&, double, \
                                Scratch<Increment<D>>&, std::uint64_t&);                        \
  template void find_increments_if_any(const WorldConfig<D>&, std::span<const Body<D>>,         \
                                       const Forces<D>&, double, Scratch<Increment<D>>&,        \
                                       WorldWork&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
