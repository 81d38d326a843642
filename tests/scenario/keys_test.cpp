// Every key of the language: what it takes, what it refuses, and where that is said.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "language/counts.hpp"
#include "language/language.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;  // key, value

// A small good scenario around one table; `lines` are that table's keys.
struct Surroundings {
  std::string before;
  Lines lines;
  std::string after;
};

const std::string kWorld = "[world]\nsize = [64, 64]\n";
const std::string kRed = "[[body]]\nname = \"red\"\nradius = 1\nposition = [1, 1]\n";
const std::string kDot = "[[prototype]]\nname = \"dot\"\nfriction = 0\n";
const std::string kInsert = "[[step]]\ndo = \"insert\"\nbodies = [\"red\"]\n";
const std::string kScreen =
    "[atlas]\nsize = [64, 64]\nscreen = [16, 16]\n[[texture]]\nname = \"A\"\nsize = [8, 8]\n";
const std::string kElement = "[[element]]\ntexture = \"A\"\nat = [0, 0]\n";
const std::string kAtlas = "[atlas]\nsize = [64, 64]\n[[texture]]\nname = \"A\"\nsize = [8, 8]\n";
const std::string kRules = "[world]\nsize = [64, 64]\ncontacts = \"impulse\"\nmay_sleep = true\n";
const std::string kLevel = "[level]\nloops = [[[0, 0], [8, 0], [8, 6]]]\n";
const std::string kCompile = "[[step]]\ndo = \"compile\"\n";
// Two bodies of which all is counted that the narrow phase tells.
const std::string kMeasured =
    "[[body]]\nname = \"one\"\nradius = 1\nposition = [30, 30]\n"
    "[[body]]\nname = \"two\"\nradius = 1\nposition = [40, 30]\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"one\", \"two\"]\n"
    "[[step]]\ndo = \"separate\"\npair = [\"one\", \"two\"]\n"
    "[[step]]\ndo = \"gjk\"\npair = [\"one\", \"two\"]\n[[step]]\ndo = \"test_shapes\"\n";
const std::string kPlot = "plot = \"a\"\n";
const std::string kTitle = "title = \"x\"\n";

std::map<std::string, Surroundings> make_surroundings() {
  const std::string world = kTitle + kWorld;
  const std::string scene = world + kTree + kRed;
  const std::string pink = "[[body]]\nname = \"pink\"\nradius = 1\nposition = [9, 1]\n";
  const std::string touching = kTitle + kRules + kTree + kRed + pink +
                               "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"pink\"]\n";
  const std::string level = world + kLevel;
  const std::string step = "[[step]]\n";
  return {
      {"", {"", {{"title", "\"x\""}}, kWorld + kTree + kRed + kShow}},
      {"world", {kTitle + "[world]\n", {{"size", "[64, 64]"}}, kRed + kShow}},
      {"structure",
       {world + "[structure]\n",
        {{"kind", "\"quadtree\""}},
        kRed + kShow + "[[step]]\ndo = \"rebuild\"\nkind = \"grid\"\n"}},
      {"structure.planes",
       {world + "[structure]\nkind = \"bsp\"\n[[structure.planes]]\n",
        {{"point", "[32, 0]"}, {"normal", "[1, 0]"}},
        kRed + kShow}},
      {"prototype",
       {world + "[[prototype]]\n",
        {{"name", "\"wall\""}, {"radius", "1"}},
        "[[prototype]]\nname = \"dot\"\nradius = 1\n" + kRed + kShow}},
      {"map",
       {world + "[[prototype]]\nname = \"wall\"\nradius = 1\n[map]\n",
        {{"rows", "\"#.\""}, {"legend", "{ \"#\" = \"wall\" }"}},
        kShow}},
      {"body",
       {world + kDot + "[[body]]\n",
        {{"name", "\"pink\""}, {"radius", "1"}, {"position", "[1, 1]"}},
        kShow}},
      {"pattern",
       {world + kDot + "[[pattern]]\n",
        {{"name", "\"dot\""}, {"count", "5"}, {"radius", "1"}},
        kShow}},
      {"atlas", {kTitle + "[atlas]\n", {{"size", "[64, 64]"}}, kShow}},
      {"texture",
       {kTitle + kAtlas + "[[texture]]\n", {{"name", "\"B\""}, {"size", "[8, 8]"}}, kShow}},
      {"texture_pattern",
       {kTitle + kAtlas + "[[texture_pattern]]\n",
        {{"name", "\"t\""}, {"count", "5"}, {"min", "[8, 8]"}, {"max", "[16, 16]"}},
        kShow}},
      {"element",
       {kTitle + kScreen + "[[element]]\n", {{"texture", "\"A\""}, {"at", "[0, 0]"}}, kShow}},
      {"spring",
       {scene + "[[spring]]\n", {{"a", "\"red\""}, {"to", "[1, 9]"}, {"stiffness", "10"}}, kShow}},
      {"joint",
       {scene + "[[joint]]\n",
        {{"a", "\"red\""}, {"to", "[1, 9]"}, {"kind", "\"distance\""}},
        kShow}},
      {"level", {world + "[level]\n", {{"loops", "[[[0, 0], [8, 0], [8, 6]]]"}}, kShow}},
      {"side", {scene + "[[side]]\nname = \"a\"\n[[side]]\n", {{"name", "\"b\""}}, kShow}},
      {"chart", {scene + "[chart]\n", {{"x", "\"bodies\""}, {"y", "[\"pairs\"]"}}, kShow + kPlot}},
      {"problem",
       {world + "[problem]\n",
        {{"solution", "\"projectile\""}, {"seconds", "1"}, {"step", "0.1"}},
        kRed + kShow}},
      {"show", {scene + step, {{"do", "\"show\""}}, ""}},
      {"insert", {scene + step, {{"do", "\"insert\""}, {"bodies", "[\"red\"]"}}, ""}},
      {"emit", {scene + step, {{"do", "\"emit\""}, {"bodies", "[\"red\"]"}, {"every", "1"}}, ""}},
      {"remove", {scene + kInsert + step, {{"do", "\"remove\""}, {"bodies", "[\"red\"]"}}, ""}},
      {"move",
       {scene + kInsert + step, {{"do", "\"move\""}, {"body", "\"red\""}, {"to", "[2, 2]"}}, ""}},
      {"run", {scene + step, {{"do", "\"run\""}, {"seconds", "1"}}, ""}},
      {"wait",
       {touching + step,
        {{"do", "\"wait\""},
         {"event", "\"touch\""},
         {"bodies", "[\"red\", \"pink\"]"},
         {"at_most", "1"}},
        ""}},
      {"compare",
       {scene + step,
        {{"do", "\"compare\""},
         {"bodies", "[\"red\"]"},
         {"row", "\"a\""},
         {"times", "{ grid = 9 }"},
         {"machine", "\"a desk\""}},
        ""}},
      {"phases", {scene + step, {{"do", "\"phases\""}}, ""}},
      {"solve_by", {touching + step, {{"do", "\"solve_by\""}, {"contacts", "\"soft\""}}, ""}},
      {"force",
       {scene + kInsert + step,
        {{"do", "\"force\""}, {"body", "\"red\""}, {"force", "[1, 0]"}},
        ""}},
      {"impulse",
       {scene + kInsert + step,
        {{"do", "\"impulse\""}, {"body", "\"red\""}, {"impulse", "[1, 0]"}},
        ""}},
      {"sleep", {touching + step, {{"do", "\"sleep\""}, {"bodies", "[\"red\"]"}}, ""}},
      {"wake", {touching + step, {{"do", "\"wake\""}, {"bodies", "[\"red\"]"}}, ""}},
      {"ray", {scene + step, {{"do", "\"ray\""}, {"from", "[-0.5, 0]"}, {"to", "[64, 0]"}}, ""}},
      {"cull",
       {scene + step, {{"do", "\"cull\""}, {"eye", "[-0.5, 0]"}, {"target", "[64, 0]"}}, ""}},
      {"query", {scene + step, {{"do", "\"query\""}, {"center", "[0, 0]"}, {"radius", "2"}}, ""}},
      {"test_shapes", {scene + kInsert + step, {{"do", "\"test_shapes\""}}, ""}},
      {"separate",
       {touching + step, {{"do", "\"separate\""}, {"pair", "[\"red\", \"pink\"]"}}, ""}},
      {"gjk", {touching + step, {{"do", "\"gjk\""}, {"pair", "[\"red\", \"pink\"]"}}, ""}},
      {"compile", {level + step, {{"do", "\"compile\""}}, ""}},
      {"locate", {level + kCompile + step, {{"do", "\"locate\""}, {"point", "[2, 2]"}}, ""}},
      {"order", {level + kCompile + step, {{"do", "\"order\""}, {"eye", "[2, 2]"}}, ""}},
      {"see", {level + kCompile + step, {{"do", "\"see\""}, {"eye", "[2, 2]"}}, ""}},
      {"rebuild",
       {scene + step,
        {{"do", "\"rebuild\""},
         {"kind", "\"bsp\""},
         {"planes", "[{ point = [32, 0], normal = [1, 0] }]"}},
        ""}},
      {"sweep",
       {kTitle + kRules + "[structure]\nkind = \"sort_and_sweep\"\n" + kRed + kInsert + step,
        {{"do", "\"sweep\""}},
        ""}},
      {"pack", {kTitle + kAtlas + step, {{"do", "\"pack\""}, {"textures", "[\"A\"]"}}, ""}},
      {"ask_room", {kTitle + kAtlas + step, {{"do", "\"ask_room\""}, {"size", "[8, 8]"}}, ""}},
      {"draw",
       {kTitle + kScreen + kElement + step + "do = \"pack\"\ntextures = [\"A\"]\n" + step,
        {{"do", "\"draw\""}},
        ""}},
      {"display", {kTitle + kRules + "[display]\n", {}, kTree + kRed + kShow}},
      {"view", {scene + kShow + "[step.view]\n", {{"at", "[32, 32]"}, {"width", "16"}}, ""}},
      {"camera",
       {kTitle + "[world]\nsize = [8, 8, 8]\n" + kShow + "[step.camera]\n",
        {{"eye", "[9, 9, 9]"}, {"target", "[1, 1, 1]"}},
        ""}},
      {"step.note",
       {touching + "[[step.note]]\n", {{"text", "\"here\""}, {"body", "\"red\""}}, ""}},
      {"step.ruler",
       {scene + kInsert + kShow + "[[step.ruler]]\n", {{"a", "\"red\""}, {"to", "[2, 2]"}}, ""}},
      {"code",
       {kTitle + "panels = [\"code\"]\n" + kWorld + kTree + kRed + kShow + "[step.code]\n",
        {{"function", "\"Insert\""}},
        ""}},
      // All that can be counted is counted here.
      {"expect",
       {kTitle + "panels = [\"islands\"]\n" + kRules + kLevel +
            "[structure]\nkind = \"quadtree\"\nsplit_static = true\n" + kRed + kMeasured +
            kCompile + "[[step]]\ndo = \"see\"\neye = [1, 1]\n" +
            "[[step]]\ndo = \"run\"\nseconds = 1\n" +
            "[[step]]\ndo = \"ray\"\nfrom = [0, 0]\nto = [1, 1]\n" + kInsert +
            "[[step]]\ndo = \"compare\"\nbodies = [\"red\"]\nrow = \"a\"\n" + "[step.expect]\n",
        {},
        ""}},
  };
}

