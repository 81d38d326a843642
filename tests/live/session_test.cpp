// The engine of a page behind its one function: what it answers is held against a run of its own
// and against the text that a hand has left.
#include "live/session.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "draw/page.hpp"
#include "language/scenario.hpp"
#include "live/edit.hpp"
#include "publish/lesson_frames.hpp"
#include "run/director.hpp"
#include "run/shown.hpp"

namespace lantern::live {
namespace {

using nlohmann::json;

// Keys of the lesson's shapes and where each row stands, as a page decodes one frame alone.
struct Looked {
  explicit Looked(const json& answer) {
    const json& lesson = answer.at("lesson");
    const json& frame = lesson.at("frames").at(0);
    std::size_t known = 0;
    for (std::size_t i = 0; i < frame.at("rows").size(); i += 2) {
      const int from = frame["rows"][i], count = frame["rows"][i + 1];
      for (int k = 0; from == -1 && k < count; ++k) rows.push_back(lesson["rows"][known++]);
      if (from == -2) rows.push_back(lesson["rows"][static_cast<std::size_t>(count)]);
    }
    for (const json& row : rows) keys.push_back(lesson["keys"][row[1].get<std::size_t>()][0]);
  }

  // Without the numbers of tables, which are those of one answer.
  std::vector<std::string> shapes_of(const std::string& key) const {
    std::vector<std::string> shapes;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (keys[i] == key) {
        json shape = rows[i];
        shape[1] = shape[2] = 0;
        if (shape[0] == 3) shape.back() = 0;
        shapes.push_back(shape.dump());
      }
    return shapes;
  }

  // The middle of what is drawn of a body, in page units.
  Vec<2> middle(const std::string& key) const {
    Vec<2> lo(1e9), hi(-1e9);
    const auto see = [&](const Vec<2>& p) {
      lo = glm::min(lo, p);
      hi = glm::max(hi, p);
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (keys[i] != key) continue;
      const json& row = rows[i];
      Vec<2> at(row[3], row[4]);
      see(at);
      if (row[0] == 0) see(at + Vec<2>(row[5], row[6]));
      if (row[0] == 1 || row[0] == 2)
        for (std::size_t k = 5; k + 1 < row.size(); k += 2) {
          at += Vec<2>(row[k], row[k + 1]);
          see(at);
        }
    }
    return (lo + hi) / 200.0;
  }

  std::vector<json> rows;
  std::vector<std::string> keys;
};

class Page {
 public:
  json ask(const json& question) { return json::parse(session_.ask(question.dump())); }
  json ask_text(std::string_view question) { return json::parse(session_.ask(question)); }

  json open(const std::string& text) {
    return ask({{"do", "open"}, {"text", text}, {"name", "page.toml"}});
  }
  json frame(int index) { return ask({{"do", "frame"}, {"index", index}}); }
  json grab(int frame, const std::string& entity, const Vec<2>& at = Vec<2>(0.0)) {
    return ask({{"do", "grab"}, {"frame", frame}, {"entity", entity}, {"x", at.x}, {"y", at.y}});
  }
  // Whatever a hand leaves is a scenario.
  json drag(json way) {
    way["do"] = "drag";
    const json answer = ask(way);
    EXPECT_FALSE(answer.contains("refused")) << answer.dump();
    if (answer.contains("text"))
      language::parse_scenario(answer["text"].get<std::string>(), "left");
    return answer;
  }

 private:
  Session session_;
};

std::string said(const json& answer) { return answer.value("said", "(not refused)"); }

std::string shipped(const std::string& name) {
  return read_file(std::filesystem::path(LANTERN_ROOT) / "scenarios" / name, 1 << 20);
}

std::string with(std::string text, std::string_view old, std::string_view now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, text.npos) << old;
  return text.replace(at, old.size(), now);
}

// A point of a text, as "body[0].position".
std::vector<double> point_at(const std::string& text, const std::string& path) {
  return json::parse(value_at(text, path)).get<std::vector<double>>();
}

Vec<2> middle_of_red(const json& answer) { return Looked(answer).middle("world/body/red"); }

constexpr const char* kTwo = R"(title = "Two and a crowd"  # of dots
[world]
size = [64, 32]
[structure]
kind = "quadtree"
[[body]]  # it is held
name = "red"
radius = 3
position = [20, 12]  # here
[[body]]
name = "blue"
half_size = [2, 2]
oriented = true
position = [44, 20]
velocity = [4, 0]
[[body]]
name = "rock"
radius = 1
static = true
position = [60, 4]
[[pattern]]
name = "dot"
count = 3
radius = 0.6
seed = 3
[[step]]
do = "insert"
name = "in"
bodies = ["red", "blue", "rock", "dot"]
[[step]]
do = "run"
seconds = 1
[[step]]
do = "show"
ending = true
)";
constexpr int kRunEnds = 60;  // the frame at which its run does

