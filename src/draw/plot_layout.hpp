// Where the parts of a plot lie: its axes, and its points on the page.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "draw/number_text.hpp"
#include "draw/pen.hpp"
#include "draw/plot.hpp"
#include "draw/plot_marks.hpp"
#include "draw/plot_parts.hpp"

namespace lantern::draw {

// What differs between a page that is read closely and a slide.
struct PlotStyle {
  double mark = 5;  // radius
  double line = 3;
  double apart = 24;  // between two marks of a line, at least
  Vec<2> ticks_apart{0.0};

  explicit PlotStyle(const Plot& plot) {
    ticks_apart = {96, plot.over_time ? 34 : 50};  // over time a slide's plot may be low
    if (plot.slide) return;
    mark = plot.mark > 0 ? plot.mark : 0.31 * plot.size;
    line = 0.44 * mark;
    apart = 0;
    ticks_apart = Vec<2>(3.6, 2.1) * plot.size;
  }
};

// A series on the page.
struct PlacedSeries {
  const PlotSeries* series = nullptr;
  std::vector<Vec<2>> points;  // that are joined
  std::vector<Vec<2>> beyond;  // at the upper edge
  std::vector<bool> open;      // of the joined ones
  // Which points they are, first those that are joined; not on a slide.
  std::vector<const PlotPoint*> told, told_beyond;
  std::vector<std::pair<Vec<2>, std::string>> notes;
  std::vector<std::pair<Vec<2>, Vec<2>>> whiskers;
};

class PlotLayout {
 public:
  // Draws headings and the legend, and places the rest. The plot must outlive this.
  PlotLayout(const Plot& plot, const Box<2>& panel, bool with_legend, DrawList& list,
             Labels& labels)
      : plot_(plot), style_(plot), paper_(panel, plot.size, list, labels) {
    find_ranges();
    const PlotType& type = paper_.type;
    const double top = area_.lo.y;
    paper_.heading(plot_.title, type.title);
    paper_.heading(plot_.y_name, type.tick);
    area_.lo.y += area_.lo.y > top ? 0.28 * plot_.size : 10;
    if (with_legend && !xs_.empty()) add_legend(list, labels);
    paper_.reserve_x(!plot_.x_name.empty() || !plot_.x_note.empty());
    if (xs_.empty() && !plot_.slide) return;
    paper_.place.strip = edge_height([](const PlotPoint& p) { return p.beyond; }, 6);
    paper_.place.ground = edge_height([&](const PlotPoint& p) { return is_on_ground(p); }, 10);
    y_ = y_axis(ticks_in(1));
    area_.hi.x -= plot_.names == PlotNames::column ? column_width(column(), paper_, plot_.over_time)
                                                   : 0.9 * plot_.size;
    paper_.reserve_y(y_);
    area_.hi = glm::max(area_.hi, area_.lo + 10.0);
    x_ = plot_.over_time && plot_.seconds
             ? Axis::linear(0, *plot_.seconds, std::max(4, ticks_in(0))).cut_to(0, *plot_.seconds)
             : axis_of(xs_, plot_.log_x, ticks_in(0));
  }

  bool empty() const { return xs_.empty(); }
  const Box<2>& area() const { return paper_.place.area; }
  Box<2> scaled() const { return paper_.place.scaled(); }

