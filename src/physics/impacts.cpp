#include "physics/impacts.hpp"

#include <algorithm>
#include <cmath>

#include "base/stop.hpp"

namespace lantern::physics {
namespace {

// Newton's law of restitution at all points of a pair at once: those that approach will part with
// the given part of their speed.
template <int D>
void strike(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double restitution,
            WorldWork& work) {
  for (ContactPoint<D>& p : rows.points()) {
    const double parting = glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal);
    p.bounce = parting < 0 ? -restitution * parting : 0;
    p.pn = 0;
    p.pt = Vec<D>(0.0);
    p.separation = p.gap = 0;
  }
  for (int i = 0; i < kImpactSettings.most_point_sweeps; ++i) {
    Sweep sweep;
    rows.solve_velocities(a, b, 1, sweep);
    count(sweep, work);
    if (rows.count == 1 && rows.friction == 0) break;
    if (sweep.change <= kImpactSettings.change * sweep.largest) break;
  }
}

// The sum of impulse times relative velocity.
template <int D>
double power(const ContactRows<D>& rows, const SolverBody<D>& a, const SolverBody<D>& b) {
  double sum = 0;
  for (const ContactPoint<D>& p : rows.points())
    sum += glm::dot(rows.normal * p.pn + p.pt, relative_velocity(a, p.arm_a, b, p.arm_b));
  return sum;
}

template <int D>
void blend(SolverBody<D>& to, const SolverBody<D>& from, double share) {
  to.velocity = from.velocity + (to.velocity - from.velocity) * share;
  to.spin = from.spin + (to.spin - from.spin) * share;
  to.twist = from.twist + (to.twist - from.twist) * share;
}

// With friction, Newton's law may give energy (Kane and Levinson, "Dynamics", 1985). Without
// restitution it never does. Between the two blows the energy is a parabola,
//
//   E(s) = E0 + s (p.v0) + s^2 (p.v1 - p.v0) / 2      p: the second blow's impulses less the
//   first's
//
// and the pair gets as much of its restitution as leaves E no higher than before the blow. Impulses
// stay within the cone of friction, which is convex.
template <int D>
void take_back_gained_energy(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b,
                             const SolverBody<D>& old_a, const SolverBody<D>& old_b,
                             WorldWork& work) {
  const double size = std::abs(power(rows, old_a, old_b));
  const double gained = (power(rows, old_a, old_b) + power(rows, a, b)) / 2;
  if (!(gained > kImpactSettings.gain_by_rounding * size)) return;
  ContactRows<D> dead_rows = rows;
  SolverBody<D> dead_a = old_a, dead_b = old_b;
  strike(dead_rows, dead_a, dead_b, 0, work);
  const double lost = -(power(dead_rows, old_a, old_b) + power(dead_rows, dead_a, dead_b)) / 2;
  ContactRows<D> more = rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows.count); ++i) {
    more.room[i].pn -= dead_rows.room[i].pn;
    more.room[i].pt -= dead_rows.room[i].pt;
  }
  const double slope = power(more, dead_a, dead_b);
  const double bend = power(more, a, b) - slope;
  // s of bend s^2 / 2 + slope s = lost, in the form that does not cancel.
  const double root = std::sqrt(slope * slope + 2 * bend * std::max(lost, 0.0));
  const double share =
      slope + root > 0 ? std::clamp(2 * std::max(lost, 0.0) / (slope + root), 0.0, 1.0) : 0;
  blend(a, dead_a, share);
  blend(b, dead_b, share);
  for (std::size_t i = 0; i < static_cast<std::size_t>(rows.count); ++i) {
    rows.room[i].pn = dead_rows.room[i].pn + more.room[i].pn * share;
    rows.room[i].pt = dead_rows.room[i].pt + more.room[i].pt * share;
  }
}

