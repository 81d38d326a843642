// Sweeps over the contacts of a large island, as many as a wanted error asks for. The rows are
// those of contact/contact_rows.hpp, solved four at a time (quick_vectors.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "base/scratch.hpp"
#include "base/stop.hpp"
#include "physics/contact/quick_vectors.hpp"
#include "physics/contact/sub_step.hpp"

namespace lantern::physics {

// The order in which sweeps solve contacts, four at a time: from above, where loads come from, down
// to what carries them, so that one sweep hands them on all the way. A contact is in the first
// layer behind all those of its bodies before it; those of a layer do not know of each other. So
// each body meets its contacts as if they were solved one by one. (Layers are the colours of a
// graph whose order matters.)
class QuickOrder {
 public:
  static constexpr std::uint32_t kFixed = ~std::uint32_t{0};  // a body that cannot be moved

  void clear(std::size_t bodies) {
    next_.assign(bodies, 0);
    above_.assign(bodies, 0);
    highest_ = 0;
    contacts_.clear();
  }
  // Contacts that lie equally high are solved as they are told. `down`: from a to b, as a cosine.
  void add(std::uint32_t a, std::uint32_t b, int points, double height, double down) {
    contacts_.push_back({a, b, static_cast<std::uint32_t>(points), height, down});
  }
  // Gives each contact its place, and returns how many groups there are; those that are not full
  // have places for nobody.
  std::size_t arrange(Scratch<std::uint32_t>& places) {
    find_heights();
    keys_.resize(contacts_.size());
    std::uint32_t last = 0;
    for (const std::uint32_t i : in_order(kHeights)) {
      const auto& [a, b, points, height, down] = contacts_[i];
      const std::uint32_t layer = std::max(a != kFixed ? next_[a] : 0, b != kFixed ? next_[b] : 0);
      if (a != kFixed) next_[a] = layer + 1;
      if (b != kFixed) next_[b] = layer + 1;
      if (std::abs(down) > kCarries) lay_upon(down > 0 ? a : b, down > 0 ? b : a);
      // Those with as many points come together.
      keys_[i] = (layer + 1) * kMostPoints - points;
      last = std::max(last, keys_[i]);
    }
    places.resize(keys_.size());
    groups_.clear();
    std::uint32_t layer = 0, place = 0;
    for (const std::uint32_t i : in_order(last + 1)) {
      if (std::exchange(layer, keys_[i] / kMostPoints) != layer)
        place = static_cast<std::uint32_t>(groups_.size() * kQuickLanes);
      places[i] = place++;
      groups_.resize((place + kQuickLanes - 1) / kQuickLanes);
      groups_.back().points += contacts_[i].points;
      groups_.back().most = std::max(groups_.back().most, contacts_[i].points);
    }
    return groups_.size();
  }
  // How many bodies lie upon each other at most.
  std::uint32_t highest_stack() const { return highest_; }
  // Of a group: how many points a contact has at most, and whether four have as many.
  std::size_t most_points(std::size_t group) const { return groups_[group].most; }
  bool is_full(std::size_t group) const {
    return groups_[group].points == kQuickLanes * groups_[group].most;
  }

 private:
  static constexpr std::uint32_t kMostPoints = 4;
  static constexpr std::uint32_t kHeights = 4096;  // that are told apart
  static constexpr double kCarries = 0.5;          // cosine: not a wall at its side
  struct Contact {
    std::uint32_t a, b, points;
    double height, down;
  };
  struct Group {
    std::uint32_t points = 0, most = 0;
  };

  void lay_upon(std::uint32_t upper, std::uint32_t lower) {
    if (upper == kFixed) return;
    highest_ = std::max(highest_, above_[upper] + 1);
    if (lower != kFixed) above_[lower] = std::max(above_[lower], above_[upper] + 1);
  }

  void find_heights() {
    keys_.clear();
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Contact& contact : contacts_) {
      if (!std::isfinite(contact.height)) continue;
      lowest = std::min(lowest, contact.height);
      highest = std::max(highest, contact.height);
    }
    const double scale = (kHeights - 1) / (highest - lowest);
    for (const Contact& contact : contacts_) {
      const double below = (highest - contact.height) * scale;
      keys_.push_back(below > 0 ? static_cast<std::uint32_t>(std::min(below, kHeights - 1.0)) : 0);
    }
  }

