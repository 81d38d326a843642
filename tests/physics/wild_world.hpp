// Worlds drawn at random: what an outsider might build in a closed room, by any method. Each is
// told by its number, so that one that fails can be made again.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "physics/world.hpp"

namespace lantern::physics {

// What a wild world may break.
struct WildReport {
  std::string what;   // in one word; empty if it holds
  double by = 0;      // by how much
  int step = 0;       // after which
  std::string world;  // how it was built
};

template <int D>
class WildWorld {
 public:
  enum class Theme { flight, slope, stack, chain, bridge, springs, bullets };
  static constexpr std::array<const char*, 7> kThemes = {"flight", "slope",   "stack",  "chain",
                                                         "bridge", "springs", "bullets"};

  WildWorld(std::uint64_t seed, std::uint64_t number, ContactMethod method)
      : random_(seed + 1000003 * number + static_cast<std::uint64_t>(method)),
        method_(method),
        // The lecture has no joints.
        theme_(static_cast<Theme>(random_.whole(0, 6))),
        half_(random_.between(1.5, 4)),
        world_(config()) {
    if (method == ContactMethod::lecture && jointed()) theme_ = Theme::flight;
    build_walls();
    switch (theme_) {
      case Theme::flight:
        scatter(random_.whole(1, 6));
        break;
      case Theme::slope:
        build_slope();
        break;
      case Theme::stack:
        build_stack();
        break;
      case Theme::chain:
        build_chain();
        break;
      case Theme::bridge:
        build_bridge();
        break;
      case Theme::springs:
        build_springs();
        break;
      case Theme::bullets:
        build_bullets();
        break;
    }
    steps_ = static_cast<int>(fastest_ * h_ > 0.5 ? random_.whole(2, 5) : random_.whole(6, 30));
    start_ = energy_now();
    for (const Body<D>& body : world_.bodies()) {
      if (!body.is_dynamic()) continue;
      scale_ += body.mass * glm::length(pull_of(body)) * 4 * half_;
      drift_ += body.mass * glm::dot(pull_of(body), pull_of(body)) * h_ * h_ / 2;
    }
    scale_ += kinetic_now() + world_energy().springs;
  }

  WildReport run() {
    double most = start_;
    for (int i = 1; i <= steps_; ++i) {
      const WorldWork before = world_.work();
      try {
        world_.step(h_);
      } catch (const Refused& refused) {
        return failed("refused", 0, i, refused.what());
      }
      const WorldWork done = work_between(before, world_.work());
      const double now = energy_now(), above = now - most - allowed_gain(i),
                   below = start_ - allowed_loss(i) - now;
      if (!std::isfinite(now)) return failed("not a number", now, i);
      if (above > 0 && bounds_energy()) return failed("energy grows", (now - most) / scale_, i);
      if (is_elastic() && below > 0) return failed("energy is lost", (start_ - now) / scale_, i);
      most = std::max(most, now);
      if (const double out = outside(); out > 0) return failed("gets out", out, i);
      if (const double gap = widest_gap(world_) / link_; gap > most_gap())
        return failed("joint parts", gap, i);
      // A row takes about a hundredth of the time of a test.
      const auto work = static_cast<double>(done.narrow_tests + done.constraint_rows / 100);
      if (work > kMostWork) return failed("too much work", work, i);
      work_ = std::max(work_, work);
    }
    return {.what = "", .by = 0, .step = steps_, .world = told()};
  }

  double work() const { return work_; }
  World<D>& world() { return world_; }
  double seconds() const { return h_; }
  int steps() const { return steps_; }
  double energy_now() const { return world_energy().total() + pushed_energy() - floor_energy(); }
  double scale() const { return scale_; }
  std::string told() const {
    return fmt::format("{}D {} {} {} h 1/{:.0f} error {} g {:.3g} bodies {} e {:.2g} mu {:.2g}{}",
                       D, to_string(method_), kThemes[static_cast<std::size_t>(theme_)],
                       to_string(world_.config().integrator), 1 / h_,
                       world_.config().wanted_error.value_or(-1),
                       glm::length(world_.config().gravity), world_.bodies().size() - 2 * D,
                       material_.restitution, material_.friction, calm_ ? " calm" : "");
  }

