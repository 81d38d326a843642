// [chart] and [problem]: what is plotted of a scenario, and the known answer that it is held
// against.
#include <algorithm>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/suggest.hpp"
#include "language/counts.hpp"
#include "language/keys/key.hpp"
#include "language/method.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

// A count, a measure, or a measure of one body.
void check_number(const Named& number, Draft& draft) {
  if (find_count(number.name)) return;
  if (is_of_body(number.name)) {
    note_body_measure(number, draft);
    return;
  }
  draft.problems.add_unknown(number.where, "count", number.name, [] {
    std::vector<std::string_view> known = names_of_counts();
    known.push_back(kTimeAxis);
    return known;
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
  if (chart.each_part && !chart.over_time() && !chart.x.empty())
    table.bad_key("each_part", "'each_part' is of bars, or of a chart over time",
                  "give it x = \"time\"");
}

void read_lines(const TableReader& table, ChartSpec& chart, Draft& draft) {
  std::vector<Named> y = table.names("y");
  if (const auto bars = table.named("bars")) y = {*bars};
  for (const Named& number : y) {
    check_number(number, draft);
    if (std::ranges::find(chart.y, number.name) != chart.y.end())
      draft.problems.add(number.where,
                         fmt::format("{} stands twice in 'y'", in_quotes(number.name)));
    chart.y.push_back(number.name);
  }
  for (const Named& piece : table.names("pieces")) {
    check_number(piece, draft);
    chart.pieces.push_back(piece.name);
  }
  if (!chart.pieces.empty() && (!chart.x.empty() || chart.logarithmic))
    table.bad_key("pieces", "only bars on a plain axis have pieces", "leave it out");
  for (const Named& label : table.names("labels")) chart.labels.push_back(label.name);
  const std::size_t labelled = chart.pieces.empty() ? chart.y.size() : chart.pieces.size();
  if (!chart.labels.empty() && chart.labels.size() != labelled)
    table.bad_value("labels",
                    fmt::format("{} labels for {} {}", chart.labels.size(), labelled,
                                chart.pieces.empty() ? "lines" : "pieces"),
                    "one for each");
  constexpr std::size_t kMostLines = 8;  // as many as a theme has colours
  if (chart.y.size() > kMostLines)
    table.bad_value(
        "y", fmt::format("{} lines in one chart, the limit is {}", chart.y.size(), kMostLines));
}

// One of each name, but for the numbers.
std::vector<Method> made() {
  std::vector<Method> methods;
  const auto add = [&]<class E>(std::optional<E> Method::*member, E first) {
    const auto all = names(first);
    for (auto i = static_cast<std::size_t>(first); i < all.size(); ++i) {
      Method& method = methods.emplace_back();
      method.name = all[i];
      method.*member = static_cast<E>(i);
    }
  };
  add(&Method::integrator, Integrator());
  add(&Method::rotation, RotationMethod());
  add(&Method::contacts, ContactMethod::impulse);
  return methods;
}

const std::vector<Method>& known() {
  static const std::vector<Method> methods = made();
  return methods;
}

}  // namespace

TableDoc chart_table() {
  using C = ChartSpec;
  TableDoc table = {"chart", "[chart]",
                    "Counts and measures as a picture. Each step with `plot` adds a point to the "
                    "lines, or a bar; over `time`, every frame adds a point by itself."};
  table.keys = {
      key(&C::x, "x", "The count or measure along the x axis of lines, or `time`.", range(1, 64)),
      key(KeyType::text, "bars", "The count that bars show, instead of lines.", range(1, 64)),
      key(KeyType::texts, "pieces",
          "Counts that make up what a bar shows: it is drawn in pieces, one for each.",
          or_else("bars are of one piece")),
      key(KeyType::texts, "y", "Counts and measures, each a line; of one body as `energy.bob`.",
          or_else("none")),
      key(KeyType::texts, "labels", "What the lines or pieces are called, one for each.",
          or_else("what `y` or `pieces` say")),
      key(&C::logarithmic, "logarithmic", "Logarithmic axes; time never has one."),
      key(&C::least, "least", "Where the y axis begins; lines leave the picture below it.",
          range(-1e12, 1e12), or_else("where the lines do")),
      key(&C::most, "most", "Where the y axis ends.", range(-1e12, 1e12),
          or_else("where the lines do")),
      key(&C::each_part, "each_part",
          "Bars, and lines over time, begin anew with each part of the script."),
  };
  table.groups = {{{"x", "y"}, {"bars"}}};
  return table;
}

void read_chart(const TableReader& file, Draft& draft) {
  if (file.has("chart")) draft.scenario.chart.emplace();
  for_each<ChartSpec>(file, "chart", draft, [&](const TableReader& table, ChartSpec& chart) {
    if (table.is_good("x") && !chart.over_time()) check_number(*table.named("x"), draft);
    read_lines(table, chart, draft);
    check_axes(table, chart);
    draft.scenario.chart = std::move(chart);
  });
}

TableDoc problem_table() {
  using P = ProblemSpec;
  TableDoc table = {"problem", "[problem]",
                    "A question whose answer is known, so that `lantern measure` can tell each "
                    "method's error. All bodies of the file are there from the start. Without this "
                    "table a scenario is measured against its own run at a much finer step."};
  table.keys = {
      key(&P::solution, "solution",
          "What the answer is computed by. It takes masses, positions, speeds and springs from the "
          "scenario.",
          must()),
      key(&P::variant, "variant", "Which of its family it is."),
      key(&P::seconds, "seconds", "How long it is run.", must(), above(0, 1e9), in("s")),
      key(&P::samples, "samples", "Moments at which it is sampled, equally far apart.",
          range(1, 100'000)),
      key(&P::step, "step", "The largest time step. It is cut so that each sample is met.", must(),
          above(0, 1e9), in("s")),
      key(&P::halvings, "halvings", "Of the step: one more run each.", range(0, 24)),
      key(&P::methods, "methods",
          "Ways to move it: an integrator, `exact`, `splitting_2`, `splitting_4`, "
          "`explicit_gyroscopic`, `soft:16` (sub-steps), `soft:0.001` (wanted error) or "
          "`impulse:100` (sweeps).",
          or_else("all that make a difference")),
  };
  return table;
}

void read_problem(const TableReader& file, Draft& draft) {
  for_each<ProblemSpec>(
      file, "problem", draft, [&](const TableReader& table, ProblemSpec& problem) {
        for (const Named& method : table.names("methods"))
          if (!method_named(method.name))
            draft.problems.add(method.where, fmt::format("there is no method '{}'", method.name),
                               [name = method.name] { return suggestion(name, method_names()); });
        if (draft.scenario.bodies.empty())
          draft.problems.add(table.where(), "a [problem] needs bodies", "add a [[body]]");
        draft.scenario.problem = std::move(problem);
      });
}

std::optional<Method> method_named(std::string_view name) {
  const std::size_t colon = name.find(':');
  for (Method method : known()) {
    if (method.name != name.substr(0, colon)) continue;
    method.name = name;
    if (colon == std::string_view::npos) return method;
    const std::string_view number = name.substr(colon + 1);
    method.wanted_error = number_in<double>(number);
    if (method.contacts == ContactMethod::soft && method.wanted_error > 0.0 &&
        method.wanted_error < 1.0)
      return method;
    method.wanted_error.reset();
    method.effort = number_in<int>(number);
    const int most = method.contacts == ContactMethod::soft      ? 1000
                     : method.contacts == ContactMethod::impulse ? 100'000
                                                                 : 0;
    if (!method.effort || *method.effort < 1 || *method.effort > most) return std::nullopt;
    return method;
  }
  return std::nullopt;
}

std::vector<std::string_view> method_names() {
  return mapped<std::string_view>(known(), &Method::name);
}

Scenario moved_by(Scenario scenario, const Method& method, double h) {
  WorldSpec& world = scenario.world;
  world.time_step = h;
  if (method.integrator) world.integrator = *method.integrator;
  if (method.rotation) world.rotation = *method.rotation;
  if (method.contacts) world.contacts = *method.contacts;
  for (BodySpec& body : scenario.bodies) {
    if (method.integrator) body.integrator.reset();
    if (method.rotation) body.rotation.reset();
  }
  if (method.contacts)
    for (Step& step : scenario.steps)
      if (std::holds_alternative<SolveBy>(step.verb)) step.verb = Show{};
  if (method.contacts) world.wanted_error = method.wanted_error;
  if (method.effort)
    (world.contacts == ContactMethod::soft ? world.sub_steps : world.iterations) = *method.effort;
  return scenario;
}

}  // namespace lantern::language
