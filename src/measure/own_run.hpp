// A scenario's own run at a much finer step, as the metric of its other runs.
#pragma once

#include <memory>
#include <vector>

#include "measure/error_metric.hpp"

namespace lantern {

// Keeps every moment.
class Recorder : public ErrorMetric {
 public:
  explicit Recorder(std::vector<Observation>& record) : record_(record) {}
  void look(const Observation& now) override { record_.push_back(now); }
  std::vector<Norm> norms() const override { return {}; }

 private:
  std::vector<Observation>& record_;
};

// "traj": the largest distance from the record over the run, of places against the way that the
// body that moves most has gone from where it began, of velocities against the largest speed.
class OwnRun : public ErrorMetric {
 public:
  explicit OwnRun(std::shared_ptr<const std::vector<Observation>> record);
  void look(const Observation& now) override;
  std::vector<Norm> norms() const override { return {{"traj", worst_}}; }

 private:
  std::shared_ptr<const std::vector<Observation>> record_;
  double way_ = 0, speed_ = 0;
  std::size_t next_ = 0;
  double worst_ = 0;
};

}  // namespace lantern
