// What the tree tells while it is built is true at that moment, and telling changes nothing.
#include <functional>
#include <map>
#include <set>
#include <type_traits>

#include <gtest/gtest.h>

#include "spatial/picture.hpp"
#include "spatial/trees/orthtree.hpp"
#include "spatial/worlds.hpp"

namespace lantern::spatial {
namespace {

using Kind = Event::Kind;
using testing::Sort;

static_assert(std::is_empty_v<NoObserver>, "the default observer must carry nothing");

// Looks at the whole tree at each event, as a director does that pictures every event.
class Witness {
 public:
  Witness(const Quadtree& tree, const testing::TreeConfig<2>& config,
          const std::vector<Item<2>>& items)
      : tree_(tree), config_(config), items_(items) {}

  void operator()(const Event& event) {
    ++told[event.kind];
    const auto node = look(event.node);
    switch (event.kind) {
      case Kind::make_child:
        EXPECT_TRUE(made_.insert(event.node).second) << "a node came to be twice";
        EXPECT_TRUE(node.leaf && node.bodies.empty());
        break;
      case Kind::store:
        EXPECT_TRUE(std::binary_search(node.bodies.begin(), node.bodies.end(), event.body));
        expect_count(event, node.bodies.size());
        break;
      case Kind::split:
        EXPECT_TRUE(node.leaf) << "a snapshot must still show the overflowing leaf";
        EXPECT_GT(event.count, event.limit);
        expect_count(event, node.bodies.size());
        waiting_[event.node] = event.count;
        break;
      case Kind::hand_down:
        EXPECT_FALSE(node.leaf);
        EXPECT_GT(waiting_[event.node]--, 0u) << "handed down more than the node held";
        break;
      case Kind::depth_limit:
        EXPECT_EQ(node.depth, config_.max_depth);
        EXPECT_GT(event.count, event.limit);
        expect_count(event, node.bodies.size());
        break;
      case Kind::no_progress:
        EXPECT_TRUE(config_.no_progress_stop);
        EXPECT_GT(event.count, event.limit);
        for (const BodyId a : node.bodies)
          for (const BodyId b : node.bodies)
            EXPECT_TRUE(overlap(testing::box_of(items_, a), testing::box_of(items_, b)));
        break;
      case Kind::test:
      case Kind::miss:
        break;
      case Kind::rotate:
      case Kind::leave:
        ADD_FAILURE() << "an orthtree turns nothing";
        break;
    }
  }

  void expect_all_handed_down() const {
    for (const auto& [node, left] : waiting_) EXPECT_EQ(left, 0u) << "node " << node;
  }

  std::map<Kind, std::uint64_t> told;

 private:
  struct Node {
    bool leaf = true;
    std::uint32_t depth = 0;
    std::vector<BodyId> bodies;
  };

  Node look(NodeHandle handle) const {
    std::optional<Node> found;
    std::uint64_t nodes = 0;
    tree_.visit([&](const NodeView<2>& view) {
      ++nodes;
      if (view.handle == handle)
        found = Node{view.leaf, view.depth, {view.bodies.begin(), view.bodies.end()}};
      return true;
    });
    EXPECT_EQ(nodes, tree_.counters().nodes);
    EXPECT_TRUE(found.has_value()) << "the event names a node that is not in the tree";
    return found.value_or(Node{});
  }

  void expect_count(const Event& event, std::size_t held) const {
    EXPECT_EQ(event.count, held);
    EXPECT_EQ(event.limit, config_.capacity);
  }

  const Quadtree& tree_;
  const testing::TreeConfig<2>& config_;
  const std::vector<Item<2>>& items_;
  std::set<NodeHandle> made_;
  std::map<NodeHandle, std::uint32_t> waiting_;  // bodies of a split node still to be handed down
};

void expect_true_events(Sort sort, std::uint64_t seed) {
  SCOPED_TRACE(fmt::format("sort {}, seed {}", static_cast<int>(sort), seed));
  Random random(seed);
  const auto items = testing::random_world<2>(sort, 14, random);
  testing::TreeConfig<2> config;
  config.bounds = testing::bounds_of<2>(sort);
  config.capacity = static_cast<std::uint32_t>(random.whole(1, 4));
  config.max_depth = 3;
  config.eager_children = random.bits() % 2 == 0;
  config.no_progress_stop = random.bits() % 2 == 0;
  Quadtree watched(config), alone(config);
  Witness witness(watched, config, items);
  for (const Item<2>& item : items) {
    watched.insert(item, std::ref(witness));
    alone.insert(item);
  }
  witness.expect_all_handed_down();

  const Counters c = watched.counters();
  EXPECT_EQ(witness.told[Kind::split], c.splits);
  EXPECT_EQ(witness.told[Kind::make_child] + 1, c.nodes);
  // A child that was not made is tested, but cannot be named in a `miss`.
  if (config.eager_children) {
    EXPECT_EQ(witness.told[Kind::test] + witness.told[Kind::miss], c.box_tests);
  }

  const Counters d = alone.counters();
  EXPECT_EQ(testing::picture_of<2>(watched), testing::picture_of<2>(alone))
      << "watching changed the tree";
  EXPECT_TRUE(c.box_tests == d.box_tests && c.allocations == d.allocations &&
              c.entries == d.entries && c.splits == d.splits)
      << "watching changed the work done";
}

TEST(OrthtreeEvents, AreTrueWhenTheyAreTold) {
  for (const Sort sort : testing::kSorts)
    for (std::uint64_t seed = 0; seed < 8; ++seed) expect_true_events(sort, seed);
}

TEST(OrthtreeEvents, TellTheLecturesStoryInOrder) {
  testing::TreeConfig<2> config;
  config.bounds = {{0, 0}, {64, 64}};
  config.capacity = 1;
  config.max_depth = 1;
  Quadtree tree(config);
  std::vector<std::string> story;
  const auto listen = [&](const Event& e) {
    constexpr const char* kNames[] = {"test",  "miss",      "make",  "store",
                                      "split", "hand down", "limit", "no progress"};
    story.push_back(fmt::format("{} {} body {}", kNames[static_cast<int>(e.kind)], e.node, e.body));
  };
  tree.insert({7, {{1, 1}, {2, 2}}}, listen);
  tree.insert({5, {{60, 60}, {61, 61}}}, listen);
  const std::vector<std::string> expected = {
      "test 0 body 7",      "store 0 body 7",                                      //
      "test 0 body 5",      "store 0 body 5", "split 0 body 5",                    //
      "hand down 0 body 7", "make 1 body 7",  "test 1 body 7",  "store 1 body 7",  //
      "hand down 0 body 5", "make 2 body 5",  "test 2 body 5",  "store 2 body 5", "miss 1 body 5"};
  EXPECT_EQ(story, expected);
}

}  // namespace
}  // namespace lantern::spatial
