// In what two files of facts differ, member by member.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lantern::render {

struct FactsDifference {
  std::string path;              // "counts.pairs", "bodies[ann].position[0]"
  std::string expected, actual;  // as JSON, long ones shortened; "nothing" where there is none
};

struct FactsComparison {
  std::vector<FactsDifference> differences;  // the first kMost; what tells most comes first
  std::size_t total = 0;                     // how many there are
  static constexpr std::size_t kMost = 50;
};

// Counts come first, then measures, then the rest in the order of the file; what follows from the
// rest (hash, since_last_frame) last. What a file was made from is no fact. Elements with a name or
// an id are compared with those of the same; other lists by place, if they are as long. Facts of
// another format differ in nothing else. Nothing if one of the texts is no JSON object, or one that
// is nested more than 64 deep.
std::optional<FactsComparison> compare_facts(std::string_view expected, std::string_view actual);

// Is it a JSON object that compare_facts() takes?
bool are_facts(std::string_view text);

// "counts.pairs: expected 3, found 4, and 5 more"; there must be a difference.
std::string finding(const FactsComparison& comparison);

}  // namespace lantern::render