  std::vector<Vec<2>> on_page(const std::vector<Vec<2>>& values) const {
    std::vector<Vec<2>> points;
    for (const Vec<2>& value : values) points.push_back(at(value));
    return points;
  }
  // Of each series, not farther out than a few panels: beyond, only the direction matters.
  std::vector<PlacedSeries> place_series() const {
    std::vector<PlacedSeries> all;
    const Vec<2> reach = 4.0 * area_.size();
    int row = 0, ground_row = 0;
    for (const PlotSeries& series : plot_.series) {
      PlacedSeries& placed = all.emplace_back();
      placed.series = &series;
      bool any_zero = false;
      for (const PlotPoint& p : series.points) {
        if (!is_drawn(p)) continue;
        Vec<2> place = glm::clamp(at(p.at), area_.lo - reach, area_.hi + reach);
        if (p.beyond) {
          place.y = area_.lo.y + 3 + (row % most_rows() + 0.5) * row_height();
          placed.beyond.push_back(place);
          placed.told_beyond.push_back(&p);
          continue;
        }
        if (is_on_ground(p))
          place.y = scaled().hi.y + 5 + (ground_row % most_rows() + 0.5) * row_height();
        any_zero = any_zero || is_on_ground(p);
        placed.points.push_back(place);
        placed.told.push_back(&p);
        placed.open.push_back(p.open);
        if (!p.note.empty()) placed.notes.push_back({place, p.note});
        if (p.spread) place_whiskers(place, *p.spread, placed);
      }
      if (plot_.slide) {
        constexpr std::size_t kMostPieces = 2400;  // of all lines together
        placed.points =
            thinned(placed.points, std::max<std::size_t>(60, kMostPieces / plot_.series.size()));
        placed.open.assign(placed.points.size(), false);
      }
      row += !placed.beyond.empty();
      ground_row += any_zero;
    }
    return all;
  }
  // Of each series, without a number if it has no points; the only one needs no name.
  // A number is finer than the ticks are, or what has changed would not be seen.
  std::vector<ColumnName> column() const {
    std::vector<ColumnName> names;
    const int decimals = y_.decimals() > 1 && y_.decimals() < 7 ? y_.decimals() + 1 : 0;
    for (const PlotSeries& series : plot_.series) {
      ColumnName& name = names.emplace_back();
      if (plot_.series.size() > 1) name.name = series.name;
      const auto newest = std::find_if(series.points.rbegin(), series.points.rend(),
                                       [&](const PlotPoint& p) { return is_drawn(p); });
      if (newest == series.points.rend()) continue;
      const double y = newest->at.y;
      name.number = decimals > 0 ? number_text(y, decimals) : short_number(y);
    }
    return names;
  }

  void draw_axes(DrawList& list) {
    const PlotType& type = paper_.type;
    list.crisp_rect(area_, Role::panel);
    paper_.upright_ticks(y_);
    const double end = area_.hi.y + type.tick_length();
    if (plot_.slide)
      paper_.level_ticks(x_, area_.hi.y, end, {Role::ink, 1.8}, 8, 12);
    else
      paper_.level_ticks(x_, scaled().lo.y, end, {Role::rule, 1.5 * type.unit}, 8 * type.unit, 8);
    paper_.axis_lines();
    paper_.name_x(plot_.x_name, plot_.x_note, plot_.slide ? type.name : type.tick);
  }

 protected:
  const Plot& plot_;
  PlotStyle style_;
  PlotPaper paper_;
  Axis x_, y_;

 private:
  bool is_drawn(const PlotPoint& p) const {
    return plot_.has_place(p) && (p.beyond || std::isfinite(p.at.y));
  }

  // Slides have no ground: what is not above 0 lies at the lower end of a logarithmic axis.
  bool is_ground(double y) const { return plot_.log_y && y <= 0 && !plot_.slide; }
  bool is_on_ground(const PlotPoint& p) const { return !p.beyond && is_ground(p.at.y); }

  bool has_points(const PlotSeries& series) const {
    return std::ranges::any_of(series.points, [&](const PlotPoint& p) { return is_drawn(p); });
  }

  void find_ranges() {
    if (plot_.range)
      for (const double end : {plot_.range->first, plot_.range->second}) ys_.add(end, plot_.log_y);
    if (plot_.x_range)
      for (const double end : {plot_.x_range->first, plot_.x_range->second})
        xs_.add(end, plot_.log_x);
    for (const PlotSeries& series : plot_.series)
      for (const PlotPoint& p : series.points) {
        if (!is_drawn(p)) continue;
        xs_.add(p.at.x, plot_.log_x);
        if (!p.beyond) ys_.add(p.at.y, plot_.log_y);
        if (p.beyond || !p.spread) continue;
        for (const Vec<2>& end : {p.spread->lo, p.spread->hi}) {
          xs_.add(end.x, plot_.log_x);
          ys_.add(end.y, plot_.log_y);
        }
      }
    if (ys_.empty() && !xs_.empty()) ys_ = {plot_.log_y ? 0.1 : 0.0, 1};
  }