TEST(Session, OpensARunAndKeepsItWhereTheNextIsRefused) {
  Page page;
  EXPECT_EQ(said(page.ask({{"do", "lesson"}})), "nothing is opened yet");
  const std::string ghosts = shipped("ghost_quadtree.toml");
  const json opened = page.open(ghosts);
  ASSERT_FALSE(opened.contains("refused")) << opened.dump();
  EXPECT_EQ(opened["frames"], 9);
  EXPECT_EQ(opened["warnings"], json::array());
  EXPECT_EQ(opened["unmet"], json::array());

  const json refused = page.open(with(kTwo, "size = [64, 32]", "size = [64, 32]\n  sise = 3"));
  const json& first = refused.at("refused").at(0);
  EXPECT_EQ(first["line"], 4);
  EXPECT_EQ(first["column"], 3);
  EXPECT_EQ(first["severity"], "error");
  EXPECT_EQ(first["suggestion"].get<std::string>().find("did you mean 'size'? known here: "), 0u);
  EXPECT_EQ(said(refused).find("page.toml:4:3: error: "), 0u) << said(refused);
  // What only the run finds stands at its step.
  const json late =
      page.open(with(shipped("ui_atlas.toml"), "size = [100, 32]", "size = [128, 96]"));
  ASSERT_TRUE(late.contains("refused"));
  EXPECT_GT(late["refused"][0]["line"].get<int>(), 60) << late.dump();
  EXPECT_EQ(page.ask({{"do", "lesson"}})["hashes"].size(), 9u);
  EXPECT_EQ(page.ask({{"do", "set"}, {"path", "structure.capacity"}, {"value", "3"}})["text"],
            with(ghosts, "capacity = 2", "capacity = 3"));

  const json unmet = page.open(with(ghosts, "pairs = 1", "pairs = 4"));
  ASSERT_EQ(unmet["unmet"].size(), 1u) << unmet.dump();
  EXPECT_GT(unmet["unmet"][0]["line"].get<int>(), 0);
}

// As `lantern render` draws a lesson page, from the first frame to the last.
TEST(Session, TheLessonIsThatOfARunOfItsOwn) {
  for (const char* name : {"ghost_quadtree.toml", "octree_split.toml", "ui_atlas.toml"}) {
    const std::string text = shipped(name);
    const language::Scenario scenario = language::parse_scenario(text, name);
    Work work;
    std::vector<Frame> frames;
    run::direct(scenario, scenario.pace, work, [&](const Frame& frame) {
      frames.push_back(frame);
      return true;
    });
    draw::AxisRanges axes;
    for (const Frame& frame : frames) axes.see(frame);
    publish::LessonFrames lesson;
    std::string facts;
    json hashes = json::array();
    for (std::size_t first = 0, end = 0; first < frames.size(); first = end) {
      for (end = first + 1; end < frames.size(); ++end)
        if (!draw::Staging::is_one_group(frames[end - 1], frames[end])) break;
      const draw::Staging staging(std::span<const Frame>(frames).subspan(first, end - first), axes);
      for (std::size_t i = first; i < end; ++i) {
        Frame bare = frames[i];
        bare.display.title = bare.display.caption = bare.display.counters = false;
        const auto list = draw::draw_frame(bare, staging, publish::lesson_page(), work);
        lesson.add(frames[i], list,
                   publish::words_of(i > 0 ? frames[i - 1] : Frame(), frames[i], scenario));
        facts += (i > 0 ? "," : "") + publish::facts_for_page(frames[i], list);
        hashes.push_back(fmt::format("{:016x}", frames[i].hash));
      }
    }
    Page page;
    page.open(text);
    const json answer = page.ask({{"do", "lesson"}});
    EXPECT_EQ(answer["lesson"], json::parse(lesson.json())) << name;
    EXPECT_EQ(answer["facts"], json::parse("[" + facts + "]")) << name;
    EXPECT_EQ(answer["hashes"], hashes) << name;

    const json one = page.frame(2);
    EXPECT_EQ(one["facts"], json::array({answer["facts"][2]}));
    EXPECT_EQ(one["hashes"], json::array({hashes[2]}));
    EXPECT_EQ(one["lesson"]["frames"][0]["caption"], answer["lesson"]["frames"][2]["caption"]);
  }
}

TEST(Session, ABodyThatStandsWhereItWasPutIsPutElsewhere) {
  const std::string text = shipped("ghost_quadtree.toml");
  Page page;
  page.open(text);
  const Vec<2> before = middle_of_red(page.frame(1));
  EXPECT_EQ(page.grab(1, "body/red", before)["grabbed"], "position");
  const json first = page.drag({{"x", before.x + 30}, {"y", before.y + 10}});
  const json second = page.drag({{"x", before.x + 60}, {"y", before.y + 40}});
  for (const auto& [answer, way] : {std::pair{first, Vec<2>(30, 10)}, {second, Vec<2>(60, 40)}}) {
    const std::string now = answer["text"];
    EXPECT_EQ(now, with(text, "[24, 56]", value_at(now, "body[0].position")));
    EXPECT_EQ(answer["index"], 1);
    EXPECT_LE(glm::length(middle_of_red(answer) - before - way), 1);
  }
  // What has not moved is drawn as it was.
  const Looked was(page.frame(1)), is(second);
  int still = 0;
  for (const std::string& key : std::set(was.keys.begin(), was.keys.end()))
    if (key == "world/body/pink" || key.starts_with("world/cell/") ||
        key.starts_with("tree/node/")) {
      EXPECT_EQ(was.shapes_of(key), is.shapes_of(key)) << key;
      ++still;
    }
  EXPECT_GE(still, 3);
  // Back at the place of the grab, nothing is changed; and the run that was opened never was.
  EXPECT_EQ(page.drag({{"x", before.x}, {"y", before.y}})["text"], text);
  EXPECT_EQ(middle_of_red(page.frame(1)), before);
  EXPECT_FALSE(page.open(second["text"]).contains("refused"));
  EXPECT_TRUE(
      page.ask({{"do", "drag"}, {"x", 1}}).contains("refused"));  // nothing is held any more
}

TEST(Session, ABodyStaysWithinTheWorld) {
  Page page;
  page.open(kTwo);
  page.grab(0, "body/red", {500, 300});
  EXPECT_EQ(page.drag({{"x", -1e6}, {"y", -1e6}})["text"], with(kTwo, "[20, 12]", "[3, 29]"));
  EXPECT_EQ(page.drag({{"x", 1e6}, {"y", 1e6}})["text"], with(kTwo, "[20, 12]", "[61, 3]"));
}

