#include "physics/direct_solve.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lantern::physics {

// How much the velocity along one row changes by an impulse along another.
template <int D>
double DirectSolve<D>::link(const Island<D>& island, const Row& x, const Row& y) const {
  double sum = 0;
  const double along = glm::dot(x.direction, y.direction);
  const auto mass = [&](std::uint32_t body) {
    return island.solver_bodies[body].inverse_mass * along;
  };
  if (x.a == y.a) sum += mass(x.a) + dot(x.turn_a, y.gained_a);
  if (x.b == y.b) sum += mass(x.b) + dot(x.turn_b, y.gained_b);
  if (x.a == y.b) sum -= mass(x.a) + dot(x.turn_a, y.gained_b);
  if (x.b == y.a) sum -= mass(x.b) + dot(x.turn_b, y.gained_a);
  return sum;
}

template <int D>
bool DirectSolve<D>::factor(const Island<D>& island) {
  std::vector<std::size_t> first_of(island.solver_bodies.size(), rows_.size());  // row of each body
  system_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    std::size_t first = i;
    for (const std::uint32_t body : {rows_[i].a, rows_[i].b}) {
      if (island.solver_bodies[body].inverse_mass == 0) continue;
      first_of[body] = std::min(first_of[body], i);
      first = std::min(first, first_of[body]);
    }
    system_.add_line(first);
    if (system_.work() > kDirectSettings.most_work) return false;
  }
  return system_.factor([&](std::size_t i, std::size_t j) {
    const double value = link(island, rows_[i], rows_[j]);
    return i == j ? value * (1 + kDirectSettings.compliance) : value;
  });
}

template <int D>
void DirectSolve<D>::count(WorldWork& work) const {
  ++work.direct_solves;
  work.direct_rows += rows_.size();
  work.constraint_rows += rows_.size();
}

// The gains of all parts after which nothing is missing; missing(part) is the velocity along it.
template <int D>
template <class Missing>
void DirectSolve<D>::find_gains(Missing&& missing) {
  values_.assign(rows_.size(), 0.0);
  for (const Part& part : parts_) {
    const double wanted = missing(part);
    for (int k = 0; k < part.width; ++k)
      values_[part.row + static_cast<std::size_t>(k)] += part.share[k] * wanted;
  }
  system_.solve(values_);
  for (Part& part : parts_) {
    part.gain = 0;
    for (int k = 0; k < part.width; ++k)
      part.gain += part.share[k] * values_[part.row + static_cast<std::size_t>(k)];
  }
}

// Whether, with the new impulses, contacts pull or slip; those are let go.
template <int D>
bool DirectSolve<D>::let_go(Island<D>& island) {
  bool any = false;
  for (std::size_t i = 0; i < parts_.size();) {
    const Part& part = parts_[i];
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
    } else if (most >= 0 && glm::length(pt) > most) {
      p.sticks = false;
      any = true;
    }
    i = next;
  }
  return any;
}

template <int D>
void DirectSolve<D>::keep_guess(Island<D>& island) {
  kept_bodies_ = island.solver_bodies;
  kept_.clear();
  for (const IslandPair<D>& pair : island.pairs)
    for (const ContactPoint<D>& p : pair.rows.points()) kept_.push_back({p.pn, p.pt, p.sticks});
}

template <int D>
void DirectSolve<D>::take_guess_back(Island<D>& island) {
  island.solver_bodies = kept_bodies_;
  auto kept = kept_.begin();
  for (IslandPair<D>& pair : island.pairs)
    for (ContactPoint<D>& p : pair.rows.points()) {
      p.pn = kept->pn;
      p.pt = kept->pt;
      p.sticks = kept->sticks;
      ++kept;
    }
}

