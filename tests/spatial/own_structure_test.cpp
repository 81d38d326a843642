// Structures that a program is given: a right one is as good as ours, and whatever a wrong one
// says, it is told and nothing of ours breaks.
#include "spatial/own_structure.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "spatial/broad_phase.hpp"
#include "spatial/query.hpp"
#include "spatial/structure_trial.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using testing::Sort;

// Our own quadtree through the door of a user's, its children told backwards.
class Borrowed {
 public:
  Borrowed(const Box<2>& bounds, std::uint32_t capacity, std::uint32_t max_depth)
      : tree_(testing::TreeConfig<2>{bounds, capacity, max_depth, true}) {}
  void insert(BodyId id, const Box<2>& box) { tree_.insert({id, box}); }
  void clear() { tree_.clear(); }
  void visit(const NodeSink& f) const {
    std::vector<NodeView<2>> nodes;
    std::vector<std::vector<BodyId>> bodies;
    tree_.visit([&](const NodeView<2>& node) {
      nodes.push_back(node);
      bodies.emplace_back(node.bodies.begin(), node.bodies.end());
      return true;
    });
    const std::function<void(std::uint32_t)> tell = [&](std::uint32_t i) {
      f({nodes[i].box, nodes[i].depth, nodes[i].leaf, bodies[i]});
      for (std::size_t c = nodes.size(); c-- > 1;)
        if (nodes[c].parent == i) tell(static_cast<std::uint32_t>(c));
    };
    tell(0);
  }

 private:
  Quadtree tree_;
};

// As Borrowed, but each body is only where its middle is.
class ByMiddle : public Borrowed {
 public:
  using Borrowed::Borrowed;
  void insert(BodyId id, const Box<2>& box) { Borrowed::insert(id, {box.center(), box.center()}); }
};

const bool known = [] {
  know_own_structures(
      {own<Borrowed>("borrowed", "a borrowed tree"), own<ByMiddle>("by_middle", "")});
  return true;
}();

StructureKind kind_named(const char* name) { return structure_named(name).value(); }

// --- liars ---

struct Said {
  Box<2> box;
  std::uint32_t depth = 0;
  bool leaf = true;
  std::vector<BodyId> bodies = {};
};

class Liar : public OwnTree {
 public:
  using Visit = std::function<void(const NodeSink&)>;
  explicit Liar(Visit visit) : visit_(std::move(visit)) {}
  void insert(BodyId, const Box<2>&) override {}
  void visit(const NodeSink& f) const override { visit_(f); }
  bool clear() override { return true; }

 private:
  Visit visit_;
};

OwnKind liar(Liar::Visit visit) {
  return {"liar", "a liar", [visit](const Box<2>&, std::uint32_t, std::uint32_t) {
            return std::make_unique<Liar>(visit);
          }};
}

OwnKind saying(std::vector<Said> said) {
  return liar([said](const NodeSink& f) {
    for (const Said& s : said) f({s.box, s.depth, s.leaf, s.bodies});
  });
}

const Box<2> kWorld{{0, 0}, {64, 64}};
const Box<2> kUpperLeft{{0, 32}, {32, 64}}, kUpperRight{{32, 32}, {64, 64}};
const Box<2> kLowerLeft{{0, 0}, {32, 32}}, kLowerRight{{32, 0}, {64, 32}};
const Box<2> kSmall{{10, 10}, {20, 20}}, kAcross{{28, 28}, {40, 40}};  // bodies 0 and 1

std::vector<Said> right_tree() {
  return {{kWorld, 0, false},
          {kUpperLeft, 1, true, {1}},
          {kUpperRight, 1, true, {1}},
          {kLowerLeft, 1, true, {1, 0}},
          {kLowerRight, 1, true, {1}}};
}

// All that is told of a tree into which these were inserted; what is thrown stands alone.
std::string told_of(const OwnKind& kind, const std::vector<Box<2>>& boxes = {kSmall, kAcross}) {
  StructureConfig<2> config;
  config.bounds = kWorld;
  config.capacity = 2;
  config.max_depth = 4;
  try {
    const auto tree = own_tree<2>(kind, config);
    for (BodyId i = 0; i < boxes.size(); ++i) tree->insert({i, boxes[i]});
    tree->look();
    std::string all;
    for (const OwnFault& fault : tree->faults())
      all += text_of(fault, [](BodyId id) { return "b" + std::to_string(id); }) + "\n";
    return all;
  } catch (const StructureFault& broken) {
    return std::string("thrown: ") + broken.what();
  }
}