TEST(Session, WhatHasMovedGetsAStepOfItsOwn) {
  Page page;
  page.open(kTwo);
  EXPECT_EQ(page.grab(kRunEnds, "body/blue", {800, 300})["grabbed"], "move");
  const json moved = page.drag({{"x", 780}, {"y", 280}});
  const std::string text = moved["text"];
  const std::string step = "[[step]]\ndo = \"move\"\nbody = \"blue\"\nto = ";
  const std::string to = value_at(text, "step[2].to");
  EXPECT_EQ(text, with(kTwo, "seconds = 1\n", "seconds = 1\n\n" + step + to + "\n"));
  EXPECT_EQ(moved["index"], kRunEnds + 1);

  // Then that step's place changes.
  page.open(text);
  EXPECT_EQ(page.grab(kRunEnds + 1, "body/blue", {780, 280})["grabbed"], "move");
  const json again = page.drag({{"x", 790}, {"y", 270}});
  const std::string now = value_at(again["text"].get<std::string>(), "step[2].to");
  EXPECT_NE(now, to);
  EXPECT_EQ(again["text"], with(text, to, now));
  EXPECT_EQ(again["index"], kRunEnds + 1);

  // So does a member of a pattern; behind an ending, which is none then.
  page.open(kTwo);
  EXPECT_EQ(page.grab(kRunEnds + 1, "body/dot2", {0, 0})["grabbed"], "move");
  const std::string last = page.drag({{"x", 10}, {"y", 10}})["text"];
  EXPECT_EQ(value_at(last, "step[3].body"), "\"dot2\"");
  EXPECT_EQ(value_at(last, "step[2].ending"), "");
}

TEST(Session, WhatIsOfTheBodyThatAHandHoldsIsLit) {
  const std::string text = shipped("ghost_quadtree.toml");
  const language::Scenario scenario = language::parse_scenario(text, "ghosts.toml");
  Work work;
  int stored_twice = 0;
  run::direct(scenario, scenario.pace, work, [&](const Frame& frame) {
    Frame lit = frame;
    run::light_held("pink", lit);
    BodyId pink = -1;
    for (const FrameBody& body : lit.bodies) {
      EXPECT_EQ(body.lit, body.name == "pink");
      if (body.lit) pink = body.id;
    }
    int leaves = 0;
    for (const FrameNode& node : lit.nodes) {
      const bool holds = node.leaf && std::ranges::count(node.bodies, pink) > 0;
      EXPECT_EQ(node.mark == Mark::lit, holds);
      leaves += holds;
    }
    for (const FramePair& p : lit.pairs) EXPECT_EQ(p.lit, p.pair.a == pink || p.pair.b == pink);
    stored_twice += leaves == 2;
    return true;
  });
  EXPECT_GT(stored_twice, 0);

  // From the grab on, and in a text that is opened with it; of hashes nothing is another.
  Page page, held, rays;
  page.open(text);
  held.ask({{"do", "open"}, {"text", text}, {"name", "ghosts.toml"}, {"held", "red"}});
  EXPECT_NE(page.frame(3)["lesson"], held.frame(3)["lesson"]);
  EXPECT_EQ(page.frame(3)["hashes"], held.frame(3)["hashes"]);
  page.grab(3, "body/red", {400, 300});
  EXPECT_EQ(page.frame(3)["lesson"], held.frame(3)["lesson"]);
  // What a step asks for stays lit.
  const std::string ray = shipped("raycast_quadtree.toml");
  page.open(ray);
  rays.ask({{"do", "open"}, {"text", ray}, {"name", "rays.toml"}, {"held", "red"}});
  EXPECT_EQ(page.frame(4)["lesson"], rays.frame(4)["lesson"]);
}

// What has been run at the grab is gone on with once, and run again for what follows.
TEST(Session, ADragThatGoesOnShowsWhatItsTextDoes) {
  const std::string sides =
      "\n[[side]]\nname = \"a\"\n[[side]]\nname = \"b\"\nstructure.kind = \"grid\"\n";
  const std::string many = with(kTwo, "count = 3", "count = 60");
  for (const std::string& text : {many, many + sides}) {
    const std::string prefix = text == many ? "" : "a/";
    Page page;
    page.open(text);
    for (const char* body : {"body/blue", "body/rock", "body/dot2"}) {
      const json grabbed = page.grab(kRunEnds, prefix + body, {800, 300});
      EXPECT_EQ(grabbed["grabbed"], "move") << body;
      EXPECT_EQ(grabbed["kept"], true) << body;
      for (const json& way : {json{{"x", 780}, {"y", 280}},
                              {{"x", 700}, {"y", 300}},
                              {{"x", 790}, {"y", 280}, {"vx", 900}}}) {
        const json drawn = page.drag(way);
        Page fresh;
        fresh.open(drawn["text"]);
        const json whole = fresh.frame(drawn["index"]);
        EXPECT_EQ(drawn["hashes"], whole["hashes"]) << drawn["text"];
        EXPECT_EQ(drawn["facts"], whole["facts"]) << drawn["text"];
      }
    }
    EXPECT_EQ(page.grab(0, prefix + "body/blue", {800, 300})["kept"], false);  // nothing is before
  }
  Page page;
  page.open(kTwo);
  EXPECT_EQ(page.grab(kRunEnds, "body/blue", {800, 300})["kept"], false);  // it takes no time
}

