#include <algorithm>

#include "draw/plot_parts.hpp"
#include "geometry/not_finite.hpp"

namespace lantern::draw {
namespace {

constexpr double kMostForNames = 0.45;  // of the panel's width, for the lanes' names

struct Lane {
  const PlotSeries* series = nullptr;
  std::vector<const PlotPoint*> points;
  double y = 0;  // of its middle, page units
};

struct Band {
  std::string name;
  bool lowest = false;
  std::vector<Lane> lanes;
  double top = 0, bottom = 0, named_to = 0;  // page units
};

class BandDrawing {
 public:
  BandDrawing(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels)
      : plot_(plot), paper_(panel, plot.size, list, labels), list_(list), labels_(labels) {}

  void draw() {
    prepare();
    if (!(least_ <= most_)) return paper_.say_nothing(plot_.empty);
    if (pitch_ < 3 || area_.size().x < 24) return;
    list_.crisp_rect(area_, Role::panel);
    paper_.level_ticks(x_, area_.lo.y, area_.hi.y + type_.tick_length(),
                       {Role::rule, 1.5 * type_.unit}, 8 * type_.unit, 8);
    paper_.axis_lines();
    paper_.name_x(plot_.x_name, plot_.x_note, type_.tick);
    for (Band& band : bands_) draw_band(band);
    draw_front();
    for (const Band& band : bands_)
      for (const Lane& lane : band.lanes) draw_lane(lane, !band.lowest);
    for (const Band& band : bands_) name_points(band);
  }

  bool names_lanes() {
    prepare();
    return named_;
  }

 private:
  double radius() const {
    const double wanted = plot_.mark > 0 ? plot_.mark : 0.31 * plot_.size;
    return std::min(wanted, 0.36 * pitch_);
  }

  void prepare() {
    paper_.heading(plot_.title, type_.title);
    paper_.heading(plot_.y_name, type_.tick);
    sort_into_bands();
    paper_.reserve_x(!plot_.x_name.empty());
    area_.lo.y += 6;
    if (least_ <= most_) lay_out();  // else there is nothing to be seen
  }

  // The highest band first.
  void sort_into_bands() {
    bands_.push_back({plot_.beyond, false, {}});
    for (std::size_t i = plot_.bands.size(); i-- > 0;)
      bands_.push_back({plot_.bands[i].name, i == 0, {}});
    for (const PlotSeries& series : plot_.series)
      for (std::size_t b = 0; b < bands_.size(); ++b) {
        Lane lane{&series, {}};
        for (const PlotPoint& p : series.points)
          if (plot_.has_place(p) && is_in(p, b)) lane.points.push_back(&p);
        for (const PlotPoint* p : lane.points) {
          const Vec<2> reach = spread_of(*p);
          least_ = std::min(least_, reach.x);
          most_ = std::max(most_, reach.y);
        }
        if (!lane.points.empty()) bands_[b].lanes.push_back(std::move(lane));
      }
    std::erase_if(bands_, [](const Band& band) { return band.lanes.empty() && !band.lowest; });
  }

  bool is_in(const PlotPoint& p, std::size_t band) const {
    if (band == 0 || p.beyond) return band == 0 && p.beyond;
    return plot_.bands[plot_.bands.size() - band].holds(p.at.y);
  }

  // Of x, from the least to the most; the point alone where it has none.
  Vec<2> spread_of(const PlotPoint& p) const {
    const Vec<2> spread = p.spread ? Vec<2>(p.spread->lo.x, p.spread->hi.x) : Vec<2>(p.at.x);
    const bool has_places = is_finite(spread) && (!plot_.log_x || spread.x > 0);
    return has_places ? spread : Vec<2>(p.at.x);
  }

  void lay_out() {
    double lanes = 0;
    for (const Band& band : bands_) lanes += std::max(0.6, static_cast<double>(band.lanes.size()));
    const auto bands = static_cast<double>(bands_.size());
    // Where there is little room bands have no line of their own for their names.
    heading_ = 1.5 * type_.tick.size;
    if (bands * (heading_ + 6) > 0.5 * area_.size().y) heading_ = 0;
    const double height = area_.size().y - bands * (heading_ + 6);
    pitch_ = std::min(height / lanes, 2.6 * plot_.size);
    const double air = (height - lanes * pitch_) / bands;
    named_ = plot_.names != PlotNames::none && pitch_ >= 1.12 * plot_.size;
    area_.lo.x += named_ ? std::min(widest_name() + 12,
                                    kMostForNames * paper_.place.panel.size().x)
                         : 1.8 * radius();  // a mark at the axis stays in the panel
    area_.hi.x -= 0.9 * plot_.size;
    const int ticks = std::clamp(static_cast<int>(area_.size().x / (3.6 * plot_.size)), 2, 10);
    x_ = plot_.log_x ? Axis::fitted(least_, most_, ticks) : Axis::linear(least_, most_, ticks);
    double y = area_.lo.y;
    for (Band& band : bands_) {
      band.top = y;
      for (std::size_t i = 0; i < band.lanes.size(); ++i)
        band.lanes[i].y = y + heading_ + air / 2 + (static_cast<double>(i) + 0.5) * pitch_;
      y += heading_ + 6 + air + pitch_ * std::max(0.6, static_cast<double>(band.lanes.size()));
      band.bottom = y;
    }
  }

