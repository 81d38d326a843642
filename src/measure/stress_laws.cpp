// Laws: what motion must keep, where closed forms lead, and that scenes of all kinds, by every
// method, move the same in other units, beside others, in space, and on every machine.

#include "measure/stress_scenes.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

using enum SceneKind;
using enum ContactMethod;

const std::vector<LeftOut> kLeftOut = {
    // What sweeps solve in part hangs on rounding and on the order, and heaps fall otherwise then.
    {"in_other_units", {bridge, heap}},
    {"in_other_units", {stack}, {soft, direct}},
    {"in_other_units", {slope}, {soft, lecture}},
    {"in_other_units", {slope}, {direct}, false},
    {"in_mirrors", {bridge, heap}},
    {"in_mirrors", {slope, stack}, {}, false},
    // Links that are struck part for a step; what closes their gaps, and by how much explicit Euler
    // throws them on, hangs on rounding.
    {"in_mirrors", {swarm}, {}, false, {Integrator::explicit_euler}},
    // It attracts, or has no outside.
    {"beside_others", {SceneKind::free, room}},
    // Corners in space are more than in the plane, and share what presses.
    {"plane_in_space", {slope, stack, bridge, heap, swarm}},
    {"plane_in_space", {SceneKind::free, chain, room}, {}, false},
    // What bounces or hangs on joints gets impulses that no contact tells.
    {"settled", {SceneKind::free, chain, heap, swarm}},
    // It is off 25 times as far as by any other method.
    {"settled", {stack}, {direct}, true, {Integrator::explicit_euler}},
    {"two_ways", {SceneKind::free, chain, room, heap, swarm}},
    {"two_ways", {slope, stack, bridge}, {soft, impulse, lecture}},
    // What stands on something is pushed from outside.
    {"kept", {slope, stack, room, bridge, heap}},
};

// Axes change places, one is turned round, so that left is right, and all is seen in passing; not
// so where balls touch what stands still, which is one thing, or moves.
template <int D>
double in_mirrors(const Scene<D>& scene) {
  Telling<D> other{.mirrors = true};
  if constexpr (D == 2)
    other.axes = {Vec<2>(0, 1), Vec<2>(1, 0)};
  else
    other.axes = {Vec<3>(0, -1, 0), Vec<3>(0, 0, 1), Vec<3>(1, 0, 0)};
  if (!scene.is(slope) && !scene.is(stack)) other.drift = at<D>(0.3, -0.2);
  return other.parted(scene);
}

template <int D>
double beside_others(Scene<D> scene) {
  scene.steps = 12;
  return Telling<D>().apart(after(scene), after(beside_itself(scene)));
}

// All rows at once, or swept over until nothing changes; they push out of each other otherwise what
// slides, or hangs on joints.
template <int D>
double two_ways(Scene<D> scene) {
  scene.steps = 8;
  Scene<D> swept = scene;
  swept.config.contacts = impulse, swept.config.iterations = 1000;
  const double allowed = scene.is(bridge) ? 1 : scene.is(slope) ? 0.2 : 1e-9;
  return Telling<D>().apart(after(scene), after(swept)) / allowed;
}

double plane_in_space(const Scene<3>&) { return 0; }
double plane_in_space(Scene<2> scene) {
  for (auto& [body, spin] : scene.bodies)
    if (!std::holds_alternative<OrientedBox<2>>(body.shape)) body.may_turn = false, spin = 0;
  return Telling<2, 3>().parted(scene);
}

