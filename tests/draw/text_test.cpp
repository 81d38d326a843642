#include <numeric>
#include <thread>

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "draw/font.hpp"
#include "draw/labels.hpp"

namespace lantern::draw {
namespace {

TEST(Font, KernsPairs) {
  const auto width = [](const char* text) { return text_width(text, 100, Weight::regular); };
  EXPECT_LT(width("AV"), width("A") + width("V") - 3) << "Inter kerns AV by some 7 % of the em";
  EXPECT_NEAR(width("ll"), 2 * width("l"), 1e-9);
  EXPECT_EQ(width(""), 0);
}

TEST(Font, WidthGrowsWithSizeAndWeight) {
  EXPECT_NEAR(text_width("Lantern", 40, Weight::regular),
              2 * text_width("Lantern", 20, Weight::regular), 1e-9);
  EXPECT_GT(text_width("Lantern", 20, Weight::semibold),
            text_width("Lantern", 20, Weight::regular));
  EXPECT_NEAR(cap_height(Weight::regular), 0.727, 0.001);
}

TEST(Font, KnowsWhichLettersItHas) {
  for (const char32_t letter : {U'A', U'ä', U'я', U'Ω', U'×', U'…', U'\n'})
    EXPECT_TRUE(has_glyph(letter)) << static_cast<unsigned>(letter);
  for (const char32_t letter : {U'日', U'א', U'😀'})
    EXPECT_FALSE(has_glyph(letter)) << static_cast<unsigned>(letter);
}

TEST(Font, SaysWhichLetterAGlyphShows) {
  std::u32string read;
  for (const PlacedGlyph& placed : shape_text("a×\t\xff日", 10, Weight::regular))
    read += placed.letter;
  EXPECT_EQ(read, U"a× \ufffd日") << "control characters are blanks";
}

TEST(Font, PlacesGlyphsInOrder) {
  const auto glyphs = shape_text("To × …", 50, Weight::semibold);
  ASSERT_EQ(glyphs.size(), 6u) << "one glyph a character, not one a byte";
  EXPECT_EQ(glyphs[0].x, 0);
  for (std::size_t i = 1; i < glyphs.size(); ++i) EXPECT_GT(glyphs[i].x, glyphs[i - 1].x);
  for (const PlacedGlyph& g : glyphs) EXPECT_NE(g.glyph, 0) << "the font lacks a character we use";
}

TEST(Font, TakesAnyBytes) {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(static_cast<std::size_t>(random.whole(0, 12)), ' ');
    for (char& c : bytes) c = static_cast<char>(random.bits());
    const double width = text_width(bytes, 10, Weight::regular);
    EXPECT_TRUE(std::isfinite(width));
    EXPECT_LE(shape_text(bytes, 10, Weight::regular).size(), bytes.size());
    EXPECT_GE(shortened(bytes, 30, {}).size() + wrapped(bytes, 30, {}).size() + 1, 1u);
  }
  EXPECT_EQ(shape_text("\xc3(", 10, Weight::regular).size(), 2u)
      << "a broken sequence is one U+FFFD";
  EXPECT_EQ(shape_text("\xed\xa0\x80", 10, Weight::regular).size(), 3u) << "a lone surrogate";
  EXPECT_EQ(shape_text("\xf0\x9f\x92\xa1", 10, Weight::regular).size(), 1u);
}

TEST(Font, RasterisesAndOutlines) {
  const int glyph = shape_text("H", 10, Weight::regular)[0].glyph;
  const GlyphBitmap bitmap = rasterise_glyph(glyph, Weight::regular, 40, 0.25);
  ASSERT_EQ(bitmap.coverage.size(), static_cast<std::size_t>(bitmap.width * bitmap.height));
  EXPECT_NEAR(bitmap.height, 40 * cap_height(Weight::regular), 1.5);
  EXPECT_NEAR(-bitmap.top, 40 * cap_height(Weight::regular), 1.5) << "stands on the baseline";
  EXPECT_GT(*std::max_element(bitmap.coverage.begin(), bitmap.coverage.end()), 250);
  const std::vector<PathStep> path = glyph_path(glyph, Weight::regular);
  EXPECT_EQ(path.front().letter, 'M');
  EXPECT_EQ(path.back().letter, 'Z');
  const int space = shape_text(" ", 10, Weight::regular)[0].glyph;
  EXPECT_TRUE(glyph_path(space, Weight::regular).empty());
  EXPECT_TRUE(rasterise_glyph(space, Weight::regular, 40, 0).coverage.empty());
}

TEST(Font, MayBeUsedByManyThreads) {
  std::vector<double> widths(4);
  std::vector<std::thread> threads;
  for (double& width : widths)
    threads.emplace_back([&width] {
      for (int i = 0; i < 200; ++i)
        width += text_width("Quadtree × 4 — AVATAR", 20, Weight::semibold);
    });
  for (std::thread& thread : threads) thread.join();
  for (const double width : widths) EXPECT_EQ(width, widths[0]);
}

TEST(Text, WrappingKeepsEveryWordAndTheWidth) {
  Random random(2);
  const TextStyle style;
  for (int round = 0; round < 300; ++round) {
    std::string text;
    for (std::int64_t words = random.whole(1, 30); words > 0; --words) {
      text += text.empty() ? "" : " ";
      for (std::int64_t n = random.whole(1, 9); n > 0; --n)
        text += random.unit() < 0.1 ? "ü"
                                    : std::string(1, static_cast<char>('a' + random.whole(0, 25)));
    }
    const double width = random.between(150, 500);  // no single word is wider
    std::string joined;
    for (const std::string& line : wrapped(text, width, style)) {
      EXPECT_LE(text_width(line, style.size, style.weight), width) << line;
      joined += (joined.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(joined, text);
  }
}

TEST(Text, LongWordsAreBrokenAnywhere) {
  const TextStyle style;
  const std::string word(300, 'm');
  std::string joined;
  for (const std::string& line : wrapped(word, 200, style)) {
    EXPECT_LE(text_width(line, style.size, style.weight), 200);
    joined += line;
  }
  EXPECT_EQ(joined, word);
}

TEST(Text, ShortenedEndsWithAnEllipsisAndFits) {
  const TextStyle style;
  const std::string text = "Rhabarber und Spargel für öffentliche Übungen";
  EXPECT_EQ(shortened(text, 1000, style), text);
  for (double width = 20; width < 400; width += 7) {
    const std::string part = shortened(text, width, style);
    EXPECT_LE(text_width(part, style.size, style.weight), width);
    if (part.empty() || part == text) continue;
    EXPECT_TRUE(part.ends_with("…"));
    const auto glyphs = shape_text(part, 10, Weight::regular);
    for (const PlacedGlyph& g : glyphs) EXPECT_NE(g.glyph, 0) << "a character was cut in half";
  }
  EXPECT_EQ(shortened(text, 3, style), "");
}

TEST(Labels, GivesTheFirstFreePlaceAndRecordsIt) {
  DrawList list;
  Labels labels(list);
  const Box<2> panel{{0, 0}, {400, 100}};
  labels.block({{0, 0}, {60, 100}});
  EXPECT_TRUE(labels.try_add("one", {{{10, 50}, 0}, {{100, 50}, 0}}, {}, panel));
  EXPECT_EQ(list.labels.at(0).box.lo.x, 100) << "the first place is blocked";
  EXPECT_FALSE(labels.try_add("two", {{{110, 50}, 0}}, {}, panel)) << "it would cover 'one'";
  EXPECT_FALSE(labels.try_add("two", {{{390, 50}, 0}}, {}, panel)) << "it would leave the panel";
  EXPECT_TRUE(labels.try_add("two", {{{390, 50}, 1}}, {}, panel));
  EXPECT_EQ(list.labels.size(), 2u);
  EXPECT_EQ(list.shapes.size(), 2u);
}

TEST(Labels, DigitsHaveCells) {
  const auto places = [](std::int64_t number) {
    DrawList list;
    Labels(list).add_number(number, {500, 50}, {}, {{0, 0}, {600, 100}});
    std::vector<double> x;
    for (const DrawShape& shape : list.shapes) x.push_back(std::get<TextShape>(shape).at.x);
    return x;
  };
  EXPECT_EQ(places(111), places(888)) << "a narrow 1 must not move its neighbours";
  EXPECT_EQ(places(7), std::vector<double>{places(1234567).front()});
}

}  // namespace
}  // namespace lantern::draw
