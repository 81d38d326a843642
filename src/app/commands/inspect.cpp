// Commands that draw nothing: `check` and `explain`, runs of scenarios; `list`, the scenarios and
// the course that they make; and `doctor`, what they can be drawn and measured with.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "app/commands/command.hpp"
#include "app/lab.hpp"
#include "app/progress.hpp"
#include "app/run_scenario.hpp"
#include "app/terminal.hpp"
#include "app/trial.hpp"
#include "base/child.hpp"
#include "base/json_writer.hpp"
#include "base/memory.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "embedded/version.hpp"
#include "render/context.hpp"
#include "run/tally.hpp"
#include "run/warnings.hpp"

namespace lantern::app {
namespace {

struct CheckOptions {
  std::vector<std::string> files;
  std::string pace;
  bool strict = false, json = false, hashes = false;
};

Options check_options(CheckOptions& o) {
  return {{"FILE", &o.files, kFilesHelp, {.required = true}},
          pace_option(o.pace),
          language_option(),
          words_option(),
          memory_option(),
          {"--strict", &o.strict, "turn warnings into errors (exit code 3)"},
          json_option(o.json),
          {"--hashes", &o.hashes, "with --json: the hash of each frame, as its facts have it"}};
}

// What is expected is verified on the outcomes of steps: all frames are made for their hashes only.
class Hashes : public FrameSink {
 public:
  explicit Hashes(bool wanted) : wanted_(wanted) {}
  Wanted wants() const override { return wanted_ ? Wanted::all : Wanted::outcomes; }
  void frame(const Frame& frame) override {
    if (wanted_) all.push_back(fmt::format("{:016x}", frame.hash));
  }
  std::vector<std::string> all;

