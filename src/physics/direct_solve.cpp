#include "physics/direct_solve.hpp"

#include <algorithm>
#include <cmath>

namespace lantern {
namespace {

constexpr int kMostGuesses = 6;
constexpr double kMostWork = 4e6;  // products, for one factor
// Rows that say the same twice have no factor without a little compliance. What it leaves undone is
// so small a part of the impulses.
constexpr double kCompliance = 1e-10;

}  // namespace

// How much the velocity along one row changes by an impulse along another.
template <int D>
double DirectSolve<D>::link(const Island<D>& island, const Row& x, const Row& y) const {
  double sum = 0;
  const double along = glm::dot(x.direction, y.direction);
  const auto mass = [&](std::uint32_t body) { return island.movers[body].inverse_mass * along; };
  if (x.a == y.a) sum += mass(x.a) + dot(x.turn_a, y.gained_a);
  if (x.b == y.b) sum += mass(x.b) + dot(x.turn_b, y.gained_b);
  if (x.a == y.b) sum -= mass(x.a) + dot(x.turn_a, y.gained_b);
  if (x.b == y.a) sum -= mass(x.b) + dot(x.turn_b, y.gained_a);
  return sum;
}

template <int D>
bool DirectSolve<D>::factor(const Island<D>& island) {
  std::vector<std::size_t> first_of(island.movers.size(), rows_.size());  // row of each body
  system_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    std::size_t first = i;
    for (const std::uint32_t body : {rows_[i].a, rows_[i].b}) {
      if (island.movers[body].inverse_mass == 0) continue;
      first_of[body] = std::min(first_of[body], i);
      first = std::min(first, first_of[body]);
    }
    system_.add_line(first);
    if (system_.work() > kMostWork) return false;
  }
  return system_.factor([&](std::size_t i, std::size_t j) {
    const double value = link(island, rows_[i], rows_[j]);
    return i == j ? value * (1 + kCompliance) : value;
  });
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
      island.movers[part.a].apply(impulse, part.arm_a);
      island.movers[part.b].apply(-impulse, part.arm_b);
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
  kept_movers_ = island.movers;
  kept_.clear();
  for (const IslandPair<D>& pair : island.pairs)
    for (const ContactPoint<D>& p : pair.rows.points()) kept_.push_back({p.pn, p.pt, p.sticks});
}

template <int D>
void DirectSolve<D>::take_guess_back(Island<D>& island) {
  island.movers = kept_movers_;
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
bool DirectSolve<D>::settle_velocities(Island<D>& island, double h, Sweep& sweep) {
  keep_guess(island);
  for (int round = 0; round < kMostGuesses; ++round) {
    list_rows(island);
    if (rows_.empty() || !factor(island)) break;
    sweep.rows += rows_.size();
    find_gains([&](const Part& part) {
      const Vec<D> u =
          relative_velocity(island.movers[part.a], part.arm_a, island.movers[part.b], part.arm_b);
      double wanted = 0;
      if (part.point != nullptr && part.tangent < 0)
        wanted = part.point->bounce - part.point->gap / h;
      return wanted - glm::dot(u, part.direction);
    });
    if (let_go(island)) continue;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      island.movers[row.a].gain(row.direction, row.turn_a, row.gained_a, -values_[i]);
      island.movers[row.b].gain(row.direction, row.turn_b, row.gained_b, values_[i]);
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
bool DirectSolve<D>::settle_carriage(Island<D>& island, double h, bool factored, Sweep& sweep) {
  if (!factored) {
    list_rows(island);
    if (rows_.empty() || !factor(island)) return false;
  }
  sweep.rows += rows_.size();
  find_gains([&](const Part& part) {
    const Vec<D> u =
        relative_carriage(island.movers[part.a], part.arm_a, island.movers[part.b], part.arm_b);
    const double wanted = part.joint != nullptr ? wanted_carriage(*part.joint, part.direction, h)
                          : part.tangent < 0    ? wanted_carriage(*part.point, h)
                                                : glm::dot(part.point->wanted_slip, part.direction);
    return wanted - glm::dot(u, part.direction);
  });
  for (const Part& part : parts_)
    if (part.point != nullptr && part.tangent < 0 &&
        part.point->carried + part.gain < -part.point->pn)
      return false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    island.movers[row.a].gain_mean(row.direction, row.gained_a, -values_[i]);
    island.movers[row.b].gain_mean(row.direction, row.gained_b, values_[i]);
  }
  for (const Part& part : parts_)
    if (part.point != nullptr && part.tangent < 0) part.point->carried += part.gain;
  return true;
}

template bool DirectSolve<2>::settle_velocities(Island<2>&, double, Sweep&);
template bool DirectSolve<3>::settle_velocities(Island<3>&, double, Sweep&);
template bool DirectSolve<2>::settle_carriage(Island<2>&, double, bool, Sweep&);
template bool DirectSolve<3>::settle_carriage(Island<3>&, double, bool, Sweep&);

}  // namespace lantern
