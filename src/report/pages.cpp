#include "report/pages.hpp"

#include "draw/font.hpp"
#include "report/measure_document.hpp"

namespace lantern::report {
namespace {

constexpr double kMargin = 60;

// --- tables ---

// Draws what stands in a cell itself; false if that is its text.
using DrawCell = std::function<bool(std::size_t line, std::size_t column, const Box<2>& place)>;

class TablePicture {
 public:
  // `ends` are the columns' right ends, as shares of the width.
  TablePicture(const Table& table, double left, double width, std::vector<double> ends, double size)
      : table_(table), left_(left), width_(width), ends_(std::move(ends)), size_(size) {
    for (const Table::Line& line : table.lines) {
      auto& cells = cells_.emplace_back();
      std::size_t most = 1;
      for (std::size_t c = 0; c < line.cells.size(); ++c) {
        cells.push_back(wrapped(line.cells[c].text, to(c) - from(c) - 0.6 * size, style(line, c)));
        most = std::max(most, cells.back().size());
      }
      heights_.push_back(1.15 * size * static_cast<double>(most) + 0.5 * size);
    }
  }

  double height() const {
    double sum = 2 * size_;
    for (const double height : heights_) sum += height;
    return sum;
  }

  void draw(
      double top, DrawList& list, Labels& labels,
      const DrawCell& draw_cell = [](auto, auto, auto&) { return false; }) const {
    const Box<2> all{{left_, top}, {left_ + width_, top + height() + size_}};
    double y = top + 1.4 * size_;
    for (std::size_t c = 0; c < table_.columns.size(); ++c)
      labels.add(shortened(table_.columns[c].name, to(c) - from(c) - 0.6 * size_, quiet()),
                 {{from(c), y - 0.4 * size_}, 0}, quiet(), all);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      list.crisp_line({left_, y}, {left_ + width_, y}, {Role::rule, 1.2});
      for (std::size_t c = 0; c < cells_[i].size(); ++c) {
        if (draw_cell(i, c, {{from(c), y}, {to(c), y + heights_[i]}})) continue;
        for (std::size_t k = 0; k < cells_[i][c].size(); ++k)
          labels.add(cells_[i][c][k],
                     {{from(c), y + (1.1 + 1.15 * static_cast<double>(k)) * size_}, 0},
                     style(table_.lines[i], c), all);
      }
      y += heights_[i];
    }
  }

 private:
  double from(std::size_t c) const { return left_ + (c > 0 ? ends_[c - 1] : 0) * width_; }
  double to(std::size_t c) const { return left_ + ends_[c] * width_; }
  TextStyle quiet() const { return {size_, Weight::regular, Role::quiet_ink, Role::none}; }
  TextStyle style(const Table::Line& line, std::size_t c) const {
    const bool strong = line.cells[c].bad || (c == 0 && !line.who.name.empty());
    return {size_, strong ? Weight::semibold : Weight::regular, Role::ink, Role::none};
  }