 private:
  bool wanted_;
};

struct Verdict {
  std::string file;
  std::string name;  // empty if it could not be read
  int code = kGood;
  RunResult result;
  std::vector<Diagnostic> problems;
  std::optional<std::vector<std::string>> hashes;
};

// Runs one scenario; what is wrong with it goes to standard error.
Verdict check_one(const std::string& file, const CheckOptions& options, Work& work) {
  Verdict verdict;
  verdict.file = file == "-" ? kStandardInput : file;
  try {
    const Scenario scenario = load_scenario(scenario_file(file), wording());
    verdict.name = scenario.name;
    Hashes hashes(options.hashes);
    verdict.result = run_scenario(scenario, pace_of(options.pace, scenario), hashes, work);
    if (options.hashes) verdict.hashes = std::move(hashes.all);
    verdict.code = tell(verdict.result, options.strict);
    verdict.problems = unmet_of(verdict.result);
    if (options.strict)
      std::ranges::move(std::exchange(verdict.result.warnings, {}),
                        std::back_inserter(verdict.problems));
  } catch (const ScenarioError& e) {
    verdict.code = exit_code_of(e);
    complain(e);
    verdict.problems = e.diagnostics();
  } catch (const IoError& e) {
    verdict.code = kFailed;
    complain(e.what());
    verdict.problems.emplace_back().message = e.what();
  }
  return verdict;
}

void write(JsonWriter& json, const Verdict& v) {
  json.line().begin_object().member("file", v.file).key("name");
  v.name.empty() ? json.null() : json.value(v.name);
  json.member("good", v.code == kGood);
  json.member("frames", v.result.report.frames)
      .member("expectations", v.result.report.expectations);
  json.members("problems", v.problems, "warnings", v.result.warnings, "facts", v.result.facts);
  if (v.hashes) json.member("hashes", *v.hashes);
  json.end_object();
}

// "x.toml: good; 8 frames, 1 expectation holds; 2 warnings"
std::string summary_of(const Verdict& v) {
  const std::uint64_t expectations = v.result.report.expectations;
  std::string text =
      fmt::format("{}: good; {}, {} {}", v.file, counted(v.result.report.frames, "frame"),
                  counted(expectations, "expectation"), expectations == 1 ? "holds" : "hold");
  for (const std::string& fact : v.result.facts) text += "; " + fact;
  if (!v.result.warnings.empty()) text += "; " + counted(v.result.warnings.size(), "warning");
  return text;
}

int check_scenarios(const CheckOptions& options) {
  if (options.hashes && !options.json) throw UsageError("--hashes are told in JSON: add --json");
  Work work;
  JsonWriter json = answer_of("check");
  json.line().key("scenarios").begin_array();
  int code = kGood;
  for (const std::string& file : input_files(options.files)) {
    const Verdict v = check_one(file, options, work);
    code = std::max(code, v.code);
    write(json, v);
    if (v.code == kGood && !options.json) say(summary_of(v));
  }
  json.line().end_array().line().key("work");
  app::write(json, work);
  json.line().end_object();
  if (options.json) answer(json.text());
  return code;
}

struct ExplainOptions {
  std::string file;
  bool json = false;
};

Options explain_options(ExplainOptions& o) {
  return {{"FILE", &o.file, "scenario file; - is standard input", {.required = true}},
          memory_option(),
          json_option(o.json)};
}

// "60 searches, 1 candidate pair; 10.3 s passed": of amounts behind the first only what there is.
std::string told(const StageTally& stage) {
  std::string text;
  for (const Amount& a : stage.amounts)
    if (a.n > 0 || &a == &stage.amounts.front())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", lantern::grouped(a.n, " "),
                          a.n == 1 ? a.name : a.many);
  return text + (stage.note.empty() ? "" : "; ") + stage.note;
}

std::string json_of(const Scenario& scenario, const std::vector<StageTally>& stages,
                    std::uint64_t frames, double seconds) {
  JsonWriter json = answer_of("explain");
  json.line().member("scenario", scenario.name).member("frames", frames);
  json.member("seconds", seconds).line().key("stages").begin_array();
  for (const StageTally& stage : stages) {
    json.line().begin_object().member("stage", stage.stage).member("used", stage.used());
    json.key("counts").begin_object();
    for (const Amount& a : stage.amounts) json.member(a.many, a.n);
    json.end_object().member("note", stage.note).end_object();
  }
  json.line().end_array().line().end_object();
  return json.text();
}

// What ran, a row each. Of what did not, whose counters all stand at 0, a row for each reason.
std::string list_of(const std::vector<StageTally>& stages) {
  constexpr std::size_t kLongest = 64;  // of names in a line
  std::vector<std::vector<std::string>> used, left_out;
  std::map<std::string, std::vector<std::string>> lines;  // of names, by reason
  for (const StageTally& stage : stages) {
    if (stage.used()) {
      used.push_back({"uses", stage.stage, told(stage)});
      continue;
    }
    auto& names = lines[stage.note.empty() ? "nothing asks for it" : stage.note];
    if (names.empty() || names.back().size() + stage.stage.size() > kLongest)
      names.push_back(stage.stage);
    else
      names.back() += ", " + stage.stage;
  }
  for (const auto& [reason, names] : lines)
    for (const std::string& line : names)
      left_out.push_back(line == names.front()
                             ? std::vector<std::string>{"leaves out", reason, line}
                             : std::vector<std::string>{"", "", line});
  return table(used) + "\n" + table(left_out);
}

int explain_scenario(const ExplainOptions& options) {
  const Scenario scenario = load_scenario(scenario_file(options.file), wording());
  Work work;
  Tally tally(scenario, work);
  const Stopwatch watch;
  std::optional<Progress> progress;
  progress.emplace(scenario.name, extent_of(scenario, scenario.pace), work, memory_budget());
  Trials trials([&] { return progress->long_left(); }, work);
  RunWatch shown(trials);
  std::uint64_t frames = 0;
  const auto see = [&](const Frame& frame) {
    tally.see(frame);
    progress->done(++frames);
    return true;
  };
  const DirectorReport report = direct(scenario, scenario.pace, work, see, &shown);
  progress.reset();
  const double seconds = watch.seconds();
  const std::vector<StageTally> stages = tally.stages(report);
  if (options.json) {
    answer(json_of(scenario, stages, report.frames, seconds));
    return kGood;
  }
  print(fmt::format("{}: {}\n\n{}\nCounted in a run without pixels: {} in {:.2g} s.\n",
                    scenario.name, scenario.title, list_of(stages), counted(report.frames, "frame"),
                    seconds));
  return kGood;
}

constexpr std::string_view kHead =
    "# The course\n\nAll sequences in the order in which one would teach them. Each says what "
    "should be seen before it, and asks the\nstudents something afterwards. The answers are filled "
    "in by the run, and its expectations prove them; this page is\nprinted by `lantern list "
    "--course`.\n";

// The questions of a run, each with the frame that has its answer.
class QuestionSink : public FrameSink {
 public:
  void frame(const Frame& frame) override {
    if (const auto* question = frame.find<FrameQuestion>())
      asked.push_back({*question, frame.step, frame.index});
  }

