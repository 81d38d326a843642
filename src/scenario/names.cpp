// Names of bodies and textures, and what else patterns of both share.
#include <fmt/format.h>

#include "base/hash.hpp"
#include "scenario/draft.hpp"

namespace lantern::scenario {

bool Names::add(const std::string& name, const NamedRange& range, bool declared,
                Problems& problems) {
  const auto [at, is_new] = ranges_.emplace(name, range);
  if (!is_new)
    problems.add(range.where, fmt::format("the name '{}' is taken", name),
                 fmt::format("line {} has it", at->second.where.line));
  else if (declared)
    declared_.push_back(name);
  return is_new;
}

const NamedRange* Names::find(const std::string& name) const {
  const auto found = ranges_.find(name);
  return found == ranges_.end() ? nullptr : &found->second;
}

bool Draft::has_room_for(std::size_t all, std::size_t most, const char* nouns, Place where) {
  if (all <= most) return true;
  problems.add(where, fmt::format("{} {} in all, the limit is {}", all, nouns, most));
  return false;
}

int cycled_color(std::int64_t color, std::size_t index) {
  return color == 0 ? static_cast<int>(1 + index % 8) : static_cast<int>(color);
}

std::uint64_t derived_seed(const TableReader& table, const std::string& name, const Draft& draft) {
  if (const auto seed = table.get<std::uint64_t>("seed")) return *seed;
  return Hash().add(draft.scenario.seed).add(std::string_view(name)).value();
}

std::optional<std::size_t> one_body(const Named& body, Draft& draft) {
  const NamedRange* range = draft.bodies.find(body.name);
  if (!range) {
    draft.problems.add(
        body.where, fmt::format("there is no body {}", in_quotes(body.name)),
        [&known = draft.bodies, name = body.name] { return nearest(name, known.declared()); });
    return std::nullopt;
  }
  if (range->count == 1) return range->first;
  draft.problems.add(body.where, fmt::format("'{}' is a pattern, not a body", body.name),
                     fmt::format("its bodies are '{0}1' to '{0}{1}'", body.name, range->count));
  return std::nullopt;
}

void note_follower(const TableReader& table, std::size_t count, Draft& draft) {
  if (const auto name = table.named("follow"))
    draft.followers.push_back({draft.scenario.bodies.size(), count, *name});
}

void find_the_followed(Draft& draft) {
  auto& bodies = draft.scenario.bodies;
  for (const Follower& f : draft.followers) {
    const auto followed = one_body(f.followed, draft);
    if (!followed) continue;
    if (f.first <= *followed && *followed < f.first + f.count)
      draft.problems.add(f.followed.where, "a body cannot follow itself",
                         "name another one in 'follow'");
    for (std::size_t i = f.first; i < f.first + f.count; ++i) bodies[i].follows = *followed;
  }
}

}  // namespace lantern::scenario
