// Laws: what motion must keep, where closed forms lead, and that scenes of all kinds, by every
// method, move the same in other units, beside others, in space, and on every machine.
#include <numbers>

#include "measure/stress_scenes.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

// What sweeps solve in part hangs on rounding and on the order: such scenes are left out.

template <int D>
double in_other_units(const Scene<D>& scene) {
  if (scene.is(SceneKind::bridge) || scene.is(SceneKind::heap) ||
      (scene.is(SceneKind::stack) && scene.is_of({ContactMethod::soft, ContactMethod::direct})) ||
      (scene.is(SceneKind::slope) && scene.is_of({ContactMethod::soft, ContactMethod::lecture})))
    return 0;
  return parted(scene, in_units(scene, 4, 2, 8), [](std::size_t i, const auto& a, const auto& all) {
    Body<D> b = all[i];
    b.position /= 4, b.velocity /= 2;
    return apart(a, b);
  });
}

template <int D>
double beside_others(Scene<D> scene) {
  if (scene.is(SceneKind::free) || scene.is(SceneKind::room))
    return 0;  // it attracts; it has no outside
  scene.steps = 12;
  return parted(scene, beside_itself(scene),
                [](std::size_t i, const auto& a, const auto& all) { return apart(a, all[i]); });
}

double plane_in_space(const Scene<3>&) { return 0; }
double plane_in_space(Scene<2> scene) {
  if (!scene.is(SceneKind::free) && !scene.is(SceneKind::chain) && !scene.is(SceneKind::room))
    return 0;
  for (auto& [body, spin] : scene.bodies)
    if (!std::holds_alternative<OrientedBox<2>>(body.shape)) body.may_turn = false, spin = 0;
  return parted(scene, in_space(scene),
                [](std::size_t i, const auto& a, const auto& all) { return apart(a, all[i]); });
}

// Of all scenes of a kind: hashes of their states. Whatever the compiler, its settings, and the
// machine, they are these; another engine has others, which a changed one prints in its detail.
StressResult same_bits() {
  constexpr std::array<std::uint64_t, 2 * std::size(kSceneKinds)> kRecorded = {
      0xd1aaf19c6793384d, 0xdb5e81bfbb879695, 0x8b974ec2e0747aa6, 0x7868f1b67d9e01b7,
      0xd49f3dfce5b92ac5, 0xf1a75783cbe5af4a, 0xc639f0c4a68f07c2, 0x2a12f6c65b31e6da,
      0x57640657db12bca0, 0xc6773e0f4b0000,   0x3121901378fd7556, 0xc3ab5b24766ebef5,
      0x5db3644801f06359, 0x80ccb09c4c3bbd9b};
  std::array<std::uint64_t, kRecorded.size()> found{};
  const auto add = [&]<int D>(Scene<D> scene) {
    // Of what flies, the splittings, too.
    if (scene.is(SceneKind::free))
      scene.config.rotation = integration(scene.config.integrator).order == 1
                                  ? RotationMethod::splitting_2
                                  : RotationMethod::splitting_4;
    std::uint64_t& hash = found[static_cast<std::size_t>(scene.kind) * 2 + (D - 2)];
    hash = hash * 0x100000001b3u + after(scene, 1).hash();
  };
  each_scene<2>(add);
  each_scene<3>(add);
  int wrong = 0;
  std::string detail;
  for (std::size_t i = 0; i < found.size(); ++i) {
    wrong += found[i] != kRecorded[i];
    detail += fmt::format("{:#x},", found[i]);
  }
  return at_most(0, wrong, "kinds", detail);
}

// The worst of `figure(method)` over those that part bodies.
auto by_methods(double (*figure)(ContactMethod)) {
  return [figure] {
    return worst_over({ContactMethod::soft, ContactMethod::impulse, ContactMethod::direct}, figure);
  };
}

// --- smooth motion ---

// Of all that moves: how far places, velocities and angular momenta are from those of another
// world.
template <int D>
double unlike(const World<D>& a, const World<D>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.bodies().size(); ++i) {
    const Body<D>&one = a.bodies()[i], &two = b.bodies()[i];
    worst = largest({worst, glm::length(one.position - two.position),
                     glm::length(one.velocity - two.velocity),
                     std::sqrt(geometry::dot(Spin<D>(one.angular_momentum - two.angular_momentum),
                                             Spin<D>(one.angular_momentum - two.angular_momentum))),
                     glm::length(matrix(one.orientation)[0] - matrix(two.orientation)[0])});
  }
  return worst;
}