// Of all scenes of a kind: hashes of their states. Whatever the compiler, its settings, and the
// machine, they are these; another engine has others, which a changed one prints in its detail.
StressResult same_bits() {
  constexpr std::array<std::uint64_t, 2 * std::size(kSceneKinds)> kRecorded = {
      0xd1aaf19c6793384d, 0xdb5e81bfbb879695, 0x8b974ec2e0747aa6, 0x7868f1b67d9e01b7,
      0xd49f3dfce5b92ac5, 0xf1a75783cbe5af4a, 0xc639f0c4a68f07c2, 0x2a12f6c65b31e6da,
      0x57640657db12bca0, 0xc6773e0f4b0000,   0x3121901378fd7556, 0xc3ab5b24766ebef5,
      0x5db3644801f06359, 0x80ccb09c4c3bbd9b, 0x7afa46f2110aef10, 0xe958c88ce6ed2195};
  std::array<std::uint64_t, kRecorded.size()> found{};
  const auto add = [&]<int D>(Scene<D> scene) {
    // Of what flies, the splittings, too.
    if (scene.is(SceneKind::free) || scene.is(swarm))
      scene.config.rotation = integration(scene.config.integrator).order == 1
                                  ? RotationMethod::splitting_2
                                  : RotationMethod::splitting_4;
    std::uint64_t& hash = found[static_cast<std::size_t>(scene.kind) * 2 + (D - 2)];
    hash = hash * 0x100000001b3u + after(scene).hash();
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
  return [figure] { return worst_over({soft, impulse, ContactMethod::direct}, figure); };
}

// --- smooth motion ---

// How far the order of convergence towards RK4 by the finest steps is from the method's own.
template <int D>
double off_order(SceneKind kind, Integrator integrator) {
  const bool is_chain = kind == SceneKind::chain, of_places = integration(integrator).of_places;
  const auto by = [&](Integrator one) {
    Scene<D> scene = SceneOf<D>(kind, none, one).scene();
    scene.steps = 24;
    if (of_places) {
      for (Spring<D>& spring : scene.springs) spring.damping = 0;
    } else if (!is_chain) {
      scene.bodies[0].body.linear_drag = 0.5, scene.bodies[2].body.linear_drag = 0.3;
      if (D == 2) scene.bodies[0].body.angular_drag = 0.1;
    }
    return scene;
  };
  const auto in_steps = [&](Integrator one, int count) {
    Scene<D> scene = by(one);
    scene.h *= static_cast<double>(scene.steps) / count;
    return after((scene.steps = count, scene));
  };
  const int count = of_places                                              ? 6 * (D - 1)
                    : is_chain && integrator == Integrator::explicit_euler ? 768
                                                                           : 48;
  const World<D> exact = in_steps(Integrator::runge_kutta_4, 1536);
  const double coarse = Telling<D>().apart(in_steps(integrator, count), exact);
  const double fine = Telling<D>().apart(in_steps(integrator, 2 * count), exact);
  // Joints are moved by Verlet then.
  const bool better = is_chain && integrator == Integrator::semi_implicit_euler;
  return std::abs(std::log2(coarse / fine) - (better ? 2 : integration(integrator).order));
}

template <SceneKind Of>
StressResult orders() {
  double worst = 0;
  std::string where;
  for (std::size_t i = 0; i < integrator_names().size(); ++i) {
    const auto integrator = static_cast<Integrator>(i);
    if (Of == chain && integration(integrator).of_places) continue;
    const double off = largest(off_order<2>(Of, integrator), off_order<3>(Of, integrator));
    if (!(off <= worst)) where = to_string(integrator);
    worst = largest(worst, off);
  }
  return at_most(0.3, worst, "of an order", where);  // another order is 1 off, or 2
}

// What scenes keep that nothing pushes from outside: momentum, with which their middle moves on;
// and, as well as the method can, its moment. By RK4 also energy, but for blows; and joints hold.
// How far that is from what is allowed.
template <int D>
double lost(Scene<D> scene) {
  const bool fine = scene.config.integrator == Integrator::runge_kutta_4 && !scene.is(swarm);
  if (fine) scene.h /= 8, scene.steps = 200;
  for (Spring<D>& spring : scene.springs) spring.damping = 0;
  World<D> world = scene.made();
  const auto middle = [&] {
    Vec<D> sum(0.0);
    for (const Body<D>& body : world.bodies()) sum += body.position * body.mass;
    return sum;
  };
  const Vec<D> p = momentum<D>(world.bodies()), from = middle();
  const Spin<D> l = angular_momentum<D>(world.bodies());
  const double energy = total_energy(world), allowed[] = {1, 1e-12, 1e-12, 1e-4, 0.03, 1, 1, 1};
  return worst_after_steps(world, scene.steps, scene.h, [&] {
    const double held = largest(widest_gap(world) / 1e-8,
                                fine ? std::abs(total_energy(world) - energy) / 5e-8 : 0.0);
    if (scene.is(chain)) return held;
    const Spin<D> made = angular_momentum<D>(world.bodies()) - l;
    return largest({held, glm::length(momentum<D>(world.bodies()) - p) / 1e-12,
                    glm::length(middle() - from - p * world.time()) / 1e-12,
                    std::sqrt(geometry::dot(made, made)) /
                        allowed[static_cast<int>(scene.config.integrator)]});
  });
}

// --- blows ---

// Two bodies meet at one point as they fall, first without friction. Until then they fly on
// parabolas, and apart, all the more so for as long as a look at them says they do; at the moment
// of impact they touch; and by Newton's law j = -(1 + e) v_n / (1/m_a + 1/m_b + ...). With friction
// that law alone would give energy, which no blow does. What of it does not hold.
template <int D>
double blows(ContactMethod method) {
  double worst = 0;
  Random random(11);
  for (int round = 0; round < 80; ++round) {
    Scene<D> scene{{.gravity = at<D>(3, -9),
                    .integrator = Integrator::velocity_verlet,
                    .contacts = method,
                    .may_sleep = false}};
    const double e = round % 3 == 0 ? 0.2 : round % 3 == 1 ? 1 : 0.5, mu = round < 40 ? 0 : 0.6;
    for (const double side : {-1.0, 1.0}) {
      Vec<D> half(0.3);
      half.x = 0.2, half[D - 1] = 0.5;
      Body<D> body = make_body<D>(round % 2 == 0 || side < 0 ? Shape<D>(OrientedBox<D>{half})
                                  : round % 4 == 1           ? Shape<D>(Sphere{0.4})
                                                             : Shape<D>(Capsule{0.1, 0.4}),
                                  at<D>(side * 1.2, side * 0.1));
      body.mass = 0.05 * std::pow(400, random.unit());
      body.material = {e, mu};
      scene.bodies.push_back({body});
      toss(scene.bodies.back(), random, 0, 30);
      scene.bodies.back().body.velocity = at<D>(-side * random.between(1, 20));
    }
    World<D> world = scene.made();
    world.keep_impact_looks(true);
    for (int i = 0; i < 60 && world.contacts().empty(); ++i) {
      const std::vector<Body<D>> before = world.bodies();
      const Energy had = energy<D>(before, world.forces());
      world.step(1.0 / 30);
      worst = largest(worst, (total_energy(world) - had.total()) / had.kinetic() * 1e2);
      const auto& [moments, looks, kept] = world.impacts();
      const auto flown = [&](std::size_t which, double t) {
        Body<D> body = before[which];
        body.position += (body.velocity + scene.config.gravity * (t / 2)) * t;
        body.orientation = freely_turned(body, t);
        return body;
      };
      const auto gap = [&](double t) {
        const auto seen = collide<D>(placed(flown(0, t)), placed(flown(1, t)), 100);
        double least = kInfinity;
        for (const auto& point : seen->points()) least = std::min(least, point.separation);
        return least;
      };
      for (const ImpactLook<D>& look : looks) {
        if (!moments.empty() && look.time > moments[0].time) break;
        worst = largest({worst, glm::length(look.a.position - flown(0, look.time).position),
                         glm::length(look.b.position - flown(1, look.time).position)});
        for (int k = 0; k < 8 && look.free_until > look.time; ++k)
          worst = largest(worst, -gap(look.time + (look.free_until - look.time) * k / 7));
      }
      if (moments.empty() && !(gap(1.0 / 30) > 0)) return kInfinity;
      if (moments.size() != 1) continue;
      worst = largest(worst, std::abs(gap(moments[0].time)) * 1e-4);
      const Body<D>&a = world.bodies()[0], &b = world.bodies()[1];
      const Vec<D> fallen = scene.config.gravity / 30.0,
                   push = (b.velocity - before[1].velocity - fallen) * b.mass;
      worst =
          largest(worst, glm::length((a.velocity - before[0].velocity - fallen) * a.mass + push));
      if (mu > 0) break;
      // Speed along the impulse, of the points that met.
      const auto along = [&](const std::vector<Body<D>>& of) {
        double sum = glm::dot(of[1].velocity - of[0].velocity, push);
        for (std::size_t k = 0; k < 2; ++k) {
          Body<D> then = flown(k, moments[0].time);
          const Spin<D> twist = world.bodies()[k].angular_momentum - then.angular_momentum;
          then.angular_momentum = of[k].angular_momentum;
          sum += geometry::dot(angular_velocity(then), twist);
        }
        return sum / glm::length(push);
      };
      worst = largest(worst, std::abs(along(world.bodies()) + e * along(before)));
      break;
    }
  }
  return worst;
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
    World<3> world = world_of<3>({.contacts = none}, {body});
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

// By how much of an order the splittings' errors shrink otherwise than they should, as their step
// is halved; against the exact turn, of boxes of three sides.
double splittings() {
  double worst = 0;
  for (const auto& [method, order] :
       {std::pair(RotationMethod::splitting_2, 2), std::pair(RotationMethod::splitting_4, 4)}) {
    Random random(23);
    double coarse = 0, fine = 0;
    for (int round = 0; round < 60; ++round) {
      const Vec<3> half(1, random.between(0.5, 0.8), random.between(0.2, 0.4));
      Moving<3> one{make_body<3>(OrientedBox<3>{half}, Vec<3>(0.0))};
      toss(one, random, 0, 1);
      const Body<3> body = Scene<3>{.config = {}, .bodies = {one}}.made().bodies()[0];
      const auto off = [&, by = method](double h) {
        const auto turn = [&](RotationMethod it) {
          return freely_turned(body, body.angular_momentum, h, it);
        };
        return glm::length(turn_between(turn(RotationMethod::exact), turn(by)));
      };
      coarse += off(0.1), fine += off(0.05);
    }
    worst = largest(worst, std::abs(std::log2(coarse / fine) - order - 1));
  }
  return worst;
}

// --- what contacts tell ---

// Laws of contacts, at each step in which nothing bounces: they make no energy, nor do blows where
// nothing falls. A body's momentum
// changes by gravity and the impulses that its contacts tell, which push, and rub by mu times that
// at most. Where a step is one part, each presses, or parts, or comes no nearer than to touch; and
// its friction is the least that stops a slip, or full and against it (Signorini, Coulomb). How far
// that is from what is allowed.
template <int D>
double unsettled(Scene<D> scene) {
  const bool told = scene.is(slope) || scene.is(stack);
  const bool whole = told && !scene.is_of({lecture}) && (scene.is(slope) || !scene.is_of({soft}));
  if (whole) scene.config.sub_steps = 1, scene.config.iterations = 1000;
  const double off = scene.is(stack) ? 0.05 : scene.config.contacts == impulse ? 3e-4 : 1e-7;
  World<D> world = scene.made();
  double worst = 0;
  for (int step = 0; step < scene.steps; ++step) {
    const std::vector<Body<D>> before = world.bodies();
    const WorldWork work = world.work();
    world.step(scene.h);
    if (work_between(work, world.work()).impacts_located > 0 && !scene.is(room)) continue;
    const auto moved = [&](BodyId id) {  // as it was, but for its motion
      Body<D> body = before[id];
      body.velocity = world.bodies()[id].velocity;
      body.angular_momentum = world.bodies()[id].angular_momentum;
      return body;
    };
    std::vector<Vec<D>> got(before.size(), scene.config.gravity * scene.h);
    for (const Contact<D>& contact : world.contacts()) {
      const Body<D>&a = before[contact.a], &b = before[contact.b];
      const Vec<D> n = contact.manifold.normal;
      const bool rolls = !std::holds_alternative<OrientedBox<D>>(b.shape);
      for (int i = 0; i < contact.manifold.count && told; ++i) {
        const ManifoldPoint<D>& point = contact.manifold.room[static_cast<std::size_t>(i)];
        const double press = contact.normal_impulses[static_cast<std::size_t>(i)],
                     most = std::sqrt(a.material.friction * b.material.friction) * press;
        const Vec<D> rub = contact.friction_impulses[static_cast<std::size_t>(i)];
        worst = largest({worst, -press / 1e-13, (glm::length(rub) - most) / 1e-13});
        got[contact.b] += (n * press + rub) * b.inverse_mass;
        got[contact.a] -= (n * press + rub) * a.inverse_mass;
        double rubs = kInfinity, parts = 0;
        for (const double share : {-0.5, 0.0, 0.5}) {  // where between the surfaces
          const Vec<D> where = point.position + n * (point.separation * share),
                       u = velocity_at(moved(contact.b), where - b.position) -
                           velocity_at(moved(contact.a), where - a.position);
          parts = glm::dot(u, n);
          const Vec<D> stop = rub - (u - n * parts);
          rubs = std::min(rubs, glm::length(stop * std::min(1.0, most / glm::length(stop)) - rub));
        }
        const double gap = largest(point.separation, 0.0) / scene.h;
        if (whole)
          worst = largest(
              {worst, std::abs(std::min(parts + gap, press)) / off, rolls ? 0 : rubs / off});
      }
    }
    double made = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      Body<D> was = before[i];
      if (!was.is_dynamic()) continue;
      const Body<D>& now = world.bodies()[i];
      // Where a normal turns within the step, its impulses are not all along its last one.
      if (told)
        worst = largest(worst, glm::length(now.velocity - was.velocity - got[i]) /
                                   (scene.is(slope) ? 1e-13 : 0.02));
      was.velocity += scene.config.gravity * scene.h;
      for (const auto& [body, sign] : {std::pair(now, 0.5), std::pair(was, -0.5)})
        made += sign * (body.mass * glm::dot(body.velocity, body.velocity) +
                        geometry::dot(body.angular_momentum, angular_velocity(body)));
    }
    worst = largest(worst, made / 1e-9);
  }
  return worst;
}

}  // namespace