  // At the panel's lower edge; the plot gets what is left.
  void add_legend(DrawList& list, Labels& labels) {
    std::vector<LegendEntry> entries;
    for (const PlotSeries& s : plot_.series)
      if (has_points(s)) entries.push_back({s.name, s.look, s.is_peer});
    Box<2>& panel = paper_.place.panel;
    const double wanted = plot_legend_height(entries, panel.size().x, plot_.size);
    const double top = area_.hi.y - std::min(wanted, 0.45 * area_.size().y);
    draw_plot_legend(entries, {{panel.lo.x, top}, panel.hi}, plot_.size, list, labels);
    panel.hi.y = area_.hi.y = top - 0.5 * plot_.size;
  }

  int ticks_in(int axis) const {
    const double room = axis == 0 ? area_.size().x : scaled().size().y;
    return std::clamp(static_cast<int>(room / style_.ticks_apart[axis]), 2, 10 - axis);
  }

  Axis axis_of(const PlotRange& range, bool logarithmic, int ticks) const {
    if (range.empty()) return Axis::linear(0, 1, 2);
    if (!logarithmic) return Axis::linear(range.least, range.most, ticks);
    return plot_.slide ? Axis::logarithmic(range.least, range.most, ticks)
                       : Axis::fitted(range.least, range.most, ticks);
  }

  // Up to the ends that are asked for; lines go on beyond them and are cut.
  Axis y_axis(int ticks) const {
    if (!plot_.least && !plot_.most) return axis_of(ys_, plot_.log_y, ticks);
    PlotRange range = ys_;
    if (range.empty()) range.add(plot_.least.value_or(plot_.most.value_or(1)), plot_.log_y);
    const double low = plot_.least.value_or(std::min(range.least, plot_.most.value_or(1e300)));
    const double high = plot_.most.value_or(std::max(range.most, low));
    return axis_of({low, high}, plot_.log_y, ticks).cut_to(plot_.least, plot_.most);
  }
  // Marks that would cover each other at an edge stand in rows, one a series.
  double row_height() const { return 2.7 * style_.mark; }

  int most_rows() const {
    constexpr double kMostOfEdge = 0.25;  // of the area's height
    return std::clamp(static_cast<int>(kMostOfEdge * area_.size().y / row_height()), 1, 8);
  }

  template <class Is>
  double edge_height(const Is& is, double air) const {
    const auto rows = std::ranges::count_if(plot_.series, [&](const PlotSeries& s) {
      return std::ranges::any_of(s.points,
                                 [&](const PlotPoint& p) { return is_drawn(p) && is(p); });
    });
    return rows == 0 ? 0 : std::min(static_cast<int>(rows), most_rows()) * row_height() + air;
  }

  Vec<2> at(const Vec<2>& value) const {
    const Box<2> scale = scaled();
    const double x = scale.lo.x + x_.place(value.x) * scale.size().x;
    if (is_ground(value.y)) return {x, (scale.hi.y + area_.hi.y) / 2};
    return {x, scale.hi.y - y_.place(value.y) * scale.size().y};
  }

  void place_whiskers(const Vec<2>& place, const Box<2>& spread, PlacedSeries& placed) const {
    const auto add = [&](const Vec<2>& from, const Vec<2>& to) {
      if (const auto part = cut_line(from, to, area_)) placed.whiskers.push_back(*part);
    };
    const Vec<2> lo = at(spread.lo), hi = at(spread.hi);
    if (lo.x < hi.x) add({lo.x, place.y}, {hi.x, place.y});
    if (lo.y > hi.y) add({place.x, lo.y}, {place.x, hi.y});
  }

  Box<2>& area_ = paper_.place.area;
  PlotRange xs_, ys_;
};

}  // namespace lantern::draw
