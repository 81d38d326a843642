// A bound of how deep the bodies of an island lie in each other when a step ends.
//
// Contacts are looked at where a part of a step begins, and hold to first order: what falls and
// turns meanwhile brings other corners down, and sweeps end early. So after each part the pairs are
// measured. What then lies too deep by little is pushed out where it is, by the least moves in the
// measure of masses, as split impulses are, which leave no velocity. More is the sign of a blow
// that came too late: the part is made anew, half as long.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "geometry/not_finite.hpp"
#include "physics/contact/contact_solver.hpp"

namespace lantern::physics {

struct DepthSettings {
  double strictest = 1e-6;          // units: what an error of 0 asks for
  double spare = 0.5;               // of the error: so much farther than needed is pushed
  double still = 1.0 / 16;          // of the error: what moves by less is where it was
  double shallow = 0.01;            // of the thinner one's thickness: deeper is not pushed but
  double smallest_part = 1.0 / 64;  // of a step is made anew, in parts of it, down to this one
  int most_pushes = 24;             // each after a look at how all lie by then, and
  int most_vain = 3;                // of them, which bring less than a tenth
  std::size_t fewest_sweeps = 64;   // in each, or
  std::size_t most_solved = 20000;  // pairs times sweeps, unless so few bring less than a hundredth
};
inline constexpr DepthSettings kDepthSettings;

template <int D>
class DepthBound {
 public:
  // Pairs may lie as deep as they do now, but should be out if they lie too deep by little.
  DepthBound(Island<D>& island, double wanted, WorldWork& work)
      : island_(island), work_(work), error_(std::max(wanted, kDepthSettings.strictest)) {
    island_.find_axes();
    note_poses();
    for (const IslandPair<D>& pair : island_.pairs) {
      now_.gaps.push_back(least_gap(pair.seen ? *pair.seen : look(pair, pair.reach), pair.reach));
      promised_.push_back(std::max(error_, -now_.gaps.back()));
      wanted_.push_back(promised_.back() - error_ <= shallow(pair) ? error_ : promised_.back());
    }
  }

  // Whether the island, which has been moved, keeps the bound, if need be after some pushes. If not
  // it is to be taken back to where it was, unless this was the `last` try: then what is missed is
  // left so for the rest of the step.
  bool keeps(bool last) {
    for (const Body<D>& body : island_.bodies)
      if (!is_finite(body.position)) return true;  // the step will be refused
    const State begun = now_;
    last |= tired_;
    if (!follow() && settled_) return true;
    settled_ = true;
    double best = HUGE_VAL;
    for (int pushes = 0, vain = 0; pushes < kDepthSettings.most_pushes; ++pushes) {
      const double beyond = worst_beyond(wanted_, false);
      if (!(beyond > 0)) return true;
      settled_ = false;
      if (!last && worst_beyond(promised_, true) > 0) break;
      vain = beyond < 0.9 * best ? 0 : vain + 1;
      if (vain == kDepthSettings.most_vain) break;
      best = std::min(best, beyond);
      push();
    }
    const bool missed = worst_beyond(promised_, false) > 0;
    if (missed && !last) now_ = begun;
    if (missed && !last) return false;
    tired_ |= missed;
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      wanted_[i] = std::max(wanted_[i], -now_.gaps[i]);
    return true;
  }

  // Counts what is missed in the end.
  void end() {
    keeps(true);
    for (std::size_t i = 0; i < promised_.size(); ++i)
      work_.errors_missed += -now_.gaps[i] > promised_[i];
  }

 private:
  using Seen = std::optional<Manifold<D>>;
  struct State {
    Scratch<double> gaps;       // of each pair, no more than it is; below 0 they overlap
    Scratch<Vec<D>> positions;  // of the bodies, where that was, and
    Scratch<Mat<D>> axes;       // how they lay
  };

  struct Way {
    Vec<D> gone{0.0};
    double turned = 0;  // how far its surface
  };

  static double least_gap(const Seen& seen, double most) {
    return seen ? std::min(most, seen->least_separation()) : most;
  }
  Seen look(const IslandPair<D>& pair, double margin) {
    stop_if_asked();
    ++work_.narrow_tests;
    return collide<D>(island_.placed(pair.rows.a), island_.placed(pair.rows.b), margin);
  }
  double shallow(const IslandPair<D>& pair) const {
    return kDepthSettings.shallow *
           thinner(island_.bodies[pair.rows.a], island_.bodies[pair.rows.b]);
  }

  // How much deeper than this the worst pair lies, or than what is shallow beyond it.
  double worst_beyond(const Scratch<double>& depths, bool by_much) const {
    double worst = -HUGE_VAL;
    for (std::size_t i = 0; i < depths.size(); ++i)
      if (const double beyond = -now_.gaps[i] - depths[i]; beyond > worst)
        worst = std::max(worst, beyond - (by_much ? shallow(island_.pairs[i]) : 0));
    return worst;
  }