  const Table& table_;
  double left_, width_;
  std::vector<double> ends_;
  double size_;
  std::vector<std::vector<std::vector<std::string>>> cells_;  // lines of each
  std::vector<double> heights_;
};

// On a logarithmic scale on which every bar is the middle line: left of it is better.
void draw_strip(const Bar& bar, const Box<2>& place, DrawList& list) {
  constexpr double kDecades = 4;  // that it shows to each side
  const auto far = bar.distance();
  const double left = place.lo.x, right = place.hi.x - 20;
  const double y = place.center().y, middle = (left + right) / 2;
  list.crisp_line({left, y}, {right, y}, {Role::rule, 1.2});
  list.crisp_line({middle, y - 9}, {middle, y + 9}, {Role::ink, 1.8});
  if (!far) return;
  const double at = middle + std::clamp(*far / kDecades, -1.0, 1.0) * (right - left - 14) / 2;
  const bool met = *bar.met();
  const Role role = met ? Role::ink : Role::warning;
  list.line({middle, y}, {at, y}, {role, 3});
  list.disc({at, y}, 5.2, met ? Role::ink : Role::paper, {role, 2.2, 0});
  if (std::abs(*far) <= kDecades) return;  // beyond the strip: an arrow's head
  const double way = *far < 0 ? -1 : 1, tip = at + way * 12;
  for (const double side : {-1.0, 1.0})
    list.line({tip, y}, {tip - way * 5, y + side * 5}, {role, 2});
}

// --- two plots of a problem ---

std::vector<LegendEntry> legend_of(const Plot& plot) {
  return mapped(plot.series, [](const PlotSeries& s) -> LegendEntry {
    return {s.name, s.look, s.is_peer};
  });
}

// What a reader must know beside the plots, in a few lines, and in what circumstances they
// were made, at the page's lower edge. Gives the y of the rule above it.
double draw_page_foot(const std::vector<std::string>& notes, const std::string& small,
                      DrawList& list, Labels& labels) {
  constexpr std::size_t kMostLines = 9;
  constexpr double kLineHeight = 26;
  const TextStyle quiet{kLeastDeskLabel + 0.1, Weight::regular, Role::quiet_ink, Role::none};
  const double width = list.page.x - 2 * kMargin, bottom = list.page.y - 26;
  std::string joined;
  for (const std::string& note : notes) joined += (joined.empty() ? "" : " ") + note;
  std::vector<std::string> lines =
      notes.empty() ? std::vector<std::string>() : wrapped(joined, width, quiet);
  if (lines.size() > kMostLines) {
    lines.resize(kMostLines);
    lines.back() = shortened(lines.back() + " …", width, quiet);
  }
  lines.push_back(shortened(small, width, quiet));
  const double top = bottom - 36 - kLineHeight * static_cast<double>(lines.size() - 1);
  const Box<2> band{{kMargin, top}, {list.page.x - kMargin, list.page.y - 14}};
  for (std::size_t i = 0; i < lines.size(); ++i)
    labels.add(lines[i],
               {{kMargin, bottom - kLineHeight * static_cast<double>(lines.size() - 1 - i)}, 0},
               quiet, band);
  list.crisp_line({kMargin, top}, {list.page.x - kMargin, top}, {Role::rule, 1.6});
  return top;
}

// Of the same series, side by side, with one legend below, unless the left one names its lanes.
DrawList draw_plots(const ProblemRows& problem, const std::string& what, Plot left, Plot right,
                    const std::vector<std::string>& notes, const Circumstances& circumstances) {
  constexpr double kTop = 96, kGap = 48;
  DrawList list;
  Labels labels(list);
  draw_page_title(problem_words(problem), what + "  ·  " + file_name(problem), kMargin, list,
                  labels);
  const double bottom = draw_page_foot(notes, circumstances_text(circumstances), list, labels) - 18;
  const double width = list.page.x - 2 * kMargin, middle = kMargin + width / 2;
  Box<2> left_panel{{kMargin, kTop}, {middle - kGap / 2, bottom - 12}};
  if (!names_its_lanes(left, left_panel)) {
    const std::vector<LegendEntry> legend = legend_of(left);
    const double height =
        std::min(plot_legend_height(legend, width, kDeskLabel), 0.3 * (bottom - kTop));
    draw_plot_legend(legend, {{kMargin, bottom - height}, {kMargin + width, bottom}}, kDeskLabel,
                     list, labels);
    left_panel.hi.y -= height;
    left.names = PlotNames::none;
  }
  right.names = PlotNames::none;
  draw_plot(left, left_panel, list, labels);
  draw_plot(right, {{middle + kGap / 2, kTop}, {kMargin + width, left_panel.hi.y}}, list, labels);
  return list;
}

// --- the overview ---

constexpr double kLeastWidth = 1600;
constexpr double kTall = 1.41421356;  // height over width of an A3 page
constexpr double kCell = 320;         // least width of a small plot with its words
constexpr double kOverviewMargin = 56, kCellGap = 34;
constexpr double kSmall = 16.5, kCellText = 17.5;  // on A3, a page 1600 wide has 0.53 points a unit
constexpr double kOverviewHead = 140, kOverviewFoot = 84;
const TextStyle kSmallPrint{kSmall, Weight::regular, Role::quiet_ink, Role::none};
const TextStyle kCellName{kCellText, Weight::semibold, Role::ink, Role::none};

class OverviewPage {
 public:
  OverviewPage(const Measurement& measurement, const std::vector<Bar>& bars)
      : measurement_(measurement), bars_(bars) {}

