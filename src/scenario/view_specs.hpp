// What a scenario says of its pictures rather than of its world: what is shown, which part of the
// world, from where, and the notes beside it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "geometry/vec.hpp"

namespace lantern::scenario {

// Whose names stand beside bodies: of many bodies only of those that the frame is about, of all as
// far as there is room, or of none.
enum class ShownNames { story, all, none };

// What a frame shows of what there is. A mark that is off is neither drawn nor named.
inline constexpr int kMostTrail = 64;

struct Display {
  ShownNames names = ShownNames::story;
  bool pairs = true;
  bool contacts = true;
  bool arrows = false;  // velocities
  bool forces = false;  // of scripts and springs, with their sizes
  bool cells = true;    // of the world panel: borders, grounds and names
  bool not_made = true;
  bool fill = false;
  bool boxes = false;        // the bodies' broad-phase boxes
  bool depths = false;       // beside contacts
  bool coordinates = false;  // of the lit way's borders, at the world's edges
  int trail = 0;             // so many world steps back, where moving bodies were
  bool counters = true;
  bool title = true;
  bool caption = true;
  bool settings = true;  // of the structure, under its tree
  bool legend = false;

  bool operator==(const Display&) const = default;
};

// Which part of a 2D world is shown; without `at`, all of it.
struct ViewSpec {
  std::optional<Vec<3>> at;  // its middle
  double width = 0;
  SourcePosition where;
};

// From where a 3D world is seen.
struct CameraSpec {
  Vec<3> eye{0.0};
  Vec<3> target{0.0};
  SourcePosition where;
};

// What a note's line leads to.
enum class NoteOf { body, node, point, pair, count };

// A few words beside what they are about.
struct NoteSpec {
  std::string text;  // with {count}, as a caption
  NoteOf of = NoteOf::point;
  std::vector<std::size_t> bodies;  // one, or the two of a pair
  std::string name;                 // of the node or count
  Vec<3> point{0.0};
  SourcePosition where;
};

// Which function of the lecture's source a step is about, and which of its lines.
struct CodeSpec {
  std::string function;
  std::string line;  // each line with this text in it is lit; empty: none
  SourcePosition where;
};

inline std::vector<std::string_view> names(ShownNames) { return {"story", "all", "none"}; }

}  // namespace lantern::scenario