  double widest_name() const {
    double widest = 0;
    for (const Band& band : bands_)
      for (const Lane& lane : band.lanes)
        widest = std::max(widest, text_width(lane.series->name, type_.name));
    return widest;
  }

  double x_of(double value) const { return area_.lo.x + x_.place(value) * area_.size().x; }

  void draw_band(Band& band) {
    if (&band != &bands_.front())
      list_.crisp_line({area_.lo.x, band.top}, {area_.hi.x, band.top}, {Role::ink, 1.2});
    TextStyle style = band.lowest ? type_.title : type_.tick;
    style.size = type_.tick.size;
    style.halo = Role::panel;
    const std::string name = band.lanes.empty() ? band.name + ": none" : band.name;
    band.named_to = area_.lo.x + 8 + text_width(name, style);
    labels_.try_add(shortened(name, area_.size().x - 16, style),
                    {{{area_.lo.x + 8, band.top + 1.08 * style.size}, 0}}, style, area_);
  }

  // A stripe through the band of the least error, at the point where it is had for the least. Who
  // is wrong for less is no example.
  void draw_front() {
    if (plot_.front.empty()) return;
    const Vec<2>& best = plot_.front.back();
    const auto range =
        std::ranges::find_if(plot_.bands, [&](const PlotBand& b) { return b.holds(best.y); });
    if (range == plot_.bands.end()) return;
    const auto band = std::ranges::find(bands_, range->name, &Band::name);
    if (band == bands_.end()) return;
    const double x = x_of(best.x), width = 1.15 * 0.31 * plot_.size;
    const Vec<2> from{x, band->top + heading_}, to{x, band->bottom - 3};
    list_.line(from, to, {Role::lit, width});
    list_.line(from, to, {Role::lit_fill, 0.74 * width});
    TextStyle style = type_.tick;
    style.role = Role::lit_ink;
    style.halo = Role::panel;
    const double y = band->top + 1.08 * style.size;
    labels_.try_add(plot_.front_name,
                    {{{x, y}, 0.5}, {{x, y}, 1}, {{std::max(x, band->named_to + 10), y}, 0}}, style,
                    area_);
  }

  void draw_lane(const Lane& lane, bool open) {
    list_.crisp_line({area_.lo.x, lane.y}, {area_.hi.x, lane.y}, {Role::rule, 1.2});
    const Vec<2> end{area_.lo.x - 9, lane.y + 0.36 * type_.name.size};
    if (named_)
      labels_.try_add(shortened(lane.series->name, end.x - paper_.place.panel.lo.x, type_.name),
                      {{end, 1}}, type_.name, paper_.place.panel);
    const auto at = [&](const PlotPoint* p) { return Vec<2>{x_of(p->at.x), lane.y}; };
    const auto& [series, points, _] = lane;
    const std::string key = plot_key(plot_, *series);
    const DrawList::Scope lines(list_, key);
    for (std::size_t i = 1; i < points.size() && !open; ++i)
      draw_plot_line(series->ink(), at(points[i - 1]), at(points[i]), 0.44 * radius(), list_);
    const DrawList::Scope whiskers(list_, key + "/whiskers");
    for (const PlotPoint* p : points)
      if (const Vec<2> spread = spread_of(*p); spread.x < spread.y)
        draw_plot_whisker(series->ink(), {x_of(spread.x), lane.y}, {x_of(spread.y), lane.y},
                          radius(), list_);
    for (const PlotPoint* p : points) {
      const DrawList::Scope mark(list_, plot_key(plot_, *series, *p));
      draw_plot_mark(series->ink(), at(p), radius(), open, list_);
    }
  }

  void name_points(const Band& band) {
    PlotNamer namer(area_, labels_);
    for (const Lane& lane : band.lanes)
      for (const PlotPoint* p : lane.points) namer.mark({x_of(p->at.x), lane.y}, 1.2 * radius());
    const double r = 1.5 * radius() + 3, drop = 0.36 * type_.tick.size;
    for (const Lane& lane : band.lanes)
      for (const PlotPoint* p : lane.points) {
        const Vec<2> at{x_of(p->at.x), lane.y + drop};
        if (!p->note.empty())
          namer.name(p->note, {{at + Vec<2>{r, 0}, 0}, {at - Vec<2>{r, 0}, 1}}, type_.tick, 0);
      }
  }

  const Plot& plot_;
  PlotPaper paper_;
  Box<2>& area_ = paper_.place.area;
  const PlotType& type_ = paper_.type;
  DrawList& list_;
  Labels& labels_;
  std::vector<Band> bands_;
  Axis x_;
  double least_ = 1e300, most_ = -1e300, pitch_ = 0, heading_ = 0;
  bool named_ = false;
};

}  // namespace

bool names_its_lanes(const Plot& plot, const Box<2>& panel) {
  if (plot.bands.empty()) return false;
  DrawList list;
  Labels labels(list);
  return BandDrawing(plot, panel, list, labels).names_lanes();
}

void draw_banded_plot(const Plot& plot, const Box<2>& panel, DrawList& list, Labels& labels) {
  BandDrawing(plot, panel, list, labels).draw();
}

}  // namespace lantern::draw
