#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/grouped.hpp"
#include "base/markup.hpp"
#include "report/bench_pairs.hpp"
#include "report/html_plot.hpp"
#include "report/html_style.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

class PairsPage {
 public:
  explicit PairsPage(const BoxBenchResult& result) : result_(result) {
    for (const BoxBenchRow& row : result.rows) {
      if (std::ranges::find(workloads_, row.workload) == workloads_.end())
        workloads_.push_back(row.workload);
      if (std::ranges::find(names_, row.contestant, &Contestant::name) == names_.end())
        names_.push_back({row.contestant, row.is_peer()});
    }
    std::ranges::stable_sort(names_, {}, &Contestant::is_peer);
  }

  std::string text() {
    std::string rules;
    for (std::size_t i = 0; i < names_.size(); ++i)
      rules += fmt::format(":root:has(#m{0}:not(:checked)) .m{0}{{display:none}}\n", i);
    put("{}<div class=\"page\">\n", html_begin("Pairs of boxes", rules));
    add_choices();
    put("<main>\n");
    add_head();
    add_ratios();
    for (std::size_t i = 0; i < workloads_.size(); ++i) add_workload(i);
    put("</main></div>\n<script>{}</script>\n</body></html>\n", kPageScript);
    return std::move(out_);
  }

 private:
  struct Contestant {
    std::string name;
    bool is_peer = false;
  };

  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  std::size_t number_of(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(names_, name, &Contestant::name) -
                                    names_.begin());
  }
  PlotInk ink_of(std::size_t i) const {
    const auto first_peer = static_cast<std::size_t>(
        std::ranges::find(names_, true, &Contestant::is_peer) - names_.begin());
    const bool is_peer = names_[i].is_peer;
    return {static_cast<int>(is_peer ? kFirstPeerLook + i - first_peer : i), is_peer, 0};
  }

  static bool is_timed(const BoxBenchRow& row) { return row.timing.repeats > 0; }

  void add_choices() {
    put("<form class=\"side\" aria-label=\"What is shown\">\n<div id=\"buttons\"></div>");
    for (const bool peers : {false, true}) {
      if (std::ranges::find(names_, peers, &Contestant::is_peer) == names_.end()) continue;
      put("<fieldset><legend>{}</legend>\n", peers ? "Other libraries" : "Lantern’s structures");
      for (std::size_t i = 0; i < names_.size(); ++i)
        if (names_[i].is_peer == peers)
          put("<label><input type=\"checkbox\" name=\"method\" id=\"m{}\"{} checked>{}{}</label>\n",
              i, peers ? " data-peer=\"1\"" : "", svg_sample(ink_of(i)), escaped(names_[i].name));
      put("</fieldset>\n");
    }
    put("</form>\n");
  }

  void add_head() {
    const Circumstances& c = result_.circumstances;
    put("<h1>Pairs of boxes</h1>\n<p>All pairs of boxes that overlap, step by step, while the "
        "boxes "
        "move; and what rays, boxes and balls meet. All contestants get the same boxes in the same "
        "run, in turns; each gives its pairs in order of ids, each once, within its time. What "
        "others find is ordered by Lantern’s own code. Times are of the processor, all threads "
        "together. Pale bars reach from the lower to the upper quartile.</p>\n");
    put("<h3>How it was run</h3>\n<p><code>{}</code></p>\n", escaped(result_.command));
    put("<div class=\"wide\"><table><thead><tr>");
    for (const char* name : {"Lantern", "sources", "compiler", "flags", "processor"})
      put("<th>{}</th>", name);
    put("</tr></thead><tbody><tr>");
    for (const std::string& cell : {c.version, c.sources, c.compiler, c.flags, c.processor})
      put("<td>{}</td>", escaped(cell));
    put("</tr></tbody></table></div>\n");
    if (!result_.peers.empty()) {
      put("<div class=\"wide\"><table><thead><tr><th>library</th><th>version</th><th>run so</th>"
          "</tr></thead><tbody>\n");
      for (const BoxPeerWords& peer : result_.peers)
        put("<tr class=\"m{}\"><td>{}</td><td>{}</td><td>{}</td></tr>\n", number_of(peer.name),
            escaped(peer.name), escaped(peer.version), escaped(peer.how));
      put("</tbody></table></div>\n");
    }
    for (const std::string& line : result_.missing)
      put("<p class=\"quiet\">{}</p>\n", escaped(line));
  }

  // Each world beside the quickest other library.
  void add_ratios() {
    put("<section><h2>How many times as quick as the quickest other library</h2>\n<div "
        "class=\"wide\"><table><thead><tr><th>world</th><th class=\"n\">boxes</th>");
    for (std::size_t i = 0; i < names_.size(); ++i)
      put("<th class=\"n m{}\">{}</th>", i, escaped(names_[i].name));
    put("</tr></thead><tbody>\n");
    for (std::size_t i = 0; i < workloads_.size(); ++i)
      for (const std::uint64_t bodies : sizes_of(workloads_[i])) {
        put("<tr><td><a href=\"#w{}\">{}</a></td><td class=\"n\">{}</td>", i,
            escaped(workloads_[i]), grouped(static_cast<std::int64_t>(bodies)));
        for (std::size_t k = 0; k < names_.size(); ++k) {
          const BoxBenchRow* row = find(workloads_[i], bodies, names_[k].name);
          const BoxBenchRow* peer = row ? fastest_peer(result_.rows, *row) : nullptr;
          put("<td class=\"n m{}\">{}</td>", k, ratio_text(row, peer));
        }
        put("</tr>\n");
      }
    put("</tbody></table></div></section>\n");
  }

  static std::string ratio_text(const BoxBenchRow* row, const BoxBenchRow* peer) {
    if (!row) return "–";
    if (!is_timed(*row)) return escaped(row->status);
    if (!row->is_good()) return "<span class=\"bad\">wrong</span>";
    return peer ? fmt::format("{:.3g}", peer->timing.median / row->timing.median) : "–";
  }

  std::vector<std::uint64_t> sizes_of(const std::string& workload) const {
    std::vector<std::uint64_t> sizes;
    for (const BoxBenchRow& row : result_.rows)
      if (row.workload == workload && std::ranges::find(sizes, row.bodies) == sizes.end())
        sizes.push_back(row.bodies);
    return sizes;
  }

  const BoxBenchRow* find(const std::string& workload, std::uint64_t bodies,
                          const std::string& name) const {
    for (const BoxBenchRow& row : result_.rows)
      if (row.workload == workload && row.bodies == bodies && row.contestant == name) return &row;
    return nullptr;
  }

  static const BoxWorkload* known(const std::string& name) {
    for (const BoxWorkload& one : box_workloads())
      if (one.name == name) return &one;
    return nullptr;
  }

  void add_workload(std::size_t index) {
    const std::string& name = workloads_[index];
    const BoxWorkload* workload = known(name);
    put("<section id=\"w{}\"><h2>{}</h2>\n<p>{}</p>\n", index, escaped(name),
        escaped(workload             ? std::string(workload->words)
                : result_.config.own ? result_.config.own->words
                                     : ""));
    if (sizes_of(name).size() > 1) {
      put("<div class=\"plots\">\n");
      add_plot(name, workload && workload->task != BoxTask::pairs, false);
      add_plot(name, false, true);
      put("</div>\n");
    }
    add_table(name, workload && workload->task != BoxTask::pairs);
    put("</section>\n");
  }

  // Nanoseconds a box, or a question; or the ratio to the quickest other library.
  void add_plot(const std::string& workload, bool is_asked, bool as_ratio) {
    Plot plot;
    plot.title = as_ratio   ? "Times as quick as the quickest other library"
                 : is_asked ? "Time a question"
                            : "Time a box and step";
    plot.x_name = "boxes";
    plot.y_name = as_ratio ? "ratio; above 1 is quicker" : "nanoseconds";
    std::vector<std::string> classes;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      PlotSeries series{names_[i].name, {}, ink_of(i).look, names_[i].is_peer};
      for (const std::uint64_t bodies : sizes_of(workload))
        if (const BoxBenchRow* row = find(workload, bodies, names_[i].name);
            row && is_timed(*row) && row->is_good())
          if (const auto point = as_ratio ? ratio_point(*row) : time_point(*row, is_asked))
            series.points.push_back(*point);
      if (series.points.empty()) continue;
      plot.series.push_back(std::move(series));
      classes.push_back(fmt::format("m{}", i));
    }
    if (plot.series.empty()) return;
    put("<figure><figcaption><b>{}</b><br>{}</figcaption>\n{}</figure>\n", plot.title, plot.y_name,
        svg_plot(plot, classes));
  }

  static std::optional<PlotPoint> time_point(const BoxBenchRow& row, bool is_asked) {
    const auto x = static_cast<double>(row.bodies);
    const double unit = is_asked ? 1e9 : 1e9 / x;
    PlotPoint point{{x, unit * row.timing.median}};
    point.spread = {{x, unit * row.timing.lower_quartile}, {x, unit * row.timing.upper_quartile}};
    return point;
  }

  std::optional<PlotPoint> ratio_point(const BoxBenchRow& row) const {
    const BoxBenchRow* peer = fastest_peer(result_.rows, row);
    if (!peer) return std::nullopt;
    return PlotPoint{{static_cast<double>(row.bodies), peer->timing.median / row.timing.median}};
  }

  void add_table(const std::string& workload, bool is_asked) {
    for (const std::uint64_t bodies : sizes_of(workload))
      for (const BoxBenchRow& row : result_.rows)
        if (row.workload == workload && row.bodies == bodies && !row.checked.empty()) {
          put("<p class=\"quiet\">{} boxes: checked by {}.</p>\n",
              grouped(static_cast<std::int64_t>(bodies)), escaped(row.checked));
          break;
        }
    put("<div class=\"wide\"><table><thead><tr><th>contestant</th><th class=\"n\">boxes</th>"
        "<th class=\"n\">{}</th><th class=\"n\">quartiles</th><th class=\"n\">clock</th>"
        "<th class=\"n\">found</th><th class=\"n\">calls for memory</th><th class=\"n\">bytes a "
        "box</th><th class=\"n\">pair tests</th><th class=\"n\">box tests</th><th class=\"n\">"
        "nodes</th><th>setting</th></tr></thead><tbody>\n",
        is_asked ? "time a question" : "time a step");
    for (const BoxBenchRow& row : result_.rows)
      if (row.workload == workload) add_row(row);
    put("</tbody></table></div>\n");
  }

  void add_row(const BoxBenchRow& row) {
    put("<tr class=\"m{}\"><td>{}</td><td class=\"n\">{}</td>", number_of(row.contestant),
        escaped(row.contestant), grouped(static_cast<std::int64_t>(row.bodies)));
    if (!is_timed(row)) {
      put("<td colspan=\"10\" class=\"quiet\">{}: {}</td></tr>\n", row.status, escaped(row.reason));
      return;
    }
    const Timing& t = row.timing;
    put("<td class=\"n\">{}</td><td class=\"n\">{} – {}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td>",
        seconds_text(t.median), seconds_text(t.lower_quartile), seconds_text(t.upper_quartile),
        seconds_text(row.wall), grouped(static_cast<std::int64_t>(row.found)));
    for (const auto& count : {row.allocations, row.bytes, row.counts.pair_tests,
                              row.counts.box_tests, row.counts.nodes_visited})
      put("<td class=\"n\">{}</td>", count ? figure(*count) : "–");
    put("<td style=\"white-space:nowrap\">{}{}</td></tr>\n", escaped(row.setting),
        row.is_good() ? ""
                      : fmt::format(" <span class=\"bad\">wrong</span>: {}", escaped(row.reason)));
  }

  const BoxBenchResult& result_;
  std::vector<std::string> workloads_;
  std::vector<Contestant> names_;
  std::string out_;
};

}  // namespace

std::string to_html(const BoxBenchResult& result) { return PairsPage(result).text(); }

}  // namespace lantern::report
