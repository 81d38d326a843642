// The [problem] of a file: what `lantern measure` holds its runs against.
#include <fmt/format.h>

#include "base/suggest.hpp"
#include "scenario/draft.hpp"
#include "scenario/method.hpp"

namespace lantern {
namespace {

void read_methods(const TableReader& table, ProblemSpec& problem, Draft& draft) {
  for (const Named& method : table.texts("methods")) {
    if (!method_named(method.name))
      draft.problems.add(method.where, fmt::format("there is no method '{}'", method.name),
                         [name = method.name] { return suggestion(name, method_names()); });
    problem.methods.push_back(method.name);
  }
}

}  // namespace

void read_problem(const TableReader& file, Draft& draft) {
  for (const TomlValue* value : file.tables("problem")) {
    const TableReader table = open(*value, language_table("problem"), draft);
    ProblemSpec problem;
    problem.where = draft.position(value->where);
    problem.solution = static_cast<Solution>(table.choice("solution").value_or(0));
    problem.variant = static_cast<ProblemVariant>(table.choice("variant").value_or(0));
    problem.seconds = table.number("seconds").value_or(1);
    problem.samples = static_cast<std::uint32_t>(table.whole("samples").value_or(20));
    problem.step = table.number("step").value_or(1);
    problem.halvings = static_cast<int>(table.whole("halvings").value_or(7));
    read_methods(table, problem, draft);
    if (draft.scenario.bodies.empty())
      draft.problems.add(value->where, "a [problem] needs bodies", "add a [[body]]");
    draft.scenario.problem = std::move(problem);
  }
}

std::string_view to_string(Solution solution) {
  return language_table("problem").find("solution")->choices[static_cast<std::size_t>(solution)];
}

std::string_view to_string(ProblemVariant variant) {
  return language_table("problem").find("variant")->choices[static_cast<std::size_t>(variant)];
}

}  // namespace lantern
