// `solve_by`: another way to solve contacts, from now on.
#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern {

TableDoc SolveBy::table() {
  using namespace keys;
  using S = SolveBy;
  std::vector<std::string_view> methods = contact_method_names();
  std::erase(methods, to_string(ContactMethod::none));
  return {.doc = "From now on, contacts are solved another way; the world must have some.",
          .keys =
              {
                  key(&S::contacts, "contacts", "As [world] has it, but `none`.", must(),
                      one_of(methods)),
                  key(&S::sub_steps, "sub_steps",
                      "How many parts soft contacts divide a world step into.", range(1, 64),
                      or_else("as it was")),
                  key(&S::iterations, "iterations", "Sweeps over the impulses in a world step.",
                      range(1, 1000), or_else("as it was")),
              },
          .example = R"([[step]]
do = "solve_by"
contacts = "impulse"
iterations = 20
)"};
}

void SolveBy::read(const TableReader& table, ScriptReading& script) {
  script.require_contacts(table.place("do"));
}

void SolveBy::change(Engine& engine) const { engine.solve_by(*this); }

}  // namespace lantern
