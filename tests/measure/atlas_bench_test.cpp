#include "measure/atlas_bench.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/file.hpp"

namespace lantern::measure {
namespace {

namespace fs = std::filesystem;

TEST(AtlasBench, SetsAreAsTheirWordsSay) {
  for (const std::string_view name : texture_set_names()) {
    const TextureSet set = texture_set(name, 3000, 7);
    ASSERT_EQ(set.sizes.size(), 3000u);
    EXPECT_EQ(set.sizes, texture_set(name, 3000, 7).sizes);
    EXPECT_NE(set.sizes, texture_set(name, 3000, 8).sizes);
    const auto [narrow, wide] =
        std::ranges::minmax(set.sizes, {}, [](const TextureSize& size) { return size.width; });
    const auto [low, high] =
        std::ranges::minmax(set.sizes, {}, [](const TextureSize& size) { return size.height; });
    const std::vector<int> ends{narrow.width, wide.width, low.height, high.height};
    const std::vector<int> told = name == "tall"     ? std::vector{2, 9, 10, 209}
                                  : name == "glyphs" ? std::vector{6, 19, 12, 21}
                                                     : std::vector{1, 64, 1, 64};
    EXPECT_EQ(ends, told) << name;
    EXPECT_FALSE(texture_set_words(name).empty());
  }
  for (const TextureSize& size : texture_set("powers", 100, 1).sizes)
    EXPECT_EQ((size.width & (size.width - 1)) | (size.height & (size.height - 1)), 0);
  EXPECT_THROW(texture_set("sqare", 5, 1), Refused);
  EXPECT_EQ(texture_set_words("mine"), "");
}

TEST(AtlasBench, EveryContestantsLayoutIsRight) {
  AtlasBenchResult result;
  result.config.counts = {60};
  result.config.rounds = 1;
  std::size_t stages = 0;
  bench_atlases(result, [&](std::size_t stage, const TextureSet&) { EXPECT_EQ(stage, stages++); });
  EXPECT_EQ(stages, atlas_bench_stages(result.config));
  EXPECT_EQ(result.rows.size(), stages * result.contestants.size());
  EXPECT_GE(result.contestants.size(), 3u);
  for (const AtlasRow& row : result.rows) {
    SCOPED_TRACE(row.set + ", " + row.contestant);
    EXPECT_EQ(row.status, "ok") << row.reason;
    EXPECT_EQ(row.packed, 60u);
    EXPECT_EQ(row.width, row.height);
    EXPECT_GT(row.fill, 0.5);
    EXPECT_LE(row.fill, 1.0);
    EXPECT_GT(row.sides, 0u);
    EXPECT_GT(row.bytes, 0u);
    EXPECT_EQ(row.leaf_tests > 0, !row.is_peer());
    EXPECT_EQ(row.timing.repeats, 1);
    EXPECT_EQ(row.searching.repeats, 1);
    EXPECT_TRUE(row.turned == 0 || row.contestant == "best_texture:turn");
    const AtlasRow* peer = fullest_peer(result.rows, row);
    EXPECT_TRUE(!peer || (peer->is_peer() && peer->set == row.set));
  }
}

TEST(AtlasBench, AnAtlasOfOneSizeHoldsWhatItCan) {
  AtlasBenchResult result;
  result.config.sets = {"square"};
  result.config.counts = {100};
  result.config.atlas = TextureSize{100, 200};
  result.config.rounds = 1;
  bench_atlases(result, [](std::size_t, const TextureSet&) {});
  for (const AtlasRow& row : result.rows) {
    EXPECT_EQ(row.status, "ok") << row.contestant << ": " << row.reason;
    EXPECT_EQ(row.width, 100);
    EXPECT_GT(row.packed, 5u) << row.contestant;
    EXPECT_LT(row.packed, 100u) << row.contestant;
    EXPECT_EQ(row.searching.repeats, 0);
  }
}

TEST(AtlasBench, WrongLayoutsAreFound) {
  const std::vector<TextureSize> sizes{{4, 4}, {4, 4}, {2, 6}};
  const auto faults = [&](std::vector<std::optional<TexturePlace>> places) {
    AtlasRow row;
    row.width = row.height = 10;
    check_layout(sizes, places, row);
    EXPECT_EQ(row.status == "ok", row.overlaps + row.outside + row.wrong_sizes == 0);
    return std::vector<std::uint64_t>{row.overlaps, row.outside, row.wrong_sizes, row.packed};
  };
  using Faults = std::vector<std::uint64_t>;
  const TexturePlace a{{0, 0, 4, 4}}, b{{4, 0, 4, 4}}, c{{8, 0, 2, 6}};
  EXPECT_EQ(faults({a, b, c}), (Faults{0, 0, 0, 3}));
  EXPECT_EQ(faults({a, std::nullopt, TexturePlace{{0, 4, 6, 2}, true}}), (Faults{0, 0, 0, 2}));
  EXPECT_EQ(faults({a, TexturePlace{{3, 3, 4, 4}}, c}), (Faults{1, 0, 0, 3}));
  EXPECT_EQ(faults({a, a, c}), (Faults{1, 0, 0, 3}));
  EXPECT_EQ(faults({a, b, TexturePlace{{8, 5, 2, 6}}}), (Faults{0, 1, 0, 3}));
  EXPECT_EQ(faults({a, TexturePlace{{-1, 5, 4, 4}}, c}), (Faults{0, 1, 0, 3}));
  EXPECT_EQ(faults({a, b, TexturePlace{{0, 4, 6, 2}}}), (Faults{0, 0, 1, 3}));
}

TEST(AtlasBench, NamesThatAreNoneAreRefused) {
  AtlasBenchResult result;
  result.config.only = {"best"};
  EXPECT_THROW(bench_atlases(result, [](std::size_t, const TextureSet&) {}), Refused);
}

// --- a user's own file ---

class SizesFile : public ::testing::Test {
 protected:
  SizesFile() { fs::create_directories(folder_); }
  ~SizesFile() override { fs::remove_all(folder_); }

