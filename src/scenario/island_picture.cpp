#include "scenario/island_picture.hpp"

#include <algorithm>

namespace lantern::scenario {
namespace {

void add_edge(const Pair& pair, bool tied, Frame& frame) {
  frame.edges.push_back({{std::min(pair.a, pair.b), std::max(pair.a, pair.b)}, tied, false});
}

// In order of ids, each pair once: what is tied may also touch.
void put_edges_in_order(Frame& frame) {
  std::ranges::stable_sort(frame.edges, {}, &FrameEdge::pair);
  const auto twice = std::ranges::unique(frame.edges, {}, &FrameEdge::pair);
  frame.edges.erase(twice.begin(), twice.end());
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
  for (auto& entry : found) frame.islands.push_back(std::move(entry.second));
  std::ranges::sort(frame.islands, {}, &FrameIsland::number);

  const auto is_seen = [&](BodyId id) { return world.find(id) && players.spec_of(id); };
  const auto tie = [&](const auto& link) {
    if (is_seen(link.a) && is_seen(link.b)) add_edge({link.a, link.b}, true, frame);
  };
  for (const auto& entry : world.joints()) tie(entry.second);
  for (const Spring<D>& spring : world.forces().springs) tie(spring);
  for (const FrameContact& contact : frame.contacts) add_edge(contact.pair, false, frame);
  put_edges_in_order(frame);
}

void count_islands(Frame& frame) {
  std::size_t largest = 0;
  for (const FrameIsland& island : frame.islands) largest = std::max(largest, island.bodies.size());
  frame.add_count("islands", frame.islands.size());
  frame.add_count("largest_island", largest);
  frame.add_count("islands_asleep", static_cast<std::uint64_t>(std::ranges::count_if(
                                        frame.islands, &FrameIsland::asleep)));
}

template void picture_islands(const Players<2>&, IslandNumbers&, Frame&);
template void picture_islands(const Players<3>&, IslandNumbers&, Frame&);

}  // namespace lantern::scenario
