// A lesson page holds what was drawn: its JSON is decoded here as the page decodes it.
#include "publish/lesson.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "language/words.hpp"
#include "publish/lesson_frames.hpp"
#include "publish/packed.hpp"

namespace lantern::publish {
namespace {

using nlohmann::json;

// A body that moves, a cell that comes, words that stand.
DrawList picture(double x, bool with_cell) {
  DrawList list;
  {
    const DrawList::Scope words(list, "page/words");
    list.shapes.emplace_back(TextShape{"A tile", {60, 52}, 26, Weight::semibold, 0.5});
  }
  list.crisp_rect({{20, 90}, {800, 700}}, Role::panel, {Role::rule, 1.6});
  if (with_cell) {
    const DrawList::Scope cell(list, "tree/node/root.0", "tree/node/root");
    list.rect({{100, 100}, {150, 140}}, Role::panel, {Role::cell_line_1, 2, 5.5}, 6);
  }
  const DrawList::Scope body(list, "world/body/ann");
  list.disc({x, 300}, 20.004, body_role(1), {Role::body_line, 2});
  list.polygon({{x, 310}, {x + 7.25, 320}, {x - 7.25, 320}}, Role::pupil);
  list.crisp_line({x, 300}, {x + 40, 300}, {Role::ray, 3});
  return list;
}

Frame frame_of(std::uint32_t index) {
  Frame frame;
  frame.index = frame.step = index;
  frame.caption = fmt::format("Caption {}", index);
  FrameBody& body = frame.bodies.emplace_back();
  body.id = 7;
  body.name = "ann";
  body.position = {1.5, 2, 0};
  FrameNode& root = frame.nodes.emplace_back();
  root.label = "root";
  root.box = {{0, 0, 0}, {8, 4, 0}};
  root.bodies = {7};
  frame.add_count("pairs", 3);
  return frame;
}

// The lists of rows, as lesson_data.js makes them.
std::vector<std::vector<std::size_t>> lists_of(const json& lesson) {
  std::vector<std::vector<std::size_t>> lists;
  std::vector<std::size_t> before;
  std::size_t known = 0;
  for (const json& frame : lesson["frames"]) {
    std::vector<std::size_t> list;
    const json& rows = frame["rows"];
    for (std::size_t i = 0; i < rows.size(); i += 2) {
      const int from = rows[i];
      if (from == -2) list.push_back(rows[i + 1]);
      for (int k = 0; from != -2 && k < rows[i + 1].get<int>(); ++k)
        list.push_back(from == -1 ? known++ : before.at(static_cast<std::size_t>(from + k)));
    }
    lists.push_back(list);
    before = list;
  }
  return lists;
}

double length(const json& number) { return number.get<double>() / 100; }

// The shape of a row, as far as it is drawn.
DrawShape shape_of(const json& lesson, const json& row) {
  const json& style = lesson["styles"][row[2].get<std::size_t>()];
  const Role fill{style[0].get<std::uint8_t>()};
  const Stroke stroke{Role{style[1].get<std::uint8_t>()}, length(style[2]), length(style[3])};
  const bool snapped = style[4] == 1;
  const Vec<2> at{length(row[3]), length(row[4])};
  const Vec<2> way = row.size() > 6 ? Vec<2>(length(row[5]), length(row[6])) : Vec<2>(0.0);
  switch (row[0].get<int>()) {
    case 0:
      return RectShape{{at, at + way}, length(row[7]), fill, stroke, snapped};
    case 1:
      return LineShape{at, at + way, stroke, snapped};
    case 2: {
      PolygonShape polygon{{}, fill, stroke};
      Vec<2> pen{0.0};
      for (std::size_t i = 3; i < row.size(); i += 2)
        polygon.points.push_back(pen += Vec<2>(length(row[i]), length(row[i + 1])));
      return polygon;
    }
    default:
      return TextShape{lesson["texts"][row[6].get<std::size_t>()][0],
                       at,
                       length(row[5]),
                       Weight::regular,
                       0,
                       fill,
                       stroke.role};
  }
}

// Measures, roles and words are the same, but for what is below a hundredth of a unit.
void expect_same(DrawShape drawn, DrawShape told) {
  ASSERT_EQ(drawn.index(), told.index());
  const auto measures = [](DrawShape& shape) {
    std::vector<double> all;
    std::visit([&](auto& s) { for_each_measure(s, [&](double m) { all.push_back(m); }); }, shape);
    return all;
  };
  const auto expected = measures(drawn), found = measures(told);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(expected[i], found[i], 0.011);
  const auto roles = [](const DrawShape& shape) {
    std::vector<Role> all;
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { s.fill; }) all.push_back(s.fill);
          if constexpr (requires { s.stroke; }) all.push_back(s.stroke.role);
          if constexpr (requires { s.text; }) all.push_back(s.role), all.push_back(s.halo);
        },
        shape);
    return all;
  };
  EXPECT_EQ(roles(drawn), roles(told));
  if (const auto* text = std::get_if<TextShape>(&drawn)) {
    EXPECT_EQ(text->text, std::get<TextShape>(told).text);
  }
}