// The scenario with `key = value`, and without the keys of `without`. The value is marked with @
// for each of `marks`, counted from its first letter.
const std::map<std::string, Surroundings>& surroundings() {
  static const std::map<std::string, Surroundings> all = make_surroundings();
  return all;
}

std::string with(const std::string& table, const std::string& key, const std::string& value,
                 const std::vector<std::string>& without = {}) {
  const Surroundings& s = surroundings().at(table);
  std::string text = s.before;
  bool done = false;
  for (const auto& [k, v] : s.lines) {
    if (std::find(without.begin(), without.end(), k) != without.end()) continue;
    text += k + " = " + (k == key ? value : v) + "\n";
    done = done || k == key;
  }
  if (!done) text += key + " = " + value + "\n";
  return text + s.after;
}

std::string without_key(const std::string& table, const std::string& key) {
  const Surroundings& s = surroundings().at(table);
  std::string text = s.before;
  for (const auto& [k, v] : s.lines)
    if (k != key) text += k + " = " + v + "\n";
  return text + s.after;
}

struct KeyCase {
  std::string table;
  std::string key;
  std::vector<std::string> good;
  std::vector<std::pair<std::string, std::string>> bad;  // the value with its @, what is said
  std::vector<std::string> without = {};
};

using Bad = std::vector<std::pair<std::string, std::string>>;

Bad bad_text(const std::string& letters, std::size_t most) {
  Bad bad = {{"@1", "must be a text"},
             {"@[\"a\"]", "not a list"},
             {"@\"\\n\"", "one line"},
             {"@\"" + std::string(most + 1, 'x') + "\"", letters}};
  return bad;
}

Bad bad_name() {
  return {{"@1", "must be a text"}, {"@\"\"", "cannot be"},
          {"@\"1a\"", "cannot be"}, {"@\"a/b\"", "\"a_b\""},
          {"@\"é\"", "cannot be"},  {"@\"" + std::string(25, 'a') + "\"", "cannot be"},
          {"@[]", "must be a text"}};
}

Bad bad_whole(const std::string& below, const std::string& above, const std::string& range) {
  return {{"@" + below, range},
          {"@" + above, range},
          {"@1.5", "must be a whole number"},
          {"@2.0", "write 2"},
          {"@\"1\"", "must be a whole number, not a text"},
          {"@nan", "must be a whole number"},
          {"@true", "must be a whole number"}};
}

Bad bad_number(const std::string& below, const std::string& above) {
  return {{"@" + below, "allowed is"},  {"@" + above, "allowed is"}, {"@nan", "must be finite"},
          {"@inf", "must be finite"},   {"@-inf", "must be finite"}, {"@\"1\"", "must be a number"},
          {"@1979-05-27", "not a date"}};
}

Bad bad_point() {
  return {{"@1", "two numbers"},
          {"@[]", "two numbers"},
          {"@[1]", "two numbers"},
          {"@[1, 2, 3]", "this world is 2D: write [x, y]"},
          {"[1, @nan]", "must be finite"},
          {"[@inf, 1]", "must be finite"},
          {"[@\"1\", 2]", "must be a number"},
          {"[1, @1.1e9]", "allowed is"},
          {"@{ x = 1, y = 2 }", "not a table"}};
}

Bad bad_size(int most = 16384) {
  const std::string range = fmt::format("1 to {}", most);
  return {{"@1", "two whole numbers"},
          {"@[1]", "two numbers"},
          {"[@0, 8]", range},
          {"[8, @-8]", range},
          {fmt::format("[8, @{}]", most + 1), range},
          {"[@8.0, 8]", "write 8"}};
}

Bad bad_choice(const std::string& near, const std::string& word) {
  return {{"@\"" + near + "\"", "did you mean '" + word + "'?"},
          {"@1", "must be a text"},
          {"@\"" + word + "s_and_more_of_it\"", "cannot be"}};
}

Bad bad_truth() {
  return {{"@1", "true or false"}, {"@\"true\"", "true or false"}, {"@[true]", "true or false"}};
}

Bad bad_names(const std::string& kind) {
  return {{"@\"red\"", "must be a list"},
          {"@[]", "must not be empty"},
          {"[@1]", "a list of texts"},
          {"[@\"nobody\"]", "there is no " + kind + " 'nobody'"}};
}

Bad bad_headline() {
  return {{"@\"pairs\"", "must be a list"},
          {"@[]", "must not be empty"},
          {"[@\"pair\"]", "did you mean 'pairs'?"}};
}

Bad bad_table(const std::string& header) { return {{"@1", "must be a table"}, {"@[1]", header}}; }

Bad bad_capsule() {
  return {{"@1", "two numbers [radius, half_length]"},
          {"@[1]", "two numbers"},
          {"[@-1, 1]", "0 to 1000000000"},
          {"[1, @nan]", "must be finite"}};
}