// How far the order of convergence towards RK4 by the finest steps is from the method's own.
template <int D>
double off_order(SceneKind kind, Integrator integrator) {
  const bool chain = kind == SceneKind::chain, of_places = integration(integrator).of_places;
  const auto by = [&](Integrator one) {
    Scene<D> scene = SceneOf<D>(kind, ContactMethod::none, one).scene();
    scene.steps = 24;
    if (of_places) {
      for (Spring<D>& spring : scene.springs) spring.damping = 0;
    } else if (!chain) {
      scene.bodies[0].body.linear_drag = 0.5, scene.bodies[2].body.linear_drag = 0.3;
      if (D == 2) scene.bodies[0].body.angular_drag = 0.1;
    }
    return scene;
  };
  const auto in_steps = [&](Integrator one, int count) {
    Scene<D> scene = by(one);
    scene.h *= static_cast<double>(scene.steps) / count;
    return after((scene.steps = count, scene), 1);
  };
  const int count = of_places                                           ? 6 * (D - 1)
                    : chain && integrator == Integrator::explicit_euler ? 768
                                                                        : 48;
  const World<D> exact = in_steps(Integrator::runge_kutta_4, 1536);
  const double coarse = unlike(in_steps(integrator, count), exact);
  const double fine = unlike(in_steps(integrator, 2 * count), exact);
  // Joints are moved by Verlet then.
  const bool better = chain && integrator == Integrator::semi_implicit_euler;
  return std::abs(std::log2(coarse / fine) - (better ? 2 : integration(integrator).order));
}

template <SceneKind Of>
StressResult orders() {
  double worst = 0;
  std::string where;
  for (std::size_t i = 0; i < integrator_names().size(); ++i) {
    const auto integrator = static_cast<Integrator>(i);
    if (Of == SceneKind::chain && integration(integrator).of_places) continue;
    const double off = largest(off_order<2>(Of, integrator), off_order<3>(Of, integrator));
    if (!(off <= worst)) where = to_string(integrator);
    worst = largest(worst, off);
  }
  return at_most(0.3, worst, "of an order", where);
}

// What is kept: energy, momentum, angular momentum, and joints that hold; relative to what there
// is.
template <int D, SceneKind Of>
double lost() {
  Scene<D> scene = SceneOf<D>(Of, ContactMethod::none, Integrator::runge_kutta_4).scene();
  for (Spring<D>& spring : scene.springs) spring.damping = 0;
  World<D> world = scene.made();
  const auto kept = [&] {
    std::vector<double> all{total_energy(world)};
    if (Of == SceneKind::chain) return all;
    const Vec<D> p = momentum<D>(world.bodies());
    const Spin<D> l = angular_momentum<D>(world.bodies());
    for (int i = 0; i < D; ++i) all.push_back(p[i]);
    for (int i = 0; i < (D == 2 ? 1 : 3); ++i) all.push_back(spin_component(l, i));
    return all;
  };
  const auto before = kept();
  return worst_after_steps(world, 200, kStep / 8, [&] {
    double worst = widest_gap(world);
    const auto now = kept();
    for (std::size_t i = 0; i < now.size(); ++i)
      worst = largest(worst, std::abs(now[i] - before[i]));
    return worst;
  });
}

// --- blows ---