std::string told_of(std::vector<Said> said) { return told_of(saying(std::move(said))); }

#define EXPECT_TOLD(text, part)                                    \
  {                                                                \
    const std::string is = text;                                   \
    EXPECT_NE(is.find(part), std::string::npos) << "told: " << is; \
  }

TEST(OwnStructure, ARightTreeHasNoFaults) {
  EXPECT_EQ(told_of(right_tree()), "");
  EXPECT_EQ(told_of(std::vector<Said>{{kWorld, 0, true, {0, 1}}}), "");
}

TEST(OwnStructure, WhatOnlyTouchesABorderMayLieOnEitherSide) {
  const Box<2> touches{{20, 40}, {32, 50}}, across{{30, 40}, {40, 50}};
  std::vector<Said> said = right_tree();
  for (Said& s : said) s.bodies.clear();
  said[1].bodies = {0, 1}, said[2].bodies = {1};
  EXPECT_EQ(told_of(saying(said), {touches, across}), "");
}

TEST(OwnStructure, NodesThatCannotBeReadAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  auto said = right_tree();
  said[3].box.hi.y = kNan;
  EXPECT_TOLD(told_of(said),
              "thrown: structure 'liar': the box of node 3 goes from 0 to nan on axis y");
  said = right_tree();
  std::swap(said[0].box.lo, said[0].box.hi);
  EXPECT_TOLD(told_of(said),
              "thrown: structure 'liar': the box of the root goes from 64 to 0 on axis x");
  EXPECT_TOLD(told_of(std::vector<Said>{}), "visit told no node");
  said = right_tree();
  said[0].depth = 3;
  EXPECT_TOLD(told_of(said), "the first node that visit tells has depth 3");
  said = right_tree();
  said[4].depth = 0;
  EXPECT_TOLD(told_of(said), "second root after node 3");
  said = right_tree();
  said[2].depth = 3;
  EXPECT_TOLD(told_of(said), "after node 1, at depth 1, comes a node of depth 3; it can be 2");
  said = right_tree();
  said[2].depth = 2;
  EXPECT_TOLD(told_of(said), "node 1 is told as a leaf, but a child of it follows");
}

TEST(OwnStructure, LoopsEnd) {
  const OwnKind own_child = liar([](const NodeSink& f) {
    const std::function<void(std::uint32_t)> visit = [&](std::uint32_t depth) {
      f({kWorld, depth, false});
      visit(depth + 1);
    };
    visit(0);
  });
  EXPECT_TOLD(told_of(own_child),
              "thrown: structure 'liar': node 1.1.1.1.1 lies at depth 5, the limit is 4");
  const OwnKind endless = liar([](const NodeSink& f) {
    f({kWorld, 0, false});
    for (;;) f({kWorld, 1, true});
  });
  EXPECT_TOLD(told_of(endless), "the root has more than 4096 children; does visit come to an end?");
  // It hears that it should end, and does not.
  const OwnKind deaf = liar([](const NodeSink& f) {
    for (int i = 0; i < 10; ++i) try {
        f({kWorld, 7, false});
      } catch (...) {
      }
  });
  EXPECT_TOLD(told_of(deaf), "has depth 7");
}

TEST(OwnStructure, WhatItThrowsIsItsOwnFault) {
  EXPECT_TOLD(told_of(liar([](const NodeSink&) { throw std::runtime_error("no luck"); })),
              "thrown: structure 'liar': visit threw: no luck");
  EXPECT_TOLD(told_of(liar([](const NodeSink&) { throw 7; })),
              "something that is no std::exception");
  struct Thrower : Liar {
    using Liar::Liar;
    void insert(BodyId, const Box<2>&) override { throw std::out_of_range("vector"); }
  };
  const OwnKind thrower{"liar", "", [](auto&&...) {
                          return std::make_unique<Thrower>([](const NodeSink& f) { f({kWorld}); });
                        }};
  EXPECT_TOLD(told_of(thrower), "insert of body 0 threw: vector");
  const OwnKind stillborn{"liar", "", [](auto&&...) -> std::unique_ptr<OwnTree> {
                            throw std::runtime_error("not today");
                          }};
  EXPECT_TOLD(told_of(stillborn), "its constructor threw: not today");
}

