// Tables and the page of `bench pairs`.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/benches.hpp"

namespace lantern::report {
namespace {

BoxBenchRow row(const char* who, const char* version, std::uint64_t bodies, double median) {
  BoxBenchRow row;
  row.workload = "uniform_2d";
  row.bodies = bodies;
  row.contestant = who;
  row.version = version;
  row.timing = {5, median, 0.9 * median, 0.95 * median, 1.1 * median};
  row.wall = median;
  row.found = bodies / 2;
  row.checked = "brute force";
  return row;
}

BoxBenchResult some_pairs() {
  BoxBenchResult result;
  result.command = "lantern bench pairs --workload <uniform>";
  result.circumstances.processor = "AMD";
  result.contestants = {{"CGAL", "5", "in its best way"}};
  for (const std::uint64_t bodies : {1000, 10000}) {
    const double seconds = 1e-7 * static_cast<double>(bodies);
    result.rows.push_back(row("quadtree", "", bodies, seconds));
    result.rows.push_back(row("octree", "", bodies, 2 * seconds));
    result.rows.push_back(row("CGAL", "5", bodies, 3 * seconds));
    result.rows.push_back(row("Boost", "1", bodies, 1e-9));
    result.rows.back().status = "wrong";
    result.rows.back().reason = "4 missed, 0 invented";
    BoxBenchRow missing = row("Bullet", "?", bodies, 1);
    missing.timing = {};
    missing.checked = "";
    missing.status = "missing";
    missing.reason = "apt-get install libbullet-dev";
    result.rows.push_back(missing);
  }
  return result;
}

TEST(BenchPairsReport, TheQuickestWithRightPairsIsTheMeasure) {
  const BoxBenchResult result = some_pairs();
  ASSERT_NE(fastest_peer(result.rows, result.rows[0]), nullptr);
  EXPECT_EQ(fastest_peer(result.rows, result.rows[0])->contestant, "CGAL");
  EXPECT_FALSE(result.rows[3].is_good());
}

TEST(BenchPairsReport, TheTableTellsAll) {
  const std::string text = texts_of(some_pairs()).table;
  for (const char* words :
       {"uniform_2d with 1000 boxes: 500 pairs, checked by brute force", "quadtree", "CGAL",
        "wrong: 4 missed, 0 invented", "missing: apt-get install libbullet-dev"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  for (const char* words : {"median, µs", "  quadtree  ", "  100", "  95 - 110", "  3  "})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

TEST(BenchPairsReport, JsonAndCsvHaveTheSameRows) {
  const BoxBenchResult result = some_pairs();
  const auto json = nlohmann::json::parse(texts_of(result).json);
  EXPECT_EQ(json["format"], "lantern.bench.pairs/1");
  ASSERT_EQ(json["rows"].size(), result.rows.size());
  EXPECT_EQ(json["rows"][1]["contestant"], "octree");
  EXPECT_DOUBLE_EQ(json["rows"][1]["seconds"]["median"].get<double>(), 2e-4);
  EXPECT_FALSE(json["rows"][4]["seconds"].contains("median"));
  const std::string csv = texts_of(result).csv;
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            result.rows.size() + 1);
}

TEST(BenchPairsReport, ThePageStandsAlone) {
  const std::string page = texts_of(some_pairs()).html;
  for (const char* words :
       {"<!DOCTYPE html>", "--workload &lt;uniform&gt;", "in its best way", "Time a box and step",
        "class=\"plot\"", "wrong</span>", "missing: apt-get", "</html>"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  EXPECT_EQ(page.find("http"), std::string::npos) << "something is loaded from elsewhere";
  EXPECT_NE(texts_of(BoxBenchResult{}).html.find("</html>"), std::string::npos);
}

}  // namespace
}  // namespace lantern::report
