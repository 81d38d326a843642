#include "report/html_page.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/markup.hpp"
#include "report/drift_plots.hpp"
#include "report/html_plot.hpp"
#include "report/html_style.hpp"
#include "report/html_tables.hpp"
#include "report/measure_plots.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

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

bool has_no_points(const Plot& plot) {
  return std::ranges::all_of(plot.series, [](const PlotSeries& s) { return s.points.empty(); });
}

class HtmlPage {
 public:
  HtmlPage(std::span<const Measurement> measurements, const std::vector<Bar>& bars)
      : measurements_(measurements), bars_(bars) {
    std::vector<Row> all;
    for (const Measurement& m : measurements) {
      problems_of_.push_back(by_problem(m.rows));
      all.insert(all.end(), m.rows.begin(), m.rows.end());
    }
    looks_ = looks_of(all);
    cast_.machines = measurements.size();
    for (std::size_t machine = 0; machine < problems_of_.size(); ++machine)
      for (const ProblemRows& problem : problems_of_[machine]) add(problem, machine);
    for (const ProblemRows& problem : by_problem(all))
      for (const MethodRows& method : by_method(problem))
        if (std::ranges::find(cast_.methods, method.method, &MethodRows::method) ==
            cast_.methods.end())
          cast_.methods.push_back(method);
    std::ranges::stable_sort(cast_.methods, {}, &MethodRows::is_peer);
  }