class LessonFramesTest : public testing::Test {
 protected:
  void SetUp() override {
    for (std::uint32_t i = 0; i < lists_.size(); ++i) frames_.add(frame_of(i), lists_[i], {});
    lesson_ = json::parse(frames_.json());
  }

  std::array<DrawList, 3> lists_{picture(200, false), picture(260.5, true), picture(260.5, true)};
  LessonFrames frames_;
  json lesson_;
};

TEST_F(LessonFramesTest, HoldsEveryShapeOfEveryFrameInOrder) {
  const auto lists = lists_of(lesson_);
  ASSERT_EQ(lists.size(), lists_.size());
  for (std::size_t f = 0; f < lists.size(); ++f) {
    ASSERT_EQ(lists[f].size(), lists_[f].shapes.size());
    for (std::size_t i = 0; i < lists[f].size(); ++i)
      expect_same(lists_[f].shapes[i], shape_of(lesson_, lesson_["rows"][lists[f][i]]));
  }
}

TEST_F(LessonFramesTest, TellsAShapeOnceAndWhatItShows) {
  EXPECT_EQ(lesson_["rows"].size(), 5u + 4u);  // the body is elsewhere, the cell is new
  EXPECT_EQ(lesson_["frames"][2]["rows"].dump(), "[0,6]");
  EXPECT_EQ(lesson_["frames"][2]["way"].dump(), "[-6,0]");
  std::vector<std::string> keys;
  for (const json& key : lesson_["keys"]) keys.push_back(key.dump());
  EXPECT_EQ(keys, (std::vector<std::string>{R"([""])", R"(["page/words"])",
                                            R"(["world/body/ann","body/ann"])",
                                            R"(["tree/node/root.0","node/root.0"])"}));
}

// Each shape of the picture before, and of this one, has its passage; what moves has both.
TEST_F(LessonFramesTest, TellsTheWayAsTheInBetweensGoIt) {
  const json& way = lesson_["frames"][1]["way"];
  const std::vector<Passage> expected = passages(lists_[0], lists_[1]);
  std::int64_t a = -1, b = -1;
  std::size_t next = 0;
  for (std::size_t i = 0; i < way.size();) {
    const std::int64_t word = way[i++];
    if (word < 0) {
      for (std::int64_t k = 0, first = way[i++]; k < -word; ++k)
        EXPECT_EQ(*expected.at(next++).b, static_cast<std::size_t>(first + k));
      continue;
    }
    const json& kind = lesson_["kinds"].at(static_cast<std::size_t>(word));
    const Passage& p = expected.at(next++);
    ASSERT_EQ(kind[0] == 1, p.a.has_value());
    ASSERT_EQ(kind[1] == 1, p.b.has_value());
    if (p.a) {
      EXPECT_EQ(a += way[i++].get<std::int64_t>(), static_cast<std::int64_t>(*p.a));
    }
    if (p.b) {
      EXPECT_EQ(b += way[i++].get<std::int64_t>(), static_cast<std::int64_t>(*p.b));
    }
    EXPECT_EQ(kind[2], static_cast<int>(p.move));
    EXPECT_EQ(kind[3], static_cast<int>(p.fade));
    EXPECT_EQ(kind[4] == 1, p.leaves);
    if (kind[5] == 1) {
      EXPECT_LT(way[i++].get<std::size_t>(), lesson_["places"].size());
    }
  }
  EXPECT_EQ(next, expected.size());
}

TEST(LessonEntities, SayOfWhomAThingIs) {
  Frame frame = frame_of(0);
  frame.bodies.emplace_back().id = 9;
  const auto of = [&](const char* key) {
    return fmt::format("{}", fmt::join(entities_of(key, frame), " "));
  };
  EXPECT_EQ(of("world/body/ann"), "body/ann");
  EXPECT_EQ(of("world/velocity/#9"), "body/#9");
  EXPECT_EQ(of("world/pair/#9/ann"), "pair/#9|ann");
  EXPECT_EQ(of("world/pair/#9/ann/boxes"), "pair/#9|ann");
  EXPECT_EQ(of("world/contact/7/9"), "pair/#9|ann");
  EXPECT_EQ(of("ledger/7-9"), "pair/#9|ann");
  EXPECT_EQ(of("ledger/body/7"), "body/ann");
  EXPECT_EQ(of("sweep/9"), "body/#9");
  EXPECT_EQ(of("pool/4"), "slot/4");
  EXPECT_EQ(of("world/cell name/root.1"), "node/root.1");
  EXPECT_EQ(of("tree/body/ann/root.1"), "body/ann node/root.1");
  EXPECT_EQ(of("ledger/key/2"), "");
  EXPECT_EQ(of("page/words"), "");
  frame.sides.push_back(frame_of(0));
  frame.sides[0].add<FrameSide>().name = "eager";
  EXPECT_EQ(of("eager/world/body/ann"), "eager/body/ann");
}

