#include "physics/direct_solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lantern {
namespace {

constexpr int kMostGuesses = 6;
constexpr double kMostWork = 4e6;  // products, for one factor
// Four corners of a face say more than a box needs: without a little compliance there would be no
// factor. What it leaves undone is so small a part of the impulses.
constexpr double kCompliance = 1e-10;

std::array<Vec<2>, 1> tangents(const Vec<2>& n) { return {Vec<2>(-n.y, n.x)}; }
std::array<Vec<3>, 2> tangents(const Vec<3>& n) {
  const Vec<3> other = std::abs(n.x) < 0.6 ? Vec<3>(1, 0, 0) : Vec<3>(0, 1, 0);
  const Vec<3> s = glm::normalize(glm::cross(n, other));
  return {s, glm::cross(n, s)};
}

}  // namespace

template <int D>
void DirectSolve<D>::add_row(const Island<D>& island, Row row) {
  const Mover<D>& a = island.movers[row.a];
  const Mover<D>& b = island.movers[row.b];
  row.turn_a = cross(row.arm_a, row.direction);
  row.turn_b = cross(row.arm_b, row.direction);
  row.gained_a = a.inverse_inertia * row.turn_a;
  row.gained_b = b.inverse_inertia * row.turn_b;
  rows_.push_back(row);
}

template <int D>
void DirectSolve<D>::list_rows(Island<D>& island) {
  rows_.clear();
  for (JointRows<D>& joint : island.joints) {
    Row row;
    row.a = joint.a;
    row.b = joint.b;
    row.arm_a = joint.arm_a;
    row.arm_b = joint.arm_b;
    row.joint = &joint;
    if (joint.joint.kind == JointKind::distance) {
      row.direction = joint.direction;
      if (joint.compliance > 0) add_row(island, row);
      continue;
    }
    for (row.axis = 0; row.axis < D; ++row.axis) {
      row.direction = Vec<D>(0.0);
      row.direction[row.axis] = 1;
      add_row(island, row);
    }
  }
  for (IslandPair<D>& pair : island.pairs) {
    const auto across = tangents(pair.rows.normal);
    for (ContactPoint<D>& point : pair.rows.points()) {
      if (!(point.pn > 0) || !(point.normal_compliance > 0)) continue;
      Row row;
      row.a = pair.rows.a;
      row.b = pair.rows.b;
      row.arm_a = point.arm_a;
      row.arm_b = point.arm_b;
      row.point = &point;
      row.direction = pair.rows.normal;
      add_row(island, row);
      if (pair.rows.friction == 0 || !point.sticks) continue;
      row.most = pair.rows.friction;
      for (const Vec<D>& tangent : across) {
        ++row.tangent;
        row.direction = tangent;
        add_row(island, row);
      }
    }
  }
}

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
bool DirectSolve<D>::lay_out(const Island<D>& island) {
  std::vector<std::size_t> first_of(island.movers.size(), rows_.size());
  first_.clear();
  start_.clear();
  std::size_t size = 0;
  double products = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    std::size_t first = i;
    for (const std::uint32_t body : {rows_[i].a, rows_[i].b}) {
      if (island.movers[body].inverse_mass == 0) continue;
      first_of[body] = std::min(first_of[body], i);
      first = std::min(first, first_of[body]);
    }
    first_.push_back(first);
    start_.push_back(size);
    const std::size_t length = i - first + 1;
    size += length;
    products += static_cast<double>(length) * static_cast<double>(length) / 2;
    if (products > kMostWork) return false;
  }
  entries_.resize(size);
  return true;
}

template <int D>
bool DirectSolve<D>::factor(const Island<D>& island) {
  if (!lay_out(island)) return false;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t j = first_[i]; j <= i; ++j) {
      double value = link(island, rows_[i], rows_[j]);
      if (i == j) value *= 1 + kCompliance;
      const double* line_i = &entries_[start_[i]];
      const double* line_j = &entries_[start_[j]];
      for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k)
        value -= line_i[k - first_[i]] * line_j[k - first_[j]];
      if (i != j) {
        entry(i, j) = value / entry(j, j);
      } else if (value > 0) {
        entry(i, i) = std::sqrt(value);
      } else {
        return false;
      }
    }
  return true;
}

