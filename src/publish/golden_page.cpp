#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/markup.hpp"
#include "publish/golden_report.hpp"
#include "publish/packed.hpp"

namespace lantern::publish {
namespace {

constexpr std::string_view kGoldenStyle = R"css(
:root{color-scheme:light dark;--paper:#fff;--ink:#1b1f24;--quiet:#57606a;--rule:#d0d7de;--bad:#b3160b}
@media(prefers-color-scheme:dark){:root{--paper:#14171b;--ink:#e8eaed;--quiet:#a2aab4;--rule:#3c444d;--bad:#ff8d80}}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.5rem 2rem;max-width:110rem;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif}
h1{margin:0;font-size:1.7rem}h2{margin:2.5rem 0 .4rem;padding-top:1rem;border-top:1px solid var(--rule);font-size:1.3rem}
h3{margin:1.5rem 0 .3rem;font-size:1rem}summary{cursor:pointer;margin:1rem 0}.bad{color:var(--bad);font-weight:600}.quiet,figcaption,caption{color:var(--quiet)}
a{color:inherit}:focus-visible{outline:2px solid var(--ink);outline-offset:2px}
ul{margin:.3rem 0;padding-left:1.2rem}pre{white-space:pre-wrap;overflow-wrap:anywhere}
.three{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(20rem,100%),1fr));gap:.6rem;margin:.6rem 0}
figure{margin:0}figcaption{font-size:.85rem}img{display:block;width:100%;height:auto;border:1px solid var(--rule);background:#fff}
.wide{overflow-x:auto}table{border-collapse:collapse;font-size:.88rem;margin:.6rem 0}caption{text-align:left}
th,td{padding:.15rem 1rem .15rem 0;text-align:left;vertical-align:top;overflow-wrap:anywhere;font-variant-numeric:tabular-nums}
thead th{border-bottom:1px solid var(--ink)}tbody tr{border-bottom:1px solid var(--rule)}tbody th{font-weight:400}
@media print{article{break-inside:avoid-page}.three{grid-template-columns:repeat(3,1fr)}body{font-size:10pt}}
)css";

class GoldenPage {
 public:
  GoldenPage(std::span<const GoldenSuite> suites, const std::string& made_by)
      : suites_(suites), made_by_(made_by) {}

  std::string written() {
    std::size_t frames = 0, differing = 0;
    for (const GoldenSuite& s : suites_) frames += s.cases.size(), differing += s.differing();
    put("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n",
        differing > 0 ? differing_of(differing, frames)
                      : fmt::format("{} as expected", counted_frames(frames)),
        kGoldenStyle);
    put("<p class=\"quiet\">Compared with their golden frames; found by {}.</p>\n",
        escaped(made_by_));
    put_first();
    for (std::size_t i = 0; i < suites_.size(); ++i)
      if (!suites_[i].good()) put_suite(i);
    put_good();
    put("</main>\n</body>\n</html>\n");
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kMostCases = 200;

  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...);
  }

  // What differs first, of every scenario.
  void put_first() {
    put("<ul>\n");
    for (std::size_t i = 0; i < suites_.size(); ++i) {
      const GoldenSuite& s = suites_[i];
      if (s.good()) continue;
      put("<li><a href=\"#s{}\">{}</a>", i, escaped(s.scenario));
      if (const GoldenCase* first = s.first())
        put(" differs first in <a href=\"#s{}f{}\">{}</a>: {}", i, first->frame,
            escaped(name_of(*first)), escaped(first->findings.front()));
      put("</li>\n");
    }
    put("</ul>\n");
  }

  void put_suite(std::size_t place) {
    const GoldenSuite& s = suites_[place];
    put("<section aria-labelledby=\"s{0}\">\n<h2 id=\"s{0}\">{1}</h2>\n", place,
        escaped(s.scenario));
    if (!s.error.empty()) put("<pre class=\"bad\">{}</pre>\n", escaped(s.error));
    for (const std::string& text : s.findings) put("<p class=\"bad\">{}</p>\n", escaped(text));
    const std::size_t differing = s.differing();
    if (!s.cases.empty()) put("<p>{}.</p>\n", differing_of(differing, s.cases.size()));
    std::size_t shown = 0;
    for (const GoldenCase& c : s.cases)
      if (!c.findings.empty() && shown++ < kMostCases) put_case(place, c);
    if (shown > kMostCases) put("<p>{} more frames differ.</p>\n", shown - kMostCases);
    put_unmet(s.unmet_count, s.unmet);
    put("</section>\n");
  }

  // Mostly a consequence of what differs, and long.
  void put_unmet(std::uint64_t count, const std::vector<std::string>& unmet) {
    if (count == 0) return;
    put("<details><summary>{} not met</summary>\n",
        count == 1 ? "An expectation is" : fmt::format("{} expectations are", count));
    for (const std::string& text : unmet) put("<pre>{}</pre>\n", escaped(text));
    put("</details>\n");
  }

  void put_case(std::size_t place, const GoldenCase& c) {
    std::string name = name_of(c);
    name[0] = static_cast<char>(std::toupper(name[0]));
    put("<article aria-labelledby=\"s{0}f{1}\">\n<h3 id=\"s{0}f{1}\">{2}</h3>\n<ul>\n", place,
        c.frame, escaped(name));
    for (const std::string& text : c.findings) put("<li>{}</li>\n", escaped(text));
    put("</ul>\n");
    if (!c.picture_differs) {
      put("<p class=\"quiet\">Its picture is as expected.</p>\n");
    } else if (!c.expected.empty() || !c.actual.empty()) {
      put("<div class=\"three\">\n");
      put_picture(c.expected, "Expected", name);
      put_picture(c.actual, "Found", name);
      put_picture(c.difference, "Difference, in red", name);
      put("</div>\n");
    } else {
      put("<p class=\"quiet\">Its pictures are not shown.</p>\n");
    }
    put_facts(c.facts);
    put("</article>\n");
  }

  void put_picture(const std::string& png, std::string_view title, const std::string& name) {
    if (png.empty()) return;
    put("<figure><img src=\"{}\" alt=\"{}: {}\"><figcaption>{}</figcaption></figure>\n",
        "data:image/png;base64," + base64(png), escaped(name), title, title);
  }

  void put_facts(const FactsComparison& facts) {
    if (facts.differences.empty()) return;
    put("<div class=\"wide\"><table>\n<caption>Facts that differ</caption>\n<thead><tr>"
        "<th scope=\"col\">fact</th><th scope=\"col\">expected</th><th scope=\"col\">found</th>"
        "</tr></thead>\n<tbody>\n");
    for (const FactsDifference& d : facts.differences)
      put("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", escaped(d.path),
          escaped(d.expected), escaped(d.actual));
    put("</tbody>\n</table></div>\n");
    if (facts.total > facts.differences.size())
      put("<p>{} more facts differ.</p>\n", facts.total - facts.differences.size());
  }

  void put_good() {
    std::string names;
    for (const GoldenSuite& s : suites_)
      if (s.good())
        names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", escaped(s.scenario),
                             counted_frames(s.cases.size()));
    if (!names.empty()) put("<h2>As expected</h2>\n<p>{}</p>\n", names);
  }

  std::span<const GoldenSuite> suites_;
  const std::string& made_by_;
  std::string out_;
};

}  // namespace

std::string golden_page(std::span<const GoldenSuite> suites, const std::string& made_by) {
  return GoldenPage(suites, made_by).written();
}

}  // namespace lantern::publish
