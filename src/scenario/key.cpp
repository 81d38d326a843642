#include "scenario/key.hpp"

#include <algorithm>

#include "geometry/angle.hpp"

namespace lantern::scenario {

std::string Filled<double>::literal(double value) {
  std::string text = fmt::format("{:.12g}", value);
  if (const std::size_t zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
  return text;
}

namespace keys {
namespace {

void add(const Note& note, KeyDoc& doc) {
  doc.required |= note.required;
  doc.above_least |= note.above_least;
  doc.least = std::max(doc.least, note.least);
  doc.most = std::min(doc.most, note.most);
  if (!note.fallback.empty()) doc.fallback = note.fallback;
  if (!note.otherwise.empty()) doc.otherwise = note.otherwise;
  if (!note.unit.empty()) doc.unit = note.unit;
  if (note.unit.starts_with("°")) doc.scale = kDegree;
  if (!note.of.empty()) doc.of = note.of;
  if (!note.form.empty()) doc.form = note.form;
  if (!note.advice.empty()) doc.advice = note.advice;
  if (note.pattern) doc.pattern = *note.pattern;
  if (note.choices.empty()) return;
  doc.choices.assign(note.choices.begin(), note.choices.end());
  if (doc.type == KeyType::texts) doc.type = KeyType::choices_list;
}

}  // namespace

Note must() { return {.required = true}; }
Note range(double least, double most) { return {.least = least, .most = most}; }
Note above(double least, double most) {
  return {.above_least = true, .least = least, .most = most};
}
Note at_most(double most) { return {.most = most}; }
Note in(std::string_view unit) { return {.unit = unit}; }
Note like(const NamePattern& pattern) { return {.pattern = &pattern}; }
Note holds(std::string_view table) { return {.of = table}; }
Note written(std::string_view form) { return {.form = form}; }
Note by_default(std::string_view literal) { return {.fallback = literal}; }
Note or_else(std::string_view words) { return {.otherwise = words}; }
Note one_of(std::span<const std::string_view> choices) { return {.choices = choices}; }

Note advising(std::string_view advice) { return {.advice = advice}; }

KeyDoc made(KeyType type, std::string_view name, std::string_view meaning,
            std::initializer_list<Note> notes) {
  KeyDoc doc{.key = name, .type = type, .doc = meaning};
  for (const Note& note : notes) add(note, doc);
  return doc;
}

KeyDoc made(const MemberKind& kind, const std::type_info& owner, std::size_t offset,
            const void* initial, std::string_view name, std::string_view meaning,
            std::initializer_list<Note> notes) {
  KeyDoc doc{.key = name, .type = kind.type, .doc = meaning};
  if (kind.choices) doc.choices = kind.choices();
  for (const Note& note : notes) add(note, doc);
  doc.owner = &owner;
  doc.offset = offset;
  doc.fill = kind.fill;
  if (doc.required || !doc.otherwise.empty()) return doc;
  doc.fallback = kind.literal(initial, doc.scale);
  if (doc.fallback == "\"\"" && doc.least > 0) doc.fallback.clear();  // no text may be empty here
  return doc;
}

}  // namespace keys
}  // namespace lantern::scenario
