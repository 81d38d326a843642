#include <algorithm>

#include <fmt/format.h>

#include "draw/sample_frames.hpp"
#include "frame/parts/atlas.hpp"
#include "frame/parts/motion.hpp"
#include "frame/parts/panels.hpp"
#include "language/code_text.hpp"

namespace lantern::draw::samples {
namespace {

// All pairs, in turn ruled out, candidates, apart and touching; the last two bodies are static.
Frame ledger(std::uint32_t bodies, bool contacts) {
  Frame frame =
      base("The pair ledger", {{0, 0}, {32, 18}}, {panel_named("world"), panel_named("ledger")});
  for (BodyId id = 0; id < bodies; ++id) {
    const std::string name = id % 3 == 0 ? fmt::format("body {}", id) : fmt::format("b{}", id);
    frame.bodies.push_back(body(id, name, id % 2 == 0 ? Look::ball : Look::ghost,
                                static_cast<int>(id % 8) + 1,
                                {1.0 + 2 * (id % 15), 2.0 + 2 * (id / 15 % 8)}));
    frame.bodies.back().is_static = bodies > 3 && id + 2 >= bodies;
  }
  std::uint32_t turn = 0;
  for (BodyId a = 0; a < bodies; ++a)
    for (BodyId b = a + 1; b < std::min(bodies, a + 12); ++b) {
      if (frame.bodies[a].is_static && frame.bodies[b].is_static) continue;
      const std::uint32_t kind = turn++ * 7 % 5;
      if (kind == 0) continue;
      frame.pairs.push_back({{a, b}, turn % 6 == 0, kind > 1});
      if (contacts && kind > 2) frame.tested.push_back({a, b});
      if (!contacts || kind != 4) continue;
      FrameContact& contact = frame.contacts.emplace_back();
      contact.pair = {a, b};
    }
  if (contacts) frame.add_count("contacts", frame.contacts.size());
  frame.caption = "Every pair has a cell.";
  return frame;
}

// Every node of the tree in a pool of `slots`, the first `reused` of them for the second time.
void put_in_pool(Frame& frame, std::uint32_t slots, std::uint32_t reused) {
  frame.add<FrameStructure>().pool_size = slots;
  for (FrameNode& node : frame.nodes) {
    node.pool_slot = node.id;
    node.reused = node.id < reused;
  }
  frame.add_count("allocations", 14);
}

// Pairs that touch in every ninth step, once, and in every second.
Frame collisions(std::uint64_t steps) {
  Frame frame = ghosts(4);
  frame::FrameCollisions& told = frame.add<FrameCollisions>();
  told.remembered = 5;
  told.now = steps;
  if (steps == 30) told.steps = 60;
  for (const std::uint64_t every : {9u, 100000u, 2u}) {
    if (steps == 30 && every == 2) break;
    auto& row = told.rows.emplace_back();
    row.pair = {0, static_cast<BodyId>(told.rows.size())};
    for (std::uint64_t step = 1; step <= steps; ++step) {
      const int left = 4 - static_cast<int>(std::min<std::uint64_t>((step - 1) % every, 6));
      if (left >= -1) row.moments.push_back({step, left, left == 4, left == 4 && every > 5});
    }
  }
  frame.panels = {panel_named("world"), panel_named("collisions")};
  return frame;
}

// A function with the line of this number lit, or all of them.
std::pair<std::string, Frame> code(const std::string& function, std::size_t lit) {
  Frame frame = ghosts(4);
  run::FrameCode& code = frame.add<FrameCode>() = *run::code_of(function);
  for (std::size_t i = 0; i < code.lines.size(); ++i)
    code.lines[i].lit = i == lit || lit > code.lines.size();
  frame.panels = {panel_named("world"), panel_named("tree"), panel_named("code")};
  return {fmt::format("code_{}{}", function, lit), frame};
}

void count_bytes(Frame& frame) {
  const auto n = static_cast<std::uint64_t>(frame.nodes.size());
  frame.add_count("node_bytes", 17 * n);
  frame.add_count("node_bytes_with_bounds", 49 * n);
}

}  // namespace

Named islands() {
  Named frames;
  Frame two =
      base("Two islands", {{0, 0}, {16, 9}}, {panel_named("world"), panel_named("islands")});
  const auto add = [](Frame& frame, BodyId id, const Vec<2>& at) {
    frame.bodies.push_back(
        body(id, fmt::format("b{}", id), Look::box, static_cast<int>(id % 8) + 1, at));
  };
  two.bodies.push_back(body(0, "floor", Look::box, 7, {8, 0.5}, AxisBox<2>{{8, 0.5}}));
  two.bodies.back().is_static = true;
  for (BodyId id = 1; id < 6; ++id) add(two, id, {3.0 * id, 1.5 + id % 2});
  two.add<FrameIslands>().islands = {{1, {1, 2}, true}, {2, {3, 4}, false}};
  two.add<FrameIslands>().edges = {
      {{0, 1}, false, false}, {{1, 2}, false, false}, {{3, 4}, true, true}};
  FrameContact& contact = two.contacts.emplace_back();
  contact.pair = {0, 1};
  contact.points = {{{3, 1, 0}, 0, 0}, {{3.4, 1, 0}, 0, 0}};
  frames.emplace_back("islands2", two);
  two.panels = {panel_named("islands")};
  frames.emplace_back("islands_alone", two);
  two.dimension = 3;
  two.bounds.hi.z = 9;
  frames.emplace_back("islands_solid", two);
  Frame none = base("No island", {{0, 0}, {16, 9}}, {panel_named("islands")});
  frames.emplace_back("islands0", none);
  Frame many =
      base("Islands of one", {{0, 0}, {64, 36}}, {panel_named("world"), panel_named("islands")});
  for (BodyId id = 0; id < 600; ++id) {
    add(many, id, {1.0 + 2 * (id % 31), 1.0 + 1.7 * (id / 31)});
    many.add<FrameIslands>().islands.push_back({id + 1, {id}, id % 3 == 0});
  }
  frames.emplace_back("islands600", many);
  return frames;
}

Named screens() {
  Named frames;
  Frame frame = atlas(8, 0);
  frame.panels = {panel_named("screen"), panel_named("atlas")};
  for (FrameTexture& t : frame.add<FrameTextures>().textures)
    t.picture = static_cast<run::Picture>(t.id % 6);
  FrameScreen& screen = frame.add<FrameScreen>();
  screen.width = 480;
  screen.height = 270;
  screen.planned = 2;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const FrameTexture& t = frame.get<FrameTextures>().textures[i * 5 % 8];
    screen.elements.push_back({t.id, static_cast<int>(30 * i), 20, t.width, t.height});
  }
  frames.emplace_back("screen_before", frame);
  FrameWay way;
  for (std::uint32_t i = 0; i < 5; ++i) way.draws.push_back({i, i != 2, i < 4});
  way.bindings = 4;
  screen.ways = {way};
  for (std::uint32_t i = 4; i < 12; ++i) screen.elements[i].drawn = false;
  screen.elements[4].lit = true;
  screen.bound = screen.elements[4].texture;
  frames.emplace_back("screen_midst", frame);
  frame.panels = {panel_named("screen")};
  frames.emplace_back("screen_alone", frame);
  Frame packed = atlas(8, 8);
  packed.panels = {panel_named("screen"), panel_named("atlas"), panel_named("tree")};
  packed.add<FrameScreen>() = screen;
  packed.add<FrameScreen>().ways.push_back({true, true, {{0, true, false}}, 1});
  packed.add<FrameScreen>().atlas_bound = true;
  frames.emplace_back("screen_packed", packed);
  for (FrameElement& element : packed.add<FrameScreen>().elements) element.x = element.y = 0;
  packed.add<FrameScreen>().width = packed.add<FrameScreen>().height = 128;
  packed.add<FrameScreen>().planned = 4;
  frames.emplace_back("screen_tiny", packed);
  return frames;
}

