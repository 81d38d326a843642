// Blows upon bodies that joints hold: the joints act in the same moment.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/scratch.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/impact/time_of_impact.hpp"

namespace lantern::physics {

// Of a blow with restitution and one without, between which the energy is E0 + slope s + bend
// s^2/2: the share s of the first that gives back the energy that the second has `lost`, at most
// all. In the form that does not cancel.
inline double share_of_bounce(double slope, double bend, double lost) {
  const double root = std::sqrt(slope * slope + 2 * bend * lost);
  return slope + root > 0 ? std::clamp(2 * lost / (slope + root), 0.0, 1.0) : 0;
}

// Impulses p at contact points, each with those of all joints, after which no joint parts:
//
//   u = u0 + W p     W = C M^-1 C^T - C M^-1 J^T (J M^-1 J^T)^-1 J M^-1 C^T
//
// C: rows of the points that are struck, J: those of the island's joints, which are factored once.
// A column of W is what a point's impulse gives to bodies at rest and joints then leave of it. Of
// all pairs that approach at a time, Newton's law of restitution and the cone of friction are
// satisfied together, by sweeps over W: what strikes alike at both ends comes back alike.
template <int D>
class JointedBlow {
 public:
  // With the island's solver bodies as they are; their velocities no longer part joints. Nothing is
  // held if there are no joints, or if they are too much work (see JointBlock).
  JointedBlow(Island<D>& island, WorldWork& work)
      : island_(island), work_(work), held_(island.bodies.size()) {
    if (island.joints.empty()) return;
    for (JointRows<D>& joint : island.joints)
      joint.find_gap(island.bodies[joint.a], island.bodies[joint.b]);
    if (!island.joint_block.refresh(island.joints, island.solver_bodies)) return;
    for (const JointRows<D>& joint : island.joints)
      for (const std::uint32_t i : {joint.a, joint.b})
        held_[i] = island.solver_bodies[i].inverse_mass > 0;
    hold(island.solver_bodies);
  }

  bool holds(const ContactRows<D>& rows) const { return held_[rows.a] || held_[rows.b]; }

  // To be struck with the next ones; so many rows are struck at once.
  void add(IslandPair<D>& pair) {
    const ContactRows<D>& of = pair.rows;
    const SolverBody<D>&a = island_.solver_bodies[of.a], &b = island_.solver_bodies[of.b];
    for (ContactPoint<D>& p : pair.rows.points()) {
      const auto add_row = [&](const Vec<D>& along) {
        rows_.push_back({of.a, of.b, a.inverse_mass, b.inverse_mass});
        rows_.back().set(along, p.arm_a, a.inverse_inertia, p.arm_b, b.inverse_inertia);
      };
      const std::size_t first = rows_.size();
      add_row(of.normal);
      if (of.friction > 0) std::ranges::for_each(tangents(of.normal), add_row);
      points_.push_back({&pair, &p, first, rows_.size()});
    }
    if (rows_.size() >= kImpactSettings.most_together) strike();
  }

  // Strikes all that were added, and forgets them.
  void strike() {
    if (points_.empty()) return;
    find_answers();
    begun_ = speeds(island_.solver_bodies);
    solve(true);
    take_back_gained_energy();
    apply_rows(rows_, impulses_, island_.solver_bodies, false);
    hold(island_.solver_bodies);
    for (const Point& p : points_) {
      p.point->pn = impulses_[p.row];
      p.point->pt = Vec<D>(0.0);
      for (std::size_t r = p.row + 1; r < p.end; ++r)
        p.point->pt += rows_[r].direction * impulses_[r];
    }
    for (const Point& p : points_)
      if (p.point == p.of->rows.room.data()) p.of->record_impulses();
    points_.clear();
    rows_.clear();
  }

 private:
  struct Point {
    IslandPair<D>* of = nullptr;
    ContactPoint<D>* point = nullptr;
    std::size_t row = 0, end = 0;  // its normal's, and those across it, if there is friction
  };

  // Joints that say the same twice are solved with a compliance, so they are solved again.
  void hold(Scratch<SolverBody<D>>& bodies) {
    for (int i = 0; i < kImpactSettings.joint_rounds; ++i)
      island_.joint_block.stop_parting(island_.joints, bodies, false, work_);
  }

  Scratch<double> speeds(const Scratch<SolverBody<D>>& bodies) const {
    Scratch<double> all;
    for (const ConstraintRow<D>& row : rows_) {
      const SolverBody<D>&a = bodies[row.a], &b = bodies[row.b];
      all.push_back(glm::dot(row.direction, b.velocity - a.velocity) +
                    (dot(row.turn_b, b.spin) - dot(row.turn_a, a.spin)));
    }
    return all;
  }

  void find_answers() {
    Scratch<SolverBody<D>> still = island_.solver_bodies;
    for (SolverBody<D>& body : still) static_cast<Motion<D>&>(body) = {};
    answers_.clear();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      Scratch<SolverBody<D>> pushed = still;
      impulses_.assign(rows_.size(), 0.0);
      impulses_[r] = 1;
      apply_rows(rows_, impulses_, pushed, false);
      hold(pushed);
      answers_.push_back(speeds(pushed));
      // What joints do not let go does not answer.
      double& own = answers_[r][r];
      if (!(own > kJointSettings.least_part * rows_[r].answer_to(rows_[r]))) own = 0;
    }
  }

  double bounce_of(const Point& p) const {
    return bounces_ ? p.of->rows.restitution * std::max(-begun_[p.row], 0.0) : 0;
  }

