// How bodies that touch are parted: bodies that hang together, while a step moves them, and what
// moves them. Each solver is a function and a row that says what it is; comparing two shows the
// difference.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <optional>
#include <utility>

#include "base/scratch.hpp"
#include "physics/body.hpp"
#include "physics/contact/contact_rows.hpp"
#include "physics/integrate/integrator.hpp"
#include "physics/joint/joint_rows.hpp"
#include "physics/methods.hpp"

namespace lantern::physics {

// The state of a body as constraints see it; `axes` are its own.
template <int D>
SolverBody<D> solver_body_of(const Body<D>& body, const Mat<D>& axes) {
  SolverBody<D> solved;
  if (body.moves() && !body.asleep) solved.velocity = body.velocity;
  if (!body.is_dynamic()) {
    if (turns<D>(body.shape)) solved.spin = body.kinematic_spin;
    return solved;
  }
  const bool turning = turns<D>(body.shape);
  const Inertia<D> inverse =
      turning ? world_inverse_inertia(body, axes) : world_inverse_inertia(body);
  if (turning) solved.spin = inverse * body.angular_momentum;
  if (body.asleep) return solved;
  solved.inverse_mass = body.inverse_mass;
  if (body.inverse_inertia != Spin<D>(0.0)) solved.inverse_inertia = inverse;
  return solved;
}

// How far a surface moves because its body turns.
template <int D>
double turning_way(const Body<D>& body, double h) {
  const double radius = turning_reach<D>(body.shape);
  if (radius == 0 || !body.moves() || body.asleep) return 0;
  const Spin<D> spin = angular_velocity(body);
  return radius * std::min(std::sqrt(dot(spin, spin)) * h, std::numbers::pi);
}

template <int D>
Vec<D> velocity_of(const Body<D>& body) {
  return body.moves() && !body.asleep ? body.velocity : Vec<D>(0.0);
}

// How far two bodies may come against each other.
template <int D>
double way_of(const Body<D>& a, const Body<D>& b, double h) {
  return glm::length(velocity_of(b) - velocity_of(a)) * h + turning_way(a, h) + turning_way(b, h);
}

// Two bodies that may touch during the step.
template <int D>
struct IslandPair : Touch<D> {  // what it remembers, and what the step tells
  IslandPair() {}               // NOLINT: see ContactRows
  ContactRows<D> rows;
  double fast = 0;       // what goes farther in a step is located
  bool located = false;  // bouncing or fast: their impacts are located in time
  bool pressed = false;  // solved as a contact; an impact that is located needs no rows
  int rests = 0;         // how often it was located and too slow to bounce
  double slow = 0;       // approaches slower than this are no impacts
  double reach = 0;      // how near they must be to be looked at
  bool touched = false;
  const Manifold<D>* seen = nullptr;   // how they lie, within `reach`; null once they have moved
  const Manifold<D>* found = nullptr;  // the same when the step began
  const Touch<D>* before = nullptr;    // what the step before remembers, if they touched in it
  bool renewed = false;                // the memory is of this step

  // As if nothing of the step had been yet.
  void begin() {
    this->record = {.a = this->record.a, .b = this->record.b, .manifold = {}};
    touched = renewed = false;
    rows.count = 0;
    look_back();
  }
  void look_back() {
    this->seconds = before ? before->seconds : 0;
    seen = found;
  }
  const Contact<D>& remembered() const {
    return renewed || !before ? this->memory : before->memory;
  }
  bool may_press() const { return rows.count > 0; }
  void record_impulses() {
    for (std::size_t i = 0; i < rows.points().size(); ++i) {
      this->record.normal_impulses[i] += rows.room[i].pn;
      this->record.friction_impulses[i] += rows.room[i].pt;
    }
  }
};

template <int D>
struct Island {
  Scratch<Body<D>> bodies;        // by id: those that move together and those that they touch
  Scratch<std::uint32_t> places;  // of the bodies in the world
  Forces<D> forces;               // those that act among them
  Scratch<IslandPair<D>> pairs;   // by ids
  Scratch<JointRows<D>> joints;   // by ids
  Scratch<double> farthest;       // of the bodies, in the step: from where they were
  // Of the sub-step that the joints' impulses are from; 0: of those that the step before has left,
  // see JointRows.
  double joint_seconds = 0;

  // Scratch, kept for its memory.
  Scratch<Mat<D>> axes;               // of the bodies where they are
  Scratch<Rotation<D>> orientations;  // that the axes are of
  Scratch<SolverBody<D>> solver_bodies;
  Scratch<Increment<D>> increments;
  Scratch<Motion<D>> kicked;  // after the forces, before the constraints
  JointBlock<D> joint_block;

