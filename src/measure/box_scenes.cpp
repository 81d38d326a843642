#include "measure/box_scenes.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "geometry/flat.hpp"
#include "geometry/random_vec.hpp"
#include "scenario/director.hpp"

namespace lantern::measure {
namespace {

constexpr double kHalf = 512;     // of the world
constexpr int kMovingFrames = 8;  // updates of a moving scene
constexpr double kFastest = 12;   // units from one update to the next, on each axis
constexpr int kClusters = 20;

enum class Sort { uniform, clustered, one_huge, in_line, moving };
struct NamedSort {
  Sort sort;
  const char *name, *words;
};
constexpr NamedSort kSorts[] = {{Sort::uniform, "uniform", "{} evenly spread boxes"},
                                {Sort::clustered, "clustered", "{} clustered boxes"},
                                {Sort::one_huge, "one_huge", "one huge box among {} small ones"},
                                {Sort::in_line, "in_line", "{} boxes in a line"},
                                {Sort::moving, "moving", "{} moving boxes"}};

// Sizes are such that a body meets about one other; in three dimensions there is more room.
template <int D>
class Maker {
 public:
  Maker(Sort sort, std::uint64_t seed) : sort_(sort), random_(seed) {
    for (int i = 0; i < kClusters; ++i)
      centers_.push_back(random_point<D>(random_, -0.85 * kHalf, 0.85 * kHalf));
  }

  BoxUpdates<D> made(std::size_t bodies) {
    BoxUpdates<D> scene{{Vec<D>(-kHalf), Vec<D>(kHalf)}, {{}}};
    std::vector<Vec<D>> steps;
    for (std::size_t i = 0; i < bodies; ++i) {
      scene.frames[0].push_back({static_cast<BodyId>(i), box(i), false, true});
      steps.push_back(random_point<D>(random_, -kFastest, kFastest));
    }
    if (sort_ != Sort::moving) return scene;
    for (int frame = 1; frame < kMovingFrames; ++frame) {
      scene.frames.push_back(scene.frames.back());
      for (std::size_t i = 0; i < bodies; ++i) {
        Box<D>& moved = scene.frames.back()[i].box;
        moved = {moved.lo + steps[i], moved.hi + steps[i]};
      }
    }
    return scene;
  }

 private:
  Box<D> box(std::size_t i) {
    constexpr double kLeast = D == 2 ? 2 : 8, kMost = D == 2 ? 8 : 30;
    const Vec<D> half = random_point<D>(random_, kLeast, kMost);
    const Vec<D> anywhere = random_point<D>(random_, -kHalf + kMost, kHalf - kMost);
    if (sort_ == Sort::one_huge && i == 0)
      return Box<D>::around(Vec<D>(0.03 * kHalf), Vec<D>(0.8 * kHalf));
    if (sort_ == Sort::clustered) {
      // The sum of three even spreads is nearly a bell.
      Vec<D> away(0.0);
      for (int k = 0; k < 3; ++k) away += random_point<D>(random_, -kMost, kMost);
      return Box<D>::around(centers_[i % kClusters] + 1.5 * away, half);
    }
    if (sort_ == Sort::in_line) {  // beside the middle, where no tree cuts it lengthwise at once
      Vec<D> at(0.137 * kHalf);
      at.x = anywhere.x;
      return Box<D>::around(at, half * (0.05 * 8 / kMost));
    }
    return Box<D>::around(anywhere, half);
  }

  Sort sort_;
  Random random_;
  std::vector<Vec<D>> centers_;
};

template <int D>
BoxScene seeded(const NamedSort& s, std::size_t bodies, std::uint64_t seed) {
  const std::size_t told = s.sort == Sort::one_huge ? bodies - 1 : bodies;
  return {fmt::format("{}_{}d", s.name, D),
          fmt::format(fmt::runtime(s.words), told) + (D == 2 ? "" : " in space"),
          Maker<D>(s.sort, seed).made(bodies)};
}

template <int D>
BoxUpdates<D> updates_of(const Scenario& scenario, const Frame& frame) {
  BoxUpdates<D> scene{in_dimension<D>(scenario.world.bounds), {{}}};
  for (std::size_t i = 0; i < frame.bodies.size(); ++i)
    scene.frames[0].push_back({static_cast<BodyId>(i), in_dimension<D>(frame.bodies[i].box),
                               frame.bodies[i].is_static, true});
  return scene;
}

}  // namespace

std::vector<BoxScene> seeded_box_scenes(std::size_t bodies, std::uint64_t seed) {
  std::vector<BoxScene> scenes;
  for (const NamedSort& sort : kSorts) scenes.push_back(seeded<2>(sort, bodies, seed));
  for (const NamedSort& sort : kSorts) scenes.push_back(seeded<3>(sort, bodies, seed));
  return scenes;
}

BoxScene box_scene_of(const Scenario& scenario) {
  Frame fullest;
  Work work;
  direct(scenario, Pace::step, work, [&](const Frame& frame) {
    if (frame.bodies.size() > fullest.bodies.size() &&
        (fullest.bodies.empty() || !traits_of(scenario.steps[frame.step].verb).passes_time))
      fullest = frame;
    return fullest.bodies.empty() || !traits_of(scenario.steps[frame.step].verb).passes_time;
  });
  if (fullest.bodies.size() < 2)
    throw ScenarioError(diagnose(scenario, {scenario.file, 0, 0},
                                 "fewer than two of its bodies enter, so there is no pair"));
  BoxScene scene{
      scenario.name, fmt::format("the {} boxes of {}", fullest.bodies.size(), scenario.name), {}};
  if (scenario.world.dimension == 2)
    scene.boxes = updates_of<2>(scenario, fullest);
  else
    scene.boxes = updates_of<3>(scenario, fullest);
  return scene;
}

}  // namespace lantern::measure
