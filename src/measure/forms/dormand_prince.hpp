// Dormand and Prince's pair (physics/integrate/dormand_prince.hpp), with the step chosen by the
// error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "base/stop.hpp"
#include "physics/integrate/dormand_prince.hpp"

namespace lantern::measure {

template <class Real>
class DormandPrince {
 public:
  using State = std::vector<Real>;

  // Each step's error is kept below `tolerance` > 0 times `scale` of each component (all above 0).
  DormandPrince(Real tolerance, State scale) : tolerance_(tolerance), scale_(std::move(scale)) {}

  // From `time` to `end` >= time. `slope(t, y, dy)` gives the rates of change dy, of the same size.
  // Throws Refused if the step vanishes: below a billionth of the time to go, as where bodies fall
  // into each other.
  void run(const auto& slope, Real time, Real end, State& y) {
    if (!(end > time)) return;
    for (State& k : k_) k.resize(y.size());
    slope(time, y, k_[0]);
    if (!(step_ > 0)) step_ = first_step(y, end - time);
    const Real least = (end - time) * Real(1e-9);
    while (time < end) {
      stop_if_asked();
      const bool last = step_ >= end - time;
      const Real h = last ? end - time : step_;
      if (!(time + h > time) || (step_ < least && !last))
        throw Refused("dormand_prince: its step vanishes");
      const Real error = attempt(slope, time, h, y);
      if (error <= 1) {
        time = last ? end : time + h;
        y.swap(next_);
        k_[0].swap(k_[6]);  // the last slope is the next step's first
        ++steps_;
      }
      const Real factor = growth(error);
      if (!last || factor < 1) step_ = h * factor;
    }
  }

  std::uint64_t steps() const { return steps_; }  // taken so far

 private:
  // A step that changes nothing by more than a hundredth of its scale.
  Real first_step(const State& y, Real most) const {
    Real h = most;
    for (std::size_t i = 0; i < y.size(); ++i)
      if (k_[0][i] != 0) h = std::min(h, scale_[i] / std::abs(k_[0][i]) / 100);
    return h;
  }

  // Leaves the end of the step in next_ and its slope in k_[6]; gives the error, where 1 is
  // allowed.
  Real attempt(const auto& slope, Real time, Real h, const State& y) {
    static constexpr Real kE[7] = {Real(71) / 57600,      0,
                                   Real(-71) / 16695,     Real(71) / 1920,
                                   Real(-17253) / 339200, Real(22) / 525,
                                   Real(-1) / 40};
    next_.resize(y.size());
    for (int stage = 0; stage < 6; ++stage) {
      for (std::size_t i = 0; i < y.size(); ++i) {
        Real sum = 0;
        for (int j = 0; j <= stage; ++j) sum += kDormandPrince[stage][j] * k_[j][i];
        next_[i] = y[i] + h * sum / kDormandPrince[stage][6];
      }
      slope(time + time_of_stage<Real>(stage) * h, next_, k_[stage + 1]);
    }
    Real worst = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      Real sum = 0;
      for (int j = 0; j < 7; ++j) sum += kE[j] * k_[j][i];
      const Real error = std::abs(h * sum) / (tolerance_ * scale_[i]);
      if (!std::isfinite(error)) return error;
      worst = std::max(worst, error);
    }
    return worst;
  }

  // Proportional and integral control (Hairer and Wanner, "Solving ordinary differential equations
  // II", 1996, section IV.2).
  Real growth(Real error) {
    if (!std::isfinite(error)) return Real(0.1);
    const Real e = std::max(error, Real(1e-10));
    const Real factor = Real(0.9) * std::pow(e, Real(-0.17)) * std::pow(before_, Real(0.04));
    if (error > 1) return std::max(Real(0.2), std::min(factor, Real(0.9)));
    before_ = e;
    return std::clamp(factor, Real(0.2), Real(5));
  }

  Real tolerance_;
  State scale_;
  State k_[7] = {};
  State next_;
  Real step_ = 0;
  Real before_ = Real(1e-4);
  std::uint64_t steps_ = 0;
};

}  // namespace lantern::measure
