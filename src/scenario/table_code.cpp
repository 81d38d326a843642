// `code` of a step: a function of the lecture's own source, and the line that the step is about.
#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "scenario/code_text.hpp"
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"

namespace lantern::scenario {

namespace {

// As it would be written: with its class if the name has one.
std::string nearest_function(const std::string& name) {
  const bool with_class = name.find("::") != name.npos;
  const std::vector<std::string> functions = code_functions();
  std::vector<std::string_view> known;
  for (const std::string_view function : functions) {
    const std::string_view own = function.substr(with_class ? 0 : function.rfind(':') + 1);
    if (std::ranges::count(known, own) == 0) known.push_back(own);
  }
  return nearest(name, known);
}

}  // namespace

TableDoc code_table() {
  using namespace keys;
  return {"code",
          "code",
          "Which function of the lecture's own source the panel `code` shows from this step on, "
          "and which of its lines the step is about. Without it the panel goes on with the "
          "function of the step before. In event pace a `lecture_quadtree` lights the line that it "
          "is in by itself, as do the phases of a step with `contacts = \"lecture\"`.",
          {key(&CodeSpec::function, "function",
               "Its name, with its class or without: \"QuadTreeNode::Insert\", \"Insert\".", must(),
               range(1, 80)),
           key(&CodeSpec::line, "line",
               "A text; each line of the function that has it is lit. It must be in one.",
               range(0, 80), or_else("none is lit"))}};
}

void read_code(const TableReader& step, Step& to, Draft& draft) {
  for (const TomlValue* value : step.tables("code")) {
    const TableReader table = open(*value, language_table("code"), draft, "'code'");
    CodeSpec spec;
    table.fill(spec);
    spec.where = draft.position(value->where);
    to.code = spec;
    if (!shows(draft.scenario.panels, "code"))
      draft.problems.add(value->where, "no panel shows 'code'",
                         "name it: panels = [\"world\", \"tree\", \"code\"]");
    if (!table.is_good("function")) continue;
    std::optional<FrameCode> code = code_of(spec.function);
    if (!code) {
      table.bad_value("function",
                      fmt::format("the lecture's source has no function {} of several lines",
                                  in_quotes(spec.function)),
                      [name = spec.function] { return nearest_function(name); });
      continue;
    }
    if (!spec.line.empty() && light_line(*code, spec.line) == 0) {
      std::vector<std::string_view> lines;
      for (const FrameCode::Line& line : code->lines) lines.push_back(line.text);
      table.bad_value("line",
                      fmt::format("no line of '{}' has {}", code->function, in_quotes(spec.line)),
                      nearest(spec.line, lines));
    }
  }
}

}  // namespace lantern::scenario
