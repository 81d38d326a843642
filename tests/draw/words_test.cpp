// In a made-up language no word on any page comes from elsewhere than its table.
#include "language/words.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "draw/page.hpp"
#include "run/director.hpp"

namespace lantern::draw {
namespace {

namespace fs = std::filesystem;

bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Each letter outside of braces becomes a Cyrillic one: whatever is Latin still is not translated.
std::string made_up(std::string_view english) {
  std::string text;
  int depth = 0;
  for (const char c : english) {
    depth += (c == '{') - (c == '}');
    text += depth == 0 && is_ascii_letter(c) ? "ж" : std::string(1, c);
  }
  return text;
}

// Nouns within braces, {leaves:leaf/leaves}, are the scenario's own, too.
std::string made_up_caption(std::string_view own) {
  std::string text;
  bool in_name = false;
  for (const char c : own) {
    if (c == '{') in_name = true;
    if (c == '}' || (in_name && c == ':')) in_name = false;
    text += !in_name && is_ascii_letter(c) ? "ж" : std::string(1, c);
  }
  return text;
}

WordTable made_up_words() {
  WordTable words = *language::words_in("de");
  words.language = "x-made-up";
  for (auto& [english, said] : words.said) said = made_up(english);
  return words;
}

// Runs of two Latin letters and more.
std::set<std::string> latin_in(std::string_view text) {
  std::set<std::string> found;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_ascii_letter(text[end])) ++end;
    if (end - at > 1) found.emplace(text.substr(at, end - at));
    at = std::max(end, at + 1);
  }
  return found;
}

// A line of the lecture's code, its file, its function.
bool is_code(const TextShape& text) {
  return text.weight == Weight::code || text.text.find("::") != text.text.npos ||
         text.text.ends_with(".hpp") || text.text.ends_with(".cpp");
}

std::vector<std::string> sequences() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(LANTERN_ROOT) / "scenarios"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class EveryWord : public testing::TestWithParam<std::string> {};

TEST_P(EveryWord, ComesFromTheTable) {
  language::ScenarioSpec spec = language::load_scenario(
      (fs::path(LANTERN_ROOT) / "scenarios" / (GetParam() + ".toml")).string());
  WordTable words = made_up_words();
  for (const std::string& text : language::texts_of(spec))
    words.texts[text] = made_up_caption(text);
  // Names of the scenario, and units.
  std::set<std::string> known = {"mm",        "cm", "µm", "nm", "ms", "rad", "allCollisions",
                                 "framesLeft"};
  const auto know = [&](const language::ScenarioSpec& of) {
    for (const auto& body : of.bodies) words.texts[body.name] = made_up(body.name);
    for (const auto& texture : of.textures) words.texts[texture.name] = made_up(texture.name);
    for (const auto* structure : of.structures())
      for (const auto& plane : structure->planes) words.texts[plane.name] = made_up(plane.name);
    known.merge(latin_in(of.side));
  };
  know(spec);
  for (const auto& side : spec.sides) know(*side);
  language::translate(spec, words);
  const language::Scenario scenario(std::move(spec));
  const Speaking speaking(scenario.words.get());
  std::set<std::string> strange;
  std::set<std::pair<std::size_t, std::string>> drawn;
  Work work;
  run::direct(scenario, Pace::event, work, [&](Frame frame) {
    if (!drawn.emplace(frame.step, frame.event).second) return true;
    frame.display.legend = true;
    Work page_work;
    const DrawList list = draw_frame(frame, page_for(1600, 900), page_work);
    for (const DrawShape& shape : list.shapes)
      if (const auto* text = std::get_if<TextShape>(&shape); text && !is_code(*text))
        for (const std::string& latin : latin_in(text->text))
          if (!known.contains(latin)) strange.insert(fmt::format("{} in “{}”", latin, text->text));
    return true;
  });
  EXPECT_EQ(strange, std::set<std::string>());
}

INSTANTIATE_TEST_SUITE_P(Scenarios, EveryWord, testing::ValuesIn(sequences()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace lantern::draw
