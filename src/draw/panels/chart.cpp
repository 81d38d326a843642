#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "draw/plot_parts.hpp"
#include "frame/parts/panels.hpp"
#include "language/panel_rules.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::draw {
namespace {

constexpr double kChartType = 26;  // of names; the ticks' is the least that the back row reads
constexpr double kGoodRow = 32;    // a name has room in it
constexpr double kLeastRow = 28;   // names of neighbours do not touch
constexpr double kMostRow = 96;
constexpr double kGroupGap = 0.55, kLeastGroupGap = 0.2;  // between groups, in rows
constexpr double kAfter = 10;  // between a bar and its number, or its name
constexpr double kTickLine = 40;

std::string value_text(double value) {
  return value == std::floor(value) ? number_text(value) : short_number(value);
}

// The look that bars and lines named as a structure have in all charts.
std::optional<int> look_of_structure(const std::string& name) {
  for (const StructureKind kind : kStructureKinds)
    if (name == chart_words(std::string(to_string(kind)))) return static_cast<int>(kind) - 1;
  return std::nullopt;
}

// "energy, J": what is on the y axis, and in which unit.
std::string title_of(const FrameChart& chart) {
  const std::string name = chart_words(chart.y_name);
  return name + (name.empty() || chart.y_unit.empty() ? "" : ", ") + chart.y_unit;
}

// Each bar has its place from the beginning on: one that is still to come only its name.
class Bars : PanelPicture {
 public:
  explicit Bars(const PanelPicture& on) : PanelPicture(on) {
    for (const FrameBar& bar : chart_.bars) bars_.push_back({bar});
    const std::vector<FrameBar>& all = staging_.axes().bars(chart_.part);
    for (std::size_t i = bars_.size(); i < all.size(); ++i) bars_.push_back({all[i], true});
    std::erase_if(bars_, [](const Row& row) { return !std::isfinite(row.value); });
    for (Row& row : bars_) row.label = chart_words(row.label);
    std::ranges::stable_sort(bars_, {}, &FrameBar::group);
  }

  void draw() {
    paper_.heading(title(), type_.title);
    if (area_.lo.y > panel_.lo.y) area_.lo.y += 0.28 * type_.name.size;
    draw_key();
    find_room();
    if (bars_.empty()) return;
    measure();
    if (ticks_) paper_.level_ticks(axis_, area_.lo.y, area_.hi.y + 6, {Role::rule, 1.6}, 4, 14);
    double y = area_.lo.y + (row_ * gap_) / 4;
    for (std::size_t i = 0; i < bars_.size(); ++i) {
      if (i > 0 && bars_[i].group != bars_[i - 1].group) y += gap_ * row_;
      draw_bar(bars_[i], y);
      y += row_;
    }
    const double x = x_of(zero());
    list_.crisp_line({x, area_.lo.y}, {x, area_.hi.y}, {Role::ink, 2.2});
    if (!note_.empty())
      write(note_, {{area_.lo.x, panel_.hi.y - 0.3 * type_.tick.size}, 0}, type_.tick);
  }

 private:
  struct Row : FrameBar {
    bool is_to_come = false;
  };

  std::string title() const {
    const std::string name = chart_.y_unit.empty() && !chart_.y_name.empty()
                                 ? count_words(frame_, chart_.y_name, kMany)
                                 : title_of(chart_);
    if (!chart_.logarithmic) return name;
    return name + (name.empty() ? "" : ", ") + word("logarithmic scale");
  }

  // What the pieces of bars are called.
  void draw_key() {
    if (chart_.pieces.empty()) return;
    double x = panel_.lo.x;
    const double y = area_.lo.y + 0.5 * kTickLine;
    for (std::size_t i = 0; i < chart_.pieces.size(); ++i) {
      const std::string words = chart_words(chart_.pieces[i]);
      list_.rect({{x, y - 9}, {x + 18, y + 9}}, piece_role(i), {Role::body_line, 1.2}, 2);
      write(words, centred({x + 26, y}, type_.tick, 0), type_.tick);
      x += 44 + text_width(words, type_.tick);
    }
    area_.lo.y += kTickLine;
  }

  // Of all bars: the last piece has that of bars of one quantity.
  Role piece_role(std::size_t piece) const {
    return piece + 1 < chart_.pieces.size() ? Role::quiet_ink : plot_role(0);
  }

  double rows() const {
    return static_cast<double>(bars_.size()) + gap_ * static_cast<double>(groups() - 1) + gap_ / 2;
  }
  std::size_t groups() const {
    std::size_t count = 1;
    for (std::size_t i = 1; i < bars_.size(); ++i) count += bars_[i].group != bars_[i - 1].group;
    return count;
  }

  double below() const { return kTickLine * ((ticks_ ? 1 : 0) + (note_.empty() ? 0 : 1)); }
  bool fits(double row) const { return rows() * row <= area_.size().y - below(); }

