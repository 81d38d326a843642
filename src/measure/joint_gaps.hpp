// How far the joints of a scenario part, by the states of its bodies alone.
#pragma once

#include "measure/error_metrics.hpp"

namespace lantern::measure {

class JointGaps {
 public:
  // Of its pins and rods. Refuses a scenario without any.
  explicit JointGaps(const Scenario& scenario);

  void look(const std::vector<BodyState>& states);
  double worst() const { return worst_.value(); }  // units, so far

 private:
  struct Joint {
    LinkSpec link;
    double length = 0;  // 0 of a pin
  };
  static double distance(const LinkSpec& link, const std::vector<BodyState>& states);

  std::vector<Joint> joints_;
  Worst worst_;
};

// As the bodies are at first.
std::vector<BodyState> first_states(const Scenario& scenario);

// Where a point of a body is that is given in its own axes.
Vec<3> point_of(const BodyState& state, const Vec<3>& at);

}  // namespace lantern::measure
