#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/json_writer.hpp"
#include "scenario/language.hpp"
#include "scenario/reference.hpp"

namespace lantern {
namespace {

// JSON in the making: each piece is the text of one value.
using Members = std::vector<std::pair<std::string_view, std::string>>;

std::string json_array(const std::vector<std::string>& values) {
  std::string text = "[";
  for (const std::string& value : values) text += (text.size() > 1 ? ", " : "") + value;
  return text + "]";
}

std::string object(const Members& members) {
  std::string text = "{";
  for (const auto& [key, value] : members)
    text += fmt::format("{}{}: {}", text.size() > 1 ? ", " : "", json_string(key), value);
  return text + "}";
}

std::string json_texts(const std::vector<std::string_view>& list) {
  std::vector<std::string> values;
  for (const std::string_view text : list) values.push_back(json_string(text));
  return json_array(values);
}

void add_range(const KeyDoc& doc, Members& members) {
  if (std::isfinite(doc.least))
    members.push_back(
        {doc.above_least ? "exclusiveMinimum" : "minimum", fmt::format("{}", doc.least)});
  if (std::isfinite(doc.most)) members.push_back({"maximum", fmt::format("{}", doc.most)});
}

std::string reference(std::string_view table) {
  return object({{"$ref", json_string(fmt::format("#/$defs/{}", table))}});
}

std::string number_type(const KeyDoc& doc, const char* type) {
  Members members = {{"type", json_string(type)}};
  add_range(doc, members);
  return object(members);
}

Members two(const KeyDoc& doc, const char* type) {
  return {{"type", "\"array\""},
          {"items", number_type(doc, type)},
          {"minItems", "2"},
          {"maxItems", "2"}};
}

// Two numbers in a flat world, three in a solid one: the parser knows which.
Members point_type(const KeyDoc& doc) {
  return {{"type", "\"array\""},
          {"items", number_type(doc, "number")},
          {"minItems", "2"},
          {"maxItems", "3"}};
}

// What a value of the key must be, but for its description and default.
Members value_members(const KeyDoc& doc) {
  Members m;
  switch (doc.type) {
    case KeyType::text:
      m = {{"type", "\"string\""}};
      if (doc.pattern) m.push_back({"pattern", json_string(doc.pattern->expression)});
      if (std::isfinite(doc.least)) m.push_back({"minLength", fmt::format("{}", doc.least)});
      if (std::isfinite(doc.most)) m.push_back({"maxLength", fmt::format("{}", doc.most)});
      return m;
    case KeyType::whole:
    case KeyType::number:
      m = {{"type", doc.type == KeyType::whole ? "\"integer\"" : "\"number\""}};
      add_range(doc, m);
      return m;
    case KeyType::truth:
      return {{"type", "\"boolean\""}};
    case KeyType::choice:
      return {{"enum", json_texts(doc.choices)}};
    case KeyType::point:
      return point_type(doc);
    case KeyType::two_numbers:
      return two(doc, "number");
    case KeyType::size:
      return two(doc, "integer");
    case KeyType::loops:
      return {{"type", "\"array\""},
              {"items", object({{"type", "\"array\""},
                                {"items", object(two(doc, "number"))},
                                {"minItems", "3"}})},
              {"minItems", "1"}};
    case KeyType::whole_or_names:
      return {{"anyOf", json_array({number_type(doc, "integer"),
                                    object({{"type", "\"array\""},
                                            {"items", object({{"type", "\"string\""}})},
                                            {"minItems", "1"}})})}};
    case KeyType::names:
      return {{"type", "\"array\""}, {"items", object({{"type", "\"string\""}})}};
    case KeyType::texts:
      return {
          {"type", "\"array\""}, {"items", object({{"type", "\"string\""}})}, {"minItems", "1"}};
    case KeyType::choices_list:
      return {{"type", "\"array\""},
              {"items", object({{"enum", json_texts(doc.choices)}})},
              {"minItems", "1"},
              {"uniqueItems", "true"}};
    case KeyType::table:
      return {{"$ref", json_string(fmt::format("#/$defs/{}", doc.of))}};
    case KeyType::tables:
      return {{"type", "\"array\""},
              {"items", reference(doc.of)},
              {"maxItems", fmt::format("{}", doc.most)}};
    case KeyType::name_pairs:
      return {{"type", "\"array\""},
              {"items", object({{"type", "\"array\""},
                                {"items", object({{"type", "\"string\""}})},
                                {"minItems", "2"},
                                {"maxItems", "2"}})}};
    case KeyType::name_wholes:
      return {{"type", "\"object\""}, {"additionalProperties", number_type(doc, "integer")}};
    case KeyType::name_numbers:
      return {{"type", "\"object\""}, {"additionalProperties", number_type(doc, "number")}};
    case KeyType::name_points:
      return {{"type", "\"object\""}, {"additionalProperties", object(point_type(doc))}};
  }
  return m;
}

std::string key_schema(const KeyDoc& doc) {
  Members members = value_members(doc);
  members.insert(members.begin(), {"description", json_string(doc.doc)});
  if (!doc.fallback.empty()) members.push_back({"default", std::string(doc.fallback)});
  return object(members);
}

// "Exactly one of these groups of keys", or "at least one".
void add_groups(const KeyGroups& groups, Members& members) {
  if (groups.groups.empty()) return;
  std::vector<std::string> choices;
  for (const auto& group : groups.groups)
    choices.push_back(object({{"required", json_texts(group)}}));
  members.push_back({groups.exactly_one ? "oneOf" : "anyOf", json_array(choices)});
}

Members table_members(const TableDoc& table) {
  Members properties;
  std::vector<std::string_view> required;
  for (const KeyDoc& key : table.keys) {
    const bool is_verb = key.key == "do";
    properties.push_back(
        {key.key, is_verb ? object({{"const", json_string(table.name)}}) : key_schema(key)});
    if (key.required) required.push_back(key.key);
  }
  Members members = {{"description", json_string(table.doc)},
                     {"type", "\"object\""},
                     {"properties", object(properties)},
                     {"additionalProperties", "false"}};
  if (!required.empty()) members.push_back({"required", json_texts(required)});
  add_groups(table.groups, members);
  return members;
}

std::string definitions() {
  std::vector<std::string> verbs;
  for (const TableDoc& verb : language_verbs()) verbs.push_back(object(table_members(verb)));
  Members tables;
  for (const TableDoc& table : language_tables().subspan(1))
    tables.push_back({table.name, table.name == "step" ? object({{"oneOf", json_array(verbs)}})
                                                       : object(table_members(table))});
  return object(tables);
}

// One member or element a line; what fits on a line stays on one.
class Indenter {
 public:
  explicit Indenter(std::string_view json) : json_(json) {}

