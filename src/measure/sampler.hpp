// How error and energy of a run go with time.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/error_metric.hpp"
#include "measure/invariants.hpp"
#include "measure/schedule.hpp"

namespace lantern::measure {

// Writes down how error and energy have gone, about a dozen times, further and further apart.
class Sampler : public ErrorMetric {
 public:
  Sampler(ErrorMetric& metric, const DriftMeter& meter, const Schedule& schedule)
      : metric_(metric), meter_(meter) {
    for (const Leg& leg : schedule.legs) looks_ += leg.looks;
    growth_ = std::max(1.0, std::pow(looks_, 1.0 / kSamples));
  }

  void look(const Observation& now) override {
    metric_.look(now);
    const double seen = seen_++;
    if (seen < next_ && seen < looks_) return;
    if (seen > 0)
      samples_.push_back({now.time, metric_.norms().front().value, meter_.drift().energy});
    next_ = std::max(seen + 1, std::floor(seen * growth_));
  }
  void interfere(const Observation& now, Simulation& simulation) override {
    metric_.interfere(now, simulation);
  }
  std::vector<Norm> norms() const override { return metric_.norms(); }
  const std::vector<DriftSample>& samples() const { return samples_; }

 private:
  static constexpr double kSamples = 12;

  ErrorMetric& metric_;
  const DriftMeter& meter_;
  double looks_ = 0, seen_ = 0, next_ = 1, growth_ = 1;
  std::vector<DriftSample> samples_;
};

}  // namespace lantern::measure
