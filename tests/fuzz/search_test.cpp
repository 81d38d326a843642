// The kept corpus, then a short search that is the same every time.
#include "fuzz/search.hpp"

#include <gtest/gtest.h>

#include "fuzz/document.hpp"
#include "fuzz/trial.hpp"

namespace lantern::fuzz {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr std::uint64_t kRounds = 1500;
#else
constexpr std::uint64_t kRounds = 5000;
#endif

TEST(Fuzz, NothingCrashesHangsOrBreaksItsPromise) {
  SearchOptions options;
  options.rounds = kRounds;
  options.corpus = LANTERN_ROOT "/tests/fuzz/corpus";
  const SearchReport report = search(options);
  EXPECT_EQ(report.findings(), 0u) << to_text(report);
  EXPECT_GE(report.files, kRounds);
  EXPECT_GT(report.ran, report.files / 10) << "the search is too wild to get anywhere";
  EXPECT_LT(report.good, report.files * 9 / 10) << "the search is too tame to break anything";
  EXPECT_GT(report.drawn, 0u);
  EXPECT_GT(report.measured, 0u);
}

TEST(Fuzz, ADocumentKnowsItsLines) {
  const std::string text =
      "title = \"a\"\n[world]\nsize = [1,\n1]\nseed = 2\n[[step]]\ndo = \"show\"\n";
  const Document document = document_of(text);
  EXPECT_EQ(document.text(), text);
  ASSERT_EQ(document.blocks.size(), 3u);
  for (const auto& [line, block, entry] : {std::tuple{1, 0, 0},
                                           {2, 1, -1},
                                           {3, 1, 0},
                                           {4, 1, 0},
                                           {5, 1, 1},
                                           {6, 2, -1},
                                           {7, 2, 0},
                                           {8, -1, -1}}) {
    EXPECT_EQ(document.at_line(line).block, block) << line;
    EXPECT_EQ(document.at_line(line).entry, entry) << line;
  }
}

TEST(Fuzz, SvgThatIsNotWellFormedIsSeen) {
  EXPECT_NO_THROW(require_well_formed("<svg a=\"1\"><g><path d=\"M1\"/></g></svg>\n"));
  for (const char* bad : {"<svg>", "<svg></g>", "<svg a=\"1></svg>", "<svg>x</svg>", "</svg>",
                          "<svg a=\"&\"></svg>", "<svg a=\"nan\"></svg>", "<svg><a</svg>"})
    EXPECT_THROW(require_well_formed(bad), Finding) << bad;
}

}  // namespace
}  // namespace lantern::fuzz