// Two bodies in free space meet at one point, without friction: by Newton's law, along the normal
// at the moment of impact, j = -(1 + e) v_n / (1/m_a + 1/m_b + ...). The impulse that they got,
// less that.
template <int D>
double blows(ContactMethod method) {
  double worst = 0;
  Random random(11);
  for (int round = 0; round < 40; ++round) {
    WorldConfig<D> config{.contacts = method, .may_sleep = false};
    Scene<D> scene{config};
    const double e = round % 3 == 0 ? 0 : round % 3 == 1 ? 1 : 0.5;
    for (const double side : {-1.0, 1.0}) {
      Vec<D> half(0.3);
      half.x = 0.2, half[D - 1] = 0.5;
      Body<D> body = make_body<D>(
          round % 2 == 0 || side < 0 ? Shape<D>(OrientedBox<D>{half}) : Shape<D>(Sphere{0.4}),
          at<D>(side * 1.2, side * 0.1));
      body.mass = random.between(0.5, 3);
      body.material = {e, 0};
      body.velocity = at<D>(-side * random.between(1, 2));
      Moving<D> one{body};
      if constexpr (D == 2)
        one.body.orientation.angle = random.between(-3, 3), one.spin = random.between(-2, 2);
      else
        one.body.orientation = turned(Rotation<3>{}, random_direction<3>(random) * 2.0),
        one.spin = random_direction<3>(random) * 2.0;
      scene.bodies.push_back(one);
    }
    World<D> world = scene.made();
    for (int i = 0; i < 240 && world.contacts().empty(); ++i) {
      const std::vector<Body<D>> before = world.bodies();
      world.step(1.0 / 120);
      if (world.work().impacts_located != 1) continue;
      const Body<D>&a = world.bodies()[0], &b = world.bodies()[1];
      const Vec<D> push = (b.velocity - before[1].velocity) * b.mass;
      const double size = glm::length(push);
      worst = largest(worst, glm::length((a.velocity - before[0].velocity) * a.mass + push));
      if constexpr (D == 2) {  // in space the axes of the moment are not told
        // Speed along the impulse, of the points that met.
        const auto along = [&](const std::vector<Body<2>>& of) {
          const double spun =
              angular_velocity(of[1]) * (b.angular_momentum - before[1].angular_momentum) +
              angular_velocity(of[0]) * (a.angular_momentum - before[0].angular_momentum);
          return (glm::dot(of[1].velocity - of[0].velocity, push) + spun) / size;
        };
        worst = largest(worst, std::abs(along(world.bodies()) + e * along(before)));
      }
      break;
    }
  }
  return worst;
}

// --- what bears what ---

// A stack at rest: the impulse between two boxes over a step is the weight above.
template <int D>
double bearing(ContactMethod method) {
  WorldConfig<D> config = with_gravity<D>();
  config.contacts = method, config.may_sleep = false, config.iterations = 40;
  World<D> world = world_of<D>(config, {make_floor<D>()});
  double above[4] = {};
  for (int i = 0; i < 4; ++i) {
    Body<D> box = make_box<D>(at<D>(0.05 * i, 0.5 + i));
    box.mass = 1 + 0.5 * i;
    for (int j = 0; j <= i; ++j) above[j] += box.mass;
    world.add(box);
  }
  run(world, 1.0);
  double worst = 0;
  for (const Contact<D>& contact : world.contacts()) {
    double sum = 0;
    for (const double p : contact.normal_impulses) sum += p;
    worst = largest(worst, std::abs(sum / (above[contact.b - 1] * kGravity * kStep) - 1));
  }
  for (int i = 0; i < 4; ++i)
    worst = largest(worst, glm::length(world.bodies()[i + 1].position - at<D>(0.05 * i, 0.5 + i)));
  const double allowed = method == ContactMethod::impulse ? 0.01 : 1e-10;
  return world.contacts().size() == 4 ? worst / allowed : kInfinity;
}

// --- turning ---