  // The newest bar but for the last one, whose step is told of, and the largest, which is never
  // left out.
  std::ptrdiff_t spare() const {
    const auto length = [](const FrameBar& bar) { return std::abs(bar.value); };
    const auto largest = std::ranges::max_element(bars_, {}, length) - bars_.begin();
    const auto last = std::ssize(bars_) - 1;
    if (last == 1) return largest == 0 ? 1 : 0;
    return largest == last - 1 ? last - 2 : last - 1;
  }

  // Gaps between groups shrink first, then rows; then ticks go, for each bar has its number; then
  // bars.
  void find_room() {
    if (fits(kGoodRow)) return;
    gap_ = kLeastGroupGap;
    if (fits(kLeastRow)) return;
    std::erase_if(bars_, [](const Row& row) { return row.is_to_come; });
    if (fits(kLeastRow)) return;
    ticks_ = false;
    const std::size_t all = bars_.size();
    while (bars_.size() > 1 && !fits(kLeastRow)) {
      note_ = " ";
      bars_.erase(bars_.begin() + spare());
    }
    if (!fits(kLeastRow)) bars_.clear();
    if (bars_.size() < all)
      note_ = shortened(say("and {} more", all - bars_.size()), panel_.size().x, type_.tick);
  }

  void measure() {
    double least = 0, most = 0, above_zero = 1e300, names = 0, values = 0;
    for (const FrameBar& bar : bars_) {
      least = std::min(least, bar.value);
      most = std::max(most, bar.value);
      if (bar.value > 0) above_zero = std::min(above_zero, bar.value);
      names = std::max(names, text_width(bar.label, type_.name));
      values = std::max(values, text_width(value_text(bar.value), type_.title));
    }
    if (range_) {
      least = std::min(least, range_->first);
      most = std::max(most, range_->second);
      if (range_->first > 0) above_zero = std::min(above_zero, range_->first);
      values = std::max(values, text_width(value_text(most), type_.title));
    }
    names += 1;  // sums of widths lose a hair
    values += 1;
    const double width = panel_.size().x, number = std::min(values, 0.35 * width) + kAfter;
    // Bars keep a fifth of it.
    area_.lo.x += std::min(names, std::max(0.4 * width, 0.8 * width - number - kAfter)) + kAfter;
    area_.hi.x -= number + (chart_.logarithmic ? 13 : 0);
    area_.hi.y -= below();
    row_ = std::min(kMostRow, area_.size().y / rows());
    area_.hi.y = area_.lo.y + rows() * row_;
    const int ticks = std::clamp(static_cast<int>(area_.size().x / 110), 2, 8);
    if (chart_.logarithmic) {
      // From 1 on where that is not far; otherwise half a decade less than the least bar, so that
      // it has a length.
      const double low = most > 0 ? above_zero : 1;
      axis_ = Axis::logarithmic(low >= 1 && low < 1e5 ? 1 : low / 3, std::max(most, low), ticks);
    } else {
      axis_ = Axis::linear(least, most, ticks);
    }
  }

  double zero() const { return chart_.logarithmic ? 0 : std::max(0.0, axis_.low()); }
  double x_of(double value) const { return area_.lo.x + axis_.share(value) * area_.size().x; }

  // A structure's, or that of all bars of one quantity or side.
  Role color_of(const FrameBar& bar) const {
    if (!bar.pieces.empty()) return piece_role(bar.pieces.size() - 1);
    return plot_role(look_of_structure(bar.label).value_or(bar.line));
  }

  void draw_bar(const Row& bar, double top) {
    const double thick = std::min(0.7 * row_, 52.0), middle = top + row_ / 2;
    const double room = area_.lo.x - panel_.lo.x - kAfter;
    TextStyle style = type_.name;
    if (bar.is_to_come) style.role = Role::quiet_ink;
    write(shortened(bar.label, room, style), centred({area_.lo.x - kAfter, middle}, style, 1),
          style);
    if (bar.is_to_come) return;
    const double from = x_of(zero()), to = x_of(bar.value);
    if (chart_.logarithmic) {
      draw_dot(bar, {to, middle}, std::min(0.24 * row_, 13.0));
    } else {
      const Box<2> box{{std::min(from, to), middle - thick / 2},
                       {std::max(from, to), middle + thick / 2}};
      if (box.size().x > 0.5) list_.rect(box, color_of(bar), {Role::body_line, 1.2}, 2);
      double sum = 0;
      for (std::size_t i = 0; i + 1 < bar.pieces.size(); ++i) {
        const double begin = x_of(std::exchange(sum, sum + bar.pieces[i])), end = x_of(sum);
        if (end - begin > 0.5)
          list_.rect({{begin, box.lo.y}, {end, box.hi.y}}, piece_role(i), {Role::body_line, 1.2},
                     2);
      }
    }
    const double left = std::max(from, to) + kAfter + (chart_.logarithmic ? 13 : 0);
    write(shortened(value_text(bar.value), panel_.hi.x - left, type_.title),
          centred({left, middle}, type_.title, 0), type_.title);
  }

