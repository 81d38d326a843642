// Scenes of all kinds, as data, so that a law can be tried on each: told otherwise, it must move
// the same.
#pragma once

#include <cmath>

#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "measure/stress_scene.hpp"

namespace lantern::measure::stress {

enum class SceneKind { free, chain, slope, stack, room, bridge, heap, swarm };
inline constexpr std::pair<SceneKind, const char*> kSceneKinds[] = {
    {SceneKind::free, "free"},   {SceneKind::chain, "chain"}, {SceneKind::slope, "slope"},
    {SceneKind::stack, "stack"}, {SceneKind::room, "room"},   {SceneKind::bridge, "bridge"},
    {SceneKind::heap, "heap"},   {SceneKind::swarm, "swarm"}};
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
  bool is_of(const std::vector<ContactMethod>& methods) const {
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

// Flies and turns any way, and lies so.
template <int D>
void toss(Moving<D>& one, Random& random, double speed, double spin) {
  one.body.velocity = random_direction<D>(random) * speed;
  if constexpr (D == 2)
    one.spin = random.between(-spin, spin), one.body.orientation.angle = random.between(-3, 3);
  else
    one.spin = random_direction<3>(random) * spin,
    one.body.orientation = turned(Rotation<3>{}, random_direction<3>(random) * 2.0);
}

template <int D>
class SceneOf {
 public:
  SceneOf(SceneKind kind, ContactMethod contacts, Integrator integrator) {
    scene_.kind = kind;
    scene_.config.contacts = contacts;
    scene_.config.integrator = integrator;
    scene_.config.sub_steps = 4;
    scene_.config.may_sleep = false;
    if (kind != SceneKind::free && kind != SceneKind::room && kind != SceneKind::swarm)
      scene_.config.gravity.y = -10;
    constexpr void (SceneOf::*kBuilds[])() = {
        &SceneOf::build_free, &SceneOf::build_chain,  &SceneOf::build_slope, &SceneOf::build_stack,
        &SceneOf::build_room, &SceneOf::build_bridge, &SceneOf::build_heap,  &SceneOf::build_swarm};
    (this->*kBuilds[static_cast<int>(kind)])();
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
  void toss(double speed, double spin) { stress::toss(scene_.bodies.back(), random_, speed, spin); }
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
  void build_chain() { build_links(false); }
  void build_bridge() {
    build_links(true);
    add(Sphere{0.1}, at<D>(3.5), 0).kind = BodyKind::static_body;
    scene_.joints.push_back({.a = last() - 1, .b = last(), .at_a = at<D>(0.5)});
    add(OrientedBox<D>{halves(0.6, 0.2)}, at<D>(1.3, 0.3), 20);
  }
  void build_links(bool bridge) {
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

  // Links, a brick, a rod and a ball, thrown at each other where nothing else is.
  void build_swarm() {
    scene_.steps = 12;
    for (int i = 0; i < 3; ++i) {
      add(OrientedBox<D>{halves(0.4, 0.1)}, at<D>(i), 1 + 0.5 * i).material = {0.2 * i, 0.4};
      if (i > 0)
        scene_.joints.push_back(
            {.a = last() - 1, .b = last(), .at_a = at<D>(0.5), .at_b = at<D>(-0.5)});
    }
    Vec<D> brick = halves(0.4, 0.25);
    brick[D - 1] = 0.15;
    const Shape<D> thrown[] = {Sphere{0.3}, OrientedBox<D>{brick}, Capsule{0.1, 0.3}};
    const Vec<D> from[] = {at<D>(1.2, 1.2), at<D>(-1.6, 0.2), at<D>(3.2, -0.7)},
                 way[] = {at<D>(0, -8), at<D>(6), at<D>(-5, 3)};
    for (int i = 0; i < 3; ++i) {
      add(thrown[i], from[i], 0.7 + i).material = {0.5 * i, 0.3};
      toss(1, 5);
      scene_.bodies.back().body.velocity = way[i];
    }
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
            (kind == SceneKind::chain || kind == SceneKind::bridge || kind == SceneKind::swarm))
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

template <int D>
World<D> after(const Scene<D>& scene) {
  World<D> world = scene.made();
  for (int i = 0; i < scene.steps; ++i) world.step(scene.h);
  return world;
}

// A scene told otherwise: in other units, along other axes, by who moves along, in space.
template <int D, int E = D>
struct Telling {
  double length = 1, time = 1, mass = 1;
  std::array<Vec<E>, D> axes = own_axes();  // signed ones of the world, for each that there is
  bool mirrors = false;                     // left is right then
  Vec<E> drift{0.0};                        // of all, and static bodies are moved by it

  static std::array<Vec<E>, D> own_axes() {
    std::array<Vec<E>, D> all{};
    for (int i = 0; i < D; ++i) all[static_cast<std::size_t>(i)][i] = 1;
    return all;
  }
  Vec<E> vec(const Vec<D>& v) const {
    Vec<E> sum(0.0);
    for (int i = 0; i < D; ++i) sum += axes[static_cast<std::size_t>(i)] * v[i];
    return sum;
  }
  Spin<E> spin(const Spin<D>& s) const {
    const double sense = mirrors ? -1 : 1;
    if constexpr (E == 2)
      return sense * s;
    else if constexpr (D == 2)
      return Vec<3>(0, 0, s);
    else
      return vec(s) * sense;
  }
  // In a body's own axes: those of a box are told as the world's are, all else keeps its y axis.
  Vec<E> own(const Body<D>& body, Vec<D> v) const {
    if (D != E || std::holds_alternative<OrientedBox<D>>(body.shape)) return vec(v);
    if (mirrors) v.x = -v.x;
    return Telling<D, E>().vec(v);
  }
  Rotation<E> lie(const Body<D>& body) const {
    Mat<E> to(0.0);
    if constexpr (D != E) to[2][2] = 1;
    const Mat<D> from = matrix(body.orientation);
    for (int i = 0; i < D; ++i)
      to += glm::outerProduct(vec(from[i]), own(body, Telling<D>().axes[i]));
    if constexpr (E == 2)
      return {std::atan2(to[0].y, to[0].x)};
    else
      return {glm::normalize(glm::quat_cast(to))};
  }
  Shape<E> shape(const Shape<D>& of) const {
    return std::visit(
        geometry::EachShape{
            [&](Sphere s) -> Shape<E> { return Sphere{s.radius * length}; },
            [&](Capsule s) -> Shape<E> {
              return Capsule{s.radius * length, s.half_length * length};
            },
            [&](const HalfSpace<D>& s) -> Shape<E> { return HalfSpace<E>{vec(s.normal)}; },
            [&](const auto& s) -> Shape<E> {
              Vec<E> half = glm::abs(vec(s.half_size)) * length;
              if constexpr (D != E) half.z = 0.2;
              return OrientedBox<E>{half};
            }},
        of);
  }
  Scene<E> told(const Scene<D>& s) const {
    Scene<E> t{
        {.gravity = vec(s.config.gravity) * (length / (time * time)),
         .gravitation = s.config.gravitation * length * length * length / (mass * time * time),
         .integrator = s.config.integrator,
         .rotation = s.config.rotation,
         .contacts = s.config.contacts,
         .sub_steps = s.config.sub_steps,
         .iterations = s.config.iterations,
         .may_sleep = s.config.may_sleep}};
    t.h = s.h * time, t.steps = s.steps, t.kind = s.kind, t.name = s.name;
    for (const auto& [body, turning] : s.bodies) {
      const bool carried = drift != Vec<E>(0.0) && body.kind == BodyKind::static_body;
      t.bodies.push_back({{.name = body.name,
                           .shape = shape(body.shape),
                           .kind = carried ? BodyKind::kinematic_body : body.kind,
                           .position = vec(body.position) * length,
                           .orientation = lie(body),
                           .velocity = vec(body.velocity) * (length / time) + drift,
                           .mass = body.mass * mass,
                           .material = body.material,
                           .linear_drag = body.linear_drag * mass / time,
                           .angular_drag = body.angular_drag * mass * length * length / time,
                           .may_turn = body.may_turn,
                           .rotation = body.rotation},
                          spin(turning) / time});
    }
    const auto end = [&](BodyId id, const Vec<D>& v) { return own(s.bodies[id].body, v) * length; };
    for (const Spring<D>& one : s.springs)
      t.springs.push_back({one.a, one.b, end(one.a, one.at_a), end(one.b, one.at_b),
                           one.rest_length * length, one.stiffness * mass / (time * time),
                           one.damping * mass / time});
    for (const Joint<D>& one : s.joints)
      t.joints.push_back({one.kind, one.a, one.b, end(one.a, one.at_a), end(one.b, one.at_b),
                          one.length * length});
    return t;
  }
  double parted(const Scene<D>& scene) const { return apart(after(scene), after(told(scene))); }
  // The farthest that places, velocities, angular momenta and axes are from their like, told.
  double apart(const World<D>& one, const World<E>& two) const {
    double worst = 0;
    for (std::size_t i = 0; i < one.bodies().size(); ++i) {
      const Body<D>& a = one.bodies()[i];
      const Body<E>& b = two.bodies()[i];
      const Spin<E> gained =
          b.angular_momentum / (mass * length * length / time) - spin(a.angular_momentum);
      worst = largest({worst,
                       glm::length(b.position / length - vec(a.position) -
                                   drift * (one.time() * time / length)),
                       glm::length((b.velocity - drift) * (time / length) - vec(a.velocity)),
                       std::sqrt(geometry::dot(gained, gained))});
      for (const Vec<D>& axis : Telling<D>().axes)
        worst = largest(worst, glm::length(matrix(b.orientation) * own(a, axis) -
                                           vec(matrix(a.orientation) * axis)));
    }
    return worst;
  }
};

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

// What a law leaves out: kinds of scenes, by these methods, or by all; in the plane, or in space,
// too; by these integrators, or by all.
struct LeftOut {
  std::string_view law;
  std::vector<SceneKind> kinds;
  std::vector<ContactMethod> methods = {};
  bool plane = true;
  std::vector<Integrator> integrators = {};

  template <int D>
  bool covers(const Scene<D>& scene) const {
    return (D == 3 || plane) && std::ranges::count(kinds, scene.kind) > 0 &&
           (methods.empty() || scene.is_of(methods)) &&
           (integrators.empty() || std::ranges::count(integrators, scene.config.integrator) > 0);
  }
};

// A case: the worst of `part(scene)` over all scenes that the law holds for, and where it was.
StressCase law(const std::vector<LeftOut>& left_out, std::string_view name, const char* what,
               double bound, const char* unit, auto part) {
  return {name, "laws", what, [=, &left_out] {
            double worst = 0;
            int tried = 0, all = 0;
            std::string where;
            const auto go = [&]<int D>(const Scene<D>& scene) {
              ++all;
              for (const LeftOut& one : left_out)
                if (one.law == name && one.covers(scene)) return;
              const double far = part(scene);
              ++tried;
              if (!(far <= worst)) where = scene.name;
              worst = largest(worst, far);
            };
            each_scene<2>(go);
            each_scene<3>(go);
            return at_most(bound, worst, unit,
                           fmt::format("{} of {} scenes; worst: {}", tried, all, where));
          }};
}

}  // namespace lantern::measure::stress
