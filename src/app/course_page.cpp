#include "app/course_page.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"

namespace lantern::app {
namespace {

constexpr std::string_view kHead =
    "# The course\n\n"
    "All sequences in the order in which one would teach them. Each says what should be seen "
    "before "
    "it, and asks the\nstudents something afterwards. The answers are filled in by the run, and "
    "its "
    "expectations prove them; this page is\nprinted by `lantern list --course`.\n";

struct Asked {
  FrameQuestion question;
  std::uint32_t step = 0;
  std::uint32_t frame = 0;
};

class QuestionSink : public FrameSink {
 public:
  void frame(const Frame& frame) override {
    if (frame.find<FrameQuestion>())
      asked.push_back({*frame.find<FrameQuestion>(), frame.step, frame.index});
  }
  void finish(const DirectorReport&) override {}

  std::vector<Asked> asked;
};

std::string heading_of(const Scenario& s) {
  return s.lecture ? fmt::format("{} {}", *s.lecture, s.title) : s.title;
}

std::string needs_of(const Scenario& s, const std::map<std::string, std::string>& headings) {
  std::string text;
  for (const std::string& need : s.needs) {
    const auto found = headings.find(need);
    text += text.empty() ? "After " : ", ";
    text += found == headings.end() ? fmt::format("`{}`", need)
                                    : fmt::format("[{}](#{})", found->second, need);
  }
  return text.empty() ? "" : text + ".\n\n";
}

std::string entry_of(const Scenario& s, const std::vector<Asked>& asked,
                     const std::map<std::string, std::string>& headings) {
  std::string text = fmt::format("\n## <a id=\"{1}\"></a>{0}\n\n`{1}`: {2}\n\n{3}", heading_of(s),
                                 s.name, s.idea.empty() ? s.title : s.idea, needs_of(s, headings));
  for (const Asked& a : asked) {
    const std::string& step = s.steps.at(a.step).name;
    text += fmt::format(
        "**{}**\n\n<details><summary>Answer</summary>\n\n{} Look at {}, frame {}.\n\n"
        "It holds that {}.\n\n</details>\n",
        a.question.asked, a.question.answer,
        step.empty() ? fmt::format("step {}", a.step + 1) : fmt::format("`{}`", step), a.frame,
        fmt::format("{}", fmt::join(proofs_of(s, a.step), "; ")));
  }
  return text;
}

}  // namespace

int print_course(const std::vector<std::string>& files) {
  int code = kGood;
  std::vector<Scenario> scenarios;
  std::map<std::string, std::string> headings;
  for (const std::string& file : files)
    if (auto scenario = load_or_complain(file, code)) {
      headings.emplace(scenario->name, heading_of(*scenario));
      scenarios.push_back(std::move(*scenario));
    }
  std::string page(kHead);
  for (const Scenario& scenario : scenarios) {
    QuestionSink sink;
    Work work;
    try {
      const RunResult result = run_scenario(scenario, Pace::step, sink, work);
      code = std::max(code, tell(result, false));
    } catch (const ScenarioError& e) {
      complain(e);
      code = std::max(code, exit_code_of(e));
    }
    page += entry_of(scenario, sink.asked, headings);
  }
  print(page);
  return code;
}

}  // namespace lantern::app