  std::string text() {
    put("{}", html_begin("Error against cost", hiding_rules()));
    put("<div class=\"page\">\n");
    add_choices();
    put("<main>\n");
    add_head();
    for (std::size_t i = 0; i < problems_.size(); ++i) add_problem(i);
    if (!bars_.empty())
      put("<section id=\"bars\"><h2>Bounds that Lantern sets itself</h2>\n{}</section>\n",
          bars_table(bars_));
    put("</main></div>\n<script>{}</script>\n</body></html>\n", kPageScript);
    return std::move(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  bool is_shared() const { return cast_.is_shared(); }

  void add(const ProblemRows& problem, std::size_t machine) {
    auto found = std::ranges::find(problems_, problem.problem, &SharedProblem::name);
    if (found == problems_.end()) {
      problems_.push_back({problem.problem, {}});
      found = std::prev(problems_.end());
      found->of.resize(measurements_.size());
    }
    found->of[machine] = &problem;
  }

  static std::string machine_name(std::size_t machine) {
    return fmt::format("Machine {}", machine_letter(machine));
  }

  // What is not chosen is hidden by the style sheet alone.
  std::string hiding_rules() const {
    std::string rules;
    const auto add = [&](const std::string& id) {
      rules += fmt::format(":root:has(#{0}:not(:checked)) .{0}{{display:none}}\n", id);
    };
    for (std::size_t i = 0; i < cast_.methods.size(); ++i) add(fmt::format("m{}", i));
    if (is_shared())
      for (std::size_t i = 0; i < measurements_.size(); ++i) add(fmt::format("k{}", i));
    return rules;
  }

  void add_choices() {
    put("<form class=\"side\" aria-label=\"What is shown\">\n<div id=\"buttons\"></div>");
    for (const bool peers : {false, true}) {
      if (std::ranges::none_of(cast_.methods,
                               [&](const MethodRows& m) { return m.is_peer == peers; }))
        continue;
      put("<fieldset><legend>{}</legend>\n", peers ? "Other engines" : "Lantern’s methods");
      for (const MethodRows& method : cast_.methods)
        if (method.is_peer == peers)
          put("<label><input type=\"checkbox\" name=\"method\" id=\"m{}\"{} checked>{}{}</label>\n",
              cast_.number_of(method.method), peers ? " data-peer=\"1\"" : "",
              svg_sample(ink_of(method)), escaped(method.name()));
      put("</fieldset>\n");
    }
    if (is_shared()) {
      put("<fieldset><legend>Machines</legend>\n");
      for (std::size_t i = 0; i < measurements_.size(); ++i)
        put("<label><input type=\"checkbox\" id=\"k{}\" checked>{}: {}{}</label>\n", i,
            machine_name(i), escaped(measurements_[i].circumstances.processor),
            i > 0 ? " (hollow marks)" : "");
      put("</fieldset>\n");
    }
    put("</form>\n");
  }

  PlotInk ink_of(const MethodRows& method) const {
    return {looks_.at(method.method), method.is_peer, 0};
  }

  void add_head() {
    put("<h1>Error against cost</h1>\n<p>Problems whose answers are known, method by method: how "
        "far each run is off, and what it costs. Down and to the left is better. Pale bars reach "
        "from the lower to the upper quartile of the repeats; runs that failed lie at the upper "
        "edge. "
        "The pale stairs join the runs that no other beats in both.</p>\n");
    put("<h3>How it was run</h3>\n<div class=\"wide\"><table><thead><tr><th></th>");
    for (const char* name :
         {"Lantern", "sources", "compiler", "flags", "processor", "effort", "seed", "runs"})
      put("<th>{}</th>", name);
    put("</tr></thead><tbody>\n");
    for (std::size_t i = 0; i < measurements_.size(); ++i) {
      const Circumstances& c = measurements_[i].circumstances;
      put("<tr{}><th>{}</th>", is_shared() ? fmt::format(" class=\"k{}\"", i) : "",
          is_shared() ? machine_name(i) : "");
      for (const std::string& cell :
           {c.version, c.sources, c.compiler, c.flags, c.processor, c.effort})
        put("<td>{}</td>", escaped(cell));
      put("<td>{}</td><td>{}</td></tr>\n", c.seed, measurements_[i].rows.size());
    }
    put("</tbody></table></div>\n");
    for (std::size_t i = 1; i < measurements_.size(); ++i) {
      const auto [both, same] = same_runs(measurements_[0], measurements_[i]);
      put("<p>Of {} runs of Lantern that machines A and {} both made, {} ended in the same state, "
          "bit for bit.</p>\n",
          both, machine_letter(i), same);
    }
    add_engines();
    put("<nav aria-label=\"Problems\"><h3>Problems</h3>\n<ul class=\"index\">\n");
    for (std::size_t i = 0; i < problems_.size(); ++i)
      put("<li><a href=\"#p{}\">{}</a></li>\n", i, escaped(problem_words(problems_[i].any())));
    put("</ul></nav>\n");
  }

  // As the first measurement that has an engine tells.
  void add_engines() {
    std::vector<PeerRecord> peers;
    for (const Measurement& m : measurements_)
      for (const PeerRecord& peer : m.peers)
        if (std::ranges::find(peers, peer.name, &PeerRecord::name) == peers.end())
          peers.push_back(peer);
    if (!peers.empty()) put("{}", engines_table(peers, cast_));
  }

  void add_problem(std::size_t index) {
    const SharedProblem& problem = problems_[index];
    const ProblemRows& any = problem.any();
    put("<section id=\"p{}\"><h2>{}</h2>\n<p class=\"quiet\">{}</p>\n", index,
        escaped(problem_words(any)), escaped(file_name(any)));
    for (const std::string& note : notes_on(any)) put("<p class=\"quiet\">{}</p>\n", escaped(note));
    put("<div class=\"plots\">\n");
    std::vector<std::vector<Plot>> plots;  // of each machine
    for (const ProblemRows* rows : problem.of) {
      std::vector<Plot>& mine = plots.emplace_back();
      if (!rows) continue;
      auto [left, right] = plots_of(*rows, looks_);
      mine = {std::move(left), std::move(right), {}, {}};
      if (auto drift = drift_plots(*rows, looks_)) {
        mine[2] = std::move(drift->error);
        mine[3] = std::move(drift->energy);
      }
    }
    for (std::size_t which = 0; which < 4; ++which) add_figure(problem, which, plots);
    put("</div>\n");
    add_legend(problem);
    put("{}{}</section>\n", best_table(problem, cast_), runs_table(problem, cast_));
  }

  // All machines' series in one plot; the first machine's front and guides.
  void add_figure(const SharedProblem& problem, std::size_t which,
                  std::vector<std::vector<Plot>>& plots) {
    std::optional<Plot> plot;
    std::vector<std::string> classes;
    std::string only;
    for (std::size_t i = 0; i < problem.of.size(); ++i) {
      if (!problem.of[i]) continue;
      Plot& mine = plots[i][which];
      if (mine.title.empty() || (which == 3 && has_no_points(mine))) continue;
      if (plot && mine.title != plot->title) {  // other runs, of which another plot says more
        only = fmt::format(" (without machine {})", machine_letter(i));
        continue;
      }
      for (const MethodRows& method : by_method(*problem.of[i]))
        classes.push_back(cast_.class_of(method.method, i));
      if (!plot) {
        plot = std::move(mine);
        continue;
      }
      plot->series.insert(plot->series.end(), mine.series.begin(), mine.series.end());
      if (mine.bands.size() > plot->bands.size()) plot->bands = mine.bands;
    }
    if (!plot) return;
    put("<figure><figcaption><b>{}</b>{}<br>{}</figcaption>\n{}</figure>\n", escaped(plot->title),
        only, escaped(plot->y_name), svg_plot(*plot, classes));
  }

  // Orders are those of the first machine that has the method.
  void add_legend(const SharedProblem& problem) {
    put("<ul class=\"legend\">");
    for (const MethodRows& one : cast_.methods)
      for (const ProblemRows* rows : problem.of) {
        if (!rows) continue;
        const std::vector<MethodRows> all = by_method(*rows);
        const auto method = std::ranges::find(all, one.method, &MethodRows::method);
        if (method == all.end()) continue;
        const auto order = observed_order(method->rows);
        put("<li class=\"m{}\">{}{}{}</li>", cast_.number_of(one.method), svg_sample(ink_of(one)),
            escaped(method->name()), order ? fmt::format(": order {:.2f}", *order) : "");
        break;
      }
    put("</ul>\n");
  }

  std::span<const Measurement> measurements_;
  const std::vector<Bar>& bars_;
  std::vector<std::vector<ProblemRows>> problems_of_;  // of each machine
  std::vector<SharedProblem> problems_;
  HtmlCast cast_;
  Looks looks_;
  std::string out_;
};

}  // namespace

std::string to_html(std::span<const Measurement> measurements, const std::vector<Bar>& bars) {
  return HtmlPage(measurements, bars).text();
}

}  // namespace lantern::report
