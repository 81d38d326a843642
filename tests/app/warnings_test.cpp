// Warnings as a user of the program meets them.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A camera that looks away.
const std::string kAway =
    "title = \"away\"\n[world]\nsize = [4, 4, 4]\ncamera_eye = [2, 2, -20]\n"
    "camera_target = [2, 2, -40]\n[[body]]\nname = \"a\"\nposition = [1, 1, 1]\nradius = 0.5\n"
    "[[step]]\ndo = \"insert\"\nbodies = [\"a\"]\n";

std::string file_of(const std::string& name, const std::string& text) {
  const fs::path file = fresh_folder("warnings-" + name) / (name + ".toml");
  write_text(file, text);
  return file.string();
}

std::string looking_at_it() {
  std::string text = kAway;
  return text.replace(text.find("-40"), 3, "0");
}

TEST(Warnings, AreSaidWithPlaceAndKey) {
  const Outcome o = shell("lantern check " + file_of("away", kAway));
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("away.toml:5:1: warning: frame 0 (0 s) shows no body"), std::string::npos)
      << o.err;
  EXPECT_NE(o.err.find("camera_target = [1, 1, 1] would look at it"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("good; 1 frame, 0 expectations hold; 1 warning\n"), std::string::npos);
  EXPECT_EQ(shell("lantern check " + file_of("at", looking_at_it())).err.find(": warning: "),
            std::string::npos);
}

TEST(Warnings, AreErrorsIfOneIsStrict) {
  const Outcome o = shell("lantern check --strict " + file_of("away", kAway));
  EXPECT_EQ(o.code, 3);
  EXPECT_NE(o.err.find("away.toml:5:1: error: frame 0"), std::string::npos) << o.err;
  EXPECT_EQ(o.err.find("good"), std::string::npos) << o.err;
  EXPECT_EQ(shell("lantern check --strict " + file_of("at", looking_at_it())).code, 0);
}

TEST(Warnings, AreAListOfTheirOwnInJson) {
  const std::string file = file_of("away", kAway);
  const json told = json::parse(shell("lantern check --json " + file).out)["scenarios"][0];
  EXPECT_EQ(told["good"], true);
  EXPECT_TRUE(told["problems"].empty());
  ASSERT_EQ(told["warnings"].size(), 1u);
  EXPECT_EQ(told["warnings"][0]["line"], 5);
  EXPECT_EQ(told["warnings"][0]["column"], 1);
  EXPECT_EQ(told["warnings"][0]["suggestion"], "camera_target = [1, 1, 1] would look at it");
  const json strict =
      json::parse(shell("lantern check --strict --json " + file).out)["scenarios"][0];
  EXPECT_EQ(strict["good"], false);
  EXPECT_EQ(strict["problems"], told["warnings"]);
  EXPECT_TRUE(strict["warnings"].empty());
}

TEST(Warnings, AreGivenOfNothingThatComesWithLantern) {
  const std::string root = repository("scenarios");
  std::string files = root + "/*.toml";
#ifndef __SANITIZE_ADDRESS__  // the problems would take minutes
  files += " " + root + "/problems/*.toml";
#endif
  // Event pace does all that step pace does.
  const Outcome o = shell("lantern check --strict --pace event " + files);
  EXPECT_EQ(o.code, 0) << o.err;
}

}  // namespace
}  // namespace lantern::app
