// The two axes of a plot: where a value lies, and what is written at the ticks.
#pragma once

#include <string>
#include <vector>

#include "draw/axis.hpp"
#include "draw/labels.hpp"

namespace lantern {

// "10⁻⁵"; 1 and 10 as they are.
std::string power_of_ten(int power);

// One axis. A logarithmic one fits its values closely. Its ticks are powers of ten, or, where fewer
// than two are on it, these with twice and five times as much: "2·10⁻³".
class PlotScale {
 public:
  PlotScale() = default;
  // For values from `least` to `most`, finite, in order, above 0 on a logarithmic axis.
  PlotScale(double least, double most, bool logarithmic, int most_ticks);

  // 0 at the lower end and 1 at the upper one; beyond them for values outside. What has no
  // logarithm is at the lower end.
  double share(double value) const;
  // The same, never outside.
  double share_inside(double value) const;
  const std::vector<Axis::Tick>& ticks() const { return ticks_; }
  bool logarithmic() const { return logarithmic_; }
  double decades() const { return high_ - low_; }  // of a logarithmic one

 private:
  bool add_parts(double decades, int most_ticks);

  double low_ = 0, high_ = 1;
  bool logarithmic_ = false;
  std::vector<Axis::Tick> ticks_;
};

struct PlotType {
  explicit PlotType(double size)
      : tick{0.92 * size, Weight::regular, Role::quiet_ink, Role::none},
        name{size, Weight::regular, Role::ink, Role::none},
        title{size, Weight::semibold, Role::ink, Role::none} {}
  TextStyle tick, name, title;
};

// Where points lie. `strip` is the height of the part at the upper edge that has no scale, `ground`
// that of the part at the lower edge where 0 is, on a logarithmic axis.
struct PlotArea {
  Box<2> box;
  double strip = 0, ground = 0;
};

// The ground, a line and a text for each tick, and the axes themselves.
void draw_plot_axes(const PlotScale& x, const PlotScale& y, const PlotArea& place,
                    const Box<2>& panel, const PlotType& type, DrawList& list, Labels& labels);

// How much room the ticks' texts take to the left of the area, and below it.
double plot_ticks_width(const PlotScale& y, const PlotType& type);
double plot_ticks_height(const PlotType& type);

}  // namespace lantern