 private:
  // Of the energy: so much more of it may be in a stack whose boxes ten sweeps have pushed up a
  // little too far, or less where they let them sink.
  static constexpr double kLeftBySweeps = 1e-4;
  // What friction stops on its way uphill comes up to half a step of its speed too far: 4.4e-5.
  static constexpr double kStopsUphill = 1e-4;
  // In a step in which a body of unlike inertia turns by more than half a radian, what brakes it
  // about the axes of half way may push it: velocity Verlet has made 1.7e-4 in a step.
  static constexpr double kDraggedTop = 1e-3;
  static constexpr double kMostWork = 3e6;  // narrow tests in one step

  bool jointed() const { return theme_ == Theme::chain || theme_ == Theme::bridge; }
  bool springy() const { return theme_ == Theme::springs; }
  bool meets() const { return method_ != ContactMethod::none; }
  bool holds_room() const { return meets() && method_ != ContactMethod::lecture; }
  bool is_elastic() const {
    return elastic_ && !braked_ && !jointed() && !world_.config().may_sleep && holds_room();
  }
  // The lecture moves bodies apart, whatever pulls them together; explicit Euler makes energy of
  // springs.
  bool bounds_energy() const {
    const WorldConfig<D>& config = world_.config();
    if (springy() && config.integrator == Integrator::explicit_euler) return false;
    return method_ != ContactMethod::lecture || (!springy() && config.gravity == Vec<D>(0.0));
  }
  bool first_order() const {
    const Integrator by = world_.config().integrator;
    return by != Integrator::velocity_verlet && by != Integrator::runge_kutta_4 &&
           by != Integrator::implicit_midpoint;
  }

  WorldConfig<D> config() {
    constexpr std::array kSteps = {30.0, 50.0, 60.0, 100.0, 120.0, 240.0, 480.0};
    constexpr std::array kErrors = {0.01, 0.1};
    WorldConfig<D> config;
    config.contacts = method_;
    config.integrator = static_cast<Integrator>(random_.whole(0, 5));
    h_ = 1 / kSteps[static_cast<std::size_t>(random_.whole(0, 6))];
    calm_ = chance(0.4);
    if (!chance(0.4)) config.gravity.y = -10;
    if (method_ != ContactMethod::lecture && chance(0.5))
      config.wanted_error = kErrors[static_cast<std::size_t>(random_.whole(0, 1))];
    config.sub_steps = static_cast<int>(random_.whole(1, 10));
    config.iterations = chance(0.7) ? 10 : static_cast<int>(random_.whole(1, 60));
    config.may_sleep = chance(0.3);
    config.warm_start = chance(0.9);
    elastic_ = chance(0.25);
    material_.restitution = elastic_ ? 1 : chance(0.4) ? 0 : random_.unit();
    material_.friction = elastic_ || chance(0.2) ? 0 : random_.between(0, 2);
    return config;
  }

  bool chance(double part) { return random_.unit() < part; }
  double wide(double lo, double hi) {  // evenly by size
    return std::exp(random_.between(std::log(lo), std::log(hi)));
  }

  Spin<D> random_spin(double size) {
    if constexpr (D == 2)
      return chance(0.5) ? size : -size;
    else
      return geometry::random_direction<3>(random_) * size;
  }
  Rotation<D> random_rotation() {
    if constexpr (D == 2)
      return {random_.between(-3, 3)};
    else
      return turned(Rotation<3>{}, geometry::random_direction<3>(random_) * random_.between(0, 3));
  }

  void build_walls() {
    const double thick = thick_ = wide(1e-3, 1);
    for (int axis = 0; axis < D; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Body<D> wall;
        Vec<D> size(half_ + 2 * thick);
        size[axis] = thick;
        wall.name = "wall";
        wall.shape = chance(0.5) ? Shape<D>(AxisBox<D>{size}) : Shape<D>(OrientedBox<D>{size});
        wall.kind = BodyKind::static_body;
        wall.position[axis] = side * (half_ + thick);
        wall.material = material_;
        world_.add(wall);
      }
  }