template <int D>
void DirectSolve<D>::solve() {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (std::size_t j = first_[i]; j < i; ++j) values_[i] -= entry(i, j) * values_[j];
    values_[i] /= entry(i, i);
  }
  for (std::size_t i = rows_.size(); i-- > 0;) {
    values_[i] /= entry(i, i);
    for (std::size_t j = first_[i]; j < i; ++j) values_[j] -= entry(i, j) * values_[i];
  }
}

// Whether, with the new impulses, contacts pull or slip; those are let go.
template <int D>
bool DirectSolve<D>::let_go(Island<D>& island) {
  bool any = false;
  for (std::size_t i = 0; i < rows_.size();) {
    const Row& row = rows_[i];
    std::size_t next = i + 1;
    if (row.point == nullptr) {
      i = next;
      continue;
    }
    ContactPoint<D>& p = *row.point;
    const double pn = p.pn + values_[i];
    Vec<D> pt = p.pt;
    double most = -1;
    for (; next < rows_.size() && rows_[next].point == &p; ++next) {
      pt += rows_[next].direction * values_[next];
      most = rows_[next].most * pn;
    }
    if (!(pn > 0)) {
      const Vec<D> impulse = row.direction * p.pn + p.pt;
      island.movers[row.a].apply(impulse, row.arm_a);
      island.movers[row.b].apply(-impulse, row.arm_b);
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
bool DirectSolve<D>::settle_velocities(Island<D>& island, double h, Sweep& sweep) {
  const std::vector<Mover<D>> movers = island.movers;
  const std::vector<IslandPair<D>> pairs = island.pairs;
  for (int round = 0; round < kMostGuesses; ++round) {
    list_rows(island);
    if (rows_.empty() || !factor(island)) break;
    sweep.rows += rows_.size();
    values_.clear();
    for (const Row& row : rows_) {
      const Vec<D> u =
          relative_velocity(island.movers[row.a], row.arm_a, island.movers[row.b], row.arm_b);
      double wanted = 0;
      if (row.point != nullptr && row.tangent < 0) wanted = row.point->bounce - row.point->gap / h;
      values_.push_back(wanted - glm::dot(u, row.direction));
    }
    solve();
    if (let_go(island)) continue;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      const Vec<D> impulse = row.direction * values_[i];
      island.movers[row.a].apply(-impulse, row.arm_a);
      island.movers[row.b].apply(impulse, row.arm_b);
      if (row.joint != nullptr)
        row.joint->impulse += impulse;
      else if (row.tangent < 0)
        row.point->pn += values_[i];
      else
        row.point->pt += impulse;
    }
    return true;
  }
  island.movers = movers;
  for (std::size_t i = 0; i < pairs.size(); ++i) island.pairs[i].rows = pairs[i].rows;
  return false;
}

template <int D>
bool DirectSolve<D>::settle_carriage(Island<D>& island, double h, bool factored, Sweep& sweep) {
  if (!factored) {
    list_rows(island);
    if (rows_.empty() || !factor(island)) return false;
  }
  values_.clear();
  for (const Row& row : rows_) {
    const Vec<D> u =
        relative_carriage(island.movers[row.a], row.arm_a, island.movers[row.b], row.arm_b);
    const double wanted = row.joint != nullptr ? wanted_carriage(*row.joint, row.direction, h)
                          : row.tangent < 0    ? wanted_carriage(*row.point, h)
                                               : glm::dot(row.point->wanted_slip, row.direction);
    values_.push_back(wanted - glm::dot(u, row.direction));
  }
  solve();
  sweep.rows += rows_.size();
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].point != nullptr && rows_[i].tangent < 0 &&
        rows_[i].point->carried + values_[i] < -rows_[i].point->pn)
      return false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const Vec<D> impulse = row.direction * values_[i];
    island.movers[row.a].carry(-impulse, row.arm_a);
    island.movers[row.b].carry(impulse, row.arm_b);
    if (row.point != nullptr && row.tangent < 0) row.point->carried += values_[i];
  }
  return true;
}

template class DirectSolve<2>;
template class DirectSolve<3>;

}  // namespace lantern
