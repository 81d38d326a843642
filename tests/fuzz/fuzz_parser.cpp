// Whatever bytes a scenario file has, the parser gives a scenario, or mistakes with places in the
// file; it neither crashes nor hangs. Build with -DLANTERN_LIBFUZZER -fsanitize=fuzzer for a long
// search; the tests run a fixed number of seeded rounds.
#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "scenario/scenario.hpp"
#include "scenario/source_text.hpp"

namespace lantern {
namespace {

// Throws std::logic_error unless the place is in the text or right behind its end.
void require_inside(const SourcePosition& where, std::string_view text) {
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  const auto width = static_cast<int>(letters(line_of(text, where.line)));
  const bool inside = where.line >= 1 && where.line <= lines && where.column >= 1 &&
                      where.column <= width + 2;  // a line break, CR LF, may be what is wrong
  if (!inside)
    throw std::logic_error(
        fmt::format("a mistake at {}:{}, outside the file", where.line, where.column));
}

}  // namespace

// Throws std::logic_error if what the parser promises does not hold for these bytes.
void fuzz_parser(std::span<const std::uint8_t> bytes) {
  const std::string text(bytes.begin(), bytes.end());
  try {
    const Scenario scenario = parse_scenario(text, "fuzz.toml");
    if (scenario.steps.empty()) throw std::logic_error("a scenario without a step");
  } catch (const ScenarioError& error) {
    if (error.diagnostics().empty()) throw std::logic_error("an error without a mistake");
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      require_inside(diagnostic.where, text);
      for (const std::string& part :
           {diagnostic.message, diagnostic.source_line, diagnostic.suggestion})
        if (first_bad_byte(part)) throw std::logic_error("a message that is not UTF-8: " + part);
    }
  }
}

}  // namespace lantern

#ifdef LANTERN_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lantern::fuzz_parser({data, size});
  return 0;
}

#else

#include <gtest/gtest.h>

#include "base/random.hpp"
#include "scenario/parsing.hpp"

namespace lantern::test {
namespace {

constexpr std::string_view kWords[] = {"[",
                                       "]",
                                       "{",
                                       "}",
                                       "[[",
                                       "]]",
                                       "=",
                                       ",",
                                       "\"",
                                       "'",
                                       "\"\"\"",
                                       "'''",
                                       "#",
                                       ".",
                                       "\n",
                                       "\r\n",
                                       "\\",
                                       "\\u",
                                       "\\uD800",
                                       "\\U0010FFFF",
                                       "nan",
                                       "inf",
                                       "-inf",
                                       "1e308",
                                       "1e999",
                                       "-0.0",
                                       "0x7f",
                                       "0b1",
                                       "9223372036854775807",
                                       "-1",
                                       "0",
                                       "1979-05-27T07:32:00Z",
                                       "true",
                                       "false",
                                       "[[body]]",
                                       "[[step]]",
                                       "[world]",
                                       "[atlas]",
                                       "[structure]",
                                       "[[structure.planes]]",
                                       "[[pattern]]",
                                       "name = \"red\"",
                                       "do = \"run\"",
                                       "do = \"insert\"",
                                       "bodies = [\"red\"]",
                                       "count = 20000",
                                       "radius = 0",
                                       "expect = { nodes = 1 }",
                                       "caption = \"{pairs\"",
                                       "{pairs:pair}",
                                       "\xef\xbb\xbf",
                                       "\xff",
                                       "\xc3",
                                       "\xed\xa0\x80",
                                       "é",
                                       "a.b.c.d",
                                       "\t",
                                       "size = [1, 1]",
                                       "seconds = 1e300",
                                       "events = [\"split\"]",
                                       "size = [1, 1, 1]",
                                       "[1, 2, 3]",
                                       "[[[0, 0], [1, 0], [1, 1]]]",
                                       "[[spring]]",
                                       "[[joint]]",
                                       "[level]",
                                       "[chart]",
                                       "contacts = \"soft\"",
                                       "may_sleep = true",
                                       "ground = [0, 0]",
                                       "capsule = [0, 0]",
                                       "arrange = \"stack\"",
                                       "arrange = \"grid\"",
                                       "follow = \"red\"",
                                       "along = \"dot\"",
                                       "plot = \"a\"",
                                       "do = \"wait\"",
                                       "do = \"ray\"",
                                       "do = \"query\"",
                                       "do = \"compile\"",
                                       "expect = { at_most = { hits = 1 } }",
                                       "asleep = [\"red\"]"};

std::size_t somewhere(const std::string& text, Random& random) {
  return static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(text.size())));
}

void mutate(std::string& text, const std::string& other, Random& random) {
  const std::size_t at = somewhere(text, random);
  const auto length = static_cast<std::size_t>(random.whole(1, 40));
  switch (random.whole(0, 6)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random.whole(0, 255));
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, kWords[static_cast<std::size_t>(random.whole(0, std::size(kWords) - 1))]);
      break;
    case 3:
      text.insert(at, other.substr(somewhere(other, random), length));
      break;
    case 4:
      text.insert(at, text.substr(somewhere(text, random), length * 4));
      break;
    case 5:
      text.resize(at);
      break;
    default:
      if (at < text.size()) text[at] = static_cast<char>(random.whole(32, 126));
  }
}

TEST(FuzzParser, MutatedScenariosGiveAScenarioOrMistakesWithPlaces) {
  const std::vector<std::string> seeds = good_texts();
  Random random(2024);
  std::size_t good = 0;
  constexpr int kRounds = 2000;
  for (int round = 0; round < kRounds; ++round) {
    const auto pick = [&]() -> const std::string& {
      return seeds[static_cast<std::size_t>(
          random.whole(0, static_cast<std::int64_t>(seeds.size()) - 1))];
    };
    std::string text = pick();
    for (std::int64_t n = random.whole(1, 5); n > 0; --n) mutate(text, pick(), random);
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    ASSERT_NO_THROW(fuzz_parser(bytes)) << "round " << round << "\n" << text;
    good += mistakes(text).empty() ? 1u : 0u;
  }
  EXPECT_GT(good, 0u) << "no mutation kept a scenario good: the search is too wild";
  EXPECT_LT(good, std::size_t{kRounds}) << "no mutation broke a scenario: the search is too tame";
}

TEST(FuzzParser, RandomBytesGiveMistakes) {
  Random random(7);
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(random.whole(0, 200)));
    const bool ascii = random.unit() < 0.5;
    for (std::uint8_t& byte : bytes)
      byte = static_cast<std::uint8_t>(ascii ? random.whole(9, 126) : random.whole(0, 255));
    ASSERT_NO_THROW(fuzz_parser(bytes)) << "round " << round;
  }
}

}  // namespace
}  // namespace lantern::test

#endif