  DrawList draw() {
    plan();
    draw_head();
    draw_grid(draw_legend(kOverviewHead));
    if (!bars_.empty())
      bars_picture().draw(list_.page.y - kOverviewFoot - bars_height(), list_, labels_,
                          [this](std::size_t line, std::size_t column, const Box<2>& place) {
                            if (column == kBarDistance) draw_strip(bars_[line], place, list_);
                            return column == kBarDistance;
                          });
    draw_foot();
    return std::move(list_);
  }

 private:
  double inner() const { return list_.page.x - 2 * kOverviewMargin; }
  Box<2> band(double top, double bottom) const {
    return {{kOverviewMargin, top}, {list_.page.x - kOverviewMargin, bottom}};
  }
  double cell_width() const {
    return (inner() - kCellGap * static_cast<double>(columns_ - 1)) / static_cast<double>(columns_);
  }
  double rows() const { return static_cast<double>((problems_.size() + columns_ - 1) / columns_); }
  TablePicture bars_picture() const {
    return {
        bars_table_, kOverviewMargin, inner(), {0.24, 0.34, 0.44, 0.58, 0.645, 0.78, 1}, kSmall};
  }
  double bars_height() const { return bars_.empty() ? 0 : bars_picture().height() + 24; }

  // As few columns as keep the page from being taller than A3, so that type is as large as can be.
  void plan() {
    legend_ = legend();
    const std::size_t n = problems_.size();
    columns_ = n <= 1 ? 1 : n <= 4 ? 2 : n <= 9 ? 3 : 4;
    plan_rows();
    while (list_.page.y > 1.02 * kTall * list_.page.x && columns_ < 12) {
      ++columns_;
      plan_rows();
    }
  }
  // The width, and the height of a row of cells: what is left of the page, but enough to be read
  // and no more than is of use.
  void plan_rows() {
    list_.page.x =
        std::max(kLeastWidth, 2 * kOverviewMargin +
                                  static_cast<double>(columns_) * (kCell + kCellGap) - kCellGap);
    const double fixed = kOverviewHead + kOverviewFoot + bars_height() +
                         plot_legend_height(legend_, inner(), kSmall) + 48;
    const double page = kTall * list_.page.x, words = 56;
    const double tallest = columns_ > 2 ? 1.3 : 0.62;  // over the width
    row_ = std::clamp(rows() > 0 ? (page - fixed) / rows() : 0, words + 0.62 * cell_width(),
                      words + tallest * cell_width());
    const double needed = std::ceil(fixed + rows() * row_);
    list_.page.y = columns_ > 2 ? std::max(page, needed) : needed;
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
    list_.crisp_line({kOverviewMargin, y}, {list_.page.x - kOverviewMargin, y}, {Role::ink, 2});
  }

  void draw_head() {
    const Box<2> place = band(30, 132);
    labels_.add("Error against run time", {{kOverviewMargin, 74}, 0},
                {38, Weight::semibold, Role::ink, Role::none}, place);
    const TextStyle quiet{19, Weight::regular, Role::quiet_ink, Role::none};
    const std::string how = fmt::format(
        "{} problem{}, {} runs. Each plot: a run's error (of the quantity named at its upper "
        "right) against its processor seconds, both logarithmic; lower left is better.",
        problems_.size(), problems_.size() == 1 ? "" : "s",
        std::ranges::count_if(measurement_.rows, &Row::was_run));
    labels_.add(shortened(how, inner(), quiet), {{kOverviewMargin, 110}, 0}, quiet, place);
    rule(126);
  }

  double draw_legend(double y) {
    const double height = plot_legend_height(legend_, inner(), kSmall);
    draw_plot_legend(legend_, band(y, y + height), kSmall, list_, labels_);
    y += height + 4;
    const std::string rest =
        "Dashed: other engines. Open marks: failed runs. Thin bars: 95 % intervals. Stairs: "
        "unbeaten runs of the world's step. Dashed grey: floors.";
    labels_.add(shortened(rest, inner(), kSmallPrint), {{kOverviewMargin, y + 17}, 0}, kSmallPrint,
                band(y, y + 26));
    return y + 44;
  }

