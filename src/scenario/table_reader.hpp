// One table of a scenario file, read against its table of the language.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/vec.hpp"
#include "scenario/language.hpp"
#include "scenario/problems.hpp"
#include "scenario/toml_tree.hpp"

namespace lantern {

// A name with the place where it is written.
struct Named {
  std::string name;
  Place where;
};

// Checks a table as a whole when it is made: unknown and missing keys, types, ranges, choices. What
// is asked for afterwards is either good, or the default, or, where there is neither, nothing; so
// the reader of a bad file goes on and finds the other mistakes, too.
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

  std::optional<std::string> text(std::string_view key) const;
  std::optional<std::int64_t> whole(std::string_view key) const;
  std::optional<double> number(std::string_view key) const;
  std::optional<Vec<3>> point(std::string_view key) const;  // z = 0 unless it is written
  std::optional<Vec<2>> two(std::string_view key) const;    // two numbers, or a size
  std::vector<std::vector<Vec<2>>> loops(std::string_view key) const;
  std::vector<Named> texts(std::string_view key) const;
  bool truth(std::string_view key) const;

  // The position of the key's choice, or of its default, in the language's list of choices.
  std::optional<std::size_t> choice(std::string_view key) const;
  std::vector<std::size_t> choices(std::string_view key) const;

  // The table or tables of a key, with their places; empty if there is none or it is bad.
  std::vector<const TomlValue*> tables(std::string_view key) const;

  // Is the key's value a good list? Otherwise it is a whole number, bad, or not there.
  bool is_list(std::string_view key) const;

  // Entries of the types name_wholes, name_numbers, name_points and name_pairs.
  std::vector<std::pair<Named, std::int64_t>> name_wholes(std::string_view key) const;
  std::vector<std::pair<Named, double>> name_numbers(std::string_view key) const;
  std::vector<std::pair<Named, Vec<3>>> name_points(std::string_view key) const;
  std::vector<std::pair<Named, Named>> name_pairs(std::string_view key) const;

 private:
  const TomlEntry* entry(std::string_view key) const;
  const TomlValue* good(std::string_view key) const;
  const KeyDoc& doc(std::string_view key) const;
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

}  // namespace lantern
