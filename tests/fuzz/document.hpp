// A scenario file as text that can be edited table by table: keys and values as they are written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fuzz/sees_all.hpp"
#include "language/language.hpp"

namespace lantern::fuzz {

struct Entry {
  std::string key;
  std::string value;  // as TOML, perhaps over several lines
};

struct Block {
  std::string header;  // "[world]", "[[step]]"; empty for the file's own keys
  std::vector<Entry> entries;

  std::string name() const;  // "world", "step"; of the file's own keys ""
  const Entry* find(std::string_view key) const;
  std::string_view value(std::string_view key) const;  // empty if there is none
};

struct Document {
  std::vector<Block> blocks;  // the file's own keys first

  std::string text() const;

  // Which block and entry stand in a line of text(); entry -1: the block's header.
  struct Spot {
    int block = -1;
    int entry = -1;
  };
  Spot at_line(int line) const;
};

// Of any text; what is no header and no `key = value` is left out.
Document document_of(std::string_view text);

// The language's table of a block, of a step its verb's. Null if the language has none.
const TableDoc* table_of(const Block& block);

// `text` as a TOML string.
std::string in_toml(std::string_view text);

// What stands in quotes in a value: "a" and "b" of `["a", "b"]`.
std::vector<std::string> texts_in(std::string_view value);

}  // namespace lantern::fuzz
