// Scenes of all kinds, as data, so that a law can be tried on each: told otherwise, it must move
// the same.
#pragma once

#include <cmath>

#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "measure/stress_scene.hpp"

namespace lantern::measure::stress {

enum class SceneKind { free, chain, slope, stack, room, bridge, heap };
inline constexpr std::pair<SceneKind, const char*> kSceneKinds[] = {
    {SceneKind::free, "free"},   {SceneKind::chain, "chain"}, {SceneKind::slope, "slope"},
    {SceneKind::stack, "stack"}, {SceneKind::room, "room"},   {SceneKind::bridge, "bridge"},
    {SceneKind::heap, "heap"}};
inline constexpr ContactMethod kSceneContacts[] = {ContactMethod::soft, ContactMethod::impulse,
                                                   ContactMethod::direct, ContactMethod::lecture};

template <int D>
struct Moving {
  Body<D> body;
  Spin<D> spin{0.0};
};

// As data, so that it can be told otherwise before it is made.
template <int D>
struct Scene {
  WorldConfig<D> config;
  std::vector<Moving<D>> bodies = {};
  std::vector<Spring<D>> springs = {};
  std::vector<Joint<D>> joints = {};
  double h = kStep;
  int steps = 30;
  SceneKind kind = SceneKind::free;
  std::string name = {};

  bool is(SceneKind one) const { return kind == one; }
  bool is_of(std::initializer_list<ContactMethod> methods) const {
    return std::ranges::find(methods, config.contacts) != methods.end();
  }

  World<D> made() const {
    World<D> world(config);
    for (const Moving<D>& one : bodies) world.add(one.body, one.spin);
    for (const Spring<D>& spring : springs) world.add_spring(spring);
    for (const Joint<D>& joint : joints) world.add_joint(joint);
    return world;
  }
};

template <int D>
class SceneOf {
 public:
  SceneOf(SceneKind kind, ContactMethod contacts, Integrator integrator) {
    scene_.kind = kind;
    scene_.config.contacts = contacts;
    scene_.config.integrator = integrator;
    scene_.config.sub_steps = 4;
    scene_.config.may_sleep = false;
    if (kind != SceneKind::free && kind != SceneKind::room) scene_.config.gravity.y = -10;
    switch (kind) {
      case SceneKind::free:
        build_free();
        break;
      case SceneKind::chain:
        build_chain(false);
        break;
      case SceneKind::slope:
        build_slope();
        break;
      case SceneKind::stack:
        build_stack();
        break;
      case SceneKind::room:
        build_room();
        break;
      case SceneKind::bridge:
        build_chain(true);
        break;
      case SceneKind::heap:
        build_heap();
        break;
    }
  }
  Scene<D> scene() && { return std::move(scene_); }

 private:
  Body<D>& add(const Shape<D>& shape, const Vec<D>& position, double mass) {
    Body<D> body = make_body<D>(shape, position);
    body.mass = mass;
    return scene_.bodies.emplace_back(Moving<D>{body}).body;
  }
  Vec<D> halves(double a, double b) {
    Vec<D> half(b);
    half.x = a;
    return half;
  }
  void toss(double speed, double spin) {
    Moving<D>& one = scene_.bodies.back();
    one.body.velocity = random_direction<D>(random_) * speed;
    if constexpr (D == 2)
      one.spin = random_.between(-spin, spin), one.body.orientation.angle = random_.between(-3, 3);
    else
      one.spin = random_direction<3>(random_) * spin,
      one.body.orientation = turned(Rotation<3>{}, random_direction<3>(random_) * 2.0);
  }
  BodyId last() const { return static_cast<BodyId>(scene_.bodies.size() - 1); }

