#include "draw/sample_frames.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/random.hpp"
#include "draw/page.hpp"
#include "draw/world3d_samples.hpp"
#include "geometry/flat.hpp"

namespace lantern::draw::samples {
namespace {

Vec<2> corner_of(std::uint32_t slot) { return {slot % 2 == 0 ? 0.0 : 0.5, slot < 2 ? 0.5 : 0.0}; }

// The lecture's quadtree, children in its order, all made at a split.
struct Builder {
  Frame& frame;
  std::size_t capacity;
  std::uint32_t max_depth;

  void add(std::uint32_t parent, std::uint32_t slot, const Box<2>& box,
           const std::vector<BodyId>& candidates) {
    FrameNode node;
    node.id = static_cast<std::uint32_t>(frame.nodes.size());
    node.parent = parent;
    node.slot = slot;
    node.box = solid(box);
    node.label = "root";
    if (parent != kNone) {
      const FrameNode& p = frame.nodes[parent];
      node.depth = p.depth + 1;
      const std::string number = std::to_string(slot + 1);
      node.label = p.label == "root" ? number : p.label + "." + number;
    }
    std::vector<BodyId> inside;
    for (const BodyId id : candidates)
      if (overlap(flat(frame.bodies[id].box), box)) inside.push_back(id);
    node.leaf = inside.size() <= capacity || node.depth == max_depth;
    node.over_capacity = node.leaf && inside.size() > capacity;
    if (node.leaf) node.bodies = inside;
    frame.nodes.push_back(node);
    if (node.leaf) return;
    for (std::uint32_t child = 0; child < 4; ++child) {
      const Vec<2> half = box.size() * 0.5;
      const Vec<2> lo = box.lo + box.size() * corner_of(child);
      add(node.id, child, {lo, lo + half}, inside);
    }
  }
};

void count(Frame& frame) {
  std::int64_t leaves = 0, entries = 0;
  std::vector<Pair> pairs;
  for (const FrameNode& node : frame.nodes) {
    leaves += node.leaf;
    entries += static_cast<std::int64_t>(node.bodies.size());
    for (std::size_t i = 0; i < node.bodies.size(); ++i)
      for (std::size_t j = i + 1; j < node.bodies.size(); ++j)
        pairs.push_back({node.bodies[i], node.bodies[j]});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const Pair& pair : pairs) frame.pairs.push_back({pair, frame.pairs.empty()});
  const auto n = static_cast<std::int64_t>(frame.bodies.size());
  frame.counts = {{"bodies", n},
                  {"nodes", static_cast<std::int64_t>(frame.nodes.size())},
                  {"leaves", leaves},
                  {"entries", entries},
                  {"pairs", static_cast<std::int64_t>(pairs.size())},
                  {"all_pairs", n * (n - 1) / 2},
                  {"testable_pairs", n * (n - 1) / 2}};
}

void grow(Frame& frame, std::size_t capacity, std::uint32_t max_depth) {
  frame.structure = StructureKind::quadtree;
  frame.add<FrameStructure>().settings =
      fmt::format("capacity {}, depth limit {}, all children made", capacity, max_depth);
  std::vector<BodyId> all_ids;
  for (const FrameBody& b : frame.bodies) all_ids.push_back(b.id);
  Builder{frame, capacity, max_depth}.add(kNone, 0, flat(frame.bounds), all_ids);
  count(frame);
}

void mark(Frame& frame, const std::function<Mark(const FrameNode&)>& of) {
  for (FrameNode& node : frame.nodes) node.mark = of(node);
}

FrameNode bsp_node(Frame& frame, std::uint32_t parent, std::uint32_t slot) {
  FrameNode node;
  node.id = static_cast<std::uint32_t>(frame.nodes.size());
  node.parent = parent;
  node.slot = slot;
  node.label = "root";
  node.region = polygon_of(flat(frame.bounds));
  if (parent != kNone) {
    const FrameNode& p = frame.nodes[parent];
    const std::string side = slot == 0 ? "back" : "front";
    node.depth = p.depth + 1;
    node.label = p.label == "root" ? side : p.label + "." + side;
    node.region = clipped(p.region, flat(*p.plane), slot == 1);
  }
  Box<2> box{node.region[0], node.region[0]};
  for (const Vec<2>& p : node.region) box = united(box, Box<2>{p, p});
  node.box = solid(box);
  return node;
}

std::uint32_t divide(Frame& frame, std::uint32_t parent, std::uint32_t slot, std::string name,
                     Plane<2> plane) {
  FrameNode node = bsp_node(frame, parent, slot);
  node.leaf = false;
  node.plane = solid(plane);
  node.plane_name = std::move(name);
  frame.nodes.push_back(node);
  return node.id;
}

void leaf(Frame& frame, std::uint32_t parent, std::uint32_t slot, std::vector<BodyId> bodies,
          Mark m) {
  FrameNode node = bsp_node(frame, parent, slot);
  node.bodies = std::move(bodies);
  node.mark = m;
  frame.nodes.push_back(node);
}

// The lecture's packer: a texture goes to the first free leaf it fits, which is cut to fit.
struct Packer {
  Frame& frame;