// Boxes of any three sides at any spin, free for a step of any length: how far their axes are from
// where Euler's equations lead, by RK4 in steps of a hundredth of a radian.
double turned_freely() {
  Random random(17);
  double worst = 0;
  const auto wide = [&](double lo, double hi) { return lo * std::pow(hi / lo, random.unit()); };
  for (int round = 0; round < 120; ++round) {
    Vec<3> half(wide(0.01, 1), wide(0.01, 1), wide(0.01, 1));
    if (round % 4 == 0) half.y = half.x;
    if (round % 12 == 0) half.z = half.y * (1 + wide(1e-9, 1e-2));
    Body<3> body = make_body<3>(OrientedBox<3>{half}, Vec<3>(0.0));
    body.orientation = turned(Rotation<3>{}, random_direction<3>(random) * 2.0);
    Vec<3> way = random_direction<3>(random);
    if (round % 3 == 0) way = glm::normalize(Vec<3>(1e-3 * way.x, 1, 1e-3 * way.z));
    const double spin = wide(0.01, 60);
    World<3> world = world_of<3>({.contacts = ContactMethod::none}, {body});
    world.set_angular_velocity(0, matrix(body.orientation) * way * spin);
    const Body<3> start = world.bodies()[0];
    const double h = wide(0.01, 1);
    world.step(h);
    const auto rate = [&](const glm::dquat& q) {
      const Vec<3> own = glm::conjugate(q) * start.angular_momentum;
      return q * glm::dquat(0, own * start.inverse_inertia / 2.0);
    };
    const double fast =
        glm::length(start.angular_momentum) *
        largest({start.inverse_inertia.x, start.inverse_inertia.y, start.inverse_inertia.z});
    const int steps = 10 + static_cast<int>(std::min(fast * h * 100, 2e4));
    glm::dquat q = start.orientation.q;
    for (int i = 0; i < steps; ++i) {
      const double t = h / steps;
      const glm::dquat a = rate(q), b = rate(q + a * (t / 2)), c = rate(q + b * (t / 2)),
                       d = rate(q + c * t);
      q = glm::normalize(q + (a + (b + c) * 2.0 + d) * (t / 6));
    }
    const Mat<3> found = matrix(world.bodies()[0].orientation), wanted = matrix({q});
    if (fast * h * 100 < 2e4)
      for (int i = 0; i < 3; ++i) worst = largest(worst, glm::length(found[i] - wanted[i]));
  }
  return worst;
}

// --- what contacts tell ---

// Newton's and Coulomb's laws at each step of what lies, slides and falls: a body's momentum
// changes by gravity and the impulses that its contacts tell, which push, and rub by mu times that
// at most.
template <int D>
double untold_impulses(const Scene<D>& scene) {
  if (!scene.is(SceneKind::slope) && !scene.is(SceneKind::stack)) return 0;
  World<D> world = scene.made();
  double worst = 0;
  for (int step = 0; step < scene.steps; ++step) {
    const std::vector<Body<D>> before = world.bodies();
    world.step(scene.h);
    std::vector<Vec<D>> got(before.size(), Vec<D>(0.0));
    for (const Contact<D>& contact : world.contacts())
      for (int i = 0; i < contact.manifold.count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const Body<D>&a = *world.find(contact.a), &b = *world.find(contact.b);
        const double press = contact.normal_impulses[at];
        const double mu = std::sqrt(a.material.friction * b.material.friction);
        worst = largest({worst, -press, glm::length(contact.friction_impulses[at]) - mu * press});
        got[contact.b] += contact.manifold.normal * press + contact.friction_impulses[at];
        got[contact.a] -= contact.manifold.normal * press + contact.friction_impulses[at];
      }
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Body<D>& now = world.bodies()[i];
      if (!now.is_dynamic()) continue;
      const Vec<D> gained = (now.velocity - before[i].velocity) * now.mass;
      worst = largest(worst,
                      glm::length(gained - got[i] - scene.config.gravity * (now.mass * scene.h)));
    }
  }
  // Where a normal turns within the step, its impulses are not all along its last one.
  return worst / (scene.is(SceneKind::slope) ? 1e-13 : 0.02);
}

// --- masses ---

// Mass and inertia of balls and capsules by their slices across the y axis, and of boxes by their
// sides: the largest part by which the engine's are off.
template <int D>
double masses_off() {
  double worst = 0;
  const auto meet = [&](const Shape<D>& shape, double mass, double along, double across) {
    const MassProperties<D> own = mass_of<D>(shape, 0.7);
    const MassProperties<D> found = scaled_to<D>(own, 3 * 0.7 * mass);
    worst = largest({worst, std::abs(own.mass / (0.7 * mass) - 1),
                     std::abs(spin_component(found.inertia, 0) / (2.1 * across) - 1),
                     std::abs(spin_component(found.inertia, 1) / (2.1 * along) - 1)});
  };
  const double r = 0.3, half = 0.8;
  for (const double rod : {0.0, half}) {
    constexpr int kSlices = 20000;
    double mass = 0, along = 0, across = 0;
    for (int i = 0; i < kSlices; ++i) {
      const double dy = 2 * (rod + r) / kSlices, y = -rod - r + (i + 0.5) * dy;
      const double out = largest(std::abs(y) - rod, 0.0), w2 = r * r - out * out, w = std::sqrt(w2);
      const double slice = D == 2 ? 2 * w : std::numbers::pi * w2;
      mass += slice * dy;
      along += slice * w2 / 2 * dy;
      across += slice * (y * y + w2 / (D == 2 ? 3 : 4)) * dy;
    }
    meet(rod > 0 ? Shape<D>(Capsule{r, rod}) : Shape<D>(Sphere{r}), mass, D == 2 ? across : along,
         across);
  }
  Vec<D> sides(0.5);
  sides.x = 0.4, sides[D - 1] = 0.9;
  const double box = 0.8 * 1.8;
  const double across = box * (D == 2 ? 0.16 + 0.81 : 0.25 + 0.81) / 3;
  meet(OrientedBox<D>{sides}, box, D == 2 ? across : box * (0.16 + 0.81) / 3, across);
  return worst;
}

