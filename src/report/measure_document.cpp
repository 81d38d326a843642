#include "report/measure_document.hpp"

#include <tuple>

#include "report/pages.hpp"

namespace lantern::report {
namespace {

constexpr const char* kNothing = "–";

// Runs that both made: how many, and how many of them ended in the same state, bit for bit.
std::pair<std::size_t, std::size_t> same_runs(const Measurement& a, const Measurement& b) {
  using Key = std::tuple<std::string, std::uint64_t, std::string, double>;
  const auto key = [](const Row& row) {
    return Key{row.problem, row.text_hash, row.method, row.step};
  };
  std::map<Key, std::uint64_t> hashes;
  for (const Row& row : a.rows)
    if (row.hash != 0 && !row.is_peer()) hashes[key(row)] = row.hash;
  std::size_t both = 0, same = 0;
  for (const Row& row : b.rows) {
    const auto found = hashes.find(key(row));
    if (row.hash == 0 || found == hashes.end()) continue;
    ++both;
    same += found->second == row.hash;
  }
  return {both, same};
}

// "Bullet:10 3.24" of "Bullet:10 3.24 (double)".
std::string short_name(const MethodRows& method) {
  const std::string name = method.is_peer ? method.name() : method.method;
  return name.substr(0, name.find(" ("));
}

std::string figure_or_nothing(const std::optional<double>& value) {
  return value ? figure(*value) : kNothing;
}
std::string count_or_nothing(std::uint64_t n) { return n > 0 ? fmt::format("{}", n) : kNothing; }

std::string interval_text(const Row& row) {
  const Timing& t = row.processor;
  if (t.repeats == 0) return kNothing;
  return fmt::format("{} ({} – {}){}", seconds_text(t.median), seconds_text(t.low),
                     seconds_text(t.high), t.is_narrow() ? "" : " wide");
}

// The most exact run of a method, or the first on its floor, and what became of the others.
std::vector<Cell> best_of(const MethodRows& method, const WorkCount& work) {
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
  const auto& floor = method.floor;
  if (floor) best = &method.rows[floor->first];
  std::string not_ok;
  for (const auto& [status, count] : failed)
    not_ok += fmt::format("{}{} {}", not_ok.empty() ? "" : ", ", count, to_string(status));
  const auto seconds = best ? seconds_of(*best) : std::nullopt;
  const auto count = best ? work.of(*best) : std::nullopt;
  return {short_name(method),
          fmt::format("{}/{}", ok, method.rows.size()),
          method.order ? method.order->words() : kNothing,
          floor  ? "≤ " + figure(floor->largest)
          : best ? figure(*best->error())
                 : kNothing,
          best ? figure(best->step) : kNothing,
          seconds ? seconds_text(*seconds) : kNothing,
          count ? fmt::format("{:.0f}", *count) : kNothing,
          {not_ok, true}};
}

std::vector<Cell> cells_of(const Row& row) {
  const bool ok = row.status == Status::ok;
  return {row.method,
          figure(row.step),
          figure_or_nothing(row.error()),
          interval_text(row),
          row.timing.repeats ? seconds_text(row.timing.median) : kNothing,
          count_or_nothing(static_cast<std::uint64_t>(row.timing.repeats)),
          count_or_nothing(row.counted.steps),
          count_or_nothing(row.counted.force_evaluations),
          count_or_nothing(row.counted.constraint_rows),
          figure_or_nothing(row.drift.energy),
          figure_or_nothing(row.was_run() ? std::optional(row.penetration) : std::nullopt),
          ok ? Cell("ok") : Cell(std::string(to_string(row.status)), true),
          row.reason};
}

// A problem as each machine has it; null where it has not, but for one at least.
struct SharedProblem {
  std::string name;
  std::vector<const ProblemRows*> of;