TEST(Session, AHandTurnsAndThrows) {
  Page page;
  page.open(kTwo);
  page.grab(0, "body/blue", {800, 300});
  EXPECT_EQ(page.drag({{"x", 800}, {"y", 300}, {"turn", 30}})["text"],
            with(kTwo, "velocity = [4, 0]\n", "velocity = [4, 0]\nturned = 30\n"));
  const json thrown = page.drag({{"x", 800}, {"y", 300}, {"vx", 1000}, {"vy", -500}});
  const auto way = point_at(thrown["text"], "body[1].velocity");
  EXPECT_GT(way[0], 0);
  EXPECT_NEAR(way[1], way[0] / 2, 0.1);  // y points upwards in a world
  EXPECT_EQ(thrown["text"],
            with(kTwo, "[4, 0]", value_at(thrown["text"].get<std::string>(), "body[1].velocity")));
  EXPECT_EQ(page.drag({{"x", 800}, {"y", 300}})["text"], kTwo);  // it is put down

  // Turned from where it stood when the hand came, however it was told.
  const std::string heading = with(kTwo, "oriented = true", "heading = [-1, 0]");
  page.open(heading);
  page.grab(0, "body/blue", {800, 300});
  const std::string turned = page.drag({{"x", 800}, {"y", 300}, {"turn", 15}})["text"];
  EXPECT_EQ(value_at(turned, "body[1].turned"), "105");
  EXPECT_EQ(value_at(turned, "body[1].heading"), "");
  page.open(with(kTwo, "velocity = [4, 0]", "spin = 90"));  // it turns on the spot
  page.grab(kRunEnds, "body/blue", {800, 300});
  const std::string spun = page.drag({{"x", 800}, {"y", 300}, {"turn", 15}})["text"];
  EXPECT_EQ(value_at(spun, "step[2].turned"), "105");

  // Where no time passes any more, it does for a throw.
  for (const char* body : {"body/red", "body/blue"}) {
    page.open(kTwo);
    page.grab(kRunEnds + 1, body, {800, 300});
    const json far = page.drag({{"x", 800}, {"y", 300}, {"vx", 1000}});
    const auto steps = language::parse_scenario(far["text"].get<std::string>(), "far").steps;
    EXPECT_TRUE(traits_of(steps.back().verb).passes_time) << far["text"];
    EXPECT_EQ(value_at(far["text"].get<std::string>(), "step[2].ending"), "");
  }
  // Within a run it does.
  page.open(with(kTwo, "[[step]]\ndo = \"show\"\nending = true\n", ""));
  page.grab(5, "body/red", {800, 300});
  EXPECT_EQ(value_at(page.drag({{"x", 800}, {"y", 300}, {"vx", 1000}})["text"].get<std::string>(),
                     "step[3].do"),
            "\"run\"");
  // What never moves is put down, however fast the hand is.
  page.open(kTwo);
  page.grab(0, "body/rock", {800, 300});
  const std::string put = page.drag({{"x", 700}, {"y", 300}, {"vx", 1000}})["text"];
  EXPECT_EQ(put, with(kTwo, "[60, 4]", value_at(put, "body[2].position")));
}

TEST(Session, InASolidWorldABodyFollowsInThePlaneOfThePicture) {
  Page page;
  page.open(R"(title = "Solid"
world = { size = [8, 8, 8], camera_eye = [-5.5, 6.5, -9], camera_target = [4, 3.8, 4] }
structure = { kind = "octree" }
body = [{ name = "red", radius = 0.05, position = [3, 4, 5] }]
step = [{ do = "insert", bodies = ["red"] }]
)");
  const Vec<2> before = middle_of_red(page.frame(0));
  EXPECT_EQ(page.grab(0, "body/red", before)["grabbed"], "position");
  for (const Vec<2> way : {Vec<2>(40, 0), Vec<2>(0, -35), Vec<2>(-60, 50)}) {
    const json answer = page.drag({{"x", before.x + way.x}, {"y", before.y + way.y}});
    EXPECT_LE(glm::length(middle_of_red(answer) - before - way), 1) << answer["text"];
    EXPECT_EQ(point_at(answer["text"], "body[0].position").size(), 3u);
  }
}

TEST(Session, OnASideABodyMovesOnAll) {
  const std::string text = R"(title = "Sides"
world = { size = [32, 32] }
structure = { kind = "quadtree" }
side = [{ name = "somebody", structure = { capacity = 1 } }, { name = "body" }]
body = [{ name = "red", radius = 3, position = [12, 12] }]
step = [{ do = "insert", bodies = ["red"] }]
)";
  Page page;
  const json opened = page.open(text);
  ASSERT_FALSE(opened.contains("refused")) << opened.dump();
  for (const std::string side : {"somebody", "body"}) {
    const std::string key = side + "/world/body/red";
    const Vec<2> before = Looked(page.frame(0)).middle(key);
    ASSERT_EQ(page.grab(0, side + "/body/red", before)["grabbed"], "position");
    const json answer = page.drag({{"x", before.x - 40}, {"y", before.y + 20}});
    EXPECT_LE(glm::length(Looked(answer).middle(key) - before - Vec<2>(-40, 20)), 1);
    const std::string now = answer["text"];
    EXPECT_EQ(now, with(text, "[12, 12]", value_at(now, "body[0].position")));
    EXPECT_EQ(answer["facts"][0][0]["bodies"], answer["facts"][0][1]["bodies"]);
  }
  EXPECT_TRUE(page.grab(0, "nobody/body/red").contains("refused"));
  EXPECT_TRUE(page.grab(0, "body/red").contains("refused"));
}

// As no scenario of ours is written: keys in quotes and with dots, tables in braces, steps that are
// only words, lines as in Windows, names that need signs before their signs.
std::string unusual() {
  const std::string text = R"(# [[step]] is none here
"title" = 'Anders "geschrieben" \ für x'
world.size = [ 64,
  32 ]  # [world]
'world' . time_step = 0.05
structure = { kind = """grid""", cell = 4 }
body = [ { name = "gr\u0065en new2 x", radius = 2, position = [20, 12], velocity = [4, 0] },
  {name='new1', radius = 1, 'position'=[50, 20]} ]
[[ step ]]
do = 'insert'
bodies = [ 'new1', 'green new2 x' ]
notes = """\
[[step]] \
do = "run" \
time_step = 1"""
[[step]]
'do' = "r\u0075n"
seconds = 1
every = 5  # of them
[[step]]  # the last
do = "show"
"ending" = true)";
  std::string lines = "\xef\xbb\xbf";
  for (const char c : text) lines += c == '\n' ? "\r\n" : std::string(1, c);
  return lines;
}
constexpr const char* kGreen = "body/green new2 x";

