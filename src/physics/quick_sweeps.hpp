// Sweeps over the contacts of a large island, as many as a wanted error asks for. The rows are
// those of contact_rows.hpp, laid out for a cache: what a sweep reads lies in one piece, and
// nothing else.
//
// One sweep solves two problems, which know nothing of each other, so that a processor works at
// both at a time: impulses that stop bodies, and pushes that move them out of each other (split
// impulses). Both begin where the sub-step before has left them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "physics/sub_step.hpp"

namespace lantern::physics {

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
    return std::max(1, static_cast<int>(std::lround(2 * std::pow(usual_error / error, 0.3))));
  }
  int most_sweeps(double error) const {
    const double most = 6 * std::pow(usual_error / error, 0.4);
    return static_cast<int>(std::lround(std::clamp(most, 4.0, 200.0)));
  }
};
inline constexpr QuickSettings kQuickSettings;

template <int D>
class QuickSweeps {
 public:
  // Finds the impulses of a sub-step that has begun, and corrects its positions, for an error above
  // 0. The island has no joints.
  void settle(SubStep<D>& step, double error);

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
  };
  struct Motion {
    Vec<D> velocity{0.0};
    Spin<D> spin{0.0};
  };
  struct Moving {
    Motion real, pushed;
    Motion old, way;  // of `real`
  };

  void gather(const SubStep<D>& step);
  double sweep(WorldWork& work);  // returns the largest change of a relative speed
  void begin_sweep();
  void go_on_along_the_way();
  void bring_back(SubStep<D>& step);
  static double solve_normal(Contact& contact, Point& point, Moving& a, Moving& b);
  static double solve_friction(Contact& contact, Point& point, Moving& a, Moving& b);

  std::vector<Contact> contacts_;
  std::vector<Moving> bodies_;
  double last_squared_ = 0;  // change of all impulses by the sweep before; 0: there was none
};

}  // namespace lantern::physics
