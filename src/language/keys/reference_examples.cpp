// The examples of the reference page, and the pictures that Lantern makes of them.
#include <fmt/format.h>

#include "language/language.hpp"
#include "language/reference.hpp"
#include "language/specs.hpp"
#include "language/tables/placement.hpp"

namespace lantern::language {
namespace {

constexpr std::string_view kWorldExample = R"(title = "Three bodies, four cells"

[world]
size = [16, 9]
contacts = "impulse"
may_sleep = true

[structure]
kind = "quadtree"
capacity = 2

[[body]]
name = "red"
look = "ghost"
half_size = [0.8, 0.8]
position = [3, 6]

[[body]]
name = "pink"
look = "ghost"
color = 2
half_size = [0.8, 0.8]
position = [6, 7]

[[body]]
name = "player"
look = "player"
color = 3
radius = 0.8
position = [12, 2]

[[body]]
name = "blue"
look = "ghost"
color = 4
half_size = [0.8, 0.8]
position = [12, 7]

[[step]]
do = "insert"
bodies = ["red", "pink"]
caption = "Two bodies fit into the root: {pairs:pair} to test."
expect = { nodes = 1, pairs = 1 }

[[step]]
do = "insert"
bodies = ["player"]
caption = "The third overflows it. Still {pairs:pair}, where brute force tests {all_pairs}."
expect = { pairs = 1, all_pairs = 3, pairs_are = [["red", "pink"]] }
)";

constexpr std::string_view kAtlasExample = R"(title = "A small atlas"

[atlas]
size = [128, 128]
screen = [160, 90]

[[texture]]
name = "A"
size = [48, 80]

[[texture_pattern]]
name = "tile"
count = 3
min = [16, 16]
max = [32, 32]
multiple = 8

[[element]]
texture = "tile1"
at = [8, 8]

[[element]]
texture = "A"
at = [56, 4]

[[element]]
texture = "tile1"
at = [112, 8]

[[step]]
do = "show"
caption = "An empty atlas: {free_leaves:free leaf/free leaves} of {free_area} px."
expect = { free_leaves = 1, textures = 0 }
)";

constexpr std::string_view kLevelExample = R"(title = "A room with a pillar"

[world]
size = [12, 8]

[level]
loops = [
  [[1, 1], [11, 1], [11, 7], [1, 7]],
  [[5, 3], [5, 5], [7, 5], [7, 3]],
]

[[step]]
do = "compile"
caption = "{walls:wall}: four around the room, four around the pillar."
expect = { walls = 8 }
)";

constexpr std::string_view kMapExample = R"(title = "Two ghosts in a small maze"

[world]
size = [16, 8]

[[prototype]]
name = "wall"
static = true
color = 7

[[prototype]]
name = "ghost"
look = "ghost"
half_size = [0.6, 0.6]
color = 0

[map]
cell = 1.6
legend = { "#" = "wall", "o" = "ghost" }
rows = """
##########
#o...#...#
#.##...#.#
#..#.##o.#
##########
"""

[[step]]
do = "insert"
bodies = ["wall", "ghost1..ghost2"]
caption = "{bodies} bodies: 33 letters of walls become nine boxes."
expect = { bodies = 11 }
)";

constexpr std::string_view kChartExample = R"(title = "More bodies, more pairs"

[world]
size = [16, 9]

[structure]
kind = "quadtree"

[[pattern]]
name = "dot"
count = 24
radius = 0.3

[chart]
x = "bodies"
y = ["all_pairs", "pairs"]

[[step]]
do = "insert"
bodies = ["dot1..dot8"]
plot = "8"

[[step]]
do = "insert"
bodies = ["dot9..dot16"]
plot = "16"

[[step]]
do = "insert"
bodies = ["dot17..dot24"]
plot = "24"
caption = "{bodies} bodies: {pairs:pair} share a leaf, of {all_pairs}."
)";

constexpr std::string_view kCollisionsExample = R"(title = "A ball hops"

[world]
size = [16, 9]
gravity = [0, -10]
contacts = "lecture"
time_step = 0.05

[[body]]
name = "ball"
look = "ball"
radius = 0.8
position = [8, 5]
restitution = 0.3

[[body]]
name = "bat"
look = "bat"
half_size = [4, 0.4]
position = [8, 2]
static = true

[[step]]
do = "insert"
bodies = ["ball", "bat"]

[[step]]
do = "run"
seconds = 2
)";

bool is_of_atlas(std::string_view verb) {
  return verb == "pack" || verb == "ask_room" || verb == "draw";
}
bool is_of_level(std::string_view verb) {
  return verb == "compile" || verb == "locate" || verb == "order" || verb == "see";
}

}  // namespace

std::string_view world_example() { return kWorldExample; }
std::string_view atlas_example() { return kAtlasExample; }
std::string_view level_example() { return kLevelExample; }
std::string_view map_example() { return kMapExample; }
std::string_view chart_example() { return kChartExample; }
std::string_view collisions_example() { return kCollisionsExample; }

std::string looks_example() {
  std::string text = "title = \"Who a body can look like\"\nworld = { size = [16, 6] }\nbody = [\n";
  int index = 0;
  for (const std::string_view look : names(Look())) {
    const bool is_box = look == "ghost" || look == "bat" || look == "box" || look == "person" ||
                        look == "demon" || look == "item";
    text += fmt::format(
        "  {{ name = \"{0}\", look = \"{0}\", {1}, position = [{2}, {3}], color = {4} }},\n", look,
        is_box ? "half_size = [0.9, 0.9]" : "radius = 0.9", 1.5 + 2.5 * (index % 5),
        index < 5 ? 4.3 : 1.5, 1 + index % 8);
    ++index;
  }
  text += "]\n\n[[step]]\ndo = \"insert\"\nbodies = [";
  for (const std::string_view look : names(Look()))
    text += fmt::format("{}\"{}\"", text.ends_with('[') ? "" : ", ", look);
  return text + "]\n";
}

EnumNames arrange_names() { return names(Arrange()); }

std::string pattern_example(std::string_view arrange) {
  return fmt::format(R"(title = "Twelve dots"

[world]
size = [16, 9]

[[pattern]]
name = "dot"
count = 12
radius = 0.4
arrange = "{}"

[[step]]
do = "insert"
bodies = ["dot"]
)",
                     arrange);
}

bool verb_has_picture(std::string_view verb) { return verb != "show"; }

std::vector<ExamplePicture> example_pictures() {
  std::vector<ExamplePicture> all = {{"looks", looks_example()}};
  for (const std::string_view arrange : arrange_names())
    all.push_back({fmt::format("arrange_{}", arrange), pattern_example(arrange)});
  all.push_back({"map", std::string(kMapExample)});
  for (const PanelKind& kind : panel_kinds())
    all.push_back({fmt::format("panel_{}", kind.name),
                   fmt::format("panels = [\"{}\"]\n{}", kind.name,
                               kind.example ? kind.example() : std::string(kWorldExample))});
  std::string world(kWorldExample), atlas(kAtlasExample), level(kLevelExample);
  for (const TableDoc& verb : language_verbs()) {
    std::string& text = is_of_atlas(verb.name) ? atlas : is_of_level(verb.name) ? level : world;
    text += fmt::format("\n{}", verb.example);
    if (verb_has_picture(verb.name)) all.push_back({fmt::format("do_{}", verb.name), text});
  }
  return all;
}

}  // namespace lantern::language
