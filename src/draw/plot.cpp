#include "draw/plot.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "draw/pen.hpp"
#include "draw/plot_layout.hpp"
#include "draw/plot_parts.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeastArea = 24;  // page units: what is smaller shows nothing

class Drawing : PlotLayout {
 public:
  Drawing(const Plot& plot, const Box<2>& panel, bool with_legend, DrawList& list, Labels& labels)
      : PlotLayout(plot, panel, with_legend, list, labels),
        with_legend_(with_legend),
        halo_(plot.size),
        list_(list),
        labels_(labels) {
    halo_.tick.halo = halo_.name.halo = Role::panel;
  }

  void draw() {
    if (empty() && !plot_.slide) return paper_.say_nothing(plot_.empty);
    if (!plot_.slide && (scaled().size().y < kLeastArea || area().size().x < kLeastArea)) return;
    placed_ = place_series();
    draw_axes(list_);
    const double width = 1.15 * style_.mark;
    const std::vector<Vec<2>> front =
        draw_front(on_page(plot_.front), {scaled().lo, area().hi}, width, 0.3 * style_.mark, list_);
    PlotNamer namer({area().lo + Vec<2>{4, 0}, area().hi}, labels_);  // off the axis
    std::vector<Pieces> guides;
    for (const PlotGuide& guide : plot_.guides)
      guides.push_back(draw_guide(on_page(guide.points), scaled(), namer, list_));
    draw_series(namer);
    name_strip(namer);
    for (std::size_t i = 0; i < guides.size(); ++i)
      name_guide(plot_.guides[i].name, guides[i], halo_.tick, namer);
    name_front(plot_.front_name, front, width, halo_.tick, namer);
    draw_slopes(namer);
    if (!with_legend_ && plot_.names == PlotNames::ends)
      for (const PlacedSeries& placed : placed_) all_named_ &= name_end(placed, namer);
    if (plot_.names == PlotNames::column) name_column();
    name_notes(namer);
  }

  bool all_named() const { return all_named_; }

 private:
  // What follows shows this; on a slide, whose lines are one thing, nothing is told.
  std::unique_ptr<DrawList::Scope> shown(const std::string& key) {
    return plot_.slide ? nullptr : std::make_unique<DrawList::Scope>(list_, key);
  }

  // Lines end there, and reach a hair over its edge.
  Box<2> picture() const { return shrunk(area(), -2); }

  // On a slide each line has its marks before the next one is drawn, and what is newest lies on
  // top. The first line comes last: where others run along it, it keeps its colour.
  void draw_series(PlotNamer& namer) {
    for (std::size_t k = 0; k < placed_.size(); ++k) {
      const std::size_t i = plot_.slide ? placed_.size() - 1 - k : k;
      draw_line(placed_[i], namer);
      if (plot_.slide) draw_marks(i, namer);
    }
    for (const PlacedSeries& placed : placed_) draw_whiskers(placed, namer);
    for (std::size_t i = placed_.size(); plot_.slide && i-- > 0;) draw_newest(placed_[i]);
    for (std::size_t i = 0; i < placed_.size() && !plot_.slide; ++i) draw_marks(i, namer);
  }

