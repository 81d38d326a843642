// The verbs that let time pass, rebuild, and ask.
#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"

namespace lantern {
namespace {

using enum KeyType;

KeyDoc every_key() {
  return Key(whole, "every", "World steps from frame to frame.")
      .range(1, kMostEvery)
      .in("steps")
      .or_else("the world's `frame_every`");
}

TableDoc run_verb() {
  return {"run",
          "do = \"run\"",
          "Time passes.",
          {Key(number, "seconds",
               "A whole number of time steps; the frames of all steps are at most 100000, and the "
               "time steps 1000000.")
               .must()
               .above(0, kHundredYears)
               .in("s"),
           every_key()},
          {},
          R"([[step]]
do = "run"
seconds = 0.5
every = 6
caption = "{time} s: pink runs to the right, {pairs:pair} to test."
always = { bodies = 3 }
expect = { position = { pink = [4.5, 2] } }
)"};
}

TableDoc wait_verb() {
  return {"wait",
          "do = \"wait\"",
          "Time passes until something happens. If it has not happened in time, the scenario "
          "fails.",
          {Key(choice, "event", "Two bodies `touch` or `part`; or all of some bodies are `asleep`.")
               .must()
               .one_of({"touch", "part", "asleep"}),
           Key(texts, "bodies", "Two names of bodies; of what falls asleep any number.").must(),
           Key(number, "at_most", "A whole number of time steps.")
               .must()
               .above(0, kHundredYears)
               .in("s"),
           every_key()},
          {},
          R"([[step]]
do = "wait"
event = "touch"
bodies = ["pink", "player"]
at_most = 2
every = 6
caption = "After {time} s they touch: {contacts:contact}."
expect = { contacts_are = [["pink", "player"]] }
)"};
}

TableDoc phases_verb() {
  return {"phases",
          "do = \"phases\"",
          "One world step, phase by phase.",
          {pace_key(), events_key({"broad_phase", "narrow_phase", "solve", "integrate"})},
          {},
          R"([[step]]
do = "phases"
pace = "event"
caption = "Of {pairs:candidate pair}, {contacts} in contact."
)"};
}

TableDoc solve_by_verb() {
  std::vector<std::string_view> methods = contact_method_names();
  std::erase(methods, to_string(ContactMethod::none));
  return {"solve_by",
          "do = \"solve_by\"",
          "From now on, contacts are solved another way; the world must have some.",
          {Key(choice, "contacts", "As [world] has it, but `none`.").must().one_of(methods),
           Key(whole, "sub_steps", "Into which soft contacts divide a world step.")
               .range(1, 64)
               .or_else("as it was"),
           Key(whole, "iterations", "Of the impulses, in a world step.")
               .range(1, 1000)
               .or_else("as it was")},
          {},
          R"([[step]]
do = "solve_by"
contacts = "impulse"
iterations = 20
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

KeyDoc query_events() { return events_key({"visit", "skip", "hit", "miss"}); }

TableDoc ray_verb() {
  return {"ray",
          "do = \"ray\"",
          "Which bodies does a ray meet? The structure leaves out what it cannot meet.",
          {Key(point, "from", "Where it begins.").must().range(-kFar, kFar),
           Key(point, "to", "Where it ends, unless something stops it.").must().range(-kFar, kFar),
           Key(choice, "hits", "It stops at the `nearest` body, or goes through `all`.")
               .one_of({"nearest", "all"})
               .by_default("\"nearest\""),
           pace_key(), query_events()},
          {},
          R"([[step]]
do = "ray"
from = [0, 6]
to = [16, 6]
caption = "{objects_tested:body/bodies} of {bodies} tested, {hits:hit}."
expect = { hits_are = ["red"] }
)"};
}

TableDoc cull_verb() {
  return {"cull",
          "do = \"cull\"",
          "Which bodies can a camera see? Whole nodes outside its view are left out.",
          {Key(point, "eye", "Where the camera is.").must().range(-kFar, kFar),
           Key(point, "target", "Where it looks.").must().range(-kFar, kFar),
           Key(number, "angle", "How wide its view opens; in a solid world from bottom to top.")
               .above(0, 170)
               .in("°")
               .by_default("60"),
           Key(number, "near", "It sees nothing nearer.").above(0, kFar).by_default("0.1"),
           Key(number, "far", "It sees nothing farther.").above(0, kFar).by_default("10"),
           pace_key(), query_events()},
          {},
          R"([[step]]
do = "cull"
eye = [0, 6]
target = [16, 6]
angle = 40
far = 8
expect = { hits_are = ["red"] }
)"};
}

TableDoc query_verb() {
  return {
      "query",
      "do = \"query\"",
      "Which bodies overlap a box, or a disc or ball?",
      {Key(point, "min", "Lowest corner of the box.").range(-kFar, kFar),
       Key(point, "max", "Highest corner of the box.").range(-kFar, kFar),
       Key(point, "center", "Of the disc or ball, instead.").range(-kFar, kFar),
       Key(number, "radius", "Of the disc or ball.").above(0, kFar), pace_key(), query_events()},
      {.groups = {{"min", "max"}, {"center", "radius"}}},
      R"([[step]]
do = "query"
min = [0, 4]
max = [8, 9]
expect = { hits_are = ["red"] }
)"};
}

Key flat_point(std::string_view key, std::string_view meaning) {
  return Key(two_numbers, key, meaning).range(-kFar, kFar).written("[x, y]").must();
}

TableDoc compile_verb() {
  return {"compile",
          "do = \"compile\"",
          "The level's walls become a BSP, whose leaves are the sectors.",
          {pace_key(), events_key({"consider", "choose", "cut", "sector"})},
          {},
          R"([[step]]
do = "compile"
pace = "event"
events = ["choose", "cut"]
caption = "{walls} walls, {sectors} sectors, {cuts:wall} cut in two."
expect = { walls = 8 }
)"};
}

TableDoc locate_verb() {
  return {"locate",
          "do = \"locate\"",
          "In which sector of the compiled level is a point?",
          {flat_point("point", "The point asked for.")},
          {},
          R"([[step]]
do = "locate"
point = [2, 2]
caption = "Sector {sector}, after {planes_tested:line}."
)"};
}

TableDoc order_verb() {
  return {"order",
          "do = \"order\"",
          "The sectors of the compiled level, front to back.",
          {flat_point("eye", "From where they are seen.")},
          {},
          R"([[step]]
do = "order"
eye = [2, 2]
)"};
}

}  // namespace

std::vector<TableDoc> time_verbs() {
  return {run_verb(), wait_verb(), phases_verb(), solve_by_verb()};
}
std::vector<TableDoc> structure_verbs() { return {rebuild_verb()}; }
std::vector<TableDoc> query_verbs() { return {ray_verb(), cull_verb(), query_verb()}; }
std::vector<TableDoc> level_verbs() { return {compile_verb(), locate_verb(), order_verb()}; }

}  // namespace lantern
