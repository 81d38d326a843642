#include <fmt/format.h>

#include "app/answer.hpp"
#include "app/commands/command.hpp"
#include "app/course_page.hpp"
#include "app/inputs.hpp"
#include "app/run_scenario.hpp"
#include "app/scenario_folder.hpp"
#include "app/terminal.hpp"
#include "base/json_writer.hpp"

namespace lantern::app {
namespace {

struct ListOptions {
  std::vector<std::string> folders;
  bool course = false, json = false;
};

Options list_options(ListOptions& o) {
  return {{"DIR", &o.folders, "folders or files; the default is scenarios"},
          json_option(o.json),
          {"--course",
           &o.course,
           "run them, and print the course as Markdown: ideas, what comes before, questions "
           "with their answers",
           {.without = "--json"}}};
}

std::vector<std::string> row_of(const Scenario& s) {
  return {s.lecture ? fmt::format("{}", *s.lecture) : "", s.name, s.title, s.idea,
          s.needs.empty() ? "" : fmt::format("after {}", fmt::join(s.needs, ", "))};
}

void add_member(JsonWriter& json, const Scenario& s) {
  json.line().begin_object().members("name", s.name, "title", s.title, "source", s.source, "idea",
                                     s.idea);
  json.key("lecture");
  s.lecture ? json.value(*s.lecture) : json.null();
  json.key("needs").begin_array();
  for (const std::string& name : s.needs) json.value(name);
  json.end_array();
  json.key("questions").begin_array();
  for (const Step& step : s.steps)
    if (!step.question.empty()) json.value(step.question);
  json.end_array();
  json.members("steps", s.steps.size(), "file", s.file);
  json.end_object();
}

int list_scenarios(const ListOptions& options) {
  std::vector<std::string> words = options.folders;
  if (words.empty()) {
    const auto folders = scenario_folders();
    if (folders.empty()) throw UsageError("there is no folder scenarios here: name one");
    if (folders.front() != "scenarios") say(fmt::format("from {}", folders.front().string()));
    words.push_back(folders.front().string());
  }
  if (options.course) return print_course(input_files(words));
  std::vector<std::vector<std::string>> rows;
  JsonWriter json = answer_of("list");
  json.line().key("scenarios").begin_array();
  int code = kGood;
  for (const std::string& file : input_files(words))
    if (const auto scenario = load_or_complain(file, code)) {
      rows.push_back(row_of(*scenario));
      add_member(json, *scenario);
    }
  json.line().end_array().line().end_object();
  options.json ? answer(json.text()) : print(table(rows));
  return code;
}

}  // namespace

Command list_command() {
  return command("list", "List the scenarios in a folder in the order of a lecture", list_scenarios,
                 list_options);
}

}  // namespace lantern::app
