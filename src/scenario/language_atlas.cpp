// Tables of the atlas, and its verbs.
#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"

namespace lantern {

using enum KeyType;

TableDoc atlas_table() {
  return {"atlas",
          "[atlas]",
          "One large image that textures are packed into, by a kD-tree. Its origin is the upper "
          "left corner.",
          {Key(size, "size", "Its width and height; it is also written as an image.")
               .must()
               .range(1, kMostAtlas)
               .in("px")}};
}

TableDoc texture_table() {
  return {
      "texture",
      "[[texture]]",
      "A texture. It enters the atlas when a step packs it.",
      {
          Key(text, "name", "Unique over textures and their patterns.").must().like(kNamePattern),
          Key(size, "size", "Its width and height.").must().range(1, kMostPixels).in("px"),
          Key(whole, "color", "As a body's.").range(1, 8).by_default("1"),
      }};
}

TableDoc texture_pattern_table() {
  return {
      "texture_pattern",
      "[[texture_pattern]]",
      "Many textures at once, of random sizes. Those of pattern `t` are called `t1`, `t2`, …",
      {
          Key(text, "name", "Unique over textures and their patterns.").must().like(kNamePattern),
          Key(whole, "count", "How many; 20000 textures in all are allowed.")
              .must()
              .range(1, kMostTextures)
              .in("textures"),
          Key(size, "min", "The least width and height.").must().range(1, kMostPixels).in("px"),
          Key(size, "max", "The largest width and height.").must().range(1, kMostPixels).in("px"),
          Key(whole, "multiple", "Widths and heights are multiples of it.")
              .range(1, kMostPixels)
              .in("px")
              .by_default("1"),
          Key(choice, "order", "In which they are named and packed.")
              .one_of({"as_made", "tallest_first"})
              .by_default("\"as_made\""),
          Key(whole, "color", "As a body's; 0 cycles through 1 to 8.").range(0, 8).by_default("0"),
          Key(whole, "seed", "Of this pattern alone.")
              .range(0, kMostWhole)
              .or_else("from the scenario's seed and the name"),
      }};
}

namespace {

TableDoc pack_verb() {
  return {
      "pack",
      "do = \"pack\"",
      "Textures enter the atlas, one after another. One that fits nowhere is refused.",
      {Key(texts, "textures", "Names of textures, or of their patterns for all of theirs.").must(),
       Key(truth, "each", "One frame a texture, or one for all.").by_default("true"),
       Key(text, "free_name", "Labels the largest free leaf that the last one leaves.")
           .range(1, 24)
           .or_else("none"),
       pace_key(), events_key({"too_small", "used", "cut", "store", "refuse"})},
      {},
      R"([[step]]
do = "pack"
textures = ["A", "tile"]
each = true
free_name = "F"
caption = "{texture} has its place: {textures:texture}, {free_area} px free."
expect = { textures = 4, refused = 0 }
)"};
}

TableDoc ask_room_verb() {
  return {
      "ask_room",
      "do = \"ask_room\"",
      "The kD-tree's own question: has any free leaf room for this size?",
      {Key(size, "size", "The width and height asked for.").must().range(1, kMostPixels).in("px")},
      {},
      R"([[step]]
do = "ask_room"
size = [128, 128]
caption = "Is there room for 128 × 128? {free_leaves:leaf/leaves} free, none of them large enough."
expect = { room = 0 }
)"};
}

}  // namespace

std::vector<TableDoc> atlas_verbs() { return {pack_verb(), ask_room_verb()}; }
}  // namespace lantern