  std::string text() {
    while (at_ < json_.size()) step();
    return out_ + "\n";
  }

 private:
  // The end of the value that opens at `at_`, behind its bracket.
  std::size_t end() const {
    int depth = 0;
    bool in_text = false;
    for (std::size_t i = at_; i < json_.size(); ++i) {
      const char c = json_[i];
      if (in_text && c == '\\')
        ++i;
      else if (c == '"')
        in_text = !in_text;
      else if (!in_text && (c == '{' || c == '['))
        ++depth;
      else if (!in_text && (c == '}' || c == ']') && --depth == 0)
        return i + 1;
    }
    return json_.size();
  }

  void line(int change) {
    depth_ += change;
    out_ += '\n' + std::string(static_cast<std::size_t>(2 * depth_), ' ');
    start_ = out_.size();
  }

  void copy(std::size_t count) {
    out_ += json_.substr(at_, count);
    at_ += count;
  }

  void step() {
    constexpr std::size_t kWidth = 100;
    const char c = json_[at_];
    if (c == '"') {
      std::size_t close = at_ + 1;
      while (json_[close] != '"') close += json_[close] == '\\' ? 2 : 1;
      copy(close + 1 - at_);
    } else if (c == '{' || c == '[') {
      const std::size_t length = end() - at_;
      if (depth_ > 0 && out_.size() - start_ + length < kWidth) return copy(length);
      copy(1);
      line(+1);
    } else if (c == '}' || c == ']') {
      line(-1);
      copy(1);
    } else if (c == ',') {
      copy(1);
      ++at_;
      line(0);
    } else {
      copy(1);
    }
  }

  std::string_view json_;
  std::string out_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;  // of the current line's own letters
  int depth_ = 0;
};

}  // namespace

std::string json_schema() {
  Members root = {{"$schema", "\"https://json-schema.org/draft/2020-12/schema\""},
                  {"title", "\"Lantern scenario\""}};
  for (auto& member : table_members(language_tables()[0])) root.push_back(std::move(member));
  root.push_back({"$defs", definitions()});
  return Indenter(object(root)).text();
}

}  // namespace lantern