  void draw_grid(double y) {
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      const auto column = static_cast<double>(i % columns_);
      const auto row = static_cast<double>(i / columns_);
      const Vec<2> corner{kOverviewMargin + column * (cell_width() + kCellGap), y + row * row_};
      draw_cell(problems_[i], {corner, corner + Vec<2>{cell_width(), row_ - 26}});
    }
  }

  void draw_cell(const ProblemRows& problem, const Box<2>& cell) {
    const std::string name = shortened(file_name(problem), cell.size().x, kCellName);
    labels_.add(name, {{cell.lo.x, cell.lo.y + 16}, 0}, kCellName, cell);
    const std::string norm = norm_words(main_norm(problem));
    labels_.try_add(norm, {{{cell.hi.x, cell.lo.y + 16}, 1}}, kSmallPrint, cell);
    Plot plot = cost_plot(problem, seconds_of, looks_, false);
    plot.names = PlotNames::none;
    plot.size = kSmall;
    plot.mark = columns_ < 3 ? 6 : columns_ < 4 ? 4.8 : 4.2;
    plot.front_name.clear();
    plot.empty = "no run was timed";
    for (PlotGuide& guide : plot.guides) guide.name.clear();
    draw_plot(plot, {{cell.lo.x, cell.lo.y + 22}, cell.hi}, list_, labels_);
  }

  void draw_foot() {
    const double y = list_.page.y - 62;
    rule(y);
    labels_.add(shortened(circumstances_text(measurement_.circumstances), inner(), kSmallPrint),
                {{kOverviewMargin, y + 30}, 0}, kSmallPrint, band(y, list_.page.y - 16));
  }

  const Measurement& measurement_;
  const std::vector<Bar>& bars_;
  Table bars_table_ = table_of(bars_);
  std::vector<ProblemRows> problems_ = by_problem(measurement_.rows);
  Looks looks_ = looks_of(measurement_.rows);
  std::vector<LegendEntry> legend_;
  std::size_t columns_ = 4;
  double row_ = 0;
  DrawList list_;
  Labels labels_{list_};
};

}  // namespace

void draw_page_title(const std::string& title, const std::string& rest, double margin,
                     DrawList& list, Labels& labels) {
  constexpr double kBaseline = 58, kRule = 78;
  const Box<2> band{{margin, 20}, {list.page.x - margin, kRule - 2}};
  const TextStyle bold{26, Weight::semibold, Role::ink, Role::none};
  const TextStyle quiet{22, Weight::regular, Role::quiet_ink, Role::none};
  const std::string name = shortened(title, 0.6 * band.size().x, bold);
  labels.add(name, {{margin, kBaseline}, 0}, bold, band);
  const double x = margin + text_width(name, bold) + 11;
  labels.add(shortened("·  " + rest, band.hi.x - x, quiet), {{x, kBaseline}, 0}, quiet, band);
  list.crisp_line({margin, kRule}, {list.page.x - margin, kRule}, {Role::rule, 1.6});
}

std::string circumstances_text(const Circumstances& c) {
  std::string text = "Lantern " + c.version;
  for (const std::string& part : {c.date, c.processor, c.compiler, c.flags})
    if (!part.empty()) text += " · " + part;
  if (c.cores > 0)
    text += fmt::format(" · {} core{}, load {:.1f} to {:.1f}", c.cores, c.cores == 1 ? "" : "s",
                        c.load_at_start, c.load_at_end);
  return text +
         fmt::format(" · seed {}{}", c.seed, c.effort.empty() ? "" : " · effort: " + c.effort);
}

DrawList draw_problem(const ProblemRows& problem, const Measurement& measurement) {
  auto [left, right] = plots_of(problem, looks_of(measurement.rows));
  std::vector<std::string> notes = notes_on(problem);
  notes.insert(notes.begin(), who_is_quickest(problem));
  return draw_plots(problem,
                    has_whole_errors(problem) ? "outcome against cost" : "error against cost",
                    std::move(left), std::move(right), std::move(notes), measurement.circumstances);
}

