// Films, from outside: what ffmpeg is given, what becomes of the file when it fails, and some real
// ones. Most of it with a program that only passes for ffmpeg.
#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "base/child.hpp"
#include "render/png.hpp"
#include "rooms.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const char* const kRecords =
    "printf '%s\\n' \"$@\" >>\"$0.args\"\n"
    "for last; do :; done\n"
    "cat >\"${last#file:}\"\n";

class AFilm : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder(::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "out");
  }
  // A program called ffmpeg that does this.
  void fake(const std::string& script) {
    fs::create_directories(folder_ / "bin");
    write_text(folder_ / "bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(folder_ / "bin/ffmpeg", fs::perms::owner_all);
  }
  // In the folder out/.
  Outcome render(const std::string& words) {
    const char* const size = words.find("--size") == words.npos ? " --size 64x36 " : " ";
    return shell("export PATH=" + (folder_ / "bin").string() + ":$PATH; cd " +
                 (folder_ / "out").string() + " && lantern render " + kGhosts + size + words);
  }
  std::string out(const std::string& name) { return read_text(folder_ / "out" / name); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_ / "out"), fs::directory_iterator()));
  }
  void refused(const std::string& words, int code, const std::string& why) {
    const Outcome o = render(words);
    EXPECT_EQ(o.code, code) << words << ": " << o.err;
    EXPECT_NE(o.err.find(why), std::string::npos) << words << ": " << o.err;
  }

  fs::path folder_;
};

// Each begins a cluster.
std::size_t pictures_in(const std::string& stream) {
  std::size_t count = 0;
  for (auto at = stream.find("\x1f\x43\xb6\x75"); at != stream.npos;
       at = stream.find("\x1f\x43\xb6\x75", at + 1))
    ++count;
  return count;
}

