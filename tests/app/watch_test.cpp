// `lantern watch`: what is saved is drawn again.
#include "app/output/watch.hpp"

#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

// Looks until a change is told or it has looked often enough; a look apart the clock has ticked.
std::vector<std::string> looked(WatchedFiles& watched) {
  for (int i = 0; i < 3; ++i) {
    ::usleep(10'000);
    if (auto changed = watched.changed(); !changed.empty()) return changed;
  }
  return {};
}

TEST(WatchedFiles, TellsOfOtherBytesOnce) {
  const fs::path folder = fresh_folder("watched");
  const std::string a = folder / "a.toml", b = folder / "b.toml";
  write_text(a, "one");
  write_text(b, "one");
  WatchedFiles watched({a, b});
  EXPECT_TRUE(looked(watched).empty());
  write_text(a, "two");
  EXPECT_EQ(looked(watched), std::vector{a}) << "written in place";
  EXPECT_TRUE(looked(watched).empty());
  write_text(folder / "new", "six");
  fs::rename(folder / "new", b);
  EXPECT_EQ(looked(watched), std::vector{b}) << "written elsewhere and renamed";
  write_text(a, "two");
  EXPECT_TRUE(looked(watched).empty()) << "saved without a change";
  fs::remove(a);
  EXPECT_TRUE(looked(watched).empty()) << "between two saves";
  EXPECT_EQ(watched.gone(), std::vector<std::string>()) << "told once";
  write_text(a, "ten");
  EXPECT_EQ(looked(watched), std::vector{a});
}

TEST(WatchedFiles, TellsOnceThatAFileIsGoneAndOnceThatItIsBack) {
  const fs::path folder = fresh_folder("vanished");
  const std::string a = folder / "a.toml";
  write_text(a, "one");
  WatchedFiles watched({a});
  std::vector<std::string> told;
  const auto look = [&] {
    for (int i = 0; i < 4; ++i) {
      ::usleep(10'000);
      EXPECT_TRUE(watched.changed().empty());
      for (const std::string& file : watched.gone()) told.push_back("gone " + file);
      for (const std::string& file : watched.back()) told.push_back("back " + file);
    }
  };
  look();
  EXPECT_TRUE(told.empty());
  fs::remove(a);
  look();
  EXPECT_EQ(told, std::vector{"gone " + a});
  write_text(a, "one");
  look();
  EXPECT_EQ(told, (std::vector{"gone " + a, "back " + a})) << "even if it is as it was";
}

// Waits, in the shell, until a command succeeds, as long as $lantern is there.
std::string until(const std::string& command) {
  return "until " + command + "; do kill -0 $lantern 2>/dev/null || exit 9; sleep 0.01; done\n";
}

TEST(Watch, DrawsWhatWasSavedAndGoesOnThroughErrors) {
  const fs::path home = fresh_folder("watch");
  const std::string file = home / "pong_bsp.toml";
  const std::string text = read_text(scenario("pong_bsp"));
  write_text(file, text);
  std::string wrong = text;
  wrong.replace(wrong.find("[world]"), 7, "[wrold]");
  write_text(home / "wrong", wrong);
  std::string titled = text;
  titled.replace(titled.find("title = \""), 9, "title = \"Renamed: ");
  write_text(home / "titled", titled);
  const std::string manifest = home / "out/pong_bsp/manifest.json";
  const Outcome o =
      shell("cd " + home.string() +
            "\nenv --default-signal=INT " LANTERN_BINARY
            " watch pong_bsp.toml --size 80x45 --frames 0-1 -o out 2>said & lantern=$!\n" +
            until("grep -q 'watching pong_bsp.toml' said") +  //
            "grep -q 'finished\": true' " + manifest + " || exit 8\n" +
            "cp wrong new; mv new pong_bsp.toml\n" + until("grep -q wrold said") +
            "cp titled pong_bsp.toml\n" +
            until("grep -q 'finished\": true' " + manifest + " && grep -q Renamed " + manifest) +
            "kill -INT $lantern; wait $lantern; echo ended $?; cat said");
  EXPECT_EQ(o.code, 0) << o.err << o.out;
  EXPECT_NE(o.out.find("ended 130"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("pong_bsp.toml:"), std::string::npos) << "the place of the error\n" << o.out;
}

TEST(Watch, TellsOfAFileThatIsGoneAndLeavesNothingBehind) {
  const fs::path home = fresh_folder("watch-page");
  fs::copy_file(scenario("pong_bsp"), home / "w.toml");
  const Outcome o =
      shell("cd " + home.string() +
            "\nenv --default-signal=INT " LANTERN_BINARY
            " watch w.toml --frames 0-1 -o w.html 2>said & lantern=$!\n" +
            until("grep -q 'watching w.toml' said") +
            "test -e w.html.version.js || exit 8\nmv w.toml away\n" +
            until("grep -q \"'w.toml' is gone\" said") + "mv away w.toml\n" +
            until("grep -q \"'w.toml' is back\" said") + "kill -INT $lantern; wait $lantern; ls");
  EXPECT_EQ(o.code, 0) << o.err << o.out;
  EXPECT_EQ(o.out, "said\nw.html\nw.toml\n");
}

TEST(Watch, ShowsAnErrorOnThePageUntilItIsMended) {
  const fs::path home = fresh_folder("watch-error");
  const std::string text = read_text(scenario("pong_bsp"));
  write_text(home / "w.toml", text);
  std::string wrong = text;
  wrong.replace(wrong.find("[world]"), 7, "[wrold]");
  write_text(home / "wrong", wrong);
  const Outcome o = shell(
      "cd " + home.string() + "; cp w.toml right" +
      "\nenv --default-signal=HUP " LANTERN_BINARY
      " watch w.toml --frames 0-1 -o w.html 2>said & lantern=$!\n" +
      until("grep -q 'watching w.toml' said") + "cp w.html.version.js before\n" +
      "cp wrong w.toml\n" + until("grep -q wrold w.html.version.js") +
      "cp w.html.version.js during\ncp right w.toml\n" + until("cmp -s before w.html.version.js") +
      "kill -HUP $lantern; wait $lantern; cat during; ls *.js");
  EXPECT_NE(o.out.find("w.toml:"), std::string::npos) << o.out << o.err;
  EXPECT_EQ(o.out.find("w.html.version.js"), std::string::npos) << "it is left behind";
  EXPECT_NE(read_text(home / "w.html").find("lantern-error"), std::string::npos);
}

// Only what it has written, and where it has written it.
TEST(Watch, RemovesNothingOfAnybodyElse) {
  const auto watched = [](const std::string& before, const std::string& words,
                          const std::string& meanwhile) {
    const fs::path home = fresh_folder("watch-others");
    fs::copy_file(scenario("pong_bsp"), home / "w.toml");
    const Outcome o = shell("cd " + home.string() + "\n" + before +
                            "\nenv --default-signal=INT " LANTERN_BINARY " watch --frames 0 " +
                            words + " 2>said & lantern=$!\n" + until("grep -q watching said") +
                            meanwhile + "\nkill -INT $lantern; wait $lantern; cat said");
    EXPECT_EQ(o.code, 0) << o.err << o.out;
    return std::pair(home, o.out);
  };
  auto [home, said] = watched("mv w.toml w.html.version.js", "w.html.version.js -o w.html", "");
  EXPECT_TRUE(fs::exists(home / "w.html.version.js")) << said;
  EXPECT_NE(said.find("it is what this run has read"), said.npos) << said;
  std::tie(home, said) = watched("echo mine >w.html.version.js", "w.toml -o w.html", "");
  EXPECT_EQ(read_text(home / "w.html.version.js"), "mine\n");
  EXPECT_NE(said.find("'w.html.version.js' is not Lantern's"), said.npos) << said;
  std::tie(home, said) = watched("mkdir w.html.version.js", "w.toml -o w.html", "");
  EXPECT_TRUE(fs::exists(home / "w.html.version.js")) << said;
  std::tie(home, said) = watched("", "w.toml -o w.html", "echo mine >w.html.version.js");
  EXPECT_EQ(read_text(home / "w.html.version.js"), "mine\n");
  std::tie(home, said) =
      watched("mkdir out; echo mine >out/l.html.version.js", "w.toml -o '{scenario}/l.html'",
              "mv pong_bsp old; ln -s out pong_bsp");
  EXPECT_EQ(read_text(home / "out/l.html.version.js"), "mine\n") << said;
  EXPECT_FALSE(fs::exists(home / "old/l.html.version.js")) << "its own is gone";
}

TEST(Watch, WhatNoSaveCanMendEndsIt) {
  EXPECT_EQ(shell("lantern watch " + kGhosts + " -o -").code, 2);
  EXPECT_EQ(shell("lantern watch " + kGhosts + " --size 1x1").code, 2);
  const Outcome o = shell("lantern watch nowhere.toml");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.err.find("'nowhere.toml' is not there to be watched"), std::string::npos) << o.err;
}

TEST(Reload, AVersionBelongsToItsPage) {
  const fs::path home = fresh_folder("reload");
  const fs::path page = home / "a lesson.html";
  EXPECT_NE(reload_script(page).find("encodeURIComponent(\"a lesson.html.version.js\")"),
            std::string::npos)
      << reload_script(page);
  EXPECT_EQ(reload_script("<b>.html").find("<b>.html"), std::string::npos);
  tell_version(page, "one");
  const std::string first = read_text(home / "a lesson.html.version.js");
  tell_version(page, "two");
  EXPECT_NE(read_text(home / "a lesson.html.version.js"), first);
}

}  // namespace
}  // namespace lantern::app