  // A box, a rod and a ball that attract each other, between springs that hold them off their
  // centres.
  void build_free() {
    scene_.config.gravitation = 0.7;
    add(OrientedBox<D>{halves(0.5, 0.3)}, at<D>(0), 1.5);
    toss(1, 3);
    add(Capsule{0.2, 0.4}, at<D>(2, 0.5), 0.7);
    toss(1, 3);
    add(Sphere{0.3}, at<D>(1, 2), 2.5);
    toss(1, 3);
    scene_.springs.push_back({.a = 0,
                              .b = 1,
                              .at_a = at<D>(0.3, 0.2),
                              .at_b = at<D>(0.1, -0.3),
                              .rest_length = 1.5,
                              .stiffness = 6,
                              .damping = 0.4});
    scene_.springs.push_back({.a = 1,
                              .b = 2,
                              .at_a = at<D>(-0.1, 0.4),
                              .at_b = at<D>(0.2),
                              .rest_length = 1,
                              .stiffness = 9});
  }

  // Links let go level, on a post; a bridge between two, with a load.
  void build_chain(bool bridge) {
    add(Sphere{0.1}, at<D>(-0.5), 0).kind = BodyKind::static_body;
    for (int i = 0; i < 4; ++i) {
      add(OrientedBox<D>{halves(0.45, 0.1)}, at<D>(i), 1 + 0.3 * i);
      const bool rod = !bridge && i == 2;
      scene_.joints.push_back({.kind = rod ? JointKind::distance : JointKind::pin,
                               .a = last() - 1,
                               .b = last(),
                               .at_a = at<D>(i == 0 ? 0
                                             : rod  ? 0.4
                                                    : 0.5),
                               .at_b = at<D>(rod ? -0.4 : -0.5),
                               .length = rod ? 0.2 : 0});
    }
    if (!bridge) return;
    add(Sphere{0.1}, at<D>(3.5), 0).kind = BodyKind::static_body;
    scene_.joints.push_back({.a = last() - 1, .b = last(), .at_a = at<D>(0.5)});
    add(OrientedBox<D>{halves(0.6, 0.2)}, at<D>(1.3, 0.3), 20);
  }

  void build_slope() {
    Body<D>& plane = add(HalfSpace<D>{glm::normalize(at<D>(-0.4, 1))}, Vec<D>(0.0), 0);
    plane.kind = BodyKind::static_body;
    const Vec<D> up = glm::normalize(at<D>(-0.4, 1)), along = glm::normalize(at<D>(1, 0.4));
    const double lean = std::atan(0.4);
    const auto put = [&](const Shape<D>& shape, double x, double mu) {
      Body<D>& body = add(shape, up * 0.25 + along * x, 1.3);
      if constexpr (D == 2)
        body.orientation.angle = lean;
      else
        body.orientation = turned(Rotation<3>{}, Vec<3>(0, 0, lean));
      body.material.friction = mu;
    };
    put(OrientedBox<D>{Vec<D>(0.25)}, 0, 0.1);
    scene_.bodies.back().body.velocity = along * 2.0;
    put(OrientedBox<D>{Vec<D>(0.25)}, 2, 2);
    put(Sphere{0.25}, 4, 1);
    put(Capsule{0.25, 0.1}, 6, 0.02);
  }

  void build_stack() {
    scene_.bodies.push_back({make_floor<D>()});
    for (int i = 0; i < 3; ++i)
      add(OrientedBox<D>{halves(0.5 - 0.1 * i, 0.25)}, at<D>(0.05 * i, 0.25 + 0.5 * i),
          1 + 0.5 * i);
    add(Sphere{0.2}, at<D>(-1.5, 0.9), 0.6);
    scene_.bodies.back().body.velocity = at<D>(5, 1);
  }

  void build_room() {
    scene_.steps = 20;
    for (int axis = 0; axis < D; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Vec<D> normal(0.0);
        normal[axis] = -side;
        Body<D>& wall = add(HalfSpace<D>{normal}, normal * -1.5, 0);
        wall.kind = BodyKind::static_body;
        wall.material = {0.6, 0.4};
      }
    const Shape<D> shapes[] = {OrientedBox<D>{halves(0.3, 0.1)}, Capsule{0.1, 0.2}, Sphere{0.2},
                               OrientedBox<D>{Vec<D>(0.2)}};
    constexpr RotationMethod kRotations[] = {RotationMethod::splitting_2, RotationMethod::exact,
                                             RotationMethod::exact, RotationMethod::splitting_4};
    for (int i = 0; i < 4; ++i) {
      add(shapes[i], at<D>(i % 2 * 1.4 - 0.7, i / 2 * 1.4 - 0.7), 0.5 + i).material = {0.3 * i,
                                                                                       0.3};
      scene_.bodies.back().body.rotation = kRotations[i];
      toss(4, 6);
    }
  }

