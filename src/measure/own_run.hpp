// A scenario without a known answer is held against a record of its own finer run.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "base/check.hpp"
#include "measure/error_metric.hpp"

namespace lantern::measure {

// Keeps every moment.
class Recorder : public ErrorMetric {
 public:
  void look(const Observation& now) override { record_->push_back(now); }
  std::vector<Norm> norms() const override { return {}; }
  std::shared_ptr<const std::vector<Observation>> record() const { return record_; }

 private:
  std::shared_ptr<std::vector<Observation>> record_ = std::make_shared<std::vector<Observation>>();
};

// The distance from a record: of places over the way that the body that moves most has gone from
// where it began, of velocities over the largest speed.
class OwnRun : public ErrorMetric {
 public:
  explicit OwnRun(std::shared_ptr<const std::vector<Observation>> record)
      : record_(std::move(record)) {
    const std::size_t bodies = record_->empty() ? 0 : record_->front().states.size();
    for (std::size_t i = 0; i < bodies; ++i) {
      const BodyState* first = nullptr;
      for (const Observation& moment : *record_) {
        const BodyState& state = moment.states[i];
        if (!state.there) continue;
        if (!first) first = &state;
        way_ = std::max(way_, glm::length(state.position - first->position));
        speed_ = std::max(speed_, glm::length(state.velocity));
      }
    }
  }

  void look(const Observation& now) override {
    LANTERN_CHECK(next_, <, record_->size());
    const Observation& then = (*record_)[next_++];
    const auto against = [](double error, double scale) {
      if (error == 0) return 0.0;
      return scale > 0 ? error / scale : std::numeric_limits<double>::infinity();
    };
    for (std::size_t i = 0; i < now.states.size(); ++i) {
      const BodyState &a = now.states[i], &b = then.states[i];
      if (!a.there || !b.there) continue;
      worst_ = std::max({worst_, against(glm::length(a.position - b.position), way_),
                         against(glm::length(a.velocity - b.velocity), speed_)});
    }
  }
  std::vector<Norm> norms() const override { return {trajectory_norm(worst_, way_, speed_)}; }

 private:
  std::shared_ptr<const std::vector<Observation>> record_;
  double way_ = 0, speed_ = 0;
  std::size_t next_ = 0;
  double worst_ = 0;
};

}  // namespace lantern::measure
