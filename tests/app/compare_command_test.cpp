// `lantern compare` of what a run writes: pictures, figures, facts, whole folders.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Frames 0 and 1 of the ghosts, as PNG and as SVG in one folder, and a copy of it.
class CompareCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name());
    const std::string render = "lantern render " + kGhosts + " --size 128x72 --frames -1 -o ";
    ASSERT_EQ(shell(render + at("a") + " && " + render + at("a") + " --format svg").code, 0);
    fs::copy(folder_ / "a", folder_ / "b", fs::copy_options::recursive);
  }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string in_b(const std::string& ending) const {
    return at("b/ghost_quadtree/ghost_quadtree_0001." + ending);
  }
  std::string in_a(const std::string& ending) const {
    return at("a/ghost_quadtree/ghost_quadtree_0001." + ending);
  }
  Outcome compare(const std::string& words) const { return shell("lantern compare " + words); }
  Outcome folders() const { return compare(at("a") + " " + at("b")); }

  static void change(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = read_text(file);
    ASSERT_NE(text.find(from), text.npos) << from;
    write_text(file, text.replace(text.find(from), from.size(), to));
  }

  fs::path folder_;
};

TEST_F(CompareCommand, FoldersAreComparedFactsAndAll) {
  EXPECT_EQ(folders().code, 0);
  EXPECT_EQ(folders().err, "0 of 6 files differ\n");
  change(in_b("json"), "\"pairs\": 1", "\"pairs\": 4");
  const Outcome o = folders();
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("different; counts.pairs: expected 1, found 4\n1 of 6 files differ\n"),
            std::string::npos)
      << o.err;
  fs::remove(in_b("json"));
  EXPECT_NE(folders().err.find("_0001.json: different; is missing"), std::string::npos);
}

TEST_F(CompareCommand, FiguresAreTextAndTheirSealIsNoPartOfThem) {
  const std::string both = in_a("svg") + " " + in_b("svg");
  EXPECT_EQ(compare(both).code, 0);
  const std::string text = read_text(in_b("svg"));
  write_text(in_b("svg"), text.substr(0, text.find("<!-- Lantern made this")));
  EXPECT_EQ(compare(both).code, 0);
  change(in_b("svg"), "<path", "<Path");
  const Outcome o = compare(both);
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("different; line "), std::string::npos) << o.err;
}

TEST_F(CompareCommand, WritesOverNothingThatItCompares) {
  const std::string before = read_text(in_a("png"));
  EXPECT_EQ(compare(in_a("png") + " " + in_b("png") + " -o " + in_a("png")).code, 2);
  EXPECT_EQ(read_text(in_a("png")), before);
}

TEST_F(CompareCommand, FactsWithoutTheirSealAreTheSameFacts) {
  change(in_b("json"), "made_from", "made_by");
  EXPECT_EQ(compare(in_a("json") + " " + in_b("json")).code, 1);
  change(in_b("json"), "made_by", "made_from");
  change(in_b("json"), "checksum\": \"", "checksum\": \"0");
  EXPECT_EQ(compare(in_a("json") + " " + in_b("json")).code, 0);
  write_text(in_b("json"), "{\"format\"");
  const Outcome o = compare(in_a("json") + " " + in_b("json"));
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("_0001.json' is no JSON object, or it is damaged"), std::string::npos)
      << o.err;
}

TEST_F(CompareCommand, TwoKindsAreAUsageError) {
  EXPECT_EQ(compare(in_a("svg") + " " + in_b("png")).code, 2);
  EXPECT_EQ(compare(in_a("png") + " " + in_b("json")).code, 2);
}

TEST_F(CompareCommand, AProgramIsToldTheSame) {
  change(in_b("json"), "\"pairs\": 1", "\"pairs\": 4");
  const json report = json::parse(compare("--json " + at("a") + " " + at("b")).out);
  EXPECT_EQ(report["format"], "lantern.compare/1");
  EXPECT_EQ(report["equal"], false);
  ASSERT_EQ(report["files"].size(), 6u);
  EXPECT_EQ(report["files"][3]["name"], "ghost_quadtree/ghost_quadtree_0001.json");
  EXPECT_EQ(report["files"][3]["finding"], "counts.pairs: expected 1, found 4");
}

}  // namespace
}  // namespace lantern::app
