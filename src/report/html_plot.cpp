#include "report/html_plot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/markup.hpp"
#include "draw/axis.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

constexpr double kSvgWidth = 620, kSvgHeight = 400;
constexpr double kMarkRadius = 4.6;
constexpr double kEdgeStrip = 26;  // of failed runs, and of errors of 0

std::string ink_style(const PlotInk& ink) {
  return fmt::format("--c:var(--b{})",
                     static_cast<int>(ink.role()) - static_cast<int>(body_role(1)) + 1);
}

std::string points_text(const std::vector<Vec<2>>& points) {
  std::string text;
  for (const Vec<2>& p : points)
    text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "" : " ", p.x, p.y);
  return text;
}

struct Extent {
  double least = 1e300, most = -1e300;
  void add(double value, bool logarithmic) {
    if (!std::isfinite(value) || (logarithmic && value <= 0)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  Axis axis(bool logarithmic, int ticks) const {
    if (least > most) return Axis::linear(0, 1, 2);
    return logarithmic ? Axis::fitted(least, most, ticks) : Axis::linear(least, most, ticks);
  }
};

class SvgPlot {
 public:
  SvgPlot(const Plot& plot, const std::vector<std::string>& classes)
      : plot_(plot), classes_(classes) {
    Extent xs, ys;
    for (const PlotSeries& series : plot.series)
      for (const PlotPoint& p : series.points) see(p, xs, ys);
    x_ = xs.axis(plot.log_x, 7);
    y_ = ys.axis(plot.log_y, 8);
    empty_ = xs.least > xs.most;
    area_ = {{plot.bands.empty() ? 66.0 : 120.0, 24}, {kSvgWidth - 14, kSvgHeight - 52}};
    top_ = area_.lo.y + (beyond_ ? kEdgeStrip : 0);
    bottom_ = area_.hi.y - (ground_ ? kEdgeStrip : 0);
  }

  std::string text() {
    put("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kSvgWidth,
        kSvgHeight, escaped(plot_.title));
    put("<rect class=\"area\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", area_.lo.x,
        area_.lo.y, area_.size().x, area_.size().y);
    if (empty_) {
      put("<text x=\"{}\" y=\"200\" text-anchor=\"middle\">{}</text></svg>\n", kSvgWidth / 2,
          escaped(plot_.empty));
      return out_;
    }
    add_axes();
    add_lines();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) add_series(i);
    put("</svg>\n");
    return out_;
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  bool is_ground(const PlotPoint& p) const {
    return plot_.bands.empty() && plot_.log_y && !p.beyond && p.at.y <= 0;
  }

  bool is_drawn(const PlotPoint& p) const {
    if (!plot_.has_place(p) || (!p.beyond && !std::isfinite(p.at.y))) return false;
    return p.beyond || plot_.bands.empty() ||
           std::ranges::any_of(plot_.bands, [&](const PlotBand& b) { return b.holds(p.at.y); });
  }

  void see(const PlotPoint& p, Extent& xs, Extent& ys) {
    if (!is_drawn(p)) return;
    xs.add(p.at.x, plot_.log_x);
    beyond_ = beyond_ || p.beyond;
    ground_ = ground_ || is_ground(p);
    if (p.beyond) return;
    ys.add(p.at.y, plot_.log_y);
    if (!p.spread) return;
    for (const Vec<2>& end : {p.spread->lo, p.spread->hi}) {
      xs.add(end.x, plot_.log_x);
      ys.add(end.y, plot_.log_y);
    }
  }

  double x_of(double x) const { return area_.lo.x + x_.place(x) * area_.size().x; }
  double y_of(double y) const { return bottom_ - y_.place(y) * (bottom_ - top_); }

  double band_height() const { return (bottom_ - top_) / static_cast<double>(plot_.bands.size()); }

  // Each series has a lane of its own in a band, so that none hides another.
  double place_of(const PlotPoint& p, std::size_t series) const {
    const double lane = (static_cast<double>(series) + 0.5) /
                        static_cast<double>(std::max<std::size_t>(1, plot_.series.size()));
    if (p.beyond) return area_.lo.y + 5 + lane * (kEdgeStrip - 10);
    if (is_ground(p)) return bottom_ + 5 + lane * (kEdgeStrip - 10);
    for (std::size_t i = 0; i < plot_.bands.size(); ++i)
      if (plot_.bands[i].holds(p.at.y))
        return bottom_ - (static_cast<double>(i) + 0.1 + 0.8 * lane) * band_height();
    return y_of(p.at.y);
  }

  void level(double y, const char* kind) {
    put("<line class=\"{}\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", kind, area_.lo.x,
        area_.hi.x, y, y);
  }
  void name_level(double y, std::string_view name) {
    put("<text class=\"tick\" x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", area_.lo.x - 7,
        y + 4, escaped(name));
  }

  void add_axes() {
    for (const Axis::Tick& tick : x_.ticks()) {
      const double x = x_of(tick.value);
      put("<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{}\" y2=\"{}\"/>", x, x,
          area_.lo.y, area_.hi.y);
      put("<text class=\"tick\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x,
          area_.hi.y + 18, escaped(tick.text));
    }
    if (plot_.bands.empty())
      for (const Axis::Tick& tick : y_.ticks()) {
        level(y_of(tick.value), "grid");
        name_level(y_of(tick.value), tick.text);
      }
    for (std::size_t i = 0; i < plot_.bands.size(); ++i) {
      const double low = bottom_ - static_cast<double>(i) * band_height();
      if (i > 0) level(low, "grid");
      name_level(low - band_height() / 2, plot_.bands[i].name);
    }
    if (beyond_) {
      level(top_, "edge");
      put("<text class=\"tick\" x=\"{}\" y=\"{}\">{}</text>", area_.lo.x, area_.lo.y - 7,
          escaped(plot_.beyond));
    }
    if (ground_) {
      level(bottom_, "edge");
      name_level((bottom_ + area_.hi.y) / 2, "0");
    }
    put("<text class=\"name\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
        (area_.lo.x + area_.hi.x) / 2, kSvgHeight - 10, escaped(plot_.x_name));
  }

  // What is not measured, cut to the area by an inner picture.
  void add_lines() {
    put("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">",
        area_.lo.x, top_, area_.size().x, bottom_ - top_);
    for (const PlotGuide& guide : plot_.guides) {
      std::vector<Vec<2>> points;
      for (const Vec<2>& p : guide.points) points.push_back({x_of(p.x), y_of(p.y)});
      put("<polyline class=\"guide\" points=\"{}\"><title>{}</title></polyline>",
          points_text(points), escaped(guide.name));
    }
    if (plot_.bands.empty() && plot_.front.size() > 1) {
      std::vector<Vec<2>> stairs;
      for (const Vec<2>& corner : plot_.front) {
        if (!stairs.empty()) stairs.push_back({x_of(corner.x), stairs.back().y});
        stairs.push_back({x_of(corner.x), std::min(y_of(corner.y), bottom_)});
      }
      put("<polyline class=\"front\" points=\"{}\"><title>{}</title></polyline>",
          points_text(stairs), escaped(plot_.front_name));
    }
    put("</svg>");
  }

  void add_whisker(const Vec<2>& at, const Box<2>& spread) {
    constexpr const char* kLine = "<path class=\"whisker\" d=\"M{:.1f},{:.1f}{}{:.1f}\"/>";
    if (spread.lo.x < spread.hi.x)
      put(fmt::runtime(kLine), x_of(spread.lo.x), at.y, "H", x_of(spread.hi.x));
    if (spread.lo.y < spread.hi.y)
      put(fmt::runtime(kLine), at.x, y_of(spread.lo.y), "V", y_of(spread.hi.y));
  }

  void add_series(std::size_t index) {
    const PlotSeries& series = plot_.series[index];
    put("<g class=\"{}{}\" style=\"{}\">", classes_[index], series.is_peer ? " peer" : "",
        ink_style(series.ink()));
    std::vector<Vec<2>> line;
    for (const PlotPoint& p : series.points)
      if (is_drawn(p) && !p.beyond) line.push_back({x_of(p.at.x), place_of(p, index)});
    if (series.joined && line.size() > 1)
      put("<polyline class=\"line\" points=\"{}\"/>", points_text(line));
    for (const PlotPoint& p : series.points) {
      if (!is_drawn(p)) continue;
      const Vec<2> at{x_of(p.at.x), place_of(p, index)};
      if (p.spread && !p.beyond) add_whisker(at, *p.spread);
      put("<use class=\"{}\" href=\"#mark{}\" x=\"{:.1f}\" y=\"{:.1f}\"><title>{}: {}; {}</title>"
          "</use>",
          p.beyond || p.open ? "open" : "mark", series.look % kPlotMarks, at.x, at.y,
          escaped(series.name), figure(p.at.x), p.beyond ? escaped(plot_.beyond) : figure(p.at.y));
    }
    put("</g>");
  }

  const Plot& plot_;
  const std::vector<std::string>& classes_;
  Axis x_, y_;
  Box<2> area_;
  double top_ = 0, bottom_ = 0;  // of the scale
  bool beyond_ = false, ground_ = false, empty_ = false;
  std::string out_;
};

}  // namespace

std::string svg_marks() {
  std::string text = "<svg width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>";
  for (int mark = 0; mark < kPlotMarks; ++mark) {
    DrawList list;
    draw_plot_mark({mark, false, 0}, {0, 0}, kMarkRadius, false, list);
    const auto* outline = std::get_if<PolygonShape>(&list.shapes.at(0));
    if (outline)
      text +=
          fmt::format("<polygon id=\"mark{}\" points=\"{}\"/>", mark, points_text(outline->points));
    else
      text += fmt::format("<circle id=\"mark{}\" r=\"{}\"/>", mark, kMarkRadius);
  }
  return text + "</defs></svg>\n";
}

std::string svg_sample(const PlotInk& ink) {
  return fmt::format(
      "<svg class=\"sample{}\" viewBox=\"0 0 34 14\" style=\"{}\" aria-hidden=\"true\">"
      "<polyline class=\"line\" points=\"1,7 33,7\"/><use class=\"mark\" href=\"#mark{}\" "
      "x=\"17\" y=\"7\"/></svg>",
      ink.is_peer ? " peer" : "", ink_style(ink), ink.look % kPlotMarks);
}

std::string svg_plot(const Plot& plot, const std::vector<std::string>& classes) {
  return SvgPlot(plot, classes).text();
}

}  // namespace lantern::report
