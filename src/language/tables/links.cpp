// [[spring]] and [[joint]].
#include <fmt/format.h>

#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

// What both have.
std::vector<KeyDoc> link_keys(std::vector<KeyDoc> own) {
  std::vector<KeyDoc> keys = {
      key(KeyType::text, "a", "A body.", range(1, 64)),
      key(KeyType::text, "b", "The other body.", range(1, 64), or_else("none: give `to`")),
      key(KeyType::point, "to", "A point of the world, instead of `b`.", range(-kFar, kFar),
          or_else("none: give `b`")),
      key(KeyType::text, "along", "A pattern, instead of `a`: each member is tied to the next.",
          range(1, 64)),
      key(&LinkSpec::at_a, "at_a",
          "Where it is fixed, from the centre of `a`, in the body's own axes.", range(-kFar, kFar),
          or_else("the centre")),
      key(&LinkSpec::at_b, "at_b", "The same for `b`.", range(-kFar, kFar), or_else("the centre")),
  };
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

bool has_room(std::size_t count, Place where, Draft& draft) {
  return draft.has_room_for(draft.scenario.links.size() + count, kMostLinks, "springs and joints",
                            where);
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
    table.bad_value(
        "b",
        fmt::format("a spring between '{}', moved by {}, and '{}', moved by {}", s.bodies[a].name,
                    to_string(of(a)), s.bodies[b].name, to_string(of(b))),
        "give both the same integrator");
}

void check_forces(const TableReader& table, const LinkSpec& link,
                  std::initializer_list<std::optional<std::size_t>> ends, const Draft& draft) {
  const bool is_spring = link.kind == LinkSpec::Kind::spring;
  for (const auto& end : ends)
    if (end && is_dynamic(*end, draft) &&
        check_knows(
            table, is_spring ? "damping" : "kind",
            draft.scenario.bodies[*end].integrator.value_or(draft.scenario.world.integrator),
            !is_spring || link.damping > 0, is_spring ? "damping" : "joints"))
      return;
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
    table.bad_key("at_b", "'at_b' is of 'b'", "'to' is the point of the world itself");
  const auto a = body_at(table, "a", draft), b = body_at(table, "b", draft);
  if (has_to) link.at_b = table.get<Vec<3>>("to").value_or(Vec<3>(0.0));
  if (!a || (has_b && !b)) return;
  check_forces(table, link, {a, b}, draft);
  link.a = *a;
  link.b = b;
  if (b && *a == *b)
    table.bad_value("b", "a body cannot be tied to itself", "name another one");
  else if (!is_dynamic(*a, draft) && !(b && is_dynamic(*b, draft)))
    table.bad_value("a", "it ties nothing that it could move",
                    "one of the ends must be a dynamic body");
  else if (b && link.kind == LinkSpec::Kind::spring)
    check_integrators(*a, *b, table, draft);
  if (has_room(1, table.where(), draft)) draft.scenario.links.push_back(std::move(link));
}

// Each member of a pattern to the next.
void read_chain(const TableReader& table, const LinkSpec& like, Draft& draft) {
  for (const char* key : {"b", "to"})
    if (table.is_good(key))
      table.bad_key(key, fmt::format("'{}' goes with 'a', not with 'along'", key),
                    "'along' ties the members of a pattern to each other");
  const auto name = table.named("along");
  if (!name) return;
  const NamedRange* range = draft.bodies.find(name->name);
  if (!range) {
    one_body(*name, draft);  // says what is wrong
    return;
  }
  if (range->count < 2) {
    table.bad_value("along",
                    fmt::format("'{}' has only one body, nothing to tie it to", name->name),
                    "'along' takes a pattern of at least two");
    return;
  }
  if (!is_dynamic(range->first, draft))
    table.bad_value("along", "it ties nothing that it could move",
                    "the pattern's bodies must be dynamic");
  check_forces(table, like, {range->first}, draft);
  if (!has_room(range->count - 1, table.where(), draft)) return;
  for (std::size_t i = 0; i + 1 < range->count; ++i) {
    LinkSpec link = like;
    link.a = range->first + i;
    link.b = link.a + 1;
    draft.scenario.links.push_back(std::move(link));
  }
}

void read_link(const TableReader& table, const LinkSpec& link, Draft& draft) {
  if (table.is_good("length") && link.kind == LinkSpec::Kind::pin)
    table.bad_key("length", "a pin has no 'length'", "take kind = \"distance\"");
  if (table.has("along"))
    read_chain(table, link, draft);
  else if (table.has("a"))
    read_pair(table, link, draft);
}

}  // namespace

TableDoc spring_table() {
  using L = LinkSpec;
  TableDoc table = {"spring", "[[spring]]",
                    "A damped spring between two bodies, or a body and a point of the world. It is "
                    "there while its bodies are."};
  table.keys = link_keys({
      key(&L::rest_length, "rest_length", "Where it neither pulls nor pushes.", range(0, kFar),
          or_else("as long as it is at first")),
      key(&L::stiffness, "stiffness", "Force for each unit that it is longer.", must(),
          above(0, kHeavy), in("N/unit")),
      key(&L::damping, "damping", "Force against each unit a second that it grows.",
          range(0, kHeavy), in("N s/unit")),
  });
  table.groups = {{{"a"}, {"along"}}};
  return table;
}

TableDoc joint_table() {
  using L = LinkSpec;
  TableDoc table = {
      "joint", "[[joint]]",
      "Keeps two points at one distance, or pins them together. It is there while its bodies are."};
  table.keys = link_keys({
      key(&L::kind, "kind", "A rod of fixed length, or a hinge.", must(),
          one_of({"distance", "pin"})),
      key(&L::rest_length, "length", "Of kind `distance`.", above(0, kFar),
          or_else("as long as it is at first")),
  });
  table.groups = {{{"a"}, {"along"}}};
  return table;
}

void read_links(const TableReader& file, Draft& draft) {
  for (const std::string_view kind : {"spring", "joint"})
    for_each<LinkSpec>(file, kind, draft, [&](const TableReader& table, const LinkSpec& link) {
      read_link(table, link, draft);
    });
}

}  // namespace lantern::language
