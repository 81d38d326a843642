#include "report/html_tables.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/markup.hpp"
#include "report/html_plot.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

constexpr const char* kNothing = "–";

std::string quartiles_text(const Row& row) {
  if (row.timing.repeats == 0) return kNothing;
  return fmt::format("{} ({} – {})", seconds_text(row.timing.median),
                     seconds_text(row.timing.lower_quartile),
                     seconds_text(row.timing.upper_quartile));
}

// One of runs: a row a run, its first column the machine if there are several.
class RunTable {
 public:
  struct Column {
    const char* name;
    bool is_number = true;
  };

  RunTable(const char* caption, const std::vector<Column>& columns, const HtmlCast& cast)
      : cast_(cast) {
    text_ = fmt::format("<div class=\"wide\"><table><caption>{}</caption><thead><tr>{}", caption,
                        cast.is_shared() ? "<th>machine</th>" : "");
    for (const Column& column : columns)
      text_ += fmt::format("<th{}>{}</th>", column.is_number ? " class=\"n\"" : "", column.name);
    text_ += "</tr></thead><tbody>\n";
  }

  void begin(const std::string& method, std::size_t machine) {
    text_ += fmt::format("<tr class=\"{}\">", cast_.class_of(method, machine));
    if (cast_.is_shared()) words(std::string(1, machine_letter(machine)));
  }
  void words(const std::string& words) { text_ += fmt::format("<td>{}</td>", escaped(words)); }
  void number(const std::string& words) {
    text_ += fmt::format("<td class=\"n\">{}</td>", escaped(words));
  }
  void figure_or_nothing(const std::optional<double>& value, const char* unit = "") {
    number(value ? figure(*value) + unit : kNothing);
  }
  void count(std::uint64_t n) { number(n > 0 ? fmt::format("{}", n) : kNothing); }
  void end(const std::string& failure, const std::string& rest) {
    text_ += fmt::format("<td><span class=\"bad\">{}</span> {}</td></tr>\n", escaped(failure),
                         escaped(rest));
  }
  std::string finished() const { return text_ + "</tbody></table></div>\n"; }

 private:
  const HtmlCast& cast_;
  std::string text_;
};

void add_best_of(const MethodRows& method, const WorkCount& work, std::size_t machine,
                 RunTable& table) {
  const Row* best = nullptr;
  std::size_t ok = 0;
  std::map<Status, std::size_t> failed;
  for (const Row& row : method.rows) {
    if (row.status == Status::ok)
      ++ok;
    else
      ++failed[row.status];
    if (const auto error = row.error(); error && (!best || *error < *best->error())) best = &row;
  }
  std::vector<std::string> words;
  for (const auto& [status, count] : failed)
    words.push_back(fmt::format("{} {}", count, to_string(status)));
  table.begin(method.method, machine);
  table.words(method.name());
  table.number(fmt::format("{}/{}", ok, method.rows.size()));
  table.figure_or_nothing(best ? best->error() : std::nullopt);
  table.figure_or_nothing(best ? std::optional(best->step) : std::nullopt, " s");
  table.number(best ? quartiles_text(*best) : kNothing);
  const auto count = best ? work.of(*best) : std::nullopt;
  table.number(count ? fmt::format("{:.0f} {}", *count, work.name) : kNothing);
  table.end(listed(words), "");
}

void add_run(const Row& row, std::size_t machine, RunTable& table) {
  table.begin(row.method, machine);
  table.words(row.is_peer() ? row.method : method_words(row.method));
  table.figure_or_nothing(row.step);
  table.figure_or_nothing(row.error());
  table.number(quartiles_text(row));
  table.count(row.counted.steps);
  table.count(row.counted.force_evaluations);
  table.count(row.counted.constraint_rows);
  table.figure_or_nothing(row.drift.energy);
  table.figure_or_nothing(row.was_run() ? std::optional(row.penetration) : std::nullopt);
  const bool ok = row.status == Status::ok;
  table.end(ok ? "" : std::string(to_string(row.status)), ok ? "ok" : row.reason);
}

}  // namespace

