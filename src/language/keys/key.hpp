// One row of the language's tables, written as a sentence: what it fills, its name and meaning,
// then what else holds. A key that is bound to a member takes its type and its default from it.
#pragma once

#include <concepts>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include <fmt/format.h>

#include "language/keys/table_reader.hpp"

namespace lantern::language {

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
  static std::string literal(double value);
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

template <class M>
struct ChoiceOf {
  using type = M;
};
template <class E>
struct ChoiceOf<std::optional<E>> : ChoiceOf<E> {};
template <class E>
struct ChoiceOf<std::vector<E>> : ChoiceOf<E> {};

// What a member is to its key, the same for all members of one type.
struct MemberKind {
  KeyType type;
  EnumNames (*choices)();  // null if there are none
  void (*fill)(const TomlValue& value, const KeyDoc& key, void* member);
  std::string (*literal)(const void* member, double scale);
};

template <class M>
inline constexpr MemberKind kMemberKind = {
    Filled<M>::type,
    [] {
      if constexpr (Filled<M>::type == KeyType::choice || Filled<M>::type == KeyType::choices_list)
        return +[] { return names(typename ChoiceOf<M>::type()); };
      else
        return static_cast<EnumNames (*)()>(nullptr);
    }(),
    [](const TomlValue& value, const KeyDoc& key, void* member) {
      M& to = *static_cast<M*>(member);
      if constexpr (std::is_same_v<M, bool>)  // or the second of two choices
        if (key.type == KeyType::choice) {
          to = std::get<std::string>(value.data) == key.choices.at(1);
          return;
        }
      assign(value, to);
      if constexpr (std::is_same_v<M, double>) to *= key.scale;
      if constexpr (std::is_same_v<M, std::optional<double>>) *to *= key.scale;
    },
    [](const void* member, double scale) {
      M value = *static_cast<const M*>(member);
      if constexpr (std::is_same_v<M, double>) value /= scale;
      return Filled<M>::literal(value);
    }};

// What may stand behind a key's meaning. There are some two hundred keys: what is made for each is
// plain values, so that a table compiles fast. The words that a note refers to must outlive the
// statement it stands in.
struct Note {  // of KeyDoc's members, those that it sets
  bool required = false;
  bool above_least = false, may_be_empty = false;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  std::string_view fallback = {}, otherwise = {}, unit = {}, of = {}, form = {};
  const NamePattern* pattern = nullptr;
  std::span<const std::string_view> choices = {};
  std::string_view advice = {};
  ByHand by_hand = {};
};

inline Note must() { return {.required = true}; }
inline Note range(double least, double most) { return {.least = least, .most = most}; }
inline Note above(double least, double most) {
  return {.above_least = true, .least = least, .most = most};
}
inline Note empty_or_at_most(double most) { return {.may_be_empty = true, .most = most}; }
inline Note at_most(double most) { return {.most = most}; }
// The member of a key in degrees is in radians.
inline Note in(std::string_view unit) { return {.unit = unit}; }
inline Note like(const NamePattern& pattern) { return {.pattern = &pattern}; }
inline Note holds(std::string_view table) { return {.of = table}; }
inline Note written(std::string_view form) { return {.form = form}; }
// Of a key that is bound to nothing.
inline Note by_default(std::string_view literal) { return {.fallback = literal}; }
inline Note or_else(std::string_view words) { return {.otherwise = words}; }
// Only these, in this order.
inline Note one_of(std::span<const std::string_view> choices) { return {.choices = choices}; }
inline Note one_of(std::initializer_list<std::string_view> choices) {
  return one_of(std::span(choices.begin(), choices.size()));
}
// To who chooses something that is not there.
inline Note advising(std::string_view advice) { return {.advice = advice}; }

// A hand may turn it, a number between these ends; what is idle or refused in a scene is not there.
inline Note by_hand(double least = 0, double most = 0) { return {.by_hand = {true, least, most}}; }
inline Note by_hand_in_world(double least, double most) {
  return {.by_hand = {true, least, most, true}};
}

// Read by the reader of its table.
KeyDoc made(KeyType type, std::string_view name, std::string_view meaning,
            std::initializer_list<Note> notes);
// Fills a member, `offset` bytes into an object of type `owner`, that is `initial` at first.
KeyDoc made(const MemberKind& kind, const std::type_info& owner, std::size_t offset,
            const void* initial, std::string_view name, std::string_view meaning,
            std::initializer_list<Note> notes);

template <std::same_as<Note>... Notes>
KeyDoc key(KeyType type, std::string_view name, std::string_view meaning, const Notes&... notes) {
  return made(type, name, meaning, {notes...});
}

// One of each kind, as it is before anything is read.
template <class T>
const T& blank() {
  static const T object{};
  return object;
}

// Fills the member of a B; or of a T that is a B, too, and has other defaults: key<T>(&B::member,
// …).
template <class Of = void, class M, class B, std::same_as<Note>... Notes>
KeyDoc key(M B::*member, std::string_view name, std::string_view meaning, const Notes&... notes) {
  using T = std::conditional_t<std::is_void_v<Of>, B, Of>;
  const void* initial = &(blank<T>().*member);
  const auto offset = static_cast<std::size_t>(static_cast<const char*>(initial) -
                                               reinterpret_cast<const char*>(&blank<T>()));
  return made(kMemberKind<M>, typeid(T), offset, initial, name, meaning, {notes...});
}

// The parts that the language's list of tables is put together from, each in a file of its own.
TableDoc world_table(), structure_table(), planes_table(), body_table(), pattern_table(),
    prototype_table(), map_table(), spring_table(), joint_table(), level_table(), chart_table(),
    problem_table(), atlas_table(), texture_table(), texture_pattern_table(), element_table(),
    side_table(), expect_table(), display_table(), view_table(), camera_table(), note_table(),
    ruler_table(), code_table();
KeyDoc note_key();  // of a step

// Those of a table for a body or a pattern: `own` and what both have.
std::vector<KeyDoc> body_keys(std::vector<KeyDoc> own);

// The keys that several verbs have.
KeyDoc body_key();  // read by the verb, as is "bodies"
KeyDoc bodies_key();
KeyDoc pace_key();  // of a verb that can be watched while it works, as is "events"
KeyDoc events_key(std::initializer_list<std::string_view> names);

}  // namespace lantern::language