TEST(OwnStructure, WrongListsAreTold) {
  auto said = right_tree();
  said[4].bodies = {1, 99};
  EXPECT_TOLD(told_of(said),
              "structure 'liar': node 4 lists a body of number 99, which was never inserted");
  said = right_tree();
  said[4].bodies = {1, 1};
  EXPECT_TOLD(told_of(said), "node 4 lists b1 twice");
  said = right_tree();
  said[0].bodies = {0};
  EXPECT_TOLD(told_of(said), "the root has children, and lists b0");
  said = right_tree();
  said[2].bodies = {0, 1};
  EXPECT_TOLD(told_of(said),
              "node 2, from [32, 32] to [64, 64], lists b0, which does not reach it: its box goes "
              "from [10, 10] to [20, 20]");
  said = right_tree();
  said[4].bodies = {};
  EXPECT_TOLD(told_of(said),
              "node 4, from [32, 0] to [64, 32], does not list b1, which reaches it");
  said = right_tree();
  said[3].bodies = {1};
  EXPECT_TOLD(told_of(said), "no leaf lists b0, whose box goes from [10, 10] to [20, 20]");
  said = right_tree();
  said[1].bodies = said[2].bodies = said[3].bodies = {};
  EXPECT_TOLD(told_of(said), "does not list b1");
  EXPECT_EQ(std::ranges::count(told_of(said), '\n'), 2) << "one of each body";
}

TEST(OwnStructure, WrongCellsAreTold) {
  auto said = right_tree();
  said[2].box.hi.x = 70;
  EXPECT_TOLD(told_of(said),
              "node 2 goes from [32, 32] to [70, 64], which is not within its parent");
  said = right_tree();
  said[2].box.lo.x = 20;
  EXPECT_TOLD(told_of(said), "node 2 overlaps its sibling 1");
  said = right_tree();
  said[0].box = kLowerLeft;
  EXPECT_TOLD(told_of(said),
              "the root goes from [0, 0] to [32, 32], but the world from [0, 0] to [64, 64]");
  said = right_tree();
  said.erase(said.begin() + 4);
  EXPECT_TOLD(told_of(said), "a part of b1 lies in no leaf");
  said = right_tree();
  said[1].leaf = false;
  EXPECT_TOLD(told_of(said), "node 1 is told as an inner node, but no child of it follows");
}

TEST(OwnStructure, APairThatSharesNoLeafIsMissed) {
  std::vector<Said> said = right_tree();
  for (Said& s : said) s.bodies.clear();
  said[3].bodies = {0}, said[4].bodies = {1};
  EXPECT_TOLD(told_of(saying(said), {Box<2>{{20, 8}, {32, 16}}, Box<2>{{32, 8}, {44, 16}}}),
              "b0 and b1 overlap, but share no leaf: b0 is listed in 3, b1 in 4");
}

// --- a right one ---

struct Seen {
  std::uint32_t slot, depth;
  bool leaf;
  Box<2> box;
  std::vector<BodyId> bodies;
  bool operator==(const Seen&) const = default;
};

std::vector<Seen> seen_of(const BroadPhase<2>& phase) {
  std::vector<Seen> all;
  phase.dynamic().visit([&](const NodeView<2>& node) {
    all.push_back(
        {node.slot, node.depth, node.leaf, node.box, {node.bodies.begin(), node.bodies.end()}});
    return true;
  });
  return all;
}

BroadPhase<2> phase_of(StructureKind kind, const Box<2>& bounds) {
  BroadPhaseConfig<2> config;
  config.kind = kind;
  config.bounds = bounds;
  config.capacity = 2;
  config.max_depth = 5;
  config.eager_children = true;
  config.no_progress_stop = false;
  config.in_proportion = false;
  return BroadPhase<2>(config);
}

