// `draw`: the screen of an atlas.
#include <fmt/format.h>

#include "base/error.hpp"
#include "scenario/event_text.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

constexpr const char* kBindEvent = "bind";
constexpr const char* kDrawEvent = "draw";

// In event pace: one frame about this element, and, in an atlas, about the leaf it comes from.
void tell_draw(const char* event, std::size_t texture, bool from_atlas, const std::string& text,
               ScriptRun& run) {
  if (!run.frames.by_event() || !run.frames.wanted(event)) return;
  Touched now;
  if (from_atlas) now.lit.insert(run.stage.atlas->leaf_of(texture).value());
  run.frames.emit(now, event, text);
}

}  // namespace

TableDoc DrawScreen::table() {
  using namespace keys;
  return {.doc =
              "Draws all elements of the [atlas]'s `screen`, and counts how often another image "
              "must be bound. Each `draw` begins with an empty screen and nothing bound.",
          .keys = {key(&DrawScreen::from, "from",
                       "Each element from its own texture, or all from the atlas that holds them."),
                   key(&DrawScreen::order, "order",
                       "`as_listed`, or `by_texture`: sorted so that equal textures follow each "
                       "other, but what lies over another element still comes after it."),
                   pace_key(), events_key({kBindEvent, kDrawEvent})},
          .example = R"([[step]]
do = "draw"
order = "by_texture"
caption = "{draws:element} of two textures: {bindings:binding}."
expect = { draws = 3, bindings = 2 }
)"};
}

void DrawScreen::read(const TableReader& table, ScriptReading& script) {
  const ScenarioSpec& s = script.draft.scenario;
  if (s.elements.empty())
    return table.bad_value("do", "there is no [[element]] to draw",
                           "add [[element]] with texture = \"…\" and at = [0, 0]");
  if (++script.state.ways > kMostWays)
    table.bad_value("do", fmt::format("more than {} steps draw the screen", kMostWays));
  if (from != From::atlas) return;
  for (const ElementSpec& element : s.elements)
    if (!script.state.packed[element.texture])
      return table.bad_value(
          "from",
          fmt::format("the texture '{}' is not in the atlas yet", s.textures[element.texture].name),
          "pack it in a step before");
}

void DrawScreen::act(ScriptRun& run) const {
  ScreenStage& screen = *run.stage.screen;
  FrameMaker& frames = run.frames;
  const bool from_atlas = from == From::atlas;
  std::string bound;
  for (const std::size_t element : screen.begin(*this)) {
    if (frames.stopped()) return;
    const std::size_t texture = screen.texture_of(element);
    frames.texture = run.scenario.textures[texture].name;
    if (from_atlas && !run.stage.atlas->leaf_of(texture))
      throw Refused(
          fmt::format("the atlas has refused '{}', which its screen shows", frames.texture));
    const std::string image = from_atlas ? "the atlas" : frames.texture;
    if (screen.bind(element))
      tell_draw(kBindEvent, texture, from_atlas, bind_text(image, bound, screen.bindings()), run);
    bound = image;
    screen.draw(element);
    tell_draw(kDrawEvent, texture, from_atlas, draw_text(frames.texture, from_atlas), run);
  }
  screen.end();
  frames.settle(kDrawEvent);
}

}  // namespace lantern::scenario
