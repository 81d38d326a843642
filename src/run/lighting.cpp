#include "run/lighting.hpp"

#include <algorithm>

#include "base/hash.hpp"
#include "frame/parts/level.hpp"
#include "frame/parts/motion.hpp"

namespace lantern::run {
namespace {

constexpr std::size_t kMostInFocus = 3;  // of more, nobody stands out

// Of each node its way down from the root: a node that is made anew at the same place is the same.
std::vector<std::uint64_t> places_of(const Frame& frame) {
  std::vector<std::uint64_t> places;
  places.reserve(frame.nodes.size());
  for (const FrameNode& node : frame.nodes) {
    const std::uint64_t parent = node.parent == kNone ? 0 : places[node.parent];
    Hash hash;
    hash.add(parent).add(std::uint64_t{node.slot}).add(std::uint64_t{node.of_static});
    // A grid's cells may have been made larger or smaller.
    if (!frame.get<FrameStructure>().grid_levels.empty() && node.leaf)
      hash.add(node.box.lo.x).add(node.box.lo.y).add(node.box.hi.x);
    places.push_back(hash.value());
  }
  return places;
}

bool holds_any(const FrameNode& leaf, const std::set<BodyId>& bodies) {
  return std::ranges::any_of(leaf.bodies, [&](BodyId id) { return bodies.contains(id); });
}

// Parents stand before children, so one pass from the back hands the light up.
void pass_to(Frame& frame) {
  for (std::size_t i = frame.nodes.size(); i-- > 0;) {
    const FrameNode& node = frame.nodes[i];
    if (node.mark == Mark::quiet || node.parent == kNone) continue;
    Mark& above = frame.nodes[node.parent].mark;
    if (above == Mark::quiet) above = Mark::passed;
  }
}

void put_out(Frame& frame) {
  for (FrameBody& body : frame.bodies) body.lit = false;
  for (FrameNode& node : frame.nodes) node.mark = Mark::quiet;
  for (FramePair& pair : frame.pairs) pair.lit = false;
  if (auto* islands = frame.find<FrameIslands>())
    for (FrameEdge& edge : islands->edges) edge.lit = false;
  if (auto* level = frame.find<FrameLevel>())
    for (FrameWall& wall : level->walls) wall.mark = Mark::quiet;
}

bool is_all_that_move(const std::set<BodyId>& focus, const Frame& frame) {
  return focus.size() > 1 && std::ranges::all_of(frame.bodies, [&](const FrameBody& body) {
           return body.is_static || focus.contains(body.id);
         });
}

}  // namespace

void Lighting::light(const Cause& cause, Frame& frame) const {
  if (frame.index == 0 && !cause.midst) return put_out(frame);
  const std::size_t n = cause.focus.size();
  const bool all = (cause.verb.passes_time && is_all_that_move(cause.focus, frame)) ||
                   (cause.verb.asks && n > 1 && n == frame.bodies.size());
  const bool few = !all && n <= kMostInFocus;
  for (FrameBody& body : frame.bodies)
    body.lit = (few || (cause.verb.asks && !all)) && cause.focus.contains(body.id);
  light_nodes(cause, few, frame);
  light_pairs(few, frame);
  light_edges(frame);
}

void Lighting::light_nodes(const Cause& cause, bool few, Frame& frame) const {
  const bool marked = std::ranges::any_of(
      frame.nodes, [](const FrameNode& node) { return node.mark != Mark::quiet; });
  if (marked) {
    // A question lights where it has found something, of all that it went through.
    if (cause.verb.asks && !cause.midst && frame.nodes.size() > 1)
      for (FrameNode& node : frame.nodes)
        if (node.leaf && node.mark == Mark::passed && holds_any(node, cause.focus))
          node.mark = Mark::lit;
    return;
  }
  if (cause.midst || frame.nodes.size() < 2) return;
  if (few && !cause.focus.empty()) {
    for (FrameNode& node : frame.nodes)
      if (node.leaf && holds_any(node, cause.focus)) node.mark = Mark::lit;
    return pass_to(frame);
  }
  if (places_.empty()) return;
  const std::vector<std::uint64_t> places = places_of(frame);
  std::vector<std::size_t> fresh;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::ranges::binary_search(places_, places[i])) fresh.push_back(i);
  if (2 * fresh.size() > places.size()) return;  // nearly all are
  for (const std::size_t i : fresh) frame.nodes[i].mark = Mark::lit;
  pass_to(frame);
}

void Lighting::light_pairs(bool few, Frame& frame) const {
  std::size_t fresh = 0;
  for (FramePair& p : frame.pairs) {
    p.lit = !std::ranges::binary_search(pairs_, p.pair);
    fresh += p.lit;
  }
  if (few || 2 * fresh <= frame.pairs.size()) return;
  for (FramePair& p : frame.pairs) p.lit = false;
}

// Where nothing held together before, all of it is new.
void Lighting::light_edges(Frame& frame) const {
  auto* islands = frame.find<FrameIslands>();
  if (!islands) return;
  for (FrameEdge& edge : islands->edges)
    edge.lit = !edges_.empty() && !std::ranges::binary_search(edges_, edge.pair);
}

void Lighting::remember(const Frame& frame, bool midst) {
  pairs_.clear();
  for (const FramePair& p : frame.pairs) pairs_.push_back(p.pair);
  edges_.clear();
  for (const FrameEdge& e : frame.get<FrameIslands>().edges) edges_.push_back(e.pair);
  if (midst) return;
  places_ = places_of(frame);
  std::ranges::sort(places_);
}

}  // namespace lantern::run