  bool insert(std::uint32_t at, FrameTexture& t) {
    if (!frame.nodes[at].leaf) {
      for (std::uint32_t i = 0; i < frame.nodes.size(); ++i)
        if (frame.nodes[i].parent == at && insert(i, t)) return true;
      return false;
    }
    const Vec<2> size = flat(frame.nodes[at].box).size();
    if (!frame.nodes[at].bodies.empty() || t.width > size.x || t.height > size.y) return false;
    if (size.x == t.width && size.y == t.height) {
      frame.nodes[at].bodies = {t.id};
      frame.nodes[at].label = t.name;
      frame.nodes[at].mark = Mark::lit;
      t.packed = true;
      t.x = static_cast<int>(frame.nodes[at].box.lo.x);
      t.y = static_cast<int>(frame.nodes[at].box.lo.y);
      return true;
    }
    const bool upright = size.x - t.width > size.y - t.height;
    const int axis = upright ? 0 : 1;
    const double cut = frame.nodes[at].box.lo[axis] + (upright ? t.width : t.height);
    frame.nodes[at].leaf = false;
    frame.nodes[at].cut_vertically = upright;
    frame.nodes[at].mark = Mark::lit;
    const auto first = static_cast<std::uint32_t>(frame.nodes.size());
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      FrameNode child;
      child.id = first + slot;
      child.parent = at;
      child.slot = slot;
      child.depth = frame.nodes[at].depth + 1;
      child.box = frame.nodes[at].box;
      (slot == 0 ? child.box.hi : child.box.lo)[axis] = cut;
      frame.nodes.push_back(child);
    }
    return insert(first, t);
  }
};

}  // namespace

FrameBody body(BodyId id, std::string name, Look look, int color, const Vec<2>& at,
               const Shape<2>& shape, double angle) {
  FrameBody b;
  b.id = id;
  b.name = std::move(name);
  b.look = look;
  b.color = color;
  b.shape = in_dimension<3>(shape);
  b.position = solid(at);
  b.angle = angle;
  b.box = solid(bounding_box(shape, at, Rotation<2>{angle}));
  return b;
}

Frame base(std::string title, const Box<2>& bounds, std::vector<Panel> panels) {
  Frame frame;
  frame.scenario = "sample";
  frame.title = std::move(title);
  frame.step = 3;
  frame.steps = 9;
  frame.bounds = solid(bounds);
  frame.panels = std::move(panels);
  return frame;
}

DrawList page_of(const Frame& frame, const AxisRanges& axes) {
  Work work;
  return draw_frame(frame, Staging(std::span(&frame, 1), axes), page_for(1600, 900), work);
}