std::optional<DrawList> draw_drift(const ProblemRows& problem, const Measurement& measurement) {
  auto plots = drift_plots(problem, looks_of(measurement.rows));
  if (!plots) return std::nullopt;
  std::erase_if(plots->error.series, [](const PlotSeries& s) { return s.points.empty(); });
  return draw_plots(problem, "drift with time", std::move(plots->error), std::move(plots->energy),
                    {}, measurement.circumstances);
}

DrawList draw_slide(const ProblemRows& problem, const Measurement& measurement) {
  DrawList list;
  Labels labels(list);
  const TextStyle head{38, Weight::semibold, Role::ink, Role::none};
  const TextStyle words{29, Weight::regular, Role::ink, Role::none};
  const double width = list.page.x - 2 * kMargin;
  labels.add(shortened(problem_words(problem) + ": error against run time", width, head),
             {{kMargin, 66}, 0}, head, {{kMargin, 20}, {list.page.x - kMargin, 84}});
  std::vector<std::string> lines = wrapped(who_is_quickest(problem), width, words);
  if (lines.size() > 5) lines.resize(5), lines[4] = shortened(lines[4] + " …", width, words);
  double y = list.page.y - 34 - 36 * static_cast<double>(lines.size() - 1);
  const double bottom = y - 46;
  for (const std::string& line : lines) {
    labels.add(line, {{kMargin, y}, 0}, words,
               {{kMargin, bottom}, {list.page.x - kMargin, list.page.y - 10}});
    y += 36;
  }
  ProblemRows shown = problem;
  const auto is_other = [](const Row& row) { return is_adaptive(row.method); };
  if (!std::ranges::all_of(shown.rows, is_other))  // like beside like: steps of a world
    std::erase_if(shown.rows, is_other);
  Plot plot = plots_of(shown, looks_of(measurement.rows)).first;
  plot.title.clear();
  plot.y_name += "; lower left is better";
  plot.guides.clear();
  plot.slopes.clear();
  if (plot.bands.empty()) plot.front.clear();  // the line below says more
  for (PlotSeries& series : plot.series)       // orders are on the other page
    series.name = series.name.substr(0, series.name.find(": "));
  plot.size = 27;
  const Box<2> panel{{kMargin, 96}, {list.page.x - kMargin, bottom}};
  if (!plot.bands.empty()) {  // its lanes have names
    draw_plot(plot, panel, list, labels);
    return list;
  }
  plot.names = PlotNames::none;
  // As the lines end, from the top: who has no point comes last.
  std::ranges::stable_sort(plot.series, std::greater(), [](const PlotSeries& series) {
    return series.points.empty() ? -1 : series.points.back().at.y;
  });
  const std::vector<LegendEntry> legend = legend_of(plot);
  const auto wide = greatest_of<double>(
      0, legend, [&](const LegendEntry& one) { return text_width(one.name, words); });
  const double middle = list.page.x - kMargin - std::min(wide + 76, 0.4 * width);
  draw_plot(plot, {panel.lo, {middle - 24, bottom}}, list, labels);
  draw_plot_legend(legend, {{middle, 150}, panel.hi}, plot.size, list, labels);
  return list;
}

DrawList draw_overview(const Measurement& measurement, const std::vector<Bar>& bars) {
  return OverviewPage(measurement, bars).draw();
}

DrawList draw_peers(const Measurement& measurement) {
  const Table table = engines_table(measurement.peers);
  DrawList list;
  const TablePicture picture(table, kMargin, list.page.x - 2 * kMargin,
                             {0.135, 0.325, 0.455, 0.64, 0.85, 1}, kDeskLabel);
  list.page.y = std::max(list.page.y, 180 + picture.height());
  Labels labels(list);
  draw_page_title(table.title, "and who recommends it so", kMargin, list, labels);
  picture.draw(90, list, labels);
  draw_page_foot({}, circumstances_text(measurement.circumstances), list, labels);
  return list;
}

}  // namespace lantern::report