  Shape<D> random_shape(double size) {
    Vec<D> half(size);
    switch (random_.whole(0, 5)) {
      case 0:
        return Sphere{size};
      case 1:
        return OrientedBox<D>{half};
      case 2:
        for (int i = 0; i < D; ++i) half[i] *= random_.between(0.1, 1);
        return OrientedBox<D>{half};
      case 3:
        return Capsule{size * random_.between(0.1, 0.7), size * random_.between(0.1, 1)};
      case 4: {  // a needle
        half *= wide(1e-3, 0.1);
        half[static_cast<int>(random_.whole(0, D - 1))] = size;
        return OrientedBox<D>{half};
      }
      default:
        return Capsule{size * wide(1e-3, 0.1), size};
    }
  }

  Body<D> body_of(const Shape<D>& shape) {
    Body<D> body;
    body.name = "body";
    body.shape = shape;
    body.mass = wide(0.03, 30);
    body.material = material_;
    if (!elastic_ && chance(0.3)) body.material.friction = random_.between(0, 2);
    body.may_turn = !chance(0.05);
    return body;
  }

  double random_speed(double most) {
    if (calm_) return chance(0.5) ? 0 : random_.between(0, 2);
    return chance(0.2) ? 0 : wide(0.1, most);
  }

  void add_moving(Body<D> body) {
    const double speed = random_speed(1e3), spin = random_speed(1e4);
    body.velocity = geometry::random_direction<D>(random_) * speed;
    const Spin<D> turning =
        turns<D>(body.shape) && body.may_turn ? random_spin(spin) : Spin<D>(0.0);
    fastest_ = std::max({fastest_, speed / half_, spin});
    if (chance(0.15)) brake(body);
    dragged_top_ |= D == 3 && body.angular_drag > 0 && spin * h_ > 0.5;
    world_.add(body, turning);
  }
  // Explicit methods follow no drag that would turn the velocity round in a step.
  void brake(Body<D>& body) {
    const Integrator by = world_.config().integrator;
    const bool any = by == Integrator::velocity_verlet || by == Integrator::implicit_midpoint ||
                     by == Integrator::implicit_euler;
    const double most = any ? 1e3 : 0.5;
    body.linear_drag = body.mass / h_ * wide(1e-3, most);
    const Spin<D> inertia = scaled_to<D>(mass_of<D>(body.shape, 1), body.mass).inertia;
    double least = spin_component(inertia, 0);
    for (int i = 1; i < (D == 2 ? 1 : 3); ++i) least = std::min(least, spin_component(inertia, i));
    if (chance(0.5)) body.angular_drag = least / h_ * wide(1e-3, most);
    braked_ = true;
  }

  static double extent(const Shape<D>& shape) {
    return visit_shape<D>(
        shape, [](const Core<D>& core) { return glm::length(core.half) + core.radius; },
        [](const HalfSpace<D>&) { return 0.0; });
  }

  // Bodies that lie apart: none within another one's ball.
  void scatter(std::int64_t count, double size = 0.25) {
    for (std::int64_t i = 0; i < count; ++i) {
      Body<D> body = body_of(random_shape(half_ * random_.between(0.1, 1) * size));
      const double radius = extent(body.shape);
      for (int look = 0; look < 30; ++look) {
        body.position = geometry::random_point<D>(random_, -half_ + radius, half_ - radius);
        body.orientation = random_rotation();
        if (!is_free(body, radius)) continue;
        add_moving(body);
        break;
      }
    }
  }
  bool is_free(const Body<D>& body, double radius) const {
    const Box<D> box{body.position - Vec<D>(radius), body.position + Vec<D>(radius)};
    return std::ranges::none_of(world_.bodies(),
                                [&](const Body<D>& other) { return overlap(box, other.box()); });
  }

  // Bodies on a plane that leans, some of them at rest on it.
  void build_slope() {
    const double lean = random_.between(0, 1.2);
    Body<D> slope;
    slope.name = "slope";
    slope.kind = BodyKind::static_body;
    Vec<D> normal(0.0);
    normal.x = -std::sin(lean);
    normal.y = std::cos(lean);
    slope.shape = HalfSpace<D>{normal};
    slope.position.y = -half_ / 2;
    slope.material = material_;
    world_.add(slope);
    Vec<D> along(0.0);
    along.x = normal.y;
    along.y = -normal.x;
    for (int i = 0, n = static_cast<int>(random_.whole(1, 3)); i < n; ++i) {
      const double size = half_ * random_.between(0.03, 0.12);
      const bool ball = chance(0.3);
      Body<D> body =
          body_of(ball ? Shape<D>(Sphere{size}) : Shape<D>(OrientedBox<D>{Vec<D>(size)}));
      body.position = slope.position + normal * size + along * (half_ * (i - n / 2) * 0.3);
      if constexpr (D == 2)
        body.orientation.angle = lean;
      else
        body.orientation = turned(Rotation<3>{}, Vec<3>(0, 0, lean));
      body.velocity = along * random_speed(30);
      world_.add(body);
    }
    if (chance(0.4)) scatter(1, 0.1);
  }

