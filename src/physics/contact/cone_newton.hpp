// All rows of an island at once, whatever presses, sticks or slips in the end: what needs no guess.
//
// It is the method of multipliers (Rockafellar, Math. Oper. Res. 1, 1976; for contacts Alart and
// Curnier, Comput. Methods Appl. Mech. Eng. 92, 1991). Each impulse is what is allowed, nearest to
// what a stiff spring would add to the last one:
//
//   p = P(p_last - k (u - wanted))      u: relative velocities
//   M (v - v_free) = J^T p              P: onto the cone of friction; of a joint all is allowed
//
// The velocities v are the minimum of a convex function. Newton's method with a search along each
// line finds it from anywhere; its matrix has a block for each body and for each two that touch.
// Rows that say the same twice, as the corners of a face do, do no harm. What can be at rest is.
//
// What slips would part by it, as fast as mu times its slip. So much more is asked of its approach
// (De Saxce and Feng, Math. Comput. Modelling 28, 1998), by the slip of the solve before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/scratch.hpp"
#include "physics/contact/sub_step.hpp"
#include "physics/integrate/block_system.hpp"

namespace lantern::physics {

struct ConeNewtonSettings {
  std::size_t most_bytes = std::size_t{1} << 23;  // for one factor: some 1e8 products
  // Of springs, against the mass that each moves: at first and at most, by how much they are made
  // stiffer when Newton's method came to its end, and softer when it did not.
  double softest = 1e2, stiffest = 1e6, stiffer = 10, softer = 100;
  // Rounds of Newton's method, each with a factor: where joints hold bodies, which slip together,
  // and elsewhere; and for the same springs.
  int most_rounds_jointed = 150, most_rounds = 60, some_rounds = 30;
  double flat = 0.1;  // of the slope at its start: where a search along a line ends
  double shortest = 1e-6;
  // How much may be missing. Velocity, squared: of what is missing at first, and of the largest
  // that an impulse gives.
  double enough = 1e-8, rounding = 1e-24;
  // Of the largest impulse: before what slips is asked for more approach, and in the end; there
  // also of what would stop the fastest slip.
  double converged = 1e-8, solved = 1e-11, slides = 1e-5;
  double sticks = 1e-10;  // of its impulse: what would stop a point that slips by rounding only
};
inline constexpr ConeNewtonSettings kConeNewtonSettings;

template <int D>
class ConeNewton {
 public:
  // Impulses that satisfy all rows, applied. False, with nothing changed, if that is too much work
  // or if no end of it is found.
  bool solve(SubStep<D>& step) {
    Island<D>& island = step.island;
    list(island, step.h);
    if (!plan(island.bodies.size())) return false;
    stiffness_ = kConeNewtonSettings.softest;
    double& k = stiffness_;
    double share = 1, last_missing = std::numeric_limits<double>::infinity();
    int left = island.joints.empty() ? kConeNewtonSettings.most_rounds
                                     : kConeNewtonSettings.most_rounds_jointed;
    while (left > 0) {
      const int rounds = descend(step.work);
      left -= rounds > 0 ? rounds : kConeNewtonSettings.some_rounds;
      if (rounds == 0) {
        k = std::max(k / kConeNewtonSettings.softer, 1.0);
        continue;
      }
      for (std::size_t i = 0; i < holds_.size(); ++i) holds_[i].last = answers_[i].impulse;
      if (missing_part() <= kConeNewtonSettings.converged) {
        const double slip = shift(share);
        const double missing = missing_part();
        if (missing <= std::max(kConeNewtonSettings.solved, kConeNewtonSettings.slides * slip)) {
          apply(island);
          return true;
        }
        share = missing > last_missing / 2 ? 0.5 : 1;
        last_missing = missing;
      }
      k = std::min(k * kConeNewtonSettings.stiffer, kConeNewtonSettings.stiffest);
    }
    return false;
  }

 private:
  static constexpr int kFreedoms = D == 2 ? 3 : 6;
  // Velocities of a body, each divided by the root of what gives way to it, so that M is 1. What
  // cannot be moved or turned does not answer.
  using Freedoms = std::array<double, kFreedoms>;
  using Rows = std::array<double, D>;
  using System = BlockSystem<kFreedoms>;

