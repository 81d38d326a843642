#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "language/language.hpp"
#include "language/reference.hpp"
#include "language/sides.hpp"

namespace lantern::language {
namespace {

using Json = nlohmann::ordered_json;

// Whole numbers without a point.
Json json_number(double x) {
  if (std::trunc(x) == x && std::abs(x) <= 0x1p53) return static_cast<std::int64_t>(x);
  return x;
}

Json typed(const char* type) { return Json::object({{"type", type}}); }

// A number, of the key's range.
Json number_schema(const KeyDoc& doc, const char* type) {
  Json schema = typed(type);
  if (std::isfinite(doc.least))
    schema[doc.above_least ? "exclusiveMinimum" : "minimum"] = json_number(doc.least);
  if (std::isfinite(doc.most)) schema["maximum"] = json_number(doc.most);
  return schema;
}

constexpr std::size_t kNoLimit = 0;

Json list_of(Json items, std::size_t least, std::size_t most = kNoLimit) {
  Json schema = typed("array");
  schema["items"] = std::move(items);
  if (least > 0) schema["minItems"] = least;
  if (most != kNoLimit) schema["maxItems"] = most;
  return schema;
}

Json names_to(Json values) {
  Json schema = typed("object");
  schema["additionalProperties"] = std::move(values);
  return schema;
}

Json part_schema(std::string_view table);

Json reference(std::string_view table) {
  return Json::object({{"$ref", fmt::format("#/$defs/{}", table)}});
}

Json text_schema(const KeyDoc& doc) {
  Json schema = typed("string");
  if (doc.pattern) schema["pattern"] = doc.pattern->expression();
  if (std::isfinite(doc.least)) schema["minLength"] = json_number(doc.least);
  if (std::isfinite(doc.most)) schema["maxLength"] = json_number(doc.most);
  return schema;
}

// What a value of the key must be.
Json value_schema(const KeyDoc& doc) {
  const Json choices = Json::object({{"enum", doc.choices}});
  // Two numbers in a 2D world, three in a 3D one: the parser knows which.
  const Json point = list_of(number_schema(doc, "number"), 2, 3);
  switch (doc.type) {
    case KeyType::text:
      return text_schema(doc);
    case KeyType::whole:
      return number_schema(doc, "integer");
    case KeyType::number:
      return number_schema(doc, "number");
    case KeyType::truth:
      return typed("boolean");
    case KeyType::choice:
      return choices;
    case KeyType::point:
      return point;
    case KeyType::two_numbers:
      return list_of(number_schema(doc, "number"), 2, 2);
    case KeyType::size:
      return list_of(number_schema(doc, "integer"), 2, 2);
    case KeyType::loops:
      return list_of(list_of(list_of(number_schema(doc, "number"), 2, 2), 3), 1);
    case KeyType::whole_or_names:
      return Json::object(
          {{"anyOf", Json::array({number_schema(doc, "integer"), list_of(typed("string"), 1)})}});
    case KeyType::names:
      return list_of(typed("string"), 0);
    case KeyType::texts:
      return list_of(typed("string"), 1);
    case KeyType::choices_list: {
      Json schema = list_of(choices, 1);
      schema["uniqueItems"] = true;
      return schema;
    }
    case KeyType::lines:
      return typed("string");
    case KeyType::turn: {
      Json turn = typed("object");
      turn["properties"] = {{doc.of, number_schema(doc, "number")},
                            {"axis", list_of(typed("number"), 2, 3)}};
      turn["required"] = Json::array({doc.of});
      turn["additionalProperties"] = false;
      return Json::object({{"anyOf", Json::array({number_schema(doc, "number"), turn})}});
    }
    case KeyType::table:
      return reference(doc.of);
    case KeyType::tables:
      return list_of(reference(doc.of), 0, static_cast<std::size_t>(doc.most));
    case KeyType::part:
      return part_schema(doc.of);
    case KeyType::name_pairs:
      return list_of(list_of(typed("string"), 2, 2), 0);
    case KeyType::name_wholes:
      return names_to(number_schema(doc, "integer"));
    case KeyType::name_numbers: {  // energy.bob, without quotes, is a table in the table
      const Json number = number_schema(doc, "number");
      return names_to(Json::object({{"anyOf", Json::array({number, names_to(number)})}}));
    }
    case KeyType::name_points:
      return names_to(point);
    case KeyType::name_texts:
      return names_to(typed("string"));
  }
  return {};
}

Json key_schema(const KeyDoc& doc) {
  Json schema = Json::object({{"description", doc.doc}});
  schema.update(value_schema(doc));
  if (!doc.fallback.empty()) schema["default"] = Json::parse(doc.fallback);
  return schema;
}

Json table_schema(const TableDoc& table) {
  Json properties = Json::object(), required = Json::array(), groups = Json::array();
  for (const KeyDoc& key : table.keys) {
    properties[std::string(key.key)] =
        key.key == "do" ? Json::object({{"const", table.name}}) : key_schema(key);
    if (key.required) required.push_back(key.key);
  }
  for (const auto& group : table.groups.groups)
    groups.push_back(Json::object({{"required", group}}));
  Json schema = Json::object({{"description", table.doc},
                              {"type", "object"},
                              {"properties", properties},
                              {"additionalProperties", false}});
  if (table.by_side) schema["additionalProperties"] = reference(table.name);
  Json all = Json::object();
  if (!required.empty()) all["required"] = required;
  if (!groups.empty()) all[table.groups.exactly_one ? "oneOf" : "anyOf"] = groups;
  // Who is like a prototype may have the rest from it.
  if (table.find("like") && !all.empty())
    schema["anyOf"] =
        Json::array({Json::object({{"required", Json::array({"name", "like"})}}), all});
  else
    schema.update(all);
  return schema;
}

// Any of the keys that a side may override; what is not there is as in the file.
Json part_schema(std::string_view name) {
  Json properties = Json::object();
  for (const KeyDoc& key : language_table(name).keys)
    if (may_differ(name, key.key)) properties[std::string(key.key)] = value_schema(key);
  return Json::object(
      {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}});
}

}  // namespace

std::string json_schema() {
  Json root = Json::object(
      {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Lantern scenario"}});
  root.update(table_schema(language_tables()[0]));
  Json verbs = Json::array();
  for (const TableDoc& verb : language_verbs()) verbs.push_back(table_schema(verb));
  for (const TableDoc& table : language_tables().subspan(1))
    root["$defs"][std::string(table.name)] =
        table.name == "step" ? Json::object({{"oneOf", verbs}}) : table_schema(table);
  return root.dump(2) + "\n";
}

}  // namespace lantern::language
