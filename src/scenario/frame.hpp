// One picture's worth of facts, as plain values from the engine. All that is drawn or written as
// JSON is here; nothing of it is computed by whoever draws.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/polygon.hpp"
#include "scenario/scenario.hpp"
#include "spatial/structure.hpp"

namespace lantern {

// What the current step did to a node.
enum class Mark { quiet, passed, lit };

struct FrameBody {
  BodyId id = 0;
  std::string name;
  Look look = Look::box;
  int color = 1;
  Shape<2> shape;
  Vec<2> position{0.0};
  Vec<2> velocity{0.0};
  double orientation = 0;       // radians, counter-clockwise
  double angular_momentum = 0;
  Box<2> box;                   // in the broad phase
  bool is_static = false;
  bool asleep = false;
  bool lit = false;             // the step is about it
};

struct FrameNode {
  std::uint32_t id = 0;         // position in the order of visiting
  std::uint32_t parent = kNone;
  std::uint32_t slot = 0;       // which child of its parent
  std::uint32_t depth = 0;
  std::string label;            // "root", "1", "1.3"; of a BSP "back", "front.back"; of an atlas "C"
  Box<2> box;                   // an atlas counts pixels, y down
  std::optional<Plane<2>> plane;  // a BSP's inner nodes
  std::string plane_name;
  Polygon region;               // a BSP's, cut to the world's bounds; otherwise empty
  bool leaf = true;
  bool awake = true;
  std::vector<BodyId> bodies;   // a leaf's, ascending; of an atlas, textures
  bool cut_vertically = false;  // an atlas's inner nodes
  bool over_capacity = false;   // holds more than its limit: at the depth limit, or no progress
  Mark mark = Mark::quiet;
};

struct FrameTexture {
  std::uint32_t id = 0;
  std::string name;
  int color = 1;
  int width = 0;
  int height = 0;
  bool packed = false;
  bool refused = false;
  int x = 0;                    // of a packed one, upper left corner
  int y = 0;
};

struct FramePair {
  Pair pair;
  bool lit = false;             // new since the frame before
};

struct Frame {
  std::string scenario;
  std::string title;
  std::string part;
  std::uint64_t seed = 1;
  std::uint32_t index = 0;       // of this frame, from 0
  std::uint32_t step = 0;        // of the script, from 0
  std::uint32_t steps = 0;
  std::string event;             // the step's name or the algorithm's event; for --at
  double time = 0;               // seconds of world time
  std::string caption;           // counts filled in
  StructureKind structure = StructureKind::none;
  std::string settings;          // "capacity 2, depth limit 4": what the tree was told
  std::vector<Panel> panels;
  Box<2> bounds;
  std::vector<FrameBody> bodies;
  std::vector<FrameNode> nodes;  // parents before children
  std::vector<FramePair> pairs;  // in order of ids
  std::vector<FrameTexture> textures;
  std::vector<std::pair<std::string, std::int64_t>> counts;  // in a fixed order
  std::uint64_t hash = 0;        // of all of the above that is state

  // Nothing if the scene does not count this.
  std::optional<std::int64_t> count(std::string_view name) const;
};

// The frame as `lantern.frame/1`, one line a body, node and pair.
std::string to_json(const Frame& frame);

}  // namespace lantern
