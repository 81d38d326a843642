// Counts in words.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace lantern {

// "1 frame", "2 frames", "0 frames": the number and its noun. One whose plural is not made with an
// s gives it: counted(2, "body", "bodies").
std::string counted(std::integral auto number, std::string_view noun,
                    std::string_view plural = {}) {
  if (number == 1) return fmt::format("1 {}", noun);
  return plural.empty() ? fmt::format("{} {}s", number, noun)
                        : fmt::format("{} {}", number, plural);
}

}  // namespace lantern