  // Whether any body has moved. No surface comes nearer to another than both have moved against
  // each other. (Where boxes overlap, depth may be taken along another axis, and jump.)
  bool follow() {
    island_.find_axes();
    bool moved = false;
    ways_.clear();
    for (std::size_t i = 0; i < island_.bodies.size(); ++i) {
      const Body<D>& body = island_.bodies[i];
      const Mat<D> turned = island_.axes[i] - now_.axes[i];
      double turn = 0;
      for (int k = 0; k < D; ++k) turn += glm::dot(turned[k], turned[k]);
      if (turn > 0) turn = turning_reach<D>(body.shape) * std::sqrt(turn);
      ways_.push_back({body.position - now_.positions[i], turn});
      moved |= turn > 0 || body.position != now_.positions[i];
    }
    if (!moved) return false;
    note_poses();
    for (std::size_t i = 0; i < island_.pairs.size(); ++i) {
      const IslandPair<D>& pair = island_.pairs[i];
      const Way &a = ways_[pair.rows.a], &b = ways_[pair.rows.b];
      const double nearer = glm::length(b.gone - a.gone) + a.turned + b.turned;
      double& gap = now_.gaps[i];
      gap -= nearer;
      if (gap > 0 || (nearer <= kDepthSettings.still * error_ && gap >= -wanted_[i])) continue;
      gap = least_gap(look(pair, pair.reach), pair.reach);
    }
    return true;
  }

  void note_poses() {
    now_.axes = island_.axes;
    now_.positions.clear();
    for (const Body<D>& body : island_.bodies) now_.positions.push_back(body.position);
  }

  // Moves bodies out of each other, and none that this might press deeper than they may lie.
  void push() {
    island_.set_solver_bodies();
    auto& bodies = island_.bodies;
    auto& solved = island_.solver_bodies;
    for (JointRows<D>& joint : island_.joints)
      joint.refresh(bodies[joint.a], bodies[joint.b], solved[joint.a], solved[joint.b]);
    const bool closes = island_.joint_block.refresh(island_.joints, solved);
    Scratch<ContactRows<D>> all = rows();
    Sweep sweep{&work_};
    const std::size_t few = kDepthSettings.fewest_sweeps;
    double before = HUGE_VAL;
    for (std::size_t i = 0; i < few || i * all.size() < kDepthSettings.most_solved; ++i) {
      for (JointRows<D>& joint : island_.joints)
        joint.correct_positions(solved[joint.a], solved[joint.b], sweep);
      double missing = 0;
      for (ContactRows<D>& rows : all) missing = std::max(missing, sweep_over(rows));
      if (missing <= kDepthSettings.spare / 2 * error_) break;
      if (i % few == 0 && missing > 0.99 * std::exchange(before, missing)) break;
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!bodies[i].is_pushed()) continue;
      bodies[i].position += solved[i].mean.velocity;
      turn_with_momentum(bodies[i], solved[i].mean.spin);
    }
    if (closes) island_.joint_block.close_gaps(island_.joints, bodies, 1, work_);
    follow();
  }

  // Of pairs that lie too deep, or might by what pushes these. Separations are against how deep
  // they are to lie.
  Scratch<ContactRows<D>> rows() {
    const double near = 2 * (worst_beyond(wanted_, false) + error_);
    const auto& bodies = island_.bodies;
    Scratch<ContactRows<D>> all;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (now_.gaps[i] > near) continue;
      const auto [a, b] = std::pair(island_.pairs[i].rows.a, island_.pairs[i].rows.b);
      const Seen seen = look(island_.pairs[i], near);
      if (!seen) continue;
      ContactRows<D>& rows = all.emplace_back();
      rows.a = a;
      rows.b = b;
      const Mat<D>&axes_a = island_.axes[a], &axes_b = island_.axes[b];
      rows.set_points(*seen, bodies[a], bodies[b], axes_a, axes_b, nullptr, 0);
      rows.refresh(bodies[a], bodies[b], axes_a, axes_b, island_.solver_bodies[a],
                   island_.solver_bodies[b], 0, 0);
      for (ContactPoint<D>& p : rows.points())
        p.separation += wanted_[i] - kDepthSettings.spare * error_;
    }
    return all;
  }

  // Returns by how much the worst of its points lay too deep.
  double sweep_over(ContactRows<D>& rows) {
    SolverBody<D>&a = island_.solver_bodies[rows.a], &b = island_.solver_bodies[rows.b];
    double worst = 0;
    for (ContactPoint<D>& p : rows.points()) {
      if (p.inverse_normal_mass == 0) continue;
      const Vec<D> parting = relative_velocity(a.mean, p.arm_a, b.mean, p.arm_b);
      const double missing = -p.separation - glm::dot(parting, rows.normal), old = p.correction;
      p.correction = std::max(old + missing / p.inverse_normal_mass, 0.0);
      a.correct(-rows.normal * (p.correction - old), p.arm_a);
      b.correct(rows.normal * (p.correction - old), p.arm_b);
      worst = std::max(worst, missing);
      ++work_.normal_rows;
    }
    return worst;
  }

  Island<D>& island_;
  WorldWork& work_;
  double error_;
  State now_;
  Scratch<Way> ways_;                  // of the bodies, since `now_`
  Scratch<double> promised_, wanted_;  // depths of pairs
  bool tired_ = false;                 // a pair was missed in this step
  bool settled_ = false;               // where bodies are, no pair lies too deep
};

}  // namespace lantern::physics
