#include "draw/naming.hpp"

#include <algorithm>
#include <cctype>

#include "draw/world/world2d_parts.hpp"

namespace lantern::draw {
namespace {

constexpr std::ptrdiff_t kFewBodies = 8;  // with names
constexpr double kNameSpare = 1;          // that a name's side has to the room's rim and to bodies
constexpr std::uint32_t kFewLeaves = 9;
constexpr std::size_t kMostLookedAt = 120;  // frames of a group, here and there

// As a word of its own.
bool names(const std::string& text, const std::string& name) {
  const auto is_part = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0);
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if ((at == 0 || !is_part(at - 1)) && !is_part(at + name.size())) return true;
  return false;
}

using Free = std::map<std::string, std::array<int, 8>, std::less<>>;  // by body: on how many frames

void count_free(const Frame& frame, const Box<2>& panel, Free& free) {
  const View2D map(flat(frame.bounds), panel);
  const std::vector<Stand> stands = stands_of(frame, map);
  const Box<2> room = shrunk(map.picture(), 5);
  std::vector<Box<2>> covered;
  for (const Stand& stand : stands) covered.push_back(stand.box);
  for (const Stand& stand : stands) {
    const FrameBody& body = *stand.bodies.front();
    if (stand.bodies.size() > 1 || !shows_name(frame, body)) continue;
    const auto anchors = anchors_around(stand.box, kNameGap + kNameSpare, {});
    std::array<int, 8>& counts = free[body.name];
    for (std::size_t k = 0; k < anchors.size(); ++k) {
      const Box<2> extent = Labels::extent(body.name, anchors[k], {});
      counts[k] += holds(room, extent) && !touches(covered, extent);
    }
  }
}

}  // namespace

bool shows_name(const Frame& frame, const FrameBody& body) {
  if (body.name.empty() || frame.display.names == ShownNames::none) return false;
  if (body.lit || frame.display.names == ShownNames::all) return true;
  const auto named = std::ranges::count_if(
      frame.bodies, [](const FrameBody& other) { return !other.name.empty(); });
  return named <= kFewBodies || names(frame.caption, body.name);
}

std::vector<std::string> leaf_names(const Frame& frame, const FrameNode& leaf) {
  const std::size_t dot = leaf.label.rfind('.');
  if (traits_of(frame.structure).names != NodeNames::sides || dot == std::string::npos)
    return {leaf.label};
  if (leaf.mark != Mark::lit && !leaf.over_capacity) return {};
  const std::string side = leaf.label.substr(dot + 1);
  if (leaf.parent == kNone || frame.nodes[leaf.parent].plane_name.empty()) return {side};
  return {frame.nodes[leaf.parent].plane_name + ": " + side, side};
}

bool shows_id(const Staging& staging, const FrameNode& node) {
  return node.mark != Mark::quiet || staging.leaves() <= kFewLeaves;
}

const NameSides& name_sides(const Staging& staging, const Box<2>& panel) {
  return staging.once<NameSides>("sides of names", panel, [&] {
    Free free;
    for (const Frame* frame : staging.some_frames(kMostLookedAt))
      if (frame->bodies.size() <= kCrowd) count_free(*frame, panel, free);
    NameSides sides;
    for (const auto& [name, counts] : free)
      sides[name] = static_cast<std::size_t>(std::ranges::max_element(counts) - counts.begin());
    return sides;
  });
}

std::array<Anchor, 8> on_its_side(std::array<Anchor, 8> anchors, const NameSides& sides,
                                  std::string_view name) {
  const auto found = sides.find(name);
  if (found != sides.end())
    std::rotate(anchors.begin(), anchors.begin() + static_cast<std::ptrdiff_t>(found->second),
                anchors.begin() + static_cast<std::ptrdiff_t>(found->second) + 1);
  return anchors;
}

}  // namespace lantern::draw