TEST(Session, WhatIsOpenedTellsOfItsScene) {
  Page page;
  const json opened = page.open(unusual());
  ASSERT_FALSE(opened.contains("refused")) << opened.dump();
  EXPECT_EQ(opened["steps"], 3);
  EXPECT_EQ(opened["frames"], 6);
  EXPECT_EQ(opened["level"], false);
  EXPECT_EQ(opened["world"], true);
  EXPECT_EQ(page.frame(0)["facts"][0][0]["leaf"], json({"cell", "cells"}));
  EXPECT_EQ(page.open(shipped("doom_level_bsp.toml"))["level"], true);
  EXPECT_EQ(page.frame(0)["facts"][0][0]["leaf"], json({"leaf", "leaves"}));
  EXPECT_EQ(page.open(shipped("ui_atlas.toml"))["world"], false);
}

TEST(Session, ATextsOwnColoursAreTold) {
  Page page;
  std::string text = shipped("ghost_quadtree.toml");
  page.open(text);
  EXPECT_EQ(page.ask({{"do", "lesson"}})["colours"], "");
  text.replace(text.find("color = "), 9, "paint = \"#123456\"");
  page.open(text);
  const std::string colours = page.ask({{"do", "lesson"}})["colours"];
  EXPECT_NE(colours.find(":#123456;"), std::string::npos) << colours;
}

// Of the frame, its bodies by name.
std::vector<std::string> cast_of(const json& frame, std::size_t side = 0) {
  std::vector<std::string> names;
  for (const json& body : frame["facts"][0][side]["bodies"]) names.push_back(body[1]);
  return names;
}

TEST(Session, BodiesComeAndGoBehindTheFrame) {
  using Names = std::vector<std::string>;
  Page page;
  page.open(unusual());
  const json added = page.ask({{"do", "add"}, {"frame", 0}});
  EXPECT_EQ(added["entity"], "body/new3");  // the second is a part of another's name
  EXPECT_EQ(added["index"], 1);
  const std::string text = added["text"];
  EXPECT_EQ(text, with(with(unusual(), " ]\r\n[[ step ]]",
                            ",\r\n  { name = \"new3\", radius = 1.6, position = " +
                                value_at(text, "body[2].position") + " } ]\r\n[[ step ]]"),
                       "\"\"\"\r\n[[step]]\r\n'do'",
                       "\"\"\"\r\n\r\n[[step]]\r\ndo = \"insert\"\r\nbodies = "
                       "[\"new3\"]\r\n[[step]]\r\n'do'"));
  ASSERT_EQ(page.open(text)["steps"], 4);
  EXPECT_EQ(cast_of(page.frame(0)).size(), 2u);
  EXPECT_EQ(cast_of(page.frame(1)), Names({"new1", "green new2 x", "new3"}));

  // The step that was the ending is none any more.
  const json removed = page.ask({{"do", "remove"}, {"frame", 6}, {"entity", kGreen}});
  EXPECT_EQ(removed["index"], 7);
  ASSERT_FALSE(page.open(removed["text"]).contains("refused")) << removed["text"];
  EXPECT_EQ(cast_of(page.frame(6)).size(), 3u);
  EXPECT_EQ(cast_of(page.frame(7)), Names({"new1", "new3"}));
  for (const char* entity : {"body/nobody", "body/", "new1", "left/body/new1"})
    EXPECT_TRUE(page.ask({{"do", "remove"}, {"frame", 7}, {"entity", entity}}).contains("refused"));
  EXPECT_TRUE(page.ask({{"do", "remove"}, {"frame", 7}, {"entity", kGreen}}).contains("refused"));

  // Into an empty world, however that is written; and no wall or body is near.
  for (const std::string& empty :
       {std::string("title = 'x'\nworld = { size = [64, 32] }\nstep = [ { do = 'show' } ]"),
        std::string("title = 'x'\nworld = { size = [64, 32] }\nbody = []\n[[step]]\ndo = 'show'"),
        std::string("title = 'x'\n[[step]]\ndo = 'show'\n[world]\nsize = [64, 32]")}) {
    ASSERT_FALSE(page.open(empty).contains("refused"));
    const std::string first = page.ask({{"do", "add"}, {"frame", 0}})["text"];
    ASSERT_FALSE(page.open(first).contains("refused")) << first;
    EXPECT_EQ(cast_of(page.frame(1)), Names({"new1"}));
    ASSERT_FALSE(page.open(page.ask({{"do", "add"}, {"frame", 1}})["text"]).contains("refused"));
    EXPECT_EQ(cast_of(page.frame(2)), Names({"new1", "new2"}));
    const json bodies = page.frame(2)["facts"][0][0]["bodies"];
    EXPECT_GT(std::abs(bodies[0][2][0].get<double>() - bodies[1][2][0].get<double>()), 10);
  }
  // On each side, and in three dimensions.
  const json two = page.open(shipped("octree_split.toml"));
  const std::string side = page.frame(0)["facts"][0][0]["name"];
  const json solid = page.ask({{"do", "add"}, {"frame", 0}});
  EXPECT_EQ(solid["entity"], side + "/body/new1");
  ASSERT_EQ(page.open(solid["text"])["steps"], two["steps"].get<int>() + 1);
  for (const std::size_t i : {0u, 1u})
    EXPECT_EQ(cast_of(page.frame(solid["index"]), i).back(), "new1");
  const json gone =
      page.ask({{"do", "remove"}, {"frame", solid["index"]}, {"entity", solid["entity"]}});
  ASSERT_FALSE(page.open(gone["text"]).contains("refused"));
  EXPECT_NE(cast_of(page.frame(gone["index"])).back(), "new1");
  // Where there is no world there is no place.
  page.open(shipped("ui_atlas.toml"));
  EXPECT_TRUE(page.ask({{"do", "add"}, {"frame", 0}}).contains("refused"));
}