// What [[body]] and [[pattern]] share.
void add_body_cases(std::vector<KeyCase>& cases) {
  Bad nonnegative = bad_point();
  nonnegative.push_back({"[@-1, 1]", "0 to 1000000000"});
  for (const std::string table : {"body", "pattern", "prototype"}) {
    const auto add = [&](const std::string& key, std::vector<std::string> good, Bad bad,
                         std::vector<std::string> without = {}) {
      cases.push_back({table, key, std::move(good), std::move(bad), std::move(without)});
    };
    add("capsule", {"[0.5, 1]", "[1, 0]"}, bad_capsule(), {"radius"});
    add("oriented", {}, bad_truth());
    add("oriented", {}, {});
    Bad turn = bad_number("-1.1e6", "1.1e6");
    turn.push_back({"@{}", "has no"});
    turn.push_back({"@[1]", "a number or a table"});
    add("turned", {"0", "-90", "1e6", "{ angle = 90 }"}, turn);
    add("spin", {"0", "-90", "1e6", "{ speed = 90 }"}, turn);
    add("heading", {"[0, 1]", "[-3, 4]"}, bad_point());
    add("like", {"\"dot\""}, {{"@1", "must be a text"}, {"@\"dots\"", "did you mean 'dot'?"}});
    add("axis", {}, bad_point());
    add("kind", {"\"dynamic\"", "\"kinematic\"", "\"static\""}, bad_choice("dynamc", "dynamic"));
    add("density", {"0.5", "1e12"}, bad_number("0", "1.1e12"));
    add("mass", {"0.5", "1e12"}, bad_number("0", "1.1e12"));
    add("restitution", {"0", "1"}, bad_number("-0.1", "1.1"));
    add("friction", {"0", "1000"}, bad_number("-0.1", "1001"));
    add("drag", {"0", "3"}, bad_number("-0.1", "1.1e12"));
    add("angular_drag", {"0", "3"}, bad_number("-0.1", "1.1e12"));
    add("may_turn", {"true", "false"}, bad_truth());
    Bad no_path = {{"@1", "must be a text"}};
    if (table != "prototype")  // it is read with the body that is like it
      no_path = {{"@1", "must be a text"},
                 {"@\"L0 0\"", "begins with M"},
                 {"@\"M0 0 X\"", "is none of its commands"},
                 {"@\"M0 0 L4\"", "2 numbers"},
                 {"@\"M0 0 L4 4\"", "area"}};
    add("outline", {"\"M0 0 L4 0 2 3z\"", "\"m1,1h4v4Q0-3 1 1M9 9C0 0 1 1 2 3Z\""}, no_path);
    add("paint", {"\"#0077aa\"", "\"#07a\""}, {{"@1", "must be a text"}, {"@\"blue\"", "six of"}});
    add("volume", {"true", "false"}, bad_truth());
    add("address", {"1", "4000000000"}, bad_whole("0", "4000000001", "1 to 4000000000"));
    add("integrator", {"\"explicit_euler\"", "\"implicit_midpoint\""},
        bad_choice("explicit_eulr", "explicit_euler"));
    add("rotation", {"\"splitting_4\"", "\"explicit_gyroscopic\""},
        bad_choice("splitting_5", "splitting_2"));
    add("asleep", {"false"}, bad_truth());
    add("asleep", {}, {});
    add("follow", {}, {});
    add("follow_axes", {}, {});
    add("wander", {"false"}, bad_truth());
  }
  cases.push_back(
      {"body", "ground", {"[0, 1]", "[-3, 4]", "[1e-200, 0]"}, bad_point(), {"radius"}});
  cases.push_back({"body", "ground", {}, {{"@[0, 0]", "points nowhere"}}, {"radius"}});
  cases.push_back({"body", "speed", {}, bad_number("0", "1.1e9")});
}

void add_link_cases(std::vector<KeyCase>& cases) {
  const Bad body = {{"@1", "must be a text"}, {"@\"rex\"", "did you mean 'red'?"}};
  const std::vector<std::string> points = {"[0, 0]", "[-1e9, 1e9]", "[1.5, 2]"};
  for (const std::string table : {"spring", "joint"}) {
    cases.push_back({table, "a", {"\"red\""}, body});
    cases.push_back({table, "b", {}, body, {"to"}});
    cases.push_back({table, "to", points, bad_point()});
    cases.push_back({table, "at_a", points, bad_point()});
    cases.push_back({table, "at_b", {}, bad_point()});
    cases.push_back({table, "along", {}, body, {"a", "to"}});
  }
  cases.push_back({"spring", "rest_length", {"0", "2.5"}, bad_number("-1", "1.1e9")});
  cases.push_back({"spring", "stiffness", {"0.5", "1e12"}, bad_number("0", "1.1e12")});
  cases.push_back({"spring", "damping", {"0", "1e12"}, bad_number("-1", "1.1e12")});
  cases.push_back(
      {"joint", "kind", {"\"distance\"", "\"pin\""}, bad_choice("distnce", "distance")});
  cases.push_back({"joint", "length", {"0.5", "2"}, bad_number("0", "1.1e9")});
  cases.push_back({"level",
                   "loops",
                   {"[[[0, 0], [8, 0], [8, 6]], [[1, 1], [2, 1], [2, 2], [1, 2]]]"},
                   {{"@1", "a list of polygons"},
                    {"@[]", "must not be empty"},
                    {"[@1]", "a list of corners"},
                    {"[@[[0, 0], [1, 1]]]", "at least 3 corners, not 2"},
                    {"[[[0, 0], [8, 0], @[8]]]", "a corner is two numbers"},
                    {"[[[0, 0], [8, 0], @[8, 6, 1]]]", "a corner is two numbers"},
                    {"[[[0, 0], [8, 0], [8, @nan]]]", "must be finite"},
                    {"@[[[0, 0], [8, 0], [8, 0]]]", "the corner [8, 0] twice in a row"},
                    {"@[[[0, 0], [8, 0], [8, 6], [0, 0]]]", "joined to the first by itself"}}});
  cases.push_back({"level", "balance", {"0", "2.5"}, bad_number("-1", "1.1e6")});
  cases.push_back({"level", "cuts", {"0", "2.5"}, bad_number("-1", "1.1e6")});
  cases.push_back(
      {"level", "choose", {"\"score\"", "\"first_wall\""}, bad_choice("first_wal", "first_wall")});
  cases.push_back({"chart",
                   "x",
                   {"\"all_pairs\""},
                   {{"@1", "must be a text"}, {"@\"bodie\"", "did you mean 'bodies'?"}}});
  cases.push_back({"chart",
                   "y",
                   {"[\"pairs\", \"all_pairs\"]"},
                   {{"@\"pairs\"", "must be a list"},
                    {"@[]", "must not be empty"},
                    {"[@\"pair\"]", "did you mean 'pairs'?"},
                    {"[\"pairs\", @\"pairs\"]", "stands twice"}}});
  cases.push_back({"chart",
                   "bars",
                   {"\"pairs\""},
                   {{"@1", "must be a text"}, {"@\"pairss\"", "did you mean 'pairs'?"}},
                   {"x", "y"}});
  cases.push_back({"chart", "logarithmic", {"true", "false"}, bad_truth()});
  cases.push_back({"chart", "least", {"-3", "0.5"}, bad_number("-1.1e12", "1.1e12")});
  cases.push_back({"chart", "most", {"-3", "0.5"}, bad_number("-1.1e12", "1.1e12")});
  cases.push_back({"chart", "each_part", {"false"}, bad_truth()});
  cases.push_back({"chart", "pieces", {}, {{"@1", "must be a list"}, {"[@1]", "a list of texts"}}});
  cases.push_back({"chart",
                   "labels",
                   {},
                   {{"@1", "must be a list"},
                    {"[@1]", "a list of texts"},
                    {"@[\"a\", \"b\", \"c\"]", "3 labels for"}}});
}

void add_side_cases(std::vector<KeyCase>& cases) {
  const Bad part = {{"@1", "must be a table"}, {"@[]", "must be a table"}};
  cases.insert(cases.end(), {{"side", "name", {"\"b\"", "\"two trees\""}, bad_name()},
                             {"side", "name", {}, {{"@\"a\"", "is taken"}}},
                             {"side", "title", {"\"x\""}, bad_text("1 to 40", 40)},
                             {"side", "structure", {"{ capacity = 3 }", "{}"}, part},
                             {"side", "world", {"{ contacts = \"soft\" }"}, part},
                             {"side", "level", {}, part},
                             {"side", "atlas", {}, part}});
}

void add_problem_cases(std::vector<KeyCase>& cases) {
  cases.insert(cases.end(),
               {{"problem",
                 "solution",
                 {"\"oscillator\"", "\"hanging_chain\""},
                 bad_choice("oscilator", "oscillator")},
                {"problem", "variant", {"\"plain\"", "\"extreme\""}, bad_choice("stif", "stiff")},
                {"problem", "seconds", {"0.5", "1e9"}, bad_number("0", "1.1e9")},
                {"problem", "samples", {"1", "100000"}, bad_whole("0", "100001", "1 to 100000")},
                {"problem", "step", {"0.5", "1e9"}, bad_number("0", "1.1e9")},
                {"problem", "halvings", {"0", "24"}, bad_whole("-1", "25", "0 to 24")},
                {"problem",
                 "methods",
                 {"[\"velocity_verlet\", \"soft:16\", \"soft:0.001\"]"},
                 {{"@\"soft\"", "must be a list"},
                  {"@[]", "must not be empty"},
                  {"[@\"sofd:16\"]", "there is no method 'sofd:16'"},
                  {"[@\"soft:0\"]", "there is no method 'soft:0'"}}}});
}

