// What is made of the list of verbs, whatever they are.
#include "scenario/verbs.hpp"

#include <cmath>

#include <fmt/format.h>

#include "scenario/engine.hpp"
#include "scenario/language.hpp"
#include "scenario/script_run.hpp"

namespace lantern::scenario {
namespace {

// The verb's own keys, then those of every step.
template <class V>
TableDoc table_of() {
  TableDoc table = V::table();
  table.name = V::kTraits.name;
  table.heading = fmt::format("do = \"{}\"", table.name);
  const std::vector<KeyDoc>& common = language_table("step").keys;
  table.keys.insert(table.keys.end(), common.begin(), common.end());
  return table;
}

template <class... V>
std::vector<TableDoc> tables_of(const std::variant<V...>*) {
  return {table_of<V>()...};
}

}  // namespace

std::span<const TableDoc> language_verbs() {
  static const std::vector<TableDoc> verbs = tables_of(static_cast<const Verb*>(nullptr));
  return verbs;
}

const std::vector<std::size_t>* entering(const Verb& verb) {
  if (const auto* insert = std::get_if<Insert>(&verb)) return &insert->bodies;
  if (const auto* emit = std::get_if<Emit>(&verb)) return &emit->bodies;
  return nullptr;
}

double seconds_of(const Verb& any, double time_step) {
  const auto seconds = [&]<class V>(const V& verb) {
    if constexpr (V::kTraits.passes_time) return verb.seconds_of(time_step);
    return 0.0;
  };
  return std::visit(seconds, any);
}

void carry_out(const Verb& any, Engine& engine, double time_step) {
  const auto carry = [&]<class V>(const V& verb) {
    if constexpr (V::kTraits.changes_bodies) verb.change(engine);
    if constexpr (V::kTraits.passes_time)
      for (auto n = std::llround(verb.seconds_of(time_step) / time_step); n > 0; --n) engine.step();
  };
  std::visit(carry, any);
}

TableDoc Show::table() {
  return {.doc = "Nothing happens; the caption speaks.", .example = R"([[step]]
do = "show"
caption = "Three bodies, and {pairs:pair} to test."
)"};
}

void Show::act(ScriptRun& run) const { run.frames.settle("show"); }

}  // namespace lantern::scenario