Named strips() {
  Named frames;
  Frame all = ghosts(4);
  put_in_pool(all, 14, 6);
  count_bytes(all);
  all.add<FrameTrace>() = {"pairs", {{0, 3}, {0.5, 9}, {1, 6}}, 4.0};
  all.panels = {panel_named("world"), panel_named("tree"), panel_named("pool")};
  frames.emplace_back("strips_pool", all);
  all.panels = {panel_named("world"), panel_named("tree"), panel_named("bytes"),
                panel_named("sparkline")};
  frames.emplace_back("strips_others", all);
  all.panels = {panel_named("pool")};
  frames.emplace_back("strips_alone", all);
  all.panels = {panel_named("pool"), panel_named("bytes"), panel_named("sparkline")};
  frames.emplace_back("strips_only", all);
  all.add<FrameTrace>() = {"pair_tests", {}, std::nullopt};
  for (int i = 0; i < 5000; ++i)
    all.add<FrameTrace>().points.push_back({0.1 * i, 1.0 * (i * 7919 % 10000)});
  frames.emplace_back("strips_long", all);
  Frame pieces = ghosts(4);
  pieces.structure = StructureKind::lecture_quadtree;
  pieces.add_count("allocations", 1234);
  for (const auto& panels :
       {std::vector{panel_named("world"), panel_named("tree"), panel_named("memory")},
        std::vector{panel_named("pool")}, std::vector{panel_named("world"), panel_named("pool")}}) {
    pieces.panels = panels;
    frames.emplace_back(fmt::format("pieces{}", frames.size()), pieces);
  }
  Frame crowded = crowd(300, 0.6);
  crowded.structure = StructureKind::lecture_quadtree;
  crowded.panels = {panel_named("world"), panel_named("memory"), panel_named("pool")};
  frames.emplace_back("pieces_many", crowded);
  for (const std::uint64_t steps : {0u, 1u, 30u, 5000u})
    frames.emplace_back(fmt::format("collisions{}", steps), collisions(steps));
  for (const std::string function : {"QuadTreeNode::Insert", "QuadTreeNode::OperateOnContents",
                                     "PhysicsSystem::ImpulseResolveCollision"})
    for (const std::size_t lit : {0u, 5u, 1000u}) frames.push_back(code(function, lit));
  Frame many = crowd(900, 0.6);
  put_in_pool(many, 4000, 4000);
  many.panels = {panel_named("world"), panel_named("pool")};
  frames.emplace_back("strips_many", many);
  for (const std::size_t n : {1u, 7u, 200u}) {
    Frame sweep = crowd(n, 1.4);
    sweep.structure = StructureKind::sort_and_sweep;
    sweep.nodes.clear();
    for (std::size_t i = 0; i < sweep.bodies.size(); ++i) sweep.bodies[i].lit = i == n / 2;
    frames.emplace_back(fmt::format("sweep{}", n), sweep);
  }
  return frames;
}