Frame ghosts(std::size_t objects) {
  Frame frame =
      base("Ghosts in a quadtree", {{0, 0}, {8, 8}}, {panel_named("world"), panel_named("tree")});
  frame.part = "children on demand";
  frame.bodies = {
      body(0, "red", Look::ghost, 1, {3.05, 6.85}), body(1, "pink", Look::ghost, 2, {2.0, 4.85}),
      body(2, "player", Look::player, 3, {6.2, 2.0}), body(3, "blue", Look::ghost, 4, {0.95, 6.9})};
  frame.bodies.resize(objects);
  frame.bodies.back().lit = true;
  grow(frame, 2, 4);
  const char* captions[] = {
      "The root holds red and pink: 2 of 2.",
      "The player overflows the root: it holds 3, its limit is 2, so it splits in 4 and all three "
      "are tested again.",
      "The blue ghost overflows child 1: it holds 3, its limit is 2, so it splits. The pink ghost "
      "lies across 1.3 and 1.4 and is stored in both."};
  frame.caption = captions[objects - 2];
  mark(frame, [&](const FrameNode& n) {
    if (objects == 4)
      return n.label[0] == '1' ? Mark::lit : n.depth == 0 ? Mark::passed : Mark::quiet;
    return n.leaf && n.bodies.empty() ? Mark::quiet : Mark::lit;
  });
  return frame;
}

Frame pong(double ball_x) {
  Frame frame =
      base("Pong and its BSP", {{0, 0}, {32, 18}}, {panel_named("world"), panel_named("tree")});
  frame.structure = StructureKind::bsp;
  frame.add<FrameStructure>().settings = "1 dividing line";
  const AxisBox<2> bat{{0.5, 2.2}};
  frame.bodies = {body(0, "blue bat", Look::bat, 4, {1.5, 8}, bat),
                  body(1, "red bat", Look::bat, 1, {30.5, 11}, bat),
                  body(2, "ball", Look::ball, 3, {ball_x, 9.5}, Sphere{0.9})};
  frame.bodies[2].velocity = {3, 1, 0};
  frame.bodies[2].lit = true;
  const Plane<2> net = Plane<2>::through({16, 9}, {1, 0});
  divide(frame, kNone, 0, "net", net);
  const Reach r = reach(flat(frame.bodies[2].box), net);
  leaf(frame, 0, 0, r.back ? std::vector<BodyId>{0, 2} : std::vector<BodyId>{0},
       r.back ? Mark::lit : Mark::quiet);
  leaf(frame, 0, 1, r.front ? std::vector<BodyId>{1, 2} : std::vector<BodyId>{1},
       r.front ? Mark::lit : Mark::quiet);
  count(frame);
  frame.time = 1.25;
  frame.caption = "The ball lies in front of the net: only the red bat can be near it.";
  return frame;
}

Frame doom() {
  Frame frame = base("A level cut into convex sectors", {{0, 0}, {20, 14}},
                     {panel_named("world"), panel_named("tree")});
  frame.structure = StructureKind::bsp;
  frame.add<FrameStructure>().settings = "3 dividing lines";
  frame.bodies = {body(0, "imp", Look::ghost, 7, {4, 10}),
                  body(1, "medic", Look::box, 5, {9, 3}, AxisBox<2>{{0.6, 0.6}}),
                  body(2, "marine", Look::player, 8, {16, 6})};
  const std::uint32_t root =
      divide(frame, kNone, 0, "long wall", Plane<2>::through({12, 0}, {1, -0.2}));
  const std::uint32_t back =
      divide(frame, root, 0, "corridor", Plane<2>::through({0, 7}, {0.3, 1}));
  leaf(frame, back, 0, {1}, Mark::quiet);
  leaf(frame, back, 1, {0}, Mark::passed);
  const std::uint32_t front = divide(frame, root, 1, "gate", Plane<2>::through({16, 9}, {-0.5, 1}));
  leaf(frame, front, 0, {2}, Mark::lit);
  leaf(frame, front, 1, {}, Mark::quiet);
  frame.nodes[root].mark = Mark::passed;
  frame.nodes[front].mark = Mark::passed;
  count(frame);
  frame.caption = "The marine stands behind the gate.";
  return frame;
}

Frame coincident(std::uint32_t depth) {
  Frame frame = base("Three bodies at one place", {{0, 0}, {16, 16}},
                     {panel_named("world"), panel_named("tree")});
  const Vec<2> place{6.3, 9.4};
  frame.bodies = {body(0, "pink", Look::ghost, 2, place, Sphere{1.1}),
                  body(1, "red", Look::ghost, 1, place, Sphere{1.1}),
                  body(2, "player", Look::player, 3, place, Sphere{1.1})};
  frame.bodies[2].lit = true;
  grow(frame, 2, depth);
  mark(frame,
       [](const FrameNode& n) { return n.leaf && n.bodies.empty() ? Mark::quiet : Mark::lit; });
  frame.caption = fmt::format(
      "Every child that still holds all three splits again, down to depth {}: {} nodes, and "
      "nothing "
      "is gained.",
      depth, frame.nodes.size());
  return frame;
}