void add_verb_cases(std::vector<KeyCase>& cases) {
  const std::vector<std::string> points = {"[0, 0]", "[-1e9, 1e9]", "[1.5, 2]"};
  const Bad body = {{"@1", "must be a text"}, {"@\"rex\"", "did you mean 'red'?"}};
  const Bad every = bad_whole("0", "1001", "1 to 1000");
  const Bad corner = {{"@1", "two numbers [x, y]"}, {"@[1, 2, 3]", "two numbers, not 3"}};
  const Bad pace = bad_choice("evnt", "event");
  cases.insert(
      cases.end(),
      {{"move", "turned", {}, {{"@nan", "must be finite"}, {"@1e7", "allowed is"}}},
       {"move", "turned", {"90", "-720"}, {}},
       {"move", "spin", {"90", "-720"}, {{"@inf", "must be finite"}, {"@1e7", "allowed is"}}},
       {"move", "rebuild", {"true", "false"}, bad_truth()},
       {"move", "pace", {"\"event\""}, pace},
       {"move", "events", {"[\"leave\"]"}, {{"[@\"leve\"]", "did you mean 'leave'?"}}},
       {"run", "every", {"1", "1000"}, every},
       {"wait", "event", {"\"touch\"", "\"part\"", "\"asleep\""}, bad_choice("toch", "touch")},
       {"wait",
        "bodies",
        {"[\"pink\", \"red\"]"},
        {{"@[\"red\"]", "it takes two"}, {"[\"red\", @\"red\"]", "is named twice"}}},
       {"wait", "node", {}, {{"@1", "must be a text"}, {"@\"\"", "1 to 64"}}},
       {"wait", "at_most", {"1", "0.5"}, bad_number("0", "1e10")},
       {"wait", "every", {"1", "1000"}, every},
       {"solve_by", "contacts", {"\"impulse\"", "\"soft\""}, bad_choice("impulses", "impulse")},
       {"solve_by", "sub_steps", {"1", "64"}, bad_whole("0", "65", "1 to 64")},
       {"solve_by", "wanted_error", {"0", "0.01"}, bad_number("-0.1", "1.5")},
       {"solve_by", "iterations", {"1", "1000"}, bad_whole("0", "1001", "1 to 1000")},
       {"compare", "bodies", {"[\"red\"]"}, bad_names("body")},
       {"compare", "row", {"\"a town\""}, bad_text("1 to 24", 24)},
       {"compare", "verdict", {"\"\"", "\"{least_work:comparison}\""}, bad_text("0 to 56", 56)},
       {"compare", "verdict", {}, {{"\"@{leest_work}\"", "did you mean 'least_work'?"}}},
       {"compare",
        "kinds",
        {"[\"grid\", \"quadtree\"]"},
        {{"[@\"gird\", \"quadtree\"]", "did you mean 'grid'?"},
         {"@[\"grid\"]", "one kind alone"},
         {"[\"grid\", @\"grid\"]", "stands twice"},
         {"@[\"grid\", \"octree\"]", "needs a 3D world"},
         {"@[\"grid\", \"lecture_quadtree\"]", "is not counted"},
         {"@[\"grid\", \"auto\"]", "is not counted"}}},
       {"compare",
        "times",
        {"{ grid = 95, quadtree = 310 }"},
        {{"{ @gird = 9 }", "did you mean 'grid'?"},
         {"{ @octree = 9 }", "is not compared here"},
         {"{ grid = @0 }", "allowed is 1 to 1000000000"},
         {"{ grid = @1.5 }", "whole number"},
         {"@9", "a table of names"}}},
       {"compare", "machine", {"\"a desk\""}, bad_text("1 to 40", 40)},
       {"phases", "pace", {"\"step\""}, pace},
       {"phases", "events", {"[\"solve\"]"}, {{"[@\"sovle\"]", "did you mean 'solve'?"}}},
       {"separate",
        "pair",
        {"[\"pink\", \"red\"]"},
        {{"@[\"red\"]", "a pair is two bodies"}, {"[\"red\", @\"red\"]", "is named twice"}}},
       {"separate", "pace", {"\"step\""}, pace},
       {"separate", "events", {"[\"axis\"]"}, {{"[@\"axsi\"]", "did you mean 'axis'?"}}},
       {"gjk",
        "pair",
        {"[\"pink\", \"red\"]"},
        {{"@[\"red\"]", "a pair is two bodies"}, {"[\"red\", @\"red\"]", "is named twice"}}},
       {"gjk", "pace", {"\"step\""}, pace},
       {"gjk", "events", {"[\"support\"]"}, {{"[@\"suport\"]", "did you mean 'support'?"}}},
       {"force", "body", {"\"red\""}, body},
       {"force", "force", points, bad_point()},
       {"force", "at", points, bad_point()},
       {"impulse", "body", {"\"red\""}, body},
       {"impulse", "impulse", points, bad_point()},
       {"impulse", "at", points, bad_point()},
       {"sleep", "bodies", {"[\"red\", \"pink\"]"}, bad_names("body")},
       {"wake", "bodies", {"[\"red\", \"pink\"]"}, bad_names("body")},
       {"ray", "from", points, bad_point()},
       {"ray", "to", points, bad_point()},
       {"ray", "to", {}, {{"@[-0.5, 0]", "the same point"}}},
       {"ray", "hits", {"\"nearest\"", "\"all\""}, bad_choice("nearst", "nearest")},
       {"cull", "eye", points, bad_point()},
       {"cull", "target", points, bad_point()},
       {"cull", "target", {}, {{"@[-0.5, 0]", "the same point"}}},
       {"cull", "angle", {"1", "170"}, bad_number("0", "171")},
       {"cull", "near", {"0.5", "9"}, bad_number("0", "1.1e9")},
       {"cull", "near", {}, {{"@10", "that is nothing"}}},
       {"cull", "far", {"0.5", "1e9"}, bad_number("0", "1.1e9")},
       {"cull", "far", {}, {{"@0.1", "'far' is greater than 'near'"}}},
       {"query", "center", points, bad_point()},
       {"query", "radius", {"0.5", "1e9"}, bad_number("0", "1.1e9")},
       {"compile", "pace", {"\"event\""}, pace},
       {"compile", "events", {"[\"cut\"]"}, {{"[@\"cuts\"]", "did you mean 'cut'?"}}},
       {"locate", "point", points, corner},
       {"order", "eye", points, corner},
       {"see", "pace", {"\"event\""}, pace},
       {"see", "events", {"[\"row\"]"}, {{"[@\"rows\"]", "did you mean 'row'?"}}},
       {"see", "eye", {"[2, 2]", "[0, 64]"}, corner},
       {"see", "eye", {}, {{"@[65, 2]", "outside of the world"}}}});
  for (const std::string verb : {"ray", "cull", "query"}) {
    cases.push_back({verb, "pace", {"\"event\""}, pace});
    cases.push_back({verb, "events", {"[\"skip\"]"}, {{"[@\"skp\"]", "did you mean 'skip'?"}}});
  }
}