  const ProblemRows& any() const {
    return **std::ranges::find_if(of, [](const ProblemRows* rows) { return rows != nullptr; });
  }
  // act(machine, its rows) for each that has them.
  void each(const auto& act) const {
    for (std::size_t machine = 0; machine < of.size(); ++machine)
      if (of[machine]) act(machine, *of[machine]);
  }
};

// How many medians are known well.
std::string wide_words(const Measurement& measurement) {
  std::size_t timed = 0, wide = 0;
  for (const Row& row : measurement.rows) {
    timed += row.processor.repeats > 0;
    wide += row.processor.repeats > 0 && !row.processor.is_narrow();
  }
  return fmt::format(
      "Times are processor seconds, medians of repeats taken in turn. Of {} medians {} are wide: "
      "their 95 % interval is more than 5 % of them.",
      timed, wide);
}

class Writer {
 public:
  explicit Writer(std::span<const Measurement> measurements) {
    std::vector<Row> all;
    for (const Measurement& m : measurements) {
      document_.machines.push_back(m.circumstances);
      problems_of_.push_back(by_problem(m.rows));
      all.insert(all.end(), m.rows.begin(), m.rows.end());
    }
    looks_ = looks_of(all);
    document_.title = "Error against cost";
    document_.about =
        "Problems whose answers are known, method by method: how far each run is off, and what "
        "it costs: processor time, the median of repeats that the runs took in turn. Down and to "
        "the left is better. Pale bars are 95 % intervals of the medians, which were repeated "
        "until these were within 5 %, or are called wide: nominal ones, since repeats end once "
        "an interval is narrow; methods whose intervals overlap, or whose medians are within 10 "
        "%, tie. A method's order is fitted to the longest piece of its runs between which the "
        "slopes lie within 0.35 of the median of all, of errors that are at most 0.5 and above "
        "its floor and 100 times the rounding of as many steps; of two medians the larger "
        "counts. It has three runs at least, and ends with the finest of these or next to it. "
        "Behind the order stands how far slopes lie from it; in its place, if that is more than "
        "0.05 and they only rise or only fall, the first and the last of them. Errors are on a "
        "floor if they fell to it and those after the largest there are not less by more than "
        "half of the order's power (half a power without one) of the steps since the floor's "
        "first; two runs are one only if the second is no less. A run has diverged if it is off, "
        "or its energy has changed, by more than 100 times their scale, or if its equations "
        "could not be solved: the table of all runs says which. Runs that failed have no time; "
        "where their work was counted, they lie at the upper edge of its plot. The energy's "
        "drift is told over the kinetic and elastic energy at the start or, of what begins at "
        "rest, over the most that its potential energy has fallen; penetration is the deepest "
        "overlap of two shapes at the looks, as the narrow phase measures it. The pale stairs "
        "join the runs that no other beats in both, among those that do the world's step; a run "
        "counts as off by as much as any of its method's at smaller steps, and on a floor by the "
        "largest error there. What a method takes for an error is read on the straight line "
        "between its neighbouring runs, both axes logarithmic; at most so much, if it is so good "
        "at its largest step already. Told are decades from 0.1 to 1e-13 that two methods reach "
        "at least, and of which none but the quickest has reached more at its largest step "
        "already; of many ranges the three widest, the finer of equal ones. Behind ≤ stands the "
        "largest error of the runs from the step beside it on: they scatter below.";
    document_.legends = {"Lantern’s methods", "Other engines"};
    for (const ProblemRows& problem : by_problem(all))
      for (const MethodRows& method : by_method(problem))
        if (!has_choice(method.method))
          document_.choices.push_back(
              {method.method, {looks_.at(method.method), method.is_peer, 0}, method.name()});
    std::ranges::stable_sort(document_.choices, {}, [](const Choice& c) { return c.ink.is_peer; });
    for (std::size_t i = 1; i < measurements.size(); ++i) {
      const auto [both, same] = same_runs(measurements[0], measurements[i]);
      document_.notes.push_back(fmt::format(
          "Of {} runs of Lantern that machines A and {} both made, {} ended in the same state, bit "
          "for bit.",
          both, machine_letter(i), same));
    }
    add_engines(measurements);
    for (std::size_t i = 0; i < measurements.size(); ++i)
      document_.notes.push_back(
          fmt::format("Machine {}: {} of {} runs were made, seed {}.", machine_letter(i),
                      std::ranges::count_if(measurements[i].rows, &Row::was_run),
                      measurements[i].rows.size(), measurements[i].circumstances.seed));
    for (const Measurement& m : measurements) document_.notes.push_back(wide_words(m));
    for (const SharedProblem& problem : shared_problems()) add(problem);
  }

  Document finished() { return std::move(document_); }

 private:
  bool has_choice(const std::string& name) const {
    return std::ranges::find(document_.choices, name, &Choice::name) != document_.choices.end();
  }

  std::vector<SharedProblem> shared_problems() const {
    std::vector<SharedProblem> all;
    for (std::size_t machine = 0; machine < problems_of_.size(); ++machine)
      for (const ProblemRows& problem : problems_of_[machine]) {
        auto found = std::ranges::find(all, problem.problem, &SharedProblem::name);
        if (found == all.end()) {
          all.push_back({problem.problem, {}});
          found = std::prev(all.end());
          found->of.resize(problems_of_.size());
        }
        found->of[machine] = &problem;
      }
    return all;
  }

  // How the other engines were run, as the first measurement that has one tells.
  void add_engines(std::span<const Measurement> measurements) {
    std::vector<PeerRecord> known;
    for (const Measurement& m : measurements)
      for (const PeerRecord& peer : m.peers)
        if (has_choice(peer.name) &&
            std::ranges::find(known, peer.name, &PeerRecord::name) == known.end())
          known.push_back(peer);
    Table table = engines_table(known);
    table.folded = true;
    if (!table.lines.empty()) document_.head.push_back(std::move(table));
  }

