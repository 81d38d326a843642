// The page of `bench atlas`.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/grouped.hpp"
#include "geometry/box.hpp"
#include "report/bench_atlas.hpp"
#include "report/bench_page.hpp"

namespace lantern::report {
namespace {

// One point a contestant: down is emptier, left is sooner.
Plot fill_plot(const BenchPage& page, const std::vector<const AtlasRow*>& rows, bool search) {
  Plot plot;
  plot.title = search ? "Searching the smallest square" : "Packing into it";
  plot.x_name = "ms of the processor, median; whiskers: quartiles";
  plot.y_name = "% of the atlas under textures: upper left is better";
  plot.log_y = false;
  for (const AtlasRow* row : rows) {
    const Timing& timing = search ? row->searching : row->timing;
    if (row->status != "ok" || timing.repeats == 0) continue;
    PlotSeries series = page.series_of(row->contestant);
    PlotPoint point{{1e3 * timing.median, 100 * row->fill}};
    point.spread = Box<2>{{1e3 * timing.lower_quartile, point.at.y},
                          {1e3 * timing.upper_quartile, point.at.y}};
    series.points.push_back(point);
    plot.series.push_back(series);
  }
  return plot;
}

std::vector<BenchCell> cells_of(const AtlasRow& row) {
  const auto ms = [](double seconds) { return BenchCell{fmt::format("{:.3g}", 1e3 * seconds)}; };
  const BenchCell status{row.status + (row.reason.empty() ? "" : ": " + row.reason),
                         row.status == "wrong"};
  if (row.status == "left out") return {{row.contestant}, {}, {}, {}, {}, {}, {}, {}, {}, status};
  return {{row.contestant},
          {fmt::format("{:.2f} %", 100 * row.fill)},
          {fmt::format("{} × {}", row.width, row.height)},
          {fmt::format("{} of {}", grouped(std::int64_t(row.packed)),
                       grouped(std::int64_t(row.textures)))},
          ms(row.timing.median),
          {fmt::format("{:.3g} … {:.3g}", 1e3 * row.timing.lower_quartile,
                       1e3 * row.timing.upper_quartile)},
          row.searching.repeats > 0 ? ms(row.searching.median) : BenchCell{"–"},
          {row.leaf_tests > 0 ? grouped(std::int64_t(row.leaf_tests)) : "–"},
          {grouped(std::int64_t(row.bytes))},
          status};
}

}  // namespace

std::string to_html(const AtlasBenchResult& result) {
  std::vector<BenchContestant> contestants;
  for (const AtlasPeerWords& c : result.contestants)
    contestants.push_back({c.name, c.version, c.how});
  BenchPage page({"Texture atlases: how full, how soon",
                  result.config.atlas
                      ? "Textures packed into an atlas of one size. Contestants take turns."
                      : "Textures packed into the smallest square: sides from the square root of "
                        "their area up by 0.2 % until all fit. Contestants take turns; each layout "
                        "is checked: nothing overlaps, all lies inside, sizes are right.",
                  result.command, result.circumstances},
                 contestants);
  for (std::size_t i = 0; i < result.rows.size();) {
    const AtlasRow& first = result.rows[i];
    std::vector<const AtlasRow*> rows;
    for (; i < result.rows.size() && result.rows[i].set == first.set &&
           result.rows[i].textures == first.textures;
         ++i)
      rows.push_back(&result.rows[i]);
    page.begin_section(
        fmt::format("{}, {} textures", first.set, grouped(std::int64_t(first.textures))),
        texture_set_words(first.set));
    page.add_plot(fill_plot(page, rows, false));
    if (!result.config.atlas) page.add_plot(fill_plot(page, rows, true));
    std::vector<std::vector<BenchCell>> table;
    for (const AtlasRow* row : rows) table.push_back(cells_of(*row));
    page.add_table({"", "full", "atlas", "textures", "ms", "quartiles", "search ms", "leaf tests",
                    "bytes", "checked"},
                   table);
  }
  return page.text();
}

}  // namespace lantern::report