  struct Asked {
    FrameQuestion question;
    std::uint32_t step = 0, frame = 0;
  };
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

std::string entry_of(const Scenario& s, const std::vector<QuestionSink::Asked>& asked,
                     const std::map<std::string, std::string>& headings) {
  std::string text = fmt::format("\n## <a id=\"{1}\"></a>{0}\n\n`{1}`: {2}\n\n{3}", heading_of(s),
                                 s.name, s.idea.empty() ? s.title : s.idea, needs_of(s, headings));
  for (const auto& a : asked) {
    const std::string& step = s.steps.at(a.step).name;
    text += fmt::format(
        "**{}**\n\n<details><summary>Answer</summary>\n\n{} Look at {}, frame {}.\n\n"
        "It holds that {}.\n\n</details>\n",
        a.question.asked, a.question.answer,
        step.empty() ? fmt::format("step {}", a.step + 1) : fmt::format("`{}`", step), a.frame,
        fmt::format("{}", fmt::join(mapped(proofs_of(s, a.step), &Proof::text), "; ")));
  }
  return text;
}

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

struct ListOptions {
  std::vector<std::string> folders;
  bool course = false, json = false, names = false;
};

Options list_options(ListOptions& o) {
  return {{"DIR", &o.folders, "folders or files; the default is scenarios"},
          json_option(o.json),
          {"--names", &o.names, "names alone, a line each", OptionTraits{.without = "--json"}},
          {"--course", &o.course,
           "run them, and print the course as Markdown: ideas, what comes before, questions "
           "with their answers",
           OptionTraits{.without = "--json"}}};
}

std::vector<std::string> row_of(const Scenario& s) {
  return {s.lecture ? fmt::format("{}", *s.lecture) : "", s.name, s.title, s.idea,
          s.needs.empty() ? "" : fmt::format("after {}", fmt::join(s.needs, ", "))};
}

void add_member(JsonWriter& json, const Scenario& s) {
  json.line().begin_object().members("name", s.name, "title", s.title, "source", s.source, "idea",
                                     s.idea);
  json.members("lecture", s.lecture, "needs", s.needs);
  json.key("questions").begin_array();
  for (const Step& step : s.steps)
    if (!step.question.empty()) json.value(step.question);
  json.end_array();
  json.members("steps", s.steps.size(), "file", s.file);
  json.end_object();
}

// Lines no longer than that; on no terminal as they are.
std::string cut_to(std::optional<std::size_t> width, const std::string& lines) {
  if (!width) return lines;
  std::string cut;
  std::istringstream each(lines);
  for (std::string line; std::getline(each, line);) {
    const bool fits = letters(line) <= *width;
    for (bool is_whole = fits; !is_whole; is_whole = letters(line) < *width) {
      const auto begins_letter = [](char c) { return (c & 0xc0) != 0x80; };
      line.erase(std::find_if(line.rbegin(), line.rend(), begins_letter).base() - 1, line.end());
    }
    cut += line + (fits ? "\n" : "…\n");
  }
  return cut;
}

int list_scenarios(const ListOptions& options) {
  const std::vector<std::string> files = listed_files(options.folders);
  if (options.course) return print_course(files);
  if (options.names) {
    std::string names;
    for (const std::string& file : files)
      names += std::filesystem::path(file).stem().string() + "\n";
    print(names);
    return kGood;
  }
  constexpr std::size_t kWithIdeas = 120, kWithoutIdea = 3;
  const auto width = terminal_width();
  std::vector<std::vector<std::string>> rows;
  JsonWriter json = answer_of("list");
  json.line().key("scenarios").begin_array();
  int code = kGood;
  for (const std::string& file : files)
    if (const auto scenario = load_or_complain(file, code)) {
      rows.push_back(row_of(*scenario));
      if (width && *width < kWithIdeas) rows.back().resize(kWithoutIdea);
      add_member(json, *scenario);
    }
  json.line().end_array().line().end_object();
  options.json ? answer(json.text()) : print(cut_to(width, table(rows)));
  return code;
}

// What Lantern can be measured beside: "Box2D 2.4.1 (single)", or that there is no lab.
std::vector<std::string> found_peers(
    std::vector<std::string> (*Lab::*peers)(std::vector<std::string>&),
    std::vector<std::string>& missing) {
  std::string why;
  if (const Lab* lab = find_lab(&why)) return (lab->*peers)(missing);
  missing.push_back(why);
  return {};
}

// An indented line each.
std::string lines_of(const std::vector<std::string>& found,
                     const std::vector<std::string>& missing) {
  std::string text;
  for (const auto* peers : {&found, &missing})
    for (const std::string& peer : *peers) text += fmt::format("         {}\n", peer);
  return text;
}

int examine(const JsonOnly& options) {
  const auto found = find_program("ffmpeg");
  const std::string ffmpeg = found ? found->string() : "";
  std::vector<std::string> missing, missing_boxes;
  const std::vector<std::string> peers = found_peers(&Lab::engines, missing);
  const std::vector<std::string> boxes = found_peers(&Lab::box_libraries, missing_boxes);
  bool any = false;
  std::string text = fmt::format("Lantern {} ({})\n", kVersion, kSourceHash);
  JsonWriter json = answer_of("doctor");
  json.line().member("version", kVersion).line().key("backends").begin_array();
  for (const BackendReport& r : examine_backends()) {
    any |= r.works;
    text += fmt::format("{:<8} {}\n         {}\n", r.name, r.works ? "works" : "does not work",
                        r.works ? r.library + ", " + r.renderer : r.problem);
    json.line().object("name", r.name, "works", r.works, "library", r.library, "renderer",
                       r.renderer, "problem", r.problem);
  }
  text += fmt::format("{:<8} {}\n", "ffmpeg",
                      found ? printable(ffmpeg) : "not found; only needed to make films (ffmpeg)");
  text += "peers    other engines, only needed to measure beside them\n" + lines_of(peers, missing);
  text += "boxes    other libraries of boxes, only needed by bench pairs\n" +
          lines_of(boxes, missing_boxes);
  json.line().end_array().lines("ffmpeg", ffmpeg, "peers", peers, "missing_peers", missing,
                                "box_peers", boxes, "missing_box_peers", missing_boxes);
  json.line().end_object();
  options.json ? answer(json.text()) : print(text);
  return any ? kGood : kNoBackend;
}

}  // namespace

std::vector<Command> inspecting_commands() {
  return {command("check", "Run scenarios without drawing, verify expectations", check_scenarios,
                  check_options),
          command("list", "List the scenarios in a folder in the order of a lecture",
                  list_scenarios, list_options),
          command("explain", "Run a scenario without pixels, tell what each stage did",
                  explain_scenario, explain_options),
          command("doctor", "Graphics backends found, and what to install", examine, json_only)};
}

}  // namespace lantern::app