void add_look_cases(std::vector<KeyCase>& cases) {
  const Bad body = {{"@1", "must be a text"}, {"@\"rex\"", "did you mean 'red'?"}};
  Bad solid = {
      {"@1", "three numbers"}, {"@[1, 2]", "this world is 3D"}, {"[1, @nan, 1]", "finite"}};
  cases.push_back(
      {"display", "names", {"\"story\"", "\"all\"", "\"none\""}, bad_choice("storry", "story")});
  for (const KeyDoc& key : language_table("display").keys)
    if (key.key != "names" && key.key != "trail")
      cases.push_back({"display", std::string(key.key), {"true", "false"}, bad_truth()});
  cases.push_back({"display", "trail", {"0", "64"}, bad_whole("-1", "65", "0 to 64")});
  cases.insert(
      cases.end(),
      {{"view", "at", {"[0, 0]", "[64, 9.5]"}, bad_point()},
       {"view", "at", {}, {{"@[99, 1]", "outside the world"}}},
       {"view", "width", {"0.5", "64"}, bad_number("0", "1.1e9")},
       {"view", "width", {}, {{"@64.5", "wider than the world"}}},
       {"camera", "eye", {"[9, 1, -9]"}, solid},
       {"camera", "target", {"[9, 1, -9]"}, solid},
       {"step.note", "text", {"\"{pairs:pair}\""}, bad_text("1 to 40", 40)},
       {"step.note", "body", {"\"pink\""}, body},
       {"step.note", "event", {"\"split\""}, bad_text("1 to 64", 64), {}},
       {"step.note",
        "node",
        {"\"1.3\""},
        {{"@1", "must be a text"}, {"@\"\"", "letters"}},
        {"body"}},
       {"step.note", "point", {"[1, 2]"}, bad_point(), {"body"}},
       {"step.note",
        "pair",
        {"[\"red\", \"pink\"]"},
        {{"@\"red\"", "must be a list"},
         {"@[]", "must not be empty"},
         {"@[\"red\"]", "two names, not 1"},
         {"[\"red\", @\"red\"]", "no pair with itself"}},
        {"body"}},
       {"step.note",
        "count",
        {"\"pairs\""},
        {{"@1", "must be a text"}, {"@\"pairss\"", "did you mean 'pairs'?"}},
        {"body"}},
       {"step.note", "side", {}, {{"@1", "must be a text"}, {"@\"left\"", "no side 'left'"}}}});
}

void add_promise_cases(std::vector<KeyCase>& cases) {
  for (const std::string key : {"equal", "at_most", "at_least"})
    cases.push_back({"expect",
                     key,
                     {"{ hits = 1 }", "{ energy = -1.5, bodies = 2 }", "{}"},
                     {{"@1", "a table of names"},
                      {"{ bodies = @\"1\" }", "must be a number"},
                      {"{ bodies = @nan }", "must be finite"},
                      {"{ @bodis = 1 }", "did you mean 'bodies'?"},
                      {"{ @refused = 1 }", "no [atlas]"}}});
  cases.push_back({"expect",
                   "contacts_are",
                   {"[]"},
                   {{"@1", "a list of pairs"},
                    {"[[\"red\", @\"red\"]]", "no pair with itself"},
                    {"[[\"red\", @\"pink\"]]", "no body 'pink'"}}});
  cases.push_back(
      {"expect",
       "hits_are",
       {"[]", "[\"red\"]"},
       {{"@1", "must be a list"}, {"[@1]", "a list of texts"}, {"[@\"rd\"]", "'red'"}}});
  for (const std::string key : {"build_work", "step_work"})
    cases.push_back({"expect",
                     key,
                     {"{ grid = 1 }"},
                     {{"@1", "a table of names"},
                      {"{ grid = @-1 }", "allowed is"},
                      {"{ @gird = 1 }", "did you mean 'grid'?"}}});
  cases.push_back({"expect",
                   "fewest",
                   {"[\"grid\"]"},
                   {{"@1", "must be a list"}, {"[@\"gird\"]", "did you mean 'grid'?"}}});
  for (const std::string key : {"asleep", "awake"})
    cases.push_back({"expect",
                     key,
                     {"0", "3", "[\"red\"]"},
                     {{"@\"red\"", "a whole number or a list of names"},
                      {"@-1", "allowed is"},
                      {"@1.5", "a whole number or a list of names"},
                      {"@[]", "must not be empty"},
                      {"[@1]", "a list of texts"},
                      {"[@\"rd\"]", "'red'"}}});
  for (const std::string key : {"velocity", "half_size"})
    cases.push_back({"expect",
                     key,
                     {"{ red = [1, 1] }"},
                     {{"@1", "a table of names"},
                      {"{ red = @1 }", "two numbers"},
                      {"{ red = @[1, 1, 1] }", "this world is 2D"},
                      {"{ @rd = [1, 1] }", "'red'"}}});
  cases.push_back({"expect",
                   "turned",
                   {"{ red = 90 }"},
                   {{"@1", "a table of names"},
                    {"{ red = @\"1\" }", "must be a number"},
                    {"{ red = @inf }", "must be finite"},
                    {"{ @rd = 1 }", "'red'"}}});
  for (const CountDoc& measure : known_measures())
    // These need joints and another structure: in tests of their own.
    if (measure.name != "joint_gap" && measure.name != "tree_cost")
      cases.push_back({"expect",
                       std::string(measure.name),
                       {"0", "1.5", "-2e20"},
                       {{"@\"1\"", "must be a number"},
                        {"@nan", "must be finite"},
                        {"@-inf", "must be finite"}}});
}

