#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "draw/chart_parts.hpp"
#include "draw/clip.hpp"
#include "draw/font.hpp"
#include "draw/number_text.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostSeries = 12;
constexpr std::size_t kMostPieces = 2400;  // of all lines together
constexpr double kNameBeside = 16;         // between a line's end and its name
constexpr double kNamesEvery = 80;         // the room for names grows by so much
constexpr double kLineTick = 7;
constexpr double kMarkEvery = 24;  // page units between two marks of a line

struct ValueRange {
  double least = 1e300, most = -1e300, above_zero = 1e300;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
    if (value > 0) above_zero = std::min(above_zero, value);
  }
};

Axis axis_for(const ValueRange& range, bool logarithmic, int ticks) {
  if (range.least > range.most) return Axis::linear(0, 1, 2);
  if (!logarithmic) return Axis::linear(range.least, range.most, ticks);
  const double low = range.above_zero < 1e300 ? range.above_zero : 1;
  return Axis::logarithmic(low, std::max(range.most, low), ticks);
}

// A line on the page, with what stands at its end.
struct Line {
  std::size_t look = 0;
  int color = 1;
  std::string name, number;
  std::vector<Vec<2>> values, points;
  double label = 0;  // y of its name's middle
};

class Lines {
 public:
  Lines(const FrameChart& chart, const Box<2>& panel, DrawList& list, Labels& labels)
      : chart_(chart), panel_(panel), type_(panel), list_(list), labels_(labels) {
    for (const FrameSeries& series : chart.series) {
      Line line;
      line.look = lines_.size();
      line.color = series.color > 0 ? series.color : chart_color(line.look);
      line.name = chart_words(series.name);
      for (const Vec<2>& p : series.points)
        if (std::isfinite(p.x) && std::isfinite(p.y)) line.values.push_back(p);
      if (lines_.size() < kMostSeries) lines_.push_back(std::move(line));
    }
  }

  void draw() {
    measure();
    draw_axes();
    for (const bool strong : {false, true})  // what is newest lies on top
      for (Line& line : lines_) strong ? draw_end(line) : draw_line(line);
    name_lines();
  }

 private:
  double line_height() const { return 1.35 * type_.name.size; }  // from one name to the next
  double under_ticks() const { return kLineTick + 8 + 0.78 * type_.tick.size; }
  bool alone() const { return chart_.series.size() <= 1; }

  // Finer than the ticks are, or what has changed would not be seen.
  std::string newest(const Line& line) const {
    if (line.values.empty()) return "";
    const double y = line.values.back().y;
    return y_.decimals() > 1 && y_.decimals() < 7 ? number_text(y, y_.decimals() + 1)
                                                  : short_number(y);
  }

  void measure() {
    ValueRange xs, ys;
    for (const Line& line : lines_)
      for (const Vec<2>& p : line.values) {
        xs.add(p.x);
        ys.add(p.y);
      }
    std::string y_name = chart_words(alone() && !chart_.series.empty() && chart_.y_name.empty()
                                         ? chart_.series[0].name
                                         : chart_.y_name);
    if (chart_.over_time && chart_.logarithmic && !y_name.empty()) y_name += "  (logarithmic)";
    area_ = panel_;
    area_.lo.y += std::max(10.0, draw_chart_heading(y_name, panel_, labels_));
    area_.hi.y -= under_ticks() + 8 + (chart_.x_name.empty() ? 0 : 1.5 * type_.name.size);
    const double apart = chart_.over_time ? 34 : 50;  // such charts may be low
    y_ = y_axis(ys, std::clamp(int(area_.size().y / apart), 2, 9));
    double names = 0;
    for (Line& line : lines_) {
      line.number = newest(line);
      const double name = alone() ? 0 : text_width(line.name, type_.name) + 10;
      names = std::max(names, name + text_width(line.number, type_.number));
    }
    // Over time the numbers change from frame to frame: the area must not.
    if (chart_.over_time)
      names = std::ceil((names + text_width("0.000", type_.number)) / kNamesEvery) * kNamesEvery;
    area_.hi.x -= std::min(names + 1, 0.42 * panel_.size().x) + kNameBeside + 4;
    double numbers = 0;
    for (const Axis::Tick& tick : y_.ticks())
      numbers = std::max(numbers, text_width(tick.text, type_.tick));
    area_.lo.x += std::min(numbers + 1, 0.3 * panel_.size().x) + kLineTick + 8;
    area_.hi.x = std::max(area_.hi.x, area_.lo.x + 10);
    area_.hi.y = std::max(area_.hi.y, area_.lo.y + 10);
    const int x_ticks = std::clamp(int(area_.size().x / 96), 2, 10);
    if (chart_.over_time && chart_.seconds)
      x_ = Axis::linear(0, *chart_.seconds, std::max(4, x_ticks)).cut_to(0, *chart_.seconds);
    else
      x_ = axis_for(xs, chart_.logarithmic && !chart_.over_time, x_ticks);
    for (Line& line : lines_)
      for (const Vec<2>& p : line.values) line.points.push_back(at(p));
  }

