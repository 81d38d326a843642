// The atlas of a scenario, where textures are packed, and its screen: both are pictured.
#pragma once

#include <functional>
#include <unordered_map>

#include "atlas/atlas.hpp"
#include "base/work.hpp"
#include "frame/parts/atlas.hpp"
#include "language/scenario.hpp"

namespace lantern::run {

// Textures are named by their index in the scenario.
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

}  // namespace lantern::run
