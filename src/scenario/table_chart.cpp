// [chart]: what it shows, and over what.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/draft.hpp"
#include "scenario/key.hpp"

namespace lantern::scenario {
namespace {

// A count, a measure, or a measure of one body.
void check_number(const Named& number, Draft& draft) {
  if (find_count(number.name)) return;
  if (is_of_body(number.name)) {
    note_body_measure(number, draft);
    return;
  }
  draft.problems.add(number.where, fmt::format("there is no count {}", in_quotes(number.name)),
                     [name = number.name] {
                       std::vector<std::string_view> known = names_of_counts();
                       known.push_back(kTimeAxis);
                       return nearest(name, known);
                     });
}

void check_axes(const TableReader& table, const ChartSpec& chart) {
  for (const char* key : {"least", "most"})
    if (table.is_good(key) && chart.x.empty())
      table.bad_key(key, fmt::format("bars have no '{}'", key), "leave it out");
  if (chart.least && chart.most && !(*chart.least < *chart.most))
    table.bad_value("most", "'most' must be above 'least'");
  if (chart.logarithmic && chart.least.value_or(1) <= 0)
    table.bad_value("least", "a logarithmic axis begins above 0", "as least = 0.001");
  if (chart.logarithmic && chart.most.value_or(1) <= 0)
    table.bad_value("most", "a logarithmic axis ends above 0");
  if (chart.each_part && !chart.over_time())
    table.bad_key("each_part", "'each_part' is of a chart over time", "give it x = \"time\"");
}

void read_lines(const TableReader& table, ChartSpec& chart, Draft& draft) {
  std::vector<Named> y = table.names("y");
  if (const auto bars = table.named("bars")) y = {*bars};
  for (const Named& number : y) {
    check_number(number, draft);
    if (std::find(chart.y.begin(), chart.y.end(), number.name) != chart.y.end())
      draft.problems.add(number.where,
                         fmt::format("{} stands twice in 'y'", in_quotes(number.name)));
    chart.y.push_back(number.name);
  }
  constexpr std::size_t kMostLines = 8;  // as many as a theme has colours
  if (chart.y.size() > kMostLines)
    table.bad_value(
        "y", fmt::format("{} lines in one chart, the limit is {}", chart.y.size(), kMostLines));
}

}  // namespace

TableDoc chart_table() {
  using namespace keys;
  using C = ChartSpec;
  TableDoc table = {
      "chart", "[chart]",
      "Counts and measures as a picture. Each step with `plot` adds a point to the lines, or a "
      "bar; over `time`, every frame adds a point by itself."};
  table.keys = {
      key(&C::x, "x", "The count or measure along the x axis of lines, or `time`.", range(1, 64)),
      key(KeyType::text, "bars", "The count that bars show, instead of lines.", range(1, 64)),
      key(KeyType::texts, "y", "Counts and measures, each a line; of one body as `energy.bob`.",
          or_else("none")),
      key(&C::logarithmic, "logarithmic", "Logarithmic axes; time never has one."),
      key(&C::least, "least", "Where the y axis begins; lines leave the picture below it.",
          range(-1e12, 1e12), or_else("where the lines do")),
      key(&C::most, "most", "Where the y axis ends.", range(-1e12, 1e12),
          or_else("where the lines do")),
      key(&C::each_part, "each_part", "Over time: lines begin anew with each part of the script."),
  };
  table.groups = {{{"x", "y"}, {"bars"}}};
  return table;
}

void read_chart(const TableReader& file, Draft& draft) {
  if (file.has("chart")) draft.scenario.chart.emplace();
  for (const TomlValue* value : file.tables("chart")) {
    const TableReader table = open(*value, language_table("chart"), draft);
    ChartSpec chart;
    table.fill(chart);
    chart.where = draft.position(value->where);
    if (table.is_good("x") && !chart.over_time()) check_number(*table.named("x"), draft);
    read_lines(table, chart, draft);
    check_axes(table, chart);
    draft.scenario.chart = std::move(chart);
  }
}

}  // namespace lantern::scenario
