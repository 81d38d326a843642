// `sleep` and `wake`.
#include <fmt/format.h>

#include "scenario/language_parts.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/script_run.hpp"

namespace lantern {
namespace {

std::vector<std::size_t> read_sleepers(const TableReader& table, std::string_view verb,
                                       ScriptReading& script) {
  const std::vector<Named> written = table.names("bodies");
  for (const Named& named : written) {
    const NamedRange* range = script.draft.bodies.find(named.name);
    if (range && script.draft.scenario.bodies[range->first].kind != BodyKind::dynamic_body)
      script.draft.problems.add(named.where,
                                fmt::format("'{}' is not dynamic: it cannot {}", named.name, verb),
                                "only dynamic bodies sleep and wake");
  }
  script.require_sleep(table.place("do"));
  return script.bodies.present(written);
}

}  // namespace

TableDoc Sleep::table() {
  return {.doc = "Bodies fall asleep: nothing moves them until something wakes them.",
          .keys = {bodies_key()},
          .example = R"([[step]]
do = "sleep"
bodies = ["red"]
expect = { asleep = ["red"] }
)"};
}

void Sleep::read(const TableReader& table, ScriptReading& script) {
  bodies = read_sleepers(table, "sleep", script);
}

void Sleep::change(Engine& engine) const {
  for (const std::size_t body : bodies) engine.sleep(body);
}

TableDoc Wake::table() {
  return {.doc = "Bodies wake up.", .keys = {bodies_key()}, .example = R"([[step]]
do = "wake"
bodies = ["red"]
expect = { awake = ["red"] }
)"};
}

void Wake::read(const TableReader& table, ScriptReading& script) {
  bodies = read_sleepers(table, "wake", script);
}

void Wake::change(Engine& engine) const {
  for (const std::size_t body : bodies) engine.wake(body);
}

}  // namespace lantern
