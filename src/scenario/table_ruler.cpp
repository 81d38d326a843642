// `headline` and [[step.ruler]]: what a frame says in numbers beside its caption.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/key.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/table_side.hpp"

namespace lantern::scenario {
namespace {

// Is it counted or measured there? A measure of one body is noted. What is said of another side is
// checked when that one is read.
bool is_counted(const Named& written, Draft& draft, const ScriptState* state) {
  const std::string_view side = side_of(written.name, draft.sides);
  if (!side.empty() && side != draft.scenario.side) return true;
  const Named number{std::string(within_side(written.name, draft.sides)), written.where};
  if (is_of_body(number.name)) return note_body_measure(number, draft);
  if (!find_count(number.name)) {
    draft.problems.add(number.where,
                       fmt::format("there is no count or measure {}", in_quotes(number.name)),
                       [name = number.name] { return nearest(name, names_of_counts()); });
    return false;
  }
  const std::string why = state ? why_not_counted(number.name, draft, *state) : "";
  if (why.empty()) return true;
  draft.problems.add(number.where, fmt::format("'{}' is not counted here: {}", number.name, why));
  return false;
}

// The body at one end, if it is one.
std::optional<std::size_t> end_of(const TableReader& table, const char* key, Draft& draft) {
  const auto name = table.named(key);
  return name ? one_body(*name, draft) : std::nullopt;
}

// Exactly one of a body and a point.
bool has_one(const TableReader& table, const char* body, const char* point, Draft& draft) {
  if (table.has(body) != table.has(point)) return true;
  draft.problems.add(table.has(body) ? table.key_place(point) : table.where(),
                     fmt::format("a ruler has {} '{}' and '{}'",
                                 table.has(body) ? "only one of" : "one of", body, point),
                     fmt::format("'{}' is a body, '{}' a point of the world", body, point));
  return false;
}

}  // namespace

TableDoc ruler_table() {
  using namespace keys;
  using R = RulerSpec;
  return {"step.ruler",
          "[[step.ruler]]",
          "A length, measured and drawn on every frame of the step, while both its ends are there: "
          "between the centres of two bodies, or points.",
          {key(KeyType::text, "a", "The body at which it begins.", range(1, 64),
               or_else("none: give `from`")),
           key(&R::from, "from", "A point of the world, instead of `a`.", range(-kFar, kFar),
               or_else("none: give `a`")),
           key(KeyType::text, "b", "The body at which it ends.", range(1, 64),
               or_else("none: give `to`")),
           key(&R::to, "to", "A point of the world, instead of `b`.", range(-kFar, kFar),
               or_else("none: give `b`")),
           key(&R::text, "text", "Stands before the length.", range(0, 24)),
           key(&R::change, "change",
               "Says how much longer or shorter it is than when the step began, beside a ghost of "
               "that length.")}};
}

std::vector<std::string> read_headline(const TableReader& table, Draft& draft,
                                       const ScriptState* state) {
  std::vector<std::string> names;
  const std::vector<Named> written = table.names("headline");
  for (const Named& number : written) {
    if (!is_counted(number, draft, state)) continue;
    if (std::ranges::find(names, number.name) != names.end())
      draft.problems.add(number.where,
                         fmt::format("{} stands twice in 'headline'", in_quotes(number.name)));
    names.push_back(number.name);
  }
  if (written.size() > kMostHeadline)
    table.bad_value("headline", fmt::format("{} numbers in a headline, the limit is {}",
                                            written.size(), kMostHeadline));
  return names;
}

std::vector<RulerSpec> read_rulers(const TableReader& step, ScriptReading& script) {
  std::vector<RulerSpec> rulers;
  Draft& draft = script.draft;
  for (const TomlValue* value : step.tables("ruler")) {
    const TableReader table = open(*value, language_table("step.ruler"), draft);
    RulerSpec ruler;
    table.fill(ruler);
    ruler.where = draft.position(value->where);
    has_one(table, "a", "from", draft);
    has_one(table, "b", "to", draft);
    ruler.a = end_of(table, "a", draft);
    ruler.b = end_of(table, "b", draft);
    if (ruler.a && ruler.b && *ruler.a == *ruler.b)
      table.bad_value("b", "a ruler from a body to itself", "name another one");
    rulers.push_back(std::move(ruler));
  }
  return rulers;
}

}  // namespace lantern::scenario