  TextureSet read(const std::string& text) {
    fs::remove(folder_ / "mine.csv");  // what was read is not written over
    write_file(folder_ / "mine.csv", text);
    return read_texture_sizes(folder_ / "mine.csv");
  }
  Diagnostic mistake(const std::string& text) {
    try {
      read(text);
    } catch (const ScenarioError& error) {
      return error.diagnostics().at(0);
    }
    ADD_FAILURE() << "read without a word: " << text;
    return {};
  }

  fs::path folder_ = fs::temp_directory_path() /
                     ("lantern-sizes-" + std::to_string(static_cast<long>(::getpid())));
};

TEST_F(SizesFile, IsReadWithAndWithoutNames) {
  const std::vector<TextureSize> sizes{{3, 4}, {50, 6}};
  EXPECT_EQ(read("3,4\n50,6\n").sizes, sizes);
  EXPECT_EQ(read("\xef\xbb\xbfwidth,height\r\n3,4\r\n\r\n# a note\r\n50 , 6").sizes, sizes);
  EXPECT_EQ(read("height;width\n4;3\n6;50\n").sizes, sizes);
  EXPECT_EQ(read("\"3\",\"4\"\n50,6\n").name, "mine");
}

TEST_F(SizesFile, MistakesHaveTheirPlace) {
  struct Wrong {
    const char* text;
    int line, column;
    const char* message;
    const char* advice;
  };
  for (const Wrong& wrong : std::vector<Wrong>{
           {"3,4\n5,six\n", 2, 3, "'six' is no whole number", "WIDTH,HEIGHT"},
           {"3,4\n5\n", 2, 1, "1 value,", "WIDTH,HEIGHT"},
           {"3,4,5\n", 1, 5, "3 values", "WIDTH,HEIGHT"},
           {"3,4\n0,4\n", 2, 1, "0 pixels", "1 to 65536"},
           {"-3,4\n", 1, 1, "-3 pixels", "1 to 65536"},
           {"3,65537\n", 1, 3, "65537 pixels", "1 to 65536"},
           {"3,4.5\n", 1, 3, "'4.5' is no whole", "WIDTH,HEIGHT"},
           {"3,99999999999\n", 1, 3, "no whole number", "WIDTH,HEIGHT"},
           {"width,heigth\n3,4\n", 1, 7, "unknown column 'heigth'", "did you mean 'height'?"},
           {"width,width\n3,4\n", 1, 7, "twice", "width and height"},
           {"3,\n", 1, 3, "'' is no whole", "WIDTH,HEIGHT"}}) {
    SCOPED_TRACE(wrong.text);
    const Diagnostic told = mistake(wrong.text);
    EXPECT_EQ(told.where.line, wrong.line);
    EXPECT_EQ(told.where.column, wrong.column);
    EXPECT_NE(told.message.find(wrong.message), std::string::npos) << told.message;
    EXPECT_NE(told.suggestion.find(wrong.advice), std::string::npos) << told.suggestion;
  }
  EXPECT_THROW(read(""), Refused);
  EXPECT_THROW(read("width,height\n"), Refused);
  EXPECT_THROW(read_texture_sizes(folder_ / "none.csv"), IoError);
}

}  // namespace
}  // namespace lantern::measure