TEST_F(AFilm, IsGivenToFfmpegPictureByPicture) {
  fake(kRecords);
  const Outcome o = render("-o talk.mp4 --hold 1 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string stream = out("talk.mp4");
  const std::size_t pictures = 8 + 7 * 14 + 2;  // the last one tells twice how long it stands
  EXPECT_EQ(pictures_in(stream), pictures);
  EXPECT_NEAR(static_cast<double>(stream.size()), 64 * 36 * 1.5 * pictures, 50.0 * pictures);
  const std::string args = read_text(folder_ / "bin/ffmpeg.args");
  for (const char* word :
       {"libx264", "fps=30", "+faststart", "bt709", "title=Ghosts fill a quadtree"})
    EXPECT_NE(args.find(word), std::string::npos) << word;
  const json said = json::parse(o.out);
  EXPECT_EQ(said["scenarios"][0]["files"], json::array({"talk.mp4"}));
  EXPECT_EQ(said["scenarios"][0]["fps"], 30);
  EXPECT_NEAR(said["scenarios"][0]["seconds"], 8 + 7 * 14 / 30.0, 1e-9);
  EXPECT_EQ(said["work"]["in_betweens"], 7 * 14);
  EXPECT_EQ(said["work"]["graphics_contexts"], 1);
  EXPECT_EQ(files(), 1u);
}

TEST_F(AFilm, MayCutAndBeOfSomeFrames) {
  fake(kRecords);
  const Outcome o = render("-o talk.gif --hold 1 --tween 0 --frames 2-4 --fps 20 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(pictures_in(out("talk.gif")), 3u + 2u);
  EXPECT_EQ(json::parse(o.out)["scenarios"][0]["seconds"], 3);
  EXPECT_EQ(json::parse(o.out)["work"]["in_betweens"], 0);
}

TEST_F(AFilm, ByStepIsAClipEachThatBeginsWhereTheLastOneEnded) {
  fake(kRecords);
  const Outcome o = render("-o clips/{step}.mp4 --hold 1 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(json::parse(o.out)["scenarios"][0]["files"].size(), 8u);
  EXPECT_EQ(pictures_in(out("clips/0000.mp4")), 1u + 2u);
  EXPECT_EQ(pictures_in(out("clips/0007.mp4")), 1u + 14u + 1u + 2u);
}

TEST_F(AFilm, NeedsFfmpegAndSaysSoBeforeAnyWork) {
  const Outcome o = shell("export PATH=/nowhere; lantern render " + kGhosts + " -o " +
                          (folder_ / "new/talk.mp4").string());
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("apt-get install ffmpeg"), std::string::npos) << o.err;
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(AFilm, ThatFailsLeavesTheOldFileAndFfmpegsWords) {
  write_text(folder_ / "out/talk.mp4", "old");
  const char* const fails[][2] = {
      {"echo \"Unknown encoder 'libx264'\" >&2; exit 1", "Unknown encoder 'libx264'"},
      {"head -c 50000 >&3; echo '  no room'>&2; exit 3", "failed with exit code 3: no room"},
      {"cat >&3; echo Error writing trailer of file:/proc/self/fd/3: full >&2",
       "Error writing trailer of talk.mp4: full"},
      {"cat >/dev/null", "exit code 0"},
      {"kill -9 $$", "signal 9"},
  };
  for (const auto& [script, why] : fails) {
    fake(script);
    refused("-o talk.mp4", 1, why);
    EXPECT_EQ(out("talk.mp4"), "old") << script;
    EXPECT_EQ(files(), 1u) << script;
  }
}

TEST_F(AFilm, ThatIsInterruptedLeavesNothing) {
  write_text(folder_ / "out/talk.mp4", "old");
  fake("head -c 50000 >&3; echo $$ >\"$0.pid\"; exec sleep 10000");
  const Outcome o =
      shell("export PATH=" + (folder_ / "bin").string() + ":$PATH; begin render " + kGhosts +
            " --size 64x36 -o " + (folder_ / "out/talk.mp4").string() + "; until_so 'test -s " +
            (folder_ / "bin/ffmpeg.pid").string() + "'; interrupt");
  EXPECT_EQ(o.code, 130) << o.err;
  EXPECT_EQ(out("talk.mp4"), "old");
  EXPECT_EQ(files(), 1u);
  EXPECT_NE(shell("kill -0 $(cat " + (folder_ / "bin/ffmpeg.pid").string() + ")").code, 0)
      << "ffmpeg lives on";
}

TEST_F(AFilm, ThatCannotBeIsRefusedWithAdvice) {
  fake(kRecords);
  refused("-o talk.mp4 --size 65x37", 2, "--size 66x38");
  refused("-o talk.mp4 --transparent", 2, ".webm");
  refused("-o talk.gif --fps 30", 2, "--fps 50, 25");
  refused("-o {frame}.mp4", 2, "{step}");
  refused("-o talk.mp4 --format svg", 2, "leave out --format");
  refused("-o talk.mp4 --png small", 2, "leave out --png");
  refused("-o talk.png --hold 2", 2, "only a film");
  refused("-o talk.webm --at nowhere", 2, "no frame has this event");
  EXPECT_EQ(files(), 0u);
  EXPECT_FALSE(fs::exists(folder_ / "bin/ffmpeg.args")) << "it was run";
}

TEST_F(AFilm, OfFfmpegHasTheRightLengthSizeAndRate) {
  ASSERT_TRUE(find_program("ffmpeg")) << "apt-get install ffmpeg";
  const Outcome o = render("-o talk.mp4 --hold 0.5 -j 1");
  ASSERT_EQ(o.code, 0) << o.err;
  ASSERT_EQ(render("-o again.mp4 --hold 0.5 -j 3").code, 0);
  EXPECT_EQ(out("talk.mp4"), out("again.mp4"));
  const Outcome probe =
      shell("ffprobe -v error -of json -count_frames -show_streams -show_format " +
            (folder_ / "out/talk.mp4").string());
  const json film = json::parse(probe.out);
  EXPECT_EQ(film["streams"][0]["nb_read_frames"], std::to_string(8 * 15 + 7 * 14));
  EXPECT_EQ(film["streams"][0]["r_frame_rate"], "30/1");
  EXPECT_EQ(film["streams"][0]["width"], 64);
  EXPECT_EQ(film["streams"][0]["height"], 36);
  EXPECT_EQ(film["streams"][0]["color_space"], "bt709");
  EXPECT_EQ(film["format"]["tags"]["title"], "Ghosts fill a quadtree");
}

TEST_F(AFilm, OfFfmpegShowsThePictures) {
  ASSERT_TRUE(find_program("ffmpeg")) << "apt-get install ffmpeg";
  ASSERT_EQ(render("-o four.png --at four").code, 0);
  const auto expected = decode_png(out("four.png"));
  ASSERT_TRUE(expected);
  for (const char* kind : {"apng", "webm"}) {
    const std::string film = "four." + std::string(kind);
    const Outcome o = render("--at four --hold 0.1 -o " + film);
    ASSERT_EQ(o.code, 0) << o.err;
    ASSERT_EQ(shell("cd " + (folder_ / "out").string() + " && ffmpeg -v error -y -i " + film +
                    " -frames:v 1 shown.png")
                  .code,
              0);
    const auto shown = decode_png(out("shown.png"));
    ASSERT_TRUE(shown);
    double off = 0;
    for (std::size_t i = 0; i < shown->rgba.size(); ++i)
      off += std::abs(shown->rgba[i] - expected->rgba[i]);
    EXPECT_LE(off / static_cast<double>(shown->rgba.size()), kind[0] == 'a' ? 0 : 3) << kind;
  }
}

TEST_F(AFilm, OrPicturesOfTheNamesThatAreWanted) {
  ASSERT_EQ(render("-o folder").code, 0);
  const Outcome o = render("-o figures/{scenario}-{frame}.png --frames 2-4 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(json::parse(o.out)["scenarios"][0]["files"].size(), 3u);
  EXPECT_EQ(out("figures/ghost_quadtree-0003.png"),
            out("folder/ghost_quadtree/ghost_quadtree_0003.png"));
  ASSERT_EQ(render("-o four.svg --at four").code, 0);
  EXPECT_NE(out("four.svg").find("<svg"), std::string::npos);
  ASSERT_EQ(render("-o {step}.svg --frames 1-2").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/0002.svg"));
}

TEST_F(AFilm, OrPicturesOfWhichNoneIsWrittenOverAnother) {
  refused("-o four.png", 2, "write {frame} in the name");
  refused("-o figures/{step}.png --pace event", 2, "choose one with --frames or --at");
  refused("-o {frame}.png --fps 10", 2, "in-betweens");
  refused("-o {frame}.svg --format png", 2, "leave out --format png");
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace lantern::app
