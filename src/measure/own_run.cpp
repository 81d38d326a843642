#include "measure/own_run.hpp"

#include <algorithm>
#include <limits>

#include "base/check.hpp"

namespace lantern {

OwnRun::OwnRun(std::shared_ptr<const std::vector<Observation>> record)
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

void OwnRun::look(const Observation& now) {
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

}  // namespace lantern