  // Only of those that have turned since they were asked for last.
  void find_axes() {
    const bool known = axes.size() == bodies.size();
    axes.resize(bodies.size());
    orientations.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (known && std::memcmp(&orientations[i], &bodies[i].orientation, sizeof(Rotation<D>)) == 0)
        continue;
      axes[i] = axes_of(bodies[i]);
      orientations[i] = bodies[i].orientation;
    }
  }
  void set_solver_bodies() {
    find_axes();
    solver_bodies.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i)
      solver_bodies.push_back(solver_body_of(bodies[i], axes[i]));
  }

  // As the narrow phase sees the body where `find_axes` was asked last.
  Placed<D> placed(std::uint32_t i) const {
    return {bodies[i].shape, bodies[i].position, bodies[i].orientation, axes[i]};
  }

  // The pair's points where its bodies are now, with the impulses of `remembered` scaled; none, and
  // false, if they are farther apart than `margin`.
  bool find_points(IslandPair<D>& pair, double margin, const Contact<D>* remembered, double scale,
                   WorldWork& work) const {
    const Body<D>& a = bodies[pair.rows.a];
    const Body<D>& b = bodies[pair.rows.b];
    pair.rows.count = 0;
    const Manifold<D>* manifold = std::exchange(pair.seen, nullptr);
    std::optional<Manifold<D>> made;
    if (manifold == nullptr || margin != pair.reach) {
      ++work.narrow_tests;
      made = collide<D>(placed(pair.rows.a), placed(pair.rows.b), margin);
      if (!made) return false;
      manifold = &*made;
    }
    pair.rows.set_points(*manifold, a, b, axes[pair.rows.a], axes[pair.rows.b], remembered, scale);
    renew_record(pair.record, *manifold);
    work.contact_points += pair.rows.points().size();
    return true;
  }
};

// What a contact solver does: it moves the island by `h` of the step's `whole` seconds.
template <int D>
struct IslandMove {
  Island<D>& island;
  const WorldConfig<D>& config;
  double h;
  double whole;
  WorldWork& work;
};

// Turns the body freely, as if its angular momentum were more by `lag` meanwhile, by its own method
// or by the world's, and by what its integrator adds to that. False if it does not turn.
template <int D>
bool turn_on(Body<D>& body, const Increment<D>& increment, const Spin<D>& lag, double h,
             RotationMethod worlds) {
  const Spin<D> turning =
      body.kind == BodyKind::kinematic_body ? body.kinematic_spin : body.angular_momentum + lag;
  if (turning == Spin<D>(0.0) && increment.turn == Spin<D>(0.0)) return false;
  turn_freely(body, h, body.rotation.value_or(worlds), lag);
  if (increment.turn != Spin<D>(0.0)) body.orientation = turned(body.orientation, increment.turn);
  return true;
}

// What the bodies' free motion would be: x += h (v + kick) + drift, and so on. Static and kinematic
// bodies, too.
template <int D>
void fly(Body<D>& body, const Increment<D>& increment, double h, RotationMethod worlds,
         WorldWork& work) {
  if (!body.moves() || body.asleep) return;
  if (increment.kick != Vec<D>(0.0)) body.velocity += increment.kick;
  body.position += body.velocity * h;
  if (increment.drift != Vec<D>(0.0)) body.position += increment.drift;
  body.angular_momentum += increment.twist;
  if (body.is_dynamic() && body.inverse_inertia == Spin<D>(0.0)) return;
  if (turn_on(body, increment, increment.lag, h, worlds)) ++work.rotations_integrated;
}

// Moves the island under forces, joints and those of its pairs that are pressed: turns its bodies'
// state into that at the end, and notes in each pair whether it touched and how hard it pressed.
// What is asleep or not dynamic pushes but is not pushed. Counts what it did.
template <int D>
using SolveContacts = void (*)(const IslandMove<D>& move);

struct ContactSolver {
  std::string_view name;
  BothDimensions<SolveContacts> solve = {};
  // Is given the world as a single island: all bodies, all pairs that may touch, for the whole
  // step. Its impacts are not located in time. Others get island by island, from impact to impact.
  bool whole_world = false;
  // After so many steps without touch a pair is said to have parted; at least 1.
  int frames_remembered = 1;
};

const ContactSolver& contact_solver(ContactMethod method);
// One more solver, which outlives all worlds; before any is made. What scenarios call it is its
// name.
ContactMethod add_contact_solver(const ContactSolver& solver);

// Moves the island from impact to impact and on to the end; in between by the solver. At most
// `budget` impacts are located; it shrinks by those that were. `log` is told of them.
template <int D>
void move_through_impacts(const IslandMove<D>& move, const ContactSolver& solver, int& budget,
                          ImpactLog<D>& log);

}  // namespace lantern::physics
