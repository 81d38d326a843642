#include "physics/sure_advance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lantern::physics {
namespace {

// A plane that turns is followed for so many radians at most: what bounds it grows with time.
constexpr double kMostTurn = 0.5;
// A corner seen along the normal: s + rate t, wrong by no more than bend t^2 / 2.
struct Side {
  double at = 0, rate = 0, bend = 0;
};

template <int D>
struct Sides {
  std::array<Side, 1 << D> room;
  std::size_t count = 0;
  void add(const Side& side) { room[count++] = side; }
};

// Where corners are seen from: a frame that flies and turns with a body; or none, which stands.
template <int D>
struct Frame {
  const Flying<D>* body = nullptr;
  double within = 0;
};

template <int D>
Side seen(const Flying<D>& body, const Vec<D>& arm, const Vec<D>& n, const Frame<D>& frame) {
  const double reach = glm::length(arm);
  const Vec<D> point = body.position + arm, v = body.velocity + cross(body.spin, arm);
  const double bend = body.pull + body.swerve * reach;
  if (frame.body == nullptr) return {glm::dot(n, point), glm::dot(n, v), bend};
  const Flying<D>& own = *frame.body;
  const Vec<D> d = point - own.position;
  if (&own == &body) return {glm::dot(n, d), 0, 0};
  const double fast = glm::length(body.velocity - own.velocity) + body.fastest * reach +
                      (body.pull + own.pull) * frame.within;
  const double far = glm::length(d) + fast * frame.within;
  return {glm::dot(n, d), glm::dot(n, v - own.velocity - cross(own.spin, d)),
          bend + own.pull + 2 * own.fastest * fast + own.swerve * far};
}

// All corners, each moved out by the roundness; as a ball round the centre the body may turn as it
// likes. `out` is 1 for the body that lies behind the plane, -1 for the one before it.
template <int D>
Sides<D> sides_of(const Flying<D>& body, const Vec<D>& n, const Frame<D>& frame, double out,
                  bool as_ball) {
  Sides<D> sides;
  visit_shape<D>(
      body.shape,
      [&](const Core<D>& core) {
        if (as_ball) {
          const double radius = glm::length(core.half) + core.radius;
          const double along = glm::dot(n, body.position) + out * radius;
          return sides.add({along, glm::dot(n, body.velocity), body.pull});
        }
        for (unsigned corner = 0; corner < 1U << D; ++corner) {
          Vec<D> arm(0.0);
          bool twin = false;
          for (int i = 0; i < D; ++i) {
            const bool high = (corner >> i & 1U) != 0;
            twin |= high && core.half[i] == 0;
            arm += body.axes[i] * (high ? core.half[i] : -core.half[i]);
          }
          if (twin) continue;
          Side side = seen(body, arm, n, frame);
          side.at += out * core.radius;
          sides.add(side);
        }
      },
      [&](const HalfSpace<D>&) { sides.add(seen(body, Vec<D>(0.0), n, frame)); });
  return sides;
}

// When a gap g with the rate v, which shrinks by no more than bend t^2 / 2 besides, may be closed.
double until_closed(double g, double v, double bend) {
  if (bend == 0) return v < 0 ? g / -v : HUGE_VAL;
  const double root = std::sqrt(v * v + 2 * bend * g);
  return v > 0 ? (v + root) / bend : root - v > 0 ? 2 * g / (root - v) : 0;
}

template <int D>
double until_met(const Sides<D>& behind, const Sides<D>& before, double depth, double within) {
  double sure = within;
  for (std::size_t i = 0; i < behind.count; ++i)
    for (std::size_t j = 0; j < before.count; ++j) {
      const Side &a = behind.room[i], &b = before.room[j];
      const double gap = b.at - a.at;
      if (gap < -depth) return 0;  // this plane is not between them
      sure = std::min(sure, until_closed(std::max(gap, 0.0), b.rate - a.rate, a.bend + b.bend));
    }
  return sure;
}

template <int D>
bool is_half_space(const Flying<D>& body) {
  return std::holds_alternative<HalfSpace<D>>(body.shape);
}

}  // namespace

template <int D>
double fastest_spin(const Body<D>& body) {
  const Spin<D> spin = angular_velocity(body);
  double square = dot(spin, spin);
  if constexpr (D == 3) {
    if (body.kind == BodyKind::dynamic_body) {
      // As L wanders, |w|^2 is a linear function of the square of L's middle component, and the
      // largest where that is 0.
      const Vec<3> l = glm::conjugate(body.orientation.q) * body.angular_momentum;
      std::array<int, 3> axis{0, 1, 2};
      const Vec<3>& m = body.inverse_inertia;
      std::stable_sort(axis.begin(), axis.end(), [&](int i, int j) { return m[i] < m[j]; });
      square += (m[axis[1]] - m[axis[0]]) * (m[axis[2]] - m[axis[1]]) * l[axis[1]] * l[axis[1]];
    }
  }
  return std::sqrt(square);
}

template <int D>
double sure_advance(const Flying<D>& a, const Flying<D>& b, const Vec<D>& n, double depth,
                    double within) {
  double sure = 0;
  const auto with = [&](const Frame<D>& frame, bool as_ball) {
    const double met = until_met(sides_of(a, n, frame, 1, as_ball),
                                 sides_of(b, n, frame, -1, as_ball), depth, frame.within);
    sure = std::max(sure, met);
  };
  with({nullptr, within}, false);
  with({nullptr, within}, true);
  if (is_half_space(a) || is_half_space(b)) return sure;  // their planes stand
  for (const Flying<D>* own : {&a, &b})
    if (own->fastest > 0) with({own, std::min(within, kMostTurn / own->fastest)}, false);
  return sure;
}

#define LANTERN_INSTANTIATE(D)                  \
  template double fastest_spin(const Body<D>&); \
  template double sure_advance(const Flying<D>&, const Flying<D>&, const Vec<D>&, double, double);

LANTERN_INSTANTIATE(2)
LANTERN_INSTANTIATE(3)
#undef LANTERN_INSTANTIATE

}  // namespace lantern::physics
