// A step cut into sub-steps. Each one is a whole small step, with few sweeps over the constraints,
// whose impulses begin where the sub-step before has left them; penetration is eased out a part at
// a time. For the same work this mends far more than many sweeps in one large step (Macklin et al.,
// "Small Steps in Physics Simulation", 2019; Catto, "Solver2D", 2024: soft step).
//
// Small steps alone do not hold a heavy body on a light one: what the sweeps cannot, the direct
// solve of all rows at once does in each sub-step (direct_solve.cpp). Large islands of which an
// error is wanted are swept for as long as that takes, and in fewer parts (QuickSweeps); so are
// heaps of bodies inside each other.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/stop.hpp"
#include "geometry/elementary.hpp"
#include "physics/contact/contact_solver.hpp"
#include "physics/contact/sub_step.hpp"

namespace lantern::physics {
namespace {

struct QuickSettings {
  // Of the wanted error: so far may the last sweep of a sub-step move a body. What it leaves undone
  // is more, and sub-steps add up.
  double last_move = 0.005;
  int fewest_pairs = 8;  // smaller islands are solved exactly: it costs less
  // Pairs for each body: no more touch unless bodies lie in heaps inside each other. Those are
  // swept so, too: how fast they part is limited, and by what impulses exactly is of no account.
  std::size_t crowd = 16;
  double usual_error = 0.01;  // at which a step has two parts of at most six sweeps
  // How a step of a pile is best spent at an error: measured on piles of 300 to 2,000 boxes.
  int parts(double error) const {
    return std::max(1, static_cast<int>(std::lround(2 * geometry::pow(usual_error / error, 0.3))));
  }
  int most_sweeps(double error) const {
    const double most = 6 * geometry::pow(usual_error / error, 0.4);
    return static_cast<int>(std::lround(std::clamp(most, 4.0, 200.0)));
  }
};
constexpr QuickSettings kQuickSettings;

template <int D, class Row>
inline __attribute__((always_inline)) double speed_along(const Motion<D>& a, const Motion<D>& b,
                                                         const Vec<D>& direction, const Row& row) {
  return glm::dot(b.velocity - a.velocity, direction) + dot(row.turn_b, b.spin) -
         dot(row.turn_a, a.spin);
}

template <int D, class Row>
inline __attribute__((always_inline)) void apply(Motion<D>& a, Motion<D>& b,
                                                 const Vec<D>& direction, const Row& row,
                                                 double inverse_mass_a, double inverse_mass_b,
                                                 double impulse) {
  a.velocity -= direction * (impulse * inverse_mass_a);
  b.velocity += direction * (impulse * inverse_mass_b);
  a.spin -= row.gained_a * impulse;
  b.spin += row.gained_b * impulse;
}

// Sweeps over the contacts of a large island, as many as a wanted error asks for. The rows are
// those of contact/contact_rows.hpp, laid out for a cache: what a sweep reads lies in one piece,
// and nothing else.
//
// One sweep solves two problems, which know nothing of each other, so that a processor works at
// both at a time: impulses that stop bodies, and pushes that move them out of each other (split
// impulses). Both begin where the sub-step before has left them.
template <int D>
class QuickSweeps {
 public:
  // Finds the impulses of a sub-step that has begun, and corrects its positions, for an error above
  // 0. The island has no joints. Sweeps go always from the first pair to the last: what one leaves
  // undone then lies where the next one finds it, and warm starting does the rest.
  void settle(SubStep<D>& step, double error) {
    gather(step);
    const double enough = kQuickSettings.last_move * error / step.h;
    const int most = kQuickSettings.most_sweeps(error);
    last_squared_ = 0;
    for (int i = 1;; ++i) {
      begin_sweep();
      if (sweep(step.work) <= enough || i == most) break;
      go_on_along_the_way();
    }
    bring_back(step);
  }

