#include "run/level_stage.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"

namespace lantern::run {
namespace {

std::string counted(std::uint64_t n, std::string_view one) {
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

}  // namespace

LevelStage::LevelStage(const Scenario& scenario)
    : spec_(*scenario.level),
      bounds_(flat(scenario.world.bounds)),
      walls_(walls_of_loops(spec_.loops)) {}

void LevelStage::compile(const Watch& watch) {
  LevelConfig config;
  config.balance_weight = spec_.balance;
  config.cut_weight = spec_.cuts;
  if (spec_.first_wall) config.choose = LevelConfig::Choose::first_wall;
  place_.reset();
  put_away_answers();
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
  visibility_.reset();
  seen_ = nullptr;
  try {
    LevelBsp made = compile_level(walls_, bounds_, config, observer);
    level_.emplace(std::move(made));
  } catch (...) {
    current_ = nullptr;  // what it has looked at is gone
    throw;
  }
  current_ = &*level_;
  side_tests_ += level_->counters().side_tests;
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

void LevelStage::put_away_answers() {
  shown_ = Answer::none;
  order_.clear();
  eye_.reset();
}

void LevelStage::locate(const Vec<2>& point) {
  put_away_answers();
  place_ = compiled().locate(point);
  eye_ = point;
  shown_ = Answer::place;
}

void LevelStage::order_from(const Vec<2>& eye) {
  locate(eye);  // its sector is the first
  shown_ = Answer::order;
  compiled().front_to_back(eye, [&](std::uint32_t sector) {
    order_.push_back(sector);
    return true;
  });
}

void LevelStage::see(const std::optional<Vec<2>>& eye, const Watch& watch) {
  const LevelBsp& level = compiled();
  put_away_answers();
  if (!visibility_) {
    const auto observer = [&](const LevelVisibility& so_far) {
      seen_ = &so_far;
      viewer_ = so_far.done == 0 ? kNone : so_far.done - 1;
      watch({viewer_ == kNone ? "portals" : "row", told(so_far)});
    };
    try {
      visibility_.emplace(find_visibility(level, {}, observer));
    } catch (...) {
      seen_ = nullptr;
      throw;
    }
    seen_ = &*visibility_;
    viewer_ = kNone;
  }
  if (!eye) return;
  locate(*eye);
  if (!place_)
    throw Refused(fmt::format("the eye [{}, {}] lies outside of the world", eye->x, eye->y));
  shown_ = Answer::sights;
}

std::string LevelStage::told(const LevelVisibility& seen) const {
  if (viewer_ == kNone)
    return fmt::format("{} between the sectors: what is no wall can be looked through.",
                       counted(seen.portals.size(), "portal"));
  std::uint32_t others = 0;
  for (std::uint32_t s = 0; s < seen.sectors; ++s) others += s != viewer_ && seen.sees(viewer_, s);
  return fmt::format(
      "Sector {} looks through one portal after another, as long as one straight line passes all. "
      "It sees {} of {}.",
      viewer_ + 1, others, counted(seen.sectors - 1, "other"));
}

StructureSpec LevelStage::structure() const {
  StructureSpec spec;
  spec.kind = StructureKind::bsp;
  spec.of_level = true;
  std::vector<std::string> ways;  // from the root, by id
  compiled().visit([&](const LevelNodeView& view) {
    std::string way;
    if (view.parent != kNone)
      way = ways[view.parent] + (ways[view.parent].empty() ? "" : ".") +
            (view.slot == 1 ? "front" : "back");
    if (view.plane)
      spec.planes.push_back({"",
                             solid(view.plane->normal * view.plane->offset),
                             solid(view.plane->normal),
                             way.empty() ? "root" : way,
                             {}});
    spec.sectors.push_back(view.sector);
    ways.push_back(std::move(way));
    return true;
  });
  return spec;
}

}  // namespace lantern::run