// By hand, so that a slip in the language's table is found.
std::vector<KeyCase> key_cases() {
  const Bad color = bad_whole("0", "9", "1 to 8");
  const Bad cycled = bad_whole("-1", "9", "0 to 8");
  const Bad seed = bad_whole("-1", "9007199254740993", "0 to 9007199254740992");
  const std::vector<std::string> seeds = {"0", "1", "9007199254740992", "0x10"};
  const std::vector<std::string> points = {"[0, 0]", "[-1e9, 1e9]", "[1.5, 2]"};
  Bad nonnegative = bad_point();
  nonnegative.push_back({"[@-1, 1]", "0 to 1000000000"});
  Bad extent = bad_point();
  extent.erase(extent.begin(), extent.begin() + 4);  // with three numbers the world is solid
  extent.push_back({"@1", "two or three numbers"});
  extent.push_back({"@[]", "two or three numbers"});
  extent.push_back({"@[1]", "two or three numbers"});
  extent.push_back({"@[1, 2, 3, 4]", "[x, y, z] in a 3D one"});
  extent.push_back({"[@0, 1]", "above 0"});
  extent.push_back({"[1, @-1]", "above 0"});
  Bad file_name = bad_name();
  file_name.push_back({"@\"../evil\"", "cannot be"});
  file_name.push_back({"@\"Ghost Tree\"", "name = \"ghost_tree\""});
  file_name.erase(file_name.begin() + 2);  // a file's name may begin with a digit
  file_name[4] = {"@\"" + std::string(65, 'a') + "\"", "cannot be"};
  const std::vector<std::string> looks = {"\"ghost\"", "\"player\"", "\"ball\"",  "\"bat\"",
                                          "\"disc\"",  "\"box\"",    "\"demon\"", "\"item\""};
  const Bad planes = {{"@1", "a list of tables"}, {"[@1]", "a list of tables"}};
  const Bad no_number = {{"@\"1\"", "must be a whole number"}, {"@-1", "allowed is"}};

  std::vector<KeyCase> cases = {
      {"", "title", {"\"a\"", "'Ghosts — now'"}, bad_text("1 to 80", 80)},
      {"", "title", {}, {{"@\"\"", "0 letters"}}},
      {"", "source", {"\"\"", "\"Quadtrees\""}, bad_text("0 to 80", 80)},
      {"", "name", {"\"ghosts_2\"", "\"7\"", "\"" + std::string(64, 'a') + "\""}, file_name},
      {"", "seed", seeds, seed},
      {"", "pace", {"\"step\"", "\"event\""}, bad_choice("evnt", "event")},
      {"",
       "panels",
       {"[\"world\"]", "[\"tree\", \"world\"]"},
       {{"@\"world\"", "must be a list"},
        {"@[]", "must not be empty"},
        {"[@\"tre\"]", "did you mean 'tree'?"},
        {"[\"tree\", @\"tree\"]", "stands twice"},
        {"[@\"atlas\"]", "it needs an [atlas]"}}},
      {"world", "size", {"[1, 2.5]", "[1e9, 1e-6]"}, extent},
      {"world", "time_step", {"1", "0.0166", "1000"}, bad_number("0", "1000.1")},
      {"world", "frame_every", {"1", "1000"}, bad_whole("0", "1001", "1 to 1000")},
      {"world", "gravity", points, bad_point()},
      {"world", "gravitation", {"0", "1"}, bad_number("-1", "1.1e9")},
      {"world",
       "contacts",
       {"\"none\"", "\"impulse\"", "\"soft\""},
       bad_choice("impulses", "impulse")},
      {"world",
       "integrator",
       {"\"explicit_euler\"", "\"semi_implicit_euler\"", "\"velocity_verlet\"", "\"runge_kutta_4\"",
        "\"implicit_midpoint\"", "\"implicit_euler\"", "\"kahan_li_8\"", "\"dormand_prince\""},
       bad_choice("runge_kuta_4", "runge_kutta_4")},
      {"world",
       "rotation",
       {"\"exact\"", "\"splitting_2\"", "\"splitting_4\"", "\"explicit_gyroscopic\""},
       bad_choice("splitting_3", "splitting_2")},
      {"world", "sub_steps", {"1", "64"}, bad_whole("0", "65", "1 to 64")},
      {"world", "wanted_error", {"0", "0.01"}, bad_number("-0.1", "1.5")},
      {"world", "iterations", {"1", "1000"}, bad_whole("0", "1001", "1 to 1000")},
      {"world", "impact_budget", {"0", "10000000"}, bad_whole("-1", "10000001", "0 to 10000000")},
      {"world", "may_sleep", {"true", "false"}, bad_truth()},
      {"world", "show_boxes", {"true", "false"}, bad_truth()},
      {"world", "show_velocities", {"true", "false"}, bad_truth()},
      {"world", "show_depths", {"false"}, bad_truth()},
      {"world", "camera_eye", {}, {{"@1", "two numbers"}}},
      {"world", "camera_target", {}, {{"@1", "two numbers"}}},
      {"world",
       "land",
       {"[[[0, 0], [8, 0], [8, 6]]]", "[[[-9, 0], [8, 0], [8, 6]], [[1, 1], [2, 1], [2, 2]]]"},
       {{"@1", "a list of polygons"},
        {"@[]", "must not be empty"},
        {"[@[[0, 0], [1, 1]]]", "at least 3 corners, not 2"},
        {"[[[0, 0], [8, 0], [8, @nan]]]", "must be finite"}}},
      {"world", "sea", {"true", "false"}, bad_truth()},
      {"world",
       "quiet",
       {"[\"energy\"]",
        "[\"view\", \"outside\", \"contacts\", \"joints\", \"energy\", \"through\"]"},
       {{"@\"energy\"", "must be a list"},
        {"@[]", "must not be empty"},
        {"[@\"enrgy\"]", "did you mean 'energy'?"},
        {"[\"view\", @\"view\"]", "stands twice"}}},
      {"structure",
       "kind",
       {"\"none\"", "\"brute_force\"", "\"quadtree\"", "\"kd_tree\"", "\"sort_and_sweep\"",
        "\"grid\""},
       bad_choice("quadtre", "quadtree")},
      {"structure", "kind", {}, {{"@\"octree\"", "needs a 3D world"}}},
      {"structure", "split_static", {"true", "false"}, bad_truth()},
      {"rebuild", "split_static", {"true", "false"}, bad_truth()},
      {"structure", "capacity", {"1", "1000"}, bad_whole("0", "1001", "1 to 1000")},
      {"structure", "max_depth", {"0", "32"}, bad_whole("-1", "33", "0 to 32")},
      {"structure", "children", {"\"lazy\"", "\"eager\""}, bad_choice("eagre", "eager")},
      {"structure", "no_progress_stop", {"true", "false"}, bad_truth()},
      {"structure", "cell", {"0", "0.5", "1e9"}, bad_number("-1", "1.1e9")},
      {"structure", "cell", {"1e-9"}, {{"@5e-324", "cells so small"}}},
      {"structure", "levels", {"1", "16"}, bad_whole("0", "17", "1 to 16")},
      {"structure", "open", {"true", "false"}, bad_truth()},
      {"structure", "margin", {"0"}, bad_number("-1", "1.1e9")},
      {"structure", "following", {}, bad_choice("refti", "refit")},
      {"structure", "axis", {}, bad_choice("widst", "widest")},
      {"structure", "as_printed", {"false"}, bad_truth()},
      {"structure", "root", {}, bad_point()},
      {"structure", "planes", {}, planes},
      {"structure.planes", "name", {"\"\"", "\"net\""}, bad_text("0 to 24", 24)},
      {"structure.planes", "point", points, bad_point()},
      {"structure.planes", "normal", {"[0, 1]", "[-3, 4]"}, bad_point()},
      {"structure.planes", "normal", {}, {{"@[0, 0]", "points nowhere"}}},
      {"structure.planes",
       "at",
       {"\"root\""},
       {{"@1", "must be a text"},
        {"@\"\"", "letters"},
        {"@\"left\"", "there is no region 'left'"}}},
      {"prototype", "name", {"\"a\""}, bad_name()},
      {"prototype", "look", looks, bad_choice("gost", "ghost")},
      {"prototype", "color", {"0", "8"}, cycled},
      {"prototype", "radius", {"0", "0.5", "1e9"}, bad_number("-1", "1.1e9")},
      {"prototype", "half_size", {"[0, 0]", "[2, 3]"}, nonnegative},
      {"prototype", "position", points, bad_point()},
      {"prototype", "velocity", points, bad_point()},
      {"prototype", "ground", {"[0, 1]"}, bad_point()},
      {"prototype", "speed", {"2.5"}, bad_number("0", "1.1e9")},
      {"prototype", "static", {"true", "false"}, bad_truth()},
      {"map",
       "rows",
       {"\"##\"", "\"\"\"\n#.\n.#\n\"\"\""},
       {{"@1", "must be a text"},
        {"@\"\"", "the map is empty"},
        {"@\"#\\u0007\"", "no control characters"},
        {"\"#@x\"", "has no prototype"}}},
      {"map", "cell", {"0.5", "4"}, bad_number("0", "1.1e9")},
      {"map", "at", {"[0, 0]", "[8.5, 2]"}, bad_point()},
      {"map",
       "legend",
       {"{ \"#\" = \"wall\", x = \"wall\" }"},
       {{"@1", "a table of letters"},
        {"{ \"#\" = @1 }", "from letters to names"},
        {"{ \"#\" = @\"wal\" }", "did you mean 'wall'?"}}},
      {"emit", "bodies", {"[\"red\"]"}, bad_names("body")},
      {"emit", "every", {"1", "0.5"}, {{"@0", "above 0"}, {"@\"1\"", "must be a number"}}},
      {"emit", "every", {}, {{"@0.01", "not a whole number"}}},
      {"pattern", "gap", {}, bad_number("-1", "1.1e9")},
      {"pattern", "velocity", points, bad_point()},
      {"", "idea", {"\"\"", "\"One idea.\""}, bad_text("0 to 180", 180)},
      {"", "language", {"\"de\"", "\"x-made-up\""}, bad_text("2 to 35", 35)},
      {"", "words", {"\"sv.toml\""}, bad_text("1 to 200", 200)},
      {"", "lecture", {"1", "9999"}, bad_whole("0", "10000", "1 to 9999")},
      {"",
       "needs",
       {"[\"ghost_quadtree\"]"},
       {{"@\"a\"", "must be a list"}, {"@[]", "must not be empty"}, {"[@1]", "a list of texts"}}},
      {"body",
       "name",
       {"\"a\"", "\"Blue bat-1_x\"", "\"" + std::string(24, 'a') + "\""},
       bad_name()},
      {"body", "look", looks, bad_choice("gost", "ghost")},
      {"body", "color", {"1", "8"}, color},
      {"body", "radius", {"0", "0.5", "1e9"}, bad_number("-1", "1.1e9")},
      {"body", "half_size", {"[0, 0]", "[1, 0]", "[2, 3]"}, nonnegative, {"radius"}},
      {"prototype", "label", {"\"Käfer\""}, bad_text("1 to 40", 40)},
      {"body", "label", {"\"Käfer\"", "\"カブトムシ\""}, bad_text("1 to 40", 40)},
      {"body", "position", points, bad_point()},
      {"body", "velocity", points, bad_point()},
      {"body", "static", {"true", "false"}, bad_truth()},
      {"pattern", "name", {"\"dot\""}, bad_name()},
      {"pattern", "count", {"1", "20000"}, bad_whole("0", "20001", "1 to 20000")},
      {"pattern", "arrange", {"\"random\"", "\"grid\""}, bad_choice("gird", "grid")},
      {"pattern", "min", {"[0, 0]", "[63, 63]"}, bad_point()},
      {"pattern", "max", {"[64, 64]", "[1, 1]"}, bad_point()},
      {"pattern", "look", looks, bad_choice("bal", "ball")},
      {"pattern", "color", {"0", "8"}, cycled},
      {"pattern", "radius", {"0", "1"}, bad_number("-1", "1.1e9")},
      {"pattern", "half_size", {"[2, 3]"}, nonnegative, {"radius"}},
      {"pattern", "speed", {"0", "2.5"}, bad_number("-1", "1.1e9")},
      {"pattern", "seed", seeds, seed},
      {"pattern", "static", {"true", "false"}, bad_truth()},
      {"atlas", "size", {"[1, 8192]"}, bad_size(8192)},
      {"atlas",
       "rule",
       {"\"first_fit\"", "\"best_texture\""},
       bad_choice("best_textur", "best_texture")},
      {"atlas", "turn", {"true", "false"}, bad_truth()},
      {"atlas", "trials", {"1", "18"}, bad_whole("0", "19", "1 to 18")},
      {"atlas", "screen", {"[1, 16384]"}, bad_size()},
      {"atlas",
       "quiet",
       {"[\"expect\"]", "[\"needs\", \"expect\"]"},
       {{"@\"needs\"", "must be a list"}, {"[@\"need\"]", "did you mean 'needs'?"}}},
      {"texture", "name", {"\"B\""}, bad_name()},
      {"texture", "picture", {"\"pattern\"", "\"heart\""}, bad_choice("hart", "heart")},
      {"element", "texture", {"\"A\""}, {{"@1", "must be a text"}, {"@\"Ab\"", "no texture"}}},
      {"element",
       "at",
       {"[0, 0]", "[8, 8]"},
       {{"@1", "two whole numbers"},
        {"@[1]", "two numbers"},
        {"[@-1, 8]", "0 to 16384"},
        {"@[9, 0]", "at most [8, 8]"}}},
      {"texture", "size", {"[1, 16384]"}, bad_size()},
      {"texture", "later", {"true", "false"}, bad_truth()},
      {"texture", "color", {"1", "8"}, color},
      {"texture_pattern", "name", {"\"t\""}, bad_name()},
      {"texture_pattern", "count", {"1", "19999"}, bad_whole("0", "20001", "1 to 20000")},
      {"texture_pattern", "min", {"[1, 16]"}, bad_size()},
      {"texture_pattern", "max", {"[8, 16384]"}, bad_size()},
      {"texture_pattern", "multiple", {"1", "16"}, bad_whole("0", "16385", "1 to 16384")},
      {"texture_pattern",
       "order",
       {"\"as_made\"", "\"tallest_first\""},
       bad_choice("tallest_frist", "tallest_first")},
      {"texture_pattern", "color", {"0", "8"}, cycled},
      {"texture_pattern", "seed", seeds, seed},
      {"insert", "bodies", {"[\"red\"]"}, bad_names("body")},
      {"remove", "bodies", {"[\"red\"]"}, bad_names("body")},
      {"move",
       "body",
       {"\"red\""},
       {{"@1", "must be a text"}, {"@\"rex\"", "did you mean 'red'?"}}},
      {"move", "to", points, bad_point()},
      {"move", "velocity", points, bad_point()},
      {"run", "seconds", {"1", "1.5", "0.016666666"}, bad_number("0", "1e10")},
      {"run", "seconds", {}, {{"@0.01", "not a whole number"}, {"@2000", "120000 frames"}}},
      {"rebuild", "kind", {"\"bsp\""}, bad_choice("bspp", "bsp")},
      {"rebuild", "capacity", {"1", "1000"}, bad_whole("0", "1001", "1 to 1000")},
      {"rebuild", "margin", {"0"}, bad_number("-1", "1.1e9")},
      {"rebuild", "following", {}, bad_choice("reinsrt", "reinsert")},
      {"rebuild", "axis", {}, bad_choice("wdest", "widest")},
      {"rebuild", "as_printed", {"false"}, bad_truth()},
      {"rebuild", "root", {}, bad_point()},
      {"rebuild", "cell", {"0", "0.5", "1e9"}, bad_number("-1", "1.1e9")},
      {"rebuild", "cell", {"0.5"}, {{"@1e-10", "cells so small"}}},
      {"rebuild", "levels", {"1", "16"}, bad_whole("0", "17", "1 to 16")},
      {"rebuild", "open", {"true", "false"}, bad_truth()},
      {"rebuild", "max_depth", {"0", "32"}, bad_whole("-1", "33", "0 to 32")},
      {"rebuild", "children", {"\"lazy\"", "\"eager\""}, bad_choice("laxy", "lazy")},
      {"rebuild", "no_progress_stop", {"true"}, bad_truth()},
      {"rebuild", "planes", {"[{ point = [1, 1], normal = [1, 1], name = \"net\" }]"}, planes},
      {"pack", "textures", {"[\"A\"]"}, bad_names("texture")},
      {"pack", "each", {"true", "false"}, bad_truth()},
      {"pack", "free_name", {"\"C\""}, bad_text("1 to 24", 24)},
      {"ask_room", "size", {"[1, 16384]"}, bad_size()},
      {"draw", "from", {"\"textures\"", "\"atlas\""}, bad_choice("atla", "atlas")},
      {"draw", "order", {"\"as_listed\"", "\"by_texture\""}, bad_choice("by_textur", "by_texture")},
      {"draw", "pace", {"\"step\"", "\"event\""}, bad_choice("evnt", "event")},
      {"draw", "events", {"[\"bind\"]"}, {{"[@\"bnd\"]", "did you mean 'bind'?"}}},
      {"expect",
       "in_leaves",
       {"{ red = 1 }"},
       {{"@1", "a table of names"},
        {"{ red = @\"1\" }", "whole number"},
        {"{ red = @-1 }", "allowed is"},
        {"{ @pink = 1 }", "there is no body 'pink'"}}},
      {"expect",
       "pairs_are",
       {"[]"},
       {{"@1", "a list of pairs"},
        {"[@\"red\"]", "two names"},
        {"[@[\"red\"]]", "two names"},
        {"[[\"red\", @\"red\"]]", "no pair with itself"},
        {"[[\"red\", @\"pink\"]]", "no body 'pink'"}}},
      {"expect",
       "position",
       {"{ red = [1, 1] }"},
       {{"@1", "a table of names"},
        {"{ red = @1 }", "two numbers"},
        {"{ @rd = [1, 1] }", "'red'"}}},
  };
  const std::string four = "@[\"nodes\", \"pairs\", \"leaves\", \"entries\"]";
  for (const std::string table : {"", "show"}) {
    Bad bad = bad_headline();
    bad.push_back({four, "the limit is 3"});
    bad.push_back({"[\"pairs\", @\"pairs\"]", "stands twice"});
    bad.push_back({"[@\"energy.rex\"]", "did you mean 'red'?"});
    bad.push_back({"[@\"pair: left\"]", "did you mean 'pairs'?"});
    bad.push_back({"[@\"pairs:\"]", "words of 'pairs' are missing"});
    bad.push_back({"[@\"pairs: one/\"]", "words of 'pairs' are missing"});
    bad.push_back({"[\"pairs\", @\"pairs: left\"]", "stands twice"});
    bad.push_back({"[@\"pairs: " + std::string(49, 'x') + "\"]", "more than 48 letters"});
    cases.push_back({table,
                     "headline",
                     {"[\"pairs\", \"speed.red\"]", "[\"pairs: pair left/pairs left\"]"},
                     bad});
  }
  const Bad ruled = {{"@1", "must be a text"}, {"@\"rex\"", "did you mean 'red'?"}};
  cases.push_back({"step.ruler", "a", {}, ruled});
  cases.push_back({"step.ruler", "b", {}, ruled, {"to"}});
  cases.push_back({"step.ruler", "b", {}, {{"@\"red\"", "from a body to itself"}}, {"to"}});
  cases.push_back({"step.ruler", "from", {"[0, 0]"}, bad_point(), {"a"}});
  cases.push_back({"step.ruler", "to", {"[0, 0]"}, bad_point()});
  cases.push_back({"step.ruler", "text", {"\"\"", "\"length\""}, bad_text("0 to 24", 24)});
  cases.push_back({"step.ruler", "change", {"true"}, bad_truth()});
  cases.push_back({"code",
                   "function",
                   {"\"Split\"", "\"PhysicsSystem::BroadPhase\""},
                   {{"@1", "must be a text"},
                    {"@\"\"", "letters"},
                    {"@\"Inser\"", "did you mean 'Insert'?"},
                    {"@\"QuadTreeNode::Spilt\"", "did you mean 'QuadTreeNode::Split'?"}}});
  cases.push_back({"code",
                   "line",
                   {"\"\"", "\"Split(watch);\""},
                   {{"@1", "must be a text"},
                    {"@\"Spilt();\"", "no line of 'QuadTreeNode::Insert' has 'Spilt();'"}}});
  cases.push_back({"world", "show_forces", {"true"}, bad_truth()});
  cases.push_back({"world", "show_coordinates", {"true"}, bad_truth()});
  add_body_cases(cases);
  add_link_cases(cases);
  add_side_cases(cases);
  add_problem_cases(cases);
  add_verb_cases(cases);
  add_promise_cases(cases);
  add_look_cases(cases);
  for (const char* verb : {"insert", "pack"}) {
    cases.push_back({verb, "pace", {"\"step\"", "\"event\""}, bad_choice("evnt", "event")});
    cases.push_back({verb,
                     "events",
                     {"[\"store\"]"},
                     {{"@\"store\"", "must be a list"},
                      {"@[]", "must not be empty"},
                      {"[@\"stor\"]", "did you mean 'store'?"},
                      {"[\"store\", @\"store\"]", "stands twice"}}});
  }
  for (const TableDoc& verb : language_verbs()) {
    const std::string table(verb.name);
    cases.push_back(
        {table,
         "name",
         {"\"two\"", "\"a_1\""},
         {{"@\"Two\"", "name = \"two\""}, {"@1", "must be a text"}, {"@\"\"", "cannot be"}}});
    cases.push_back({table, "plot", {}, {{"@1", "must be a text"}, {"@\"\"", "letters"}}});
    cases.push_back({table, "repeat", {"1"}, bad_whole("0", "101", "1 to 100")});
    cases.push_back({table, "part", {"\"part 2\""}, bad_text("1 to 60", 60)});
    cases.push_back({table, "caption", {"\"\"", "\"Hello\""}, bad_text("0 to 180", 180)});
    cases.push_back({table, "after", {"\"\"", "\"Hello\""}, bad_text("0 to 180", 180)});
    cases.push_back({table, "notes", {"\"\"", "\"Ask.\""}, bad_text("0 to 2000", 2000)});
    cases.push_back({table, "question", {}, bad_text("1 to 180", 180)});
    cases.push_back({table, "answer", {}, bad_text("1 to 180", 180)});
    cases.push_back({table, "predict", {}, {{"@1", "must be a text"}, {"@\"\"", "letters"}}});
    cases.push_back({table, "ending", {"true", "false"}, bad_truth()});
    cases.push_back({table, "ruler", {}, {{"@1", "[[step.ruler]]"}}});
    cases.push_back({table, "headline", {}, bad_headline()});
    cases.push_back({table,
                     "lit",
                     {"[]", "[\"red\"]"},
                     {{"@1", "must be a list"}, {"[@1]", "a list of texts"}}});
    cases.push_back({table,
                     "panels",
                     {},
                     {{"@\"world\"", "must be a list"}, {"[@\"wrld\"]", "did you mean 'world'?"}}});
    cases.push_back({table, "expect", {"{}"}, bad_table("[expect]")});
    cases.push_back({table, "always", {"{}"}, bad_table("[expect]")});
    cases.push_back({table, "display", {"{}"}, bad_table("[display]")});
    cases.push_back({table, "view", {}, bad_table("[view]")});
    cases.push_back({table, "camera", {}, bad_table("[camera]")});
    cases.push_back({table, "code", {}, bad_table("[code]")});
    cases.push_back({table, "orbit", {}, bad_number("-1.1e6", "1.1e6")});
    cases.push_back({table, "note", {"[]"}, {{"@1", "a list of tables"}, {"[@1]", "tables"}}});
  }
  for (const CountDoc& count : known_counts())
    if (count.for_world() && count.name != "asleep" && count.name != "awake" &&
        count.rule.when != "with a kD-tree" && count.rule.when != "with `sort_and_sweep`" &&
        count.rule.when != "with an `aabb_tree`" &&
        count.rule.when != "with `as_printed`")  // the first two are above
      cases.push_back(
          {"expect", std::string(count.name), {"0", "1", "9007199254740992"}, no_number});
  return cases;
}