Frame crowd(std::size_t bodies, double size) {
  Frame frame =
      base("Many bodies", {{0, 0}, {100, 70}}, {panel_named("world"), panel_named("tree")});
  Random random(7);
  for (std::size_t i = 0; i < bodies; ++i) {
    const auto look = static_cast<Look>(i % 6);
    frame.bodies.push_back(body(static_cast<BodyId>(i), fmt::format("body {}", i), look,
                                static_cast<int>(i % 8) + 1,
                                {random.between(2, 98), random.between(2, 68)}, Sphere{size}));
    frame.bodies.back().velocity.x = random.between(-1, 1);
    frame.bodies.back().velocity.y = random.between(-1, 1);
  }
  frame.bodies[0].lit = true;
  grow(frame, 4, 6);
  mark(frame, [](const FrameNode& n) {
    return n.leaf && std::count(n.bodies.begin(), n.bodies.end(), 0u) > 0 ? Mark::lit : Mark::quiet;
  });
  for (std::size_t i = frame.nodes.size(); i-- > 1;)
    if (frame.nodes[i].mark != Mark::quiet) frame.nodes[frame.nodes[i].parent].mark = Mark::passed;
  frame.caption = fmt::format("{} bodies; the tree leaves {{pairs}} of them to test.", bodies);
  return frame;
}

Frame outside() {
  Frame frame =
      base("Nothing is dropped", {{0, 0}, {10, 10}}, {panel_named("world"), panel_named("tree")});
  frame.bodies = {
      body(0, "inside", Look::ghost, 5, {4, 4}),       body(1, "left", Look::ghost, 1, {-3, 5}),
      body(2, "far", Look::player, 3, {900, 700}),     body(3, "below", Look::ball, 6, {7, -5}),
      body(4, "also below", Look::box, 7, {7.01, -6}), body(5, "edge", Look::disc, 8, {10, 6})};
  grow(frame, 2, 5);
  frame.caption = "Bodies outside the world's bounds are kept.";
  return frame;
}

Frame overhanging() {
  Frame frame = outside();
  frame.title = "Larger than the world";
  frame.bodies.push_back(body(6, "whale", Look::ghost, 2, {2, 2}, Sphere{40}));
  frame.bodies.push_back(body(7, "point", Look::disc, 2, {8, 8}, Sphere{0}));
  return frame;
}

Frame long_texts() {
  Frame frame = ghosts(4);
  std::string text;
  for (int i = 0; i < 60; ++i) text += "Rhabarberbarbara meets a ghost. ";
  frame.title = text;
  frame.part = text;
  frame.caption = text;
  frame.add<FrameStructure>().settings =
      "capacity 2, " + std::string(200, 'x') + ", depth limit 1000000";
  for (FrameBody& b : frame.bodies) b.name = "the ghost of " + b.name + " " + std::string(60, 'o');
  for (FrameNode& n : frame.nodes) n.label += std::string(40, 'y');
  return frame;
}