TEST(Session, AFlightStopsEveryFewMomentsOfItsWorld) {
  const std::string sides =
      "\n[[side]]\nname = \"a\"\n[[side]]\nname = \"b\"\nstructure.capacity = 1\n";
  struct Flight {
    std::string text, entity;
    int frames;
    double seconds;
  };
  const std::string rarely = with(kTwo, "seconds = 1", "seconds = 1\nevery = 60");
  for (const auto& [text, entity, frames, seconds] :
       {Flight{unusual(), kGreen, 1 + 20 + 1, 0.05}, Flight{rarely, "body/red", 32, 1.0 / 30},
        Flight{rarely + sides, "a/body/red", 32, 1.0 / 30}}) {
    Page page;
    page.open(text);
    EXPECT_TRUE(page.ask({{"do", "fly"}}).contains("refused"));
    ASSERT_EQ(page.grab(0, entity, {500, 300})["grabbed"], "position") << text;
    page.drag({{"x", 510}, {"y", 300}});
    page.grab(0, entity, {500, 300});
    EXPECT_TRUE(page.ask({{"do", "fly"}}).contains("refused"));
    const json thrown = page.drag({{"x", 520}, {"y", 300}, {"vx", 300}});
    const json flight = page.ask({{"do", "fly"}});
    EXPECT_EQ(flight["frames"], frames) << flight.dump();
    EXPECT_DOUBLE_EQ(flight["seconds"], seconds);
    for (int i = 1; i + 1 < frames; ++i)
      EXPECT_NEAR(page.frame(i)["lesson"]["frames"][0]["time"], i * seconds, 1e-9);
    // It ends as that text does, which is the one that is open.
    const json last = page.frame(frames - 1);
    EXPECT_EQ(page.ask({{"do", "set"}, {"path", "title"}, {"value", "1"}})["text"],
              with_value(thrown["text"].get<std::string>(), "title", "1"));
    const json opened = page.open(thrown["text"]);
    const json whole = page.frame(opened["frames"].get<int>() - 1);
    EXPECT_EQ(last["facts"][0][0]["bodies"], whole["facts"][0][0]["bodies"]);
  }
}

TEST(Session, AHandMovesWhatIsWrittenOtherwise) {
  const std::string text = unusual();
  Page page;
  page.open(text);
  const Vec<2> before = Looked(page.frame(0)).middle(std::string("world/") + kGreen);
  ASSERT_EQ(page.grab(0, kGreen, before)["grabbed"], "position");
  const json moved = page.drag({{"x", before.x + 40}, {"y", before.y}});
  EXPECT_EQ(moved["text"],
            with(text, "[20, 12]", value_at(moved["text"].get<std::string>(), "body[0].position")));
  EXPECT_EQ(moved["steps"], 3);
  ASSERT_EQ(page.grab(2, "body/new1", {800, 300})["grabbed"], "move");
  const json later = page.drag({{"x", 700}, {"y", 300}});
  EXPECT_EQ(later["steps"], 4);
  EXPECT_EQ(page.open(later["text"])["steps"], 4);
}

TEST(Session, ATextureGrowsWithItsCorner) {
  const std::string text = shipped("kdtree_atlas.toml");
  Page page;
  page.open(text);
  EXPECT_EQ(page.grab(0, "body/A", {300, 300})["grabbed"], "size");
  const std::string larger = page.drag({{"x", 340}, {"y", 300}})["text"];
  const std::string size = value_at(larger, "texture[0].size");
  EXPECT_EQ(larger, with(text, value_at(text, "texture[0].size"), size));
  EXPECT_GT(point_at(larger, "texture[0].size")[0], point_at(text, "texture[0].size")[0]);
  EXPECT_EQ(point_at(larger, "texture[0].size")[1], point_at(text, "texture[0].size")[1]);
  EXPECT_EQ(value_at(page.drag({{"x", -9000}, {"y", -9000}})["text"].get<std::string>(),
                     "texture[0].size"),
            "[1, 1]");
  EXPECT_TRUE(page.ask({{"do", "drag"}, {"x", 1e6}, {"y", 1e6}}).contains("refused"));
}

TEST(Session, TheNearestCornerOfAWallIsHeld) {
  const std::string text = R"(title = "Walls"
[world]
size = [24, 18]
[level]
loops = [
  [[1, 1], [1.4, 1], [10, 1], [10, 10], [1, 10]],  # a room
]
[[step]]
do = "show"
)";
  Page page;
  page.open(text);
  const Looked look(page.frame(0));
  const json& wall = *std::ranges::find_if(look.rows, [](const json& row) { return row[0] == 1; });
  const Vec<2> first = Vec<2>(wall[3], wall[4]) / 100.0;
  const Vec<2> second = first + Vec<2>(wall[5], wall[6]) / 100.0;
  ASSERT_LT(glm::length(second - first), 24);  // both are near
  for (const auto& [at, path] :
       {std::pair{first, "level.loops[0][0]"}, {second, "level.loops[0][1]"}}) {
    EXPECT_EQ(page.grab(0, "", at + Vec<2>(1, 1))["grabbed"], "corner");
    const json answer = page.drag({{"x", at.x + 1}, {"y", at.y + 31}});
    const std::string now = answer["text"];
    EXPECT_NE(value_at(now, path), value_at(text, path));
    EXPECT_EQ(now, with_value(text, path, value_at(now, path)));
    const Looked moved(answer);
    EXPECT_TRUE(std::ranges::any_of(moved.rows, [&](const json& row) {
      return row[0] == 1 && glm::length(Vec<2>(row[3], row[4]) / 100.0 - at - Vec<2>(0, 30)) < 1;
    }));
  }
  EXPECT_TRUE(page.grab(0, "", {800, 30}).contains("refused"));
}

