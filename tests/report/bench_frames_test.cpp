#include <filesystem>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "fresh_folder.hpp"
#include "report/benches.hpp"

namespace lantern::report {
namespace {

FrameRow row(const char* sequence, const char* writer, double rate, double against, double bytes) {
  FrameRow r;
  r.sequence = sequence;
  r.writer = writer;
  r.frames = 10;
  r.frames_per_second = r.lower_quartile = r.upper_quartile = rate;
  r.against_cairo = against;
  r.bytes_per_file = bytes;
  return r;
}

FrameBenchResult some_frames() {
  FrameBenchResult result;
  result.command = "lantern bench frames <a> b";
  result.cairo = "1.16.0";
  result.rows = {row("a", "lantern, fast", 400, 20, 1000), row("a", "cairo, 1 thread", 20, 1, 900),
                 row("b", "lantern, fast", 600, 40, 3000), row("b", "cairo, 1 thread", 15, 1, 700)};
  result.rows[0].pixels_drawn = 1920 * 1080;
  result.rows[0].bands_packed = 3;
  result.rows[0].bands_kept = 1;
  result.starts = {{false, 0.02, 0.1}, {true, 0.02, 0.04}};
  return result;
}

TEST(BenchFrames, MeansCountEachSequenceAsMuch) {
  const std::vector<FrameMean> means = means_of(some_frames());
  ASSERT_EQ(means.size(), 2u);
  EXPECT_EQ(means[0].writer, "lantern, fast");
  EXPECT_EQ(means[0].against_cairo, 30);
  EXPECT_EQ(means[0].bytes_per_file, 2000);
  EXPECT_EQ(means[1].against_cairo, 1);
}

TEST(BenchFrames, TextsTellWhatWasCounted) {
  const FrameBenchResult result = some_frames();
  const auto [table, csv, json, page, more] = texts_of(result);
  EXPECT_NE(table.find("10%"), table.npos) << "one picture's pixels of ten pictures'" << table;
  EXPECT_NE(table.find("75%"), table.npos) << "three bands of four were packed" << table;
  EXPECT_NE(csv.find("a,\"lantern, fast\",10,400,400,400,20,1000,2073600,3,1,,\r\n"), csv.npos)
      << csv;
  EXPECT_NE(csv.find("a,\"cairo, 1 thread\",10,20,20,20,1,900,,,,,\r\n"), csv.npos) << csv;
  EXPECT_NE(page.find("lantern bench frames &lt;a&gt; b"), page.npos);
  EXPECT_TRUE(more.empty());
}

TEST(BenchFrames, RefusesWhatDoesNotMove) {
  FrameBenchResult result;
  const auto none = [](std::size_t) { FAIL() << "nothing is measured"; };
  const std::filesystem::path folder = fresh_folder("bench_frames");
  EXPECT_THROW(bench_frames(result, {}, folder, none), Refused);
  EXPECT_THROW(bench_frames(result, {{"still", {DrawList{}}}}, folder, none), Refused);
}

}  // namespace
}  // namespace lantern::report
