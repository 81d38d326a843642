#include "base/random.hpp"
#include "geometry/random_vec.hpp"
#include "measure/box_contest.hpp"

namespace lantern::measure {
namespace {

template <int D>
Questions<D> random_questions(const Box<D>& bounds, std::uint64_t seed) {
  Random random(seed + 1);
  const double width = bounds.size().x;
  const auto anywhere = [&] { return bounds.lo + random_point<D>(random, 0, 1) * bounds.size(); };
  Questions<D> all;
  for (std::size_t i = 0; i < kQuestions; ++i) {
    const Vec<D> from = anywhere();
    all.rays.push_back({from, random_direction<D>(random) * random.between(0.01, 0.25) * width, 1});
    all.boxes.push_back(Box<D>::around(anywhere(), random_point<D>(random, 0, 5)));
    all.balls.push_back({anywhere(), random.between(0, 5)});
  }
  return all;
}

template <int D>
BoxUpdates<D> each(const BoxUpdates<D>& all, std::size_t part) {
  BoxUpdates<D> few{all.bounds, {{}}};
  for (std::size_t i = 0; i < all.frames[0].size(); i += part) {
    few.frames[0].push_back(all.frames[0][i]);
    few.frames[0].back().id = static_cast<BodyId>(i / part);
  }
  return few;
}

}  // namespace

std::size_t BoxStage::bodies() const {
  return std::visit([](const auto& all) { return all.frames[0].size(); }, scene.boxes);
}
std::size_t BoxStage::frames() const {
  return std::visit([](const auto& all) { return all.frames.size(); }, scene.boxes);
}

BoxStage stage_of(const BoxWorkload& workload, std::size_t bodies, std::uint64_t seed) {
  const std::size_t frames = workload.task == BoxTask::pairs ? frames_for(bodies) : 1;
  BoxStage stage{std::string(workload.name), workload.task,
                 boxes_of(workload, bodies, frames, seed), Questions<2>{}};
  if (workload.task == BoxTask::pairs) return stage;
  if (stage.dimension() == 2)
    stage.questions = random_questions(std::get<BoxUpdates<2>>(stage.scene.boxes).bounds, seed);
  else
    stage.questions = random_questions(std::get<BoxUpdates<3>>(stage.scene.boxes).bounds, seed);
  return stage;
}

BoxStage thinned(const BoxStage& stage, std::size_t part) {
  BoxStage few{stage.workload, stage.task, {stage.scene.name, stage.scene.words, {}}, {}};
  std::visit([&](const auto& all) { few.scene.boxes = each(all, part); }, stage.scene.boxes);
  return few;
}

}  // namespace lantern::measure
