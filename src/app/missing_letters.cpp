#include "app/missing_letters.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/utf8.hpp"
#include "draw/font.hpp"
#include "scenario/source_text.hpp"

namespace lantern::app {
namespace {

// Of all texts that come onto a page, each letter once, in order.
class Missing {
 public:
  void look_at(std::string_view text) {
    while (!text.empty()) {
      const Letter letter = first_letter(text);
      text.remove_prefix(letter.bytes);
      if (letter.code && !has_glyph(*letter.code) && letters_.find(*letter.code) == letters_.npos)
        letters_ += *letter.code;
    }
  }
  void look_at(const Scenario& scenario) {
    look_at(scenario.title);
    look_at(scenario.side_title);
    for (const BodySpec& body : scenario.bodies) look_at(body.name);
    for (const TextureSpec& texture : scenario.textures) look_at(texture.name);
    for (const Step& step : scenario.steps) {
      look_at(step.part);
      look_at(step.caption);
      for (const NoteSpec& note : step.notes) look_at(note.text);
    }
    for (const auto& side : scenario.sides) look_at(*side);
  }
  const std::u32string& letters() const { return letters_; }

 private:
  std::u32string letters_;
};

// Where the file first writes it, comments aside; as a whole if it writes it as \u....
SourcePosition place_in(const Scenario& scenario, std::string_view letter) {
  const std::string_view text = without_mark(scenario.text);
  for (std::size_t at = text.find(letter); at != text.npos; at = text.find(letter, at + 1)) {
    const std::size_t line = text.substr(0, at).rfind('\n') + 1;  // 0 in the first line
    if (text[std::min(text.find_first_not_of(" \t", line), at)] == '#') continue;
    const Place place = place_of(text, at);
    return {scenario.file, place.line, place.column};
  }
  return {scenario.file, 0, 0};
}

}  // namespace

std::vector<Diagnostic> missing_letters(const Scenario& scenario) {
  constexpr std::size_t kMost = 5;
  Missing missing;
  missing.look_at(scenario);
  const std::u32string& letters = missing.letters();
  if (letters.empty()) return {};
  std::string list, first;
  for (std::size_t i = 0; i < std::min(letters.size(), kMost); ++i) {
    std::string letter;
    append_utf8(letter, letters[i]);
    if (i == 0) first = letter;
    list += (i > 0 ? ", '" : "'") + letter + "'";
  }
  if (letters.size() > kMost) list += fmt::format(" and {} more", letters.size() - kMost);
  Diagnostic found = diagnose(
      scenario, place_in(scenario, first),
      fmt::format("the bundled typeface has no {}: a picture shows a box in its place", list),
      "Inter has Latin, Greek and Cyrillic letters");
  found.severity = Severity::warning;
  return {found};
}

}  // namespace lantern::app
