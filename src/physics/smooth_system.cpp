#include "physics/smooth_system.hpp"

#include "physics/body_lookup.hpp"
#include "physics/free_rotation.hpp"

namespace lantern::physics {
namespace {

// At an orientation that need not be the body's.
template <int D>
Spin<D> spin_of(const Body<D>& body, const Rotation<D>& orientation, const Spin<D>& momentum) {
  if constexpr (D == 2) {
    return body.inverse_inertia * momentum;
  } else {
    const glm::dquat q = orientation.q;
    return q * (body.inverse_inertia * (glm::conjugate(q) * momentum));
  }
}

}  // namespace

template <int D>
SmoothSystem<D>::SmoothSystem(std::span<const Body<D>> bodies, const Forces<D>& forces,
                              std::uint64_t& evaluations)
    : bodies_(bodies),
      forces_(forces),
      evaluations_(evaluations),
      moves_(bodies.size(), 0),
      turns_(bodies.size(), 0) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body<D>& body = bodies[i];
    if (body.kind != BodyKind::dynamic_body || body.asleep || !(body.inverse_mass > 0)) continue;
    moves_[i] = 1;
    movers_.push_back(i);
    if (body.linear_drag > 0) any_damping_ = true;
  }
  if (!forces.springs.empty() || !forces.pushes.empty()) {
    const BodyLookup<D> lookup(bodies);
    for (const Spring<D>& spring : forces.springs) {
      ends_.push_back({lookup.index_of(spring.a, "spring"), lookup.index_of(spring.b, "spring")});
      if (spring.damping > 0) any_damping_ = true;
    }
    for (const Push<D>& push : forces.pushes) pushed_.push_back(lookup.index_of(push.body, "push"));
  }
  if (forces.gravitation > 0)
    for (const Body<D>& body : bodies) masses_.push_back(attracting_mass(body));
  find_what_turns();
}

template <int D>
void SmoothSystem<D>::find_what_turns() {
  const Vec<D> centre(0.0);
  for (const std::size_t i : movers_) {
    if (!(bodies_[i].angular_drag > 0)) continue;
    turns_[i] = 1;
    any_damping_ = true;
  }
  for (std::size_t k = 0; k < forces_.springs.size(); ++k) {
    if (forces_.springs[k].at_a != centre) turns_[ends_[k].a] = 1;
    if (forces_.springs[k].at_b != centre) turns_[ends_[k].b] = 1;
  }
  for (std::size_t k = 0; k < pushed_.size(); ++k)
    if (forces_.pushes[k].at != centre) turns_[pushed_[k]] = 1;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!can_be_turned(i)) turns_[i] = 0;
    if (turns_[i] != 0) any_turns_ = true;
  }
}

template <int D>
bool SmoothSystem<D>::can_be_turned(std::size_t i) const {
  return moves_[i] != 0 && bodies_[i].may_turn && bodies_[i].turns_about_every_axis();
}

template <int D>
void SmoothSystem<D>::turn_also(std::size_t i) {
  if (!can_be_turned(i)) return;
  turns_[i] = 1;
  any_turns_ = true;
}

template <int D>
SmoothState<D> SmoothSystem<D>::start() const {
  const std::vector<Vec<D>> none(bodies_.size(), Vec<D>(0.0));
  SmoothState<D> state{none, none, std::vector<Spin<D>>(bodies_.size(), Spin<D>(0.0)), {}};
  for (const Body<D>& body : bodies_) state.orientation.push_back(body.orientation);
  return state;
}

template <int D>
void SmoothSystem<D>::kick(SmoothState<D>& state, const Pull<D>& pull, double time) const {
  for (const std::size_t i : movers_) {
    state.kick[i] = time * pull.acceleration[i];
    if (turns(i)) state.twist[i] = time * pull.torque[i];
  }
}

template <int D>
void SmoothSystem<D>::fly(SmoothState<D>& state, const SmoothState<D>& with, double time) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body<D>& body = bodies_[i];
    if (body.kind == BodyKind::static_body || body.asleep) continue;
    state.shift[i] = time * velocity(with, i);
    // A body that only turns freely still moves the ends of its springs, if any are off its centre;
    // then it is among those that turn, unless it is not to be turned by forces.
    if (turns(i) || !body.may_turn || body.kind == BodyKind::kinematic_body)
      state.orientation[i] = freely_turned(body, body.angular_momentum + with.twist[i], time);
  }
}

