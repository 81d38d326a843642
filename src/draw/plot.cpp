#include "draw/plot.hpp"

#include <algorithm>
#include <cmath>

#include "draw/clip.hpp"
#include "draw/plot_axes.hpp"
#include "draw/plot_bands.hpp"
#include "draw/plot_fan.hpp"
#include "draw/plot_legend.hpp"
#include "draw/plot_lines.hpp"
#include "draw/plot_marks.hpp"
#include "draw/plot_names.hpp"

namespace lantern {
namespace {

constexpr double kMostOfEdge = 0.25;  // of the area's height, for marks at one of its edges
constexpr double kLeastArea = 24;     // page units: what is smaller shows nothing

struct Range {
  double least = 1e300, most = -1e300;
  void add(double value, bool logarithmic) {
    if (!std::isfinite(value) || (logarithmic && value <= 0)) return;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool empty() const { return least > most; }
};

// A series on the page.
struct Placed {
  const PlotSeries* series = nullptr;
  std::vector<Vec<2>> points;  // that are joined
  std::vector<Vec<2>> beyond;  // at the upper edge
  std::vector<bool> open;      // of the joined ones
  std::vector<std::pair<Vec<2>, Vec<2>>> spreads;
  std::vector<std::pair<Vec<2>, std::string>> notes;
  std::vector<std::pair<Vec<2>, Vec<2>>> whiskers;
};

class Drawing {
 public:
  Drawing(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels)
      : plot_(plot), panel_(panel), type_(plot.size), list_(list), labels_(labels) {
    type_.tick.halo = type_.name.halo = Role::panel;
  }

  void draw(bool with_legend) {
    find_ranges();
    lay_out(with_legend);
    if (xs_.empty()) return say_nothing();
    if (scale_height() < kLeastArea || area_.size().x < kLeastArea) return;
    place_points();
    draw_plot_axes(x_, y_, {area_, strip_, ground_}, panel_, PlotType(plot_.size), list_, labels_);
    const Box<2> under_strip{{area_.lo.x, area_.lo.y + strip_}, area_.hi};
    front_.draw(on_page(plot_.front), under_strip, 1.15 * radius(), 0.3 * radius(), list_);
    PlotNamer namer({area_.lo + Vec<2>{4, 0}, area_.hi}, labels_);  // off the axis
    draw_guides(namer);
    for (const Placed& placed : placed_) draw_line(placed, namer);
    for (const Placed& placed : placed_) draw_whiskers(placed, namer);
    for (std::size_t i = 0; i < placed_.size(); ++i) draw_marks(i, namer);
    name_strip(namer);
    for (std::size_t i = 0; i < guides_.size(); ++i)
      guides_[i].name(plot_.guides[i].name, type_.tick, namer);
    front_.name(plot_.front_name, type_.tick, namer);
    draw_slopes(namer);
    if (!with_legend && plot_.names == PlotNames::ends)
      for (const Placed& placed : placed_) all_named_ &= name_end(placed, namer);
    name_notes(namer);
  }

  bool all_named() const { return all_named_; }

 private:
  double radius() const { return plot_.mark > 0 ? plot_.mark : 0.31 * plot_.size; }
  double width() const { return 0.44 * radius(); }

  bool is_drawn(const PlotPoint& p) const {
    if (!std::isfinite(p.at.x) || (plot_.log_x && p.at.x <= 0)) return false;
    return p.beyond || std::isfinite(p.at.y);
  }

  void find_ranges() {
    for (const PlotSeries& series : plot_.series)
      for (const PlotPoint& p : series.points) {
        if (!is_drawn(p)) continue;
        xs_.add(p.at.x, plot_.log_x);
        for (int end = 0; end < 2; ++end) {
          if (p.spread_x) xs_.add((*p.spread_x)[end], plot_.log_x);
          if (p.spread_y) ys_.add((*p.spread_y)[end], plot_.log_y);
        }
        if (p.beyond)
          any_beyond_ = true;
        else if (plot_.log_y && p.at.y <= 0)
          any_zero_ = true;
        else
          ys_.add(p.at.y, plot_.log_y);
      }
    if (ys_.empty()) ys_ = {plot_.log_y ? 0.1 : 0.0, 1};
  }