TEST(Keys, TakeWhatTheyShould) {
  for (const KeyCase& c : key_cases())
    for (const std::string& value : c.good) {
      const std::string text = with(c.table, c.key, value, c.without);
      EXPECT_TRUE(mistakes(text).empty()) << text << shown(mistakes(text));
    }
}

TEST(Keys, RefuseTheRestAtItsPlace) {
  for (const KeyCase& c : key_cases())
    for (const auto& [value, words] : c.bad) {
      SCOPED_TRACE(c.table + "." + c.key + " = " + value);
      expect_mistakes(with(c.table, c.key, value, c.without), {words});
    }
}

TEST(Keys, AllAreTested) {
  std::set<std::pair<std::string, std::string>> tested = {
      {"world", "min"},       {"world", "max"},         {"query", "min"},
      {"query", "max"},       {"expect", "joint_gap"},  {"expect", "tree_cost"},
      {"expect", "swaps"},    {"expect", "reinserted"}, {"expect", "refitted"},
      {"expect", "tolerance"}};  // in tests of their own
  for (const KeyCase& c : key_cases()) tested.emplace(c.table, c.key);
  const auto require = [&](const TableDoc& table) {
    for (const KeyDoc& key : table.keys) {
      const bool is_container = key.type == KeyType::table || key.type == KeyType::tables;
      const bool is_count = table.name == "expect" && key.type == KeyType::whole;
      if (key.key == "do" || (table.name.empty() && is_container) || is_count) continue;
      EXPECT_TRUE(tested.contains({std::string(table.name), std::string(key.key)}))
          << "no test of '" << key.key << "' in " << table.heading;
    }
  };
  for (const TableDoc& table : language_tables())
    if (table.name != "step") require(table);
  for (const TableDoc& verb : language_verbs()) require(verb);
}

