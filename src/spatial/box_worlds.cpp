#include "spatial/box_worlds.hpp"

#include <algorithm>
#include <iterator>

#include "base/random.hpp"
#include "base/stop.hpp"
#include "geometry/random_vec.hpp"
#include "spatial/pairs.hpp"

namespace lantern::spatial {
namespace {

constexpr double kHalf = 512;     // of the world
constexpr int kMovingFrames = 8;  // updates of a moving scene
constexpr double kFastest = 12;   // units from one update to the next, on each axis
constexpr int kClusters = 20;

// Sizes are such that a body meets about one other; in three dimensions there is more room.
template <int D>
class Maker {
 public:
  Maker(BoxSort sort, std::uint64_t seed) : sort_(sort), random_(seed) {
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
    if (sort_ != BoxSort::moving) return scene;
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
    if (sort_ == BoxSort::one_huge && i == 0)
      return Box<D>::around(Vec<D>(0.03 * kHalf), Vec<D>(0.8 * kHalf));
    if (sort_ == BoxSort::clustered) {
      // The sum of three even spreads is nearly a bell.
      Vec<D> away(0.0);
      for (int k = 0; k < 3; ++k) away += random_point<D>(random_, -kMost, kMost);
      return Box<D>::around(centers_[i % kClusters] + 1.5 * away, half);
    }
    if (sort_ == BoxSort::in_line) {  // beside the middle, where no tree cuts it lengthwise at once
      Vec<D> at(0.137 * kHalf);
      at.x = anywhere.x;
      return Box<D>::around(at, half * (0.05 * 8 / kMost));
    }
    return Box<D>::around(anywhere, half);
  }

  BoxSort sort_;
  Random random_;
  std::vector<Vec<D>> centers_;
};

}  // namespace

template <int D>
BoxUpdates<D> seeded_boxes(BoxSort sort, std::size_t bodies, std::uint64_t seed) {
  return Maker<D>(sort, seed).made(bodies);
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

}  // namespace lantern::spatial