// --- what pushes, and what carries ---

// A push at a lever, an impulse at a point, and a platform that rises under a box: the farthest
// that anything is from the closed form.
template <int D>
double pushed() {
  World<D> world({.integrator = Integrator::velocity_verlet,
                  .contacts = ContactMethod::soft,
                  .may_sleep = false});
  Body<D> body = make_body<D>(OrientedBox<D>{Vec<D>(0.5)}, Vec<D>(0.0));
  body.mass = 3;  // inertia 3 / 6
  const BodyId one = world.add(body);
  body.position.y = 10;
  const BodyId two = world.add(body);
  Body<D> floor = make_body<D>(OrientedBox<D>{Vec<D>(1.0)}, at<D>(20));
  floor.kind = BodyKind::kinematic_body, floor.velocity = at<D>(0.3, 0.7),
  floor.material.friction = 1;
  world.add(floor);
  body.position = at<D>(20, 1.5), body.velocity = at<D>(0.3, 0.7), body.material.friction = 1;
  const BodyId load = world.add(body);
  world.push(load, at<D>(0, -30), body.position);
  world.push(one, at<D>(0, 6), at<D>(0.25), 0.5);
  world.apply_impulse(two, at<D>(0, 6), at<D>(-0.25, 10));
  run(world, 1);
  const auto& at_end = world.bodies();
  const auto turn = [](const Body<D>& b) {
    return spin_component(angular_velocity(b), D == 2 ? 0 : 2);
  };
  return largest({std::abs(at_end[one].position.y - 0.75), std::abs(at_end[one].velocity.y - 1),
                  std::abs(turn(at_end[one]) - 1.5), std::abs(at_end[two].position.y - 12),
                  std::abs(turn(at_end[two]) + 3),
                  glm::length(at_end[load].position - at<D>(20.3, 2.2)),
                  std::abs(turn(at_end[load]))});
}

// Bodies that spin as fast as they fly against a thin wall: how many are behind it.
template <int D>
double got_through(ContactMethod method) {
  Random random(3);
  double through = 0;
  for (int round = 0; round < 12; ++round) {
    World<D> world({.contacts = method, .may_sleep = false});
    Vec<D> half(4.0);
    half.x = 0.005;
    Body<D> wall = make_body<D>(OrientedBox<D>{half}, at<D>(2));
    wall.kind = BodyKind::static_body;
    world.add(wall);
    Vec<D> thin(0.02);
    thin.x = 0.5;
    Body<D> bullet = make_body<D>(round % 3 == 0   ? Shape<D>(OrientedBox<D>{Vec<D>(0.2)})
                                  : round % 3 == 1 ? Shape<D>(OrientedBox<D>{thin})
                                                   : Shape<D>(Capsule{0.02, 0.4}),
                                  Vec<D>(0.0));
    bullet.velocity = at<D>(random.between(20, 400), random.between(-5, 5));
    bullet.material.restitution = round % 2;
    Spin<D> spin(0.0);
    spin_component(spin, D == 2 ? 0 : 2) = random.between(50, 3000);
    world.add(bullet, spin);
    run(world, 0.25);
    through += !(world.bodies()[1].position.x < 2);
  }
  return through;
}