  void build_stack() {
    const double size = half_ * random_.between(0.04, 0.15);
    double y = -half_;
    for (int i = 0, n = static_cast<int>(random_.whole(2, 6)); i < n; ++i) {
      Vec<D> half(size * random_.between(0.6, 1));
      Body<D> body = body_of(OrientedBox<D>{half});
      body.position.x = size * random_.between(-0.2, 0.2);
      body.position.y = y + half.y;
      y += 2 * half.y;
      world_.add(body);
    }
    if (chance(0.5)) scatter(1, 0.15);
  }

  void pin(BodyId a, const Vec<D>& at_a, BodyId b, const Vec<D>& at_b) {
    Joint<D> joint;
    joint.a = a;
    joint.b = b;
    joint.at_a = at_a;
    joint.at_b = at_b;
    joint.collide = false;
    world_.add_joint(joint);
  }

  // Links from the left to the right through the middle of the room.
  BodyId add_links(int count, double y) {
    link_ = half_ / (count + 1);
    BodyId first = 0;
    for (int i = 0; i < count; ++i) {
      Vec<D> half(link_ * 0.1);
      half.x = link_ * 0.45;
      Body<D> body = body_of(OrientedBox<D>{half});
      body.may_turn = true;
      body.mass = light_;
      body.position.x = (2 * i - count + 1) * link_ / 2;
      body.position.y = y;
      const BodyId id = world_.add(body);
      if (i == 0) first = id;
      if (i > 0) pin(id - 1, along(link_ / 2), id, along(-link_ / 2));
    }
    return first;
  }
  static Vec<D> along(double x) {
    Vec<D> v(0.0);
    v.x = x;
    return v;
  }

  // A chain that is let go level, from one end or free, with what it swings against.
  void build_chain() {
    const int count = static_cast<int>(random_.whole(1, 5));
    light_ = wide(0.1, 3);
    const BodyId first = add_links(count, half_ * random_.between(-0.3, 0.3));
    const Body<D> begin = *world_.find(first);
    if (chance(0.7))
      pin(0, begin.position - along(link_ / 2) - world_.find(0)->position, first,
          along(-link_ / 2));
    if (chance(0.6)) {  // with a heavy end
      const Body<D> last = *world_.find(first + static_cast<BodyId>(count) - 1);
      Body<D> end = body_of(Sphere{link_ * 0.3});
      end.mass = light_ * wide(1, 1e3);
      end.position = last.position + along(link_);
      const BodyId id = world_.add(end);
      pin(last.id, along(link_ / 2), id, along(-link_ / 2));
    }
    if (chance(0.7)) scatter(random_.whole(1, 3), 0.12);
  }

  // A chain held at both ends, and what lies on it.
  void build_bridge() {
    const int count = static_cast<int>(random_.whole(2, 7));
    light_ = wide(0.1, 3);
    const BodyId first = add_links(count, 0);
    const Vec<D> left = world_.find(first)->position - along(link_ / 2);
    const BodyId last = first + static_cast<BodyId>(count) - 1;
    const Vec<D> right = world_.find(last)->position + along(link_ / 2);
    pin(0, left - world_.find(0)->position, first, along(-link_ / 2));
    pin(last, along(link_ / 2), 0, right - world_.find(0)->position);
    Vec<D> half(link_ * random_.between(0.2, 1.2));
    half.y = link_ * random_.between(0.1, 0.4);
    Body<D> load = body_of(OrientedBox<D>{half});
    load.mass = light_ * wide(1, 1e3);
    load.position.x = random_.between(-0.2, 0.2) * half_;
    load.position.y = link_ * 0.1 + half.y + (chance(0.5) ? 0 : half_ * random_.between(0, 0.3));
    world_.add(load);
  }