TEST(Session, WhatCannotBeHeldIsRefused) {
  Page page;
  page.open(kTwo);
  for (const char* entity :
       {"", "node/root", "body/", "body/green", "side/body/red", "pair/red|blue"})
    EXPECT_TRUE(page.grab(0, entity).contains("refused")) << entity;
  EXPECT_TRUE(page.ask({{"do", "drag"}, {"x", 1}, {"y", 1}}).contains("refused"));
  // What was held before still is, in the frame of then.
  page.grab(0, "body/red", {500, 300});
  const json before = page.drag({{"x", 520}, {"y", 300}});
  EXPECT_TRUE(page.grab(kRunEnds, "body/green").contains("refused"));
  EXPECT_EQ(page.drag({{"x", 520}, {"y", 300}}), before);
  // A place that the language refuses changes nothing either.
  const std::string bounded = with(kTwo, "radius = 3", "radius = 3\nfollow = \"blue\"");
  EXPECT_TRUE(page.open(bounded).contains("refused"));
  EXPECT_EQ(page.drag({{"x", 520}, {"y", 300}}), before);
}

TEST(Session, WhereAFrameIsGoneTheNearestIsShown) {
  const std::string text = R"(title = "Events"
world = { size = [64, 32] }
structure = { kind = "quadtree", capacity = 1, max_depth = 2 }
body = [
  { name = "red", radius = 1, position = [5, 5] },
  { name = "blue", radius = 1, position = [6, 6] },
]
[[step]]
do = "insert"
bodies = ["red", "blue"]
pace = "event"
events = ["split", "depth_limit"]
)";
  Page page;
  const json opened = page.open(text);
  ASSERT_EQ(opened["frames"], 4) << opened.dump();
  for (int frame = 0; frame < 4; ++frame) {
    ASSERT_EQ(page.grab(frame, "body/blue", {200, 500})["grabbed"], "position") << frame;
    const json far = page.drag({{"x", 1200}, {"y", 100}});
    EXPECT_EQ(far["index"], std::min(frame, 1)) << frame;
    EXPECT_EQ(far["lesson"]["frames"].size(), 1u);
  }
}

TEST(Session, RequestsThatAreNoneAreRefused) {
  Page page;
  page.open(kTwo);
  page.grab(0, "body/red", {500, 300});
  for (const std::string_view question :
       {"",
        "{",
        "[]",
        "3",
        "null",
        "\"open\"",
        "{}",
        R"({"do":3})",
        R"({"do":"fly"})",
        R"({"do":"open"})",
        R"({"do":"open","text":3,"name":"n"})",
        R"({"do":"open","text":"","name":"n"})",
        R"({"do":"open","text":"a = [","name":"n"})",
        "{\"do\":\"open\",\"text\":\"\xff\",\"name\":\"n\"}",
        R"({"do":"frame"})",
        R"({"do":"frame","index":-1})",
        R"({"do":"frame","index":62})",
        R"({"do":"frame","index":"0"})",
        R"({"do":"frame","index":0.5})",
        R"({"do":"frame","index":true})",
        R"({"do":"frame","index":-1e300})",
        R"({"do":"frame","index":18446744073709551616})",
        R"({"do":"facts","index":99999999999})",
        R"({"do":"svg","index":0,"width":0,"height":9})",
        R"({"do":"svg","index":0,"width":16,"height":-9})",
        R"({"do":"svg","index":0,"width":16})",
        R"({"do":"grab","frame":0})",
        R"({"do":"grab","frame":0,"entity":3,"x":0,"y":0})",
        R"({"do":"grab","frame":62,"entity":"body/red","x":0,"y":0})",
        R"({"do":"drag","x":"1","y":0})",
        R"({"do":"drag","x":null,"y":0})",
        R"({"do":"drag","x":NaN,"y":0})",
        R"({"do":"drag","x":1e999,"y":0})",
        R"({"do":"drag","x":1e308,"y":-1e308})",
        R"({"do":"drag","x":1,"y":1,"turn":1e308})",
        R"({"do":"drag","x":1,"y":1,"vx":-1e308})",
        R"({"do":"drag","x":true,"y":0})",
        R"({"do":"drag","x":[1],"y":0})",
        R"({"do":"set","path":"structure.capacity"})",
        R"({"do":"set","path":"","value":"3"})",
        R"({"do":"set","path":"title[0]","value":"3"})",
        R"({"do":"set","path":"title.a","value":"3"})",
        R"({"do":"set","path":"body[9].mass","value":"3"})",
        R"({"do":"set","path":"a","value":"3 4"})",
        R"({"do":"complete","text":"","line":1})",
        R"({"do":"complete","text":"","line":1,"column":-1})",
        R"({"do":"complete","text":"","line":1e300,"column":1})"}) {
    const json answer = page.ask_text(question);
    ASSERT_TRUE(answer.contains("refused")) << question << ": " << answer.dump();
    EXPECT_FALSE(answer["refused"].empty()) << question;
    EXPECT_NE(said(answer), "") << question;
  }
  EXPECT_TRUE(page.ask_text(std::string(1 << 20, '[')).contains("refused"));
  EXPECT_FALSE(page.drag({{"x", 510}, {"y", 300}}).contains("refused"));  // all is as before
}

// What a text says as the lesson does was written for another world.
class InALesson : public testing::Test {
 protected:
  InALesson() { open(lesson); }

  json open(const std::string& text) {
    return page.ask({{"do", "open"}, {"text", text}, {"name", "page.toml"}, {"lesson", lesson}});
  }
  json all(const std::string& text) {
    const json opened = open(text);
    EXPECT_FALSE(opened.contains("refused")) << opened.dump();
    return page.ask({{"do", "lesson"}});
  }
  static std::vector<std::string> captions(const json& answer) {
    std::vector<std::string> all;
    for (const json& frame : answer["lesson"]["frames"]) all.push_back(frame["caption"]);
    return all;
  }
  // Somewhere on the pictures.
  static bool writes(const json& answer, const std::string& words) {
    return std::ranges::any_of(answer["lesson"]["texts"],
                               [&](const json& text) { return text[0] == words; });
  }

  const std::string lesson = R"(title = "Two discs"
panels = ["world", "tree", "chart"]
[world]
size = [64, 32]
[chart]
bars = "pairs"
[structure]
kind = "quadtree"
capacity = 1
[[body]]
name = "red"
radius = 3
position = [20, 12]
[[body]]
name = "blue"
radius = 3
position = [44, 20]
[[step]]
do = "insert"
name = "in"
bodies = ["red", "blue"]
plot = "far away"
caption = "They are apart: {pairs:pair}."
question = "How many?"
answer = "There are {pairs:pair}."
lit = ["red"]
expect = { bodies = 2 }
note = [{ text = "here is red", body = "red" }]
[[step]]
do = "show"
name = "end"
caption = "So they stay: {pairs:pair}."
plot = "later"
ending = true
)";
  const std::string moved = with(lesson, "[20, 12]", "[40, 18]");
  Page page;
};