TEST(Keys, MissingOnesAreAskedFor) {
  const std::vector<std::pair<std::string, std::string>> required = {{"structure", "kind"},
                                                                     {"structure.planes", "point"},
                                                                     {"structure.planes", "normal"},
                                                                     {"body", "name"},
                                                                     {"body", "position"},
                                                                     {"body", "radius"},
                                                                     {"pattern", "name"},
                                                                     {"pattern", "count"},
                                                                     {"pattern", "radius"},
                                                                     {"atlas", "size"},
                                                                     {"texture", "name"},
                                                                     {"texture", "size"},
                                                                     {"texture_pattern", "name"},
                                                                     {"texture_pattern", "count"},
                                                                     {"texture_pattern", "min"},
                                                                     {"texture_pattern", "max"},
                                                                     {"insert", "bodies"},
                                                                     {"remove", "bodies"},
                                                                     {"move", "body"},
                                                                     {"move", "to"},
                                                                     {"run", "seconds"},
                                                                     {"spring", "stiffness"},
                                                                     {"spring", "a"},
                                                                     {"joint", "kind"},
                                                                     {"level", "loops"},
                                                                     {"chart", "x"},
                                                                     {"wait", "event"},
                                                                     {"wait", "bodies"},
                                                                     {"wait", "at_most"},
                                                                     {"force", "body"},
                                                                     {"force", "force"},
                                                                     {"impulse", "impulse"},
                                                                     {"sleep", "bodies"},
                                                                     {"wake", "bodies"},
                                                                     {"ray", "from"},
                                                                     {"ray", "to"},
                                                                     {"cull", "eye"},
                                                                     {"cull", "target"},
                                                                     {"query", "radius"},
                                                                     {"compare", "bodies"},
                                                                     {"compare", "row"},
                                                                     {"locate", "point"},
                                                                     {"order", "eye"},
                                                                     {"pack", "textures"},
                                                                     {"ask_room", "size"},
                                                                     {"code", "function"},
                                                                     {"show", "do"},
                                                                     {"world", "size"},
                                                                     {"", "title"}};
  for (const auto& [table, key] : required) {
    const std::string text = without_key(table, key);
    const auto found = mistakes(text);
    ASSERT_EQ(found.size(), 1u) << text << shown(found);
    EXPECT_NE(found[0].message.find("no '" + key + "'"), std::string::npos) << shown(found);
  }
}

TEST(Keys, MisspeltOnesAreFoundInEveryTable) {
  for (const auto& [table, s] : surroundings()) {
    SCOPED_TRACE(table);
    std::string text = s.before + "@qqqqqqqq = 1\n";
    for (const auto& [k, v] : s.lines) text += k + " = " + v + "\n";
    expect_mistakes(text + s.after, {"unknown key 'qqqqqqqq'"});
  }
}

}  // namespace
}  // namespace lantern::run
