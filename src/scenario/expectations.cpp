#include "scenario/expectations.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "geometry/flat.hpp"

namespace lantern {
namespace {

using NamePair = std::pair<std::string, std::string>;

NamePair ordered(std::string a, std::string b) {
  return a < b ? NamePair{std::move(a), std::move(b)} : NamePair{std::move(b), std::move(a)};
}

const FrameBody* body_named(const Frame& frame, const std::string& name) {
  for (const FrameBody& body : frame.bodies)
    if (body.name == name) return &body;
  return nullptr;
}

std::string listed(const std::set<NamePair>& pairs) {
  if (pairs.empty()) return "none";
  std::string text;
  for (const auto& [a, b] : pairs) text += fmt::format("{}({}, {})", text.empty() ? "" : " ", a, b);
  return text;
}

std::optional<std::string> unmet_count(const Expectation& e, const Frame& frame) {
  const auto found = frame.count(e.name);
  if (found == e.number) return std::nullopt;
  return fmt::format("expected {} = {}, found {}", e.name, e.number,
                     found ? fmt::format("{}", *found) : "none");
}

std::optional<std::string> unmet_leaves(const Expectation& e, const Frame& frame) {
  const FrameBody* body = body_named(frame, e.name);
  if (!body)
    return fmt::format("expected '{}' in {} leaves, but it is not there", e.name, e.number);
  const auto leaves = std::count_if(frame.nodes.begin(), frame.nodes.end(), [&](const auto& node) {
    return node.leaf && std::binary_search(node.bodies.begin(), node.bodies.end(), body->id);
  });
  if (leaves == e.number) return std::nullopt;
  return fmt::format("expected '{}' in {} leaves, found it in {}", e.name, e.number, leaves);
}

std::optional<std::string> unmet_pairs(const Expectation& e, const Frame& frame) {
  std::set<NamePair> expected, found;
  for (const auto& [a, b] : e.pairs) expected.insert(ordered(a, b));
  const auto name_of = [&](BodyId id) {
    return std::lower_bound(frame.bodies.begin(), frame.bodies.end(), id,
                            [](const FrameBody& body, BodyId wanted) { return body.id < wanted; })
        ->name;
  };
  for (const FramePair& p : frame.pairs)
    found.insert(ordered(name_of(p.pair.a), name_of(p.pair.b)));
  if (found == expected) return std::nullopt;
  return fmt::format("expected the pairs {}, found {}", listed(expected), listed(found));
}

std::optional<std::string> unmet_position(const Expectation& e, const Frame& frame) {
  const FrameBody* body = body_named(frame, e.name);
  if (!body) return fmt::format("expected '{}' at a position, but it is not there", e.name);
  const Vec<2> off = flat(body->position) - e.position;
  if (std::abs(off.x) <= e.tolerance && std::abs(off.y) <= e.tolerance) return std::nullopt;
  return fmt::format("expected '{}' at [{}, {}] within {}, found [{}, {}]", e.name, e.position.x,
                     e.position.y, e.tolerance, body->position.x, body->position.y);
}

}  // namespace

std::optional<std::string> unmet(const Expectation& e, const Frame& frame) {
  switch (e.kind) {
    case Expectation::Kind::count:
      return unmet_count(e, frame);
    case Expectation::Kind::leaves:
      return unmet_leaves(e, frame);
    case Expectation::Kind::pairs:
      return unmet_pairs(e, frame);
    case Expectation::Kind::position:
      return unmet_position(e, frame);
  }
  return std::nullopt;
}

}  // namespace lantern
