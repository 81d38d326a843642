// `-o lesson.html` as a user asks for it: what it makes, what it refuses, what stays.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/process.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

class LessonPage : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  Outcome render(const std::string& words) const { return shell("lantern render " + words); }

  // A flat world in which one body flies for so many frames.
  std::string flight(const std::string& name, double seconds) const {
    const std::string path = file(name);
    write_text(path, fmt::format(R"(title = "Flight"
[world]
size = [16, 9]
time_step = 0.001
[[body]]
name = "ann"
radius = 0.5
position = [3, 6]
[[step]]
do = "insert"
bodies = ["ann"]
[[step]]
do = "run"
seconds = {}
every = 1
)",
                                 seconds));
    return path;
  }

  fs::path folder_ = fresh_folder("lesson_page");
};

TEST_F(LessonPage, IsTheSameAtEachRunAndListsItselfBesideOthers) {
  for (const char* folder : {"one", "two"}) {
    const Outcome o = render(fmt::format("{} {} -o '{}/{{scenario}}.html'", kGhosts,
                                         scenario("children_on_demand"), file(folder)));
    ASSERT_EQ(o.code, 0) << o.err;
  }
  for (const char* name : {"ghost_quadtree.html", "children_on_demand.html", "index.html"})
    EXPECT_EQ(read_text(folder_ / "one" / name), read_text(folder_ / "two" / name)) << name;
  const std::string index = read_text(folder_ / "one/index.html");
  const std::size_t first = index.find("href=\"ghost_quadtree.html\""),
                    then = index.find("href=\"children_on_demand.html\"");
  ASSERT_NE(then, index.npos);
  EXPECT_LT(first, then) << "in the order of the lecture";
  EXPECT_NE(index.find("after <a href=\"ghost_quadtree.html\">"), index.npos);
  EXPECT_LT(fs::file_size(folder_ / "one/ghost_quadtree.html"), 200'000u);
}

TEST_F(LessonPage, StandsInTheOrderAskedForAndLeadsToTheNext) {
  const std::string other = scenario("children_on_demand"), third = scenario("buckets");
  const auto places = [&] {
    const std::string index = read_text(folder_ / "index.html");
    std::vector<std::size_t> at;
    for (const char* name : {"ghost_quadtree", "children_on_demand", "buckets"})
      at.push_back(index.find(fmt::format("href=\"{}.html\"", name)));
    return at;
  };
  const auto next = [&](const char* name) {
    const std::string page = read_text(folder_ / fmt::format("{}.html", name));
    const std::size_t at = page.find("\"next\": {\"file\": \"");
    return at == page.npos ? "" : page.substr(at + 18, page.find('"', at + 18) - at - 18);
  };
  Outcome o = render(fmt::format("{} {} {} --title 'Trees & more' -o '{}'", kGhosts, third, other,
                                 file("{scenario}.html")));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(next("ghost_quadtree"), "buckets.html");
  EXPECT_EQ(next("buckets"), "children_on_demand.html");
  EXPECT_EQ(next("children_on_demand"), "");
  o = render(fmt::format("{} {} {} -o '{}'", other, kGhosts, third, file("{scenario}.html")));
  EXPECT_LT(places()[1], places()[0]);
  EXPECT_LT(places()[0], places()[2]);
  EXPECT_NE(read_text(folder_ / "index.html").find("<h1>Trees &amp; more</h1>"), std::string::npos)
      << "its title stays";
  ASSERT_EQ(render(fmt::format("{} -o '{}'", kGhosts, file("{scenario}.html"))).code, 0);
  EXPECT_LT(places()[1], places()[0]) << "its order stays";
  // By the alphabet, as a * of the shell gives them, is no order.
  ASSERT_EQ(
      render(fmt::format("{} {} {} -o '{}'", third, other, kGhosts, file("new/{scenario}.html")))
          .code,
      0);
  const std::string index = read_text(folder_ / "new/index.html");
  EXPECT_LT(index.find("href=\"ghost_quadtree.html\""), index.find("href=\"buckets.html\""));
}

TEST_F(LessonPage, ListsLessonsAsTheyAreOpenedAndOnlyThoseThatAreThere) {
  const Outcome o = render(fmt::format("{} {} --theme dark --language de -o '{}'", kGhosts,
                                       scenario("buckets"), file("{scenario}.html")));
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string index = read_text(folder_ / "index.html");
  EXPECT_NE(index.find("<html lang=\"de\" data-theme=\"dark\">"), std::string::npos);
  EXPECT_EQ(index.find("n_squared"), std::string::npos) << "a file's name is no title";
  const std::size_t told = o.err.find("captions without texts in 'de'");
  EXPECT_NE(told, std::string::npos) << o.err;
  EXPECT_EQ(o.err.find("captions without", told + 1), std::string::npos) << "once a run";
}

TEST_F(LessonPage, LeavesAnIndexAloneThatIsNotItsOwn) {
  write_text(folder_ / "index.html", "mine");
  const Outcome o = render(fmt::format("{} -o '{}'", kGhosts, file("{scenario}.html")));
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.err.find("left alone"), std::string::npos) << o.err;
  EXPECT_EQ(read_text(folder_ / "index.html"), "mine");
  EXPECT_EQ(render(fmt::format("{} -o {}", kGhosts, file("alone/a.html"))).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "alone/index.html")) << "one page needs no list";
}