  // Impulses that satisfy all points: a guess, which sweeps mend.
  void solve(bool bounces) {
    bounces_ = bounces;
    guess();
    for (int i = 0; i < kImpactSettings.most_jointed_sweeps; ++i) {
      stop_if_asked();
      change_ = largest_ = 0;
      for (const Point& p : points_) press(p);
      for (const Point& p : points_) rub(p);
      if (change_ <= kImpactSettings.change * largest_) break;
    }
  }

  // As if all points stuck, but for those that would pull; then within their cones. Rows that say
  // the same twice are given a compliance, and so solved again.
  void guess() {
    factor_.clear();
    for (std::size_t r = 0; r < rows_.size(); ++r) factor_.add_line(0);
    Scratch<std::uint8_t> holds(rows_.size());
    for (std::size_t r = 0; r < rows_.size(); ++r) holds[r] = answers_[r][r] > 0;
    const auto matrix = [&](std::size_t i, std::size_t j) {
      if (i == j) return holds[i] ? answers_[i][i] * (1 + kJointSettings.compliance) : 1.0;
      return holds[i] && holds[j] ? answers_[i][j] : 0.0;
    };
    for (bool pulls = true; std::exchange(pulls, false);) {
      impulses_.assign(rows_.size(), 0.0);
      speeds_ = begun_;
      if (!factor_.factor(matrix)) return;
      count_direct_solve(rows_.size(), work_);
      for (int i = 0; i < kImpactSettings.joint_rounds; ++i) {
        Scratch<double> missing(rows_.size());
        for (const Point& p : points_)
          for (std::size_t r = p.row; r < p.end; ++r)
            missing[r] = holds[r] ? (r == p.row ? bounce_of(p) : 0) - speeds_[r] : 0;
        factor_.solve(missing);
        for (std::size_t r = 0; r < rows_.size(); ++r) change(r, impulses_[r] + missing[r]);
      }
      for (const Point& p : points_) {
        if (!(impulses_[p.row] < 0)) continue;
        pulls = true;
        for (std::size_t r = p.row; r < p.end; ++r) holds[r] = false;
      }
    }
    for (const Point& p : points_) change_across(p, impulses_);
  }

  // By the largest answer that there may be with the friction that follows: so none overshoots.
  void press(const Point& p) {
    double answer = answers_[p.row][p.row], across = 0;
    if (!(answer > 0)) return;
    for (std::size_t r = p.row + 1; r < p.end; ++r)
      across += answers_[p.row][r] * answers_[p.row][r];
    answer += p.of->rows.friction * std::sqrt(across);
    const double missing = bounce_of(p) - speeds_[p.row];
    change(p.row, std::max(impulses_[p.row] + missing / answer, 0.0));
    ++work_.normal_rows;
  }

  // By a bound of the largest answer across the normal.
  void rub(const Point& p) {
    double answer = 0;
    for (std::size_t r = p.row + 1; r < p.end; ++r)
      for (std::size_t s = p.row + 1; s < p.end; ++s) answer += answers_[r][s] * answers_[r][s];
    if (!(answer > 0)) return;
    Scratch<double> wanted = impulses_;
    for (std::size_t r = p.row + 1; r < p.end; ++r) wanted[r] -= speeds_[r] / std::sqrt(answer);
    change_across(p, wanted);
    work_.friction_rows += D - 1;
  }

  // To what is wanted, or to the edge of the cone.
  void change_across(const Point& p, const Scratch<double>& wanted) {
    double length = 0;
    for (std::size_t r = p.row + 1; r < p.end; ++r) length += wanted[r] * wanted[r];
    const double most = p.of->rows.friction * impulses_[p.row];
    const double share = length > most * most ? most / std::sqrt(length) : 1;
    for (std::size_t r = p.row + 1; r < p.end; ++r) change(r, wanted[r] * share);
  }

  void change(std::size_t row, double to) {
    const double by = to - impulses_[row];
    impulses_[row] = to;
    for (std::size_t s = 0; s < speeds_.size(); ++s) speeds_[s] += answers_[row][s] * by;
    change_ = std::max(change_, std::abs(by));
    largest_ = std::max(largest_, std::abs(to));
  }

  static double product(const Scratch<double>& x, const Scratch<double>& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
    return sum;
  }
  double gained() const { return (product(impulses_, begun_) + product(impulses_, speeds_)) / 2; }

  // As of two bodies, see impacts.cpp; without friction, too: a point that parts may be pressed.
  void take_back_gained_energy() {
    const double size = std::abs(product(impulses_, begun_));
    if (!(gained() > kImpactSettings.gain_by_rounding * size)) return;
    const Scratch<double> bounced = speeds_;
    Scratch<double> more = impulses_;
    solve(false);
    for (std::size_t r = 0; r < more.size(); ++r) more[r] -= impulses_[r];
    const double slope = product(more, speeds_), bend = product(more, bounced) - slope;
    const double share = share_of_bounce(slope, bend, std::max(-gained(), 0.0));
    for (std::size_t r = 0; r < more.size(); ++r) impulses_[r] += more[r] * share;
  }

  Island<D>& island_;
  WorldWork& work_;
  Scratch<std::uint8_t> held_;  // bodies, by joints
  Scratch<Point> points_;
  Scratch<ConstraintRow<D>> rows_;             // C
  Scratch<Scratch<double>> answers_;           // W
  Scratch<double> begun_, speeds_, impulses_;  // u0, u, p
  EnvelopeSystem factor_;
  bool bounces_ = false;
  double change_ = 0, largest_ = 0;  // of impulses, in a sweep
};

}  // namespace lantern::physics