TEST(OwnStructure, ARightTreeIsSeenAsOursIs) {
  for (const Sort sort : testing::kSorts) {
    Random random(7);
    const Box<2> bounds = testing::bounds_of<2>(sort);
    BroadPhase<2> ours = phase_of(StructureKind::quadtree, bounds);
    BroadPhase<2> own = phase_of(kind_named("borrowed"), bounds);
    for (int moved = 0; moved < 2; ++moved) {
      const auto items = testing::random_world<2>(sort, 20, random);
      std::vector<Proxy<2>> proxies;
      for (const auto& item : items) proxies.push_back({item.id, item.box});
      ours.update(proxies);
      own.update(proxies);
      EXPECT_EQ(own.faults().size(), 0u) << static_cast<int>(sort);
      EXPECT_EQ(own.pairs(), ours.pairs()) << static_cast<int>(sort);
      EXPECT_EQ(seen_of(own), seen_of(ours)) << static_cast<int>(sort);
      EXPECT_EQ(own.counters().nodes_visited, ours.counters().nodes_visited);
      const auto box_of = [&](BodyId id) { return testing::box_of(items, id); };
      for (int i = 0; i < 20; ++i) {
        const Vec<2> from = bounds.lo + testing::random_box<2>(Sort::outside, random).lo;
        const Vec<2> to = testing::random_box<2>(sort, random).center();
        const Ray<2> ray{from, to - from, 2};
        const auto hit = [&](const auto& tree) {
          return raycast_nearest<2>(tree, ray, box_of).hit;
        };
        EXPECT_EQ(hit(own.dynamic()), hit(ours.dynamic())) << static_cast<int>(sort);
      }
    }
  }
}

TEST(OwnStructure, EventsAreInferred) {
  BroadPhase<2> own = phase_of(kind_named("borrowed"), kWorld);
  std::vector<std::string> told;
  const auto watch = [&](const Event& e) {
    constexpr const char* kNames[] = {"test",  "miss",      "make_child",  "store",
                                      "split", "hand_down", "depth_limit", "no_progress"};
    told.push_back(std::string(kNames[static_cast<int>(e.kind)]) + " " + std::to_string(e.body));
    const bool counts = e.kind != Event::Kind::make_child;
    EXPECT_EQ(e.count > 0, counts) << told.back();
    EXPECT_EQ(e.limit, counts ? 2u : 0u) << told.back();
  };
  own.insert({5, {{2, 2}, {4, 4}}}, watch);
  own.insert({6, {{40, 2}, {44, 4}}}, watch);
  EXPECT_EQ(told, (std::vector<std::string>{"store 5", "store 6"}));
  told.clear();
  own.insert({7, {{40, 40}, {44, 44}}}, watch);
  EXPECT_EQ(told, (std::vector<std::string>{"split 7", "make_child 7", "make_child 7", "store 7",
                                            "make_child 7", "make_child 7"}));
}

TEST(OwnStructure, HandlesStayWhileTheTreeGrows) {
  BroadPhase<2> own = phase_of(kind_named("borrowed"), kWorld);
  std::vector<NodeHandle> before;
  Random random(3);
  for (BodyId id = 0; id < 12; ++id) {
    own.insert({id, testing::random_box<2>(Sort::uniform, random)}, {});
    std::vector<std::pair<std::string, NodeHandle>> now;
    std::vector<bool> used(own.dynamic().counters().nodes);
    own.dynamic().visit([&](const NodeView<2>& node) {
      EXPECT_FALSE(used.at(node.handle)) << "two of one handle";
      used.at(node.handle) = true;
      return true;
    });
  }
}

TEST(OwnStructure, InThreeDimensionsItLooksFromAbove) {
  BroadPhaseConfig<3> config;
  config.kind = kind_named("borrowed");
  config.bounds = {Vec<3>(0.0), Vec<3>(64.0)};
  config.capacity = 1;
  config.max_depth = 4;
  BroadPhase<3> own(config);
  config.kind = StructureKind::brute_force;
  BroadPhase<3> force(config);
  Random random(11);
  std::vector<Proxy<3>> proxies;
  for (BodyId id = 0; id < 40; ++id)
    proxies.push_back({id, testing::random_box<3>(Sort::uniform, random), id % 5 == 0});
  own.update(proxies);
  force.update(proxies);
  EXPECT_EQ(own.pairs(), force.pairs());
  EXPECT_TRUE(own.faults().empty());
}

// --- names and trials ---

TEST(OwnStructure, NamesAreOursOrTheirs) {
  EXPECT_EQ(to_string(kind_named("borrowed")), "borrowed");
  EXPECT_EQ(traits_of(kind_named("by_middle")).words, "by_middle");
  EXPECT_TRUE(traits_of(kind_named("by_middle")).is_own);
  EXPECT_EQ(known_structures().size(), kStructureKinds.size() + 2);
  for (const char* name : {"quadtree", "none", "borrowed", "", "My Tree"})
    EXPECT_THROW(know_own_structures({own<Borrowed>(name, "")}), Refused) << name;
}

