// What a step acts on: the engine, the level, the atlas and its screen, each of which is pictured.
#pragma once

#include <functional>
#include <unordered_map>

#include "atlas/atlas.hpp"
#include "base/work.hpp"
#include "frame/frame.hpp"
#include "frame/parts/atlas.hpp"
#include "language/scenario.hpp"
#include "run/engine.hpp"
#include "spatial/level/level_bsp.hpp"

namespace lantern::run {

// What the compiler does, or who looks for what sectors see, while it is done.
struct LevelMoment {
  std::string_view event;  // "consider", "choose", "cut", "sector"; "portals", "row"
  std::string text;
};

// The level of a scenario: its BSP is compiled here, asked, and pictured.
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
  std::string told(const LevelEvent& event) const;
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
  LineChoice lit_line_;  // that is taken, or cuts
  std::optional<LevelVisibility> visibility_;
  const LevelVisibility* seen_ = nullptr;  // while it is being found, and after
  std::uint32_t viewer_ = kNone;           // the sector whose view has just been found
  Answer shown_ = Answer::none;
  std::vector<std::uint32_t> order_;  // of sectors, the nearest first
  std::optional<LevelBsp::Place> place_;
  std::optional<Vec<2>> eye_;
};

// The atlas of a scenario, where textures are packed. Textures are named by their index in the
// scenario.
class AtlasStage {
 public:
  using Watch = std::function<void(const AtlasEvent&)>;

  // The scenario must have an atlas.
  AtlasStage(const Scenario& scenario, Work& work);

  // By the rule of first fit; is it packed?
  bool pack(std::size_t texture, const Watch& watch);
  // All of them, chosen by the leaves.
  void pack_all(const std::vector<std::size_t>& textures, const Watch& watch);
  const FrameTexture& texture(std::size_t index) const { return textures_[index]; }
  std::vector<std::uint32_t> free_leaves() const;  // handles
  // Labels the largest free leaf that was not there `before`.
  void name_free_leaf(const std::string& name, const std::vector<std::uint32_t>& before);
  bool ask_room(int width, int height);

  // The leaf that holds the texture; none if it is not packed.
  std::optional<std::uint32_t> leaf_of(std::size_t texture) const;
  std::string label_of(std::uint32_t node) const;  // its texture, its name, or its size
  void picture(const Touched& touched, Frame& frame) const;

 private:
  FrameNode frame_node(const AtlasNodeView& view, std::vector<FrameTexture>& textures) const;

  void hold(std::size_t texture, bool turned);

  AtlasSpec spec_;
  Atlas atlas_;
  std::vector<FrameTexture> textures_;                         // where they lie, the atlas knows
  std::unordered_map<std::uint32_t, std::string> free_names_;  // of leaves, by handle
  std::optional<bool> room_;
};

// The screen of a scenario, which is drawn from textures or from the atlas that holds them.
// Elements are named by their index in the scenario.
class ScreenStage {
 public:
  // The scenario must have elements.
  explicit ScreenStage(const Scenario& scenario);

  // The screen is empty again and nothing is bound; gives the order in which to draw.
  std::vector<std::size_t> begin(const DrawScreen& way);
  // Binds what the element is drawn from; false if it is bound already.
  bool bind(std::size_t element);
  void draw(std::size_t element);
  // All is drawn; the frames to come are about no element.
  void end();

  std::size_t texture_of(std::size_t element) const { return elements_[element].image; }
  std::uint64_t bindings() const { return binder_.bindings; }
  void picture(Frame& frame) const;

 private:
  void light(std::size_t element);

  std::vector<ScreenElement> elements_;
  Binder binder_;
  FrameScreen screen_;
};

// The pieces that a scenario needs, and none that it does not.
struct Stage {
  Stage(const Scenario& scenario, Work& work) {
    if (!scenario.bodies.empty()) engine = make_engine(scenario, work);
    if (scenario.atlas) atlas.emplace(scenario, work);
    if (!scenario.elements.empty()) screen.emplace(scenario);
    if (scenario.level) level.emplace(scenario);
  }

  std::unique_ptr<Engine> engine;  // if there are bodies
  std::optional<AtlasStage> atlas;
  std::optional<ScreenStage> screen;
  std::optional<LevelStage> level;
  double time = 0;  // seconds of world time
};

}  // namespace lantern::run
