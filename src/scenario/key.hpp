// One row of the language's tables, written as a sentence: what it fills, its name and meaning,
// then what else holds. A key that is bound to a member takes its type and its default from it.
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "geometry/angle.hpp"
#include "scenario/language.hpp"
#include "scenario/toml_value.hpp"

namespace lantern {

inline constexpr NamePattern kFilePattern = {"a-z0-9_", "a-z0-9_", 64, "1 to 64 of a–z, 0–9 and _"};
inline constexpr NamePattern kNamePattern = {
    "A-Za-z", "A-Za-z0-9_ -", 24, "a letter, then up to 23 letters, digits, spaces, _ and -"};
inline constexpr NamePattern kEventPattern = {"a-z", "a-z0-9_", 64,
                                              "a small letter, then a–z, 0–9 and _"};

// Coordinates, sizes and speeds: far from where doubles lose whole units.
inline constexpr double kFar = 1e9;
inline constexpr double kMostPixels = 16384;
inline constexpr double kMostAtlas = 8192;    // the largest image that can be drawn
inline constexpr double kMostWhole = 0x1p53;  // above it, doubles skip whole numbers
inline constexpr double kMostEvery = 1000;    // world steps from frame to frame
inline constexpr double kMostTurn = 1e6;      // degrees, and degrees a second
inline constexpr double kHeavy = 1e12;        // masses, densities, stiffness and drag
inline constexpr double kHundredYears = 4e9;  // seconds

// The type of key that fills such a member, and the member's default as TOML writes it.
template <class M>
struct Filled {
  static constexpr KeyType type = std::is_enum_v<M> ? KeyType::choice : KeyType::whole;
  static std::string literal(const M& value) {
    if constexpr (std::is_enum_v<M>)
      return fmt::format("\"{}\"", names(value)[static_cast<std::size_t>(value)]);
    else
      return fmt::format("{}", value);
  }
};
template <KeyType kType>
struct FilledWithoutDefault {
  static constexpr KeyType type = kType;
  static std::string literal(const auto&) { return {}; }
};
template <>
struct Filled<bool> {
  static constexpr KeyType type = KeyType::truth;
  static std::string literal(bool value) { return value ? "true" : "false"; }
};
template <>
struct Filled<double> {
  static constexpr KeyType type = KeyType::number;
  static std::string literal(double value) {
    std::string text = fmt::format("{:.12g}", value);
    if (const std::size_t zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
    return text;
  }
};
template <>
struct Filled<std::string> {
  static constexpr KeyType type = KeyType::text;
  static std::string literal(const std::string& value) { return fmt::format("\"{}\"", value); }
};
template <int D>
struct Filled<Vec<D>> : FilledWithoutDefault<D == 2 ? KeyType::two_numbers : KeyType::point> {};
template <>
struct Filled<std::vector<std::vector<Vec<2>>>> : FilledWithoutDefault<KeyType::loops> {};
template <>
struct Filled<std::vector<std::string>> : FilledWithoutDefault<KeyType::texts> {};
template <class E>
struct Filled<std::vector<E>> : FilledWithoutDefault<KeyType::choices_list> {};
template <class T>
struct Filled<std::optional<T>> : FilledWithoutDefault<Filled<T>::type> {};

// What may stand behind a key's meaning.
namespace keys {

inline auto must() {
  return [](KeyDoc& doc) { doc.required = true; };
}
inline auto range(double least, double most) {
  return [=](KeyDoc& doc) { doc.least = least, doc.most = most; };
}
inline auto above(double least, double most) {
  return [=](KeyDoc& doc) { doc.least = least, doc.most = most, doc.above_least = true; };
}
inline auto at_most(double most) {
  return [=](KeyDoc& doc) { doc.most = most; };
}
// The member of a key in degrees is in radians.
inline auto in(std::string_view unit) {
  return [=](KeyDoc& doc) {
    doc.unit = unit;
    if (unit.starts_with("°")) doc.scale = kDegree;
  };
}
inline auto like(const NamePattern& pattern) {
  return [=](KeyDoc& doc) { doc.pattern = pattern; };
}
inline auto holds(std::string_view table) {
  return [=](KeyDoc& doc) { doc.of = table; };
}
inline auto written(std::string_view form) {
  return [=](KeyDoc& doc) { doc.form = form; };
}
// Of a key that is bound to nothing.
inline auto by_default(std::string_view literal) {
  return [=](KeyDoc& doc) { doc.fallback = literal; };
}
inline auto or_else(std::string_view words) {
  return [=](KeyDoc& doc) { doc.otherwise = words; };
}
// Only these, in this order.
inline auto one_of(std::vector<std::string_view> choices) {
  return [choices = std::move(choices)](KeyDoc& doc) {
    if (doc.type == KeyType::texts) doc.type = KeyType::choices_list;
    doc.choices = choices;
  };
}

// Read by the reader of its table.
template <class... More>
KeyDoc key(KeyType type, std::string_view name, std::string_view meaning, const More&... more) {
  KeyDoc doc{.key = name, .type = type, .doc = meaning};
  (more(doc), ...);
  return doc;
}

template <class M>
struct ChoiceOf {
  using type = M;
};
template <class E>
struct ChoiceOf<std::optional<E>> : ChoiceOf<E> {};
template <class E>
struct ChoiceOf<std::vector<E>> : ChoiceOf<E> {};

// Fills the member of a T.
template <class T, class M, class... More>
KeyDoc key(M T::*member, std::string_view name, std::string_view meaning, const More&... more) {
  KeyDoc doc{.key = name, .type = Filled<M>::type, .doc = meaning};
  if constexpr (Filled<M>::type == KeyType::choice || Filled<M>::type == KeyType::choices_list)
    doc.choices = names(typename ChoiceOf<M>::type());
  (more(doc), ...);
  doc.owner = &typeid(T);
  doc.fill = [member](const TomlValue& value, const KeyDoc& filled, void* object) {
    M& to = static_cast<T*>(object)->*member;
    assign(value, to);
    if constexpr (std::is_same_v<M, double>) to *= filled.scale;
    if constexpr (std::is_same_v<M, std::optional<double>>) *to *= filled.scale;
  };
  if (doc.required || !doc.otherwise.empty()) return doc;
  M value = T{}.*member;
  if constexpr (std::is_same_v<M, double>) value /= doc.scale;
  doc.fallback = Filled<M>::literal(value);
  if (doc.fallback == "\"\"" && doc.least > 0) doc.fallback.clear();  // no text may be empty here
  return doc;
}

}  // namespace keys

using keys::key;

}  // namespace lantern
