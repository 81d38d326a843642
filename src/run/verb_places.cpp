// What the verbs of a level and of an atlas do: `compile`, `locate`, `order` and `see`; `pack`,
// `ask_room` and `draw`.
#include <fmt/format.h>

#include "base/error.hpp"
#include "run/event_text.hpp"
#include "run/script_run.hpp"

namespace lantern::run {
namespace {

void show(const LevelMoment& moment, FrameMaker& frames) {
  if (!frames.stopped() && frames.by_event() && frames.wanted(moment.event))
    frames.emit({}, moment.event, moment.text);
}

void witness(const AtlasEvent& event, ScriptRun& run) {
  FrameMaker& frames = run.frames;
  if (frames.stopped()) return;
  using Kind = AtlasEvent::Kind;
  (event.kind == Kind::cut || event.kind == Kind::store ? frames.touched.lit
                                                        : frames.touched.passed)
      .insert(event.node);
  if (!frames.by_event() || !frames.wanted(event_name(event.kind))) return;
  Touched now = frames.touched;
  now.lit = {event.node};
  const FrameTexture& texture = run.stage.atlas->texture(event.texture);
  frames.emit(now, event_name(event.kind),
              event_text(event, run.stage.atlas->label_of(event.node),
                         texture.turned ? texture.name + ", turned" : texture.name, texture.width,
                         texture.height));
}

std::string refusal_text(const TextureSpec& texture) {
  return fmt::format("No leaf has room for {} ({} × {}): it is refused, the rest is kept.",
                     texture.name, texture.width, texture.height);
}

// Leaves choose among all textures of the step: these enter in the order in which they are chosen.
void pack_chosen(const Pack& step, ScriptRun& run) {
  FrameMaker& frames = run.frames;
  AtlasStage& atlas = *run.stage.atlas;
  const bool names = !step.free_name.empty();
  const std::vector<std::uint32_t> before =
      names ? atlas.free_leaves() : std::vector<std::uint32_t>();
  std::size_t done = 0;
  const bool watched = step.each || frames.by_event();
  const auto watch = [&](const AtlasEvent& event) {
    const TextureSpec& texture = run.scenario.textures[event.texture];
    const bool refused = event.kind == AtlasEvent::Kind::refuse;
    frames.texture = texture.name;
    if (refused) frames.note_refused(texture.name);
    if (watched) witness(event, run);
    if (!refused && event.kind != AtlasEvent::Kind::store) return;
    const bool last = ++done == step.textures.size();
    if (last && names) atlas.name_free_leaf(step.free_name, before);
    if ((!last && !step.each) || frames.stopped()) return;
    if (!step.each) frames.touched = {};
    frames.settle("pack", last, refused && step.each ? refusal_text(texture) : "");
    frames.touched = {};
  };
  frames.touched = {};
  atlas.pack_all(step.textures, watch);
}

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

void act(const CompileLevel&, ScriptRun& run) {
  run.stage.level->compile([&](const LevelMoment& moment) { show(moment, run.frames); });
  if (run.stage.engine) {
    const StructureSpec& structure = run.engine().structure();
    if (structure.of_level || structure.kind == StructureKind::none)
      run.engine().rebuild_as(run.stage.level->structure());
  }
  run.frames.settle("compile");
}

void act(const Locate& locate, ScriptRun& run) {
  run.stage.level->locate(locate.point);
  run.frames.settle("locate");
}

void act(const OrderFrom& order, ScriptRun& run) {
  run.stage.level->order_from(order.eye);
  run.frames.settle("order");
}

void act(const See& see, ScriptRun& run) {
  run.stage.level->see(see.eye, [&](const LevelMoment& moment) { show(moment, run.frames); });
  run.frames.settle("see");
}

void act(const Pack& pack, ScriptRun& run) {
  if (run.scenario.atlas->rule == AtlasRule::best_texture) return pack_chosen(pack, run);
  AtlasStage& atlas = *run.stage.atlas;
  FrameMaker& frames = run.frames;
  for (std::size_t i = 0; i < pack.textures.size() && !frames.stopped(); ++i) {
    const TextureSpec& texture = run.scenario.textures[pack.textures[i]];
    if (pack.each) frames.touched = {};
    frames.texture = texture.name;
    const bool last = i + 1 == pack.textures.size();
    const bool names = last && !pack.free_name.empty();
    const std::vector<std::uint32_t> before =
        names ? atlas.free_leaves() : std::vector<std::uint32_t>();
    // Who packs many for one frame looks at none of them.
    AtlasStage::Watch watch;
    if (pack.each || frames.by_event())
      watch = [&](const AtlasEvent& event) { witness(event, run); };
    const bool packed = atlas.pack(pack.textures[i], watch);
    if (!packed) frames.note_refused(texture.name);
    if (names) atlas.name_free_leaf(pack.free_name, before);
    if (!last && !pack.each) continue;
    if (!pack.each) frames.touched = {};
    frames.settle("pack", last, packed ? "" : refusal_text(texture));
  }
}

void act(const AskRoom& ask, ScriptRun& run) {
  run.stage.atlas->ask_room(ask.width, ask.height);
  run.frames.settle("ask_room");
}

void act(const DrawScreen& draw, ScriptRun& run) {
  ScreenStage& screen = *run.stage.screen;
  FrameMaker& frames = run.frames;
  const bool from_atlas = draw.from == DrawScreen::From::atlas;
  std::string bound;
  for (const std::size_t element : screen.begin(draw)) {
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

}  // namespace lantern::run
