// The narrow phase at the limits of size, shape and angle.

#include "measure/stress_scenes.hpp"

namespace lantern::measure {
namespace {

using namespace stress;

template <int D>
bool is_sane(const Manifold<D>& manifold) {
  for (const ManifoldPoint<D>& point : manifold.points())
    if (!geometry::is_finite<D>(point.position) || !std::isfinite(point.separation)) return false;
  return manifold.count > 0 && std::abs(glm::length(manifold.normal) - 1) <= 1e-14;
}

// --- parallel and nearly parallel edges ---

// Two boxes meet edge to edge, the second turned a little: how far the normal jumps from one angle
// to the next beyond 100 times the turn; endless if it is not finite and unit.
//
//      /\  /\      each stands on an edge along z; what is
//     /a \/b \     nearly parallel are the two edges that meet
//     \  /\  /
StressResult parallel_edges() {
  const double root = std::sqrt(2.0), eighth = std::atan(1.0);
  const Rotation<3> on_edge = turned(Rotation<3>{}, Vec<3>(0, 0, eighth));
  const Shape<3> box = OrientedBox<3>{Vec<3>(1.0)};
  double worst = 0;
  int tried = 0;
  for (const double gap : {-0.01, -1e-9, 0.0, 0.01}) {
    Vec<3> previous(0.0);
    for (const double turn :
         {0.0, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 0.99e-6, 1e-6, 1.01e-6, 1e-5})
      for (const Vec<3>& about : {Vec<3>(1, 0, 0), Vec<3>(0, 1, 0), Vec<3>(1, 1, 0),
                                  Vec<3>(1, 2, 3), Vec<3>(-3, 1, -2)}) {
        const Rotation<3> turned_on = turned(on_edge, glm::normalize(about) * turn);
        const auto found = collide<3>({box, Vec<3>(0.0), on_edge},
                                      {box, {2 * root + gap, 0.1, 0.2}, turned_on}, 0.1);
        ++tried;
        if (!found || !is_sane(*found)) return at_most(1e-3, kInfinity, "rad", "no unit normal");
        if (previous != Vec<3>(0.0))
          worst = largest(worst, glm::length(found->normal - previous) - 100 * turn);
        previous = found->normal;
      }
  }
  return at_most(1e-3, worst, "rad",
                 fmt::format("the normal's largest jump, {} angles of 0, 1e-16 ... 1e-5", tried));
}

StressResult parallel_capsules() {
  const Shape<3> rod = Capsule{0.1, 1e4};
  double worst = 0;
  for (const double turn : {0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6}) {
    const auto found = collide<3>(
        {rod, Vec<3>(0.0), {}}, {rod, {0.2, 10, 0}, turned(Rotation<3>{}, Vec<3>(turn, 0, 0))}, 1);
    if (!found || !is_sane(*found)) return at_most(1e-8, kInfinity, "rad", "no unit normal");
    worst = largest(worst, glm::length(found->normal - Vec<3>(1, 0, 0)));
  }
  return at_most(1e-8, worst, "rad", "the normal's error; rods of 1 : 1e5, 0 ... 1e-6 rad apart");
}

// --- common centres ---

template <int D>
int insane_centres(int& tried) {
  const Shape<D> shapes[] = {Sphere{1}, Sphere{0}, AxisBox<D>{Vec<D>(1.0)},
                             OrientedBox<D>{Vec<D>(1.0)}, Capsule{0.5, 1}};
  int insane = 0;
  Vec<D> place(3.0);
  for (const Shape<D>& a : shapes)
    for (const Shape<D>& b : shapes)
      for (const double apart : {0.0, 1e-300, 1e-160, 1e-16}) {
        const Vec<D> other = place + at<D>(apart);
        const auto found = collide<D>({a, place, {}}, {b, other, {}}, 0);
        const auto again = collide<D>({a, place, {}}, {b, other, {}}, 0);
        ++tried;
        insane += !found || !is_sane(*found) || found->normal != again->normal;
      }
  return insane;
}

// --- sizes ---

// Balls and boxes of size ratio 1e-6 ... 1e6 in any direction, with the closed form of their
// distance: the largest error in parts of the larger size.
template <int D>
double ratio_error() {
  Random random(D);
  double worst = 0;
  for (const double ratio : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (int round = 0; round < 200; ++round) {
      const double radius = ratio * random.between(0.1, 1), larger = largest(1.0, radius);
      const Vec<D> place = random_direction<D>(random) * (random.between(1, 2) + radius);
      const Shape<D> unit = Sphere{1}, ball = Sphere{radius}, box = AxisBox<D>{Vec<D>(1.0)};
      const auto balls = collide<D>({unit, Vec<D>(0.0), {}}, {ball, place, {}}, 1e9);
      const auto mixed = collide<D>({box, Vec<D>(0.0), {}}, {ball, place, {}}, 1e9);
      if (!balls || !mixed || !is_sane(*balls) || !is_sane(*mixed)) return kInfinity;
      worst = largest(
          worst, std::abs(balls->room[0].separation - (glm::length(place) - 1 - radius)) / larger);
      double beyond = 0;  // squared distance from the box, where the centre is outside
      for (int i = 0; i < D; ++i) {
        const double over = largest(0.0, std::abs(place[i]) - 1);
        beyond += over * over;
      }
      if (beyond < 1e-12) continue;
      worst = largest(worst,
                      std::abs(mixed->least_separation() - (std::sqrt(beyond) - radius)) / larger);
    }
  return worst;
}

// Boxes of 1 : 1e4 turned about: parted along the normal by what the contact says, they touch no
// more. The largest rest, in parts of the longer side.
template <int D>
double needle_error() {
  Random random(D + 10);
  double worst = 0;
  for (int round = 0; round < 500; ++round) {
    Vec<D> half_a(1.0), half_b(1.0);
    half_a[static_cast<int>(random.whole(0, D - 1))] = 1e4;
    half_b[static_cast<int>(random.whole(0, D - 1))] = 1e4;
    const Rotation<D> turn_a = random_rotation<D>(random), turn_b = random_rotation<D>(random);
    const Shape<D> a = OrientedBox<D>{half_a}, b = OrientedBox<D>{half_b};
    const Vec<D> place = random_direction<D>(random) * random.between(0, 1e4);
    const auto found = collide<D>({a, Vec<D>(0.0), turn_a}, {b, place, turn_b}, 1e9);
    if (!found || !is_sane(*found)) return kInfinity;
    const double separation = found->least_separation();
    if (separation > 0) continue;
    const auto parted =
        collide<D>({a, Vec<D>(0.0), turn_a}, {b, place - found->normal * separation, turn_b}, 1e9);
    if (!parted || !is_sane(*parted)) return kInfinity;
    worst = largest(worst, std::abs(parted->least_separation()) / 1e4);
  }
  return worst;
}

// Points and lines that meet, or miss each other by 5e-7.
StressResult zero_size_contacts() {
  const Shape<3> points[] = {Sphere{0}, AxisBox<3>{}, OrientedBox<3>{}, Capsule{}};
  double worst = 0;
  for (const Shape<3>& a : points)
    for (const Shape<3>& b : points) {
      const auto meet = collide<3>({a, {1, 2, 3}, {}}, {b, {1, 2, 3}, {}}, 0);
      const auto miss = collide<3>({a, {1, 2, 3}, {}}, {b, {1, 2 + 3e-7, 3 + 4e-7}, {}}, 1);
      if (!meet || !miss || !is_sane(*meet) || !is_sane(*miss))
        return at_most(5e-15, kInfinity, "m", "no contact, or no unit normal");
      worst = largest(
          {worst, std::abs(meet->room[0].separation), std::abs(miss->room[0].separation - 5e-7)});
    }
  return at_most(5e-15, worst, "m", "error of their separation");
}

// A static point and a dynamic one with a mass, and a box that falls onto the first: how far they
// end from where they must.
template <int D>
double zero_size_error() {
  World<D> world(with_gravity<D>());
  Body<D> point = make_ball<D>(Vec<D>(0.0), 0);
  if (!refusal([&] { world.add(point); })) return kInfinity;  // dynamic, without a mass
  point.kind = BodyKind::static_body;
  world.add(point);
  world.add(make_floor<D>(-2));
  Body<D> falls = make_ball<D>(at<D>(3), 0);
  falls.mass = 1;
  world.add(falls);
  run(world, 2);
  return is_finite(world) ? std::abs(world.bodies()[2].position.y + 2) : kInfinity;
}

// How far what moves is from where it would be, had all of it not been moved by `offset` on every
// axis but the height.
template <int D>
double worst_deviation(double offset, int steps) {
  Vec<D> away(offset);
  away.y = 0;
  double worst = 0;
  for (const SceneKind kind : {SceneKind::free, SceneKind::chain, SceneKind::stack}) {
    Scene<D> near = SceneOf<D>(kind, ContactMethod::soft, Integrator::semi_implicit_euler).scene();
    near.steps = steps;
    Scene<D> far = near;
    for (Moving<D>& one : far.bodies) one.body.position += away;
    const World<D> here = after(near), there = after(far);
    for (std::size_t i = 0; i < here.bodies().size(); ++i)
      worst = largest(worst,
                      glm::length(there.bodies()[i].position - away - here.bodies()[i].position));
  }
  return worst;
}

StressResult moved_by(double offset) {
  const int steps = 30;
  const double ulp = std::nextafter(offset, 2 * offset) - offset;
  const double worst =
      largest(worst_deviation<2>(offset, steps), worst_deviation<3>(offset, steps));
  return at_most(20, worst / ulp / steps, "ulp a step",
                 fmt::format("{:.1e} m after {} steps, 2D and 3D", worst, steps));
}

template <int D>
double settling_error() {
  const double offset = 1e7;
  World<D> world =
      world_of<D>(with_gravity<D>(), {make_floor<D>(), make_box<D>(at<D>(offset, 0.6))});
  run(world, 10);
  return glm::length(world.bodies()[1].position - at<D>(offset, 0.5));
}

// Boxes of all sizes that touch or overlap by the least, far away. The narrow phase subtracts
// positions first and finds them; rounded as they are, their enveloping boxes must let it look.
template <int D>
int contacts_unseen(double offset, int& touching) {
  Random random(11);
  int unseen = 0;
  for (int round = 0; round < 1000; ++round) {
    Vec<D> place, way(0.0);
    for (int i = 0; i < D; ++i) place[i] = offset + random.between(-1, 1);
    way[static_cast<int>(random.whole(0, D - 1))] = 1;
    const double size = round % 2 == 0 ? 1 : 1e-3;
    const double a = size * random.between(0.1, 1), b = size * random.between(0.1, 1);
    World<D> world((WorldConfig<D>()));
    world.add(make_body<D>(AxisBox<D>{Vec<D>(a)}, place, "first"));
    world.add(make_body<D>(AxisBox<D>{Vec<D>(b)}, place + way * (a + b), "second"));
    const Body<D>&first = world.bodies()[0], &second = world.bodies()[1];
    if (!collide<D>({first.shape, first.position, {}}, {second.shape, second.position, {}}, 0))
      continue;
    ++touching;
    world.step(1e-9);
    unseen += world.pairs().empty();
  }
  return unseen;
}

StressResult boxes_round_outward() {
  int touching = 0, unseen = 0;
  for (const double offset : {0.0, 1e6, 1e9})
    unseen += contacts_unseen<2>(offset, touching) + contacts_unseen<3>(offset, touching);
  return at_most(0, unseen, "contacts",
                 fmt::format("that the broad phase does not see, of {}", touching));
}

}  // namespace

std::vector<StressCase> shape_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"parallel_edges", kGroup, "Nearly parallel box edges keep their normal.", parallel_edges},
      {"parallel_capsules", kGroup, "Nearly parallel capsules keep their normal.",
       parallel_capsules},
      {"fallback_normal", kGroup, "Shapes with a common centre get a fixed normal of unit length.",
       none_wrong("normals", "not finite, unit and fixed, of {} pairs of shapes", insane_centres<2>,
                  insane_centres<3>)},
      {"contact_size_ratio", kGroup, "Contacts are exact at size ratios from 1e-6 to 1e6.",
       none_above(1e-14, "of the size", "separations of balls and boxes, ratios 1e-6 ... 1e6",
                  ratio_error<2>, ratio_error<3>)},
      {"contact_aspect_ratio", kGroup, "Contacts of boxes of 1 : 1e4 part them.",
       none_above(1e-14, "of the size",
                  "left over when boxes of 1 : 1e4 are parted as their contact says",
                  needle_error<2>, needle_error<3>)},
      {"zero_size_contacts", kGroup, "Shapes of no size have exact contacts.", zero_size_contacts},
      {"zero_size", kGroup, "A shape of no size is legal if static, or with an explicit mass.",
       none_above(1e-9, "m",
                  "a point with a mass on the floor, 2D and 3D; without one it is refused",
                  zero_size_error<2>, zero_size_error<3>)}};
}

// Far from the origin: the same motion, but for the digits that the place itself takes away.

std::vector<StressCase> origin_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"origin_moved_by_1e6", kGroup, "A million metres away the relative motion is the same.",
       [] { return moved_by(1e6); }},
      {"origin_moved_by_1e9", kGroup, "A billion metres away the relative motion is the same.",
       [] { return moved_by(1e9); }},
      {"far_from_origin", "bars", "A box settles in its place, 1e7 m from the origin.",
       none_above(1e-8, "m", "a box that settles 1e7 m away, 2D and 3D", settling_error<2>,
                  settling_error<3>)},
      {"boxes_round_outward", kGroup,
       "Shapes that touch have boxes that do, however far from the origin.", boxes_round_outward}};
}

}  // namespace lantern::measure
