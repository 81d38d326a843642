// One row of the language's tables, written as a sentence: type, key, meaning, then what else
// holds.
#pragma once

#include <utility>

#include "scenario/language.hpp"

namespace lantern {

inline constexpr NamePattern kFilePattern = {"^[a-z0-9_]{1,64}$", "1 to 64 of a–z, 0–9 and _"};
inline constexpr NamePattern kNamePattern = {
    "^[A-Za-z][A-Za-z0-9_ -]{0,23}$", "a letter, then up to 23 letters, digits, spaces, _ and -"};
inline constexpr NamePattern kEventPattern = {"^[a-z][a-z0-9_]{0,63}$",
                                              "a small letter, then a–z, 0–9 and _"};

// Coordinates, sizes and speeds: far from where doubles lose whole units.
inline constexpr double kFar = 1e9;
inline constexpr double kMostPixels = 16384;
inline constexpr double kMostAtlas = 8192;    // the largest image that can be drawn
inline constexpr double kMostWhole = 0x1p53;  // above it, doubles skip whole numbers
inline constexpr double kMostEvery = 1000;    // world steps from frame to frame
inline constexpr double kMostTurn = 1e6;      // degrees, and degrees a second
inline constexpr double kHundredYears = 4e9;  // seconds

class Key {
 public:
  Key(KeyType type, std::string_view key, std::string_view meaning) {
    doc_.key = key;
    doc_.type = type;
    doc_.doc = meaning;
  }
  operator KeyDoc() const { return doc_; }

  Key& must() { return doc_.required = true, *this; }
  Key& range(double least, double most) { return doc_.least = least, doc_.most = most, *this; }
  Key& above(double least, double most) { return doc_.above_least = true, range(least, most); }
  Key& at_most(double most) { return doc_.most = most, *this; }
  Key& in(std::string_view unit) { return doc_.unit = unit, *this; }
  Key& like(const NamePattern& pattern) { return doc_.pattern = pattern, *this; }
  Key& holds(std::string_view table) { return doc_.of = table, *this; }
  Key& written(std::string_view form) { return doc_.form = form, *this; }
  Key& by_default(std::string_view literal) { return doc_.fallback = literal, *this; }
  Key& or_else(std::string_view words) { return doc_.otherwise = words, *this; }
  Key& one_of(std::vector<std::string_view> choices) {
    return doc_.choices = std::move(choices), *this;
  }

 private:
  KeyDoc doc_;
};

}  // namespace lantern
