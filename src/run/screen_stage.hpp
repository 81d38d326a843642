// The screen of a scenario, which is drawn from textures or from the atlas that holds them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "atlas/atlas.hpp"
#include "frame/frame.hpp"
#include "atlas/binder.hpp"
#include "frame/parts/atlas.hpp"

namespace lantern::run {

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
