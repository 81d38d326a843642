#include "spatial/box_worlds.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "base/random.hpp"
#include "base/stop.hpp"
#include "geometry/elementary.hpp"
#include "geometry/random_vec.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
namespace {

constexpr double kHalf = 512;     // of the world
constexpr int kMovingFrames = 8;  // updates of a moving scene
constexpr double kFastest = 12;   // units from one update to the next, on each axis
constexpr int kClusters = 20;
constexpr std::size_t kHeap = 12;

constexpr std::int64_t kMostBodies = 24;

struct TrialSort {
  std::string_view name;
  TrialBody (*body)(const Box<2>& bounds, Random& random);
};

Vec<2> somewhere(const Box<2>& bounds, Random& random) {
  return {random.between(bounds.lo.x, bounds.hi.x), random.between(bounds.lo.y, bounds.hi.y)};
}

constexpr TrialSort kTrialSorts[] = {
    {"uniform",
     [](const Box<2>& bounds, Random& random) {
       return TrialBody{somewhere(bounds, random), random_point<2>(random, 0, 6)};
     }},
    {"clustered",
     [](const Box<2>& bounds, Random& random) {
       const double at = random.bits() % 2 == 0 ? 0.15 : 0.64;
       return TrialBody{bounds.lo + bounds.size() * at + random_point<2>(random, 0, 2),
                        random_point<2>(random, 0, 1)};
     }},
    {"coincident",
     [](const Box<2>& bounds, Random&) {
       return TrialBody{bounds.lo + bounds.size() * 0.375, Vec<2>(1.5)};
     }},
    {"on borders",  // edges lie exactly on those of cells
     [](const Box<2>& bounds, Random& random) {
       TrialBody body;
       for (int i = 0; i < 2; ++i) {
         const double cell = bounds.size()[i] / 16;
         const auto from = static_cast<double>(random.whole(0, 14));
         const auto cells = static_cast<double>(random.whole(0, 2));
         body.half[i] = cell * cells / 2;
         body.center[i] = bounds.lo[i] + cell * from + body.half[i];
       }
       return body;
     }},
    {"large and small",
     [](const Box<2>& bounds, Random& random) {
       const double size = bounds.size().x * geometry::pow(10.0, random.between(-6, 1));
       return TrialBody{somewhere(bounds, random), random_point<2>(random, 0, size)};
     }},
    {"points",
     [](const Box<2>& bounds, Random& random) {
       return TrialBody{somewhere(bounds, random), Vec<2>(0.0)};
     }},
    {"outside",
     [](const Box<2>& bounds, Random& random) {
       const Vec<2> size = bounds.size();
       return TrialBody{somewhere({bounds.lo - size, bounds.hi + size}, random),
                        random_point<2>(random, 0, 30)};
     }},
};

constexpr std::array<Box<2>, 3> kTrialBounds = {
    Box<2>{Vec<2>(0.0), Vec<2>(64.0)}, Box<2>{{-32, -32}, {32, 32}}, Box<2>{{96, -16}, {224, 48}}};

}  // namespace

// Sizes are such that a body meets about one other; in three dimensions there is more room.
template <int D>
BoxUpdates<D> seeded_boxes(BoxSort sort, std::size_t bodies, std::uint64_t seed) {
  constexpr double kLeast = D == 2 ? 2 : 8, kMost = D == 2 ? 8 : 30;
  Random random(seed);
  std::vector<Vec<D>> centers, steps;
  for (int i = 0; i < kClusters; ++i)
    centers.push_back(random_point<D>(random, -0.85 * kHalf, 0.85 * kHalf));
  const auto box = [&](std::size_t i) {
    const Vec<D> half = random_point<D>(random, kLeast, kMost);
    const Vec<D> anywhere = random_point<D>(random, -kHalf + kMost, kHalf - kMost);
    if (sort == BoxSort::one_huge && i == 0)
      return Box<D>::around(Vec<D>(0.03 * kHalf), Vec<D>(0.8 * kHalf));
    if (sort == BoxSort::clustered) {
      // The sum of three even spreads is nearly a bell.
      Vec<D> away(0.0);
      for (int k = 0; k < 3; ++k) away += random_point<D>(random, -kMost, kMost);
      return Box<D>::around(centers[i % kClusters] + 1.5 * away, half);
    }
    if (sort == BoxSort::in_line) {  // beside the middle, where no tree cuts it lengthwise at once
      Vec<D> at(0.137 * kHalf);
      at.x = anywhere.x;
      return Box<D>::around(at, half * (0.05 * 8 / kMost));
    }
    return Box<D>::around(anywhere, half);
  };
  BoxUpdates<D> scene{{Vec<D>(-kHalf), Vec<D>(kHalf)}, {{}}};
  for (std::size_t i = 0; i < bodies; ++i) {
    scene.frames[0].push_back({static_cast<BodyId>(i), box(i), false, true});
    steps.push_back(random_point<D>(random, -kFastest, kFastest));
  }
  if (sort == BoxSort::coincident)
    for (std::size_t i = kHeap; i < bodies; ++i)
      if (i / kHeap % 2 == 1) scene.frames[0][i].box = scene.frames[0][i / kHeap * kHeap].box;
  if (sort != BoxSort::moving) return scene;
  for (int frame = 1; frame < kMovingFrames; ++frame) {
    scene.frames.push_back(scene.frames.back());
    for (std::size_t i = 0; i < bodies; ++i) {
      Box<D>& moved = scene.frames.back()[i].box;
      moved = {moved.lo + steps[i], moved.hi + steps[i]};
    }
  }
  return scene;
}
template BoxUpdates<2> seeded_boxes<2>(BoxSort, std::size_t, std::uint64_t);
template BoxUpdates<3> seeded_boxes<3>(BoxSort, std::size_t, std::uint64_t);

template <int D>
std::vector<Pair> pairs_by_force(std::span<const Proxy<D>> boxes) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    stop_if_asked();
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (!(boxes[i].is_static && boxes[j].is_static) && overlap(boxes[i].box, boxes[j].box))
        pairs.push_back({std::min(boxes[i].id, boxes[j].id), std::max(boxes[i].id, boxes[j].id)});
  }
  sort_pairs(pairs);
  return pairs;
}
template std::vector<Pair> pairs_by_force<2>(std::span<const Proxy<2>>);
template std::vector<Pair> pairs_by_force<3>(std::span<const Proxy<3>>);

std::uint64_t count_missing(std::span<const Pair> truth, std::span<const Pair> found) {
  std::vector<Pair> missing;
  std::ranges::set_difference(truth, found, std::back_inserter(missing));
  return missing.size();
}

// --- small ones, on which a structure is tried ---

TrialWorld trial_world(std::uint64_t seed, std::uint64_t number) {
  Random random(seed * 0x9e3779b97f4a7c15u + number);
  const TrialSort& sort = kTrialSorts[number % std::size(kTrialSorts)];
  TrialWorld world{sort.name, kTrialBounds[static_cast<std::size_t>(random.whole(0, 2))], 1, 1, {},
                   {}};
  world.capacity = static_cast<std::uint32_t>(random.whole(1, 4));
  world.max_depth = static_cast<std::uint32_t>(random.whole(1, 5));
  const std::int64_t bodies = random.whole(0, kMostBodies);
  for (std::int64_t i = 0; i < bodies; ++i) world.bodies.push_back(sort.body(world.bounds, random));
  const bool moves = random.bits() % 4 == 0;
  for (std::int64_t i = 0; moves && i < bodies; ++i)
    world.moved.push_back(sort.body(world.bounds, random));
  return world;
}

}  // namespace lantern::spatial