 private:
  static constexpr int kTangents = D - 1;
  struct Row {  // how a unit impulse along it turns the bodies
    Spin<D> turn_a{0.0}, turn_b{0.0};
    Spin<D> gained_a{0.0}, gained_b{0.0};
  };
  struct Point {
    Row normal;
    std::array<Row, kTangents> tangent;
    double normal_mass = 0, tangent_mass = 0;  // effective
    double bias = 0;                           // wanted speed of parting
    double pn = 0;
    std::array<double, kTangents> pt{};
    double wanted_push = 0;
    double push = 0;
    // Where the last sweep began, and which way the impulses have gone since.
    double old_pn = 0, way_pn = 0;
    std::array<double, kTangents> old_pt{}, way_pt{};
  };
  struct Contact {
    std::uint32_t a = 0, b = 0;
    int count = 0;
    double friction = 0;
    double inverse_mass_a = 0, inverse_mass_b = 0;
    Vec<D> normal{0.0};
    std::array<Vec<D>, kTangents> across;
    std::array<Point, Manifold<D>::kMostPoints> room;
    std::span<Point> points() { return {room.data(), static_cast<std::size_t>(count)}; }
  };
  struct Moving {
    Motion<D> real, pushed = {};
    Motion<D> old = {}, way = {};  // of `real`
  };

  void gather(const SubStep<D>& step) {
    const Island<D>& island = step.island;
    bodies_.clear();
    for (const SolverBody<D>& body : island.solver_bodies) bodies_.push_back({body});
    if (contacts_.empty())
      contacts_.resize(
          static_cast<std::size_t>(std::ranges::count_if(island.pairs, &IslandPair<D>::may_press)));
    auto next = contacts_.begin();
    for (const IslandPair<D>& pair : island.pairs) {
      const ContactRows<D>& rows = pair.rows;
      if (rows.count == 0) continue;
      const SolverBody<D>&body_a = island.solver_bodies[rows.a],
            &body_b = island.solver_bodies[rows.b];
      Contact& contact = *next++;
      contact.a = rows.a;
      contact.b = rows.b;
      contact.count = rows.count;
      contact.friction = rows.friction;
      contact.inverse_mass_a = body_a.inverse_mass;
      contact.inverse_mass_b = body_b.inverse_mass;
      contact.normal = rows.normal;
      contact.across = tangents(rows.normal);
      for (std::size_t i = 0; i < static_cast<std::size_t>(rows.count); ++i) {
        const ContactPoint<D>& p = rows.room[i];
        Point& point = contact.room[i];
        const auto row_along = [&](const Vec<D>& direction) {
          Row row{cross(p.arm_a, direction), cross(p.arm_b, direction)};
          row.gained_a = body_a.inverse_inertia * row.turn_a;
          row.gained_b = body_b.inverse_inertia * row.turn_b;
          return row;
        };
        point.normal = row_along(contact.normal);
        point.normal_mass = p.inverse_normal_mass > 0 ? 1 / p.inverse_normal_mass : 0;
        point.bias = p.bounce - p.gap / step.h;
        point.pn = p.pn;
        point.wanted_push = p.gap > 0 ? 0 : p.wanted_mean_speed(step.h);
        point.push = std::max(point.push * (1 - kRowSettings.pushed_out), -point.pn);
        apply(bodies_[contact.a].pushed, bodies_[contact.b].pushed, contact.normal, point.normal,
              contact.inverse_mass_a, contact.inverse_mass_b, point.push);
        if (rows.friction == 0) continue;
        point.tangent_mass = p.inverse_tangent_mass > 0 ? 1 / p.inverse_tangent_mass : 0;
        for (std::size_t k = 0; k < kTangents; ++k) {
          point.tangent[k] = row_along(contact.across[k]);
          point.pt[k] = glm::dot(p.pt, contact.across[k]);
        }
      }
    }
  }