  bool cuts() const { return chart_.least || chart_.most; }

  // Up to the ends that the scenario asks for; lines go on beyond them and are cut.
  Axis y_axis(ValueRange range, int ticks) const {
    if (!cuts()) return axis_for(range, chart_.logarithmic, ticks);
    if (range.least > range.most) range.add(chart_.least.value_or(chart_.most.value_or(1)));
    const double low = chart_.least.value_or(
        std::min(chart_.logarithmic ? range.above_zero : range.least, *chart_.most));
    const double high = chart_.most.value_or(std::max(range.most, low));
    return axis_for({low, high, low}, chart_.logarithmic, ticks).cut_to(chart_.least, chart_.most);
  }

  // Not farther out than a few panels: beyond, only the direction matters.
  Vec<2> at(const Vec<2>& value) const {
    const double x = cuts() ? std::clamp(x_.place(value.x), -4.0, 5.0) : x_.share(value.x);
    const double y = cuts() ? std::clamp(y_.place(value.y), -4.0, 5.0) : y_.share(value.y);
    return {area_.lo.x + x * area_.size().x, area_.hi.y - y * area_.size().y};
  }
  Box<2> picture() const { return shrunk(area_, -2); }
  bool is_in_picture(const Vec<2>& p) const { return holds(picture(), Box<2>{p, p}); }

  void draw_axes() {
    list_.shapes.emplace_back(RectShape{area_, 0, Role::panel, {}, true});
    double last = 1e9;
    for (const Axis::Tick& tick : y_.ticks()) {
      const double y = area_.hi.y - y_.share(tick.value) * area_.size().y;
      list_.shapes.emplace_back(
          LineShape{{area_.lo.x - kLineTick, y}, {area_.hi.x, y}, {Role::rule, 1.5, 0}, true});
      if (y > last - 22) continue;
      const double room = area_.lo.x - kLineTick - 6 - panel_.lo.x;
      labels_.try_add(shortened(tick.text, room, type_.tick),
                      {{{area_.lo.x - kLineTick - 6, y + 0.36 * type_.tick.size}, 1}}, type_.tick,
                      panel_);
      last = y;
    }
    last = -1e9;
    for (const Axis::Tick& tick : x_.ticks()) {
      const double x = area_.lo.x + x_.share(tick.value) * area_.size().x;
      const double half = text_width(tick.text, type_.tick) / 2;
      list_.shapes.emplace_back(
          LineShape{{x, area_.hi.y}, {x, area_.hi.y + kLineTick}, {Role::ink, 1.8, 0}, true});
      if (x - half < last + 12) continue;
      if (labels_.try_add(tick.text, {{{x, area_.hi.y + under_ticks()}, 0.5}}, type_.tick, panel_))
        last = x + half;
    }
    for (const Vec<2>& end : {Vec<2>(area_.lo.x, area_.lo.y), Vec<2>(area_.hi.x, area_.hi.y)})
      list_.shapes.emplace_back(
          LineShape{{area_.lo.x, area_.hi.y}, end, {Role::ink, 2.2, 0}, true});
    name_x();
  }

  void name_x() {
    const std::string plain = chart_.over_time ? "time in s" : chart_words(chart_.x_name);
    std::string name = plain;
    if (chart_.logarithmic && !chart_.over_time)
      name += name.empty() ? "both logarithmic" : "  (both logarithmic)";
    const double left = area_.lo.x, right = panel_.hi.x;
    std::string fitting = shortened(name, right - left, type_.name);
    if (fitting != name) fitting = shortened(plain, right - left, type_.name);
    const double half = text_width(fitting, type_.name) / 2;
    const double x = std::clamp(area_.center().x, left + half, std::max(left + half, right - half));
    labels_.try_add(fitting, {{{x, panel_.hi.y - 7}, 0.5}}, type_.name, panel_);
  }

