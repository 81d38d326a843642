#include "scenario/level_stage.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern::scenario {
namespace {

std::string counted(std::uint64_t n, std::string_view one) {
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

}  // namespace

LevelStage::LevelStage(const Scenario& scenario)
    : spec_(*scenario.level),
      bounds_(flat(scenario.world.bounds)),
      walls_(walls_of_loops(spec_.loops)) {}

void LevelStage::compile(const std::function<void(const LevelMoment&)>& watch) {
  LevelConfig config;
  config.balance_weight = spec_.balance;
  config.cut_weight = spec_.cuts;
  if (spec_.first_wall) config.choose = LevelConfig::Choose::first_wall;
  forget_questions();
  const auto observer = [&](const LevelBsp& level, const LevelEvent& event) {
    using Kind = LevelEvent::Kind;
    if (event.kind == Kind::candidate || event.kind == Kind::divide) return;
    current_ = &level;
    lit_node_ = event.node;
    lit_wall_ = event.kind == Kind::choose || event.kind == Kind::cut ? event.line.wall : kNone;
    constexpr std::string_view kNames[] = {"consider", "", "choose", "cut", "", "sector"};
    watch({kNames[static_cast<int>(event.kind)], told(level, event)});
  };
  level_.reset();
  try {
    LevelBsp made = compile_level(walls_, bounds_, config, observer);
    level_.emplace(std::move(made));
  } catch (...) {
    current_ = nullptr;  // what it has looked at is gone
    throw;
  }
  current_ = &*level_;
  lit_node_ = lit_wall_ = kNone;
}

std::string LevelStage::told(const LevelBsp& level, const LevelEvent& event) {
  using Kind = LevelEvent::Kind;
  const LevelNode& node = level.nodes()[event.node];
  switch (event.kind) {
    case Kind::consider:
      return fmt::format("A region with {}. Does one of them lie behind another?",
                         counted(event.line.front, "wall piece"));
    case Kind::choose:
      return fmt::format(
          "Wall {} has the best line: {} in front, {} behind, {} cut. Score {:.4g}; the first "
          "line that divides them at all would score {:.4g}.",
          event.line.wall + 1, event.line.front, event.line.back, event.line.cuts, event.line.score,
          node.first.score);
    case Kind::cut:
      return fmt::format("The line cuts wall {} in two.", event.line.wall + 1);
    case Kind::sector:
      return fmt::format("No wall lies behind another: the region is convex. It becomes sector {}.",
                         event.sector + 1);
    case Kind::candidate:
    case Kind::divide:
      break;
  }
  return {};
}

const LevelBsp& LevelStage::compiled() const {
  if (!level_) throw Refused("the level is not compiled yet");
  return *level_;
}

void LevelStage::forget_questions() {
  order_.clear();
  place_.reset();
  eye_.reset();
}

void LevelStage::locate(const Vec<2>& point) {
  order_.clear();
  place_ = compiled().locate(point);
  eye_ = point;
}

void LevelStage::order_from(const Vec<2>& eye) {
  locate(eye);  // its sector is the first
  compiled().front_to_back(eye, [&](std::uint32_t sector) {
    order_.push_back(sector);
    return true;
  });
}

void LevelStage::picture_walls(Frame& frame) const {
  for (std::uint32_t i = 0; i < walls_.size(); ++i)
    frame.walls.push_back(
        {walls_[i].line.a, walls_[i].line.b, i, kNone, i == lit_wall_ ? Mark::lit : Mark::quiet});
}

void LevelStage::picture_nodes(const LevelBsp& level, Frame& frame) const {
  const auto first = static_cast<std::uint32_t>(frame.nodes.size());  // after the bodies' tree
  std::vector<std::uint32_t> node_of(level.nodes().size(), kNone);
  level.visit([&](const LevelNodeView& view) {
    node_of[view.handle] = first + view.id;
    FrameNode node;
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
      node.label = fmt::format("{}", view.sector + 1);
      node.region = level.sectors()[view.sector].floor;
      const auto at = std::find(order_.begin(), order_.end(), view.sector);
      if (at != order_.end()) node.order = static_cast<std::uint32_t>(at - order_.begin());
      if (place_ && place_->sector == view.sector) node.mark = Mark::lit;
    } else if (view.parent == kNone) {
      node.label = "root";
    }
    if (view.handle == lit_node_) node.mark = Mark::lit;
    frame.nodes.push_back(std::move(node));
    return true;
  });
  // The way down to a place.
  for (std::size_t i = frame.nodes.size(); place_ && i-- > first + 1;)
    if (frame.nodes[i].mark != Mark::quiet) frame.nodes[frame.nodes[i].parent].mark = Mark::passed;
  for (const WallPiece& piece : level.pieces()) {
    const NodeHandle node = piece.sector != kNone ? level.sectors()[piece.sector].node : piece.node;
    frame.walls.push_back({piece.line.a, piece.line.b, piece.wall,
                           node == kNone ? kNone : node_of[node],
                           piece.wall == lit_wall_ ? Mark::lit : Mark::quiet});
  }
}

void LevelStage::picture_counts(const LevelBsp& level, Frame& frame) const {
  const LevelCounters c = level.counters();
  if (!frame.count("nodes")) {  // of the bodies' tree, if there is one
    std::uint64_t leaves = 0;
    for (const FrameNode& node : frame.nodes) leaves += node.leaf;
    frame.add_count("nodes", c.nodes);
    frame.add_count("leaves", leaves);
    frame.add_count("depth", c.depth);
  }
  frame.add_count("walls", c.walls);
  frame.add_count("wall_pieces", c.pieces);
  frame.add_count("sectors", c.sectors);
  frame.add_count("cuts", c.cuts);
  const LevelNode& root = level.nodes()[0];
  if (!root.is_leaf()) {
    frame.add_count("plane_score", static_cast<std::uint64_t>(root.chosen.score));
    frame.add_count("first_wall_score", static_cast<std::uint64_t>(root.first.score));
  }
  if (!place_) return;
  frame.add_count("sector", place_->sector + 1);
  frame.add_count("planes_tested", place_->nodes_visited - 1);
}

void LevelStage::picture(Frame& frame) const {
  frame.eye = eye_;
  if (!current_) return picture_walls(frame);
  picture_nodes(*current_, frame);
  picture_counts(*current_, frame);
}

}  // namespace lantern::scenario
