// Values for keys of the language, from its own tables: right ones, edges, and wrong ones.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "fuzz/document.hpp"
#include "fuzz/sees_all.hpp"

namespace lantern::fuzz {

// The dice, with what is asked of them.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  bool chance(double p) { return random_.unit() < p; }
  std::int64_t whole(std::int64_t least, std::int64_t most) { return random_.whole(least, most); }
  double between(double least, double most) { return random_.between(least, most); }
  std::size_t index(std::size_t size) {
    return static_cast<std::size_t>(random_.whole(0, static_cast<std::int64_t>(size) - 1));
  }
  template <class List>
  const auto& pick(const List& list) {
    return list[index(std::size(list))];
  }
  template <class T>
  T pick(std::initializer_list<T> list) {
    return list.begin()[index(list.size())];
  }
  std::uint64_t bits() { return random_.bits(); }

 private:
  Random random_;
};

// What of a document other keys refer to, before one of its blocks.
struct Surroundings {
  Surroundings(const Document& document, std::size_t block);

  int dimension = 2;
  double extent = 16;  // of the world, along each axis
  double time_step = 1.0 / 60;
  bool has_world = false, has_atlas = false, has_level = false, has_structure = false;
  std::vector<std::string> bodies;  // single ones, and members of patterns
  std::vector<std::string> patterns;
  std::vector<std::string> prototypes;
  std::vector<std::string> present;  // bodies and patterns that steps before have inserted
  std::vector<std::string> absent;
  std::vector<std::string> textures;  // and their patterns
};

// A value that the key may have, as far as its own row and the names around it tell.
std::string right_value(const KeyDoc& key, const Surroundings& around, Dice& dice);

// At the end of the key's range, or just beyond; a right value if it has no range.
std::string edge_value(const KeyDoc& key, const Surroundings& around, Dice& dice);

// Of any type and size.
std::string wild_value(const Surroundings& around, Dice& dice);

// The table's keys but for those that `block` has: the required ones, of its groups as many as must
// be, each other one with the probability `fill`.
void fill_block(Block& block, const TableDoc& table, const Surroundings& around, double fill,
                Dice& dice);

}  // namespace lantern::fuzz
