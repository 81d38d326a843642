// The chart of a scenario: what steps with a `plot` counted, or what was measured as time went on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frame/frame.hpp"
#include "frame/parts/panels.hpp"
#include "language/scenario.hpp"

namespace lantern::run {

// Seconds of world time that the whole script takes, or only its part `only`. Nothing if none
// passes, or if that depends on what happens.
std::optional<double> script_seconds(const Scenario& scenario, const std::string* only);

class Plotter {
 public:
  explicit Plotter(const Scenario& scenario);

  bool over_time() const { return spec_.over_time(); }

  // What follows belongs to this part of the scenario, at this time.
  void begin_part(const std::string& part, double time);

  // A point on each line, or a bar of this label. A new part begins a new group of bars. What the
  // frame does not count is left out.
  void add(const std::string& label, const std::string& part, const Frame& frame);

  // A point on each line at the frame's time. Nothing where the same is said already.
  void add_moment(const Frame& frame);

  FrameChart chart() const { return chart_; }

 private:
  void name_series(const Scenario& scenario);
  bool name_by_sides(const Scenario& scenario);
  std::optional<double> x_of(const std::string& y, const Frame& frame) const;

  const Scenario& scenario_;
  const ChartSpec& spec_;
  FrameChart chart_;
  int group_ = 0;
  std::string part_;  // of the last bar, or that is going on
  double begun_ = 0;  // when the part's time began
};

}  // namespace lantern::run
