#include "run/screen_stage.hpp"

#include <algorithm>
#include <numeric>
#include <variant>

namespace lantern::run {
namespace {

constexpr std::uint32_t kAtlasImage = kNone;  // beside the textures, which count from 0

}  // namespace

ScreenStage::ScreenStage(const Scenario& scenario) {
  screen_.width = scenario.atlas->screen_width;
  screen_.height = scenario.atlas->screen_height;
  screen_.planned =
      static_cast<std::uint32_t>(std::ranges::count_if(scenario.steps, [](const Step& step) {
        return std::holds_alternative<DrawScreen>(step.verb);
      }));
  for (const ElementSpec& spec : scenario.elements) {
    const TextureSpec& texture = scenario.textures[spec.texture];
    const auto image = static_cast<std::uint32_t>(spec.texture);
    elements_.push_back({image, {spec.x, spec.y, texture.width, texture.height}});
    screen_.elements.push_back({image, spec.x, spec.y, texture.width, texture.height});
  }
}

std::vector<std::size_t> ScreenStage::begin(const DrawScreen& way) {
  binder_ = {};
  const bool by_texture = way.order == DrawScreen::Order::by_texture;
  screen_.ways.push_back({way.from == DrawScreen::From::atlas, by_texture, {}, 0});
  for (FrameElement& element : screen_.elements) element.drawn = false;
  if (by_texture) return sorted_by_image(elements_);
  std::vector<std::size_t> order(elements_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

void ScreenStage::light(std::size_t element) {
  for (FrameElement& e : screen_.elements) e.lit = false;
  screen_.elements[element].lit = true;
}

bool ScreenStage::bind(std::size_t element) {
  FrameWay& way = screen_.ways.back();
  const bool binds = binder_.bind(way.from_atlas ? kAtlasImage : elements_[element].image);
  screen_.bound = way.from_atlas ? kNone : *binder_.bound;
  screen_.atlas_bound = way.from_atlas;
  way.bindings = binder_.bindings;
  way.draws.push_back({static_cast<std::uint32_t>(element), binds, false});
  light(element);
  return binds;
}

void ScreenStage::draw(std::size_t element) {
  binder_.draw();
  screen_.ways.back().draws.back().done = true;
  screen_.elements[element].drawn = true;
}

void ScreenStage::end() {
  for (FrameElement& element : screen_.elements) element.lit = false;
  screen_.bound = kNone;
  screen_.atlas_bound = false;
}

void ScreenStage::picture(Frame& frame) const {
  frame.add<FrameScreen>() = screen_;
  if (screen_.ways.empty()) return;
  frame.add_count("bindings", binder_.bindings);
  frame.add_count("draws", binder_.draws);
}

}  // namespace lantern::run
