// One table of a scenario file, read against its table of the language, and its values as values of
// C++.
#pragma once

#include <algorithm>
#include <concepts>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "geometry/vec.hpp"
#include "language/language.hpp"
#include "language/specs.hpp"

namespace lantern::language {

// A name with the place where it is written.
struct Named {
  std::string name;
  Place where;
};

// assign(value, to): what is written there, already checked against its key.
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

// Does one value fit its key? Adds a problem for each thing that is wrong with it; true if there
// was none. What is in a table of its own (KeyType::table and tables) is left to that table's
// reader. `dimension` is the world's, 0 where it is not known.
bool check_value(const TomlValue& value, const KeyDoc& doc, int dimension, Problems& problems);

// Checks a table as a whole when it is made: unknown and missing keys, types, ranges, choices. What
// is asked for afterwards is either good or not given; so the reader of a bad file goes on and
// finds the other mistakes, too.
class TableReader {
 public:
  // `where` is the place of the table's header. `dimension` is the world's, 0 where it is not
  // known: points may then have two or three numbers. `called` names the table in messages.
  TableReader(const TomlTable& table, Place where, const TableDoc& doc, Problems& problems,
              int dimension, std::string_view called = {});

  // Is the key written there, good or bad?
  bool has(std::string_view key) const { return entry(key) != nullptr; }
  // And is it good? What else is wrong with a bad one is not told.
  bool is_good(std::string_view key) const { return good(key) != nullptr; }
  // Of the key's value; of the table if it is not there.
  Place place(std::string_view key) const;
  Place key_place(std::string_view key) const;
  Place where() const { return where_; }
  const TableDoc& doc() const { return doc_; }

  // The members of `to` that keys are bound to; what is not given, or not good, stays as it is.
  template <class T>
  void fill(T& to) const {
    fill(typeid(T), &to);
  }

  // The value of one key, of the type that the language gives it (see toml_value.hpp).
  template <class T>
  std::optional<T> get(std::string_view key) const {
    std::optional<T> found;
    if (const TomlValue* value = good(key)) assign(*value, found);
    return found;
  }
  // The elements of a list, or the entries of a table from names to values.
  template <class T>
  std::vector<T> list(std::string_view key) const {
    return get<std::vector<T>>(key).value_or(std::vector<T>());
  }
  std::optional<Named> named(std::string_view key) const { return get<Named>(key); }
  std::vector<Named> names(std::string_view key) const { return list<Named>(key); }
  bool truth(std::string_view key) const { return get<bool>(key).value_or(false); }

  // Adds a problem at the key's value, or at its name.
  template <class... Hint>
  void bad_value(std::string_view key, std::string message, Hint&&... hint) const {
    problems_.add(place(key), std::move(message), std::forward<Hint>(hint)...);
  }
  template <class... Hint>
  void bad_key(std::string_view key, std::string message, Hint&&... hint) const {
    problems_.add(key_place(key), std::move(message), std::forward<Hint>(hint)...);
  }

  // The table or tables of a key, with their places; empty if there is none or it is bad.
  std::vector<const TomlValue*> tables(std::string_view key) const;

  // Is the key's value a good list? Otherwise it is a whole number, bad, or not there.
  bool is_list(std::string_view key) const;

 private:
  void fill(const std::type_info& owner, void* object) const;
  const TomlEntry* entry(std::string_view key) const;
  const TomlValue* good(std::string_view key) const;
  void check_unknown(const TomlEntry& entry);
  void check_missing();
  void check_groups();

  const TomlTable& table_;
  Place where_;
  const TableDoc& doc_;
  Problems& problems_;
  int dimension_;
  std::string called_;
  std::set<std::string_view> bad_;
};

}  // namespace lantern::language
