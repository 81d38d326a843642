#include "scenario/table_reader.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/suggest.hpp"
#include "scenario/value_check.hpp"

namespace lantern {
namespace {

double number_of(const TomlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data))
    return static_cast<double>(*whole);
  return std::get<double>(value.data);
}

Vec<2> two_of(const TomlValue& value) {
  const auto& list = std::get<TomlArray>(value.data);
  return {number_of(list[0]), number_of(list[1])};
}

Vec<3> point_of(const TomlValue& value) {
  const auto& list = std::get<TomlArray>(value.data);
  Vec<3> point(0.0);
  for (std::size_t i = 0; i < list.size(); ++i) point[static_cast<int>(i)] = number_of(list[i]);
  return point;
}

Named named(const TomlValue& value) { return {std::get<std::string>(value.data), value.where}; }

template <class T>
std::optional<T> parsed(std::string_view literal) {
  T value{};
  if (literal.empty()) return std::nullopt;
  std::from_chars(literal.data(), literal.data() + literal.size(), value);
  return value;
}

std::string_view unquoted(std::string_view literal) {
  return literal.substr(1, literal.size() - 2);
}

bool is_verb(const TableDoc& table) {
  const auto verbs = language_verbs();
  return &table >= verbs.data() && &table < verbs.data() + verbs.size();
}

// Where a key that is unknown here would be at home; empty if nowhere.
std::string home_of(std::string_view key, const TableDoc& here) {
  const KeyDoc* top = language_tables()[0].find(key);
  if (top && top->type != KeyType::table && top->type != KeyType::tables)
    return fmt::format("'{}' belongs at the top of the file, before the first [table]", key);
  for (const TableDoc& other : is_verb(here) ? language_verbs() : language_tables().subspan(1))
    if (&other != &here && other.find(key))
      return fmt::format("'{}' belongs to {}", key, other.heading);
  return {};
}

// "position = [1.5, 2]": how a key is written.
std::string form_of(const KeyDoc& key, int dimension) {
  switch (key.type) {
    case KeyType::whole:
      return fmt::format("{} = {}", key.key, std::max(key.least, 1.0));
    case KeyType::number:
      return fmt::format("{} = 1.5", key.key);
    case KeyType::truth:
      return fmt::format("{} = true", key.key);
    case KeyType::choice:
      return fmt::format("{} = \"{}\"", key.key, key.choices.back());
    case KeyType::point:
      return fmt::format("{} = {}", key.key, dimension == 3 ? "[1.5, 2, 0.5]" : "[1.5, 2]");
    case KeyType::two_numbers:
      return fmt::format("{} = [0.5, 1]", key.key);
    case KeyType::loops:
      return fmt::format("{} = [[[0, 0], [8, 0], [8, 6]]]", key.key);
    case KeyType::size:
      return fmt::format("{} = [64, 32]", key.key);
    case KeyType::texts:
      return fmt::format("{} = [\"…\"]", key.key);
    case KeyType::tables:
      return fmt::format("a [[{}]]", key.of);
    default:
      return fmt::format("{} = \"…\"", key.key);
  }
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
    if (!key)
      check_unknown(e);
    else if (!check_value(e.value, *key, dimension_, problems_))
      bad_.insert(e.key);
  }
  check_missing();
  check_groups();
}

