// Impacts: bodies that bounce or are fast meet at the very moment, not at the end of a step.
#include <algorithm>
#include <cmath>

#include "base/stop.hpp"
#include "physics/impact/time_of_impact.hpp"

namespace lantern::physics {
namespace {

template <int D>
struct Impact {
  double time = 0;
  IslandPair<D>* pair = nullptr;
};

// A bounce that would end within a small share of `step` seconds is none. So a ball that bounces
// lower and lower comes to rest after finitely many impacts. This is the speed of such a bounce.
template <int D>
double slowest_impact(const Trajectory<D>& a, const Trajectory<D>& b, double step) {
  const double pull = 2 * glm::length(b.bend - a.bend) + a.held + b.held;
  return std::max(
      pull * step * kImpactSettings.shortest_bounce,
      kImpactSettings.speed_by_rounding * (glm::length(a.velocity) + glm::length(b.velocity)));
}

template <int D>
class ImpactMotion {
 public:
  ImpactMotion(const IslandMove<D>& move, const ContactSolver& solver, int& budget,
               ImpactLog<D>& log)
      : move_(move), island_(move.island), solver_(solver), budget_(budget), log_(log) {}

  void run() {
    double left = move_.h;
    const bool any_located = std::ranges::any_of(island_.pairs, &IslandPair<D>::located);
    while (any_located) {
      find_increments_if_any<D>(move_.config, island_.bodies, island_.forces, left,
                                island_.increments, move_.work);
      const auto next = next_impact(left);
      if (!next) break;
      if (budget_ <= 0) {  // the rest of the step is soft for all
        for (IslandPair<D>& pair : island_.pairs) pair.pressed = true;
        break;
      }
      if (next->time > 0) solve(next->time);
      left -= next->time;
      const ContactRows<D>& met = next->pair->rows;
      log_.moments.push_back(
          {move_.h - left, pose(island_.bodies[met.a]), pose(island_.bodies[met.b])});
      const int impacts = resolve_impacts();
      move_.work.impacts_located += static_cast<std::uint64_t>(impacts);
      budget_ -= std::max(impacts, 1);
      if (impacts == 0) next->pair->pressed = true;  // others have moved its bodies off their way
      for (IslandPair<D>& pair : island_.pairs)      // what does not bounce stays
        if (pair.touched && pair.rows.restitution == 0) pair.pressed = true;
      if (!(left > 0)) return;
    }
    solve(left);
  }

 private:
  void solve(double seconds) {
    solver_.solve.in<D>()({island_, move_.config, seconds, move_.whole, move_.work});
  }

  // Newton's law of restitution at all points of a pair at once: those that approach will part with
  // the given part of their speed.
  void strike(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double restitution) {
    for (ContactPoint<D>& p : rows.points()) {
      const double parting = glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal);
      p.bounce = parting < 0 ? -restitution * parting : 0;
      p.pn = 0;
      p.pt = Vec<D>(0.0);
      p.separation = p.gap = 0;
    }
    for (int i = 0; i < kImpactSettings.most_point_sweeps; ++i) {
      Sweep sweep{&move_.work};
      rows.solve_velocities(a, b, 1, sweep);
      if (rows.count == 1 && rows.friction == 0) break;
      if (sweep.change <= kImpactSettings.change * sweep.largest) break;
    }
  }

  // The sum of impulse times relative velocity.
  static double power(const ContactRows<D>& rows, const SolverBody<D>& a, const SolverBody<D>& b) {
    double sum = 0;
    for (const ContactPoint<D>& p : rows.points())
      sum += glm::dot(rows.normal * p.pn + p.pt, relative_velocity(a, p.arm_a, b, p.arm_b));
    return sum;
  }

  static void blend(SolverBody<D>& to, const SolverBody<D>& from, double share) {
    to.velocity = from.velocity + (to.velocity - from.velocity) * share;
    to.spin = from.spin + (to.spin - from.spin) * share;
    to.twist = from.twist + (to.twist - from.twist) * share;
  }