  // A contact point or a joint.
  struct Hold {
    std::uint32_t a = 0, b = 0;
    ContactPoint<D>* point = nullptr;  // of a contact; null for a joint
    JointRows<D>* joint = nullptr;
    Vec<D> arm_a{0.0}, arm_b{0.0};
    int width = 1;                                 // in rows
    std::array<Vec<D>, D> along = {};              // of each row: for a contact first the normal
    std::array<Freedoms, D> of_a = {}, of_b = {};  // how bodies answer to it
    double friction = 0;
    double mass = 0;       // effective, of the row that moves most easily
    Rows first{}, last{};  // impulses, at the beginning and now
    Rows error{};          // relative velocity beyond the wanted one
    double shift = 0;      // of the normal one, see above
    bool linked = false;   // two bodies that both move
  };

  // Of a hold to its error.
  struct Answer {
    Rows impulse{};
    SmallMatrix<D> grip{};  // how it follows the error, as a part of the stiffness
  };

  static double squared_across(const Rows& rows) {
    double sum = 0;
    for (int r = 1; r < D; ++r) sum += rows[r] * rows[r];
    return sum;
  }
  static double dot(const Freedoms& x, const Freedoms& y) {
    double sum = 0;
    for (int f = 0; f < kFreedoms; ++f) sum += x[f] * y[f];
    return sum;
  }
  static double product(const Scratch<Freedoms>& x, const Scratch<Freedoms>& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += dot(x[i], y[i]);
    return sum;
  }

  void list(Island<D>& island, double h) {
    holds_.clear();
    for (JointRows<D>& joint : island.joints) {
      Hold hold{.a = joint.a, .b = joint.b, .joint = &joint};
      hold.width = joint.width();
      for (int r = 0; r < hold.width; ++r) {
        hold.along[r] = joint.joint.kind == JointKind::pin ? unit_vec<D>(r) : joint.direction;
        hold.first[r] = glm::dot(joint.impulse, hold.along[r]);
      }
      add(island, hold, joint);
    }
    for (IslandPair<D>& pair : island.pairs)
      for (ContactPoint<D>& p : pair.rows.points()) {
        Hold hold{.a = pair.rows.a, .b = pair.rows.b, .point = &p};
        hold.along[0] = pair.rows.normal;
        std::ranges::copy(tangents(pair.rows.normal), hold.along.begin() + 1);
        hold.error[0] = p.gap / h - p.bounce;
        hold.first[0] = p.pn;
        if (pair.rows.friction > 0 && p.inverse_tangent_mass > 0) {
          hold.width = D;
          hold.friction = pair.rows.friction;
          for (int r = 1; r < D; ++r) hold.first[r] = glm::dot(p.pt, hold.along[r]);
        }
        add(island, hold, p);
      }
  }

  template <class Arms>
  void add(const Island<D>& island, Hold& hold, const Arms& arms) {
    hold.arm_a = arms.arm_a;
    hold.arm_b = arms.arm_b;
    hold.last = hold.first;
    const SolverBody<D>&a = island.solver_bodies[hold.a], &b = island.solver_bodies[hold.b];
    const Vec<D> u = relative_velocity(a, hold.arm_a, b, hold.arm_b);
    double most = 0;
    for (int r = 0; r < hold.width; ++r) {
      hold.error[r] += glm::dot(u, hold.along[r]);
      hold.of_a[r] = freedoms(island, hold.a, -hold.along[r], hold.arm_a);
      hold.of_b[r] = freedoms(island, hold.b, hold.along[r], hold.arm_b);
      most = std::max(most, dot(hold.of_a[r], hold.of_a[r]) + dot(hold.of_b[r], hold.of_b[r]));
    }
    if (!(most > 0)) return;
    hold.mass = 1 / most;
    hold.linked = a.inverse_mass > 0 && b.inverse_mass > 0;
    holds_.push_back(hold);
  }