  std::vector<LegendEntry> entries() const {
    std::vector<LegendEntry> all;
    for (const PlotSeries& s : plot_.series)
      if (std::any_of(s.points.begin(), s.points.end(),
                      [&](const PlotPoint& p) { return is_drawn(p); }))
        all.push_back({s.name, s.look, s.is_peer});
    return all;
  }

  void heading(const std::string& text, const TextStyle& style) {
    if (text.empty()) return;
    labels_.add(shortened(text, panel_.size().x, style),
                {{panel_.lo.x, area_.lo.y + 0.78 * style.size}, 0}, style, panel_);
    area_.lo.y += 1.42 * style.size;
  }

  void lay_out(bool with_legend) {
    area_ = panel_;
    heading(plot_.title, type_.title);
    heading(plot_.y_name, PlotType(plot_.size).tick);
    if (with_legend && !xs_.empty()) {
      const double wanted = plot_legend_height(entries(), panel_.size().x, plot_.size);
      const double height = std::min(wanted, 0.45 * area_.size().y);
      area_.hi.y -= height;
      draw_plot_legend(entries(), {{panel_.lo.x, area_.hi.y}, panel_.hi}, plot_.size, list_,
                       labels_);
      area_.hi.y -= 0.5 * plot_.size;
    }
    const double below = area_.hi.y;
    area_.hi.y -= plot_ticks_height(type_) + (plot_.x_name.empty() ? 0 : 1.3 * plot_.size);
    area_.lo.y += 6;
    if (xs_.empty()) return;
    const auto is_beyond = [](const PlotPoint& p) { return p.beyond; };
    const auto is_zero = [&](const PlotPoint& p) { return is_on_ground(p); };
    strip_ = any_beyond_ ? rows_of(is_beyond) * row_height() + 6 : 0;
    ground_ = any_zero_ ? rows_of(is_zero) * row_height() + 10 : 0;
    const double height = scale_height();
    y_ = {ys_.least, ys_.most, plot_.log_y, std::clamp(int(height / (2.1 * plot_.size)), 2, 9)};
    area_.lo.x += plot_ticks_width(y_, type_);
    area_.hi.x -= 0.9 * plot_.size;
    x_ = {xs_.least, xs_.most, plot_.log_x,
          std::clamp(int(area_.size().x / (3.6 * plot_.size)), 2, 10)};
    const TextStyle style = PlotType(plot_.size).tick;
    labels_.try_add(shortened(plot_.x_name, area_.size().x, style),
                    {{{area_.center().x, below - 0.3 * style.size}, 0.5}}, style, panel_);
  }

  void say_nothing() {
    list_.shapes.emplace_back(RectShape{area_, 0, Role::panel, {Role::rule, 1.2, 0}, true});
    const TextStyle style = PlotType(plot_.size).tick;
    const double room = area_.size().x - 2 * plot_.size;
    labels_.try_add(shortened(plot_.empty, room, style), {{area_.center(), 0.5}}, style, panel_);
  }

  // Marks that would cover each other at an edge stand in rows, one a series.
  int most_rows() const {
    return std::clamp(int(kMostOfEdge * (area_.size().y) / row_height()), 1, 8);
  }
  double row_height() const { return 2.7 * radius(); }
  template <class Is>
  int rows_of(const Is& is) const {
    int series = 0;
    for (const PlotSeries& s : plot_.series)
      series +=
          std::ranges::any_of(s.points, [&](const PlotPoint& p) { return is_drawn(p) && is(p); });
    return std::clamp(series, 1, most_rows());
  }
  bool is_on_ground(const PlotPoint& p) const { return !p.beyond && plot_.log_y && p.at.y <= 0; }

  double scale_height() const { return area_.size().y - strip_ - ground_; }

  Vec<2> at(const Vec<2>& value) const {
    const double x = area_.lo.x + x_.share(value.x) * area_.size().x;
    if (plot_.log_y && value.y <= 0) return {x, area_.hi.y - ground_ / 2};
    return {x, area_.hi.y - ground_ - y_.share(value.y) * scale_height()};
  }