  // With friction, Newton's law may give energy (Kane and Levinson, "Dynamics", 1985). Without
  // restitution it never does. Between the two blows the energy is a parabola,
  //
  //   E(s) = E0 + s (p.v0) + s^2 (p.v1 - p.v0) / 2      p: the second blow's
  //   impulses less the first's
  //
  // and the pair gets as much of its restitution as leaves E no higher than before the blow.
  // Impulses stay within the cone of friction, which is convex.
  void take_back_gained_energy(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b,
                               const SolverBody<D>& old_a, const SolverBody<D>& old_b) {
    const double size = std::abs(power(rows, old_a, old_b));
    const double gained = (power(rows, old_a, old_b) + power(rows, a, b)) / 2;
    if (!(gained > kImpactSettings.gain_by_rounding * size)) return;
    ContactRows<D> dead_rows = rows;
    SolverBody<D> dead_a = old_a, dead_b = old_b;
    strike(dead_rows, dead_a, dead_b, 0);
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
  bool resolve(ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b, double restitution,
               double slow) {
    bool approaches = false;
    for (const ContactPoint<D>& p : rows.points())
      approaches |= glm::dot(relative_velocity(a, p.arm_a, b, p.arm_b), rows.normal) < -slow;
    if (!approaches) return false;
    const SolverBody<D> old_a = a, old_b = b;
    strike(rows, a, b, restitution);
    if (restitution > 0 && rows.friction > 0) take_back_gained_energy(rows, a, b, old_a, old_b);
    return true;
  }

  // Sets up the points of all pairs that touch now.
  std::vector<std::size_t> touching_pairs() {
    std::vector<std::size_t> touching;
    for (std::size_t i = 0; i < island_.pairs.size(); ++i) {
      stop_if_asked();
      IslandPair<D>& pair = island_.pairs[i];
      const Body<D>& a = island_.bodies[pair.rows.a];
      const Body<D>& b = island_.bodies[pair.rows.b];
      const double near = kImpactSettings.touching * thinner(a, b);
      if (!island_.find_points(pair, near, nullptr, 0, move_.work)) continue;
      pair.rows.refresh(a, b, island_.axes[pair.rows.a], island_.axes[pair.rows.b],
                        island_.solver_bodies[pair.rows.a], island_.solver_bodies[pair.rows.b], 0,
                        0);
      touching.push_back(i);
    }
    return touching;
  }

  // What had come to rest in this step, and was struck by a third body, may bounce again. (As a
  // contact it would stop the body that was sent back.)
  void let_struck_go() {
    const auto struck = [&](std::uint32_t i, double slow) {
      const Vec<D> change = island_.solver_bodies[i].velocity - island_.bodies[i].velocity;
      return island_.bodies[i].is_dynamic() && glm::length(change) > slow;
    };
    for (IslandPair<D>& pair : island_.pairs)
      if (pair.rests > 0 && pair.rests < kImpactSettings.most_rests && pair.rows.restitution > 0 &&
          (struck(pair.rows.a, pair.slow) || struck(pair.rows.b, pair.slow)))
        pair.pressed = false;
  }

  // All pairs that touch and approach get the impulses of an impact, one pair after another until
  // none approaches: so the blow runs through a row of balls. Pairs between which it does not come
  // to an end become contacts. Returns how many impacts there were.
  int resolve_impacts() {
    island_.set_solver_bodies();
    const std::vector<std::size_t> touching = touching_pairs();
    int impacts = 0;
    bool any = true;
    for (int round = 0; any && round < kImpactSettings.most_rounds; ++round) {
      any = false;
      // A blow that does not come to its end is ended without restitution.
      const bool tired = round >= kImpactSettings.bouncing_rounds;
      for (const std::size_t i : touching) {
        stop_if_asked();
        IslandPair<D>& pair = island_.pairs[i];
        const double restitution = tired ? 0 : pair.rows.restitution;
        if (!resolve(pair.rows, island_.solver_bodies[pair.rows.a],
                     island_.solver_bodies[pair.rows.b], restitution, pair.slow))
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
    if (impacts > 0) let_struck_go();
    for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
      if (!island_.bodies[i].is_dynamic()) continue;
      island_.bodies[i].velocity = island_.solver_bodies[i].velocity;
      island_.bodies[i].angular_momentum += island_.solver_bodies[i].twist;
    }
    return impacts;
  }

  // Bodies that rest on others do not fall while something comes: only the free ones are
  // accelerated.
  std::vector<Trajectory<D>> trajectories(double within) const {
    std::vector<Trajectory<D>> all;
    for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
      const Body<D>& body = island_.bodies[i];
      const Increment<D>& free = island_.increments[i];
      Trajectory<D> path{&body, body.moves() ? body.velocity : Vec<D>(0.0), Vec<D>(0.0)};
      path.rotation = body.rotation.value_or(move_.config.rotation);
      if (body.asleep) path.velocity = Vec<D>(0.0);
      path.bend = free.kick / within + free.drift / (within * within);
      all.push_back(path);
    }
    for (const IslandPair<D>& pair : island_.pairs)
      if (pair.pressed)
        for (const std::uint32_t i : {pair.rows.a, pair.rows.b}) {
          all[i].held = glm::length(island_.increments[i].kick) / within;
          all[i].bend = Vec<D>(0.0);
        }
    return all;
  }

  // The next impact. Pairs that meet too slowly become contacts on the way.
  std::optional<Impact<D>> next_impact(double within) {
    std::vector<ImpactLook<D>>* const looks = log_.keeps_looks ? &log_.looks : nullptr;
    const std::vector<Trajectory<D>> flying = trajectories(within);
    std::optional<Impact<D>> first;
    for (IslandPair<D>& pair : island_.pairs) {
      stop_if_asked();
      const Trajectory<D>& a = flying[pair.rows.a];
      const Trajectory<D>& b = flying[pair.rows.b];
      pair.slow = slowest_impact(a, b, move_.h);
      if (!pair.located || pair.pressed) continue;
      const auto met = time_of_impact<D>(
          {a, b, within, pair.slow, pair.reach, move_.work, looks, move_.h - within});
      if (!met) continue;
      if (met->rests) {
        pair.pressed = true;
        ++pair.rests;
      } else if (!first || met->seconds < first->time)
        first = Impact<D>{met->seconds, &pair};
    }
    return first;
  }

  const IslandMove<D>& move_;
  Island<D>& island_;
  const ContactSolver& solver_;
  int& budget_;
  ImpactLog<D>& log_;
};

}  // namespace

template <int D>
void move_through_impacts(const IslandMove<D>& move, const ContactSolver& solver, int& budget,
                          ImpactLog<D>& log) {
  ImpactMotion<D>(move, solver, budget, log).run();
}

template void move_through_impacts(const IslandMove<2>&, const ContactSolver&, int&, ImpactLog<2>&);
template void move_through_impacts(const IslandMove<3>&, const ContactSolver&, int&, ImpactLog<3>&);

}  // namespace lantern::physics