  static Freedoms freedoms(const Island<D>& island, std::uint32_t i, const Vec<D>& push,
                           const Vec<D>& arm) {
    Freedoms f{};
    if (island.solver_bodies[i].inverse_mass == 0) return f;
    const Spin<D> turn = cross(arm, push);
    for (int k = 0; k < D; ++k) f[k] = push[k] * std::sqrt(island.solver_bodies[i].inverse_mass);
    for (int k = D; k < kFreedoms; ++k) {
      const double root = std::sqrt(spin_component(island.bodies[i].inverse_inertia, k - D));
      if constexpr (D == 2)
        f[k] = turn * root;
      else
        f[k] = glm::dot(turn, island.axes[i][k - D]) * root;
    }
    return f;
  }

  // The order of elimination, unless the last one was of the same links.
  bool plan(std::size_t bodies) {
    Scratch<typename System::Link> links;
    for (const Hold& hold : holds_)
      if (hold.linked) links.push_back({hold.a, hold.b});
    if (!system_ || links != links_ || x_.size() != bodies)
      system_ = System::planned(bodies, links, kConeNewtonSettings.most_bytes);
    links_ = std::move(links);
    x_.assign(bodies, Freedoms{});
    return system_.has_value();
  }

  static Answer answer(const Hold& hold, const Rows& error, double stiffness) {
    Answer to;
    Rows& p = to.impulse;
    for (int r = 0; r < hold.width; ++r) {
      p[r] = hold.last[r] - stiffness * hold.mass * (error[r] + (r == 0 ? hold.shift : 0));
      to.grip[r * D + r] = 1;
    }
    if (hold.joint != nullptr) return to;
    const double mu = hold.friction, square = squared_across(p), across = std::sqrt(square);
    if (mu * across <= -p[0]) return {};
    if (across <= mu * p[0]) return to;
    const double pressure = (p[0] + mu * across) / (1 + mu * mu), kept = mu * pressure / across;
    Rows edge{1};  // of the cone
    for (int r = 1; r < D; ++r) edge[r] = mu * p[r] / across;
    for (int r = 0; r < D; ++r)
      for (int c = 0; c < D; ++c) {
        double& grip = to.grip[r * D + c];
        grip = edge[r] * edge[c] / (1 + mu * mu);
        if (r > 0 && c > 0) grip += kept * ((r == c ? 1 : 0) - p[r] * p[c] / square);
      }
    for (int r = 0; r < D; ++r) p[r] = pressure * edge[r];
    return to;
  }

  // Answers of all holds, and how much velocity they are beyond the bodies' own.
  void respond() {
    missing_ = x_;
    for (Freedoms& missing : missing_)
      for (double& value : missing) value = -value;
    answers_.resize(holds_.size());
    largest_ = fastest_squared_ = 0;
    for (std::size_t i = 0; i < holds_.size(); ++i) {
      const Hold& hold = holds_[i];
      answers_[i] = answer(hold, hold.error, stiffness_);
      for (int r = 0; r < hold.width; ++r) {
        const double impulse = answers_[i].impulse[r], gain = impulse - hold.first[r];
        largest_ = std::max(largest_, std::abs(impulse));
        fastest_squared_ = std::max(fastest_squared_, impulse * impulse / hold.mass);
        for (int f = 0; f < kFreedoms; ++f) {
          missing_[hold.a][f] += hold.of_a[r][f] * gain;
          missing_[hold.b][f] += hold.of_b[r][f] * gain;
        }
      }
    }
  }

  bool factor(WorldWork& work) {
    system_->clear();
    for (std::size_t i = 0; i < x_.size(); ++i)
      for (int f = 0; f < kFreedoms; ++f) system_->add(i, f, f, 1);
    std::size_t rows = 0;
    for (std::size_t i = 0; i < holds_.size(); ++i) {
      if (answers_[i].grip == SmallMatrix<D>{}) continue;
      add_to_system(holds_[i], answers_[i].grip);
      rows += static_cast<std::size_t>(holds_[i].width);
    }
    count_direct_solve(rows, work);
    return system_->factor();
  }

