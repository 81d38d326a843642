#include "spatial/level_bsp.hpp"

#include <cmath>

namespace lantern::spatial {

LevelBsp::LevelBsp(std::span<const Wall> walls, const Box<2>& bounds)
    : bounds_(bounds), grid_(bounds), walls_(checked_walls(walls, bounds, grid_)) {
  for (const Wall& wall : walls_) lines_.push_back(line_of(wall.line));
}

void LevelBsp::require_eye(const Vec<2>& eye) {
  for (int i = 0; i < 2; ++i)
    if (!std::isfinite(eye[i]))
      throw Refused(fmt::format("level: the eye's {} is not finite", "xy"[i]));
}

std::optional<LevelBsp::Place> LevelBsp::locate(const Vec<2>& point) const {
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !contains(bounds_, point)) return {};
  Place place;
  NodeHandle handle = 0;
  for (place.nodes_visited = 1; !nodes_[handle].is_leaf(); ++place.nodes_visited)
    handle = nodes_[handle].first_child + (height(point, nodes_[handle].plane) >= 0 ? 1u : 0u);
  place.sector = nodes_[handle].sector;
  place.floor = true;
  for (const std::uint32_t p : nodes_[handle].pieces)
    if (pieces_[p].node == kNone && grid_.side(lines_[pieces_[p].wall], point) < 0)
      place.floor = false;
  return place;
}

std::vector<BspPlane<2>> LevelBsp::planes() const {
  std::vector<BspPlane<2>> planes;
  std::vector<std::uint32_t> position(nodes_.size(), kNone);  // of a node's plane
  for (NodeHandle i = 0; i < nodes_.size(); ++i) {
    const LevelNode& node = nodes_[i];
    if (node.is_leaf()) continue;
    position[i] = static_cast<std::uint32_t>(planes.size());
    planes.push_back(
        {node.plane, node.parent == kNone ? kNone : position[node.parent], node.front});
  }
  return planes;
}

LevelCounters LevelBsp::counters() const {
  LevelCounters c{.walls = walls_.size(),
                  .nodes = nodes_.size(),
                  .sectors = sectors_.size(),
                  .pieces = pieces_.size(),
                  .cuts = cuts_,
                  .candidates = candidates_,
                  .side_tests = side_tests_};
  for (const LevelNode& node : nodes_) {
    c.depth = std::max<std::uint64_t>(c.depth, node.depth);
    c.chosen_score += node.chosen.score;
    c.first_score += node.first.score;
  }
  return c;
}

}  // namespace lantern::spatial
