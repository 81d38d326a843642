#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "draw/font.hpp"
#include "draw/plot_marks.hpp"
#include "report/bars.hpp"
#include "report/measure_plots.hpp"
#include "report/pages.hpp"

namespace lantern::report {
namespace {

constexpr double kLeastWidth = 1600;
constexpr double kTall = 1.41421356;  // height over width of an A3 page
constexpr double kCell = 320;         // least width of a small plot with its words
constexpr double kOverviewMargin = 56;
constexpr double kGap = 34;
constexpr double kSmall = 16.5, kCellText = 17.5;  // on A3, a page 1600 wide has 0.53 points a unit

const TextStyle kSmallPrint{kSmall, Weight::regular, Role::quiet_ink, Role::none};
const TextStyle kCellName{kCellText, Weight::semibold, Role::ink, Role::none};

class OverviewPage {
 public:
  OverviewPage(const Measurement& measurement, const std::vector<Bar>& bars)
      : measurement_(measurement),
        bars_(bars),
        problems_(by_problem(measurement.rows)),
        looks_(looks_of(measurement.rows)),
        labels_(list_) {
    for (const ProblemRows& problem : problems_)
      plots_.push_back(cost_plot(problem, seconds_of, looks_, false));
  }

  DrawList draw() {
    plan();
    double y = draw_head();
    y = draw_legend(y);
    y = draw_grid(y);
    draw_bars(y);
    draw_foot();
    return std::move(list_);
  }

 private:
  double inner() const { return width_ - 2 * kOverviewMargin; }
  Box<2> band(double top, double bottom) const {
    return {{kOverviewMargin, top}, {width_ - kOverviewMargin, bottom}};
  }
  double cell_width() const {
    return (inner() - kGap * static_cast<double>(columns_ - 1)) / static_cast<double>(columns_);
  }

  // As few columns as keep the page from being taller than A3, so that type is as large as can be.
  void plan() {
    legend_ = legend();
    const std::size_t n = problems_.size();
    columns_ = n <= 1 ? 1 : n <= 4 ? 2 : n <= 9 ? 3 : 4;
    plan_rows();
    while (list_.page.y > 1.02 * kTall * width_ && columns_ < 12) {
      ++columns_;
      plan_rows();
    }
  }

  // The width, and the height of a row of cells: what is left of the page, but enough to be read
  // and no more than is of use.
  void plan_rows() {
    const auto columns = static_cast<double>(columns_);
    width_ = std::max(kLeastWidth, 2 * kOverviewMargin + columns * (kCell + kGap) - kGap);
    const auto rows = static_cast<double>((problems_.size() + columns_ - 1) / columns_);
    const double head = 140, foot = 84;
    const double bars = bars_.empty() ? 0 : bars_table_height(bars_) + 24;
    const double fixed = head + foot + bars + plot_legend_height(legend_, inner(), kSmall) + 48;
    const double texts = 56;
    const double page = kTall * width_;
    row_ = rows > 0 ? (page - fixed) / rows : 0;
    const double tallest = columns_ > 2 ? 1.2 : 0.62;  // over the width
    row_ = std::clamp(row_, texts + 0.62 * cell_width(), texts + tallest * cell_width());
    const double needed = std::ceil(fixed + rows * row_);
    list_.page = {width_, columns_ > 2 ? std::max(page, needed) : needed};
  }

  // Lantern's methods first.
  std::vector<LegendEntry> legend() const {
    std::vector<LegendEntry> entries;
    for (const ProblemRows& problem : problems_)
      for (const MethodRows& method : by_method(problem)) {
        const LegendEntry entry{method.name(), looks_.at(method.method), method.is_peer};
        if (std::ranges::find(entries, entry.look, &LegendEntry::look) == entries.end())
          entries.push_back(entry);
      }
    std::ranges::stable_sort(entries, {}, &LegendEntry::is_peer);
    return entries;
  }

  void rule(double y) {
    list_.crisp_line({kOverviewMargin, y}, {width_ - kOverviewMargin, y}, {Role::ink, 2});
  }

