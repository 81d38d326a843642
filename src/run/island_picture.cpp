#include "run/island_picture.hpp"

#include <algorithm>

#include "frame/parts/motion.hpp"

namespace lantern::run {
namespace {

// In order of ids, each pair once: what is tied may also touch.
void put_in_order(std::vector<FrameEdge>& edges) {
  std::ranges::stable_sort(edges, {}, &FrameEdge::pair);
  const auto twice = std::ranges::unique(edges, {}, &FrameEdge::pair);
  edges.erase(twice.begin(), twice.end());
}

}  // namespace

template <int D>
void picture_islands(const Players<D>& players, IslandNumbers& numbers, Frame& frame) {
  const World<D>& world = players.world();
  std::map<BodyId, FrameIsland> found;  // by the lowest id
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const Body<D>& body = world.bodies()[i];
    const BodyId first = world.islands()[i];
    if (first == kNoIsland) continue;
    const auto number = static_cast<std::uint32_t>(numbers.size() + 1);
    FrameIsland& island = found[first];
    island.number = numbers.emplace(first, number).first->second;
    island.bodies.push_back(body.id);
    island.asleep = body.asleep;
  }
  auto& [islands, edges] = frame.add<FrameIslands>();
  for (auto& entry : found) islands.push_back(std::move(entry.second));
  std::ranges::sort(islands, {}, &FrameIsland::number);

  const auto is_seen = [&](BodyId id) { return world.find(id) && players.spec_of(id); };
  const auto add_edge = [&list = edges](const Pair& pair, bool tied) {
    list.push_back({{std::min(pair.a, pair.b), std::max(pair.a, pair.b)}, tied, false});
  };
  const auto tie = [&](const auto& link) {
    if (is_seen(link.a) && is_seen(link.b)) add_edge({link.a, link.b}, true);
  };
  for (const auto& entry : world.joints()) tie(entry.second);
  for (const Spring<D>& spring : world.forces().springs) tie(spring);
  for (const FrameContact& contact : frame.contacts) add_edge(contact.pair, false);
  put_in_order(edges);
}

void count_islands(Frame& frame) {
  const std::vector<FrameIsland>& islands = frame.get<FrameIslands>().islands;
  std::size_t largest = 0;
  for (const FrameIsland& island : islands) largest = std::max(largest, island.bodies.size());
  frame.add_count("islands", islands.size());
  frame.add_count("largest_island", largest);
  frame.add_count("islands_asleep",
                  static_cast<std::uint64_t>(std::ranges::count_if(islands, &FrameIsland::asleep)));
}

template void picture_islands(const Players<2>&, IslandNumbers&, Frame&);
template void picture_islands(const Players<3>&, IslandNumbers&, Frame&);

}  // namespace lantern::run
