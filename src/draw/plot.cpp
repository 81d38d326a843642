#include "draw/plot.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "draw/number_text.hpp"
#include "draw/pen.hpp"
#include "draw/plot_parts.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeastArea = 24;  // page units: what is smaller shows nothing

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

class Drawing {
 public:
  // Draws headings and the legend, and places the rest.
  Drawing(const Plot& plot, const Box<2>& panel, bool with_legend, DrawList& list, Labels& labels)
      : plot_(plot),
        paper_(panel, plot.size, list, labels),
        with_legend_(with_legend),
        list_(list),
        labels_(labels) {
    halo_.tick.halo = halo_.name.halo = Role::panel;
    find_ranges();
    const PlotType& type = paper_.type;
    const double top = area_.lo.y;
    paper_.heading(plot_.title, type.title);
    paper_.heading(plot_.y_name, type.tick);
    area_.lo.y += area_.lo.y > top ? 0.28 * plot_.size : 10;
    if (with_legend && !xs_.empty()) add_legend();
    paper_.reserve_x(!plot_.x_name.empty() || !plot_.x_note.empty());
    if (xs_.empty() && !plot_.slide) return;
    paper_.place.strip = edge_height([](const PlotPoint& p) { return p.beyond; }, 6);
    paper_.place.ground = edge_height([&](const PlotPoint& p) { return is_on_ground(p); }, 10);
    y_ = y_axis(ticks_in(1));
    area_.hi.x -= plot_.names == PlotNames::column
                      ? column_width(widest_column(), paper_, plot_.over_time)
                      : 0.9 * plot_.size;
    paper_.reserve_y(y_);
    area_.hi = glm::max(area_.hi, area_.lo + 10.0);
    x_ = plot_.over_time && plot_.seconds
             ? Axis::linear(0, *plot_.seconds, std::max(4, ticks_in(0))).cut_to(0, *plot_.seconds)
             : axis_of(xs_, plot_.log_x, ticks_in(0));
  }

  void draw() {
    if (xs_.empty() && !plot_.slide) return paper_.say_nothing(plot_.empty);
    if (!plot_.slide && (scaled().size().y < kLeastArea || area_.size().x < kLeastArea)) return;
    placed_ = place_series();
    draw_axes();
    const double width = 1.15 * style_.mark;
    const std::vector<Vec<2>> front =
        draw_front(on_page(plot_.front), {scaled().lo, area_.hi}, width, 0.3 * style_.mark, list_);
    PlotNamer namer({area_.lo + Vec<2>{4, 0}, area_.hi}, labels_);  // off the axis
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
  Box<2> scaled() const { return paper_.place.scaled(); }

  std::vector<Vec<2>> on_page(const std::vector<Vec<2>>& values) const {
    return mapped(values, [&](const Vec<2>& value) { return at(value); });
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
    for (const PlotSeries& series : plot_.series) {
      ColumnName& name = names.emplace_back();
      if (plot_.series.size() > 1) name.name = series.name;
      const auto newest = std::find_if(series.points.rbegin(), series.points.rend(),
                                       [&](const PlotPoint& p) { return is_drawn(p); });
      if (newest == series.points.rend()) continue;
      name.number = number_beside(newest->at.y);
    }
    return names;
  }
  std::string number_beside(double y) const {
    const int decimals = y_.decimals() > 1 && y_.decimals() < 7 ? y_.decimals() + 1 : 0;
    return decimals > 0 ? number_text(y, decimals) : short_number(y);
  }
  // With the longest number of the sequence, so that the axes keep their length.
  std::vector<ColumnName> widest_column() const {
    std::vector<ColumnName> names = column();
    if (!plot_.range) return names;
    for (ColumnName& name : names)
      for (const double y : {plot_.range->first, plot_.range->second})
        if (const std::string number = number_beside(y); number.size() > name.number.size())
          name.number = number;
    return names;
  }

  void draw_axes() {
    const PlotType& type = paper_.type;
    list_.crisp_rect(area_, Role::panel);
    paper_.upright_ticks(y_);
    const double end = area_.hi.y + type.tick_length();
    if (plot_.slide)
      paper_.level_ticks(x_, area_.hi.y, end, {Role::ink, 1.8}, 8, 12);
    else
      paper_.level_ticks(x_, scaled().lo.y, end, {Role::rule, 1.5 * type.unit}, 8 * type.unit, 8);
    paper_.axis_lines();
    paper_.name_x(plot_.x_name, plot_.x_note, plot_.slide ? type.name : type.tick);
  }

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
    ys_.add(plot_.range, plot_.log_y);
    xs_.add(plot_.x_range, plot_.log_x);
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
  void add_legend() {
    std::vector<LegendEntry> entries;
    for (const PlotSeries& s : plot_.series)
      if (has_points(s)) entries.push_back({s.name, s.look, s.is_peer});
    Box<2>& panel = paper_.place.panel;
    const double wanted = plot_legend_height(entries, panel.size().x, plot_.size);
    const double top = area_.hi.y - std::min(wanted, 0.45 * area_.size().y);
    draw_plot_legend(entries, {{panel.lo.x, top}, panel.hi}, plot_.size, list_, labels_);
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

  double edge_height(const auto& is, double air) const {
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

  // What follows shows this; on a slide, whose lines are one thing, nothing is told.
  std::unique_ptr<DrawList::Scope> shown(const std::string& key) {
    return plot_.slide ? nullptr : std::make_unique<DrawList::Scope>(list_, key);
  }

  // Lines end there, and reach a hair over its edge.
  Box<2> picture() const { return shrunk(area_, -2); }

  // On a slide each line has its marks before the next one is drawn, and what is newest lies on
  // top. The first line comes last: where others run along it, it keeps its colour.
  void draw_series(PlotNamer& namer) {
    for (std::size_t k = 0; k < placed_.size(); ++k) {
      const std::size_t i = plot_.slide ? placed_.size() - 1 - k : k;
      draw_line(placed_[i], namer);
      if (plot_.slide) draw_marks(i, namer);
    }
    for (const PlacedSeries& placed : placed_) draw_whiskers(placed, namer);
    for (auto p = placed_.rbegin(); plot_.slide && p != placed_.rend(); ++p)  // the newest
      if (!p->points.empty() && contains(picture(), p->points.back()))
        draw_plot_mark(p->series->ink(), p->points.back(), 1.7 * style_.mark, false, list_);
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

  void name_strip(PlotNamer& namer) {
    if (paper_.place.strip == 0) return;
    const double y = area_.lo.y + 3 + 1.35 * style_.mark + 0.36 * halo_.tick.size;
    namer.name(plot_.beyond,
               {{{area_.hi.x - 6, y}, 1}, {{area_.lo.x + 6, y}, 0}, {{area_.center().x, y}, 0.5}},
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

  const Plot& plot_;
  PlotStyle style_{plot_};
  PlotPaper paper_;
  Axis x_, y_;
  Box<2>& area_ = paper_.place.area;
  PlotRange xs_, ys_;
  bool with_legend_;
  PlotType halo_{plot_.size};  // of names inside the area
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