Frame atlas(std::size_t textures, std::size_t packed) {
  Frame frame = base("A texture atlas on a kD-tree", {{0, 0}, {1, 1}},
                     {panel_named("world"), panel_named("tree")});
  frame.panels = {panel_named("atlas"), panel_named("tree")};
  FrameNode root;
  root.label = "root";
  root.box = {{0, 0, 0}, {512, 512, 0}};
  frame.nodes.push_back(root);
  Random random(11);
  std::int64_t used = 0, stored = 0;
  for (std::size_t i = 0; i < textures; ++i) {
    FrameTexture t;
    t.id = static_cast<std::uint32_t>(i);
    t.name = i < 26 ? std::string(1, static_cast<char>('A' + i)) : fmt::format("T{}", i);
    if (i % 5 == 4) t.name = fmt::format("stone {}", i);
    t.color = static_cast<int>(i % 8) + 1;
    t.width = static_cast<int>(random.whole(3, 16)) * 8;
    t.height = static_cast<int>(random.whole(3, 16)) * 8;
    frame.add<FrameTextures>().textures.push_back(t);
  }
  for (std::size_t i = 0; i < packed; ++i) {
    for (FrameNode& node : frame.nodes) node.mark = Mark::quiet;
    FrameTexture& t = frame.add<FrameTextures>().textures[i];
    t.refused = !Packer{frame}.insert(0, t);
    stored += t.packed;
    used += t.packed ? t.width * t.height : 0;
  }
  const auto leaves = std::count_if(frame.nodes.begin(), frame.nodes.end(),
                                    [](const FrameNode& n) { return n.leaf; });
  frame.counts = {{"nodes", static_cast<std::int64_t>(frame.nodes.size())},
                  {"leaves", leaves},
                  {"textures", stored},
                  {"used_area", used},
                  {"atlas_area", 512 * 512}};
  frame.caption =
      fmt::format("Texture {} goes to the first free leaf that it fits; the leaf is cut to fit.",
                  packed > 0 ? frame.get<FrameTextures>().textures[packed - 1].name : "A");
  return frame;
}

Frame fine_atlas(std::size_t textures) {
  Frame frame = atlas(0, 0);
  frame.nodes[0].leaf = false;
  for (std::size_t i = 0; i < textures; ++i) {
    FrameTexture t;
    t.id = static_cast<std::uint32_t>(i);
    t.name = fmt::format("T{}", i);
    t.color = static_cast<int>(i % 8) + 1;
    t.width = t.height = 7;
    t.packed = true;
    t.x = static_cast<int>(i % 70) * 7;
    t.y = static_cast<int>(i / 70) * 7;
    frame.add<FrameTextures>().textures.push_back(t);
  }
  return frame;
}

Frame empty() {
  Frame frame;
  frame.panels = {panel_named("world"), panel_named("tree"), panel_named("atlas")};
  return frame;
}

Frame unstructured() {
  Frame frame = ghosts(4);
  frame.nodes.clear();
  frame.pairs.clear();
  frame.panels = {panel_named("world")};
  frame.structure = StructureKind::none;
  frame.counts = {{"bodies", 4}, {"all_pairs", 6}, {"testable_pairs", 6}};
  return frame;
}

static Named make_all() {
  Named frames;
  for (const std::size_t n : {2, 3, 4}) frames.emplace_back(fmt::format("ghosts{}", n), ghosts(n));
  for (const double x : {6.0, 16.4, 25.0}) frames.emplace_back(fmt::format("pong{}", x), pong(x));
  frames.emplace_back("doom", doom());
  for (const std::uint32_t d : {1, 4, 6, 8})
    frames.emplace_back(fmt::format("coincident{}", d), coincident(d));
  frames.emplace_back("crowd12", crowd(12, 3));
  frames.emplace_back("crowd60", crowd(60, 1.4));
  frames.emplace_back("crowd500", crowd(500, 0.8));
  frames.emplace_back("crowd20000", crowd(20000, 0.2));
  frames.emplace_back("outside", outside());
  frames.emplace_back("overhanging", overhanging());
  frames.emplace_back("long_texts", long_texts());
  frames.emplace_back("atlas0", atlas(30, 0));
  frames.emplace_back("atlas2", atlas(30, 2));
  frames.emplace_back("atlas30", atlas(30, 30));
  frames.emplace_back("atlas60", atlas(60, 60));
  frames.emplace_back("atlas300", atlas(300, 40));
  frames.emplace_back("atlas4000", fine_atlas(4000));
  frames.emplace_back("empty", empty());
  frames.emplace_back("unstructured", unstructured());
  for (const Named& more :
       {charts(), memories(), ledgers(), islands(), screens(), strips(), worlds(), sides()})
    frames.insert(frames.end(), more.begin(), more.end());
  for (auto& [name, frame] : all_solid()) frames.emplace_back("solid_" + name, frame);
  return frames;
}

const Named& all() {
  static const Named frames = make_all();
  return frames;
}

}  // namespace lantern::draw::samples