// A stack falls asleep, stays where it is, and falls when what bears it is taken away.
template <int D>
double slept(ContactMethod method) {
  WorldConfig<D> config = with_gravity<D>();
  config.contacts = method;
  World<D> world = world_of<D>(config, {make_floor<D>(), make_box<D>(at<D>(0, 0.5)),
                                        make_box<D>(at<D>(0, 1.5)), make_box<D>(at<D>(9, 0.5))});
  run(world, 0.4);
  double wrong = world.work().asleep != 0;
  run(world, 0.3);
  wrong += world.work().asleep != 3;
  world.remove(1);
  run(world, 0.2);
  wrong += world.work().asleep != 1;
  wrong += std::abs(world.bodies()[1].position.y - 1.3) > 0.02;
  run(world, 2);
  wrong += world.work().asleep != 2;
  Body<D> ball = make_ball<D>(at<D>(5, 0.5));
  ball.velocity.x = 4;
  world.add(ball);
  run(world, 1.2);
  wrong += !(world.bodies()[2].position.x > 9.01);
  return wrong + (std::abs(world.bodies()[1].position.y - 0.5) > 1e-3);
}

}  // namespace

std::vector<StressCase> law_cases() {
  constexpr const char* kGroup = "laws";
  constexpr const char* kOrders = "Errors shrink by the order of each method, in 2D and 3D.";
  return {
      {"orders_of_springs", kGroup, kOrders, orders<SceneKind::free>},
      {"orders_of_chains", kGroup, kOrders, orders<SceneKind::chain>},
      {"kept_by_springs", kGroup, "Springs and attraction keep energy, momentum and its moment.",
       none_above(5e-8, "SI units", "RK4, 200 steps of 1/480 s, 2D and 3D",
                  lost<2, SceneKind::free>, lost<3, SceneKind::free>)},
      {"kept_by_chains", kGroup, "Joints hold, and keep energy.",
       none_above(5e-8, "SI units", "RK4, 200 steps of 1/480 s, 2D and 3D",
                  lost<2, SceneKind::chain>, lost<3, SceneKind::chain>)},
      {"masses", kGroup, "Masses and inertias are those of the shapes' slices.",
       none_above(1e-5, "relative", "balls, capsules and boxes, 2D and 3D", masses_off<2>,
                  masses_off<3>)},
      {"turned_freely", kGroup, "Free boxes turn as Euler's equations say.",
       none_above(1e-7, "of a unit vector", "120 boxes, to 60 rad/s, steps to 1 s", turned_freely)},
      {"pushed", kGroup, "Pushes, impulses and a lift move and turn bodies as Newton says.",
       none_above(1e-11, "SI units", "1 s, 2D and 3D", pushed<2>, pushed<3>)},
      {"blows", kGroup, "A blow between two bodies obeys Newton's law, by every method.",
       none_above(5e-14, "SI units", "40 pairs each, restitution 0, 1/2, 1", by_methods(blows<2>),
                  by_methods(blows<3>))},
      {"bearing", kGroup, "Boxes in a stack press on each other by the weight above, and stay.",
       none_above(1, "of what is allowed", "every method, 2D and 3D; sweeps 0.01, others 1e-10",
                  by_methods(bearing<2>), by_methods(bearing<3>))},
      {"spinning_bullets", kGroup, "Nothing that spins as fast as it flies gets through a wall.",
       none_above(0, "bullets", "of 72, walls of 1 cm, to 400 m/s and 3000 rad/s",
                  by_methods(got_through<2>), by_methods(got_through<3>))},
      {"sleepers", kGroup, "A stack falls asleep in time, and wakes when it must.",
       none_above(0, "wrong states", "every method, 2D and 3D", by_methods(slept<2>),
                  by_methods(slept<3>))},
      {"told_impulses", kGroup, "Bodies move by the impulses that their contacts tell.",
       [] { return over_scenes(1, [](const auto& s) { return untold_impulses(s); }); }},
      {"same_bits", kGroup, "Scenes move bit for bit as they did when this was written.",
       same_bits},
      {"in_other_units", kGroup, "Scenes move the same in other units of length, time and mass.",
       [] { return over_scenes(1e-10, [](const auto& s) { return in_other_units(s); }); }},
      {"beside_others", kGroup, "Scenes move bit for bit the same beside others, far away.",
       [] { return over_scenes(0, [](const auto& s) { return beside_others(s); }); }},
      {"plane_in_space", kGroup, "Plane scenes move the same in space.",
       [] { return over_scenes(1e-11, [](const auto& s) { return plane_in_space(s); }); }}};
}

}  // namespace lantern::measure
