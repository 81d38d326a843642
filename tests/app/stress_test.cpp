// `lantern stress` as a user meets it: exit codes, streams, files.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kQuick = " root_too_small cradle ";

TEST(StressCommand, AGoodCaseIsATableOnStandardOutput) {
  const Outcome o = shell("lantern --quiet stress" + kQuick);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_NE(o.out.find("good    root_too_small"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("2 of 2 cases good"), std::string::npos) << o.out;
}

TEST(StressCommand, TheExitCodeIsTheVerdict) {
  const Outcome o = shell("lantern stress --json overflow overflow_implicit heavy_on_light_solid");
  bool good = true;
  const json report = json::parse(o.out);
  ASSERT_EQ(report["cases"].size(), 3u);
  for (const json& one : report["cases"]) good = good && one["good"];
  EXPECT_EQ(o.code, good ? 0 : 1) << o.out;
}

TEST(StressCommand, AnUnknownCaseIsAUsageErrorWithAHint) {
  const Outcome o = shell("lantern stress cradel");
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_NE(o.err.find("there is no case 'cradel'; did you mean 'cradle'?"), std::string::npos)
      << o.err;
  EXPECT_EQ(shell("lantern stress xyzzy_nothing_like_it").code, 2);
  EXPECT_EQ(shell("lantern stress -o ''").code, 2);
  EXPECT_EQ(shell("lantern stress --theme pink cradle").code, 2);
}

TEST(StressCommand, ListsItsCases) {
  const Outcome o = shell("lantern stress --list");
  EXPECT_EQ(o.code, 0) << o.err;
  for (const char* name : {"coincident_bodies", "stack_of_60", "bad_sizes", "free_fall"})
    EXPECT_NE(o.out.find(name), std::string::npos) << name;
  const json list = json::parse(shell("lantern stress --list --json").out)["cases"];
  EXPECT_GT(list.size(), 60u);
  EXPECT_FALSE(std::string(list[0]["what"]).empty());
}

TEST(StressCommand, DrawsNoMapThatNobodyAskedFor) {
  const fs::path out = fresh_folder("stress_tables");
  const Outcome o = shell("LD_DEBUG=files lantern stress" + kQuick + "-o " + out.string());
  ASSERT_EQ(o.code, 0);
  EXPECT_FALSE(fs::exists(out / "stability_map.svg"));
  EXPECT_EQ(o.err.find("OSMesa"), std::string::npos) << "it draws nothing";
}

TEST(StressCommand, WritesTablesAndTheMapIntoAFolder) {
  const fs::path out = fresh_folder("stress") / "deeper";
  const Outcome o = shell("lantern stress --map" + kQuick + "-o " + out.string());
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* file : {"stress.csv", "stress.json", "stability_map.svg", "stability_map.png"})
    EXPECT_TRUE(fs::exists(out / file)) << file;
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(out)) ++files;
  EXPECT_EQ(files, 4u) << "something was left behind";
  const json report = json::parse(read_text(out / "stress.json"));
  EXPECT_EQ(report["format"], "lantern.stress/1");
  EXPECT_TRUE(report["finished"]);
  EXPECT_EQ(report["cases"].size(), 2u);
  EXPECT_EQ(read_text(out / "stress.csv").substr(0, 5), "name,");
  const std::string before = read_text(out / "stability_map.png");
  EXPECT_EQ(before.substr(1, 3), "PNG");
  ASSERT_EQ(shell("lantern stress --map" + kQuick + "-o " + out.string()).code, 0);
  EXPECT_EQ(read_text(out / "stability_map.png"), before) << "the same run gives other bytes";
  EXPECT_EQ(json::parse(read_text(out / "stress.json")), report);
}

TEST(StressCommand, AFolderThatCannotBeWrittenIsFoundOutBeforeTheWork) {
  const fs::path folder = fresh_folder("stress_blocked");
  write_text(folder / "file", "");
  const Outcome o = shell("lantern stress --full --map -o " + (folder / "file" / "sub").string());
  EXPECT_EQ(o.code, 1);
  EXPECT_EQ(o.out, "") << "it began to work";
  EXPECT_NE(o.err.find("file"), std::string::npos) << o.err;
}

TEST(StressCommand, CtrlCKeepsWhatIsFinished) {
  const fs::path out = fresh_folder("stress_cut");
  const std::string said = (fresh_folder("stress_said") / "said").string();
  // It is at its second case, or behind it.
  const Outcome o =
      shell("begin stress --full --map -o " + out.string() + " 2>" + said +
            "; until_so 'grep -qE \"^stress: ([2-9]|[0-9]{2,}) of\" " + said + "'; interrupt");
  EXPECT_EQ(o.code, 130) << read_text(said);
  const json report = json::parse(read_text(out / "stress.json"));
  EXPECT_FALSE(report["finished"]);
  EXPECT_GT(report["cases"].size(), 0u);
  EXPECT_NE(o.out.find("interrupted before the end"), std::string::npos) << o.out;
  EXPECT_FALSE(fs::exists(out / "stability_map.png"));
}

}  // namespace
}  // namespace lantern::app
