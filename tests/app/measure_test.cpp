// `lantern measure` as a user meets it: exit codes, streams, files, interruption.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Few short runs of the orbit, at steps that take no time. On a busy machine their estimate may say
// otherwise, and they would be left out.
const std::string kShort =
    "lantern measure kepler --quick --longest 600 --no-peers --method velocity_verlet "
    "--step 0.1 --step 0.05 -o ";

json rows_of(const fs::path& folder) {
  return json::parse(read_text(folder / "measure.json"))["rows"];
}

// What does not depend on the clock.
json counted(json row) {
  for (const char* key : {"timing", "processor"}) row.erase(key);
  return row;
}

TEST(MeasureCommand, WritesRowsTablesAndPages) {
  const fs::path out = fresh_folder("measure") / "deeper";
  const Outcome o = shell(kShort + out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("velocity_verlet"), std::string::npos) << o.out;
  EXPECT_NE(o.err.find("2 runs, about"), std::string::npos) << "no estimate before: " << o.err;
  for (const char* file :
       {"measure.json", "measure.csv", "circumstances.csv", "peers.csv", "overview.svg",
        "overview.png", "kepler.svg", "kepler.png", "report.html"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  EXPECT_EQ(rows_of(out).size(), 2u);
  const std::string from = " --from " + out.string();
  const Outcome again = shell("lantern measure" + from + " -o " + out.string() + "_again");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read_text(out / "report.html"), read_text(out.string() + "_again/report.html"));
  EXPECT_EQ(shell("lantern measure --from " + (out / "measure.csv").string()).code, 2);
  EXPECT_EQ(shell("lantern measure --from nowhere").code, 1);
}

TEST(MeasureCommand, CountedWorkIsTheSameInEveryRun) {
  const fs::path folder = fresh_folder("measure_twice");
  json rows[2];
  for (int i = 0; i < 2; ++i) {
    const fs::path out = folder / std::to_string(i);
    ASSERT_EQ(shell(kShort + out.string()).code, 0);
    for (const json& row : rows_of(out)) rows[i].push_back(counted(row));
  }
  EXPECT_EQ(rows[0], rows[1]);
}

// What is in the folder is of this build, and of this report.
TEST(MeasureCommand, NothingOfAnotherBuildOrReportStands) {
  const fs::path out = fresh_folder("measure_older");
  ASSERT_EQ(shell(kShort + out.string()).code, 0);
  std::string text = read_text(out / "measure.json");
  text.replace(text.find("\"sources\": \"") + 12, 4, "xxxx");
  write_text(out / "measure.json", text);
  write_text(out / "mine.png", "not a page of Lantern's");
  std::string other = kShort;
  other.replace(other.find("kepler"), 6, "oscillator");
  const Outcome o = shell(other + out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err.find("finished from before"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("8 pages of an earlier report removed"), std::string::npos) << o.err;
  EXPECT_FALSE(fs::exists(out / "kepler.png")) << "it tells of a run that is no longer there";
  EXPECT_TRUE(fs::exists(out / "oscillator.png"));
  EXPECT_EQ(read_text(out / "mine.png"), "not a page of Lantern's");
}

TEST(MeasureCommand, GoesOnWithWhatIsFinished) {
  const fs::path out = fresh_folder("measure_again");
  ASSERT_EQ(shell(kShort + out.string()).code, 0);
  const json before = rows_of(out);
  const Outcome again = shell(kShort + out.string() + " --step 0.025");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("2 are finished from before"), std::string::npos) << again.err;
  const json after = rows_of(out);
  ASSERT_EQ(after.size(), 3u);
  EXPECT_EQ(after[0], before[0]) << "a finished row was measured anew";
  write_text(out / "measure.json", "{ \"damaged");
  const Outcome anew = shell(kShort + out.string());
  EXPECT_EQ(anew.code, 0) << "a damaged file is as if there were none";
  EXPECT_NE(anew.err.find("nothing is taken over from '"), anew.err.npos) << anew.err;
}

TEST(MeasureCommand, MistakesAreToldBeforeAnythingIsRun) {
  const fs::path out = fresh_folder("measure_mistakes") / "none";
  const std::string to = " -o " + out.string() + " ";
  for (const auto& [words, says] :
       {std::pair<std::string, std::string>{"keplr", "did you mean 'kepler'"},
        {"kepler --method velocity_verle", "did you mean 'velocity_verlet'"},
        {"kepler --step 0", "must be above 0"},
        {"kepler --step=-1", "must be above 0"},
        {"kepler --step nan", "must be above 0"},
        {"kepler --quick --full", "excludes"},
        {"kepler --longest 0", "longest"}}) {
    const Outcome o = shell("lantern measure" + to + words);
    EXPECT_EQ(o.code, 2) << words << ": " << o.err;
    EXPECT_NE(o.err.find(says), std::string::npos) << words << ": " << o.err;
    EXPECT_FALSE(fs::exists(out)) << words;
  }
  const Outcome tiny = shell("lantern measure" + to + "kepler --step 1e-300");
  EXPECT_EQ(tiny.code, 3);
  EXPECT_NE(tiny.err.find("too small to move a clock"), std::string::npos) << tiny.err;
}

TEST(MeasureCommand, ALongRunIsLeftOutAndSaidSo) {
  const fs::path out = fresh_folder("measure_long");
  const Outcome o = shell(
      "lantern measure kepler --no-peers --quick --longest 600 --method runge_kutta_4 "
      "--step 0.1 --step 1e-10 -o " +
      out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.err.find("left out as too long"), std::string::npos) << o.err;
  const json rows = rows_of(out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1]["status"], "left out");
  EXPECT_NE(std::string(rows[1]["reason"]).find("would take"), std::string::npos);
}

TEST(MeasureCommand, AFolderThatCannotBeWrittenIsFoundOutFirst) {
  const Outcome o = shell("lantern measure kepler -o /proc/lantern");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("/proc/lantern"), std::string::npos) << o.err;
}

TEST(MeasureCommand, AnyScenarioWithBodiesCanBeMeasured) {
  const fs::path out = fresh_folder("measure_own");
  const Outcome o =
      shell("lantern measure --quick --method runge_kutta_4 --step 0.02 --step 0.01 " +
            scenario("spring_rope") + " --longest 100 -o " + out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  ASSERT_EQ(rows_of(out).size(), 2u);
  EXPECT_NE(std::string(rows_of(out)[0]["reference"]).find("own run"), std::string::npos);
  const Outcome atlas =
      shell("lantern measure " + scenario("kdtree_atlas") + " -o " + out.string());
  EXPECT_EQ(atlas.code, 3);
  EXPECT_NE(atlas.err.find("has no bodies"), std::string::npos) << atlas.err;
}

TEST(MeasureCommand, ListsEveryProblemFile) {
  const Outcome o = shell("lantern measure --list");
  EXPECT_EQ(o.code, 0);
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(repository("scenarios/problems"))) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_NE(o.out.find(entry.path().stem().string() + " "), std::string::npos) << entry.path();
  }
  EXPECT_GT(files, 40u);
}

}  // namespace
}  // namespace lantern::app
