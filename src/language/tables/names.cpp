// Names of bodies and textures, and what else patterns of both share.
#include <fmt/format.h>

#include "base/hash.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {

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

namespace {

// "b12" is "b" and 12; the number is empty if there is none.
struct Numbered {
  std::string_view stem;
  std::string_view number;
};

Numbered numbered(std::string_view name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  const std::size_t at = end == name.npos ? 0 : end + 1;
  return {name.substr(0, at), name.substr(at)};
}

constexpr std::string_view kDots = "..";

// What is wrong with a range, and how to mend it; empty if nothing is.
struct Fault {
  std::string message;
  std::string hint;
};

Fault fault_of(const Named& range, const Numbered& first, const Numbered& last) {
  constexpr std::size_t kMostDigits = 9;
  const std::string written = in_quotes(range.name);
  if (first.number.empty() || last.number.empty())
    return {fmt::format("the range {} needs a number at both ends", written), "as 'dot2..dot9'"};
  if (first.stem != last.stem)
    return {fmt::format("the range {} begins with '{}' and ends with '{}'", written, first.stem,
                        last.stem),
            "both ends have the same name before their numbers"};
  if (first.number.size() > kMostDigits || last.number.size() > kMostDigits)
    return {fmt::format("the range {} is too long", written), {}};
  if (std::stoul(std::string(first.number)) > std::stoul(std::string(last.number)))
    return {fmt::format("the range {} runs backwards", written),
            fmt::format("write '{0}{1}..{0}{2}'", first.stem, last.number, first.number)};
  return {};
}

// Its names, up to the first that is unknown, which is told.
void unroll_range(const Named& range, const Names& names, std::string_view kind, Problems& problems,
                  std::vector<Named>& found) {
  const std::size_t dots = range.name.find(kDots);
  const std::string_view name = range.name;
  const Numbered first = numbered(name.substr(0, dots));
  const Numbered last = numbered(name.substr(dots + kDots.size()));
  if (Fault fault = fault_of(range, first, last); !fault.message.empty())
    return problems.add(range.where, std::move(fault.message), std::move(fault.hint));
  const std::size_t width = first.number.starts_with('0') ? first.number.size() : 1;
  const std::size_t end = std::stoul(std::string(last.number));
  for (std::size_t i = std::stoul(std::string(first.number)); i <= end; ++i) {
    std::string one = fmt::format("{}{:0{}}", first.stem, i, width);
    if (!names.find(one))
      return problems.add(range.where,
                          fmt::format("there is no {} {} in the range {}", kind, in_quotes(one),
                                      in_quotes(range.name)),
                          [&names, one] { return nearest(one, names.declared()); });
    found.push_back({std::move(one), range.where});
  }
}

}  // namespace

std::vector<Named> without_ranges(const std::vector<Named>& written, const Names& names,
                                  std::string_view kind, Problems& problems) {
  std::vector<Named> found;
  for (const Named& name : written)
    if (name.name.find(kDots) != name.name.npos)
      unroll_range(name, names, kind, problems, found);
    else
      found.push_back(name);
  return found;
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
    draft.problems.add_unknown(body.where, "body", body.name,
                               [&known = draft.bodies] { return known.declared(); });
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

}  // namespace lantern::language
