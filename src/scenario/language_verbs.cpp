// The verbs of the script: the second half of the language's tables.
#include "scenario/language_row.hpp"

namespace lantern {
namespace {

using enum KeyType;

KeyDoc bodies() {
  return Row(texts, "bodies", "Names of bodies, or of patterns for all of theirs.").must();
}

// Only these verbs are watched while they work.
KeyDoc pace() {
  return Row(choice, "pace", "Of this step alone.")
      .one_of({"step", "event"})
      .or_else("the scenario's");
}

KeyDoc events(std::vector<std::string_view> names) {
  return Row(choices_list, "events", "When the pace is `event`, only these give frames.")
      .one_of(std::move(names))
      .or_else("all");
}

TableDoc show_verb() {
  return {"show", "do = \"show\"", "Nothing happens; the caption speaks.", {}, {}, R"([[step]]
do = "show"
caption = "Three bodies, and {pairs:pair} to test."
)"};
}

TableDoc insert_verb() {
  return {"insert",
          "do = \"insert\"",
          "Bodies enter the world and the structure, one after another.",
          {bodies(), pace(),
           events({"test", "miss", "make_child", "store", "split", "hand_down", "depth_limit",
                   "no_progress"})},
          {},
          R"([[step]]
do = "insert"
bodies = ["blue"]
pace = "event"
events = ["split", "store"]
caption = "Blue is the fourth."
expect = { bodies = 4 }
)"};
}

TableDoc remove_verb() {
  return {"remove",   "do = \"remove\"", "Bodies leave the world and the structure.", {bodies()},
          {},
          R"([[step]]
do = "remove"
bodies = ["blue"]
expect = { bodies = 3 }
)"};
}

TableDoc move_verb() {
  return {"move",
          "do = \"move\"",
          "A body is put elsewhere, or goes another way from now on.",
          {
              Row(text, "body", "Its name.").must().range(1, 64),
              Row(point, "to", "Its new position.").range(-kFar, kFar).or_else("where it is"),
              Row(point, "velocity", "Its new velocity.")
                  .range(-kFar, kFar)
                  .in("units/s")
                  .or_else("as it is"),
          },
          {.groups = {{"to"}, {"velocity"}}, .exactly_one = false},
          R"([[step]]
do = "move"
body = "pink"
to = [2, 2]
velocity = [4, 0]
expect = { position = { pink = [2, 2] } }
)"};
}

TableDoc run_verb() {
  return {"run",
          "do = \"run\"",
          "Time passes, one frame each time step.",
          {Row(number, "seconds",
               "A whole number of time steps; the frames of all steps are at most 100000.")
               .must()
               .above(0, kHundredYears)
               .in("s")},
          {},
          R"([[step]]
do = "run"
seconds = 0.5
caption = "{time} s: pink runs to the right, {pairs:pair} to test."
always = { bodies = 3 }
expect = { position = { pink = [4, 2] } }
)"};
}

TableDoc rebuild_verb() {
  TableDoc verb = {"rebuild",
                   "do = \"rebuild\"",
                   "The structure is made anew with the settings given; the others stay.",
                   language_table("structure").keys,
                   {},
                   R"([[step]]
do = "rebuild"
kind = "bsp"
planes = [{ name = "middle", point = [8, 0], normal = [1, 0] }]
expect = { nodes = 3 }

[[step]]
do = "rebuild"
kind = "quadtree"
children = "eager"
expect = { nodes = 5 }
)"};
  for (KeyDoc& key : verb.keys) {
    key.required = false;
    key.fallback = {};
    key.otherwise = "as it was";
  }
  return verb;
}

TableDoc pack_verb() {
  return {
      "pack",
      "do = \"pack\"",
      "Textures enter the atlas, one after another. One that fits nowhere is refused.",
      {Row(texts, "textures", "Names of textures, or of their patterns for all of theirs.").must(),
       Row(truth, "each", "One frame a texture, or one for all.").by_default("true"),
       Row(text, "free_name", "Labels the largest free leaf that the last one leaves.")
           .range(1, 24)
           .or_else("none"),
       pace(), events({"too_small", "used", "cut", "store", "refuse"})},
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
      {Row(size, "size", "The width and height asked for.").must().range(1, kMostPixels).in("px")},
      {},
      R"([[step]]
do = "ask_room"
size = [128, 128]
caption = "Is there room for 128 × 128? {free_leaves:leaf/leaves} free, none of them large enough."
expect = { room = 0 }
)"};
}

std::vector<TableDoc> all_verbs() {
  std::vector<TableDoc> verbs = {show_verb(), insert_verb(),  remove_verb(), move_verb(),
                                 run_verb(),  rebuild_verb(), pack_verb(),   ask_room_verb()};
  const TableDoc& common = language_table("step");
  for (TableDoc& verb : verbs)
    verb.keys.insert(verb.keys.end(), common.keys.begin(), common.keys.end());
  return verbs;
}

}  // namespace

std::span<const TableDoc> language_verbs() {
  static const std::vector<TableDoc> verbs = all_verbs();
  return verbs;
}

}  // namespace lantern
