// The pictures of a level: its walls and sectors, who looks and what is seen, and the counts.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/check.hpp"
#include "frame/parts/level.hpp"
#include "run/level_stage.hpp"
#include "spatial/pairs.hpp"

namespace lantern::run {

void LevelStage::picture_walls(Frame& frame) const {
  for (std::uint32_t i = 0; i < walls_.size(); ++i)
    frame.add<FrameLevel>().walls.push_back(
        {walls_[i].line.a, walls_[i].line.b, i, kNone, i == lit_wall_ ? Mark::lit : Mark::quiet});
}

// Does the one that looks see this sector?
bool LevelStage::is_seen(std::uint32_t sector) const {
  const std::uint32_t from = shown_ == Answer::sights ? place_->sector : viewer_;
  return seen_ && from != kNone && seen_->sees(from, sector);
}

void LevelStage::mark_sector(std::uint32_t sector, FrameNode& node) const {
  const auto at = std::find(order_.begin(), order_.end(), sector);
  if (at != order_.end()) node.order = static_cast<std::uint32_t>(at - order_.begin());
  const bool looks = shown_ == Answer::sights || viewer_ != kNone;
  if ((shown_ != Answer::none && place_ && place_->sector == sector) || viewer_ == sector)
    node.mark = Mark::lit;
  else if (looks && is_seen(sector))
    node.mark = Mark::passed;
  node.unseen = looks && !is_seen(sector);
}

LevelStage::NodeOfSector LevelStage::picture_nodes(const LevelBsp& level, bool holds_bodies,
                                                   Frame& frame) const {
  // Those of the bodies' tree are the same, in the same order; else they stand before these.
  const auto first = holds_bodies ? 0u : static_cast<std::uint32_t>(frame.nodes.size());
  if (!holds_bodies) frame.nodes.resize(first + level.nodes().size());
  LANTERN_CHECK(frame.nodes.size(), ==, first + level.nodes().size());
  std::vector<std::uint32_t> node_of(level.nodes().size(), kNone);
  NodeOfSector sectors(level.sectors().size(), kNone);
  level.visit([&](const LevelNodeView& view) {
    node_of[view.handle] = first + view.id;
    FrameNode& node = frame.nodes[first + view.id];
    node.id = first + view.id;
    node.parent = view.parent == kNone ? kNone : first + view.parent;
    node.slot = view.slot;
    node.depth = view.depth;
    node.leaf = view.leaf;
    node.region = *view.region;
    node.box = frame.bounds;
    if (!node.region.empty()) {
      Box<2> box{node.region[0], node.region[0]};
      for (const Vec<2>& corner : node.region) box = united(box, Box<2>{corner, corner});
      node.box = solid(box);
    }
    if (view.plane) node.plane = solid(*view.plane);
    if (view.sector != kNone) {
      sectors[view.sector] = node.id;
      node.label = fmt::format("{}", view.sector + 1);
      node.region = level.sectors()[view.sector].floor;
      mark_sector(view.sector, node);
    } else if (view.parent == kNone) {
      node.label = "root";
    }
    if (view.handle == lit_node_) node.mark = Mark::lit;
    return true;
  });
  // The way down to a place.
  for (std::size_t i = frame.nodes.size(); shown_ != Answer::none && i-- > first + 1;)
    if (frame.nodes[i].mark == Mark::lit ||
        (!frame.nodes[i].leaf && frame.nodes[i].mark != Mark::quiet))
      frame.nodes[frame.nodes[i].parent].mark = Mark::passed;
  for (const WallPiece& piece : level.pieces()) {
    const NodeHandle node = piece.sector != kNone ? level.sectors()[piece.sector].node : piece.node;
    frame.add<FrameLevel>().walls.push_back({piece.line.a, piece.line.b, piece.wall,
                                             node == kNone ? kNone : node_of[node],
                                             piece.wall == lit_wall_ ? Mark::lit : Mark::quiet});
  }
  return sectors;
}

void LevelStage::picture_sights(const NodeOfSector& nodes, Frame& frame) const {
  if (!seen_) return;
  for (const Portal& p : seen_->portals)
    frame.add<FrameLevel>().portals.push_back({p.line.a, p.line.b, nodes[p.a], nodes[p.b]});
  for (const Sight& s : seen_->sights)
    if (s.from == viewer_ || s.to == viewer_)
      frame.add<FrameLevel>().sights.push_back({s.line.a, s.line.b, nodes[s.from], nodes[s.to]});
}

void LevelStage::picture_matrix(Frame& frame) const {
  if (!level_) return;
  const auto n = static_cast<std::uint32_t>(current_->sectors().size());
  FrameMatrix& matrix = frame.add<FrameMatrix>();
  matrix.rows.assign(n, std::string(n, '.'));
  for (std::uint32_t a = 0; seen_ && a < n; ++a)
    for (std::uint32_t b = 0; b < n; ++b)
      if (a < seen_->done || b < seen_->done) matrix.rows[a][b] = seen_->sees(a, b) ? '1' : '0';
  matrix.lit = shown_ == Answer::sights ? place_->sector : viewer_;
}

// Who is in none of the sectors that are in question.
void LevelStage::dim_bodies(const NodeOfSector& nodes, Frame& frame) const {
  if (!place_ || (shown_ != Answer::place && shown_ != Answer::sights)) return;
  std::set<BodyId> kept;
  for (std::uint32_t s = 0; s < nodes.size(); ++s)
    if (s == place_->sector || (shown_ == Answer::sights && is_seen(s)))
      kept.insert(frame.nodes[nodes[s]].bodies.begin(), frame.nodes[nodes[s]].bodies.end());
  for (FrameBody& body : frame.bodies) body.dimmed = !kept.contains(body.id);
}

void LevelStage::picture_counts(const LevelBsp& level, bool holds_bodies, Frame& frame) const {
  const LevelCounters c = level.counters();
  if (!frame.count("nodes")) {  // of the bodies' tree, if there is one
    std::uint64_t leaves = 0;
    for (const FrameNode& node : frame.nodes) leaves += node.leaf;
    frame.add_count("nodes", c.nodes);
    frame.add_count("leaves", leaves);
    frame.add_count("depth", c.depth);
  }
  if (holds_bodies)
    for (auto& [name, n] : frame.counts)
      if (name == "tests_so_far") n += static_cast<std::int64_t>(side_tests_);
  frame.add_count("walls", c.walls);
  frame.add_count("wall_pieces", c.pieces);
  frame.add_count("sectors", c.sectors);
  frame.add_count("sector_pairs", all_pairs(c.sectors));
  frame.add_count("cuts", c.cuts);
  frame.add_count("lines_tried", c.candidates);
  frame.add_count("side_tests", c.side_tests);
  const LevelNode& root = level.nodes()[0];
  if (!root.is_leaf()) {
    frame.add_count("plane_score", static_cast<std::uint64_t>(root.chosen.score));
    frame.add_count("first_wall_score", static_cast<std::uint64_t>(root.first.score));
  }
}

void LevelStage::count_answers(const NodeOfSector& nodes, bool holds_bodies, Frame& frame) const {
  const auto bodies_in = [&](const auto& wanted) {
    std::set<BodyId> bodies;
    for (std::uint32_t s = 0; holds_bodies && s < nodes.size(); ++s)
      if (wanted(s))
        bodies.insert(frame.nodes[nodes[s]].bodies.begin(), frame.nodes[nodes[s]].bodies.end());
    return bodies.size();
  };
  if (place_) {
    frame.add_count("sector", place_->sector + 1);
    frame.add_count("planes_tested", place_->nodes_visited - 1);
    frame.add_count("bodies_here", bodies_in([&](auto s) { return s == place_->sector; }));
  }
  if (!seen_) return;
  const std::uint64_t n = seen_->sectors;
  frame.add_count("portals", seen_->portals.size());
  frame.add_count("portals_tested", seen_->portals_tested);
  frame.add_count("visible_pairs", seen_->sights.size());
  if (!place_ || !visibility_) return;
  const auto sees = [&](std::uint32_t s) { return seen_->sees(place_->sector, s); };
  std::uint64_t seen = 0;
  for (std::uint32_t s = 0; s < n; ++s) seen += sees(s);
  frame.add_count("sectors_seen", seen);
  frame.add_count("bodies_seen", bodies_in(sees));
}

void LevelStage::picture(bool holds_bodies, Frame& frame) const {
  frame.add<FrameLevel>().eye = eye_;
  if (!current_) return picture_walls(frame);
  const bool holds = holds_bodies && level_;  // not while it is compiled anew
  // A frame has one structure: where bodies have another one, of the level only walls are seen.
  const bool shows = holds || frame.structure == StructureKind::none;
  NodeOfSector nodes;
  if (shows)
    nodes = picture_nodes(*current_, holds, frame);
  else
    picture_walls(frame);
  picture_counts(*current_, holds, frame);
  if (!level_) return;
  if (shows) picture_sights(nodes, frame);
  if (holds) dim_bodies(nodes, frame);
  count_answers(nodes, holds, frame);
}

}  // namespace lantern::run