  // Returns the largest change of a relative speed.
  double sweep(WorldWork& work) {
    double largest = 0;
    for (Contact& contact : contacts_) {
      stop_if_asked();
      Moving &a = bodies_[contact.a], &b = bodies_[contact.b];
      for (Point& point : contact.points()) {
        if (point.normal_mass == 0) continue;
        largest = std::max(largest, solve_normal(contact, point, a, b) / point.normal_mass);
        ++work.normal_rows;
      }
      if (contact.friction == 0) continue;
      for (Point& point : contact.points()) {
        if (point.tangent_mass == 0 || (point.pn == 0 && point.pt == decltype(point.pt){}))
          continue;
        largest = std::max(largest, solve_friction(contact, point, a, b) / point.tangent_mass);
        work.friction_rows += kTangents;
      }
    }
    return largest;
  }

  // Sweeps alone crawl towards the solution of a large pile. Each shows a way, though: going on
  // along the way of those before, as far as its steps shrink, makes a conjugate gradient of them
  // (Silcowitz, Niebe and Erleben, "A nonsmooth nonlinear conjugate gradient method for interactive
  // contact force problems", 2010). What then pulls or slips is mended by the next sweep.
  void begin_sweep() {
    for (Moving& body : bodies_) body.old = body.real;
    for (Contact& contact : contacts_)
      for (Point& point : contact.points()) {
        point.old_pn = point.pn;
        point.old_pt = point.pt;
      }
  }

  void go_on_along_the_way() {
    double squared = 0;
    for (Contact& contact : contacts_)
      for (const Point& p : contact.points()) {
        squared += (p.pn - p.old_pn) * (p.pn - p.old_pn);
        for (std::size_t t = 0; t < kTangents; ++t)
          squared += (p.pt[t] - p.old_pt[t]) * (p.pt[t] - p.old_pt[t]);
      }
    const double more = last_squared_ > 0 ? squared / last_squared_ : 0;
    last_squared_ = squared;
    const bool again = more > 1;  // it got no better
    const double beta = again ? 0 : more;
    for (Contact& contact : contacts_)
      for (Point& p : contact.points()) {
        const double moved = p.pn - p.old_pn;
        p.pn += beta * p.way_pn;
        p.way_pn = again ? 0 : beta * p.way_pn + moved;
        for (std::size_t t = 0; t < kTangents; ++t) {
          const double slid = p.pt[t] - p.old_pt[t];
          p.pt[t] += beta * p.way_pt[t];
          p.way_pt[t] = again ? 0 : beta * p.way_pt[t] + slid;
        }
      }
    for (Moving& body : bodies_) {
      const Motion<D> gained{body.real.velocity - body.old.velocity,
                             body.real.spin - body.old.spin};
      body.real.velocity += beta * body.way.velocity;
      body.real.spin += beta * body.way.spin;
      body.way.velocity = again ? Vec<D>(0.0) : beta * body.way.velocity + gained.velocity;
      body.way.spin = again ? Spin<D>(0.0) : beta * body.way.spin + gained.spin;
    }
  }

