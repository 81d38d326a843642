// Springs and joints.
#include <fmt/format.h>

#include "scenario/draft.hpp"

namespace lantern {
namespace {

// What all links of one table share.
LinkSpec read_link(const TableReader& table, bool is_spring, Draft& draft) {
  LinkSpec link;
  link.where = draft.position(table.where());
  link.at_a = table.point("at_a").value_or(Vec<3>(0.0));
  link.at_b = table.point("at_b").value_or(Vec<3>(0.0));
  if (is_spring) {
    link.rest_length = table.number("rest_length");
    link.stiffness = table.number("stiffness").value_or(1);
    link.damping = table.number("damping").value_or(0);
    return link;
  }
  link.kind = table.text("kind") == "pin" ? LinkSpec::Kind::pin : LinkSpec::Kind::distance;
  link.rest_length = table.number("length");
  if (table.is_good("length") && link.kind == LinkSpec::Kind::pin)
    draft.problems.add(table.key_place("length"), "a pin has no 'length'",
                       "take kind = \"distance\"");
  return link;
}

bool has_room_for(std::size_t count, Place where, Draft& draft) {
  const std::size_t all = draft.scenario.links.size() + count;
  if (all <= kMostLinks) return true;
  draft.problems.add(where,
                     fmt::format("{} springs and joints in all, the limit is {}", all, kMostLinks));
  return false;
}

std::optional<std::size_t> body_of(const TableReader& table, const char* key, Draft& draft) {
  const auto name = table.text(key);
  return name ? one_body({*name, table.place(key)}, draft) : std::nullopt;
}

bool is_dynamic(std::size_t body, const Draft& draft) {
  return draft.scenario.bodies[body].kind == BodyKind::dynamic_body;
}

// Each method would need the other's state within the step.
void check_integrators(std::size_t a, std::size_t b, const TableReader& table, Draft& draft) {
  const ScenarioSpec& s = draft.scenario;
  const auto of = [&](std::size_t i) {
    return s.bodies[i].integrator.value_or(s.world.integrator);
  };
  if (is_dynamic(a, draft) && is_dynamic(b, draft) && of(a) != of(b))
    draft.problems.add(
        table.place("b"),
        fmt::format("a spring between '{}', moved by {}, and '{}', moved by {}", s.bodies[a].name,
                    to_string(of(a)), s.bodies[b].name, to_string(of(b))),
        "give both the same integrator");
}

// Between `a` and `b`, or `a` and a point of the world.
void read_pair(const TableReader& table, LinkSpec link, Draft& draft) {
  const bool has_b = table.has("b"), has_to = table.has("to");
  if (has_b == has_to)
    draft.problems.add(
        has_b ? table.key_place("to") : table.where(),
        has_b ? "a link ends at 'b' or at 'to', not at both" : "a link needs an other end",
        "give one of 'b', a body, and 'to', a point of the world");
  if (has_to && table.is_good("at_b"))
    draft.problems.add(table.key_place("at_b"), "'at_b' is of 'b'",
                       "'to' is the point of the world itself");
  const auto a = body_of(table, "a", draft), b = body_of(table, "b", draft);
  if (has_to) link.at_b = table.point("to").value_or(Vec<3>(0.0));
  if (!a || (has_b && !b)) return;
  link.a = *a;
  link.b = b;
  if (b && *a == *b)
    draft.problems.add(table.place("b"), "a body cannot be tied to itself", "name another one");
  else if (!is_dynamic(*a, draft) && !(b && is_dynamic(*b, draft)))
    draft.problems.add(table.place("a"), "it ties nothing that it could move",
                       "one of the ends must be a dynamic body");
  else if (b && link.kind == LinkSpec::Kind::spring)
    check_integrators(*a, *b, table, draft);
  if (has_room_for(1, table.where(), draft)) draft.scenario.links.push_back(std::move(link));
}

// Each member of a pattern to the next.
void read_chain(const TableReader& table, const LinkSpec& like, Draft& draft) {
  for (const char* key : {"b", "to"})
    if (table.is_good(key))
      draft.problems.add(table.key_place(key),
                         fmt::format("'{}' goes with 'a', not with 'along'", key),
                         "'along' ties the members of a pattern to each other");
  const auto name = table.text("along");
  if (!name) return;
  const NamedRange* range = draft.bodies.find(*name);
  if (!range) {
    one_body({*name, table.place("along")}, draft);  // says what is wrong
    return;
  }
  if (range->count < 2) {
    draft.problems.add(table.place("along"),
                       fmt::format("'{}' has only one body, nothing to tie it to", *name),
                       "'along' takes a pattern of at least two");
    return;
  }
  if (!is_dynamic(range->first, draft))
    draft.problems.add(table.place("along"), "it ties nothing that it could move",
                       "the pattern's bodies must be dynamic");
  if (!has_room_for(range->count - 1, table.where(), draft)) return;
  for (std::size_t i = 0; i + 1 < range->count; ++i) {
    LinkSpec link = like;
    link.a = range->first + i;
    link.b = link.a + 1;
    draft.scenario.links.push_back(std::move(link));
  }
}

void read_tables(const TableReader& file, const char* key, bool is_spring, Draft& draft) {
  for (const TomlValue* value : file.tables(key)) {
    const TableReader table = open(*value, language_table(key), draft);
    const LinkSpec link = read_link(table, is_spring, draft);
    if (table.has("along"))
      read_chain(table, link, draft);
    else if (table.has("a"))
      read_pair(table, link, draft);
  }
}

}  // namespace

void read_links(const TableReader& file, Draft& draft) {
  read_tables(file, "spring", true, draft);
  read_tables(file, "joint", false, draft);
}

}  // namespace lantern
