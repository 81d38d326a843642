// The chart: what it shows, and over what.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/draft.hpp"

namespace lantern {
namespace {

bool is_in(std::span<const CountDoc> docs, std::string_view name) {
  return std::any_of(docs.begin(), docs.end(),
                     [&](const CountDoc& doc) { return doc.name == name; });
}

// A count, a measure, or a measure of one body.
void check_number(const Named& number, Draft& draft) {
  if (is_in(known_counts(), number.name) || is_in(known_measures(), number.name)) return;
  if (is_of_body(number.name)) {
    note_body_measure(number, draft);
    return;
  }
  draft.problems.add(number.where, fmt::format("there is no count {}", in_quotes(number.name)),
                     [name = number.name] {
                       std::vector<std::string_view> known{kTimeAxis};
                       for (const auto docs : {known_counts(), known_measures()})
                         for (const CountDoc& doc : docs) known.push_back(doc.name);
                       return nearest(name, known);
                     });
}

void read_range(const TableReader& table, ChartSpec& chart, Draft& draft) {
  chart.least = table.number("least");
  chart.most = table.number("most");
  for (const char* key : {"least", "most"})
    if (table.is_good(key) && chart.x.empty())
      draft.problems.add(table.key_place(key), fmt::format("bars have no '{}'", key),
                         "leave it out");
  if (chart.least && chart.most && !(*chart.least < *chart.most))
    draft.problems.add(table.place("most"), "'most' must be above 'least'");
  if (chart.logarithmic && chart.least.value_or(1) <= 0)
    draft.problems.add(table.place("least"), "a logarithmic axis begins above 0",
                       "as least = 0.001");
  if (chart.logarithmic && chart.most.value_or(1) <= 0)
    draft.problems.add(table.place("most"), "a logarithmic axis ends above 0");
  chart.each_part = table.truth("each_part");
  if (chart.each_part && !chart.over_time())
    draft.problems.add(table.key_place("each_part"), "'each_part' is of a chart over time",
                       "give it x = \"time\"");
}

void read_lines(const TableReader& table, ChartSpec& chart, Draft& draft) {
  std::vector<Named> y = table.texts("y");
  if (const auto bars = table.text("bars")) y = {{*bars, table.place("bars")}};
  for (const Named& number : y) {
    check_number(number, draft);
    if (std::find(chart.y.begin(), chart.y.end(), number.name) != chart.y.end())
      draft.problems.add(number.where,
                         fmt::format("{} stands twice in 'y'", in_quotes(number.name)));
    chart.y.push_back(number.name);
  }
  constexpr std::size_t kMostLines = 8;  // as many as a theme has colours
  if (chart.y.size() > kMostLines)
    draft.problems.add(table.place("y"), fmt::format("{} lines in one chart, the limit is {}",
                                                     chart.y.size(), kMostLines));
}

}  // namespace

void read_chart(const TableReader& file, Draft& draft) {
  if (file.has("chart")) draft.scenario.chart.emplace();
  for (const TomlValue* value : file.tables("chart")) {
    const TableReader table = open(*value, language_table("chart"), draft);
    ChartSpec chart;
    chart.where = draft.position(value->where);
    chart.logarithmic = table.truth("logarithmic");
    if (const auto x = table.text("x")) {
      chart.x = *x;
      if (!chart.over_time()) check_number({*x, table.place("x")}, draft);
    }
    read_lines(table, chart, draft);
    read_range(table, chart, draft);
    draft.scenario.chart = std::move(chart);
  }
}

}  // namespace lantern
