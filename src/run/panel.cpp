#include "run/panel.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "frame/parts/level.hpp"
#include "run/frame_maker.hpp"

namespace lantern::run {
namespace {

// What is in one of a frame's parts.
template <class P>
bool has_part(const Frame& frame) {
  return frame.find<P>() != nullptr;
}
template <class P, auto member>
bool lists(const Frame& frame) {
  return !(frame.get<P>().*member).empty();
}
bool has_points(const Frame& frame) {
  const FrameChart& chart = frame.get<FrameChart>();
  return !chart.bars.empty() || std::ranges::any_of(chart.series, [](const FrameSeries& line) {
    return !line.points.empty();
  });
}

std::vector<PanelRun>& runs() {
  static std::vector<PanelRun> all = {
      {.name = "world",
       .shows = {{"bodies", [](const Frame& f) { return !f.bodies.empty(); }},
                 {"walls", lists<FrameLevel, &FrameLevel::walls>}}},
      {.name = "tree", .shows = {{"nodes", [](const Frame& f) { return !f.nodes.empty(); }}}},
      {.name = "atlas",
       .shows = {{"textures", [](const Frame& f) { return f.count("textures").value_or(0) > 0; }}}},
      {.name = "chart", .shows = {{"points or bars", has_points}}},
      {.name = "memory",
       .shows = {{"the leaves' array",
                  [](const Frame& f) { return f.get<FrameStructure>().array_size > 0; }}}},
      {.name = "ledger",
       .shows = {{"two bodies or more", [](const Frame& f) { return f.bodies.size() > 1; }}}},
      {.name = "pool",
       .shows = {{"a pool of nodes",
                  [](const Frame& f) { return f.get<FrameStructure>().pool_size > 0; }}}},
      {.name = "bytes",
       .shows = {{"bytes of nodes",
                  [](const Frame& f) { return f.count("node_bytes").value_or(0) > 0; }}}},
      {.name = "sparkline",
       .stage = "sparkline",
       .shows = {{"a line so far", lists<FrameTrace, &FrameTrace::points>}}},
      {.name = "difference",
       .shows = {{"the difference of two bodies", has_part<FrameDifference>}}},
      {.name = "axes", .shows = {{"axes of two bodies", has_part<FrameSeparation>}}},
      {.name = "comparison",
       .shows = {{"worlds compared", lists<FrameComparison, &FrameComparison::rows>}}},
      {.name = "islands", .shows = {{"islands", lists<FrameIslands, &FrameIslands::islands>}}},
      {.name = "code", .shows = {{"lines of code", has_part<FrameCode>}}},
      {.name = "collisions",
       .stage = "collisions",
       .shows = {{"a collision", lists<FrameCollisions, &FrameCollisions::rows>}}},
      {.name = "matrix",
       .shows = {{"sectors to see", lists<FrameMatrix, &FrameMatrix::rows>}},
       .gather =
           [](const Stage& stage, Frame& frame) {
             if (stage.level) stage.level->picture_matrix(frame);
           }},
      {.name = "screen", .shows = {{"a drawn screen", lists<FrameScreen, &FrameScreen::ways>}}},
  };
  return all;
}

}  // namespace

const PanelRun& run_of(Panel panel) {
  const auto found = std::ranges::find(runs(), kind_of(panel).name, &PanelRun::name);
  LANTERN_CHECK(found != runs().end(), ==, true);
  return *found;
}

void add_panel(const PanelKind& kind, PanelRun run) {
  language::add_panel(kind);
  run.name = kind.name;
  runs().push_back(std::move(run));
}

}  // namespace lantern::run
