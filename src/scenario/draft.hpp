// A scenario while it is being read: what the parts of the parser share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scenario/problems.hpp"
#include "scenario/scenario.hpp"
#include "scenario/table_reader.hpp"

namespace lantern {

// Bodies or textures by name: one, or all of a pattern.
struct NamedRange {
  std::size_t first = 0;
  std::size_t count = 1;
  Place where;
};

class Names {
 public:
  // Adds a problem and gives false if the name is taken. Names of a pattern's members are not
  // `declared`: they are known, but never suggested.
  bool add(const std::string& name, const NamedRange& range, bool declared, Problems& problems);

  const NamedRange* find(const std::string& name) const;
  std::vector<std::string_view> declared() const { return {declared_.begin(), declared_.end()}; }
  bool empty() const { return declared_.empty(); }

 private:
  std::unordered_map<std::string, NamedRange> ranges_;
  std::vector<std::string> declared_;
};

struct Draft {
  Scenario scenario;
  Problems problems;
  std::string_view text;  // of the file, without a byte order mark
  bool has_world = false;
  Names bodies;
  Names textures;

  SourcePosition position(Place where) const { return {scenario.file, where.line, where.column}; }
};

// Each reads its part of the file into the draft, in this order.
void read_world(const TableReader& file, Draft& draft);
void read_bodies(const TableReader& file, Draft& draft);
void read_atlas(const TableReader& file, Draft& draft);
void read_script(const TableReader& file, Draft& draft);

// The structure keys of a table, upon `base`: what is not given stays.
StructureSpec read_structure(const TableReader& table, const StructureSpec& base, Draft& draft);

// Shared by bodies and textures: which colour the `index`-th has, when 0 cycles through all.
int cycled_color(std::int64_t color, std::size_t index);

// Of a pattern without one of its own: from the scenario's seed and the pattern's name.
std::uint64_t derived_seed(const TableReader& table, const std::string& name, const Draft& draft);

}  // namespace lantern
