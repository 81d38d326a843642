// A contact solver of one's own, in one file: springs push out what overlaps (the penalty method).
// Scenarios of a program that adds it may say contacts = "penalty".
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <lantern/physics/contact/contact_solver.hpp>
#include <lantern/physics/world.hpp>

using namespace lantern::physics;

namespace {

//! [solver]
constexpr double kStiffness = 4000, kDamping = 40;  // N a unit, N s a unit

template <int D>
void penalty(const IslandMove<D>& move) {
  Island<D>& island = move.island;
  find_increments_if_any<D>(move.config, island.bodies, island.forces, move.h, island.increments,
                            move.work);
  island.set_solver_bodies();
  for (IslandPair<D>& pair : island.pairs) {
    if (!pair.pressed || !island.find_points(pair, 0, nullptr, 0, move.work)) continue;
    pair.touched = true;
    SolverBody<D>& a = island.solver_bodies[pair.rows.a];
    SolverBody<D>& b = island.solver_bodies[pair.rows.b];
    const Vec<D> normal = pair.rows.normal;
    for (const ManifoldPoint<D>& point : pair.record.manifold.points()) {
      const Vec<D> arm_a = point.position - island.bodies[pair.rows.a].position;
      const Vec<D> arm_b = point.position - island.bodies[pair.rows.b].position;
      const double parting = glm::dot(relative_velocity(a, arm_a, b, arm_b), normal);
      const double force = -kStiffness * point.separation - kDamping * parting;
      const Vec<D> impulse = normal * (std::max(force, 0.0) * move.h);
      a.apply(-impulse, arm_a);
      b.apply(impulse, arm_b);
    }
  }
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    Increment<D>& increment = island.increments[i];
    const Vec<D> before = island.bodies[i].velocity;
    if (island.bodies[i].is_pushed()) increment.kick += island.solver_bodies[i].velocity - before;
    increment.twist += island.solver_bodies[i].twist;
    fly(island.bodies[i], increment, move.h, move.config.rotation, move.work);
  }
}

const ContactSolver kPenalty = {.name = "penalty", .solve = {penalty<2>, penalty<3>}};
//! [solver]

}  // namespace

int main() {
  const ContactMethod mine = add_contact_solver(kPenalty);
  if (contact_method_named("penalty") != mine) return 1;
  World<2> world({.gravity = {0, -10}, .contacts = mine, .may_sleep = false});
  world.add({.shape = HalfSpace<2>{{0, 1}}, .kind = BodyKind::static_body});
  const BodyId ball = world.add({.shape = Sphere{0.5}, .position = {0, 1}, .mass = 2});
  for (int i = 0; i < 1000; ++i) world.step(1.0 / 500);
  // The floor's spring carries 2 kg at 10 m / s^2.
  const double sunk = 0.5 - world.find(ball)->position.y;
  std::printf("the ball has sunk in by %.6f\n", sunk);
  return std::abs(sunk - 2 * 10 / kStiffness) < 1e-4 && world.contacts().size() == 1 ? 0 : 1;
}
