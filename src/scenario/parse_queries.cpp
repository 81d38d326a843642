// Verbs that ask: rays, views and regions; and those of a level.

#include <fmt/format.h>

#include "geometry/angle.hpp"
#include "scenario/script.hpp"

namespace lantern {
namespace {

// A ray and a view need a direction.
void check_apart(const TableReader& table, const char* from, const char* to, Draft& draft) {
  const auto a = table.point(from), b = table.point(to);
  if (a && b && *a == *b)
    draft.problems.add(table.place(to), fmt::format("'{}' and '{}' are the same point", from, to),
                       "it goes nowhere");
}

CastRay read_ray(const TableReader& table, Draft& draft) {
  check_apart(table, "from", "to", draft);
  return {table.point("from").value_or(Vec<3>(0.0)), table.point("to").value_or(Vec<3>(1, 0, 0)),
          table.text("hits") == "all"};
}

Cull read_cull(const TableReader& table, Draft& draft) {
  check_apart(table, "eye", "target", draft);
  Cull cull;
  cull.eye = table.point("eye").value_or(Vec<3>(0.0));
  cull.target = table.point("target").value_or(Vec<3>(1, 0, 0));
  cull.angle = table.number("angle").value_or(60) * kDegree;
  cull.near = table.number("near").value_or(cull.near);
  cull.far = table.number("far").value_or(cull.far);
  const bool good =
      (table.number("near") || !table.has("near")) && (table.number("far") || !table.has("far"));
  if (good && cull.far <= cull.near)
    draft.problems.add(table.place(table.has("far") ? "far" : "near"),
                       fmt::format("it sees from {} to {}: that is nothing", cull.near, cull.far),
                       "'far' is greater than 'near'");
  return cull;
}

Query read_query(const TableReader& table, Draft& draft) {
  Query query;
  if (const auto center = table.point("center")) {
    query.radius = table.number("radius").value_or(1);
    Vec<3> half(query.radius);
    if (draft.dimension != 3) half.z = 0;
    query.box = Box<3>::around(*center, half);
  }
  const auto min = table.point("min"), max = table.point("max");
  if (!min || !max) return query;
  query.box = {*min, *max};
  if (!is_valid(query.box))
    draft.problems.add(table.place("max"), "the box has no inside",
                       "'max' lies to the upper right of 'min'");
  return query;
}

void require_structure(const TableReader& table, std::string_view verb, Scope& scope) {
  if (scope.state.structure.kind == StructureKind::none)
    scope.draft.problems.add(
        table.place("do"),
        fmt::format("there is no structure at this step: nothing for '{}'", verb),
        "kind = \"brute_force\" tests every body");
  scope.state.queried = true;
}

void require_compiled(const TableReader& table, std::string_view verb, const Scope& scope) {
  if (!scope.state.compiled)
    scope.draft.problems.add(table.place("do"), fmt::format("'{}' needs the compiled level", verb),
                             "add a step with do = \"compile\" before");
}

}  // namespace

std::optional<Verb> read_query_verb(const TableReader& table, std::string_view verb, Scope& scope) {
  if (verb == "ray" || verb == "cull" || verb == "query") require_structure(table, verb, scope);
  if (verb == "ray") return read_ray(table, scope.draft);
  if (verb == "cull") return read_cull(table, scope.draft);
  if (verb == "query") return read_query(table, scope.draft);
  if (verb == "compile") {
    scope.state.compiled = true;
    return CompileLevel{};
  }
  if (verb == "locate") {
    require_compiled(table, verb, scope);
    scope.state.located = true;
    return Locate{table.two("point").value_or(Vec<2>(0.0))};
  }
  if (verb != "order") return std::nullopt;
  require_compiled(table, verb, scope);
  return OrderFrom{table.two("eye").value_or(Vec<2>(0.0))};
}

}  // namespace lantern