std::vector<StressCase> law_cases() {
  constexpr const char* kGroup = "laws";
  constexpr const char* kOrders = "Errors shrink by the order of each method, in 2D and 3D.";
  return {
      {"orders_of_springs", kGroup, kOrders, orders<SceneKind::free>},
      {"orders_of_chains", kGroup, kOrders, orders<chain>},
      {"turned_freely", kGroup, "Free boxes turn as Euler's equations say.",
       none_above(1e-7, "of a unit vector", "120 boxes, to 60 rad/s, steps to 1 s", turned_freely)},
      {"splittings", kGroup, "Splittings of the rotation are of order 2 and 4.",
       none_above(0.3, "of an order", "60 boxes, steps of 0.1 and 0.05 radians", splittings)},
      {"blows", kGroup, "A blow between two bodies obeys Newton's law, by every method.",
       none_above(5e-12, "SI units", "80 pairs each, to 40 m/s, restitution 0.2, 0.5, 1",
                  by_methods(blows<2>), by_methods(blows<3>))},
      {"same_bits", kGroup, "Scenes move bit for bit as they did when this was written.",
       same_bits},
      law(kLeftOut, "kept", "Momentum, its moment and energy are kept, and joints hold.", 1,
          "of what is allowed", [](const auto& s) { return lost(s); }),
      law(kLeftOut, "settled",
          "Contacts press or part, friction stops or slips, and none makes energy.", 1,
          "of what is allowed", [](const auto& s) { return unsettled(s); }),
      law(kLeftOut, "two_ways", "All rows at once move bodies as sweeps do that go on for long.", 1,
          "of what is allowed", [](const auto& s) { return two_ways(s); }),
      law(kLeftOut, "in_other_units",
          "Scenes move the same in other units of length, time and mass.", 1e-12, "m, m/s, kg m2/s",
          []<int D>(const Scene<D>& s) {
            return Telling<D>{.length = 4, .time = 2, .mass = 8}.parted(s);
          }),
      law(kLeftOut, "in_mirrors",
          "Scenes move the same along other axes, in a mirror, and in passing.", 5e-12,
          "m, m/s, kg m2/s", [](const auto& s) { return in_mirrors(s); }),
      law(kLeftOut, "beside_others", "Scenes move bit for bit the same beside others, far away.", 0,
          "m, m/s, kg m2/s", [](const auto& s) { return beside_others(s); }),
      law(kLeftOut, "plane_in_space", "Plane scenes move the same in space.", 5e-10,
          "m, m/s, kg m2/s", [](const auto& s) { return plane_in_space(s); })};
}

}  // namespace lantern::measure
