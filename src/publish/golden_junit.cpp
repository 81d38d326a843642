#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/markup.hpp"
#include "publish/golden_report.hpp"

namespace lantern::publish {
namespace {

std::string joined(const std::vector<std::string>& parts, std::string_view between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : std::string(between)) + part;
  return text;
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

}  // namespace

std::string golden_junit(std::span<const GoldenSuite> suites) {
  return JunitWriter().written(suites);
}

}  // namespace lantern::publish
