// [[prototype]]: keys that bodies, patterns and the letters of a map share.
#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "scenario/draft.hpp"
#include "scenario/key.hpp"

namespace lantern::scenario {
namespace {

const std::string* text_of(const TomlTable& table, std::string_view key) {
  const TomlEntry* entry = entry_of(table, key);
  return entry ? std::get_if<std::string>(&entry->value.data) : nullptr;
}

// Of each of these, a body has one: its own stands against a prototype's.
constexpr std::array<std::array<std::string_view, 4>, 5> kRivals = {{
    {"radius", "half_size", "capsule", "ground"},
    {"density", "mass"},
    {"kind", "static"},
    {"follow", "wander"},
    {"turned", "heading"},
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
      if (const std::string* name = text_of(table, "name")) tables_.emplace(*name, &table);
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
    const std::string* other = text_of(*tables_.at(name), "like");
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
      for (const auto& [name, table] : tables_) known.push_back(name);
      draft_.problems.add(where, fmt::format("there is no prototype {}", in_quotes(other)),
                          nearest(other, known));
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

const TomlTable* Prototypes::find(const std::string& name) const {
  const auto found = keys_.find(name);
  return found == keys_.end() ? nullptr : &found->second;
}

std::vector<std::string_view> Prototypes::names() const {
  std::vector<std::string_view> all;
  for (const auto& [name, keys] : keys_) all.push_back(name);
  return all;
}

TableDoc prototype_table() {
  using namespace keys;
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
  const std::string* like = text_of(own, "like");
  if (!like) return value;
  const Place where = entry_of(own, "like")->value.where;
  const TomlTable* keys = draft.prototypes.find(*like);
  if (!keys)
    draft.problems.add(where, fmt::format("there is no prototype {}", in_quotes(*like)),
                       nearest(*like, draft.prototypes.names()));
  const TomlTable stand_in = keys ? TomlTable{} : any_shape(own, where);
  draft.made.push_back({value.where, with_prototype(own, keys ? *keys : stand_in)});
  return draft.made.back();
}

}  // namespace lantern::scenario
