#include "draw/axis.hpp"

#include <fmt/format.h>

#include "draw/number_text.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
namespace {

// 1, 2 or 5 times a power of ten: the least that is not below `step`. `decimals` of it after the
// point.
double nice_step(double step, int& decimals) {
  double power = 1;
  decimals = 0;
  while (power > step && decimals < 300) {
    power /= 10;
    ++decimals;
  }
  while (power * 10 <= step) power *= 10;
  for (const double k : {1.0, 2.0, 5.0})
    if (k * power >= step) return k * power;
  decimals = std::max(0, decimals - 1);
  return 10 * power;
}

double power_value(int power) {
  double value = 1;
  for (int i = 0; i < std::abs(power); ++i) value *= 10;
  return power < 0 ? 1 / value : value;
}

}  // namespace

Axis Axis::linear(double least, double most, int most_ticks) {
  constexpr double kMost = 1e150;  // so that differences stay finite
  double low = std::clamp(least, -kMost, kMost), high = std::clamp(most, -kMost, kMost);
  if (low > 0 && low < 0.7 * high) low = 0;
  if (high < 0 && high > 0.7 * low) high = 0;
  // Where all values are one, they get a range all the same.
  if (low >= high) (low > 0 ? low : high) = low == 0 ? 1 : 0;
  // Below this, steps would be lost against the values themselves.
  const double lost = std::max(std::abs(low), std::abs(high)) * 1e-12;
  if (high - low < lost) {
    low -= lost;
    high += lost;
  }
  int decimals = 0;
  double step = nice_step((high - low) / std::max(1, most_ticks - 1), decimals);
  Axis axis;
  for (int tries = 0; tries < 8; ++tries) {
    axis.low_ = std::floor(low / step) * step;
    axis.high_ = std::ceil(high / step) * step;
    if ((axis.high_ - axis.low_) / step + 1 <= most_ticks + 0.5 || most_ticks < 3) break;
    step = nice_step(step * 1.01, decimals);
  }
  axis.decimals_ = decimals;
  const auto count = static_cast<int>(std::min(1000.0, (axis.high_ - axis.low_) / step + 0.5));
  for (int i = 0; i <= count; ++i) {
    const double value = axis.low_ + i * step;
    const bool tiny = decimals > 6;
    const double clean = std::abs(value) < step * 1e-9 ? 0 : value;
    axis.ticks_.push_back({clean, tiny ? short_number(clean) : number_text(clean, decimals)});
  }
  return axis;
}

Axis Axis::logarithmic(double least_above_zero, double most, int most_ticks) {
  Axis axis;
  axis.logarithmic_ = true;
  axis.low_ = std::floor(geometry::log10(std::clamp(least_above_zero, 1e-150, 1e150)));
  axis.high_ = std::ceil(geometry::log10(std::clamp(most, 1e-150, 1e150)));
  if (axis.high_ <= axis.low_) axis.high_ = axis.low_ + 1;
  const auto decades = static_cast<int>(axis.high_ - axis.low_);
  const int every = std::max(1, (decades + most_ticks - 2) / std::max(1, most_ticks - 1));
  for (int i = 0; i <= decades; i += every) {
    const int power = static_cast<int>(axis.low_) + i;
    const double value = power_value(power);
    axis.ticks_.push_back({value, power < 0 && power > -4 ? number_text(value, -power)
                                  : power < 0             ? short_number(value)
                                                          : number_text(value)});
  }
  return axis;
}

Axis Axis::fitted(double least_above_zero, double most, int most_ticks) {
  constexpr double kAir = 0.04;  // of the range, at both ends
  constexpr double kMostPower = 300;
  const double a = std::clamp(geometry::log10(least_above_zero), -kMostPower, kMostPower);
  const double b = std::clamp(geometry::log10(most), a, kMostPower);
  Axis axis;
  axis.logarithmic_ = true;
  axis.low_ = a - kAir * (b - a) - 0.05;
  axis.high_ = b + kAir * (b - a) + 0.05;
  if (std::floor(axis.high_) - std::ceil(axis.low_) < 1) {  // fewer than two powers of ten on it
    if (axis.add_parts(b - a, most_ticks)) return axis;
    const double low = std::min(axis.low_, std::floor(a));
    axis.high_ = std::max(axis.high_, std::floor(low + 0.999) + 1) + 0.06;
    axis.low_ = low - 0.06;
  }
  const int first = static_cast<int>(std::ceil(axis.low_));
  const int last = static_cast<int>(std::floor(axis.high_));
  int every = 1;
  while ((last - first) / every + 1 > std::max(2, most_ticks)) ++every;
  // Multiples of the spacing, so that 1 is among them if the axis holds it, where there are two.
  const int begin = every * static_cast<int>(std::ceil(static_cast<double>(first) / every));
  for (int power = begin + every > last ? first : begin; power <= last; power += every)
    axis.ticks_.push_back({power_value(power), power_of_ten(power)});
  return axis;
}

// Twice and five times the powers of ten too, where these alone would make the axis much longer
// than its values need. False, and there are none, if that gives too few or too many ticks.
bool Axis::add_parts(double decades, int most_ticks) {
  constexpr double kLeastDecades = 0.7;  // less is a close look at nothing
  if (decades < kLeastDecades) return false;
  for (int power = static_cast<int>(std::floor(low_)); power <= high_; ++power)
    for (const int part : {1, 2, 5}) {
      const double at = power + geometry::log10(part), value = part * power_value(power);
      if (at < low_ || at > high_) continue;
      const bool is_plain = power >= -1 && power <= 1;  // 0.5, 2, 20
      const std::string text = part == 1  ? power_of_ten(power)
                               : is_plain ? fmt::format("{:g}", value)
                                          : fmt::format("{}·{}", part, power_of_ten(power));
      ticks_.push_back({value, text});
    }
  if (ticks_.size() >= 2 && static_cast<int>(ticks_.size()) <= std::max(4, most_ticks)) return true;
  ticks_.clear();
  return false;
}

double Axis::share(double value) const {
  const double at = place(value);
  return at > 0 ? std::min(at, 1.0) : 0;
}

double Axis::place(double value) const {
  double at = value;
  if (logarithmic_) at = value > 0 ? geometry::log10(value) : low_;
  const double place = (at - low_) / (high_ - low_);
  return std::isnan(place) ? 0 : place;
}

Axis Axis::cut_to(std::optional<double> low, std::optional<double> high) const {
  Axis axis = *this;
  if (low) axis.low_ = logarithmic_ ? geometry::log10(*low) : *low;
  if (high) axis.high_ = logarithmic_ ? geometry::log10(*high) : *high;
  std::erase_if(axis.ticks_, [&](const Tick& tick) {
    const double at = axis.place(tick.value);
    return at < -1e-9 || at > 1 + 1e-9;
  });
  return axis;
}

}  // namespace lantern::draw