  void place_points() {
    int row = 0, ground_row = 0;
    for (const PlotSeries& series : plot_.series) {
      Placed placed;
      placed.series = &series;
      bool any_zero = false;
      for (const PlotPoint& p : series.points) {
        if (!is_drawn(p)) continue;
        Vec<2> place = at(p.at);
        if (p.beyond) {
          place.y = area_.lo.y + 3 + (row % most_rows() + 0.5) * row_height();
          placed.beyond.push_back(place);
          continue;
        }
        if (is_on_ground(p))
          place.y = area_.hi.y - ground_ + 5 + (ground_row % most_rows() + 0.5) * row_height();
        any_zero = any_zero || is_on_ground(p);
        if (p.spread) {  // cut to the plot, along the axes that have a place for it
          Vec<2> lo = at(p.spread->lo), hi = at(p.spread->hi);
          if (is_on_ground(p)) lo.y = hi.y = place.y;
          placed.spreads.push_back(
              {glm::clamp(lo, area_.lo, area_.hi), glm::clamp(hi, area_.lo, area_.hi)});
        }
        placed.points.push_back(place);
        placed.open.push_back(p.open);
        if (!p.note.empty()) placed.notes.push_back({place, p.note});
        if (p.spread_x)
          add_whisker(at({p.spread_x->x, p.at.y}), at({p.spread_x->y, p.at.y}), placed);
        if (p.spread_y && !is_on_ground(p))
          add_whisker(at({p.at.x, p.spread_y->x}), at({p.at.x, p.spread_y->y}), placed);
      }
      row += !placed.beyond.empty();
      ground_row += any_zero;
      placed_.push_back(std::move(placed));
    }
  }

  void add_whisker(const Vec<2>& from, const Vec<2>& to, Placed& placed) const {
    if (const auto part = cut_line(from, to, area_)) placed.whiskers.push_back(*part);
  }

  void draw_whiskers(const Placed& placed, PlotNamer& namer) {
    for (const auto& [from, to] : placed.whiskers) {
      draw_plot_whisker(placed.series->look, from, to, radius(), list_);
      namer.cross(from, to);
    }
  }

  std::vector<Vec<2>> on_page(const std::vector<Vec<2>>& values) const {
    std::vector<Vec<2>> points;
    for (const Vec<2>& value : values) points.push_back(at(value));
    return points;
  }

  void draw_guides(PlotNamer& namer) {
    const Box<2> inside{{area_.lo.x, area_.lo.y + strip_}, {area_.hi.x, area_.hi.y - ground_}};
    for (const PlotGuide& guide : plot_.guides)
      guides_.emplace_back().draw(on_page(guide.points), inside, namer, list_);
  }

  void draw_line(const Placed& placed, PlotNamer& namer) {
    if (!placed.series->joined) return;
    for (std::size_t i = 1; i < placed.points.size(); ++i) {
      const Vec<2>&a = placed.points[i - 1], &b = placed.points[i];
      draw_plot_line(placed.series->look, placed.series->is_peer, a, b, width(), list_);
      namer.cross(a, b);
    }
  }

  // Marks of one place are drawn the larger the more are on them, so that each is seen.
  //
  //     (<o>)
  double mark_radius(std::size_t series, const Vec<2>& p) const {
    constexpr double kRim = 0.32, kMostOver = 2;
    double over = 0;
    for (std::size_t i = series + 1; i < placed_.size(); ++i)
      over += std::ranges::any_of(placed_[i].points, [&](const Vec<2>& q) {
        return std::abs(p.x - q.x) + std::abs(p.y - q.y) < 0.3 * radius();
      });
    return radius() * (1 + kRim * std::min(over, kMostOver));
  }

