#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"
#include "draw/sample_frames.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/level.hpp"
#include "frame/parts/motion.hpp"
#include "geometry/flat.hpp"

namespace lantern::draw::samples {
namespace {

FrameBody wall(BodyId id, std::string name, Vec<2> at, Vec<2> half) {
  FrameBody b = body(id, std::move(name), Look::box, 1, at, AxisBox<2>{half});
  b.is_static = true;
  return b;
}

FrameBody ground(BodyId id, Vec<2> at, Vec<2> normal) {
  FrameBody b = body(id, "ground", Look::box, 1, at, HalfSpace<2>{normal});
  b.is_static = true;
  return b;
}

Frame shapes() {
  Frame frame = base("Five shapes", {{0, 0}, {16, 9}}, {panel_named("world")});
  frame.bodies = {ground(0, {0, 1}, {0, 1}),
                  body(1, "crate", Look::box, 4, {3, 3.2}, OrientedBox<2>{{1.2, 0.7}}, 0.5),
                  body(2, "pill", Look::box, 5, {7, 3}, Capsule{0.6, 0.9}, -0.7),
                  body(3, "wheel", Look::disc, 1, {10.5, 2.4}, Sphere{1.1}, 0.9),
                  body(4, "ghost", Look::ghost, 2, {13.4, 3}, Sphere{0.9}),
                  wall(5, "pillar", {14.8, 6.5}, {0.5, 1.4}),
                  body(6, "sleeper", Look::box, 7, {2, 7}, OrientedBox<2>{{0.8, 0.8}}, 0.2),
                  body(7, "dreamer", Look::ghost, 6, {5, 7}, Sphere{0.8}),
                  body(8, "culled", Look::disc, 3, {8, 7}, Sphere{0.8}),
                  body(9, "culled ghost", Look::ghost, 8, {11, 7}, Sphere{0.8})};
  frame.bodies[6].asleep = frame.bodies[7].asleep = true;
  frame.bodies[8].dimmed = frame.bodies[9].dimmed = true;
  frame.bodies[1].lit = true;
  frame.bodies[1].velocity = {1.5, -1, 0};
  frame.bodies[4].velocity = {-0.6, 0.4, 0};
  frame.display.boxes = frame.display.arrows = true;
  frame.caption = "Every shape has a box around it; the broad phase sees nothing else.";
  return frame;
}

Frame slope() {
  Frame frame = base("On a slope", {{-8, 0}, {8, 9}}, {panel_named("world")});
  const Vec<2> n{std::sin(0.3), std::cos(0.3)};
  frame.bodies = {ground(0, {0, 3}, n)};
  const double angle = -0.3;
  const Vec<2> along{std::cos(angle), std::sin(angle)};
  for (BodyId i = 0; i < 3; ++i) {
    const Vec<2> at = Vec<2>(0, 3) + along * (4.0 * i - 4) + n * 1.0;
    frame.bodies.push_back(body(i + 1, fmt::format("box {}", i + 1), Look::box, int(i) * 2 + 2, at,
                                OrientedBox<2>{{1.3, 1.0}}, angle));
    FrameContact contact;
    contact.pair = {0, i + 1};
    contact.normal = solid(n);
    contact.begins = i == 2;
    for (const double side : {-1.3, 1.3})
      contact.points.push_back({solid(at - n * 1.0 + along * side), -0.01, i * (2.0 + side)});
    frame.contacts.push_back(contact);
    frame.pairs.push_back({{0, i + 1}, i == 2});
  }
  frame.counts = {{"bodies", 4}, {"pairs", 3}, {"contacts", 6}};
  frame.caption = "The lower edge of each box bears more than the upper one.";
  return frame;
}

Frame stack(int height) {
  Frame frame = base("A stack", {{-6, 0}, {6, 9}}, {panel_named("world")});
  frame.bodies = {ground(0, {0, 0}, {0, 1})};
  const double size = 7.0 / height;
  for (int i = 0; i < height; ++i) {
    const auto id = static_cast<BodyId>(i + 1);
    frame.bodies.push_back(body(id, fmt::format("{}", i + 1), Look::box, i % 8 + 1,
                                {0.02 * i, size * (i + 0.5)}, OrientedBox<2>{{size / 2, size / 2}},
                                0.01 * i));
    FrameContact contact;
    contact.pair = {id - 1, id};
    contact.normal = {0, 1, 0};
    for (const double x : {-size / 2, size / 2})
      contact.points.push_back({{x, size * i, 0}, 0, 10.0 * (height - i)});
    frame.contacts.push_back(contact);
  }
  frame.caption = "The lowest box bears all the others.";
  return frame;
}

Frame linked() {
  Frame frame = base("Springs, rods and pins", {{0, 0}, {16, 9}}, {panel_named("world")});
  frame.bodies = {wall(0, "beam", {8, 8.4}, {7.5, 0.3})};
  for (BodyId i = 1; i <= 5; ++i)
    frame.bodies.push_back(body(i, fmt::format("weight {}", i), Look::disc, int(i),
                                {3.0 * i - 1, 6.6 - i}, Sphere{0.5}, 0.3 * i));
  using Kind = FrameLink::Kind;
  const double strains[] = {0, 0.3, 1.4, -0.4, 0};
  const Kind kinds[] = {Kind::spring, Kind::spring, Kind::spring, Kind::spring, Kind::distance};
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec<3> to = frame.bodies[i + 1].position;
    frame.add<FrameLinks>().links.push_back({kinds[i], {to.x, 8.1, 0}, to, strains[i]});
  }
  frame.add<FrameLinks>().links.push_back({Kind::pin, {1, 8.4, 0}, {1, 8.4, 0}, 0});
  frame.caption = "A stretched spring pulls, a pressed one pushes.";
  return frame;
}

Frame rays() {
  Frame frame = crowd(12, 3);
  frame.title = "Rays";
  frame.structure = StructureKind::quadtree;
  FrameRay ray{{4, 5, 0}, {96, 60, 0}, {}};
  for (std::size_t i = 0; i < 5; ++i)
    ray.hits.push_back(
        {static_cast<BodyId>(i), {20 + 15.0 * double(i), 14.5 + 9.0 * double(i), 0}});
  frame.add<FrameFinding>().rays = {
      ray, {{4, 60, 0}, {60, 62, 0}, {{3, {60, 62, 0}}}}, {{50, 3, 0}, {160, -20, 0}, {}}};
  for (FrameBody& b : frame.bodies) b.dimmed = b.id % 3 == 0;
  frame.add<FrameFinding>().queries = {{solid(Box<2>{{70, 5}, {92, 25}}), 0},
                                       {solid(Box<2>{{30, 40}, {50, 60}}), 10}};
  frame.caption = "A ray meets the nearest body first.";
  return frame;
}

Frame culled(std::size_t bodies) {
  Frame frame = crowd(bodies, bodies > 100 ? 0.4 : 2.4);
  frame.title = "What the view sees";
  frame.add<FrameFinding>().views = {{{10, 35, 0}, {{10, 35, 0}, {95, 4, 0}, {95, 66, 0}}}};
  for (FrameBody& b : frame.bodies)
    b.dimmed = std::abs(b.position.y - 35) > (b.position.x - 10) * 31 / 85;
  frame.caption = "Bodies outside the wedge are ruled out with their whole cells.";
  return frame;
}

Frame level() {
  Frame frame = doom();
  frame.panels = {panel_named("world"), panel_named("tree")};
  frame.add<FrameLevel>().walls = {{{2, 2}, {10, 1}, 0, 0, Mark::quiet},
                                   {{10, 1}, {11.2, 5}, 1, 0, Mark::lit},
                                   {{12.5, 3}, {12.9, 8}, 2, 0, Mark::quiet},
                                   {{12.9, 8}, {13.5, 12}, 2, 1, Mark::quiet},
                                   {{2, 12}, {9, 11}, 3, 0, Mark::passed}};
  frame.add<FrameLevel>().eye = Vec<2>(6, 4.5);
  std::uint32_t order = 0;
  for (FrameNode& node : frame.nodes) {
    if (!node.leaf) continue;
    node.order = order++;
    node.solid = order == 4;
    node.mark = order == 3 ? Mark::lit : Mark::quiet;
  }
  frame.nodes[1].mark = Mark::lit;
  frame.caption = "From the eye the sectors are visited from near to far.";
  return frame;
}

// Two trees over one world: of what never moves, and of what does.
Frame forest(std::size_t movers, std::size_t walls) {
  Frame frame = crowd(movers, 2.2);
  Frame still = crowd(walls, 3.2);
  frame.title = "What never moves has a tree of its own";
  const auto offset = static_cast<std::uint32_t>(frame.nodes.size());
  const auto ids = static_cast<BodyId>(frame.bodies.size());
  for (FrameBody& b : still.bodies) {
    b.id += ids;
    b.name = "wall " + std::to_string(b.id);
    b.look = Look::box;
    b.is_static = true;
    b.lit = false;
    b.shape = in_dimension<3>(Shape<2>(AxisBox<2>{{3.2, 3.2}}));
    b.position.x = 100 - b.position.x;
    b.box = Box<3>::around(b.position, {3.2, 3.2, 0});
    frame.bodies.push_back(b);
  }
  for (FrameNode& node : still.nodes) {
    node.id += offset;
    if (node.parent != kNone) node.parent += offset;
    for (BodyId& id : node.bodies) id += ids;
    node.of_static = true;
    node.mark = Mark::quiet;
    frame.nodes.push_back(node);
  }
  frame.caption = "The static tree is built once.";
  return frame;
}

Frame sleepers() {
  Frame frame = crowd(12, 3);
  frame.title = "Asleep";
  for (FrameNode& node : frame.nodes) node.awake = !(node.label[0] == '2' || node.label == "3.1");
  for (FrameNode& node : frame.nodes)
    if (node.label[0] == '2')
      for (const BodyId id : node.bodies) frame.bodies[id].asleep = true;
  frame.caption = "A branch whose bodies all sleep is left out.";
  return frame;
}

Frame kd(std::size_t bodies) {
  Frame frame = crowd(bodies, 2);
  frame.title = "Boxes that fit";
  frame.nodes.clear();
  frame.structure = StructureKind::kd_tree;
  frame.add<FrameStructure>().settings = "at most 2 in a leaf";
  const std::function<void(std::uint32_t, std::uint32_t, std::vector<BodyId>)> grow =
      [&](std::uint32_t parent, std::uint32_t slot, std::vector<BodyId> held) {
        FrameNode node;
        node.id = static_cast<std::uint32_t>(frame.nodes.size());
        node.parent = parent;
        node.slot = slot;
        node.label = "root";
        node.box = frame.bodies[held[0]].box;
        for (const BodyId id : held) node.box = united(node.box, frame.bodies[id].box);
        if (parent != kNone) {
          node.depth = frame.nodes[parent].depth + 1;
          node.label = parent == 0 ? "" : frame.nodes[parent].label + ".";
          node.label += std::to_string(slot + 1);
        }
        node.leaf = held.size() <= 2;
        const int axis = node.box.size().x >= node.box.size().y ? 0 : 1;
        std::sort(held.begin(), held.end(), [&](BodyId a, BodyId b) {
          return frame.bodies[a].position[axis] < frame.bodies[b].position[axis];
        });
        const auto middle = static_cast<std::ptrdiff_t>(held.size() / 2);
        if (node.leaf) {
          node.bodies = held;
          std::sort(node.bodies.begin(), node.bodies.end());
        } else {
          Vec<3> normal{0.0};
          normal[axis] = 1;
          node.plane = Plane<3>::through(frame.bodies[held[held.size() / 2]].position, normal);
          node.plane_name = fmt::format("{} = {:.0f}", "xy"[axis], node.plane->offset);
        }
        if (node.id == 1) node.mark = Mark::lit;
        frame.nodes.push_back(node);
        if (node.leaf) return;
        grow(node.id, 0, {held.begin(), held.begin() + middle});
        grow(node.id, 1, {held.begin() + middle, held.end()});
      };
  std::vector<BodyId> all;
  for (const FrameBody& b : frame.bodies) all.push_back(b.id);
  grow(kNone, 0, all);
  return frame;
}

Frame swept() {
  Frame frame = crowd(12, 3);
  frame.title = "Sort and sweep";
  frame.nodes.clear();
  frame.structure = StructureKind::sort_and_sweep;
  frame.add<FrameStructure>().settings = "along x";
  return frame;
}

// Numbers that no world should have; the picture must still be one.
Frame wild() {
  Frame frame = shapes();
  frame.title = "Wild numbers";
  const double nan = std::nan(""), inf = HUGE_VAL;
  frame.add<FrameFinding>().rays = {{{nan, 0, 0}, {1, 1, 0}, {{0, {nan, nan, 0}}}},
                                    {{1, 1, 0}, {inf, 2, 0}, {}},
                                    {{-1e300, 3, 0}, {1e300, 3, 0}, {}}};
  frame.add<FrameLinks>().links = {{FrameLink::Kind::spring, {1, 1, 0}, {1, 1, 0}, nan},
                                   {FrameLink::Kind::spring, {-1e9, 1, 0}, {1e9, 2, 0}, 1e9},
                                   {FrameLink::Kind::pin, {inf, 1, 0}, {2, 2, 0}, 0}};
  FrameContact contact;
  contact.normal = {nan, 1, 0};
  contact.points = {{{2, 2, 0}, 0, inf}, {{nan, 2, 0}, nan, nan}, {{3, 3, 0}, -1, 1e300}};
  frame.contacts = {contact, {{0, 1}, {0, 0, 0}, {{{4, 4, 0}, 0, 0}}, true}};
  frame.add<FrameFinding>().views = {{{inf, 0, 0}, {{0, 0, 0}, {1e300, 0, 0}, {0, nan, 0}}},
                                     {{4, 4, 0}, {{-1e5, -1e5, 0}, {1e5, -1e5, 0}, {0, 1e6, 0}}},
                                     {}};
  frame.add<FrameFinding>().queries = {
      {{{-inf, 0, 0}, {inf, 1, 0}}, 0}, {{{0, 0, 0}, {1, 1, 0}}, 1e200}, {}};
  frame.add<FrameLevel>().walls = {{{nan, 0}, {1, 1}, 0, 0, Mark::lit},
                                   {{2, 2}, {2, 2}, 1, 0, Mark::quiet}};
  frame.add<FrameLevel>().eye = Vec<2>(-40, 900);
  frame.bodies[1].velocity = {inf, 0, 0};
  frame.bodies[2].velocity = {1e-300, 0, 0};
  frame.bodies.push_back(ground(10, {8, 5}, {0.6, 0.8}));
  frame.bodies.push_back(ground(11, {800, 500}, {-1, 0}));
  return frame;
}

}  // namespace

Named worlds() {
  Named frames;
  frames.emplace_back("world_shapes", shapes());
  frames.emplace_back("world_slope", slope());
  frames.emplace_back("world_stack5", stack(5));
  frames.emplace_back("world_stack80", stack(80));
  frames.emplace_back("world_linked", linked());
  frames.emplace_back("world_rays", rays());
  frames.emplace_back("world_culled", culled(30));
  frames.emplace_back("world_culled900", culled(900));
  frames.emplace_back("world_level", level());
  frames.emplace_back("world_forest", forest(20, 9));
  frames.emplace_back("world_forest90", forest(90, 30));
  frames.emplace_back("world_sleepers", sleepers());
  frames.emplace_back("world_kd", kd(12));
  frames.emplace_back("world_kd100", kd(100));
  frames.emplace_back("world_swept", swept());
  frames.emplace_back("world_wild", wild());
  return frames;
}

}  // namespace lantern::draw::samples