void TableReader::check_unknown(const TomlEntry& e) {
  const std::string in = doc_.name.empty() ? "" : " in " + called_;
  problems_.add(e.where, fmt::format("unknown key {}{}", in_quotes(e.key), in),
                [&key = e.key, &here = doc_] {
                  std::vector<std::string_view> known;
                  for (const KeyDoc& k : here.keys) known.push_back(k.key);
                  if (nearest_name(key, known)) return nearest(key, known);
                  const std::string home = home_of(key, here);
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

const TomlEntry* TableReader::entry(std::string_view key) const {
  const auto found =
      std::find_if(table_.begin(), table_.end(), [&](const TomlEntry& e) { return e.key == key; });
  return found == table_.end() ? nullptr : &*found;
}

const TomlValue* TableReader::good(std::string_view key) const {
  const TomlEntry* e = entry(key);
  return e && !bad_.contains(key) ? &e->value : nullptr;
}

const KeyDoc& TableReader::doc(std::string_view key) const {
  const KeyDoc* found = doc_.find(key);
  LANTERN_CHECK(found == nullptr, ==, false);
  return *found;
}

Place TableReader::place(std::string_view key) const {
  const TomlEntry* e = entry(key);
  return e ? e->value.where : where_;
}

Place TableReader::key_place(std::string_view key) const {
  const TomlEntry* e = entry(key);
  return e ? e->where : where_;
}

std::optional<std::string> TableReader::text(std::string_view key) const {
  if (const TomlValue* value = good(key)) return std::get<std::string>(value->data);
  const std::string_view fallback = doc(key).fallback;
  if (fallback.empty()) return std::nullopt;
  return std::string(unquoted(fallback));
}

std::optional<std::int64_t> TableReader::whole(std::string_view key) const {
  if (const TomlValue* value = good(key)) return std::get<std::int64_t>(value->data);
  return parsed<std::int64_t>(doc(key).fallback);
}

std::optional<double> TableReader::number(std::string_view key) const {
  if (const TomlValue* value = good(key)) return number_of(*value);
  return parsed<double>(doc(key).fallback);
}

std::optional<Vec<3>> TableReader::point(std::string_view key) const {
  if (const TomlValue* value = good(key)) return point_of(*value);
  return std::nullopt;
}

std::optional<Vec<2>> TableReader::two(std::string_view key) const {
  if (const TomlValue* value = good(key)) return two_of(*value);
  return std::nullopt;
}

std::vector<std::vector<Vec<2>>> TableReader::loops(std::string_view key) const {
  std::vector<std::vector<Vec<2>>> found;
  if (const TomlValue* value = good(key))
    for (const TomlValue& loop : std::get<TomlArray>(value->data)) {
      found.emplace_back();
      for (const TomlValue& corner : std::get<TomlArray>(loop.data))
        found.back().push_back(two_of(corner));
    }
  return found;
}

bool TableReader::is_list(std::string_view key) const {
  const TomlValue* value = good(key);
  return value && std::holds_alternative<TomlArray>(value->data);
}

bool TableReader::truth(std::string_view key) const {
  if (const TomlValue* value = good(key)) return std::get<bool>(value->data);
  return doc(key).fallback == "true";
}

std::vector<Named> TableReader::texts(std::string_view key) const {
  std::vector<Named> found;
  if (const TomlValue* value = good(key))
    for (const TomlValue& element : std::get<TomlArray>(value->data))
      found.push_back(named(element));
  return found;
}

std::optional<std::size_t> TableReader::choice(std::string_view key) const {
  const std::optional<std::string> chosen = text(key);
  if (!chosen) return std::nullopt;
  const auto& choices = doc(key).choices;
  return static_cast<std::size_t>(std::find(choices.begin(), choices.end(), *chosen) -
                                  choices.begin());
}

std::vector<std::size_t> TableReader::choices(std::string_view key) const {
  const auto& choices = doc(key).choices;
  std::vector<std::size_t> found;
  for (const Named& chosen : texts(key))
    found.push_back(static_cast<std::size_t>(
        std::find(choices.begin(), choices.end(), chosen.name) - choices.begin()));
  return found;
}

std::vector<const TomlValue*> TableReader::tables(std::string_view key) const {
  const TomlValue* value = good(key);
  if (!value) return {};
  if (!std::holds_alternative<TomlArray>(value->data)) return {value};
  std::vector<const TomlValue*> found;
  for (const TomlValue& element : std::get<TomlArray>(value->data)) found.push_back(&element);
  return found;
}

std::vector<std::pair<Named, std::int64_t>> TableReader::name_wholes(std::string_view key) const {
  std::vector<std::pair<Named, std::int64_t>> found;
  if (const TomlValue* value = good(key))
    for (const TomlEntry& e : std::get<TomlTable>(value->data))
      found.push_back({{e.key, e.where}, std::get<std::int64_t>(e.value.data)});
  return found;
}

std::vector<std::pair<Named, double>> TableReader::name_numbers(std::string_view key) const {
  std::vector<std::pair<Named, double>> found;
  if (const TomlValue* value = good(key))
    for (const TomlEntry& e : std::get<TomlTable>(value->data))
      found.push_back({{e.key, e.where}, number_of(e.value)});
  return found;
}

std::vector<std::pair<Named, Vec<3>>> TableReader::name_points(std::string_view key) const {
  std::vector<std::pair<Named, Vec<3>>> found;
  if (const TomlValue* value = good(key))
    for (const TomlEntry& e : std::get<TomlTable>(value->data))
      found.push_back({{e.key, e.where}, point_of(e.value)});
  return found;
}

std::vector<std::pair<Named, Named>> TableReader::name_pairs(std::string_view key) const {
  std::vector<std::pair<Named, Named>> found;
  if (const TomlValue* value = good(key))
    for (const TomlValue& element : std::get<TomlArray>(value->data)) {
      const auto& pair = std::get<TomlArray>(element.data);
      found.push_back({named(pair[0]), named(pair[1])});
    }
  return found;
}

}  // namespace lantern
