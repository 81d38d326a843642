#include <map>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/tree/tree_layout.hpp"

namespace lantern::draw {
namespace {

constexpr double kGap = 7;

// A random tree, its nodes in level order, as the diagram gives them.
std::vector<TidyNode> random_tree(std::uint64_t seed, std::size_t most, int most_children) {
  Random random(seed);
  std::vector<TidyNode> nodes{{0xffffffff, random.between(5, 60)}};
  for (std::uint32_t at = 0; at < nodes.size() && nodes.size() < most; ++at)
    for (std::int64_t k = random.whole(at == 0 ? 1 : 0, most_children); k > 0; --k)
      nodes.push_back({at, random.between(5, 60)});
  return nodes;
}

std::vector<std::uint32_t> depths(const std::vector<TidyNode>& nodes) {
  std::vector<std::uint32_t> depth(nodes.size());
  for (std::size_t i = 1; i < nodes.size(); ++i) depth[i] = depth[nodes[i].parent] + 1;
  return depth;
}

void expect_tidy(const std::vector<TidyNode>& nodes, std::uint64_t seed) {
  const std::vector<double> x = tidy_tree(nodes, kGap);
  const auto depth = depths(nodes);
  std::map<std::uint32_t, std::size_t> last_of_row;
  std::map<std::uint32_t, std::pair<double, double>> children;
  double left = 1e300;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    left = std::min(left, x[i] - nodes[i].width / 2);
    const auto last = last_of_row.find(depth[i]);
    if (last != last_of_row.end()) {
      const std::size_t j = last->second;
      EXPECT_GE(x[i] - nodes[i].width / 2, x[j] + nodes[j].width / 2 + kGap - 1e-9)
          << "nodes " << j << " and " << i << " of one row overlap or changed places, so edges "
          << "cross; seed " << seed;
    }
    last_of_row[depth[i]] = i;
    if (i == 0) continue;
    auto [span, first] = children.try_emplace(nodes[i].parent, x[i], x[i]);
    span->second.second = x[i];
  }
  EXPECT_NEAR(left, 0, 1e-9) << "seed " << seed;
  for (const auto& [parent, span] : children)
    EXPECT_NEAR(x[parent], (span.first + span.second) / 2, 1e-9)
        << "node " << parent << " is not centred over its children; seed " << seed;
}

TEST(TidyTree, HoldsItsPromisesForRandomTrees) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
    expect_tidy(random_tree(seed, 10 + seed, 2 + static_cast<int>(seed % 4)), seed);
}

TEST(TidyTree, OfOneNode) {
  EXPECT_EQ(tidy_tree(std::vector<TidyNode>{{0xffffffff, 30}}, kGap), (std::vector<double>{15}));
  EXPECT_TRUE(tidy_tree({}, kGap).empty());
}

TEST(TidyTree, DrawsEqualSubtreesAlike) {
  // The root's first and last child carry the same subtree; what stands between them differs.
  const auto subtree = random_tree(5, 40, 3);
  std::vector<TidyNode> nodes{{0xffffffff, 20}, {0, 20}, {0, 90}, {0, 20}};
  std::vector<std::vector<std::size_t>> copies(2);
  for (std::size_t copy = 0; copy < 2; ++copy) {
    const auto base = static_cast<std::uint32_t>(nodes.size());
    for (std::size_t i = 0; i < subtree.size(); ++i) {
      TidyNode node = subtree[i];
      node.parent = i == 0 ? (copy == 0 ? 1 : 3) : base + node.parent;
      copies[copy].push_back(nodes.size());
      nodes.push_back(node);
    }
  }
  const auto x = tidy_tree(nodes, kGap);
  const double moved = x[copies[1][0]] - x[copies[0][0]];
  for (std::size_t i = 0; i < subtree.size(); ++i)
    EXPECT_NEAR(x[copies[1][i]] - x[copies[0][i]], moved, 1e-9) << "node " << i;
}

TEST(TidyTree, SpreadsSmallSubtreesEvenly) {
  // Two wide subtrees hold three single leaves between them; these stand at equal distances.
  std::vector<TidyNode> nodes{{0xffffffff, 10}};
  for (int i = 0; i < 5; ++i) nodes.push_back({0, 10});
  for (int i = 0; i < 9; ++i) nodes.push_back({1, 10});
  for (int i = 0; i < 9; ++i) nodes.push_back({5, 10});
  const auto x = tidy_tree(nodes, kGap);
  for (std::size_t i = 2; i <= 5; ++i)
    EXPECT_NEAR(x[i] - x[i - 1], (x[5] - x[1]) / 4, 1e-9) << "child " << i;
}

}  // namespace
}  // namespace lantern::draw