  // Many points become as many as the page can tell apart: of each part of the line its first,
  // lowest, highest and last point.
  std::vector<Vec<2>> thinned(const std::vector<Vec<2>>& points) const {
    const std::size_t most = std::max<std::size_t>(60, kMostPieces / lines_.size());
    if (points.size() <= most) return points;
    std::vector<Vec<2>> kept;
    const std::size_t parts = most / 4;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t from = points.size() * part / parts;
      const std::size_t to = points.size() * (part + 1) / parts - 1;
      std::size_t low = from, high = from;
      for (std::size_t i = from; i <= to; ++i) {
        if (points[i].y < points[low].y) low = i;
        if (points[i].y > points[high].y) high = i;
      }
      for (const std::size_t i : {from, std::min(low, high), std::max(low, high), to})
        if (kept.empty() || kept.back() != points[i]) kept.push_back(points[i]);
    }
    return kept;
  }

  void draw_line(const Line& line) {
    const Role role = body_role(line.color);
    const std::vector<Vec<2>> points = thinned(line.points);
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].x == points[i - 1].x) continue;  // the same x again begins a line anew
      const auto seen = cut_line(points[i - 1], points[i], picture());
      if (seen)
        list_.shapes.emplace_back(LineShape{seen->first, seen->second, {role, 3, 0}, false});
    }
    const Vec<2>* last = nullptr;  // marks that are not too close
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      if (!is_in_picture(points[i])) continue;
      if (last && std::hypot(points[i].x - last->x, points[i].y - last->y) < kMarkEvery) continue;
      last = &points[i];
      draw_chart_mark(line.look, line.color, points[i], 5, list_);
    }
  }

  void draw_end(const Line& line) {
    if (line.points.empty() || !is_in_picture(line.points.back())) return;
    draw_chart_mark(line.look, line.color, line.points.back(), 8.5, list_);
  }

  // Names beside the ends, moved apart where they would cover each other, the highest end first.
  void name_lines() {
    std::vector<Line*> order;
    for (Line& line : lines_)
      if (!line.points.empty()) order.push_back(&line);
    std::stable_sort(order.begin(), order.end(), [](const Line* a, const Line* b) {
      return a->points.back().y < b->points.back().y;
    });
    const auto height_of = [&](const Line& line) {
      return std::clamp(line.points.back().y, area_.lo.y, area_.hi.y);
    };
    const double top = panel_.lo.y + 14, bottom = area_.hi.y - 8;
    const auto most = static_cast<std::size_t>(std::max(1.0, (bottom - top) / line_height()));
    if (order.size() > most) order.resize(most);
    double least = top;
    for (Line* line : order) {
      line->label = std::max(least, height_of(*line));
      least = line->label + line_height();
    }
    double limit = bottom;
    for (std::size_t i = order.size(); i-- > 0;) {
      order[i]->label = std::min(order[i]->label, limit);
      limit = order[i]->label - line_height();
    }
    for (const Line* line : order) name_line(*line);
    const std::size_t left_out = chart_.series.size() - order.size();
    if (left_out > 0 && order.size() == most)
      labels_.try_add(fmt::format("and {} more", left_out),
                      {{{panel_.hi.x, area_.hi.y + under_ticks()}, 1}}, type_.tick, panel_);
  }

  void name_line(const Line& line) {
    Vec<2> end = line.points.back();
    end.y = std::clamp(end.y, area_.lo.y, area_.hi.y);
    const bool newest_at_edge = end.x > area_.hi.x - 40;
    const double x = area_.hi.x + kNameBeside;
    const double y = line.label + 0.36 * type_.name.size;
    if (std::abs(line.label - end.y) > 4 || !newest_at_edge)
      list_.shapes.emplace_back(LineShape{{std::min(end.x + 12, x - 5), end.y},
                                          {x - 5, line.label},
                                          {Role::cell_line_3, 1.4, newest_at_edge ? 0.0 : 4.0},
                                          false});
    const double room = panel_.hi.x - x;
    const std::string number = shortened(line.number, room, type_.number);
    const double number_width = text_width(number, type_.number);
    labels_.try_add(number, {{{x, y}, 0}}, type_.number, panel_);
    if (alone()) return;
    const std::string name = shortened(line.name, room - number_width - 8, type_.name);
    if (!name.empty()) labels_.try_add(name, {{{x + number_width + 8, y}, 0}}, type_.name, panel_);
  }

  const FrameChart& chart_;
  Box<2> panel_;
  ChartType type_;
  DrawList& list_;
  Labels& labels_;
  std::vector<Line> lines_;
  Box<2> area_;
  Axis x_ = Axis::linear(0, 1, 2), y_ = Axis::linear(0, 1, 2);
};

}  // namespace

void draw_lines_chart(const FrameChart& chart, const Box<2>& panel, DrawList& list,
                      Labels& labels) {
  Lines(chart, panel, list, labels).draw();
}

}  // namespace lantern