  // Springs without length between centres: their forces are linear.
  void build_springs() {
    scatter(random_.whole(2, 4), 0.2);
    for (std::size_t i = 2 * D; i + 1 < world_.bodies().size(); ++i) {
      Spring<D> spring;
      const Body<D>&a = world_.bodies()[i], &b = world_.bodies()[i + 1];
      spring.a = a.id;
      spring.b = b.id;
      const double turn = wide(0.01, 0.4);  // omega h
      spring.stiffness = turn * turn / (h_ * h_) / (1 / a.mass + 1 / b.mass) / 2;
      spring_turn_ = std::max(spring_turn_, turn);
      if (chance(0.3)) {
        spring.damping = spring.stiffness * h_ * random_.unit();
        braked_ = true;
      }
      world_.add_spring(spring);
    }
  }

  void build_bullets() {
    calm_ = false;
    scatter(random_.whole(1, 3), 0.02);
    scatter(random_.whole(0, 2), 0.3);
  }

  Vec<D> pull_of(const Body<D>&) const { return world_.config().gravity; }
  Energy world_energy() const {
    return energy<D>(std::span<const Body<D>>(world_.bodies()), world_.forces());
  }
  double pushed_energy() const { return 0; }
  double kinetic_now() const { return world_energy().kinetic(); }
  double floor_energy() const {
    double sum = 0;
    for (const Body<D>& body : world_.bodies())
      if (body.is_dynamic()) sum += body.mass * glm::length(pull_of(body)) * -2 * half_;
    return sum;
  }

  // What methods of motion themselves make or take of it: see the tables of the reference. A step
  // of first order makes or takes m g^2 h^2 / 2; a linear spring swings by (omega h)^p.
  double swing() const {
    const bool rests = theme_ == Theme::stack || theme_ == Theme::slope;
    double part = rests && method_ == ContactMethod::impulse ? kLeftBySweeps
                  : theme_ == Theme::slope                   ? kStopsUphill
                                                             : 1e-9;
    if (dragged_top_) part += kDraggedTop;
    if (springy()) {
      const double turn = spring_turn_;
      part += world_.config().integrator == Integrator::implicit_midpoint ? 0
              : first_order()                                             ? 2 * turn
                                                                          : turn * turn;
    }
    return part * scale_;
  }
  double allowed_gain(int step) const {
    double gain = swing();
    if (world_.config().integrator == Integrator::explicit_euler)
      gain += step * drift_ * (braked_ ? 2 : 1);
    if (jointed()) gain += joint_swing() * scale_;
    return gain;
  }
  double allowed_loss(int step) const {
    double loss = swing();
    if (first_order()) loss += step * drift_;
    if (springy() && world_.config().integrator != Integrator::implicit_midpoint) loss += scale_;
    return loss;
  }
  double joint_swing() const { return 1e-2; }
  // Of a link. A pin that bodies press on gives way by so little; where something fast hits a
  // chain, its links turn by radians in a part of a step, of which rows see the beginning: they
  // have come apart by 0.86 of a link for a step.
  double most_gap() const { return theme_ == Theme::bridge ? 0.03 : 1; }

  // By how much a body's centre is outside the room.
  double outside() const {
    if (!holds_room()) return 0;
    double most = 0;
    for (const Body<D>& body : world_.bodies())
      if (body.is_dynamic())
        for (int i = 0; i < D; ++i)
          most = std::max(most, std::abs(body.position[i]) - half_ - 2 * thick_);
    return most;
  }

  WildReport failed(const std::string& what, double by, int step, const std::string& more = "") {
    return {what, by, step, told() + " " + more};
  }

  Random random_;
  ContactMethod method_;
  Theme theme_;
  double half_;  // of the room's width
  double h_ = 0;
  bool calm_ = false, elastic_ = false, braked_ = false, dragged_top_ = false;
  Material material_;
  World<D> world_;
  int steps_ = 0;
  double fastest_ = 0, thick_ = 0, light_ = 1, link_ = 1, spring_turn_ = 0;
  double start_ = 0, scale_ = 0, drift_ = 0, work_ = 0;
};

}  // namespace lantern::physics