  void draw_marks(std::size_t series, PlotNamer& namer) {
    const Placed& placed = placed_[series];
    const auto draw = [&](const Vec<2>& p, bool open) {
      const double size = open ? radius() : mark_radius(series, p);
      draw_plot_mark(placed.series->look, p, size, open, list_);
      namer.mark(p, 1.2 * size);
    };
    for (const auto& [from, to] : placed.spreads)
      if (from != to)
        list_.shapes.emplace_back(LineShape{from, to, {Role::ink, 0.4 * width(), 0}, false});
    for (std::size_t i = 0; i < placed.points.size(); ++i) draw(placed.points[i], placed.open[i]);
    for (const Vec<2>& p : placed.beyond) draw(p, true);
  }

  void name_strip(PlotNamer& namer) {
    if (!any_beyond_) return;
    const double y = area_.lo.y + 3 + 1.35 * radius() + 0.36 * type_.tick.size;
    namer.name(plot_.beyond,
               {{{area_.hi.x - 6, y}, 1}, {{area_.lo.x + 6, y}, 0}, {{area_.center().x, y}, 0.5}},
               type_.tick, 3);
  }

  void draw_slopes(const PlotNamer& namer) {
    if (plot_.slopes.empty() || !plot_.log_x || !plot_.log_y) return;
    const Vec<2> decade{area_.size().x / x_.decades(), scale_height() / y_.decades()};
    const Box<2> scaled{{area_.lo.x, area_.lo.y + strip_}, {area_.hi.x, area_.hi.y - ground_}};
    draw_slope_fan(plot_.slopes, decade, scaled, type_, namer, list_, labels_);
  }

  bool name_end(const Placed& placed, PlotNamer& namer) {
    if (placed.points.empty() && placed.beyond.empty()) return true;
    const double r = 1.4 * radius() + 4, drop = 0.36 * type_.name.size;
    std::vector<Anchor> anchors;
    const auto around = [&](const Vec<2>& p) {
      anchors.push_back({p + Vec<2>{r, drop}, 0});
      anchors.push_back({p + Vec<2>{0, r + 0.78 * type_.name.size}, 0.5});
      anchors.push_back({p + Vec<2>{0, -r - 0.2 * type_.name.size}, 0.5});
      anchors.push_back({p + Vec<2>{-r, drop}, 1});
      anchors.push_back({p + Vec<2>{r, -r}, 0});
      anchors.push_back({p + Vec<2>{-r, r + 0.5 * type_.name.size}, 1});
    };
    if (!placed.points.empty()) {
      around(placed.points.back());
      around(placed.points.front());
    } else {
      around(placed.beyond.front());
    }
    return namer.name(placed.series->name, anchors, type_.name, 1);
  }

  void name_notes(PlotNamer& namer) {
    const double r = 1.4 * radius() + 3;
    for (const Placed& placed : placed_)
      for (const auto& [p, note] : placed.notes)
        namer.name(note,
                   {{p + Vec<2>{r, -0.4 * type_.tick.size}, 0},
                    {p + Vec<2>{-r, 1.1 * type_.tick.size}, 1},
                    {p + Vec<2>{r, 1.1 * type_.tick.size}, 0}},
                   type_.tick, 0);
  }

  const Plot& plot_;
  Box<2> panel_;
  PlotType type_;
  DrawList& list_;
  Labels& labels_;
  Range xs_, ys_;
  PlotScale x_, y_;
  Box<2> area_;
  double strip_ = 0, ground_ = 0;  // heights of what lies above the scale of y, and below it
  bool any_beyond_ = false, any_zero_ = false, all_named_ = true;
  std::vector<Placed> placed_;
  PlotFront front_;
  std::vector<PlotGuideLine> guides_;
};

}  // namespace

void draw_plot(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels) {
  if (!plot.bands.empty()) return draw_banded_plot(plot, panel, list, labels);
  bool with_legend = plot.names == PlotNames::legend;
  if (plot.names == PlotNames::ends) {
    DrawList trial;
    trial.labels = list.labels;
    Labels trial_labels(trial);
    Drawing drawing(plot, panel, trial, trial_labels);
    drawing.draw(false);
    with_legend = !drawing.all_named();
  }
  Drawing(plot, panel, list, labels).draw(with_legend);
}

}  // namespace lantern
