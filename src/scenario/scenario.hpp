// A scenario as plain values, each with the place in the file it came from. The language itself,
// its keys, ranges and texts, is in language.cpp; reading it is in parse.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "geometry/box.hpp"
#include "geometry/shape.hpp"

namespace lantern {

enum class StructureKind { none, brute_force, quadtree, bsp, octree, kd_tree, sort_and_sweep };
enum class Children { eager, lazy };  // all made at a split, or each when something enters it
enum class Panel { world, tree, atlas, chart, memory };
enum class Pace { step, event };
enum class Look { ghost, player, ball, bat, disc, box };

struct PlaneSpec {
  std::string name;
  Vec<2> point{0.0};
  Vec<2> normal{0.0};
  std::string at;  // "root", or the way down from it: "front", "front.back", ...
  SourcePosition where;
};

struct StructureSpec {
  StructureKind kind = StructureKind::none;
  std::uint32_t capacity = 2;
  std::uint32_t max_depth = 6;
  Children children = Children::lazy;
  bool no_progress_stop = false;
  std::vector<PlaneSpec> planes;  // bsp only; a plane's parent stands before it
  SourcePosition where;
};

struct BodySpec {
  std::string name;
  Look look = Look::box;
  int color = 1;  // body 1 ... 8 of the theme
  Shape<2> shape;
  Vec<2> position{0.0};
  Vec<2> velocity{0.0};
  bool is_static = false;
  SourcePosition where;
};

struct TextureSpec {
  std::string name;
  int width = 0;
  int height = 0;
  int color = 1;
  SourcePosition where;
};

struct AtlasSpec {
  int width = 0;
  int height = 0;
  SourcePosition where;
};

// What must hold. Exactly one of the forms:
//   count     the count `name` equals `number`
//   leaves    body `name` is stored in `number` leaves
//   pairs     the candidate pairs are exactly these, by name
//   position  body `name` is at `position`, within `tolerance` on each axis
struct Expectation {
  enum class Kind { count, leaves, pairs, position };
  Kind kind = Kind::count;
  std::string name;
  std::int64_t number = 0;
  std::vector<std::pair<std::string, std::string>> pairs;
  Vec<2> position{0.0};
  double tolerance = 1e-9;
  SourcePosition where;
};

// The script's verbs. Bodies and textures are indices into the scenario's lists.
struct Show {};                                             // nothing happens; the caption speaks
struct Insert { std::vector<std::size_t> bodies; };         // enter world and structure
struct Remove { std::vector<std::size_t> bodies; };         // leave both; the structure is rebuilt
struct Move {                                               // set anew; the structure is rebuilt
  std::size_t body = 0;
  std::optional<Vec<2>> to;
  std::optional<Vec<2>> velocity;
};
struct Run { double seconds = 0; };                         // one frame a world step
struct Rebuild { StructureSpec structure; };                // all bodies anew, with these settings
struct Pack {                                               // textures in this order
  std::vector<std::size_t> textures;
  bool each = true;                                         // one frame a texture, or one for all
  std::string free_name;                                    // label of the largest free leaf it leaves
};
struct AskRoom { int width = 0; int height = 0; };          // does any free leaf have room?

struct Step {
  std::variant<Show, Insert, Remove, Move, Run, Rebuild, Pack, AskRoom> verb;
  std::string name;                  // for --at; may be empty
  std::string part;                  // from here on shown behind the title; may be empty
  std::string caption;               // with {count} and {count:noun}; may be empty
  std::optional<Pace> pace;          // of this step alone
  std::vector<std::string> events;   // in event pace, only these give frames; empty for all
  std::vector<Expectation> expect;   // after the step
  std::vector<Expectation> always;   // on every frame of the step
  SourcePosition where;
};

struct Scenario {
  std::string name;     // [a-z0-9_]+, from the file's name unless given; names files and folders
  std::string file;     // as it was given
  std::string title;
  std::string source;   // the part of the lecture it shows
  std::uint64_t seed = 1;
  Pace pace = Pace::step;
  std::vector<Panel> panels;         // as wished, or what `needs` derives
  Box<2> bounds;                     // of the world and of the tree's root
  double time_step = 1.0 / 60.0;     // seconds
  StructureSpec structure;
  std::optional<AtlasSpec> atlas;
  std::vector<BodySpec> bodies;      // patterns unrolled
  std::vector<TextureSpec> textures;
  std::vector<Step> steps;
  std::uint64_t text_hash = 0;       // of the file's bytes
  std::string text;                  // the file's bytes, for diagnostics of the run
};

// Throws ScenarioError with every mistake found, IoError if the file cannot be read.
Scenario load_scenario(const std::string& path);

// The same from text; `path` gives the name and is shown in messages. Never touches the disk.
Scenario parse_scenario(std::string_view text, const std::string& path);

// The line of `scenario.text` at `where`, and a diagnostic made of both.
Diagnostic diagnose(const Scenario& scenario, const SourcePosition& where, std::string message,
                    std::string suggestion = {});

std::string_view to_string(StructureKind kind);
std::string_view to_string(Children children);

}  // namespace lantern
