#include "draw/shown_names.hpp"

#include <algorithm>
#include <string_view>

namespace lantern::draw {
namespace {

constexpr std::ptrdiff_t kMostOfStory = 8;

bool is_part_of_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         (static_cast<unsigned char>(c) & 0x80) != 0;
}

char small(char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Whole words; a sentence may begin with a name.
bool occurs_in(std::string_view name, std::string_view text) {
  const auto same = [](char a, char b) { return small(a) == small(b); };
  for (auto at = text.begin(); at != text.end();) {
    at = std::search(at, text.end(), name.begin(), name.end(), same);
    if (at == text.end()) return false;
    const auto end = at + static_cast<std::ptrdiff_t>(name.size());
    const bool begins = at == text.begin() || !is_part_of_word(*(at - 1));
    if (begins && (end == text.end() || !is_part_of_word(*end))) return true;
    ++at;
  }
  return false;
}

}  // namespace

bool shows_name(const Frame& frame, const FrameBody& body) {
  if (body.name.empty() || frame.display.names == ShownNames::none) return false;
  if (frame.display.names == ShownNames::all || body.lit) return true;
  const auto named = std::ranges::count_if(
      frame.bodies, [](const FrameBody& other) { return !other.name.empty(); });
  return named <= kMostOfStory || occurs_in(body.name, frame.caption);
}

}  // namespace lantern::draw