TEST_F(LessonPage, SaysWhatItCannotBe) {
  const auto refused = [&](const std::string& words, const char* why) {
    const Outcome o = render(kGhosts + " " + words);
    EXPECT_EQ(o.code, 2) << words;
    EXPECT_NE(o.err.find(why), std::string::npos) << o.err;
  };
  refused("-o " + file("{step}.html"), "only {scenario}");
  refused("--tween 3 -o " + file("a.html"), "leave out --tween");
  refused("--transparent -o " + file("a.html"), "leave out --transparent");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(LessonPage, OfTooManyFramesIsRefusedBeforeTheRun) {
  const Outcome o = render(fmt::format("{} -o {}", flight("long.toml", 60), file("a.html")));
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("long: up to 60 001 frames; a lesson page holds at most 20 000"),
            std::string::npos)
      << o.err;
  EXPECT_FALSE(fs::exists(folder_ / "a.html"));
  const std::string few =
      fmt::format("{} --frames 7-9 -o {}", flight("long.toml", 0.02), file("a.html"));
  EXPECT_EQ(render(few).code, 0);
}

// The seal at the end of a file tells of which text it was made.
TEST_F(LessonPage, NotesAreOnNoFrame) {
  const std::string text = read_text(kGhosts);
  const std::size_t step = text.find("[[step]]\n") + 9;
  ASSERT_NE(step, 8u);
  write_text(folder_ / "plain.toml", "name = \"a\"\n" + text);
  write_text(folder_ / "noted.toml",
             "name = \"a\"\n" + text.substr(0, step) + "notes = \"Wait.\"\n" + text.substr(step));
  std::string pictures[2];
  for (const bool noted : {false, true}) {
    const Outcome o =
        render(file(noted ? "noted.toml" : "plain.toml") + " --frames 0 --format svg -o -");
    ASSERT_EQ(o.code, 0) << o.err;
    pictures[noted] = o.out.substr(0, o.out.rfind("<!--"));
  }
  EXPECT_EQ(pictures[0], pictures[1]);
}

TEST_F(LessonPage, KeepsTheOldOneWhenItCannotBeWritten) {
  write_text(folder_ / "a.html", "old");
  // Files of at most 16 blocks of 512 bytes: the disk is full, as far as the program can tell.
  const Outcome o = shell(
      fmt::format("trap '' XFSZ; ulimit -f 16; lantern render {} -o {}", kGhosts, file("a.html")));
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_EQ(read_text(folder_ / "a.html"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace lantern::app