  double draw_head() {
    const Box<2> place = band(30, 132);
    labels_.add("Error against run time", {{kOverviewMargin, 74}, 0},
                {38, Weight::semibold, Role::ink, Role::none}, place);
    const std::string how = fmt::format(
        "{} problem{}, {} runs. Each plot: a run's error (of the quantity named at its upper "
        "right) "
        "against its seconds, both logarithmic; lower left is better.",
        problems_.size(), problems_.size() == 1 ? "" : "s",
        std::ranges::count_if(measurement_.rows, &Row::was_run));
    labels_.add(shortened(how, inner(), {19, Weight::regular, Role::quiet_ink, Role::none}),
                {{kOverviewMargin, 110}, 0}, {19, Weight::regular, Role::quiet_ink, Role::none},
                place);
    rule(126);
    return 140;
  }

  double draw_legend(double y) {
    const double height = plot_legend_height(legend_, inner(), kSmall);
    draw_plot_legend(legend_, band(y, y + height), kSmall, list_, labels_);
    y += height + 4;
    const std::string rest =
        "Dashed: other engines. Open marks: runs that diverged, collapsed (placed by their steps "
        "if not timed) or were off. Thin bars: quartiles. Stairs: no run has both less error and "
        "less time. Dashed grey: estimated rounding floor.";
    labels_.add(shortened(rest, inner(), kSmallPrint), {{kOverviewMargin, y + 17}, 0}, kSmallPrint,
                band(y, y + 26));
    return y + 44;
  }

  double draw_grid(double y) {
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      const auto column = static_cast<double>(i % columns_);
      const auto row = static_cast<double>(i / columns_);
      const Vec<2> corner{kOverviewMargin + column * (cell_width() + kGap), y + row * row_};
      draw_cell(i, {corner, corner + Vec<2>{cell_width(), row_ - 26}});
    }
    const auto rows = static_cast<double>((problems_.size() + columns_ - 1) / columns_);
    return y + rows * row_;
  }

  void draw_cell(std::size_t i, const Box<2>& cell) {
    const std::string name = shortened(file_name(problems_[i]), cell.size().x, kCellName);
    labels_.add(name, {{cell.lo.x, cell.lo.y + 16}, 0}, kCellName, cell);
    const std::string norm = norm_words(main_norm(problems_[i]));
    labels_.try_add(norm, {{{cell.hi.x, cell.lo.y + 16}, 1}}, kSmallPrint, cell);
    Plot& plot = plots_[i];
    plot.names = PlotNames::none;
    plot.size = kSmall;
    plot.mark = columns_ < 3 ? 6 : columns_ < 4 ? 4.8 : 4.2;
    plot.front_name.clear();
    plot.empty = "no run was timed";
    for (PlotGuide& guide : plot.guides) guide.name.clear();
    draw_plot(plot, {{cell.lo.x, cell.lo.y + 22}, cell.hi}, list_, labels_);
  }

  void draw_bars(double y) {
    if (bars_.empty()) return;
    const double height = bars_table_height(bars_);
    draw_bars_table(bars_, band(y, y + height), list_, labels_);
  }

  void draw_foot() {
    const double y = list_.page.y - 62;
    rule(y);
    const Box<2> place = band(y, list_.page.y - 16);
    labels_.add(shortened(circumstances_text(measurement_.circumstances), inner(), kSmallPrint),
                {{kOverviewMargin, y + 30}, 0}, kSmallPrint, place);
  }

  const Measurement& measurement_;
  const std::vector<Bar>& bars_;
  std::vector<ProblemRows> problems_;
  Looks looks_;
  std::vector<Plot> plots_;
  std::vector<LegendEntry> legend_;
  std::size_t columns_ = 4;
  double width_ = kLeastWidth, row_ = 0;
  DrawList list_;
  Labels labels_;
};

}  // namespace

DrawList draw_overview(const Measurement& measurement, const std::vector<Bar>& bars) {
  return OverviewPage(measurement, bars).draw();
}

}  // namespace lantern::report
