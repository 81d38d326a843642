// All rows of an island at once, by Cholesky factors. Sweeps need about n^2 rounds for a stack of n
// boxes and about r for a mass ratio of r; this needs one, if it knows which contacts press and
// which of them stick. A few sweeps make a guess at that; what turns out to pull or to slip is let
// go, and the rest is solved again (an active set, as in Dantzig's method: Baraff, "Fast Contact
// Force Computation for Nonpenetrating Rigid Bodies", 1994).
//
// That is quick, and may find no end, or friction that is not mu times what presses in the end.
// Where the sweeps after it still change impulses, and this matters, all is found from anywhere by
// Newton's method on the cone of friction (cone_newton.hpp).
//
//   K dp = wanted - u     K = J M^-1 J^T: how relative velocities u answer to impulses dp
//
// K links only rows that share a body. Rows lie in order of their pairs' ids.
//
// Two bodies have no more than 6 freedoms against each other, 3 in 2D, but the corners of a face
// that hold have 12 conditions. Such a contact is solved as a weld: a force and a torque at its
// middle. What they do to each corner is then shared out with the least squares.
#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>

#include "base/scratch.hpp"
#include "physics/contact/cone_newton.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/contact/sub_step.hpp"
#include "physics/integrate/block_system.hpp"

namespace lantern::physics {
namespace {

// The numbers of the direct solve.
struct DirectSettings {
  // Sweeps of a sub-step, if they do not end earlier: more for small islands, which are cheap.
  int fewest_sweeps = 24, most_sweeps = 256;
  int most_solved = 2048;  // pairs times sweeps
  // What slips or presses must be known before all is solved at once. A guess whose last change was
  // less than this part of the largest impulse is good; and what presses less counts for nothing.
  double good_guess = 0.05;
  double presses = 0.01;
  double unsettled_joints = 1e-4;  // of the largest impulse, where what joints hold moves
  // The same, see `is_unsettled`: in whole steps, where no set of rows held; and in parts of a
  // step, of which the next one mends what sweeps leave.
  double unsettled = 2e-3, unsettled_parts = 1e-4;
  int most_guesses = 6;    // each lets go of what the last one found to pull or to slip
  double most_work = 4e6;  // products, for one factor: a few milliseconds
  // Rows that say the same twice have no factor without a little compliance. What it leaves undone
  // is so small a part of the impulses.
  double compliance = 1e-10;
  double least_spread = 1e-6;  // a contact whose corners lie nearly in a line is no weld
};
constexpr DirectSettings kDirectSettings;

template <int D>
class DirectSolve {
 public:
  explicit DirectSolve(bool whole_steps) : whole_steps_(whole_steps) {}

  // Finds the impulses of a sub-step that has begun, and corrects its positions.
  void settle(SubStep<D>& step) {
    const auto pairs = static_cast<int>(step.island.pairs.size() + step.island.joints.size());
    const int most = std::clamp(kDirectSettings.most_solved / pairs, kDirectSettings.fewest_sweeps,
                                kDirectSettings.most_sweeps);
    bool settled = false;
    Sweep sweep{&step.work};
    for (int i = 0; i < most; ++i) {
      sweep = step.sweep_velocities(i);
      const double enough = settled ? kRowSettings.no_matter : kRowSettings.change;
      if (sweep.change <= enough * sweep.largest) break;
      if (is_due(step, i + 1, most, sweep)) settled = solve_velocities(step);
    }
    bool factored = settled;
    if (!gave_up_ && is_unsettled(step, sweep, settled)) {
      gave_up_ = !newton_.solve(step);
      settled |= !gave_up_;
      // To rounding, if what holds is certain.
      if (!gave_up_) factored = solve_velocities(step);
    }
    step.begin_position_correction();
    if (settled && correct_positions(step, factored)) return;
    for (int i = 0; i < most; ++i) {
      if (step.is_corrected(step.sweep_positions(), sweep.largest)) return;
      // Two did not do: all at once. What slips is done with already and does not matter here.
      if (i == 1 && correct_positions(step, false)) return;
    }
  }

 private:
  static constexpr int kFreedoms = D == 2 ? 3 : 6;
  using Wrench = std::array<double, kFreedoms>;  // a force, and a torque over the contact's size

  // One direction of a contact point or of a joint. It has its share of `width` rows.
  struct RowPart {
    std::uint32_t a = 0, b = 0;
    ContactPoint<D>* point = nullptr;  // of a contact; null for a joint
    JointRows<D>* joint = nullptr;
    Vec<D> arm_a{0.0}, arm_b{0.0};
    Vec<D> direction{0.0};
    double most = 0;   // friction coefficient
    int tangent = -1;  // which of the tangents; -1: a normal or a joint's
    std::size_t row = 0;
    int width = 1;
    Wrench share{1};
    double gain = 0;  // of impulse, that is found
  };

