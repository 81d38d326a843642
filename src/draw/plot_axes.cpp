#include "draw/plot_axes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "draw/font.hpp"

namespace lantern {
namespace {

constexpr double kTickLength = 6;
constexpr double kLeastPower = -300, kMostPower = 300;

double value_of(int power) {
  double value = 1;
  for (int i = 0; i < std::abs(power); ++i) value *= 10;
  return power < 0 ? 1 / value : value;
}

}  // namespace

std::string power_of_ten(int power) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (power == 0) return "1";
  if (power == 1) return "10";
  std::string text = power < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(power))) text += kDigits[digit - '0'];
  return text;
}

PlotScale::PlotScale(double least, double most, bool logarithmic, int most_ticks)
    : logarithmic_(logarithmic) {
  if (!logarithmic) {
    ticks_ = Axis::linear(least, most, most_ticks).ticks();
    low_ = ticks_.front().value;
    high_ = ticks_.back().value;
    return;
  }
  constexpr double kAir = 0.04;  // of the range, at both ends
  const double a = std::clamp(std::log10(least), kLeastPower, kMostPower);
  const double b = std::clamp(std::log10(most), a, kMostPower);
  low_ = a - kAir * (b - a) - 0.05;
  high_ = b + kAir * (b - a) + 0.05;
  if (std::floor(high_) - std::ceil(low_) < 1) {  // fewer than two powers of ten on it
    if (add_parts(b - a, most_ticks)) return;
    const double low = std::min(low_, std::floor(a));
    high_ = std::max(high_, std::floor(low + 0.999) + 1) + 0.06;
    low_ = low - 0.06;
  }
  const int first = static_cast<int>(std::ceil(low_)), last = static_cast<int>(std::floor(high_));
  int every = 1;
  while ((last - first) / every + 1 > std::max(2, most_ticks)) ++every;
  // Multiples of the spacing, so that 1 is among them if the axis holds it, where there are two.
  const int begin = every * static_cast<int>(std::ceil(static_cast<double>(first) / every));
  for (int power = begin + every > last ? first : begin; power <= last; power += every)
    ticks_.push_back({value_of(power), power_of_ten(power)});
}

// Twice and five times the powers of ten too, where these alone would make the axis much longer
// than its values need. False, and there are none, if that gives too few or too many ticks.
bool PlotScale::add_parts(double decades, int most_ticks) {
  constexpr double kLeastDecades = 0.7;  // less is a close look at nothing
  if (decades < kLeastDecades) return false;
  for (int power = static_cast<int>(std::floor(low_)); power <= high_; ++power)
    for (const int part : {1, 2, 5}) {
      const double at = power + std::log10(part), value = part * value_of(power);
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

double PlotScale::share(double value) const {
  if (logarithmic_) return value > 0 ? (std::log10(value) - low_) / (high_ - low_) : 0;
  return (value - low_) / (high_ - low_);
}

double PlotScale::share_inside(double value) const { return std::clamp(share(value), 0.0, 1.0); }

double plot_ticks_width(const PlotScale& y, const PlotType& type) {
  double widest = 0;
  for (const Axis::Tick& tick : y.ticks())
    widest = std::max(widest, text_width(tick.text, type.tick));
  return widest + kTickLength + 5;
}

double plot_ticks_height(const PlotType& type) { return kTickLength + 4 + 1.1 * type.tick.size; }

void draw_plot_axes(const PlotScale& x, const PlotScale& y, const PlotArea& place,
                    const Box<2>& panel, const PlotType& type, DrawList& list, Labels& labels) {
  const Box<2>& area = place.box;
  list.shapes.emplace_back(RectShape{area, 0, Role::panel, {}, true});
  const double top = area.lo.y + place.strip, bottom = area.hi.y - place.ground;
  const auto write = [&](const std::string& text, double at) {
    const Vec<2> end{area.lo.x - kTickLength - 4, at + 0.36 * type.tick.size};
    labels.try_add(text, {{end, 1}}, type.tick, panel);
  };
  if (place.ground > 0) write("0", area.hi.y - place.ground / 2);
  for (const Axis::Tick& tick : y.ticks()) {
    const double at = bottom - y.share_inside(tick.value) * (bottom - top);
    list.shapes.emplace_back(
        LineShape{{area.lo.x - kTickLength, at}, {area.hi.x, at}, {Role::rule, 1.2, 0}, true});
    write(tick.text, at);
  }
  double last = -1e9;
  for (const Axis::Tick& tick : x.ticks()) {
    const double at = area.lo.x + x.share_inside(tick.value) * area.size().x;
    list.shapes.emplace_back(
        LineShape{{at, top}, {at, area.hi.y + kTickLength}, {Role::rule, 1.2, 0}, true});
    const double half = text_width(tick.text, type.tick) / 2;
    if (at - half < last + 8) continue;
    const double baseline = area.hi.y + kTickLength + 3 + 0.8 * type.tick.size;
    if (labels.try_add(tick.text, {{{at, baseline}, 0.5}}, type.tick, panel)) last = at + half;
  }
  for (const Vec<2>& end : {Vec<2>(area.lo.x, area.lo.y), Vec<2>(area.hi.x, area.hi.y)})
    list.shapes.emplace_back(LineShape{{area.lo.x, area.hi.y}, end, {Role::ink, 1.6, 0}, true});
  for (const auto& [height, at] : {std::pair(place.strip, top), std::pair(place.ground, bottom)})
    if (height > 0)
      list.shapes.emplace_back(
          LineShape{{area.lo.x, at}, {area.hi.x, at}, {Role::cell_line_3, 1.2, 4}, true});
}

}  // namespace lantern
