#include "measure/box_truth.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "measure/broad_phase_cost.hpp"
#include "spatial/query.hpp"

namespace lantern::measure {

BoxTruth::BoxTruth(const BoxStage& stage, std::size_t frame) {
  stage.dimension() == 2 ? force<2>(stage, frame) : force<3>(stage, frame);
}

template <int D>
void BoxTruth::force(const BoxStage& stage, std::size_t frame) {
  const std::vector<Proxy<D>>& boxes = std::get<BoxUpdates<D>>(stage.scene.boxes).frames[frame];
  if (stage.task != BoxTask::pairs)
    answer<D>(stage);
  else if (boxes.size() <= kMostForced)
    truth_ = pairs_by_force<D>(boxes);
  else
    force_sample<D>(boxes);
}

template <int D>
void BoxTruth::force_sample(Boxes<D> boxes) {
  is_sample_ = true;
  stride_ = boxes.size() / kSample;
  for (std::size_t i = 0; i < boxes.size(); i += stride_) {
    stop_if_asked();
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (j == i || (j % stride_ == 0 && j < i)) continue;
      if ((boxes[i].is_static && boxes[j].is_static) || !overlap(boxes[i].box, boxes[j].box))
        continue;
      truth_.push_back({std::min(boxes[i].id, boxes[j].id), std::max(boxes[i].id, boxes[j].id)});
    }
  }
  std::sort(truth_.begin(), truth_.end());
}

template <int D>
void BoxTruth::answer(const BoxStage& stage) {
  const Boxes<D> boxes = std::get<BoxUpdates<D>>(stage.scene.boxes).frames[0];
  const auto& q = std::get<Questions<D>>(stage.questions);
  for (std::uint32_t i = 0; i < kQuestions; ++i) {
    stop_if_asked();
    std::optional<RayHit> best;
    for (const Proxy<D>& body : boxes) {
      const auto span = span_in(q.rays[i], body.box);
      const bool is_met = stage.task == BoxTask::boxes   ? overlap(q.boxes[i], body.box)
                          : stage.task == BoxTask::balls ? overlap(q.balls[i], body.box)
                                                         : span.has_value();
      if (!is_met) continue;
      if (stage.task != BoxTask::first_hits)
        truth_.push_back({i, body.id});
      else if (const RayHit hit{body.id, span->from}; !best || RayHit::before(hit, *best))
        best = hit;
    }
    if (best) truth_.push_back({i, best->id});
  }
}

BoxTruth::Verdict BoxTruth::judge(std::span<const Pair> found) const {
  if (!is_sample_) return {count_missing(truth_, found), count_missing(found, truth_)};
  std::vector<Pair> of_sample;
  for (const Pair& pair : found)
    if (pair.a % stride_ == 0 || pair.b % stride_ == 0) of_sample.push_back(pair);
  return {count_missing(truth_, of_sample), count_missing(of_sample, truth_)};
}

std::string BoxTruth::words() const {
  if (!is_sample_) return "brute force";
  return fmt::format("brute force of every {}th body", stride_);
}

}  // namespace lantern::measure