  void add_to_system(const Hold& hold, const SmallMatrix<D>& grip) {
    const double stiffness = stiffness_ * hold.mass;
    for (int r = 0; r < hold.width; ++r)
      for (int c = 0; c < hold.width; ++c)
        for (int f = 0; f < kFreedoms; ++f)
          for (int g = 0; g < kFreedoms; ++g) {
            const double k = stiffness * grip[r * D + c];
            system_->add(hold.a, f, g, k * hold.of_a[r][f] * hold.of_a[c][g]);
            system_->add(hold.b, f, g, k * hold.of_b[r][f] * hold.of_b[c][g]);
            if (hold.linked)
              system_->add(hold.a, hold.b, f, g, k * hold.of_a[r][f] * hold.of_b[c][g]);
          }
  }

  // Newton's method. In how many rounds it came to its end; 0 if it did not. Each goes all the way,
  // or so much less that the function no longer rises there.
  int descend(WorldWork& work) {
    respond();
    const double enough = std::max(kConeNewtonSettings.enough * product(missing_, missing_),
                                   kConeNewtonSettings.rounding * fastest_squared_);
    for (int round = 1; round <= kConeNewtonSettings.some_rounds; ++round) {
      if (!factor(work)) return 0;
      way_ = missing_;
      system_->solve(way_);
      const double flat = kConeNewtonSettings.flat * product(way_, missing_);
      double share = 1;
      for (go(share); product(way_, missing_) < -flat && share > kConeNewtonSettings.shortest;) {
        share /= 2;
        go(-share);
      }
      if (share == 1 && product(missing_, missing_) <= enough) return round;
    }
    return 0;
  }

  void go(double share) {
    for (std::size_t i = 0; i < x_.size(); ++i)
      for (int f = 0; f < kFreedoms; ++f) x_[i][f] += share * way_[i][f];
    for (Hold& hold : holds_)
      for (int r = 0; r < hold.width; ++r)
        hold.error[r] +=
            share * (dot(hold.of_a[r], way_[hold.a]) + dot(hold.of_b[r], way_[hold.b]));
    respond();
  }

  // Of the largest impulse: how far any is from what is allowed nearest to it without its error.
  double missing_part() const {
    double change = 0;
    for (const Hold& hold : holds_) {
      const Answer to = answer(hold, hold.error, 1);
      for (int r = 0; r < hold.width; ++r)
        change = std::max(change, std::abs(to.impulse[r] - hold.last[r]));
    }
    return largest_ > 0 ? change / largest_ : 0;
  }

  // Asks for more approach of what slips. Of the largest impulse: what would stop the fastest slip.
  double shift(double share) {
    double slip = 0;
    for (Hold& hold : holds_) {
      const double now = hold.friction * std::sqrt(squared_across(hold.error));
      hold.shift += share * (now - hold.shift);
      slip = std::max(slip, now * hold.mass);
    }
    return largest_ > 0 ? slip / largest_ : 0;
  }

  void apply(Island<D>& island) {
    for (const Hold& hold : holds_) {
      Vec<D> impulse(0.0);
      for (int r = 0; r < hold.width; ++r)
        impulse += hold.along[r] * (hold.last[r] - hold.first[r]);
      island.solver_bodies[hold.a].apply(-impulse, hold.arm_a);
      island.solver_bodies[hold.b].apply(impulse, hold.arm_b);
      if (hold.joint != nullptr) {
        hold.joint->impulse += impulse;
        continue;
      }
      hold.point->pn = hold.last[0];
      hold.point->pt += impulse - hold.along[0] * (hold.last[0] - hold.first[0]);
      hold.point->sticks = std::sqrt(squared_across(hold.error)) * hold.mass <=
                           kConeNewtonSettings.sticks * hold.last[0];
    }
  }

  double stiffness_ = 0;
  double largest_ = 0, fastest_squared_ = 0;  // impulse, and velocity that one gives
  std::optional<System> system_;
  Scratch<typename System::Link> links_;  // which it is planned for
  Scratch<Hold> holds_;
  Scratch<Answer> answers_;
  Scratch<Freedoms> x_, missing_, way_;  // of each body: velocity gained, missing, added next
};

}  // namespace lantern::physics
