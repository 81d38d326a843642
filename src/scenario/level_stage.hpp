// The level of a scenario: its BSP is compiled here, asked, and pictured.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/frame.hpp"
#include "spatial/level_bsp.hpp"

namespace lantern::scenario {

// What the compiler does, while it does it.
struct LevelMoment {
  std::string_view event;  // "consider", "choose", "cut", "sector"
  std::string text;
};

class LevelStage {
 public:
  // The scenario must have a level, and a flat world.
  explicit LevelStage(const Scenario& scenario);

  // `watch` may picture what stands so far. Throws Refused as compile_level does; there
  // is no level then, nor after Stopped.
  void compile(const std::function<void(const LevelMoment&)>& watch);
  // In which sector? Throws Refused before the level is compiled, as `order_from` does.
  void locate(const Vec<2>& point);
  void order_from(const Vec<2>& eye);
  // Forgets the point and the eye.
  void forget_questions();

  // Walls, and once it is compiled, nodes and counts.
  void picture(Frame& frame) const;

 private:
  const LevelBsp& compiled() const;
  std::string told(const LevelBsp& level, const LevelEvent& event);
  void picture_walls(Frame& frame) const;
  void picture_nodes(const LevelBsp& level, Frame& frame) const;
  void picture_counts(const LevelBsp& level, Frame& frame) const;

  const LevelSpec& spec_;
  Box<2> bounds_;
  std::vector<Wall> walls_;
  std::optional<LevelBsp> level_;
  const LevelBsp* current_ = nullptr;  // while it is being compiled, and after
  NodeHandle lit_node_ = kNone;
  std::uint32_t lit_wall_ = kNone;
  std::vector<std::uint32_t> order_;  // of sectors, the nearest first
  std::optional<LevelBsp::Place> place_;
  std::optional<Vec<2>> eye_;
};

}  // namespace lantern::scenario