std::size_t HtmlCast::number_of(const std::string& method) const {
  return static_cast<std::size_t>(std::ranges::find(methods, method, &MethodRows::method) -
                                  methods.begin());
}

std::string HtmlCast::class_of(const std::string& method, std::size_t machine) const {
  const std::string name = fmt::format("m{}", number_of(method));
  return is_shared() ? fmt::format("{} k{}", name, machine) : name;
}

char machine_letter(std::size_t machine) { return static_cast<char>('A' + machine % 26); }

const ProblemRows& SharedProblem::any() const {
  return **std::ranges::find_if(of, [](const ProblemRows* rows) { return rows != nullptr; });
}

std::string best_table(const SharedProblem& problem, const HtmlCast& cast) {
  RunTable table("Each method’s most exact run",
                 {{"method", false},
                  {"runs ok"},
                  {"least error"},
                  {"at step"},
                  {"time (quartiles)"},
                  {"work"},
                  {"not ok", false}},
                 cast);
  for (std::size_t machine = 0; machine < problem.of.size(); ++machine)
    if (const ProblemRows* rows = problem.of[machine])
      for (const MethodRows& method : by_method(*rows))
        add_best_of(method, work_count(*rows), machine, table);
  return table.finished();
}

std::string runs_table(const SharedProblem& problem, const HtmlCast& cast) {
  RunTable table("",
                 {{"method", false},
                  {"step, s"},
                  {"error"},
                  {"time (quartiles)"},
                  {"steps"},
                  {"force evaluations"},
                  {"constraint rows"},
                  {"energy drift"},
                  {"penetration"},
                  {"status", false}},
                 cast);
  for (std::size_t machine = 0; machine < problem.of.size(); ++machine)
    if (const ProblemRows* rows = problem.of[machine])
      for (const MethodRows& method : by_method(*rows))
        for (const Row& row : method.rows) add_run(row, machine, table);
  return "<details><summary>All runs</summary>" + table.finished() + "</details>\n";
}

std::string engines_table(const std::vector<PeerRecord>& peers, const HtmlCast& cast) {
  std::string text =
      "<details><summary>How each engine was run</summary><div class=\"wide\"><table><thead><tr>";
  for (const char* name : {"engine", "version", "precision", "integrator", "solver", "iterations",
                           "joints", "flags", "recommended by"})
    text += fmt::format("<th>{}</th>", name);
  text += "</tr></thead><tbody>\n";
  for (const PeerRecord& peer : peers) {
    if (cast.number_of(peer.name) == cast.methods.size()) continue;
    text += fmt::format("<tr class=\"m{}\">", cast.number_of(peer.name));
    const PeerSettings& s = peer.settings;
    for (const std::string* words : {&peer.name, &peer.version, &s.precision, &s.integrator,
                                     &s.solver, &s.iterations, &s.joints, &s.flags, &s.source})
      text += fmt::format("<td>{}</td>", escaped(*words));
    text += "</tr>\n";
  }
  return text + "</tbody></table></div></details>\n";
}

std::string bars_table(const std::vector<Bar>& bars) {
  std::string text =
      "<div class=\"wide\"><table><thead><tr><th>bound</th><th class=\"n\">measured</th>"
      "<th class=\"n\">asked</th><th>unit</th><th></th><th>elsewhere</th></tr></thead><tbody>\n";
  for (const Bar& bar : bars) {
    const auto met = bar.met();
    text += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{} {}</td><td>{}</td><td{}>{}</td>"
        "<td>{}</td></tr>\n",
        escaped(bar.name), bar.value ? figure(*bar.value) : kNothing, bar.at_least ? "≥" : "≤",
        figure(bar.bound), escaped(bar.unit), met == false ? " class=\"bad\"" : "",
        !met   ? "not measured"
        : *met ? "met"
               : "missed",
        escaped(bar.elsewhere));
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace lantern::report
