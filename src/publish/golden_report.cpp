#include "publish/golden_report.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/printable.hpp"
#include "publish/packed.hpp"

namespace lantern::publish {

std::size_t GoldenSuite::differing() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(cases, [](const GoldenCase& c) { return !c.findings.empty(); }));
}

bool GoldenSuite::good() const {
  return error.empty() && findings.empty() && unmet_count == 0 && first() == nullptr;
}

const GoldenCase* GoldenSuite::first() const {
  const auto it = std::ranges::find_if(cases, [](const auto& c) { return !c.findings.empty(); });
  return it == cases.end() ? nullptr : &*it;
}

std::string name_of(const GoldenCase& one) {
  return one.event.empty() ? fmt::format("frame {}", one.frame)
                           : fmt::format("frame {} ({})", one.frame, one.event);
}

std::string differing_of(std::size_t differing, std::size_t frames) {
  return fmt::format("{} of {} {}", differing, counted(frames, "frame"),
                     differing == 1 ? "differs" : "differ");
}

namespace {

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
  return fmt::format("{}", fmt::join(parts, between));
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

class JunitWriter {
 public:
  std::string written(std::span<const GoldenSuite> suites) {
    std::string all;
    Counts sum;
    for (const GoldenSuite& s : suites) {
      text_.clear();
      counts_ = {};
      cases_of(s);
      all +=
          fmt::format("  <testsuite name=\"{}\" file=\"{}\" {} skipped=\"0\">\n{}  </testsuite>\n",
                      escaped(s.scenario), escaped(s.file), attributes(counts_), text_);
      sum.tests += counts_.tests;
      sum.failures += counts_.failures;
      sum.errors += counts_.errors;
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"lantern golden\" {}>\n{}"
        "</testsuites>\n",
        attributes(sum), all);
  }

 private:
  struct Counts {
    std::size_t tests = 0, failures = 0, errors = 0;
  };

  static std::string attributes(const Counts& c) {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"", c.tests, c.failures, c.errors);
  }

  void cases_of(const GoldenSuite& s) {
    if (!s.error.empty()) {
      put(s, "run", "error", first_line(s.error), s.error);
      ++counts_.errors;
    }
    if (!s.findings.empty())
      fail(s, "all frames", joined(s.findings, "; "), joined(s.findings, "\n"));
    if (s.unmet_count > 0)
      fail(s, "expectations", first_line(s.unmet.front()), joined(s.unmet, "\n"));
    for (const GoldenCase& c : s.cases) {
      if (c.findings.empty()) {
        put(s, name_of(c), "", "", "");
      } else {
        std::string rest = joined(c.findings, "\n");
        for (const FactsDifference& d : c.facts.differences)
          rest += fmt::format("\n{}: expected {}, found {}", d.path, d.expected, d.actual);
        fail(s, name_of(c), joined(c.findings, "; "), rest);
      }
    }
  }

  void fail(const GoldenSuite& s, const std::string& name, const std::string& message,
            const std::string& rest) {
    put(s, name, "failure", message, rest);
    ++counts_.failures;
  }

  // A case, with what came in its way unless `what` is empty.
  void put(const GoldenSuite& s, const std::string& name, std::string_view what,
           const std::string& message, const std::string& rest) {
    ++counts_.tests;
    text_ += fmt::format("    <testcase name=\"{}\" classname=\"golden.{}\"", escaped(name),
                         escaped(s.scenario));
    text_ += what.empty() ? "/>\n"
                          : fmt::format(
                                ">\n      <{0} type=\"golden\" message=\"{1}\">{2}</{0}>\n"
                                "    </testcase>\n",
                                what, escaped(message), escaped(rest));
  }

  std::string text_;
  Counts counts_;
};

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
    const std::string title = differing > 0
                                  ? differing_of(differing, frames)
                                  : fmt::format("{} as expected", counted(frames, "frame"));
    put("<style>{}</style>\n</head>\n<body>\n<main>\n<h1>{}</h1>\n", kGoldenStyle, title);
    put("<p class=\"quiet\">Compared with their golden frames; found by {}.</p>\n",
        escaped(made_by_));
    put_first();
    for (std::size_t i = 0; i < suites_.size(); ++i)
      if (!suites_[i].good()) put_suite(i);
    put_good();
    put("</main>\n");
    return html_page(title, out_);
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
                             counted(s.cases.size(), "frame"));
    if (!names.empty()) put("<h2>As expected</h2>\n<p>{}</p>\n", names);
  }

  std::span<const GoldenSuite> suites_;
  const std::string& made_by_;
  std::string out_;
};

}  // namespace

std::string golden_junit(std::span<const GoldenSuite> suites) {
  return JunitWriter().written(suites);
}

std::string golden_page(std::span<const GoldenSuite> suites, const std::string& made_by) {
  return GoldenPage(suites, made_by).written();
}

}  // namespace lantern::publish