  // A logarithmic axis has no beginning, so nothing is as long as its value: only places say it.
  void draw_dot(const FrameBar& bar, const Vec<2>& at, double radius) {
    list_.crisp_line({area_.lo.x, at.y}, {at.x, at.y}, {Role::cell_line_3, 1.6, 3});
    if (bar.value > 0) list_.disc(at, radius, color_of(bar), {Role::body_line, 1.6});
  }

  const FrameChart& chart_ = frame_.get<FrameChart>();
  AxisRanges::Ends range_ = staging_.axes().chart();  // of all charts of the sequence
  PlotPaper paper_{panel_, kChartType, list_, labels_};
  const PlotType& type_ = paper_.type;
  Box<2>& area_ = paper_.place.area;
  std::vector<Row> bars_;
  std::string note_;
  double row_ = kLeastRow, gap_ = kGroupGap;
  bool ticks_ = true;
  Axis axis_;
};

Plot plot_of(const FrameChart& chart, const AxisRanges& axes) {
  Plot plot;
  plot.slide = true;
  plot.names = PlotNames::column;
  plot.over_time = chart.over_time;
  plot.seconds = chart.seconds;
  plot.least = chart.least;
  plot.most = chart.most;
  plot.range = axes.chart();
  if (!chart.over_time) plot.x_range = axes.chart_x();
  plot.log_y = chart.logarithmic;
  plot.log_x = chart.logarithmic && !chart.over_time;
  plot.x_name = chart.over_time ? word("time, s") : chart_words(chart.x_name);
  if (!chart.x_unit.empty()) plot.x_name += ", " + chart.x_unit;
  if (plot.log_x)
    plot.x_note = plot.x_name.empty() ? word("both logarithmic")
                                      : fmt::format("  ({})", word("both logarithmic"));
  plot.title = title_of(chart);
  const bool of_structures = std::ranges::all_of(chart.series, [](const FrameSeries& series) {
    return look_of_structure(chart_words(series.name)).has_value();
  });
  for (const FrameSeries& series : chart.series) {
    PlotSeries& line = plot.series.emplace_back();
    line.name = series.label.empty() ? chart_words(series.name) : series.label;
    line.look = static_cast<int>(plot.series.size()) - 1;
    line.color = series.color;
    if (const auto look = of_structures ? look_of_structure(line.name) : std::nullopt)
      line.look = *look;
    for (const Vec<2>& p : series.points) line.points.push_back({p});
  }
  if (plot.series.size() == 1 && plot.title.empty()) plot.title = plot.series[0].name;
  if (plot.over_time && plot.log_y && !plot.title.empty())
    plot.title += fmt::format("  ({})", word("logarithmic"));
  return plot;
}

void draw_chart(const Frame& frame, const Staging& staging, const Box<2>& place, DrawList& list,
                Labels& labels) {
  const FrameChart& chart = frame.get<FrameChart>();
  for (const std::string& name : {chart.x_name, chart.y_name}) list.referents.insert(name);
  for (const FrameSeries& series : chart.series)
    list.referents.insert({series.name, chart.y_name + "." + series.name});
  // A chart of bars has no axes before its first bar.
  const bool of_bars = !chart.bars.empty() ||
                       (chart.x_name.empty() && !chart.y_name.empty() && chart.series.empty());
  if (of_bars) return Bars({frame, staging, place, list, labels}).draw();
  Plot plot = plot_of(chart, staging.axes());
  plot.size = kChartType;
  draw_plot(plot, place, list, labels);
}

}  // namespace

// One count against another as lines, or counts as bars. Lines carry marks of different shapes and
// their names at their ends; the newest point of each is larger and says its number. Bars lie
// level in groups, their names before and their numbers behind them. Points that
// are not finite are left out; what there is no room for is said.
PanelEntry chart_panel() {
  const auto has_points = [](const Frame& frame) {
    const FrameChart& chart = frame.get<FrameChart>();
    return !chart.bars.empty() || std::ranges::any_of(chart.series, [](const FrameSeries& line) {
      return !line.points.empty();
    });
  };
  return {{.name = "chart",
           .words = "the `chart`",
           .needs = "it needs a [chart]",
           .possible = language::has_chart,
           .place = 5,
           .by_itself = language::has_chart,
           .of_all_sides = true,
           .example = [] { return language::example_of("chart"); }},
          {.shows = {{"points or bars", has_points}}},
          {.draw = draw_chart, .enough = 300, .inset = 4, .smallest = {40, 40}}};
}

}  // namespace lantern::draw