template <int D>
bool DirectSolve<D>::solve_velocities(SubStep<D>& step) {
  Island<D>& island = step.island;
  keep_guess(island);
  for (int round = 0; round < kDirectSettings.most_guesses; ++round) {
    list_rows(island);
    if (rows_.empty() || !factor(island)) break;
    count(step.work);
    find_gains([&](const Part& part) {
      const Vec<D> u = relative_velocity(island.solver_bodies[part.a], part.arm_a,
                                         island.solver_bodies[part.b], part.arm_b);
      double wanted = 0;
      if (part.point != nullptr && part.tangent < 0)
        wanted = part.point->bounce - part.point->gap / step.h;
      return wanted - glm::dot(u, part.direction);
    });
    if (let_go(island)) continue;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      island.solver_bodies[row.a].apply_along(row.direction, row.turn_a, row.gained_a, -values_[i]);
      island.solver_bodies[row.b].apply_along(row.direction, row.turn_b, row.gained_b, values_[i]);
    }
    for (const Part& part : parts_) {
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

template <int D>
bool DirectSolve<D>::correct_positions(SubStep<D>& step, bool factored) {
  Island<D>& island = step.island;
  if (!factored) {
    list_rows(island);
    if (rows_.empty() || !factor(island)) return false;
  }
  count(step.work);
  find_gains([&](const Part& part) {
    const Vec<D> u = relative_mean_velocity(island.solver_bodies[part.a], part.arm_a,
                                            island.solver_bodies[part.b], part.arm_b);
    const double wanted = part.joint != nullptr ? 0  // see JointRows
                          : part.tangent < 0    ? part.point->wanted_mean_speed(step.h)
                                                : glm::dot(part.point->wanted_slip, part.direction);
    return wanted - glm::dot(u, part.direction);
  });
  for (const Part& part : parts_)
    if (part.point != nullptr && part.tangent < 0 &&
        part.point->correction + part.gain < -part.point->pn)
      return false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    island.solver_bodies[row.a].correct_along(row.direction, row.gained_a, -values_[i]);
    island.solver_bodies[row.b].correct_along(row.direction, row.gained_b, values_[i]);
  }
  for (const Part& part : parts_)
    if (part.point != nullptr && part.tangent < 0) part.point->correction += part.gain;
  return true;
}

// All at once after 2, 4, 8 ... sweeps, never last. Where something slips, a guess that is good
// already is left alone: friction that lags behind would only spoil it. Of four corners of a face
// three are enough, so that one may press next to nothing and slip: that does not count.
template <int D>
bool DirectSolve<D>::is_due(SubStep<D>& step, int sweeps, int most, const Sweep& last) const {
  if (sweeps < 2 || sweeps >= most || !std::has_single_bit(static_cast<unsigned>(sweeps)))
    return false;
  bool slips = false;
  step.each_pair([&](const ContactRows<D>& rows, auto&, auto&) {
    for (const ContactPoint<D>& p : rows.points())
      slips |= rows.friction > 0 && p.pn > kDirectSettings.presses * last.largest && !p.sticks;
  });
  return !slips || last.change > kDirectSettings.good_guess * last.largest;
}

template <int D>
void DirectSolve<D>::settle(SubStep<D>& step) {
  const auto pairs = static_cast<int>(step.island.pairs.size() + step.island.joints.size());
  const int most = std::clamp(kDirectSettings.most_solved / pairs, kDirectSettings.fewest_sweeps,
                              kDirectSettings.most_sweeps);
  bool settled = false;
  Sweep sweep;
  for (int i = 0; i < most; ++i) {
    sweep = step.sweep_velocities(i);
    const double enough = settled ? kRowSettings.no_matter : kRowSettings.change;
    if (sweep.change <= enough * sweep.largest) break;
    if (is_due(step, i + 1, most, sweep)) settled = solve_velocities(step);
  }
  step.begin_position_correction();
  if (settled && correct_positions(step, true)) return;
  for (int i = 0; i < most; ++i) {
    if (step.is_corrected(step.sweep_positions(), sweep.largest)) return;
    // Two did not do: all at once. What slips is done with already and does not matter here.
    if (i == 1 && correct_positions(step, false)) return;
  }
}

template <int D>
void direct_solve(Island<D>& island, const WorldConfig<D>& config, double h, double whole,
                  WorldWork& work) {
  DirectSolve<D> direct;
  in_sub_steps<D>(island, config, h, whole, 1, work,
                  [&](SubStep<D>& step) { direct.settle(step); });
}

#define LANTERN_INSTANTIATE(D)                       \
  template void DirectSolve<D>::settle(SubStep<D>&); \
  template void direct_solve(Island<D>&, const WorldConfig<D>&, double, double, WorldWork&);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