  // A pyramid that a needle, a rod and a heavy ball fall on; some of it sleeps before they come.
  void build_heap() {
    scene_.config.may_sleep = true, scene_.config.sleep_after = 0.1;
    scene_.bodies.push_back({make_floor<D>()});
    for (int row = 0; row < 3; ++row)
      for (int i = 0; i < 3 - row; ++i)
        add(OrientedBox<D>{halves(0.25, 0.2)}, at<D>(0.55 * i + 0.275 * row, 0.2 + 0.4 * row),
            1 + 0.1 * i);
    add(OrientedBox<D>{halves(0.6, 0.004)}, at<D>(0.2, 1.5), 0.2);
    toss(1, 5);
    add(Capsule{0.1, 0.3}, at<D>(1.1, 1.7), 0.8).linear_drag = 0.2;
    toss(2, 5);
    add(Sphere{0.3}, at<D>(-1.2, 0.6), 9).material = {0.5, 0.3};
    scene_.bodies.back().body.velocity = at<D>(4);
  }

  Random random_{5};
  Scene<D> scene_;
};

// `f(scene)` of all kinds, by all methods that suit them.
template <int D, class F>
void each_scene(F&& f) {
  for (const auto& [kind, name] : kSceneKinds)
    for (const ContactMethod contacts : kSceneContacts)
      for (const Integrator integrator : kIntegrators) {
        if (contacts == ContactMethod::lecture &&
            (kind == SceneKind::chain || kind == SceneKind::bridge))
          continue;
        if (kind == SceneKind::free && contacts != ContactMethod::soft) continue;
        Scene<D> scene =
            SceneOf<D>(kind, kind == SceneKind::free ? ContactMethod::none : contacts, integrator)
                .scene();
        scene.name =
            fmt::format("{} {}D {} {}", name, D, to_string(contacts), to_string(integrator));
        f(scene);
      }
}

// Lengths, times and masses in other units.
template <int D>
Scene<D> in_units(Scene<D> s, double length, double time, double mass) {
  WorldConfig<D>& c = s.config;
  c.gravity *= length / (time * time);
  c.gravitation *= length * length * length / (mass * time * time);
  for (auto& [body, spin] : s.bodies) {
    body.position *= length;
    body.velocity *= length / time;
    spin /= time;
    body.mass *= mass;
    body.linear_drag *= mass / time;
    body.angular_drag *= mass * length * length / time;
    body.shape = std::visit(
        [&](auto shape) -> Shape<D> {
          if constexpr (requires { shape.radius; }) shape.radius *= length;
          if constexpr (requires { shape.half_length; }) shape.half_length *= length;
          if constexpr (requires { shape.half_size; }) shape.half_size *= length;
          return shape;
        },
        body.shape);
  }
  for (Spring<D>& spring : s.springs) {
    spring.at_a *= length, spring.at_b *= length, spring.rest_length *= length;
    spring.stiffness *= mass / (time * time), spring.damping *= mass / time;
  }
  for (Joint<D>& joint : s.joints)
    joint.at_a *= length, joint.at_b *= length, joint.length *= length;
  s.h *= time;
  return s;
}

// Another copy of all that moves, too far away to be met, on the same ground.
template <int D>
Scene<D> beside_itself(Scene<D> s) {
  const std::size_t count = s.bodies.size(), springs = s.springs.size(), joints = s.joints.size();
  std::vector<BodyId> copy_of;
  Vec<D> aside = at<D>(64);
  for (std::size_t i = 0; i < count; ++i) {
    const auto* ground = std::get_if<HalfSpace<D>>(&s.bodies[i].body.shape);
    copy_of.push_back(ground ? static_cast<BodyId>(i) : static_cast<BodyId>(s.bodies.size()));
    if (ground) aside = at<D>(64, -64 * ground->normal.x / ground->normal.y);
    if (!ground) s.bodies.push_back(s.bodies[i]), s.bodies.back().body.position += aside;
  }
  const auto copy = [&](auto& list, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      auto one = list[i];
      one.a = copy_of[one.a], one.b = copy_of[one.b];
      list.push_back(one);
    }
  };
  copy(s.springs, springs), copy(s.joints, joints);
  return s;
}