  // Impulses for velocities that satisfy the rows that press, applied. False, with nothing changed,
  // if there are none, if it would take too much work, or if no set of rows is found that holds
  // together.
  bool solve_velocities(SubStep<D>& step) {
    Island<D>& island = step.island;
    keep_guess(island);
    for (int round = 0; round < kDirectSettings.most_guesses; ++round) {
      list_rows(island);
      if (rows_.empty() || !factor(island)) break;
      count_direct_solve(rows_.size(), step.work);
      find_gains([&](const RowPart& part) {
        const Vec<D> u = relative_velocity(island.solver_bodies[part.a], part.arm_a,
                                           island.solver_bodies[part.b], part.arm_b);
        double wanted = 0;
        if (part.point != nullptr && part.tangent < 0)
          wanted = part.point->bounce - part.point->gap / step.h;
        return wanted - glm::dot(u, part.direction);
      });
      if (let_go(island)) continue;
      apply_rows(rows_, values_, island.solver_bodies, false);
      for (const RowPart& part : parts_) {
        const Vec<D> impulse = part.direction * part.gain;
        if (part.joint != nullptr)
          part.joint->impulse += impulse;
        else if (part.tangent < 0)
          part.point->pn += part.gain;
        else
          part.point->pt += impulse;
      }
      return true;
    }
    take_guess_back(island);
    return false;
  }

  // The same rows for mean velocities, after they were solved for velocities. If they were not (not
  // `factored`), all rows that press. False, with nothing changed, if some would pull.
  bool correct_positions(SubStep<D>& step, bool factored) {
    Island<D>& island = step.island;
    if (!factored) {
      list_rows(island);
      if (rows_.empty() || !factor(island)) return false;
    }
    count_direct_solve(rows_.size(), step.work);
    find_gains([&](const RowPart& part) {
      const Vec<D> u = relative_velocity(island.solver_bodies[part.a].mean, part.arm_a,
                                         island.solver_bodies[part.b].mean, part.arm_b);
      const double wanted = part.joint != nullptr ? 0  // see JointRows
                            : part.tangent < 0    ? part.point->wanted_mean_speed(step.h)
                                               : glm::dot(part.point->wanted_slip, part.direction);
      return wanted - glm::dot(u, part.direction);
    });
    for (const RowPart& part : parts_)
      if (part.point != nullptr && part.tangent < 0 &&
          part.point->correction + part.gain < -part.point->pn)
        return false;
    apply_rows(rows_, values_, island.solver_bodies, true);
    for (const RowPart& part : parts_)
      if (part.point != nullptr && part.tangent < 0) part.point->correction += part.gain;
    return true;
  }

  // All at once after 2, 4, 8 ... sweeps, never last. Where something slips, a guess that is good
  // already is left alone: friction that lags behind would only spoil it. Of four corners of a face
  // three are enough, so that one may press next to nothing and slip: that does not count.
  bool is_due(SubStep<D>& step, int sweeps, int most, const Sweep& last) const {
    if (sweeps < 2 || sweeps >= most || !std::has_single_bit(static_cast<unsigned>(sweeps)))
      return false;
    bool slips = false;
    step.each_pair([&](const ContactRows<D>& rows, auto&, auto&) {
      for (const ContactPoint<D>& p : rows.points())
        slips |= rows.friction > 0 && p.pn > kDirectSettings.presses * last.largest && !p.sticks;
    });
    return !slips || last.change > kDirectSettings.good_guess * last.largest;
  }

  // After the last sweep. Where none moved faster than forces make them in a sub-step, and less so
  // where joints hold bodies, all hangs on what sweeps leave undone. Elsewhere the next ones mend
  // it.
  bool is_unsettled(const SubStep<D>& step, const Sweep& last, bool settled) const {
    const Island<D>& island = step.island;
    double fastest = 0, kick = 0;
    for (std::size_t i = 0; i < island.bodies.size(); ++i) {
      fastest = std::max(fastest, glm::length(velocity_of(island.bodies[i])));
      kick = std::max(kick, glm::length(island.increments[i].kick));
    }
    const bool hangs = !island.joints.empty(), rests = fastest <= kick;
    if (!hangs && !rests) return false;
    const bool exact = hangs || (settled && whole_steps_);
    const double enough = hangs && !rests ? kDirectSettings.unsettled_joints
                          : exact         ? kRowSettings.no_matter
                          : whole_steps_  ? kDirectSettings.unsettled
                                          : kDirectSettings.unsettled_parts;
    return last.change > enough * last.largest;
  }

