// Energy that comes from nowhere: in a scene without motor, brain or script's force it never grows.
#pragma once

#include <optional>
#include <string>

#include "frame/frame.hpp"
#include "fuzz/sees_all.hpp"
#include "language/scenario.hpp"

namespace lantern::fuzz {

class EnergyMeter {
 public:
  explicit EnergyMeter(const Scenario& scenario);

  void look(const Frame& frame);

  // The largest growth so far, as a part of the motion there was and of the height that was fallen.
  double growth() const { return growth_; }

 private:
  const Scenario& scenario_;
  bool applies_ = false;
  bool running_ = false;
  double lowest_ = 0, kinetic_ = 0, low_potential_ = 0, high_potential_ = 0;
  double growth_ = 0;
};

}  // namespace lantern::fuzz