  void bring_back(SubStep<D>& step) {
    Island<D>& island = step.island;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      static_cast<Motion<D>&>(island.solver_bodies[i]) = bodies_[i].real;
      island.solver_bodies[i].twist = Spin<D>(0.0);
    }
    auto contact = contacts_.begin();
    step.each_pair([&](ContactRows<D>& rows, SolverBody<D>& a, SolverBody<D>& b) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(rows.count); ++i) {
        ContactPoint<D>& p = rows.room[i];
        const Point& point = contact->room[i];
        p.pn = point.pn;
        p.pt = Vec<D>(0.0);
        a.twist -= point.normal.turn_a * point.pn;
        b.twist += point.normal.turn_b * point.pn;
        double squared = 0;
        for (std::size_t k = 0; k < kTangents; ++k) {
          p.pt += contact->across[k] * point.pt[k];
          a.twist -= point.tangent[k].turn_a * point.pt[k];
          b.twist += point.tangent[k].turn_b * point.pt[k];
          squared += point.pt[k] * point.pt[k];
        }
        const double most = rows.friction * p.pn * (1 - kRowSettings.slip_by_rounding);
        p.sticks = squared < most * most;
      }
      ++contact;
    });
    step.do_no_work();
    step.find_mean_velocities();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      island.solver_bodies[i].mean.velocity += bodies_[i].pushed.velocity;
      island.solver_bodies[i].mean.spin += bodies_[i].pushed.spin;
    }
  }

  // Each returns by how much it changed a relative speed.
  static double solve_normal(Contact& contact, Point& point, Moving& a, Moving& b) {
    const Vec<D>& n = contact.normal;
    const Row& row = point.normal;
    const double speed = speed_along(a.real, b.real, n, row);
    const double pushed = speed_along(a.pushed, b.pushed, n, row);
    const double pn = std::max(point.pn + (point.bias - speed) * point.normal_mass, 0.0);
    const double push =
        std::max(point.push + (point.wanted_push - pushed) * point.normal_mass, -pn);
    const double change = pn - point.pn, push_change = push - point.push;
    point.pn = pn;
    point.push = push;
    apply(a.real, b.real, n, row, contact.inverse_mass_a, contact.inverse_mass_b, change);
    apply(a.pushed, b.pushed, n, row, contact.inverse_mass_a, contact.inverse_mass_b, push_change);
    return std::abs(change);
  }

  // What sticks is not pushed along, either.
  static double solve_friction(Contact& contact, Point& point, Moving& a, Moving& b) {
    std::array<double, kTangents> wanted{}, hold{};
    double squared = 0;
    for (std::size_t k = 0; k < kTangents; ++k) {
      const Vec<D>& t = contact.across[k];
      wanted[k] =
          point.pt[k] - speed_along(a.real, b.real, t, point.tangent[k]) * point.tangent_mass;
      hold[k] = -speed_along(a.pushed, b.pushed, t, point.tangent[k]) * point.tangent_mass;
      squared += wanted[k] * wanted[k];
    }
    const double most = contact.friction * point.pn;
    const bool slips = squared > most * most;
    const double kept = slips ? most / std::sqrt(squared) : 1;
    double change = 0;
    for (std::size_t k = 0; k < kTangents; ++k) {
      const double gained = wanted[k] * kept - point.pt[k];
      point.pt[k] += gained;
      apply(a.real, b.real, contact.across[k], point.tangent[k], contact.inverse_mass_a,
            contact.inverse_mass_b, gained);
      if (!slips)
        apply(a.pushed, b.pushed, contact.across[k], point.tangent[k], contact.inverse_mass_a,
              contact.inverse_mass_b, hold[k]);
      change = std::max(change, std::abs(gained));
    }
    return change;
  }

  std::vector<Contact> contacts_;
  std::vector<Moving> bodies_;
  double last_squared_ = 0;  // change of all impulses by the sweep before; 0: there was none
};

}  // namespace

template <int D>
void soft_sub_steps(const IslandMove<D>& move) {
  const Island<D>& island = move.island;
  const WorldConfig<D>& config = move.config;
  const bool crowded = island.pairs.size() > kQuickSettings.crowd * island.bodies.size();
  const double wanted = config.wanted_error.value_or(0);
  const double error = crowded ? std::max(wanted, kQuickSettings.usual_error) : wanted;
  const auto pairs = static_cast<int>(island.pairs.size());
  if (error > 0 && island.joints.empty() && pairs >= kQuickSettings.fewest_pairs) {
    QuickSweeps<D> quick;
    const int parts = std::min(kQuickSettings.parts(error), config.sub_steps);
    in_sub_steps<D>(move, parts, [&](SubStep<D>& step) { quick.settle(step, error); });
  } else {
    in_sub_steps<D>(move, config.sub_steps, settle_directly<D>());
  }
}

extern const ContactSolver kSoftSubSteps = {"soft", {soft_sub_steps<2>, soft_sub_steps<3>}};
extern const ContactSolver kJointsAlone = {"none", {soft_sub_steps<2>, soft_sub_steps<3>}};

}  // namespace lantern::physics
