// Pages with the engine in them, as a user asks for them: what they hold, what is refused. The
// engine here is none: a few bytes with the marks of one.
#include <algorithm>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "draw/theme.hpp"
#include "embedded/version.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kModule("\0asm\1\0\0\0", 8);

// What stands in the element of this id; "" if there is none.
std::string element_text(const std::string& page, const std::string& id) {
  const std::size_t at = page.find(fmt::format(" id=\"{}\">", id));
  if (at == page.npos) return "";
  const std::size_t begin = page.find('>', at) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

class LivePage : public testing::Test {
 protected:
  LivePage() { write_text(engine(), fmt::format("{}...{}...", kModule, kEngineMark)); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string engine() const { return file("engine.wasm"); }
  std::string page(const std::string& name) const { return read_text(folder_ / name); }
  Outcome render(const std::string& words) const {
    return shell(fmt::format("lantern render {} --engine {}", words, engine()));
  }
  void expect_refused(const Outcome& o, const char* why) const {
    EXPECT_EQ(o.code, 2) << why;
    EXPECT_NE(o.err.find(why), o.err.npos) << o.err;
    EXPECT_FALSE(fs::exists(folder_ / "a.html"));
  }

  fs::path folder_ = fresh_folder("live_page");
};

TEST_F(LivePage, HoldsTheScenarioAndTheEngineAndIsTheSameAtEachRun) {
  ASSERT_EQ(render(kGhosts + " --live -o " + file("a.html")).code, 0);
  ASSERT_EQ(render(kGhosts + " --live -o " + file("b.html")).code, 0);
  const std::string live = page("a.html");
  EXPECT_EQ(live, page("b.html"));
  const json scenario = json::parse(element_text(live, "scenario"));
  EXPECT_EQ(scenario, (json{{"name", "ghost_quadtree.toml"}, {"text", read_text(kGhosts)}}));
  EXPECT_TRUE(element_text(live, "engine-packed").starts_with("eN")) << "a zlib stream";
  EXPECT_EQ(element_text(live, "worker-script"),
            read_text(repository("src/publish/live_worker.js")));
  EXPECT_NE(live.find(read_text(repository("src/publish/live.css"))), live.npos);
  EXPECT_EQ(element_text(live, "scenarios"), "");
}

TEST_F(LivePage, AsksTheNetworkForNothing) {
  ASSERT_EQ(render(kGhosts + " --live -o " + file("a.html")).code, 0);
  const std::regex away(
      "(src|href)=\"(?!data:|#|lesson.html\\?embed)|url\\(|@import|import\\(|fetch\\((?!`data:)|"
      "XMLHttp|"
      "Socket");
  std::string live = page("a.html");
  std::smatch found;
  EXPECT_FALSE(std::regex_search(live, found, away)) << found.str();
  for (std::size_t at = 0; (at = live.find("://", at)) != live.npos; at += 3) {
    const std::string address = live.substr(live.rfind("http", at), 40);
    EXPECT_TRUE(address.starts_with("http://www.w3.org/")) << address << ": a name, no address";
  }
}

TEST_F(LivePage, IsNoOtherThanRecordedWithoutTheWord) {
  ASSERT_EQ(shell(fmt::format("lantern render {} -o {}", kGhosts, file("a.html"))).code, 0);
  const std::string plain = page("a.html");
  for (const char* part : {"{{live}}", "id=\"scenario\"", "engine-packed", "worker-script"})
    EXPECT_EQ(plain.find(part), plain.npos) << part;
  ASSERT_EQ(render(kGhosts + " --live -o " + file("b.html")).code, 0);
  const std::string live = page("b.html");
  for (const char* id : {"frames-packed", "facts-packed", "card"})
    EXPECT_EQ(element_text(plain, id), element_text(live, id)) << id;
  ASSERT_EQ(render(kGhosts + " --live --frames 2-3 -o " + file("c.html")).code, 0);
  const std::string few = page("c.html");
  EXPECT_EQ(element_text(few, "scenario"), element_text(live, "scenario"));
  EXPECT_EQ(json::parse(element_text(few, "card"))["frames"], 2);
}

TEST_F(LivePage, CallsBodiesByTheColoursOfTheTheme) {
  const std::string words = read_text(repository("src/publish/live_words.js"));
  EXPECT_NE(words.find(fmt::format("FIRST_COLOR = {};", static_cast<int>(draw::Role::body_1))),
            words.npos);
}

TEST_F(LivePage, SharesTheEngineWithOthersOfItsFolder) {
  const std::string both = kGhosts + " " + scenario("children_on_demand");
  const Outcome o = render(both + " --live -o '" + file("all/{scenario}.html'"));
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string shared = page("all/lantern.engine.js");
  for (const char* name : {"all/ghost_quadtree.html", "all/children_on_demand.html"}) {
    const std::string live = page(name);
    EXPECT_NE(live.find("<script src=\"lantern.engine.js\">"), live.npos) << name;
    EXPECT_EQ(element_text(live, "engine-packed"), "");
  }
  ASSERT_EQ(render(kGhosts + " --live -o " + file("a.html")).code, 0);
  EXPECT_EQ(shared, fmt::format("window.lanternEngine = \"{}\";\n",
                                element_text(page("a.html"), "engine-packed")));
  ASSERT_EQ(render(kGhosts + " --live -o '" + file("each/{scenario}/a.html'")).code, 0);
  EXPECT_NE(element_text(page("each/ghost_quadtree/a.html"), "engine-packed"), "");
  fs::remove(folder_ / "a.html");
  write_text(folder_ / "all/lantern.engine.js", "mine");
  expect_refused(render(both + " --live -o '" + file("all/{scenario}.html'")), "stands there");
  EXPECT_EQ(page("all/lantern.engine.js"), "mine");
}

TEST_F(LivePage, IsRefusedWithoutItsOwnEngine) {
  const std::string live = kGhosts + " --live -o " + file("a.html");
  expect_refused(render(kGhosts + " -o " + file("a.html")), "leave out --engine");
  expect_refused(render(kGhosts + " --live -o " + file("a.pdf")), "only a lesson page");
  write_text(engine(), "<html>");
  expect_refused(render(live), "no WebAssembly module");
  write_text(engine(), kModule + "lantern-engine 0.0.1 0123456789abcdef");
  expect_refused(render(live), "not the engine of this Lantern");
  write_text(engine(), kModule);
  expect_refused(render(live), "'./run web'");
  fs::remove(engine());
  EXPECT_EQ(render(live).code, 1) << "there is no such file";
}

TEST_F(LivePage, FindsTheEngineBesideTheProgramOrInstalled) {
  fs::create_directories(folder_ / "bin");
  fs::copy_file(LANTERN_BINARY, folder_ / "bin/lantern");
  const std::string draw =
      fmt::format("{} render {} --live -o {}", file("bin/lantern"), kGhosts, file("a.html"));
  expect_refused(shell(draw), "'./run web' builds it");
  for (const char* place : {"bin", "share/lantern"}) {
    fs::create_directories(folder_ / place);
    fs::copy_file(engine(), folder_ / place / "lantern.wasm");
    EXPECT_EQ(shell(draw).code, 0) << place;
    fs::remove(folder_ / place / "lantern.wasm");
  }
}

TEST_F(LivePage, OfHostileTextHoldsNothingButText) {
  std::string text = read_text(kGhosts);
  write_text(folder_ / "evil.toml", "# </script><script>alert(1)</script><!-- {{script}}\n" + text);
  ASSERT_EQ(render(file("evil.toml") + " --live -o " + file("a.html")).code, 0);
  const std::string live = page("a.html");
  EXPECT_EQ(live.find("alert(1)</script>"), live.npos);
  EXPECT_EQ(json::parse(element_text(live, "scenario"))["text"], page("evil.toml"));
}

TEST_F(LivePage, IsAPlaygroundOfAllScenariosAndAnEmptyWorld) {
  const std::string make =
      fmt::format("cd {} && lantern playground --engine {} ", folder_.string(), engine());
  const Outcome o = shell(make + repository("scenarios").string());
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string play = page("play.html");
  const json all = json::parse(element_text(play, "scenarios"));
  const json list = json::parse(
      shell("lantern list --json " + repository("scenarios").string()).out)["scenarios"];
  ASSERT_EQ(all.size(), list.size() + 1);
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const char* member : {"title", "idea", "lecture"})
      EXPECT_EQ(all[i][member], list[i][member]) << i;
    EXPECT_EQ(all[i]["name"], list[i]["name"].get<std::string>() + ".toml");
    EXPECT_EQ(all[i]["text"], read_text(list[i]["file"].get<std::string>()));
  }
  const json first = json::parse(element_text(play, "scenario"));
  EXPECT_EQ(first["text"], all[0]["text"]);
  EXPECT_EQ(element_text(play, "frames-packed"), "") << "the engine draws the first one";
  ASSERT_EQ(shell(make + "-o again.html " + repository("scenarios").string()).code, 0);
  EXPECT_EQ(play, page("again.html"));

  write_text(folder_ / "empty.toml", all.back()["text"].get<std::string>());
  const Outcome checked = shell("lantern check --strict " + file("empty.toml"));
  EXPECT_EQ(checked.code, 0) << "the world to begin from: " << checked.err;
  for (const char* words : {"-o play.pdf", "-o '{scenario}.html'", "-o out"})
    EXPECT_EQ(shell(make + words).code, 2) << words;
}

}  // namespace
}  // namespace lantern::app
