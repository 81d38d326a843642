// A plot's axis: its range, where its ticks stand, and what is written at them.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lantern::draw {

// What an axis must hold.
struct PlotRange {
  double least = 1e300, most = -1e300;
  void add(double value, bool logarithmic) {
    if (!std::isfinite(value) || (logarithmic && value <= 0)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  void add(const std::optional<std::pair<double, double>>& ends, bool logarithmic) {
    if (ends) add(ends->first, logarithmic), add(ends->second, logarithmic);
  }
  bool empty() const { return least > most; }
};

class Axis {
 public:
  struct Tick {
    double value = 0;
    std::string text;
  };

  // For values from `least` to `most` (finite, in order), at most `most_ticks` (2 or more) ticks.
  // A linear axis starts at 0 unless all values are far from it. A logarithmic one shows what is
  // not above 0 at its lower end; it spans whole decades, and its numbers are written out.
  static Axis linear(double least, double most, int most_ticks);
  static Axis logarithmic(double least_above_zero, double most, int most_ticks);
  // A logarithmic one that fits its values closely. Its ticks are powers of ten, or, where fewer
  // than two are on it, these with twice and five times as much: "2·10⁻³".
  static Axis fitted(double least_above_zero, double most, int most_ticks);

  // 0 at the lower end, 1 at the upper one; never outside.
  double share(double value) const;
  // The same, and below 0 or above 1 for what lies outside; 0 for what has no place.
  double place(double value) const;
  const std::vector<Tick>& ticks() const { return ticks_; }
  // With these ends, wherever the ticks are; an end that is not given stays.
  Axis cut_to(std::optional<double> low, std::optional<double> high) const;
  double low() const { return low_; }
  double decades() const { return high_ - low_; }  // of a logarithmic one
  int decimals() const { return decimals_; }       // that its ticks have after the point

 private:
  bool add_parts(double decades, int most_ticks);

  double low_ = 0, high_ = 1;
  bool logarithmic_ = false;
  int decimals_ = 0;
  std::vector<Tick> ticks_;
};

}  // namespace lantern::draw