// A plane world in space: what is round must not turn there.
inline Scene<3> in_space(const Scene<2>& s) {
  const auto up = [](const Vec<2>& v) { return Vec<3>(v, 0); };
  Scene<3> t;
  t.config.contacts = s.config.contacts, t.config.integrator = s.config.integrator;
  t.config.gravity = up(s.config.gravity), t.config.gravitation = s.config.gravitation;
  t.config.sub_steps = s.config.sub_steps, t.config.iterations = s.config.iterations;
  t.config.may_sleep = s.config.may_sleep;
  t.h = s.h, t.steps = s.steps, t.name = s.name;
  for (const auto& [flat, spin] : s.bodies) {
    Body<3> body = make_body<3>(Sphere{1}, up(flat.position));
    if (const auto* box = std::get_if<OrientedBox<2>>(&flat.shape))
      body.shape = OrientedBox<3>{Vec<3>(box->half_size, 0.2)};
    if (const auto* ball = std::get_if<Sphere>(&flat.shape)) body.shape = *ball;
    if (const auto* rod = std::get_if<Capsule>(&flat.shape)) body.shape = *rod;
    if (const auto* plane = std::get_if<HalfSpace<2>>(&flat.shape))
      body.shape = HalfSpace<3>{up(plane->normal)};
    body.kind = flat.kind, body.mass = flat.mass, body.material = flat.material;
    body.velocity = up(flat.velocity), body.may_turn = flat.may_turn;
    body.orientation = turned(Rotation<3>{}, Vec<3>(0, 0, flat.orientation.angle));
    t.bodies.push_back({body, Vec<3>(0, 0, spin)});
  }
  for (const Spring<2>& one : s.springs)
    t.springs.push_back({.a = one.a,
                         .b = one.b,
                         .at_a = up(one.at_a),
                         .at_b = up(one.at_b),
                         .rest_length = one.rest_length,
                         .stiffness = one.stiffness,
                         .damping = one.damping});
  for (const Joint<2>& one : s.joints)
    t.joints.push_back({.kind = one.kind,
                        .a = one.a,
                        .b = one.b,
                        .at_a = up(one.at_a),
                        .at_b = up(one.at_b),
                        .length = one.length});
  return t;
}

template <int D>
World<D> after(Scene<D> scene, int parts) {
  World<D> world = scene.made();
  for (int i = 0; i < scene.steps * parts; ++i) world.step(scene.h / parts);
  return world;
}

// The farthest that a body of one scene is from its like in another, after all steps.
template <int D, int E, class Like>
double parted(const Scene<D>& scene, const Scene<E>& other, Like&& like) {
  World<D> one = scene.made();
  World<E> two = other.made();
  for (int i = 0; i < scene.steps; ++i) one.step(scene.h), two.step(other.h);
  double worst = 0;
  for (std::size_t i = 0; i < one.bodies().size(); ++i)
    worst = largest(worst, like(i, one.bodies()[i], two.bodies()));
  return worst;
}

template <int D, int E>
double apart(const Body<D>& a, const Body<E>& b) {
  return largest(std::hypot(a.position.x - b.position.x, a.position.y - b.position.y),
                 std::hypot(a.velocity.x - b.velocity.x, a.velocity.y - b.velocity.y));
}

// The worst of `part(scene)` over all scenes, and where it was.
template <class Part>
StressResult over_scenes(double bound, Part part) {
  double worst = 0;
  std::string where;
  const auto go = [&](const auto& scene) {
    const double far = part(scene);
    if (!(far <= worst)) where = scene.name;
    worst = largest(worst, far);
  };
  each_scene<2>(go);
  each_scene<3>(go);
  return at_most(bound, worst, "m or m/s", "every kind, method, integrator; worst: " + where);
}

}  // namespace lantern::measure::stress
