// Worlds of boxes for the broad phase to find the pairs of: seeded ones of the sorts that tell
// structures apart, those of a scenario, those of `bench pairs`, and a user's own.
#pragma once

#include <filesystem>

#include "language/scenario.hpp"
#include "measure/box_peer.hpp"
#include "spatial/box_worlds.hpp"

namespace lantern::measure {

struct BoxScene {
  std::string name;   // "clustered_2d": names files
  std::string words;  // "2 000 clustered boxes": begins a sentence about it
  std::variant<BoxUpdates<2>, BoxUpdates<3>> boxes;

  int dimension() const { return boxes.index() == 0 ? 2 : 3; }
};

// In two dimensions and in three: evenly spread, in clusters, one huge box among small ones, all in
// a line, and evenly spread ones that move. Seeded: the same boxes on every machine.
std::vector<BoxScene> seeded_box_scenes(std::size_t bodies, std::uint64_t seed);

// What of a scenario's bodies has entered before its first run, wait or step; where its script
// begins with those, the bodies after the first frame that shows any. Throws Refused, naming the
// scenario, if fewer than two bodies enter; ScenarioError as its script does.
BoxScene box_scene_of(const Scenario& scenario);

// --- of `bench pairs` ---

// What is wanted of it.
enum class BoxTask {
  pairs,       // all pairs, each step
  rays,        // all bodies that a segment meets
  first_hits,  // the first of them
  boxes,       // all bodies that reach into a box
  balls,       // or into a ball
  nearest,     // the body that is nearest to a point
};

struct BoxWorkload {
  std::string_view name;  // "uniform_2d"
  BoxTask task = BoxTask::pairs;
  int dimension = 2;
  std::string_view words;             // how its boxes are laid out and moved
  std::vector<std::uint64_t> bodies;  // that it is measured with if nobody says how many
  std::vector<std::uint64_t> full;    // and if all is to be measured
};
std::span<const BoxWorkload> box_workloads();

// By its name, or without its dimension: "uniform" names two. Empty for none.
std::vector<const BoxWorkload*> box_workloads_named(std::string_view name);

// Its boxes, `frames` updates one after another. Asked for again and again they go to and fro, so
// that each step is as small as the others.
BoxScene boxes_of(const BoxWorkload& workload, std::size_t bodies, std::size_t frames,
                  std::uint64_t seed);

// How many frames are kept of so many bodies: enough for them to move on, in little memory.
std::size_t frames_for(std::size_t bodies);

template <int D>
struct Questions {
  std::vector<Ray<D>> rays;
  std::vector<Box<D>> boxes;
  std::vector<Ball<D>> balls;  // and their centres, to which a body is nearest
};

// A world that all contestants get: one workload with so many bodies.
struct BoxStage {
  std::string workload;
  BoxTask task = BoxTask::pairs;
  BoxScene scene;
  std::variant<Questions<2>, Questions<3>> questions;  // of what is asked

  int dimension() const { return scene.dimension(); }
  std::size_t bodies() const;
  std::size_t frames() const;
};
BoxStage stage_of(const BoxWorkload& workload, std::size_t bodies, std::uint64_t seed);
// The first frame of a stage of pairs, with only each `part`-th of its boxes.
BoxStage thinned(const BoxStage& stage, std::size_t part);

// How many questions one step asks.
inline constexpr std::size_t kQuestions = 400;

// --- of a user's own ---

// A file that ends in .aabbs is one of Broadmark (Serpa and Rodrigues, Computer Graphics Forum
// 2020): little-endian; 128 bytes of the scene's name, 128 of the objects' type, four 32-bit
// numbers (objects, frames, 0, 0), the world's box, and for each frame each object's box; of a box
// four floats of its least and four of its greatest point, the fourth 0. Its frames are kept as far
// as `frames_for` allows.
//
// Any other file is CSV, as scenarios/bench/README.md tells; `columns` says what some are called in
// it: "x=cx,y=cy". Boxes of one frame are moved, by up to a tenth of their half sizes an axis and
// step, seeded. The scene's words tell which it is, and which columns are passed over.
//
// Throws ScenarioError with file, line and column of the first ten mistakes and the number of
// others, IoError for what cannot be read, Refused for fewer than two boxes, and for `columns`
// that are none of ours.
BoxScene read_boxes(const std::filesystem::path& file, std::uint64_t seed,
                    const std::string& columns = {});

}  // namespace lantern::measure
