// What has not changed does not move: on whole pages, from each frame of a sequence to the next.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "draw/layout_check.hpp"
#include "draw/page.hpp"
#include "draw/sample_frames.hpp"
#include "scenario/directing.hpp"

namespace lantern::draw {
namespace {

using Places = std::map<std::string, Box<2>>;

// Where the things of a kind are drawn, by their keys: all of it, or its first shape, without the
// marks that it carries.
Places places_of(const DrawList& list, const std::string& kind, bool first_shape) {
  Places places;
  for (std::size_t i = 0; i < list.runs.size(); ++i) {
    const KeyedRun& run = list.runs[i];
    const std::size_t end = i + 1 < list.runs.size() ? list.runs[i + 1].first : list.shapes.size();
    if (run.key.find(kind) == std::string::npos) continue;
    for (std::size_t k = run.first; k < end; ++k) {
      if (std::holds_alternative<TextShape>(list.shapes[k])) continue;
      const Box<2> reach = reach_of(list.shapes[k]);
      const auto [at, is_new] = places.try_emplace(run.key, reach);
      if (!is_new && !first_shape) at->second = united(at->second, reach);
    }
  }
  return places;
}

std::set<std::string> keys_of(const Places& places) {
  std::set<std::string> keys;
  for (const auto& [key, place] : places) keys.insert(key);
  return keys;
}

// Does it share its place with others? Then they are fanned out, and move when one comes or goes.
bool stands_alone(const FrameBody& body, const Frame& frame) {
  return std::ranges::count_if(frame.bodies, [&](const FrameBody& other) {
           return glm::distance(other.position, body.position) < 0.1 * body.box.size().x;
         }) == 1;
}

// Bodies that look the same on both frames, by name. Of a crowd only marks are drawn.
std::set<std::string> unchanged(const Frame& a, const Frame& b) {
  constexpr std::size_t kCrowded = 100;
  std::set<std::string> names;
  if (std::max(a.bodies.size(), b.bodies.size()) > kCrowded) return names;
  for (const FrameBody& before : a.bodies)
    for (const FrameBody& after : b.bodies)
      if (before.id == after.id && before.box.lo == after.box.lo && before.box.hi == after.box.hi &&
          before.lit == after.lit && before.dimmed == after.dimmed &&
          before.asleep == after.asleep && before.velocity == after.velocity &&
          stands_alone(before, a) && stands_alone(after, b))
        names.insert(before.name);
  return names;
}

bool is_seen_alike(const Frame& a, const Frame& b) {
  const auto camera = [](const Frame& f) {
    return f.camera ? std::pair{f.camera->eye, f.camera->target} : std::pair{Vec<3>(), Vec<3>()};
  };
  if (a.view.has_value() != b.view.has_value() || camera(a) != camera(b)) return false;
  return !a.view || (a.view->lo == b.view->lo && a.view->hi == b.view->hi);
}

// In an AABB tree a rotation gives a node's place, and with it its name, to another one.
bool is_rearranged(const Frame& a, const Frame& b) {
  for (std::size_t i = 0; i < a.sides.size(); ++i)
    if (is_rearranged(a.sides[i], b.sides[i])) return true;
  const auto same = [](const FrameNode& before, const FrameNode& after) {
    return before.label == after.label && before.bodies == after.bodies;
  };
  return a.structure == StructureKind::aabb_tree && !std::ranges::equal(a.nodes, b.nodes, same);
}

void expect_still(const Frame& a, const Frame& b, const DrawList& before, const DrawList& after) {
  const std::string where = a.scenario + ", frame " + std::to_string(b.index);
  if (is_seen_alike(a, b)) {
    const Places from = places_of(before, "world/body/", false),
                 to = places_of(after, "world/body/", false);
    for (const std::string& name : unchanged(a, b)) {
      const auto old = from.find("world/body/" + name), now = to.find("world/body/" + name);
      if (old == from.end() || now == to.end()) continue;
      EXPECT_NEAR(glm::distance(old->second.center(), now->second.center()), 0, 0.01)
          << where << ": " << name;
    }
  }
  const Places from = places_of(before, "tree/node/", true),
               to = places_of(after, "tree/node/", true);
  if (keys_of(from) != keys_of(to) || is_rearranged(a, b)) return;  // another folding
  for (const auto& [key, box] : from)
    EXPECT_NEAR(glm::distance(box.center(), to.at(key).center()), 0, 0.01) << where << ": " << key;
}

class EveryPageTurned : public testing::TestWithParam<std::string> {};

TEST_P(EveryPageTurned, LeavesWhatHasNotChangedWhereItIs) {
  const std::vector<Frame> frames = run::frames_of(GetParam());
  for (std::span<const Frame> rest = frames; !rest.empty();) {
    const std::span<const Frame> group = Staging::first_group(rest);
    const Staging staging{group};
    DrawList before;
    for (std::size_t i = 0; i < std::min<std::size_t>(group.size(), 12); ++i) {
      Work work;
      DrawList now = draw_frame(group[i], staging, page_for(1600, 900), work);
      if (i > 0) expect_still(group[i - 1], group[i], before, now);
      before = std::move(now);
    }
    rest = rest.subspan(group.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryPageTurned, testing::ValuesIn(run::all_scenarios()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace lantern::draw
