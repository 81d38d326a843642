#include "language/keys/table_reader.hpp"

#include <fmt/format.h>

#include "base/suggest.hpp"

namespace lantern::language {
namespace {

bool is_verb(const TableDoc& table) { return !table.example.empty(); }

// Where a key that is unknown here would be at home; empty if nowhere.
std::string home_of(std::string_view key, const TableDoc& here) {
  const KeyDoc* top = language_tables()[0].find(key);
  if (top && top->type != KeyType::table && top->type != KeyType::tables)
    return fmt::format("'{}' belongs at the top of the file, before the first [table]", key);
  for (const TableDoc& other : is_verb(here) ? language_verbs() : language_tables().subspan(1))
    if (other.name != here.name && other.find(key))
      return fmt::format("'{}' belongs to {}", key, other.heading);
  return {};
}

}  // namespace

TableReader::TableReader(const TomlTable& table, Place where, const TableDoc& doc,
                         Problems& problems, int dimension, std::string_view called)
    : table_(table),
      where_(where),
      doc_(doc),
      problems_(problems),
      dimension_(dimension),
      called_(called.empty() ? doc.heading : called) {
  for (const TomlEntry& e : table_) {
    const KeyDoc* key = doc_.find(e.key);
    if (key && check_value(e.value, *key, dimension_, problems_)) continue;
    if (!key) check_unknown(e);
    bad_.insert(e.key);
  }
  check_missing();
  check_groups();
}

void TableReader::check_unknown(const TomlEntry& e) {
  const std::string in = doc_.name.empty() ? "" : " in " + called_;
  problems_.add(e.where, fmt::format("unknown key {}{}", in_quotes(e.key), in),
                [&key = e.key, &here = doc_] {
                  const std::vector<std::string_view> known = mapped(here.keys, &KeyDoc::key);
                  const std::string one =  // "bodies" of [[body]]
                      key.ends_with("ies") ? key.substr(0, key.size() - 3) + "y" : key;
                  const auto near = nearest_name(one, known);
                  const std::string home = home_of(key, here);
                  // Few slip at a word's first letter: what has a home elsewhere belongs there.
                  if (near && (home.empty() || near->front() == one.front()))
                    return nearest(one, known);
                  return home.empty() ? nearest(key, known) : home;
                });
}

void TableReader::check_missing() {
  for (const KeyDoc& key : doc_.keys) {
    if (!key.required || has(key.key)) continue;
    const std::string owner = doc_.name.empty() ? "the scenario" : called_;
    problems_.add(where_, fmt::format("{} has no '{}'", owner, key.key),
                  "add " + form_of(key, dimension_));
  }
}

void TableReader::check_groups() {
  std::string wanted;
  std::size_t given = 0;
  for (const auto& group : doc_.groups.groups) {
    std::string keys;
    const TomlEntry* first = nullptr;
    for (const std::string_view key : group) {
      keys += fmt::format("{}'{}'", keys.empty() ? "" : " and ", key);
      if (!first) first = entry(key);
    }
    wanted += (wanted.empty() ? "" : " or ") + keys;
    if (!first) continue;
    for (const std::string_view key : group)
      if (!has(key))
        problems_.add(first->where,
                      fmt::format("{} has '{}' but no '{}'", called_, first->key, key),
                      fmt::format("{} go together", keys));
    if (++given == 2 && doc_.groups.exactly_one)
      problems_.add(first->where,
                    fmt::format("{} has '{}', too: give {}", called_, first->key, wanted),
                    "one of them is enough");
  }
  if (given == 0 && !doc_.groups.groups.empty())
    problems_.add(where_, fmt::format("{} has no {}", called_, wanted),
                  doc_.groups.exactly_one ? "give one of them" : "give at least one of them");
}

void TableReader::fill(const std::type_info& owner, void* object) const {
  for (const KeyDoc& key : doc_.keys)
    if (key.owner && *key.owner == owner)
      if (const TomlValue* value = good(key.key))
        key.fill(*value, key, static_cast<char*>(object) + key.offset);
}

const TomlEntry* TableReader::entry(std::string_view key) const { return entry_of(table_, key); }

const TomlValue* TableReader::good(std::string_view key) const {
  const TomlEntry* e = entry(key);
  return e && !bad_.contains(key) ? &e->value : nullptr;
}

Place TableReader::place(std::string_view key) const {
  const TomlEntry* e = entry(key);
  return e ? e->value.where : where_;
}

Place TableReader::key_place(std::string_view key) const {
  const TomlEntry* e = entry(key);
  return e ? e->where : where_;
}

bool TableReader::is_list(std::string_view key) const {
  const TomlValue* value = good(key);
  return value && std::holds_alternative<TomlArray>(value->data);
}

std::vector<const TomlValue*> TableReader::tables(std::string_view key) const {
  const TomlValue* value = good(key);
  if (!value) return {};
  if (!is_list(key)) return {value};
  return mapped(std::get<TomlArray>(value->data),
                [](const TomlValue& element) { return &element; });
}

}  // namespace lantern::language