  // Contacts in order of their keys, which are below `end`; of equal ones as they were told. Digit
  // by digit, from the last one: an island may be much smaller than `end`.
  const Scratch<std::uint32_t>& in_order(std::uint32_t end) {
    constexpr std::uint32_t kBits = 6, kDigits = 1 << kBits;
    sorted_.resize(keys_.size());
    std::iota(sorted_.begin(), sorted_.end(), 0u);
    for (std::uint32_t shift = 0; (end - 1) >> shift != 0; shift += kBits) {
      std::array<std::uint32_t, kDigits + 1> begin{};
      const auto digit = [&](std::uint32_t i) { return keys_[i] >> shift & (kDigits - 1); };
      for (const std::uint32_t i : sorted_) ++begin[digit(i) + 1];
      for (std::uint32_t k = 0; k < kDigits; ++k) begin[k + 1] += begin[k];
      moved_.resize(keys_.size());
      for (const std::uint32_t i : sorted_) moved_[begin[digit(i)]++] = i;
      std::swap(sorted_, moved_);
    }
    return sorted_;
  }

  Scratch<Contact> contacts_;
  Scratch<Group> groups_;
  Scratch<std::uint32_t> next_;   // of each body: the layer behind its contacts
  Scratch<std::uint32_t> above_;  // of each body: how many lie upon each other on it
  std::uint32_t highest_ = 0;
  Scratch<std::uint32_t> keys_;  // of each contact: its height, then layer and points
  Scratch<std::uint32_t> sorted_, moved_;
};

template <int D>
class QuickSweeps {
 public:
  // Makes a part of a step of an island without joints. Sweeps end when the last has moved nothing
  // by more than `enough`, or after as many as the highest stack needs, at an effort of 1 for an
  // error of a hundredth. They go always the same way: what one leaves undone then lies where the
  // next one finds it, and warm starting does the rest.
  void make(SubStep<D>& step, double enough, double effort) {
    step.find_motion();
    if (std::exchange(is_new_, false)) arrange(step.island);
    gather(step);
    const double most = effort * (kFewest + kEach * order_.highest_stack());
    sweep(step, enough / step.h, static_cast<int>(std::lround(std::clamp(most, 6.0, 300.0))));
    bring_back(step);
    step.move_bodies();
  }

 private:
  using Body = QuickBody<D>;
  static constexpr std::size_t kTangents = D - 1;
  static constexpr double kFewest = 10, kEach = 0.4;  // sweeps, and for each body of a stack

