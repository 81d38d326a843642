// The graph of islands: what is drawn of it, and that it stands where the world does.
#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/sample_frames.hpp"

namespace lantern::draw {
namespace {

const Frame& island_sample(const std::string& name) {
  static const samples::Named all = samples::islands();
  for (const auto& [known, frame] : all)
    if (known == name) return frame;
  throw std::invalid_argument(name);
}

// The first shape of each keyed run of the graph.
std::map<std::string, DrawShape> graph_of(const DrawList& list) {
  std::map<std::string, DrawShape> found;
  for (const KeyedRun& run : list.runs)
    if (run.key.starts_with("islands/") && run.first < list.shapes.size())
      found.emplace(run.key, list.shapes[run.first]);
  return found;
}

std::size_t with_prefix(const std::map<std::string, DrawShape>& shapes, std::string_view prefix) {
  return static_cast<std::size_t>(std::ranges::count_if(
      shapes, [&](const auto& entry) { return entry.first.starts_with(prefix); }));
}

TEST(IslandsPanel, HasANodeForEachBodyThatCanBeMovedAndAnEdgeForWhatHoldsTwo) {
  const DrawList list = samples::page_of(island_sample("islands2"));
  const auto graph = graph_of(list);
  EXPECT_EQ(with_prefix(graph, "islands/node/"), 5u);
  EXPECT_FALSE(graph.contains("islands/node/floor"));
  EXPECT_TRUE(graph.contains("islands/static/floor"));
  EXPECT_EQ(with_prefix(graph, "islands/edge/"), 3u);
  EXPECT_EQ(with_prefix(graph, "islands/ground/"), 4u + 2u) << "under nodes and edges";
  EXPECT_TRUE(says(list, "island 1, asleep"));
  EXPECT_TRUE(says(list, "island 2"));
  const auto stroke = [&](const char* key) { return std::get<LineShape>(graph.at(key)).stroke; };
  EXPECT_EQ(stroke("islands/edge/b3/b4").role, Role::lit) << "it is new";
  EXPECT_EQ(stroke("islands/edge/b1/b2").role, Role::ink);
  EXPECT_GT(stroke("islands/edge/floor/b1").dash, 0) << "what never moves joins nothing";
}

TEST(IslandsPanel, StandsWhereTheWorldDoes) {
  const DrawList list = samples::page_of(island_sample("islands2"));
  const auto graph = graph_of(list);
  const WorldMap& map = list.maps.at(0);
  std::optional<Vec<2>> beside;  // from a body to its node, the same for all
  for (const FrameBody& body : island_sample("islands2").bodies) {
    if (body.is_static) continue;
    const Vec<2> node = std::get<RectShape>(graph.at("islands/node/" + body.name)).box.center();
    const Vec<2> way = node - (map.origin + Vec<2>(body.position.x, -body.position.y) * map.scale);
    if (!beside) beside = way;
    EXPECT_NEAR(way.x, beside->x, 1e-6) << body.name;
    EXPECT_NEAR(way.y, beside->y, 1e-6) << body.name;
  }
}

TEST(IslandsPanel, SaysWhatItLeavesOut) {
  const DrawList list = samples::page_of(island_sample("islands600"));
  EXPECT_TRUE(says(list, "not all bodies are drawn"));
  EXPECT_TRUE(graph_of(samples::page_of(island_sample("islands0"))).empty());
}

}  // namespace
}  // namespace lantern::draw