  void list_rows(Island<D>& island) {
    rows_.clear();
    parts_.clear();
    for (JointRows<D>& joint : island.joints) list_joint(island, joint);
    for (IslandPair<D>& pair : island.pairs) list_contact(island, pair.rows);
  }

  void list_joint(const Island<D>& island, JointRows<D>& joint) {
    RowPart part{
        .a = joint.a, .b = joint.b, .joint = &joint, .arm_a = joint.arm_a, .arm_b = joint.arm_b};
    const std::size_t first = parts_.size();
    const bool pin = joint.joint.kind == JointKind::pin;
    for (int i = 0; i < joint.width() && (pin || joint.inverse_mass > 0); ++i) {
      part.direction = pin ? unit_vec<D>(i) : joint.direction;
      parts_.push_back(part);
    }
    add_rows_of_their_own(island, first);
  }

  void list_contact(const Island<D>& island, ContactRows<D>& contact) {
    const auto across = tangents(contact.normal);
    const std::size_t first = parts_.size();
    for (ContactPoint<D>& point : contact.points()) {
      if (!(point.pn > 0) || !(point.inverse_normal_mass > 0)) continue;
      RowPart part{.a = contact.a,
                   .b = contact.b,
                   .point = &point,
                   .arm_a = point.arm_a,
                   .arm_b = point.arm_b,
                   .direction = contact.normal};
      parts_.push_back(part);
      if (contact.friction == 0 || !point.sticks) continue;
      part.most = contact.friction;
      for (const Vec<D>& tangent : across) {
        ++part.tangent;
        part.direction = tangent;
        parts_.push_back(part);
      }
    }
    if (first < parts_.size() && !add_weld(island, first)) add_rows_of_their_own(island, first);
  }

  void add_row(const Island<D>& island, std::uint32_t a, std::uint32_t b, const Vec<D>& direction,
               const Spin<D>& turn_a, const Spin<D>& turn_b) {
    const SolverBody<D>&body_a = island.solver_bodies[a], &body_b = island.solver_bodies[b];
    rows_.push_back({a, b, body_a.inverse_mass, body_b.inverse_mass, direction, turn_a, turn_b,
                     body_a.inverse_inertia * turn_a, body_b.inverse_inertia * turn_b});
  }

  void add_rows_of_their_own(const Island<D>& island, std::size_t first_part) {
    for (std::size_t i = first_part; i < parts_.size(); ++i) {
      RowPart& part = parts_[i];
      part.row = rows_.size();
      add_row(island, part.a, part.b, part.direction, cross(part.arm_a, part.direction),
              cross(part.arm_b, part.direction));
    }
  }

  // The wrench w of a part about the middle is its impulse times the column g. Of all gains that
  // give the weld's wrench W, those with the least squares are gains = G^T (G G^T)^-1 W; and where
  // the parts want different things of the weld, (G G^T)^-1 G is the least squares' way between
  // them. So the shares (G G^T)^-1 g serve both ways.
  bool add_weld(const Island<D>& island, std::size_t first_part) {
    const std::span<RowPart> parts{parts_.data() + first_part, parts_.size() - first_part};
    const std::uint32_t a = parts[0].a, b = parts[0].b;
    const auto turns = [&](std::uint32_t body) {
      return island.solver_bodies[body].inverse_mass != 0 &&
             island.bodies[body].turns_about_every_axis();
    };
    if (parts.size() <= kFreedoms || (!turns(a) && !turns(b))) return false;
    Vec<D> middle_a(0.0), middle_b(0.0);
    for (const RowPart& part : parts) {
      middle_a += part.arm_a / static_cast<double>(parts.size());
      middle_b += part.arm_b / static_cast<double>(parts.size());
    }
    double size = 0;
    for (const RowPart& part : parts) size = std::max(size, glm::length(part.arm_a - middle_a));
    if (!(size > 0)) return false;

    SmallMatrix<kFreedoms> square{};
    for (RowPart& part : parts) {
      const Spin<D> torque = cross(part.arm_a - middle_a, part.direction);
      for (int k = 0; k < kFreedoms; ++k)
        part.share[k] = k < D ? part.direction[k] : spin_component(torque, k - D) / size;
      for (int r = 0; r < kFreedoms; ++r)
        for (int c = 0; c <= r; ++c) square[r * kFreedoms + c] += part.share[r] * part.share[c];
    }
    if (!factor_small<kFreedoms>(square, kDirectSettings.least_spread)) {
      for (RowPart& part : parts) part.share = {1};
      return false;
    }
    for (RowPart& part : parts) {
      solve_lower<kFreedoms>(square, part.share);
      solve_upper<kFreedoms>(square, part.share);
      part.width = kFreedoms;
      part.row = rows_.size();
    }
    for (int k = 0; k < D; ++k) {
      const Vec<D> axis = unit_vec<D>(k);
      add_row(island, a, b, axis, cross(middle_a, axis), cross(middle_b, axis));
    }
    for (int k = D; k < kFreedoms; ++k) {
      const Spin<D> turn = size * unit_spin<D>(k - D);
      add_row(island, a, b, Vec<D>(0.0), turn, turn);
    }
    return true;
  }