TEST_F(InALesson, AnotherWorldKeepsItsOwnWordsAlone) {
  const json first = all(lesson);
  EXPECT_EQ(captions(first),
            (std::vector<std::string>{"They are apart: 0 pairs.", "So they stay: 0 pairs."}));
  EXPECT_TRUE(writes(first, "here is red") && writes(first, "far away") && writes(first, "later"));
  EXPECT_EQ(first["like"], json::parse("[[0,1],[1,1]]"));

  const json other = all(moved);
  EXPECT_EQ(captions(other), (std::vector<std::string>{"", ""}));
  EXPECT_EQ(other["questions"], json::parse(R"([["How many?", "", 0, ""]])"));
  EXPECT_FALSE(writes(other, "here is red") || writes(other, "far away"));
  EXPECT_TRUE(writes(other, "step 1"));
  EXPECT_EQ(other["like"], json::parse("[[0,0],[1,0]]"));

  const json told = all(with(with(moved, "So they stay", "They meet"), "here is red", "red came"));
  EXPECT_EQ(captions(told), (std::vector<std::string>{"", "They meet: 1 pair."}));
  EXPECT_TRUE(writes(told, "red came"));
  EXPECT_EQ(told["like"], json::parse("[[0,0],[1,1]]"));
}

TEST_F(InALesson, TheSameWorldIsToldAsBefore) {
  const json told = all(with(lesson, "So they stay", "Still"));
  EXPECT_EQ(captions(told),
            (std::vector<std::string>{"They are apart: 0 pairs.", "Still: 0 pairs."}));
  EXPECT_TRUE(writes(told, "here is red") && writes(told, "far away"));
}

TEST_F(InALesson, AStepThatWasAddedIsLikeNoneAndThoseBehindItAreAsBefore) {
  const std::string added =
      "[[step]]\ndo = \"move\"\nbody = \"red\"\nto = [9, 9]\n[[step]]\ndo = \"show\"";
  EXPECT_EQ(all(with(lesson, "[[step]]\ndo = \"show\"", added))["like"],
            json::parse("[[0,0],[-1,0],[1,0]]"));
}

TEST_F(InALesson, WhatAHandMovesIsToldInItsOwnWords) {
  page.grab(0, "body/red", {400, 300});
  const json dragged = page.drag({{"x", 430}, {"y", 310}});
  EXPECT_EQ(captions(dragged), std::vector<std::string>{""});
  EXPECT_FALSE(writes(dragged, "here is red") || writes(dragged, "later"));
  EXPECT_EQ(dragged["like"], json::parse("[[0,0]]"));
}

TEST_F(InALesson, ATreeKeepsTheRoomThatTheLessonsHas) {
  const auto root = [](const json& answer) { return Looked(answer).shapes_of("tree/node/root"); };
  const auto before = root(page.frame(1));
  const json opened = open(with(lesson, "capacity = 1", "capacity = 2"));
  ASSERT_FALSE(opened.contains("refused")) << opened.dump();
  const auto now = root(page.frame(1));
  ASSERT_FALSE(now.empty());
  const auto place = [](const std::string& shape) {
    const json row = json::parse(shape);
    return std::vector<int>{row[3], row[4], row[6]};
  };
  EXPECT_EQ(place(now[0]), place(before[0]));
}

TEST_F(InALesson, APictureIsAsLargeAsThePageAsks) {
  json question = {
      {"do", "open"}, {"text", lesson}, {"name", "n"}, {"width", 900}, {"height", 1200}};
  page.ask(question);
  EXPECT_EQ(page.frame(0)["lesson"]["page"], json::parse("[90000, 120000]"));
  question["width"] = 20;
  EXPECT_EQ(said(page.ask(question)), "a page is 300 to 5000 units wide and high");
}

}  // namespace
}  // namespace lantern::live