  // On a slide the same x again begins a line anew.
  void draw_line(const PlacedSeries& placed, PlotNamer& namer) {
    if (!placed.series->joined) return;
    const auto scope = shown(plot_key(plot_, *placed.series));
    const std::vector<Vec<2>>& points = placed.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (plot_.slide && points[i].x == points[i - 1].x) continue;
      const auto seen = cut_line(points[i - 1], points[i], picture());
      if (!seen) continue;
      draw_plot_line(placed.series->ink(), seen->first, seen->second, style_.line, list_);
      namer.cross(seen->first, seen->second);
    }
  }

  void draw_whiskers(const PlacedSeries& placed, PlotNamer& namer) {
    if (placed.whiskers.empty()) return;
    const auto scope = shown(plot_key(plot_, *placed.series) + "/whiskers");
    for (const auto& [from, to] : placed.whiskers) {
      draw_plot_whisker(placed.series->ink(), from, to, style_.mark, list_);
      namer.cross(from, to);
    }
  }

  // Marks of one place are drawn the larger the more are on them, so that each is seen.
  //
  //     (<o>)
  double mark_radius(std::size_t series, const Vec<2>& p) const {
    constexpr double kRim = 0.32, kMostOver = 2;
    double over = 0;
    for (std::size_t i = series + 1; i < placed_.size() && !plot_.slide; ++i)
      over += std::ranges::any_of(placed_[i].points, [&](const Vec<2>& q) {
        return std::abs(p.x - q.x) + std::abs(p.y - q.y) < 0.3 * style_.mark;
      });
    return style_.mark * (1 + kRim * std::min(over, kMostOver));
  }

  void draw_marks(std::size_t series, PlotNamer& namer) {
    const PlacedSeries& placed = placed_[series];
    const Vec<2>* last = nullptr;
    const auto draw = [&](const Vec<2>& p, bool open, const PlotPoint* point) {
      if (!contains(picture(), p) || (last && glm::distance(p, *last) < style_.apart)) return;
      last = &p;
      const auto scope = shown(point ? plot_key(plot_, *placed.series, *point) : "");
      const double size = open ? style_.mark : mark_radius(series, p);
      draw_plot_mark(placed.series->ink(), p, size, open, list_);
      namer.mark(p, 1.2 * size);
    };
    const std::size_t newest = plot_.slide ? 1 : 0;
    for (std::size_t i = 0; i + newest < placed.points.size(); ++i)
      draw(placed.points[i], placed.open[i], plot_.slide ? nullptr : placed.told[i]);
    for (std::size_t i = 0; i < placed.beyond.size(); ++i)
      draw(placed.beyond[i], true, placed.told_beyond[i]);
  }

  void draw_newest(const PlacedSeries& placed) {
    if (!placed.points.empty() && contains(picture(), placed.points.back()))
      draw_plot_mark(placed.series->ink(), placed.points.back(), 1.7 * style_.mark, false, list_);
  }

  void name_strip(PlotNamer& namer) {
    if (paper_.place.strip == 0) return;
    const double y = area().lo.y + 3 + 1.35 * style_.mark + 0.36 * halo_.tick.size;
    namer.name(
        plot_.beyond,
        {{{area().hi.x - 6, y}, 1}, {{area().lo.x + 6, y}, 0}, {{area().center().x, y}, 0.5}},
        halo_.tick, 3);
  }

  void draw_slopes(const PlotNamer& namer) {
    if (plot_.slopes.empty() || !plot_.log_x || !plot_.log_y) return;
    const Vec<2> decade = scaled().size() / Vec<2>(x_.decades(), y_.decades());
    draw_slope_fan(plot_.slopes, decade, scaled(), halo_, namer, list_, labels_);
  }

  bool name_end(const PlacedSeries& placed, PlotNamer& namer) {
    if (placed.points.empty() && placed.beyond.empty()) return true;
    const double r = 1.4 * style_.mark + 4, size = halo_.name.size, drop = 0.36 * size;
    std::vector<Anchor> anchors;
    const auto around = [&](const Vec<2>& p) {
      anchors.push_back({p + Vec<2>{r, drop}, 0});
      anchors.push_back({p + Vec<2>{0, r + 0.78 * size}, 0.5});
      anchors.push_back({p + Vec<2>{0, -r - 0.2 * size}, 0.5});
      anchors.push_back({p + Vec<2>{-r, drop}, 1});
      anchors.push_back({p + Vec<2>{r, -r}, 0});
      anchors.push_back({p + Vec<2>{-r, r + 0.5 * size}, 1});
    };
    if (!placed.points.empty()) {
      around(placed.points.back());
      around(placed.points.front());
    } else {
      around(placed.beyond.front());
    }
    return namer.name(placed.series->name, anchors, halo_.name, 1);
  }

  void name_column() {
    const std::vector<ColumnName> all = column();
    std::vector<ColumnName> names;  // of those that have an end
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!placed_[i].points.empty()) {
        names.push_back(all[i]);
        names.back().end = placed_[i].points.back();
      }
    draw_column(std::move(names), all.size(), paper_, list_, labels_);
  }

  void name_notes(PlotNamer& namer) {
    const double r = 1.4 * style_.mark + 3, size = halo_.tick.size;
    for (const PlacedSeries& placed : placed_)
      for (const auto& [p, note] : placed.notes)
        namer.name(note,
                   {{p + Vec<2>{r, -0.4 * size}, 0},
                    {p + Vec<2>{-r, 1.1 * size}, 1},
                    {p + Vec<2>{r, 1.1 * size}, 0}},
                   halo_.tick, 0);
  }

  bool with_legend_;
  PlotType halo_;  // of names inside the area
  DrawList& list_;
  Labels& labels_;
  bool all_named_ = true;
  std::vector<PlacedSeries> placed_;
};

}  // namespace

std::string plot_key(const Plot& plot, const PlotSeries& series) {
  return fmt::format("series/{}", &series - plot.series.data());
}

std::string plot_key(const Plot& plot, const PlotSeries& series, const PlotPoint& point) {
  return fmt::format("{}/{}", plot_key(plot, series), &point - series.points.data());
}

void draw_plot(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels) {
  if (!plot.bands.empty()) return draw_banded_plot(plot, panel, list, labels);
  bool with_legend = plot.names == PlotNames::legend;
  if (plot.names == PlotNames::ends) {
    DrawList trial;
    trial.labels = list.labels;
    Labels trial_labels(trial);
    Drawing drawing(plot, panel, false, trial, trial_labels);
    drawing.draw();
    with_legend = !drawing.all_named();
  }
  Drawing(plot, panel, with_legend, list, labels).draw();
}

}  // namespace lantern::draw
