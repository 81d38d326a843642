// What stands after -o decides what a run becomes.
#include <string>

#include <gtest/gtest.h>

#include "app/output/render_job.hpp"
#include "app/terminal.hpp"
#include "fresh_folder.hpp"

namespace lantern::app {
namespace {

std::string refused(const std::string& words, bool sheet = false) try {
  const Destination to(words, sheet);
  return "accepted";
} catch (const UsageError& e) {
  return e.what();
}

TEST(Destination, TheEndingChooses) {
  EXPECT_EQ(Destination("output", false).kind(), OutputKind::folder);
  EXPECT_EQ(Destination("-", false).kind(), OutputKind::standard_output);
  EXPECT_EQ(Destination("a/b.PNG", false).kind(), OutputKind::picture);
  EXPECT_EQ(Destination("talk.mp4", false).kind(), OutputKind::film);
  EXPECT_EQ(Destination("figure.pdf", false).kind(), OutputKind::document);
  EXPECT_EQ(Destination("hand.pdf", true).kind(), OutputKind::sheet);
  EXPECT_EQ(Destination("lesson.html", false).kind(), OutputKind::page);
}

TEST(Destination, AFolderMayHaveADotIfItStandsThereOrEndsWithASlash) {
  const auto old = fresh_folder("destination") / "out.gif";
  std::filesystem::create_directory(old);
  EXPECT_EQ(Destination(old.string(), false).kind(), OutputKind::folder);
  EXPECT_EQ(Destination("out.v2/", false).kind(), OutputKind::folder);
}

TEST(Destination, ABadWordGetsTheListOfWhatThereIs) {
  EXPECT_NE(refused("talk.mp5").find("did you mean 'mp4'?"), std::string::npos);
  EXPECT_NE(refused("talk.htm").find("; did you mean 'html'?"), std::string::npos)
      << refused("talk.htm");
  EXPECT_NE(refused("talk.quicktime").find("webm"), std::string::npos);
  EXPECT_NE(refused("{frames}.png").find("did you mean 'frame'?"), std::string::npos);
  EXPECT_NE(refused("{frame.png").find("without its }"), std::string::npos);
  EXPECT_NE(refused("{frame}").find("name of a file"), std::string::npos);
  EXPECT_NE(refused("sheet.svg", true).find(".pdf or a .png"), std::string::npos);
}

TEST(Destination, PlaceholdersStandForTheirParts) {
  const Destination to("clips/{scenario}_{step}.mp4", false);
  EXPECT_TRUE(to.is_by("step"));
  EXPECT_FALSE(to.is_by("frame"));
  EXPECT_EQ(to.file({"pong", 3, 17}), "clips/pong_0003.mp4");
}

}  // namespace
}  // namespace lantern::app
