// [problem]: a scenario whose answer is known, which `lantern measure` holds its runs against.
#include <fmt/format.h>

#include "base/suggest.hpp"
#include "scenario/draft.hpp"
#include "scenario/key.hpp"
#include "scenario/method.hpp"

namespace lantern::scenario {

TableDoc problem_table() {
  using namespace keys;
  using P = ProblemSpec;
  TableDoc table = {
      "problem", "[problem]",
      "A question whose answer is known, so that `lantern measure` can tell each method's error. "
      "All bodies of the file are there from the start. Without this table a scenario is measured "
      "against its own run at a much finer step."};
  table.keys = {
      key(&P::solution, "solution",
          "What the answer is computed by. It takes masses, positions, speeds and springs from "
          "the scenario.",
          must()),
      key(&P::variant, "variant", "Which of its family it is."),
      key(&P::seconds, "seconds", "How long it is run.", must(), above(0, 1e9), in("s")),
      key(&P::samples, "samples", "Moments at which it is sampled, equally far apart.",
          range(1, 100'000)),
      key(&P::step, "step", "The largest time step. It is cut so that each sample is met.", must(),
          above(0, 1e9), in("s")),
      key(&P::halvings, "halvings", "Of the step: one more run each.", range(0, 24)),
      key(&P::methods, "methods",
          "Ways to move it: an integrator, `splitting_2`, `splitting_4`, "
          "`explicit_gyroscopic`, `soft:16` (sub-steps), `soft:0.001` (wanted error) or "
          "`impulse:100` (sweeps).",
          or_else("all that make a difference")),
  };
  return table;
}

void read_problem(const TableReader& file, Draft& draft) {
  for (const TomlValue* value : file.tables("problem")) {
    const TableReader table = open(*value, language_table("problem"), draft);
    ProblemSpec problem;
    table.fill(problem);
    problem.where = draft.position(value->where);
    for (const Named& method : table.names("methods"))
      if (!method_named(method.name))
        draft.problems.add(method.where, fmt::format("there is no method '{}'", method.name),
                           [name = method.name] { return suggestion(name, method_names()); });
    if (draft.scenario.bodies.empty())
      draft.problems.add(value->where, "a [problem] needs bodies", "add a [[body]]");
    draft.scenario.problem = std::move(problem);
  }
}

}  // namespace lantern::scenario
