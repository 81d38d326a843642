#include "draw/world3d_samples.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "base/random.hpp"
#include "frame/parts/asked.hpp"
#include "frame/parts/motion.hpp"
#include "geometry/flat.hpp"
#include "spatial/structure.hpp"

namespace lantern::draw::samples {
namespace {

Rotation<3> turn(const Vec<3>& axis, double angle) {
  return turned(Rotation<3>{}, glm::normalize(axis) * angle);
}

template <int D, class ToBox>
void add_nodes(const Structure<D>& tree, const ToBox& to_box, Frame& frame) {
  tree.visit([&](const NodeView<D>& view) {
    FrameNode node;
    node.id = view.id;
    node.parent = view.parent;
    node.slot = view.slot;
    node.depth = view.depth;
    node.box = to_box(view.box);
    node.leaf = view.leaf;
    node.bodies.assign(view.bodies.begin(), view.bodies.end());
    const std::string slot = std::to_string(view.slot + 1);
    if (view.parent == kNone)
      node.label = "root";
    else if (frame.nodes[view.parent].parent == kNone)
      node.label = slot;
    else
      node.label = frame.nodes[view.parent].label + "." + slot;
    frame.nodes.push_back(node);
    return true;
  });
}

// Nodes that hold the body are lit, and their ancestors passed.
void light(Frame& frame, BodyId id) {
  for (std::size_t i = frame.nodes.size(); i-- > 0;) {
    FrameNode& node = frame.nodes[i];
    if (std::find(node.bodies.begin(), node.bodies.end(), id) != node.bodies.end())
      node.mark = Mark::lit;
    if (node.mark != Mark::quiet && node.parent != kNone &&
        frame.nodes[node.parent].mark == Mark::quiet)
      frame.nodes[node.parent].mark = Mark::passed;
  }
  for (FrameBody& body : frame.bodies) body.lit = body.id == id;
}

void add_octree(Frame& frame) {
  frame.structure = StructureKind::octree;
  const auto tree = make_structure<3>(
      StructureKind::octree,
      {.bounds = frame.bounds, .capacity = 2, .max_depth = 4, .no_progress_stop = false});
  for (const FrameBody& body : frame.bodies) tree->insert({body.id, body.box});
  add_nodes(
      *tree, [](const Box<3>& box) { return box; }, frame);
  std::set<Pair> pairs;
  for (const FrameNode& node : frame.nodes)
    for (const BodyId a : node.bodies)
      for (const BodyId b : node.bodies)
        if (a < b) pairs.insert({a, b});
  for (const Pair& pair : pairs) frame.pairs.push_back({pair, false});
  frame.add<FrameStructure>().settings = "capacity 2, depth limit 4";
}

Frame solid_frame(const std::string& name, const Box<3>& bounds) {
  Frame frame;
  frame.dimension = 3;
  frame.scenario = name;
  frame.title = name;
  frame.panels = {panel_named("world")};
  frame.bounds = bounds;
  frame.steps = 9;
  frame.step = 3;
  return frame;
}

}  // namespace

FrameBody solid_body(BodyId id, std::string name, const Shape<3>& shape, const Vec<3>& position,
                     int color) {
  FrameBody body;
  body.id = id;
  body.name = std::move(name);
  body.look = std::holds_alternative<Sphere>(shape) ? Look::ball : Look::box;
  body.color = color;
  body.shape = shape;
  body.position = position;
  body.box = bounding_box(shape, position);
  return body;
}

Frame octree_frame() {
  Frame frame = solid_frame("octree", {{0, 0, 0}, {8, 8, 8}});
  frame.title = "A cube is split into eight";
  frame.panels = {panel_named("world"), panel_named("tree")};
  frame.caption = "Node 6 holds 3, its limit is 2: it splits into eight. Blue lies in all of them.";
  frame.bodies = {solid_body(0, "red", Sphere{0.55}, {1.3, 6.8, 6.6}, 1),
                  solid_body(1, "pink", AxisBox<3>{{0.5, 0.5, 0.5}}, {2.9, 5.0, 5.2}, 2),
                  solid_body(2, "blue", Sphere{0.6}, {6.2, 6.2, 6.4}, 4),
                  solid_body(3, "green", AxisBox<3>{{0.5, 0.8, 0.5}}, {6.6, 1.4, 2.2}, 5),
                  solid_body(4, "yellow", Sphere{0.45}, {5.0, 7.0, 5.2}, 3),
                  solid_body(5, "sky", Sphere{0.5}, {7.0, 4.9, 6.9}, 6),
                  solid_body(6, "violet", AxisBox<3>{{0.6, 0.4, 0.6}}, {1.8, 0.9, 6.0}, 8)};
  add_octree(frame);
  light(frame, 2);
  frame.counts = {{"pairs to test", static_cast<std::int64_t>(frame.pairs.size())},
                  {"by brute force", 21}};
  return frame;
}

Frame tower_frame() {
  Frame frame = solid_frame("tower", {{-5, 0, -5}, {5, 9, 5}});
  frame.title = "A tower of boxes comes to rest";
  frame.caption = "Contacts hold the tower: 4 points a face, each pushes with its own impulse.";
  FrameBody ground = solid_body(0, "ground", HalfSpace<3>{{0, 1, 0}}, {0, 0, 0}, 1);
  ground.is_static = true;
  frame.bodies.push_back(ground);
  for (BodyId i = 1; i <= 7; ++i) {
    FrameBody box = solid_body(i, fmt::format("box {}", i), OrientedBox<3>{{0.9, 0.5, 0.9}},
                               {0.05 * i, 0.5 + (i - 1) * 1.0, 0}, static_cast<int>(i));
    box.orientation = turn({0, 1, 0}, 0.11 * i);
    box.box = bounding_box(box.shape, box.position, box.orientation);
    box.asleep = i <= 2;
    frame.bodies.push_back(box);
    FrameContact contact;
    contact.pair = {i - 1, i};
    contact.normal = {0, 1, 0};
    for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      contact.points.push_back(
          {box.position + matrix(box.orientation) * Vec<3>(0.9 * x, -0.5, 0.9 * z), -0.001, 2.0});
    contact.begins = i == 7;
    if (i > 4) frame.contacts.push_back(contact);
  }
  FrameBody wall = solid_body(20, "wall", AxisBox<3>{{0.4, 1.5, 3}}, {-3.6, 1.5, -1}, 1);
  wall.is_static = true;
  frame.bodies.push_back(wall);
  FrameBody ball = solid_body(21, "ball", Sphere{0.7}, {3.1, 3.4, 2.0}, 1);
  ball.velocity = {-6, 1, -3};
  frame.bodies.push_back(ball);
  FrameBody pill = solid_body(22, "pill", Capsule{0.45, 0.9}, {2.6, 0.9, -3}, 5);
  pill.orientation = turn({1, 0, 0.6}, 0.9);
  pill.box = bounding_box(pill.shape, pill.position, pill.orientation);
  frame.bodies.push_back(pill);
  frame.display.arrows = true;
  frame.pairs = {{{0, 1}, false}, {{0, 21}, true}, {{21, 22}, false}};
  return frame;
}

Frame culling_frame() {
  Frame frame = solid_frame("culling", {{0, 0, 0}, {16, 8, 16}});
  frame.title = "What the camera cannot see is not drawn";
  frame.caption = "The view's box tests rule out 4 of 9 bodies.";
  Random random(7);
  for (BodyId i = 0; i < 9; ++i) {
    const Vec<3> at{2 + 6.0 * (i % 3), 1.2 + 1.8 * ((i * 2) % 4), 2 + 6.0 * (i / 3)};
    Shape<3> shape = Sphere{0.8};
    if (i % 3 == 1) shape = AxisBox<3>{{0.7, 0.9, 0.7}};
    if (i % 3 == 2) shape = Capsule{0.5, 0.6};
    frame.bodies.push_back(
        solid_body(i, fmt::format("b{}", i), shape, at, 1 + static_cast<int>(i % 8)));
    frame.bodies.back().dimmed = i == 0 || i == 3 || i == 6 || i == 8;
  }
  add_octree(frame);
  frame.pairs.clear();
  FrameView view;
  view.eye = {7, 3.5, 15.5};
  const Vec<3> ahead = glm::normalize(Vec<3>(0.25, -0.1, -1));
  const Vec<3> right = glm::normalize(glm::cross(ahead, Vec<3>(0, 1, 0)));
  const Vec<3> up = glm::cross(right, ahead);
  for (const double d : {2.0, 13.0})
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      view.corners.push_back(view.eye + ahead * d + right * (0.42 * d * x) + up * (0.24 * d * y));
  frame.add<FrameFinding>().views.push_back(view);
  FrameRay ray;
  ray.from = {0.5, 6.5, 14};
  ray.to = frame.bodies[4].position + Vec<3>(-0.7, 0.2, 0.3);
  ray.hits = {{4, ray.to}};
  frame.add<FrameFinding>().rays.push_back(ray);
  frame.add<FrameLinks>().links = {
      {FrameLink::Kind::spring, frame.bodies[2].position, {14, 8, 2}, 0.2},
      {FrameLink::Kind::distance, frame.bodies[5].position, frame.bodies[8].position, 0.0}};
  return frame;
}

Frame columns_frame() {
  Frame frame = solid_frame("columns", {{0, 0, 0}, {12, 4, 12}});
  frame.title = "A quadtree over the floor of a solid world";
  frame.panels = {panel_named("world"), panel_named("tree")};
  frame.caption = "Height is not split: each node is a column.";
  const auto ghost = [&](BodyId id, const char* name, const Vec<3>& at, int color) {
    FrameBody body = solid_body(id, name, Sphere{0.6}, at, color);
    body.look = id == 3 ? Look::player : Look::ghost;
    body.velocity = {1, 0, 0.5};
    return body;
  };
  frame.bodies = {ghost(0, "blinky", {2, 0.8, 2}, 1), ghost(1, "pinky", {4.6, 2.6, 4}, 2),
                  ghost(2, "inky", {5, 0.8, 1.2}, 6), ghost(3, "player", {9, 0.6, 9}, 3),
                  ghost(4, "clyde", {1.6, 1.6, 9.4}, 7)};
  frame.structure = StructureKind::quadtree;
  const auto tree = make_structure<2>(
      StructureKind::quadtree,
      {.bounds = {{0, 0}, {12, 12}}, .capacity = 2, .max_depth = 4, .no_progress_stop = false});
  const auto on_floor = [](const Vec<3>& v) { return Vec<2>(v.x, v.z); };
  for (const FrameBody& body : frame.bodies)
    tree->insert({body.id, {on_floor(body.box.lo), on_floor(body.box.hi)}});
  add_nodes(
      *tree,
      [](const Box<2>& box) {
        return Box<3>{{box.lo.x, 0, box.lo.y}, {box.hi.x, 4, box.hi.y}};
      },
      frame);
  light(frame, 1);
  return frame;
}

Frame crowd_frame() {
  Frame frame = solid_frame("crowd", {{0, 0, 0}, {40, 20, 40}});
  frame.title = "A thousand balls";
  Random random(3);
  for (BodyId i = 0; i < 1000; ++i)
    frame.bodies.push_back(
        solid_body(i, "", Sphere{0.25},
                   {40 * random.unit(), 20 * random.unit() * random.unit(), 40 * random.unit()},
                   1 + static_cast<int>(i % 8)));
  add_octree(frame);
  frame.pairs.clear();
  return frame;
}

Frame inside_frame() {
  Frame frame = culling_frame();
  frame.title = "From within the world";
  frame.camera = Camera{{7, 3.5, 15.5}, {9.5, 2.5, 5.5}, 0.8};
  frame.add<FrameFinding>().views.clear();
  return frame;
}

Frame pit_frame() {
  Frame frame = solid_frame("pit", {{0, 0, 0}, {24, 10, 16}});
  frame.title = "Forty bodies in a pit";
  frame.camera = Camera{{20, 16, 42}, {12, 3, 8}, 0.5};
  Random random(11);
  for (BodyId i = 0; i < 40; ++i) {
    const Vec<3> at{1 + 22 * random.unit(), 0.7 + 8 * random.unit() * random.unit(),
                    1 + 14 * random.unit()};
    Shape<3> shape = Sphere{0.3 + 0.5 * random.unit()};
    if (i % 3 == 1) shape = OrientedBox<3>{{0.4 + 0.4 * random.unit(), 0.6, 0.5}};
    if (i % 3 == 2) shape = Capsule{0.35, 0.5};
    FrameBody body = solid_body(i, fmt::format("{}", i + 1), shape, at, 1 + int(i % 8));
    body.orientation = turn({random.unit(), 1, random.unit()}, 3 * random.unit());
    body.box = bounding_box(shape, at, body.orientation);
    body.asleep = i % 7 == 0;
    frame.bodies.push_back(body);
  }
  add_octree(frame);
  light(frame, 5);
  return frame;
}

std::vector<std::pair<std::string, Frame>> all_solid() {
  return {{"octree", octree_frame()},   {"tower", tower_frame()}, {"culling", culling_frame()},
          {"columns", columns_frame()}, {"crowd", crowd_frame()}, {"inside", inside_frame()},
          {"pit", pit_frame()}};
}

}  // namespace lantern::draw::samples