TEST(StructureTrial, OurOwnFindWhatBruteForceFinds) {
  for (const StructureKind kind :
       {StructureKind::sort_and_sweep, StructureKind::quadtree, StructureKind::kd_tree,
        StructureKind::lecture_quadtree, kind_named("borrowed")})
    EXPECT_EQ(try_structure(kind, 28, 1).fault, "") << to_string(kind);
}

TEST(StructureTrial, AWrongTreeFailsOnASmallWorld) {
  const Trial trial = try_structure(kind_named("by_middle"), 28, 1);
  EXPECT_GT(trial.failed, 0u);
  EXPECT_LE(trial.smallest.bodies.size(), trial.smallest.capacity + 1) << trial.fault;
  EXPECT_TOLD(trial.fault, "structure 'by_middle': ");
  EXPECT_EQ(try_structure(kind_named("by_middle"), 28, 1).fault, trial.fault);
}

// Two bodies whose middles lie apart are enough for by_middle to miss their pair. They come first:
// one alone that is not listed where it reaches is a fault, too.
TEST(StructureTrial, AWorldIsShrunkToThePairThatIsMissed) {
  const StructureKind kind = kind_named("by_middle");
  TrialWorld world;
  world.bounds = kWorld;
  world.max_depth = 3;
  world.bodies.push_back({{29.3, 10.1}, Vec<2>(4.7)});
  world.bodies.push_back({{34.9, 11.2}, Vec<2>(4.6)});
  for (int i = 0; i < 6; ++i) world.bodies.push_back({{10.5 * i + 1.3, 50.7 - i}, Vec<2>(0.3)});
  EXPECT_TOLD(fault_in(kind, world).value_or(""), "their pair is missed");
  const TrialWorld least = shrunk(kind, world);
  EXPECT_EQ(least.bodies.size(), 2u);
  EXPECT_EQ(least.max_depth, 1u) << "one split parts them";
  EXPECT_TOLD(fault_in(kind, least).value_or(""), "their pair is missed");
}

// What all with all compare is known.
TEST(StructureTrial, ABenchTimesStructuresOfTheSameBodies) {
  const StructureBench bench{.kinds = {StructureKind::brute_force, StructureKind::quadtree,
                                       StructureKind::sort_and_sweep, kind_named("borrowed")},
                             .bodies = {60},
                             .rounds = 1};
  std::uint64_t told = 0;
  const std::vector<StructureTime> rows = bench_structures(bench, [&] { ++told; });
  EXPECT_EQ(rows.size(), structure_bench_rows(bench));
  EXPECT_EQ(told, rows.size());
  for (const StructureTime& row : rows) {
    SCOPED_TRACE(row.scene + " " + std::string(to_string(row.kind)));
    EXPECT_EQ(row.fault, "");
    EXPECT_EQ(row.bodies, 60u);
    EXPECT_EQ(row.missed + row.invented, 0u);
    EXPECT_EQ(row.build.repeats, 1);
    EXPECT_GE(row.entries, 60u) << "each body lies somewhere";
    EXPECT_GT(row.pair_tests, 0u);
    if (row.kind != StructureKind::brute_force) continue;
    EXPECT_EQ(row.nodes, 1u);
    EXPECT_EQ(row.entries, 60u);
    EXPECT_EQ(row.pair_tests, 60u * 59 / 2);
  }
}

// One that covers the world is listed in six of seven leaves: four are named.
TEST(OwnStructure, OfManyLeavesOnlyTheFirstAreNamed) {
  std::vector<Said> said{{kWorld, 0, false}};
  for (int i = 0; i < 7; ++i)
    said.push_back({{Vec<2>(64.0 * i / 7, 0), Vec<2>(64.0 * (i + 1) / 7, 64)}, 1, true, {0}});
  const std::vector<Box<2>> all{kWorld};
  said[7].bodies.clear();
  EXPECT_TOLD(told_of(saying(said), all), "listed in 1, 2, 3, 4 and 2 more\n");
  said[6].bodies.clear();
  EXPECT_TOLD(told_of(saying(said), all), "listed in 1, 2, 3, 4 and 1 more\n");
  said[5].bodies.clear();
  EXPECT_TOLD(told_of(saying(said), all), "listed in 1, 2, 3, 4\n");
}

}  // namespace
}  // namespace lantern::spatial