template <int D>
Vec<D> SmoothSystem<D>::velocity(const SmoothState<D>& state, std::size_t i) const {
  const Body<D>& body = bodies_[i];
  if (body.kind == BodyKind::static_body || body.asleep) return Vec<D>(0.0);
  return body.velocity + state.kick[i];
}

template <int D>
Spin<D> SmoothSystem<D>::angular_velocity(const SmoothState<D>& state, std::size_t i) const {
  const Body<D>& body = bodies_[i];
  if (body.kind == BodyKind::static_body || body.asleep) return Spin<D>(0.0);
  if (body.kind == BodyKind::kinematic_body) return body.kinematic_spin;
  return spin_of(body, state.orientation[i], body.angular_momentum + state.twist[i]);
}

template <int D>
Spin<D> SmoothSystem<D>::inertia_times(const SmoothState<D>& state, std::size_t i,
                                       const Spin<D>& spin) const {
  if constexpr (D == 2) {
    return spin / bodies_[i].inverse_inertia;
  } else {
    const glm::dquat q = state.orientation[i].q;
    return q * ((glm::conjugate(q) * spin) / bodies_[i].inverse_inertia);
  }
}

// The difference of the places at the start first: far from the origin it is the exact part.
template <int D>
Vec<D> SmoothSystem<D>::between(const SmoothState<D>& state, const Ends& ends) const {
  return (bodies_[ends.b].position - bodies_[ends.a].position) +
         (state.shift[ends.b] - state.shift[ends.a]);
}

template <int D>
Stretch<D> SmoothSystem<D>::stretch(const SmoothState<D>& state, std::size_t spring) const {
  const auto [a, b] = ends_[spring];
  const Spring<D>& s = forces_.springs[spring];
  const auto motion = [&](std::size_t i, bool off_centre) -> EndMotion<D> {
    const Spin<D> spin = off_centre ? angular_velocity(state, i) : Spin<D>(0.0);
    return {state.orientation[i], velocity(state, i), spin};
  };
  return stretched<D>(s, between(state, ends_[spring]), motion(a, s.at_a != Vec<D>(0.0)),
                      motion(b, s.at_b != Vec<D>(0.0)));
}

template <int D>
Pull<D> SmoothSystem<D>::evaluate(const SmoothState<D>& state) {
  Pull<D> pull;
  evaluate(state, pull);
  return pull;
}

template <int D>
void SmoothSystem<D>::evaluate(const SmoothState<D>& state, Pull<D>& pull) {
  ++evaluations_;
  pull.acceleration.assign(bodies_.size(), Vec<D>(0.0));
  pull.torque.assign(bodies_.size(), Spin<D>(0.0));
  for (const std::size_t i : movers_) {
    const Body<D>& body = bodies_[i];
    pull.acceleration[i] = forces_.gravity;
    if (body.linear_drag > 0)
      pull.acceleration[i] -= body.linear_drag * body.inverse_mass * velocity(state, i);
    if (body.angular_drag > 0 && turns(i))
      pull.torque[i] = -body.angular_drag * angular_velocity(state, i);
  }
  const auto apply = [&](std::size_t i, const Vec<D>& arm, const Vec<D>& force) {
    if (moves(i)) pull.acceleration[i] += bodies_[i].inverse_mass * force;
    if (turns(i)) pull.torque[i] += cross(arm, force);
  };
  each_stretch(state, [&](const Ends& ends, const Stretch<D>& s, double) {
    const Vec<D> force = s.tension * s.direction;
    apply(ends.a, s.arm_a, force);
    apply(ends.b, s.arm_b, -force);
  });
  for (std::size_t k = 0; k < pushed_.size(); ++k)
    apply(pushed_[k], forces_.pushes[k].at, forces_.pushes[k].force);
}

template class SmoothSystem<2>;
template class SmoothSystem<3>;

}  // namespace lantern::physics