  // Of a vector or a motion, and of an inertia.
  template <class T>
  static auto numbers_of(const T& x) {
    return std::bit_cast<std::array<double, sizeof(T) / sizeof(double)>>(x);
  }
  static std::array<double, 1> numbers_of_inertia(double x) { return {x}; }
  static std::array<double, 6> numbers_of_inertia(const Mat<3>& m) {
    return {m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]};
  }
  static void set(auto& to, std::size_t lane, const auto& value) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i].lane[lane] = numbers_of(value)[i];
  }
  static void add(Body& body, std::size_t from, const Motion<D>& motion) {
    for (const double number : numbers_of(motion)) body.motion[from++] += number;
  }
  static Motion<D> motion_of(const Body& body, std::size_t from) {
    decltype(numbers_of(Motion<D>())) numbers;
    std::copy_n(body.motion.begin() + static_cast<std::ptrdiff_t>(from), numbers.size(),
                numbers.begin());
    return std::bit_cast<Motion<D>>(numbers);
  }

  void arrange(const Island<D>& island) {
    const Vec<D>& gravity = island.forces.gravity;
    const double pull = glm::length(gravity);
    const auto moving = [&](std::uint32_t i) {
      const SolverBody<D>& body = island.solver_bodies[i];
      const bool moves = body.inverse_mass != 0 || body.inverse_inertia != Inertia<D>(0.0);
      return moves ? i : QuickOrder::kFixed;
    };
    const double none = -std::numeric_limits<double>::infinity();
    const auto height = [&](std::uint32_t i) {
      return i == QuickOrder::kFixed ? none : -glm::dot(island.bodies[i].position, gravity);
    };
    order_.clear(island.bodies.size());
    for (const IslandPair<D>& pair : island.pairs) {
      if (pair.rows.count == 0) continue;
      const std::uint32_t a = moving(pair.rows.a), b = moving(pair.rows.b);
      order_.add(a, b, pair.rows.count, std::max(height(a), height(b)),
                 pull > 0 ? glm::dot(pair.rows.normal, gravity) / pull : 0);
    }
    groups_.resize(order_.arrange(places_));
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      QuickGroup<D>& group = groups_[i];
      const std::size_t most = order_.most_points(i);
      // What is not written anew for each contact is zero. Places of nobody have a body for
      // themselves, behind the others.
      if (order_.is_full(i)) {
        for (std::size_t k = 0; k < most; ++k) group.room[k].push = {};
      } else {
        for (std::size_t k = 0; k < most; ++k) group.room[k] = {};
        group.friction = group.inverse_mass_a = group.inverse_mass_b = {};
        group.inertia_a = group.inertia_b = {};
        group.normal = {};
        group.across = {};
        group.a.fill(static_cast<std::uint32_t>(island.bodies.size()));
        group.b = group.a;
      }
      group.points = most;
      group.rubs = false;
    }
  }

  void gather(SubStep<D>& step) {
    Island<D>& island = step.island;
    bodies_.assign(island.bodies.size() + 1, {});
    for (std::size_t i = 0; i < island.kicked.size(); ++i) add(bodies_[i], 0, island.kicked[i]);
    normal_rows_ = 0;
    auto place = places_.begin();
    for (IslandPair<D>& pair : island.pairs) {
      if (pair.rows.count == 0) continue;
      stop_if_asked();
      step.refresh(pair.rows);
      gather(step, pair.rows, groups_[*place / kQuickLanes], *place % kQuickLanes);
      ++place;
    }
  }

  void gather(const SubStep<D>& step, const ContactRows<D>& rows, QuickGroup<D>& group,
              std::size_t lane) {
    const auto& a = step.island.solver_bodies[rows.a];
    const auto& b = step.island.solver_bodies[rows.b];
    group.a[lane] = rows.a;
    group.b[lane] = rows.b;
    group.rubs |= rows.friction > 0;
    group.friction.lane[lane] = rows.friction;
    group.inverse_mass_a.lane[lane] = a.inverse_mass;
    group.inverse_mass_b.lane[lane] = b.inverse_mass;
    set(group.inertia_a, lane, numbers_of_inertia(a.inverse_inertia));
    set(group.inertia_b, lane, numbers_of_inertia(b.inverse_inertia));
    const std::array<Vec<D>, kTangents> across = tangents(rows.normal);
    set(group.normal, lane, rows.normal);
    for (std::size_t k = 0; k < kTangents; ++k) set(group.across[k], lane, across[k]);
    const auto begin_with = [&](const ContactPoint<D>& p, const Vec<D>& impulse, std::size_t from) {
      if (impulse == Vec<D>(0.0)) return;
      add(bodies_[rows.a], from,
          {-impulse * a.inverse_mass, -(a.inverse_inertia * cross(p.arm_a, impulse))});
      add(bodies_[rows.b], from,
          {impulse * b.inverse_mass, b.inverse_inertia * cross(p.arm_b, impulse)});
    };
    for (std::size_t i = 0; i < rows.points().size(); ++i) {
      const ContactPoint<D>& p = rows.room[i];
      QuickPoint<D>& point = group.room[i];
      const auto inverse = [](double x) { return x > 0 ? 1 / x : 0; };
      point.normal_mass.lane[lane] =
          inverse(p.inverse_normal_mass + rows.friction * glm::length(p.coupling));
      normal_rows_ += p.inverse_normal_mass > 0;
      point.bias.lane[lane] = p.bounce - p.gap / step.h;
      point.wanted_push.lane[lane] = p.gap > 0 ? 0 : p.wanted_mean_speed(step.h);
      double& push = point.push.lane[lane];
      push = std::max(push * (1 - kRowSettings.pushed_out), -p.pn);
      point.pn.now.lane[lane] = p.pn;
      set(point.arm_a, lane, p.arm_a);
      set(point.arm_b, lane, p.arm_b);
      begin_with(p, rows.normal * p.pn + p.pt, 0);
      begin_with(p, rows.normal * push, Body::kPushed);
      point.tangent_mass.lane[lane] = inverse(p.inverse_tangent_mass);
      for (std::size_t k = 0; k < kTangents; ++k)
        point.pt[k].now.lane[lane] = glm::dot(p.pt, across[k]);
    }
  }

  // Sweeps alone crawl towards the solution of a large pile. Each shows a way, though: going on
  // along it before the next, farther each time, takes of the order of n sweeps where n^2 were
  // needed (Mazhar et al., "Using Nesterov's method to accelerate multibody dynamics with friction
  // and contact", 2015). What then pulls or slips is mended by that sweep. Where sweeps change more
  // than before, it went too far, and begins anew (O'Donoghue and Candes, "Adaptive restart for
  // accelerated gradient schemes", 2015).
  void sweep(SubStep<D>& step, double enough, int most) {
    constexpr std::size_t kAtATime = 64;
    QuickSweep sweep;
    ways_.assign(bodies_.size(), {});
    old_ = bodies_;
    double squared_before = std::numeric_limits<double>::infinity(), run = 0;
    for (int i = 1;; ++i) {
      sweep.largest = sweep.squared = {};
      sweep.friction_rows = 0;
      for (std::size_t from = 0; from < groups_.size(); from += kAtATime) {
        stop_if_asked();
        const std::size_t count = std::min(kAtATime, groups_.size() - from);
        vectors_.sweep(std::span(groups_).subspan(from, count), bodies_.data(), sweep);
      }
      step.work.normal_rows += normal_rows_;
      step.work.friction_rows += sweep.friction_rows;
      if (std::ranges::max(sweep.largest.lane) <= enough || i == most) return;
      const double squared = sweep.squared.sum();
      sweep.goes_on = squared <= squared_before;
      squared_before = squared;
      run = sweep.goes_on ? run + 1 : 0;
      sweep.beta = run / (run + 3);
      go_on(sweep);
    }
  }

  // Bodies do so at once, impulses when the next sweep comes to them.
  void go_on(const QuickSweep& sweep) {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for (std::size_t k = 0; k < Body::kPushed; ++k) {
        double &now = bodies_[i].motion[k], &way = ways_[i].motion[k], &old = old_[i].motion[k];
        way = sweep.goes_on ? sweep.beta * (way + (now - old)) : 0;
        old = now += way;
      }
  }

  // Which part of the impulses does no work (see SubStep).
  double share_without_work(const SubStep<D>& step) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      old_[i] = {};
      if (i < step.island.kicked.size()) add(old_[i], 0, step.island.kicked[i]);
      add(old_[i], Body::kPushed, motion_of(bodies_[i], 0));
    }
    QuickWork work;
    vectors_.work(groups_, old_.data(), work);
    return SubStep<D>::share_without_work(work.before.sum(), work.after.sum(), work.wanted.sum());
  }

  void bring_back(SubStep<D>& step) {
    Island<D>& island = step.island;
    const double share = share_without_work(step);
    for (std::size_t i = 0; i < island.solver_bodies.size(); ++i) {
      const Motion<D> now = motion_of(bodies_[i], 0), &kicked = island.kicked[i];
      SolverBody<D>& body = island.solver_bodies[i];
      body.velocity = kicked.velocity + (now.velocity - kicked.velocity) * share;
      body.spin = kicked.spin + (now.spin - kicked.spin) * share;
    }
    auto place = places_.begin();
    for (IslandPair<D>& pair : island.pairs) {
      if (pair.rows.count == 0) continue;
      stop_if_asked();
      bring_back(pair.rows, groups_[*place / kQuickLanes], *place % kQuickLanes, share, island);
      ++place;
      step.note_touch(pair);
    }
    step.find_mean_velocities();
    for (std::size_t i = 0; i < island.solver_bodies.size(); ++i) {
      const Motion<D> pushed = motion_of(bodies_[i], Body::kPushed);
      island.solver_bodies[i].mean.velocity += pushed.velocity;
      island.solver_bodies[i].mean.spin += pushed.spin;
    }
  }

  void bring_back(ContactRows<D>& rows, const QuickGroup<D>& group, std::size_t lane, double share,
                  Island<D>& island) {
    SolverBody<D>&a = island.solver_bodies[rows.a], &b = island.solver_bodies[rows.b];
    std::array<Vec<D>, kTangents> across;
    for (std::size_t k = 0; k < kTangents; ++k)
      for (int i = 0; i < D; ++i)
        across[k][i] = group.across[k][static_cast<std::size_t>(i)].lane[lane];
    for (std::size_t i = 0; i < rows.points().size(); ++i) {
      ContactPoint<D>& p = rows.room[i];
      const QuickPoint<D>& point = group.room[i];
      p.pn = point.pn.now.lane[lane] * share;
      p.pt = Vec<D>(0.0);
      for (std::size_t k = 0; k < kTangents; ++k)
        p.pt += across[k] * (point.pt[k].now.lane[lane] * share);
      const Vec<D> impulse = rows.normal * p.pn + p.pt;
      a.twist -= cross(p.arm_a, impulse);
      b.twist += cross(p.arm_b, impulse);
    }
  }

  const QuickVectors<D>& vectors_ = quick_vectors<D>().front();
  bool is_new_ = true;
  QuickOrder order_;
  Scratch<std::uint32_t> places_;  // of the contacts: group and lane
  Scratch<QuickGroup<D>> groups_;
  Scratch<Body> bodies_;
  Scratch<Body> old_;  // where the last sweep began
  Scratch<Body> ways_;
  std::uint64_t normal_rows_ = 0;  // of a sweep
};

}  // namespace lantern::physics
