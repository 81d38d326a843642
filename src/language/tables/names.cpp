// Names of bodies and textures, what else patterns of both share, and [[prototype]]s: named keys.
#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "base/hash.hpp"
#include "language/keys/key.hpp"
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

// Of each of these, a body has one: its own stands against a prototype's.
constexpr std::array<std::array<std::string_view, 4>, 7> kRivals = {{
    {"radius", "half_size", "capsule", "ground"},
    {"density", "mass"},
    {"kind", "static"},
    {"follow", "wander"},
    {"turned", "heading"},
    {"look", "outline"},
    {"color", "paint"},
}};

bool stands_against(const TomlTable& own, std::string_view key) {
  if (entry_of(own, key)) return true;
  for (const auto& rivals : kRivals)
    if (std::ranges::find(rivals, key) != rivals.end())
      return std::ranges::any_of(
          rivals, [&](std::string_view rival) { return !rival.empty() && entry_of(own, rival); });
  return false;
}

// Those of a prototype that is like nobody, so that no other mistake follows.
TomlTable any_shape(const TomlTable& own, Place where) {
  for (const std::string_view shape : kRivals[0])
    if (entry_of(own, shape)) return {};
  return {{"radius", where, {where, 1.0}}};
}

// Follows who is like whom.
class Chains {
 public:
  Chains(std::span<const TomlValue* const> tables, Draft& draft) : draft_(draft) {
    for (const TomlValue* value : tables) {
      const TomlTable& table = std::get<TomlTable>(value->data);
      if (const std::string* name = value_of<std::string>(table, "name"))
        tables_.emplace(*name, &table);
    }
  }

  void read() {
    for (const auto& [name, table] : tables_) keys_of(name);
  }

 private:
  // All keys of the prototype, with those of whom it is like.
  const TomlTable& keys_of(const std::string& name) {
    if (const TomlTable* done = draft_.prototypes.find(name)) return *done;
    TomlTable keys;
    for (const TomlEntry& e : *tables_.at(name))
      if (e.key != "name" && e.key != "like" && language_table("prototype").find(e.key))
        keys.push_back(e);  // one that is unknown has been told
    const TomlEntry* like = entry_of(*tables_.at(name), "like");
    const std::string* other = value_of<std::string>(*tables_.at(name), "like");
    open_.push_back(name);
    if (other && is_good(*other, like->value.where))
      keys = with_prototype(std::move(keys), keys_of(*other));
    else if (other)
      keys = with_prototype(keys, any_shape(keys, like->value.where));
    open_.pop_back();
    draft_.prototypes.add(name, std::move(keys));
    return *draft_.prototypes.find(name);
  }

  // Is there such a prototype, and does nothing go round in a circle?
  bool is_good(const std::string& other, Place where) {
    if (!tables_.contains(other)) {
      std::vector<std::string_view> known;
      for (const auto& [name, table] : tables_)
        known.push_back(*value_of<std::string>(*table, "name"));
      draft_.problems.add_unknown(where, "prototype", other, [known] { return known; });
      return false;
    }
    auto at = std::ranges::find(open_, other);
    if (at == open_.end()) return true;
    std::string way;
    for (; at != open_.end(); ++at) way += fmt::format("'{}' is like ", *at);
    draft_.problems.add(where, fmt::format("a circle: {}'{}'", way, other),
                        "one of them must stand on its own");
    return false;
  }

  Draft& draft_;
  std::map<std::string, const TomlTable*> tables_;
  std::vector<std::string> open_;  // from the first that was asked for to the one at hand
};

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

const TomlTable* Prototypes::find(const std::string& name) const {
  const auto found = keys_.find(name);
  return found == keys_.end() ? nullptr : &found->second;
}

std::vector<std::string_view> Prototypes::names() const {
  return mapped(keys_, [](const auto& entry) { return std::string_view(entry.first); });
}

TableDoc prototype_table() {
  TableDoc table = {"prototype", "[[prototype]]",
                    "Keys that bodies share: whoever is `like` it has them, too, and its own keys "
                    "win. A prototype may be like another one."};
  table.keys = body_table().keys;
  for (KeyDoc& doc : table.keys) {
    doc.required = false;
    doc.owner = nullptr;
    doc.fallback = {};
    doc.otherwise = {};
    if (doc.key == "name") {
      doc.doc = "Unique over prototypes.";
      doc.required = true;
    }
    if (doc.key == "color") {
      doc.doc = "As a body's; 0 lets a pattern or map cycle through 1 to 8.";
      doc.least = 0;
    }
  }
  return table;
}

void read_prototypes(const TableReader& file, Draft& draft) {
  std::vector<const TomlValue*> tables;
  Names names;
  for (const TomlValue* value : file.tables("prototype")) {
    const TableReader table = open(*value, language_table("prototype"), draft);
    const auto name = table.named("name");
    if (name && names.add(name->name, {0, 1, name->where}, true, draft.problems))
      tables.push_back(value);
  }
  Chains(tables, draft).read();
}

TomlTable with_prototype(TomlTable own, const TomlTable& prototype) {
  const TomlTable before = own;
  for (const TomlEntry& e : prototype)
    if (!stands_against(before, e.key)) own.push_back(e);
  return own;
}

const TomlValue& completed(const TomlValue& value, Draft& draft) {
  const TomlTable& own = std::get<TomlTable>(value.data);
  const std::string* like = value_of<std::string>(own, "like");
  if (!like) return value;
  const Place where = entry_of(own, "like")->value.where;
  const TomlTable* keys = draft.prototypes.find(*like);
  if (!keys)
    draft.problems.add_unknown(where, "prototype", *like,
                               [&known = draft.prototypes] { return known.names(); });
  const TomlTable stand_in = keys ? TomlTable{} : any_shape(own, where);
  draft.made.push_back({value.where, with_prototype(own, keys ? *keys : stand_in)});
  return draft.made.back();
}

}  // namespace lantern::language