// Returns whether there was a blow: points that approach.
template <int D>
bool resolve(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double restitution,
             double slow, WorldWork& work) {
  bool approaches = false;
  for (const ContactPoint<D>& p : rows.points())
    approaches |= glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal) < -slow;
  if (!approaches) return false;
  const SolverBody<D> old_a = a, old_b = b;
  strike(rows, a, b, restitution, work);
  if (restitution > 0 && rows.friction > 0) take_back_gained_energy(rows, a, b, old_a, old_b, work);
  return true;
}

// Sets up the points of all pairs that touch now.
template <int D>
std::vector<std::size_t> touching_pairs(Island<D>& island, WorldWork& work) {
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < island.pairs.size(); ++i) {
    stop_if_asked();
    IslandPair<D>& pair = island.pairs[i];
    const Body<D>& a = island.bodies[pair.rows.a];
    const Body<D>& b = island.bodies[pair.rows.b];
    const double near = kImpactSettings.touching * thinner(a, b);
    if (!island.find_points(pair, near, nullptr, 0, work)) continue;
    pair.rows.refresh(a, b, island.axes[pair.rows.a], island.axes[pair.rows.b],
                      island.solver_bodies[pair.rows.a], island.solver_bodies[pair.rows.b], 0, 0);
    touching.push_back(i);
  }
  return touching;
}

// What had come to rest in this step, and was struck by a third body, may bounce again. (As a
// contact it would stop the body that was sent back.)
template <int D>
void let_struck_go(Island<D>& island) {
  const auto struck = [&](std::uint32_t i, double slow) {
    const Vec<D> change = island.solver_bodies[i].velocity - island.bodies[i].velocity;
    return island.bodies[i].kind == BodyKind::dynamic_body && glm::length(change) > slow;
  };
  for (IslandPair<D>& pair : island.pairs)
    if (pair.rests > 0 && pair.rests < kImpactSettings.most_rests && pair.rows.restitution > 0 &&
        (struck(pair.rows.a, pair.slow) || struck(pair.rows.b, pair.slow)))
      pair.pressed = false;
}

// All pairs that touch and approach get the impulses of an impact, one pair after another until
// none approaches: so the blow runs through a row of balls. Pairs between which it does not come to
// an end become contacts. Returns how many impacts there were.
template <int D>
int resolve_impacts(Island<D>& island, WorldWork& work) {
  island.set_solver_bodies();
  const std::vector<std::size_t> touching = touching_pairs(island, work);
  int impacts = 0;
  bool any = true;
  for (int round = 0; any && round < kImpactSettings.most_rounds; ++round) {
    any = false;
    // A blow that does not come to its end is ended without restitution.
    const bool tired = round >= kImpactSettings.bouncing_rounds;
    for (const std::size_t i : touching) {
      stop_if_asked();
      IslandPair<D>& pair = island.pairs[i];
      const double restitution = tired ? 0 : pair.rows.restitution;
      if (!resolve(pair.rows, island.solver_bodies[pair.rows.a], island.solver_bodies[pair.rows.b],
                   restitution, pair.slow, work))
        continue;
      pair.record_impulses();
      pair.touched = true;
      if (tired) {  // squeezed: nor may it bounce in the sub-steps that follow
        pair.pressed = true;
        pair.rows.restitution = 0;
      }
      ++impacts;
      any = true;
    }
  }
  if (impacts > 0) let_struck_go(island);
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    if (island.bodies[i].kind != BodyKind::dynamic_body) continue;
    island.bodies[i].velocity = island.solver_bodies[i].velocity;
    island.bodies[i].angular_momentum += island.solver_bodies[i].twist;
  }
  return impacts;
}

// Bodies that rest on others do not fall while something comes: only the free ones are accelerated.
template <int D>
std::vector<Trajectory<D>> trajectories(const Island<D>& island, const WorldConfig<D>& config,
                                        double within) {
  std::vector<Trajectory<D>> all;
  for (std::size_t i = 0; i < island.bodies.size(); ++i) {
    const Body<D>& body = island.bodies[i];
    const Increment<D>& free = island.increments[i];
    Trajectory<D> path{&body, body.moves() ? body.velocity : Vec<D>(0.0), Vec<D>(0.0)};
    path.rotation = body.rotation.value_or(config.rotation);
    if (body.asleep) path.velocity = Vec<D>(0.0);
    path.bend = free.kick / within + free.drift / (within * within);
    all.push_back(path);
  }
  for (const IslandPair<D>& pair : island.pairs)
    if (pair.pressed)
      for (const std::uint32_t i : {pair.rows.a, pair.rows.b}) {
        all[i].held = glm::length(island.increments[i].kick) / within;
        all[i].bend = Vec<D>(0.0);
      }
  return all;
}

