// The level of a scenario: its BSP is compiled here, asked, and pictured.
#pragma once

#include "frame/frame.hpp"
#include "language/scenario.hpp"
#include "spatial/level/level_bsp.hpp"

namespace lantern::run {

// What the compiler does, or who looks for what sectors see, while it is done.
struct LevelMoment {
  std::string_view event;  // "consider", "choose", "cut", "sector"; "portals", "row"
  std::string text;
};

class LevelStage {
 public:
  // The scenario must have a level, and a flat world.
  explicit LevelStage(const Scenario& scenario);

  using Watch = std::function<void(const LevelMoment&)>;

  // `watch` may picture what stands so far. Throws Refused as compile_level does; there
  // is no level then, nor after Stopped.
  void compile(const Watch& watch);
  // In which sector? Throws Refused before the level is compiled, as those below do.
  void locate(const Vec<2>& point);
  void order_from(const Vec<2>& eye);
  // Which sectors see which, found once after a compile; and what the sector of an eye sees, which
  // must lie within the level's bounds.
  void see(const std::optional<Vec<2>>& eye, const Watch& watch);
  // Their answers stay counted, but are no longer shown.
  void put_away_answers();

  // The compiled level as the structure that holds bodies.
  StructureSpec structure() const;

  // Walls, and once it is compiled, nodes and counts. `holds_bodies`: the frame's nodes are those
  // of `structure()`.
  void picture(bool holds_bodies, Frame& frame) const;
  // Who sees whom, as far as it is known; nothing before the level is compiled.
  void picture_matrix(Frame& frame) const;

 private:
  enum class Answer { none, place, order, sights };  // what is shown
  using NodeOfSector = std::vector<std::uint32_t>;   // of frame.nodes

  const LevelBsp& compiled() const;
  std::string told(const LevelBsp& level, const LevelEvent& event);
  std::string told(const LevelVisibility& seen) const;
  bool is_seen(std::uint32_t sector) const;
  void picture_walls(Frame& frame) const;
  NodeOfSector picture_nodes(const LevelBsp& level, bool holds_bodies, Frame& frame) const;
  void mark_sector(std::uint32_t sector, FrameNode& node) const;
  void picture_sights(const NodeOfSector& nodes, Frame& frame) const;
  void dim_bodies(const NodeOfSector& nodes, Frame& frame) const;
  void picture_counts(const LevelBsp& level, bool holds_bodies, Frame& frame) const;
  void count_answers(const NodeOfSector& nodes, bool holds_bodies, Frame& frame) const;

  const LevelSpec& spec_;
  Box<2> bounds_;
  std::vector<Wall> walls_;
  std::optional<LevelBsp> level_;
  std::uint64_t side_tests_ = 0;       // of all compiles
  const LevelBsp* current_ = nullptr;  // while it is being compiled, and after
  NodeHandle lit_node_ = kNone;
  std::uint32_t lit_wall_ = kNone;
  std::optional<LevelVisibility> visibility_;
  const LevelVisibility* seen_ = nullptr;  // while it is being found, and after
  std::uint32_t viewer_ = kNone;           // the sector whose view has just been found
  Answer shown_ = Answer::none;
  std::vector<std::uint32_t> order_;  // of sectors, the nearest first
  std::optional<LevelBsp::Place> place_;
  std::optional<Vec<2>> eye_;
};

}  // namespace lantern::run