  void add(const SharedProblem& problem) {
    const ProblemRows& any = problem.any();
    Chapter& chapter = document_.chapters.emplace_back();
    chapter.title = problem_words(any);
    chapter.words = {who_is_quickest(any), file_name(any)};
    chapter.notes = notes_on(any);
    std::vector<std::vector<Plot>> plots(problem.of.size());  // of each machine
    problem.each([&](std::size_t machine, const ProblemRows& rows) {
      auto [left, right] = plots_of(rows, looks_);
      plots[machine] = {std::move(left), std::move(right)};
      if (auto drift = drift_plots(rows, looks_)) {
        plots[machine].push_back(std::move(drift->error));
        plots[machine].push_back(std::move(drift->energy));
      }
    });
    for (std::size_t which = 0; which < 4; ++which)
      if (auto figure = shared_figure(problem, which, plots))
        chapter.figures.push_back(std::move(*figure));
    chapter.tables = {best_table(problem), runs_table(problem)};
  }

  // All machines' series in one plot; the first machine's front and guides.
  static std::optional<Figure> shared_figure(const SharedProblem& problem, std::size_t which,
                                             std::vector<std::vector<Plot>>& plots) {
    std::optional<Figure> figure;
    problem.each([&](std::size_t machine, const ProblemRows& rows) {
      if (which >= plots[machine].size()) return;
      Plot& mine = plots[machine][which];
      const auto has_none = [](const PlotSeries& s) { return s.points.empty(); };
      if (which == 3 && std::ranges::all_of(mine.series, has_none)) return;
      if (figure && mine.title != figure->plot.title) {  // of other runs; another plot says more
        figure->note = fmt::format(" (without machine {})", machine_letter(machine));
        return;
      }
      std::vector<Who> of = figure ? std::move(figure->of) : std::vector<Who>();
      for (const MethodRows& method : by_method(rows)) of.push_back({method.method, machine});
      if (!figure) {
        figure = {std::move(mine), std::move(of)};
        return;
      }
      figure->of = std::move(of);
      Plot& all = figure->plot;
      all.series.insert(all.series.end(), mine.series.begin(), mine.series.end());
      if (mine.bands.size() > all.bands.size()) all.bands = mine.bands;
    });
    return figure;
  }

  static Table best_table(const SharedProblem& problem) {
    const WorkCount work = work_count(problem.any());
    const std::string norm = main_norm(problem.any());
    Table table{"", columns_of({"method|", "ok", "order", norm.empty() ? "least error" : norm,
                                "step, s", "time", work.name, "not ok|"})};
    problem.each([&](std::size_t machine, const ProblemRows& rows) {
      for (const MethodRows& method : by_method(rows))
        table.lines.push_back({{method.method, machine}, best_of(method, work_count(rows))});
    });
    return table;
  }

  static Table runs_table(const SharedProblem& problem) {
    Table table{"All runs",
                columns_of({"method|", "step, s", "error", "processor time (95 %)", "by the clock",
                            "repeats", "steps", "force evaluations", "constraint rows",
                            "energy drift", "penetration", "status|", "|"})};
    table.folded = true;
    problem.each([&](std::size_t machine, const ProblemRows& rows) {
      for (const MethodRows& method : by_method(rows))
        for (const Row& row : method.rows)
          table.lines.push_back({{method.method, machine}, cells_of(row)});
    });
    return table;
  }

  std::vector<std::vector<ProblemRows>> problems_of_;  // of each machine
  Looks looks_;
  Document document_;
};

}  // namespace

Document document_of(std::span<const Measurement> measurements, const std::vector<Bar>& bars) {
  Document document = Writer(measurements).finished();
  if (!bars.empty())
    document.chapters.push_back({"Bounds that Lantern sets itself", {}, {}, {table_of(bars)}});
  return document;
}

Table engines_table(std::span<const PeerRecord> peers) {
  Table table{"How each engine was run", {}};
  for (const char* name :
       {"engine", "integrator; solver", "iterations", "joints", "flags", "recommended by"})
    table.columns.push_back({name, false});
  for (const auto& [name, version, s] : peers)
    table.lines.push_back({{name},
                           {name + " " + version,
                            fmt::format("{}; {}{}", s.integrator, s.solver,
                                        s.precision.empty() ? "" : "; " + s.precision),
                            s.iterations, s.joints, s.flags, s.source}});
  return table;
}

std::string to_table(const Measurement& measurement) {
  if (measurement.rows.empty()) return "";
  Document document = document_of(std::span(&measurement, 1), {});
  document.about.clear();
  document.notes = {circumstances_text(measurement.circumstances), wide_words(measurement)};
  return to_text(document);
}

}  // namespace lantern::report