template <int D>
struct Impact {
  double time = 0;
  IslandPair<D>* pair = nullptr;
};

// The next impact. Pairs that meet too slowly become contacts on the way.
template <int D>
std::optional<Impact<D>> next_impact(Island<D>& island, const WorldConfig<D>& config, double within,
                                     double step, WorldWork& work, ImpactLog<D>& log) {
  std::vector<ImpactLook<D>>* const looks = log.keeps_looks ? &log.looks : nullptr;
  const std::vector<Trajectory<D>> flying = trajectories(island, config, within);
  std::optional<Impact<D>> first;
  for (IslandPair<D>& pair : island.pairs) {
    stop_if_asked();
    const Trajectory<D>& a = flying[pair.rows.a];
    const Trajectory<D>& b = flying[pair.rows.b];
    pair.slow = slowest_impact(a, b, step);
    if (!pair.located || pair.pressed) continue;
    const auto met =
        time_of_impact(a, b, within, pair.slow, pair.reach, work, looks, step - within);
    if (!met) continue;
    if (met->rests) {
      pair.pressed = true;
      ++pair.rests;
    } else if (!first || met->seconds < first->time)
      first = Impact<D>{met->seconds, &pair};
  }
  return first;
}

// The bodies of the pair are where they meet, `time` seconds after the step began.
template <int D>
ImpactMoment<D> moment_of(const Island<D>& island, const IslandPair<D>& pair, double time) {
  const auto pose = [&](std::uint32_t place) {
    const Body<D>& body = island.bodies[place];
    return Pose<D>{body.id, body.position, body.orientation};
  };
  return {time, pose(pair.rows.a), pose(pair.rows.b)};
}

}  // namespace

template <int D>
void move_through_impacts(Island<D>& island, const ContactSolver<D>& solver,
                          const WorldConfig<D>& config, double h, int& budget, WorldWork& work,
                          ImpactLog<D>& log) {
  double left = h;
  const bool any_located = std::any_of(island.pairs.begin(), island.pairs.end(),
                                       [](const auto& pair) { return pair.located; });
  while (any_located) {
    find_increments_if_any<D>(config, island.bodies, island.forces, left, island.increments, work);
    const auto next = next_impact(island, config, left, h, work, log);
    if (!next) break;
    if (budget <= 0) {  // the rest of the step is soft for all
      for (IslandPair<D>& pair : island.pairs) pair.pressed = true;
      break;
    }
    if (next->time > 0) solver.solve(island, config, next->time, h, work);
    left -= next->time;
    log.moments.push_back(moment_of(island, *next->pair, h - left));
    const int impacts = resolve_impacts(island, work);
    work.impacts_located += static_cast<std::uint64_t>(impacts);
    budget -= std::max(impacts, 1);
    if (impacts == 0) next->pair->pressed = true;  // others have moved its bodies off their way
    for (IslandPair<D>& pair : island.pairs)       // what does not bounce stays
      if (pair.touched && pair.rows.restitution == 0) pair.pressed = true;
    if (!(left > 0)) return;
  }
  solver.solve(island, config, left, h, work);
}

template void move_through_impacts(Island<2>&, const ContactSolver<2>&, const WorldConfig<2>&,
                                   double, int&, WorldWork&, ImpactLog<2>&);
template void move_through_impacts(Island<3>&, const ContactSolver<3>&, const WorldConfig<3>&,
                                   double, int&, WorldWork&, ImpactLog<3>&);

}  // namespace lantern::physics
