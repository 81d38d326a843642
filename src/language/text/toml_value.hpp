// Values of a file, already checked against their keys, as values of C++.
#pragma once

#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "geometry/vec.hpp"
#include "language/specs.hpp"
#include "language/text/toml_tree.hpp"

namespace lantern::language {

// A name with the place where it is written.
struct Named {
  std::string name;
  Place where;
};

inline void assign(const TomlValue& value, std::string& to) {
  to = std::get<std::string>(value.data);
}
inline void assign(const TomlValue& value, Named& to) {
  to = {std::get<std::string>(value.data), value.where};
}
inline void assign(const TomlValue& value, bool& to) { to = std::get<bool>(value.data); }

inline void assign(const TomlValue& value, double& to) {
  const auto* whole = std::get_if<std::int64_t>(&value.data);
  to = whole ? static_cast<double>(*whole) : std::get<double>(value.data);
}

template <std::integral I>
void assign(const TomlValue& value, I& to) {
  to = static_cast<I>(std::get<std::int64_t>(value.data));
}

template <class E>
requires std::is_enum_v<E>
void assign(const TomlValue& value, E& to) {
  const EnumNames all = names(to);
  to = static_cast<E>(std::ranges::find(all, std::get<std::string>(value.data)) - all.begin());
}

// What is not written is 0.
template <int D>
void assign(const TomlValue& value, Vec<D>& to) {
  to = Vec<D>(0.0);
  int axis = 0;
  for (const TomlValue& element : std::get<TomlArray>(value.data)) assign(element, to[axis++]);
}

template <class T>
void assign(const TomlValue& value, std::optional<T>& to) {
  assign(value, to.emplace());
}

template <class T>
void assign(const TomlValue& value, std::pair<T, T>& to) {
  const auto& list = std::get<TomlArray>(value.data);
  assign(list[0], to.first);
  assign(list[1], to.second);
}

template <class T>
void assign(const TomlValue& value, std::vector<T>& to) {
  to.clear();
  for (const TomlValue& element : std::get<TomlArray>(value.data))
    assign(element, to.emplace_back());
}

// How far or how fast something turns, in the file's unit, and about what, if that is said.
struct Turn {
  double amount = 0;
  std::optional<Vec<3>> axis;
};

inline void assign(const TomlValue& value, Turn& to) {
  const auto* table = std::get_if<TomlTable>(&value.data);
  if (!table) return assign(value, to.amount);
  for (const TomlEntry& entry : *table)
    entry.key == "axis" ? assign(entry.value, to.axis) : assign(entry.value, to.amount);
}

// Calls f(name, value) for each entry of a table from names to values; those of a table in the
// table, as `energy.bob = 1` makes it, have the names of both.
template <class F>
void for_each_named(const TomlTable& table, F&& f, const std::string& before = {}) {
  for (const TomlEntry& entry : table) {
    const Named name{before + entry.key, entry.where};
    if (const auto* inner = std::get_if<TomlTable>(&entry.value.data))
      for_each_named(*inner, f, name.name + ".");
    else
      f(name, entry.value);
  }
}

// A table from names to values.
template <class T>
void assign(const TomlValue& value,
            std::vector<std::pair<Named, T>>& to) requires(!std::same_as<T, Named>) {
  for_each_named(std::get<TomlTable>(value.data), [&](const Named& name, const TomlValue& written) {
    to.push_back({name, {}});
    assign(written, to.back().second);
  });
}

}  // namespace lantern::language