  bool factor(const Island<D>& island) {
    return plan(rows_, island.solver_bodies.size(), system_, kDirectSettings.most_work) &&
           factor_compliant(rows_, kDirectSettings.compliance, system_);
  }

  // The gains of all parts after which nothing is missing; missing(part) is the velocity along it.
  template <class Missing>
  void find_gains(Missing&& missing) {
    values_.assign(rows_.size(), 0.0);
    for (const RowPart& part : parts_) {
      const double wanted = missing(part);
      for (int k = 0; k < part.width; ++k)
        values_[part.row + static_cast<std::size_t>(k)] += part.share[k] * wanted;
    }
    system_.solve(values_);
    for (RowPart& part : parts_) {
      part.gain = 0;
      for (int k = 0; k < part.width; ++k)
        part.gain += part.share[k] * values_[part.row + static_cast<std::size_t>(k)];
    }
  }

  // Whether, with the new impulses, contacts pull or slip; those are let go.
  bool let_go(Island<D>& island) {
    bool any = false;
    for (std::size_t i = 0; i < parts_.size();) {
      const RowPart& part = parts_[i];
      std::size_t next = i + 1;
      if (part.point == nullptr) {
        i = next;
        continue;
      }
      ContactPoint<D>& p = *part.point;
      const double pn = p.pn + part.gain;
      Vec<D> pt = p.pt;
      double most = -1;
      for (; next < parts_.size() && parts_[next].point == &p; ++next) {
        pt += parts_[next].direction * parts_[next].gain;
        most = parts_[next].most * pn;
      }
      if (!(pn > 0)) {
        const Vec<D> impulse = part.direction * p.pn + p.pt;
        island.solver_bodies[part.a].apply(impulse, part.arm_a);
        island.solver_bodies[part.b].apply(-impulse, part.arm_b);
        p.pn = 0;
        p.pt = Vec<D>(0.0);
        any = true;
      } else if (most >= 0 && glm::length(pt) > most * (1 + kRowSettings.slip_by_rounding)) {
        p.sticks = false;
        any = true;
      }
      i = next;
    }
    return any;
  }

  void keep_guess(Island<D>& island) {
    kept_bodies_ = island.solver_bodies;
    kept_.clear();
    for (const IslandPair<D>& pair : island.pairs)
      for (const ContactPoint<D>& p : pair.rows.points()) kept_.push_back(p);
  }

  void take_guess_back(Island<D>& island) {
    island.solver_bodies = kept_bodies_;
    auto kept = kept_.begin();
    for (IslandPair<D>& pair : island.pairs)
      for (ContactPoint<D>& p : pair.rows.points()) p = *kept++;
  }

  bool whole_steps_;
  ConeNewton<D> newton_;
  bool gave_up_ = false;  // in a sub-step before of the same step
  Scratch<ConstraintRow<D>> rows_;
  Scratch<RowPart> parts_;
  EnvelopeSystem system_;
  Scratch<double> values_;  // wanted, then impulses
  Scratch<SolverBody<D>> kept_bodies_;
  Scratch<ContactPoint<D>> kept_;  // with the guess of what presses and sticks
};

}  // namespace

template <int D>
void solve_directly(const IslandMove<D>& move, std::optional<int> sub_steps) {
  DirectSolve<D> direct(!sub_steps);
  in_sub_steps<D>(move, sub_steps.value_or(1), [&](SubStep<D>& step) { direct.settle(step); });
}

template <int D>
void direct_solve(const IslandMove<D>& move) {
  solve_directly<D>(move, std::nullopt);
}

template void solve_directly(const IslandMove<2>&, std::optional<int>);
template void solve_directly(const IslandMove<3>&, std::optional<int>);

extern const ContactSolver kDirectSolve = {"direct", {direct_solve<2>, direct_solve<3>}};

}  // namespace lantern::physics
