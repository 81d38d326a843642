// `pack` and `ask_room`: the atlas.
#include <fmt/format.h>

#include "scenario/event_text.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

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

}  // namespace

TableDoc Pack::table() {
  using namespace keys;
  return {.doc = "Textures enter the atlas, one after another. One that fits nowhere is refused.",
          .keys = {key(KeyType::texts, "textures",
                       "Names of textures, or of their patterns for all of theirs.", must()),
                   key(&Pack::each, "each", "One frame a texture, or one for all."),
                   key(&Pack::free_name, "free_name",
                       "Labels the largest free leaf that the last one leaves.", range(1, 24),
                       or_else("none")),
                   pace_key(), events_key({"too_small", "used", "cut", "store", "refuse"})},
          .example = R"([[step]]
do = "pack"
textures = ["A", "tile"]
each = true
free_name = "F"
caption = "{texture} has its place: {textures:texture}, {free_area} px free."
expect = { textures = 4, refused = 0 }
)"};
}

void Pack::read(const TableReader& table, ScriptReading& script) {
  textures =
      script.textures.take(table.names("textures"), script.state.packed, true, "is packed already");
  if (each && !textures.empty()) script.frames = textures.size();
}

void Pack::act(ScriptRun& run) const {
  if (run.scenario.atlas->rule == AtlasRule::best_texture) return pack_chosen(*this, run);
  AtlasStage& atlas = *run.stage.atlas;
  FrameMaker& frames = run.frames;
  for (std::size_t i = 0; i < textures.size() && !frames.stopped(); ++i) {
    const TextureSpec& texture = run.scenario.textures[textures[i]];
    if (each) frames.touched = {};
    frames.texture = texture.name;
    const bool last = i + 1 == textures.size();
    const bool names = last && !free_name.empty();
    const std::vector<std::uint32_t> before =
        names ? atlas.free_leaves() : std::vector<std::uint32_t>();
    // Who packs many for one frame looks at none of them.
    AtlasStage::Watch watch;
    if (each || frames.by_event()) watch = [&](const AtlasEvent& event) { witness(event, run); };
    const bool packed = atlas.pack(textures[i], watch);
    if (!packed) frames.note_refused(texture.name);
    if (names) atlas.name_free_leaf(free_name, before);
    if (!last && !each) continue;
    if (!each) frames.touched = {};
    frames.settle("pack", last, packed ? "" : refusal_text(texture));
  }
}

TableDoc AskRoom::table() {
  using namespace keys;
  return {.doc = "The kD-tree's own question: has any free leaf room for this size?",
          .keys = {key(KeyType::size, "size", "The width and height asked for.", must(),
                       range(1, kMostPixels), in("px"))},
          .example = R"([[step]]
do = "ask_room"
size = [128, 128]
caption = "Is there room for 128 × 128? {free_leaves:leaf/leaves} free, none of them large enough."
expect = { room = 0 }
)"};
}

void AskRoom::read(const TableReader& table, ScriptReading& script) {
  const auto size = table.get<Vec<2>>("size").value_or(Vec<2>(1.0));
  width = static_cast<int>(size.x);
  height = static_cast<int>(size.y);
  script.state.asked_for_room = true;
}

void AskRoom::act(ScriptRun& run) const {
  run.stage.atlas->ask_room(width, height);
  run.frames.settle("ask_room");
}

}  // namespace lantern::scenario