Named ledgers() {
  Named frames;
  for (const std::uint32_t n : {0u, 1u, 2u, 5u, 12u, 40u, 41u, 300u})
    frames.emplace_back(fmt::format("ledger{}", n), ledger(n, true));
  frames.emplace_back("ledger_plain", ledger(6, false));
  Frame broad = ledger(6, true);
  broad.phase = StepPhase::broad;
  broad.contacts.clear();
  broad.tested.clear();
  frames.emplace_back("ledger_broad", broad);
  Frame few = ledger(5, true);  // of nine that will come
  few.cast = 9;
  for (FrameBody& body : few.bodies) body.place = 2 * body.id;
  frames.emplace_back("ledger_few", few);
  few.panels = {panel_named("ledger")};
  frames.emplace_back("ledger_alone", few);
  Frame long_names = ledger(6, true);
  for (FrameBody& body : long_names.bodies) body.name += " of a very long name indeed";
  frames.emplace_back("ledger_names", long_names);
  Frame beside = ghosts(4);
  beside.panels = {panel_named("world"), panel_named("tree"), panel_named("ledger")};
  beside.pairs = {{{0, 1}, true, true}, {{0, 3}, false, false}, {{1, 3}, false, true}};
  beside.add_count("contacts", 0);
  frames.emplace_back("ledger_under", beside);
  return frames;
}

}  // namespace lantern::draw::samples