TEST(LessonFacts, SayWhereACellLiesOnThePage) {
  DrawList list;
  list.maps.push_back({"", {{100, 100}, {900, 500}}, {100, 500}, 100});
  Frame frame = frame_of(0);
  frame.bounds = {{0, 0, 0}, {1, 4, 0}};
  EXPECT_EQ(json::parse(facts_for_page(frame, list))[0]["bodies"][0][4], "outside");
  frame.bounds.hi.x = 8;
  const json facts = json::parse(facts_for_page(frame, list));
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_EQ(facts[0]["counts"].dump(), R"([["pairs",3]])");
  EXPECT_EQ(facts[0]["bodies"].dump(), R"([[7,"ann",[1.5,2],0,""]])");
  EXPECT_EQ(facts[0]["nodes"].dump(),
            R"([["root","root",0,1,[7],[100,500,900,500,900,100,100,100],-1]])");
}

TEST(LessonFrames, TellWhichFrameIsTheEnding) {
  LessonFrames frames;
  Frame frame = frame_of(0);
  frames.add(frame, picture(200, true), {});
  EXPECT_EQ(frames.json().find("\"ending\""), std::string::npos);
  frame.ending = true;
  frames.add(frame, picture(200, true), {});
  EXPECT_NE(frames.json().find("\"ending\": true"), std::string::npos) << frames.json();
}

TEST(Lesson, AsksWhatItsFramesAnswer) {
  Lesson asks({"a", "A", "", 3, {}, 2}, "light"), silent({"a", "A", "", 3, {}, 2}, "light");
  for (std::uint32_t i = 0; i < 2; ++i) {
    Frame frame = frame_of(i);
    silent.add(frame, picture(200, true), {});
    if (i == 1) frame.add<FrameQuestion>() = FrameQuestion{"Is 1 < 2?", "3 pairs & more."};
    asks.add(frame, picture(200, true), {});
  }
  const std::string page = asks.html();
  EXPECT_NE(page.find("<summary>Is 1 &lt; 2?</summary>\n<p>3 pairs &amp; more. <a href=\"#1\">"),
            page.npos);
  EXPECT_NE(page.find("<button id=\"question\""), page.npos);
  EXPECT_EQ(silent.html().find("<button id=\"question\""), page.npos);
  const std::size_t from = page.find("id=\"card\">") + 10;
  const auto card = lesson_card(page.substr(from, page.find("</script>", from) - from));
  ASSERT_TRUE(card);
  ASSERT_EQ(card->questions.size(), 1u);
  EXPECT_EQ(card->questions[0].asked, "Is 1 < 2?");
  EXPECT_EQ(card->questions[0].frame, 1u);
  const std::string older = R"({"format": "lantern.lesson/1", "scenario": "a", "title": "A",
    "idea": "", "lecture": null, "needs": [], "steps": 1, "frames": 1})";
  ASSERT_TRUE(lesson_card(older)) << "a page of before";
  EXPECT_TRUE(lesson_card(older)->questions.empty());
}

TEST(Lesson, SaysItsFixedWordsInItsLanguage) {
  Lesson lesson({"a", "A", "", 3, {}, 1}, "light");
  lesson.add(frame_of(0), picture(200, true), {});
  const auto german = language::words_in("de");
  const Speaking speaking(german.get());
  EXPECT_NE(lesson.html().find("alt=\"Der erste Frame.\""), std::string::npos);
}

TEST(Lesson, KeepsWhatAUserWroteOutOfItsMarkup) {
  const std::string nasty = "</script><b onload=\"x('y')\">&amp; 日本 {{script}}";
  Lesson lesson({"a", nasty, nasty, 3, {"b"}, 1}, "light");
  Frame frame = frame_of(0);
  frame.caption = nasty;
  lesson.add(frame, picture(200, true), {nasty, {nasty}});
  const std::string page = lesson.html();
  EXPECT_EQ(page.find("<b onload"), page.npos);
  EXPECT_NE(page.find("<title>&lt;/script&gt;&lt;b onload=&quot;x('y')&quot;&gt;&amp;amp; "
                      "日本 {{script}}</title>"),
            page.npos);
  std::size_t ends = 0;
  for (std::size_t at = 0; (at = page.find("</script>", at)) != page.npos; ++at) ++ends;
  EXPECT_EQ(ends, 5u);
  for (const char* outside : {"http://", "https://", "src=\"/", "url("})
    for (std::size_t at = 0; (at = page.find(outside, at)) != page.npos; ++at)
      EXPECT_EQ(page.compare(at, 23, "http://www.w3.org/2000/"), 0) << page.substr(at, 60);
  const std::size_t from = page.find("id=\"card\">") + 10;
  const auto card = lesson_card(page.substr(from, page.find("</script>", from) - from));
  ASSERT_TRUE(card);
  EXPECT_EQ(card->title, nasty);
  EXPECT_EQ(card->needs, std::vector<std::string>{"b"});
  EXPECT_EQ(card->frames, 1u);
}

TEST(Packed, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfb"), "//77");
}

}  // namespace
}  // namespace lantern::publish
