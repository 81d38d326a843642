// The table of promises: the forms that have keys of their own, then every measure and count.
#include <string_view>

#include "scenario/language_key.hpp"
#include "scenario/language_parts.hpp"

namespace lantern {
namespace {

using enum KeyType;

std::vector<KeyDoc> forms() {
  return {
      Key(name_numbers, "at_most",
          "Counts and measures that must not be greater, as `{ contacts = 3 }`."),
      Key(name_numbers, "at_least", "Counts and measures that must not be less."),
      Key(name_wholes, "in_leaves", "In how many leaves a body is stored, as `{ pink = 2 }`.")
          .range(0, kMostWhole),
      Key(name_pairs, "pairs_are",
          "The candidate pairs, these and no others, as `[[\"red\", \"pink\"]]`."),
      Key(name_pairs, "contacts_are", "The pairs that touch, these and no others."),
      Key(names, "hits_are",
          "What the last ray met, in order, or what the last cull or query found, in any order; "
          "these and no others."),
      Key(whole_or_names, "asleep", "How many bodies are asleep; or names of bodies that all are.")
          .range(0, kMostWhole),
      Key(whole_or_names, "awake", "How many bodies are awake; or names of bodies that all are.")
          .range(0, kMostWhole),
      Key(name_points, "position", "Where a body's centre is, as `{ ball = [12, 14] }`.")
          .range(-kFar, kFar),
      Key(name_points, "velocity", "Where a body goes, in units a second.").range(-kFar, kFar),
      Key(name_points, "half_size", "Of a body's box in the broad phase.").range(0, kFar),
      Key(name_numbers, "turned", "How far a body of a flat world is turned, in degrees.")
          .range(-1e9, 1e9),
  };
}

}  // namespace

TableDoc expect_table() {
  TableDoc expect = {"expect", "expect and always",
                     "Promises that `lantern check` verifies. Any count may be a key, as in "
                     "`expect = { nodes = 5, pairs = 1 }`.",
                     forms()};
  for (const CountDoc& measure : known_measures())
    expect.keys.push_back(Key(number, measure.name, measure.doc));
  expect.keys.push_back(
      Key(number, "tolerance",
          "How far off a measure, a turn, or a point on each axis may be. Counts are exact.")
          .range(0, kFar)
          .by_default("1e-9"));
  for (const CountDoc& count : known_counts())
    if (!expect.find(count.name))  // asleep and awake are above
      expect.keys.push_back(Key(whole, count.name, count.doc).range(0, kMostWhole));
  return expect;
}

}  // namespace lantern
