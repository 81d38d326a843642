// The verbs of the script: those that change who is where, and the list of all.
#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"

namespace lantern {
namespace {

using enum KeyType;

KeyDoc bodies_key() {
  return Key(texts, "bodies", "Names of bodies, or of patterns for all of theirs.").must();
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
          {bodies_key(), pace_key(),
           events_key({"test", "miss", "make_child", "store", "split", "hand_down", "depth_limit",
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
  return {"remove",   "do = \"remove\"", "Bodies leave the world and the structure.", {bodies_key()},
          {},
          R"([[step]]
do = "remove"
bodies = ["blue"]
expect = { bodies = 3 }
)"};
}

TableDoc move_verb() {
  return {
      "move",
      "do = \"move\"",
      "A body is put elsewhere, turned, or goes another way from now on.",
      {
          Key(text, "body", "Its name.").must().range(1, 64),
          Key(point, "to", "Its new position.").range(-kFar, kFar).or_else("where it is"),
          Key(point, "velocity", "Its new velocity.")
              .range(-kFar, kFar)
              .in("units/s")
              .or_else("as it is"),
          Key(number, "turned", "How far it is turned from now on.")
              .range(-kMostTurn, kMostTurn)
              .in("°")
              .or_else("as it is"),
          Key(number, "spin", "How fast it turns from now on.")
              .range(-kMostTurn, kMostTurn)
              .in("°/s")
              .or_else("as it does"),
          Key(truth, "rebuild", "The structure is rebuilt, or left as it was.").by_default("true"),
      },
      {.groups = {{"to"}, {"velocity"}, {"turned"}, {"spin"}}, .exactly_one = false},
      R"([[step]]
do = "move"
body = "pink"
to = [2, 2]
velocity = [4, 0]
expect = { position = { pink = [2, 2] } }
)"};
}

TableDoc sleep_verb() {
  return {"sleep",
          "do = \"sleep\"",
          "Bodies fall asleep: nothing moves them until something "
          "wakes them.",
          {bodies_key()},
          {},
          R"([[step]]
do = "sleep"
bodies = ["red"]
expect = { asleep = ["red"] }
)"};
}

TableDoc wake_verb() {
  return {"wake",     "do = \"wake\"", "Bodies wake up.", {bodies_key()}, {},
          R"([[step]]
do = "wake"
bodies = ["red"]
expect = { awake = ["red"] }
)"};
}

TableDoc force_verb() {
  return {"force",
          "do = \"force\"",
          "A force acts on a body from now on, until another takes its place; one of zero ends "
          "it.",
          {
              Key(text, "body", "Its name.").must().range(1, 64),
              Key(point, "force", "In the world's axes.").must().range(-kFar, kFar).in("N"),
              Key(point, "at", "Where, from the body's centre, in the world's axes.")
                  .range(-kFar, kFar)
                  .or_else("the centre"),
          },
          {},
          R"([[step]]
do = "force"
body = "player"
force = [-4, 0]
)"};
}

TableDoc impulse_verb() {
  return {"impulse",
          "do = \"impulse\"",
          "A body is struck once.",
          {
              Key(text, "body", "Its name.").must().range(1, 64),
              Key(point, "impulse", "In the world's axes.").must().range(-kFar, kFar).in("N s"),
              Key(point, "at", "Where, from the body's centre, in the world's axes.")
                  .range(-kFar, kFar)
                  .or_else("the centre"),
          },
          {},
          R"([[step]]
do = "impulse"
body = "pink"
impulse = [2.56, 0]
)"};
}

std::vector<TableDoc> all_verbs() {
  std::vector<TableDoc> verbs;
  for (const auto& part :
       {body_verbs(), time_verbs(), structure_verbs(), query_verbs(), level_verbs(), atlas_verbs()})
    verbs.insert(verbs.end(), part.begin(), part.end());
  const TableDoc& common = language_table("step");
  for (TableDoc& verb : verbs)
    verb.keys.insert(verb.keys.end(), common.keys.begin(), common.keys.end());
  return verbs;
}

}  // namespace

KeyDoc pace_key() {
  return Key(choice, "pace", "Of this step alone.")
      .one_of({"step", "event"})
      .or_else("the scenario's");
}

KeyDoc events_key(std::vector<std::string_view> names) {
  return Key(choices_list, "events", "When the pace is `event`, only these give frames.")
      .one_of(std::move(names))
      .or_else("all");
}

std::vector<TableDoc> body_verbs() {
  return {show_verb(),  insert_verb(), remove_verb(), move_verb(),
          sleep_verb(), wake_verb(),   force_verb(),  impulse_verb()};
}

std::span<const TableDoc> language_verbs() {
  static const std::vector<TableDoc> verbs = all_verbs();
  return verbs;
}

}  // namespace lantern
