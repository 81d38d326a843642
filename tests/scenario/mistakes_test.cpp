// What a user is told: every mistake at once, each at its place, with what to do.
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "language/language.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

namespace fs = std::filesystem;

const std::string kScene = R"(title = "x"
[world]
size = [64, 64]
[structure]
kind = "quadtree"
[[body]]
name = "red"
radius = 1
position = [1, 1]
[[body]]
name = "pink"
radius = 1
position = [2, 2]
[[pattern]]
name = "dot"
count = 3
radius = 1
)";

const std::string kAtlasScene = R"(title = "x"
[atlas]
size = [64, 64]
[[texture]]
name = "A"
size = [8, 8]
[[texture_pattern]]
name = "t"
count = 3
min = [8, 8]
max = [8, 8]
)";

TEST(Mistakes, AreAllToldInOnePassInOrder) {
  expect_mistakes(
      R"(title = "x"
@sead = 3
[world]
size = [64, @nan]
time_step = @"fast"
[structure]
kind = @"quadtre"
@capcity = 2
max_depth = @99
@[[body]]
name = @"red/blue"
look = @"gost"
radius = @-1
@[[body]]
name = "pink"
half_size = [1, 1]
[[step]]
do = "insert"
bodies = ["pink", @"pnik"]
@captoin = "x"
[[step]]
do = @"inserrt"
)",
      {"did you mean 'seed'?", "must be finite", "must be a number", "did you mean 'quadtree'?",
       "did you mean 'capacity'?", "0 to 32", "add position = [1.5, 2]", "cannot be",
       "did you mean 'ghost'?", "0 to 1000000000", "[[body]] has no 'position'",
       "did you mean 'pink'?", "did you mean 'caption'?", "did you mean 'insert'?"});
}

TEST(Mistakes, CarryTheLineAndTheFile) {
  const auto found = mistakes("title = \"x\"\n  sead = 2\r\n[[step]]\ndo = \"show\"\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].source_line, "  sead = 2") << "without the line break";
  EXPECT_TRUE(
      to_string(found[0]).starts_with("ghosts.toml:2:3: error: unknown key 'sead'\n"
                                      "    sead = 2\n"
                                      "    ^\n"
                                      "  did you mean 'seed'? known here: title, "))
      << to_string(found[0]);
}

TEST(Mistakes, OfAWrongPlaceTellTheRightOne) {
  expect_mistakes(kScene + "@title = \"late\"\n[[step]]\ndo = \"show\"\n",
                  {"belongs at the top of the file"});
  expect_mistakes(kScene + "[[step]]\ndo = \"show\"\n@bodies = [\"red\"]\n",
                  {"'bodies' belongs to do = \"insert\""});
  expect_mistakes("title = \"x\"\n[world]\nsize = [1, 1]\n@capacity = 2\n[[step]]\ndo = \"show\"\n",
                  {"'capacity' belongs to [structure]"});
}

TEST(Mistakes, AnUnknownVerbIsToldAlone) {
  expect_mistakes(kScene + steps({"do = @\"insret\"\nbodies = [\"red\"]",
                                  "do = \"move\"\nbody = \"red\"\nto = [2, 2]",
                                  "do = \"ray\"\nfrom = [0, 0]\nto = [9, 9]",
                                  "do = \"remove\"\nbodies = [\"red\"]\n"
                                  "expect = { hits = 1, bodies = 0 }"}),
                  {"did you mean 'insert'?"});
}

TEST(Mistakes, AnUnknownNameIsToldOnce) {
  expect_mistakes(kScene + steps({"do = \"insert\"\nbodies = [@\"rde\", \"pink\"]",
                                  "do = \"move\"\nbody = \"red\"\nto = [2, 2]",
                                  "do = \"show\"\nexpect = { position = { rde = [2, 2] } }",
                                  "do = \"remove\"\nbodies = [\"rde\"]"}),
                  {"there is no body 'rde', here and 2 times more"});
}

TEST(Mistakes, BeyondFiftyAreCounted) {
  std::string text = "title = \"x\"\n";
  for (int i = 0; i < 70; ++i) text += "wrong" + std::to_string(i) + " = 1\n";
  const auto found = mistakes(text + "[[step]]\ndo = \"show\"\n");
  ASSERT_EQ(found.size(), 51u);
  EXPECT_EQ(found[49].where.line, 51);
  EXPECT_EQ(found[50].message, "and 20 more mistakes");
  EXPECT_EQ(found[50].where.line, 52) << "where the others begin";
}

TEST(Mistakes, OfAFileOfNothingElseAreSortedAndCountedAllTheSame) {
  std::string text = "title = \"x\"\n[[step]]\ndo = \"show\"\n";
  for (int i = 0; i < 9000; ++i) text += "wrong" + std::to_string(i) + " = 1\n";
  const auto found = mistakes(text);
  ASSERT_EQ(found.size(), 51u);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(found[i].where.line, static_cast<int>(i) + 4);
  EXPECT_EQ(found[50].message, "and 8950 more mistakes");
}

// --- no TOML at all ---

TEST(Mistakes, OfSyntaxAreSaidPlainly) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"title @\"x\"", "a '=' is missing"},
      {"title = @x", "a text stands in \"quotes\""},
      {"title = @True", "write true or false, in small letters"},
      {"title = \"x@", "the file ends inside a text"},
      {"title = \"x\"\ntitle = @\"y\"", "'title' is there already"},
      {"[world]\n@[world]", "'world' is there already"},
      {"seed = 1 @2", "goes on behind its value"},
      {"panels = [\"a\" @\"b\"]", "need a comma between"},
      {"panels = [\"a\"@", "a ']' is missing"},
      {"[world@", "the file ends inside a [header]"},
      {"seed = 01@", "may not begin with 0"},
      {"seed = @.5", "write 0.5, not .5"},
      {"seed =@", "the file ends where a value is needed"},
      {"seed@\nname = 1", "has a name but no value"},
      {"title = @“x”", "only in a \"text\""},
      {"gr@öße = 1", "only in a \"text\""},
      {"@[.world]", "a [header] without a name"},
      {"@[[[world]]", "a [header] without a name"},
      {"@= 1", "a line begins with a key"},
      {"x = [@}]", "in a list that is not closed"},
      {"x = { a = 1@\n}", "must stand on one line"},
      {"x = { a = 1, @}", "no comma may stand before '}'"},
      {"seed = 99999999999999999999@", "too large"},
      {"title = \"a\\@q\"", "an unknown \\ sequence"},
      {"seed = 4@x", "a value is a number, a \"text\", true"},
      {"seed = 1_@_0", "this is no number"},
      {"seed = n@ul", "this is no value"},
      {"seed = inf@f", "this is no value"},
      {"seed = 1979-13@-01", "no such date"},
      {"x = [1,@,2]", "a value is missing before this comma"},
      {"x = { a =@}", "a value is missing"},
      {"x = { a = 1 @b = 2 }", "two pairs in { } need a comma"},
  };
  for (const auto& [text, words] : cases) {
    SCOPED_TRACE(text);
    expect_mistakes(text, {words});
  }
}

TEST(Mistakes, OfBytesAreFoundAtTheirPlace) {
  expect_mistakes(std::string("title = \"x@\0y\"", 14), {"a NUL byte"});
  expect_mistakes("title = \"x\"\nsource = \"@\xff\"", {"bytes that are not UTF-8"});
  expect_mistakes("title = \"ö@\xc3\"", {"bytes that are not UTF-8"});
  expect_mistakes("title = \"@\xed\xa0\x80\"", {"bytes that are not UTF-8"});
  expect_mistakes("title = \"@\xc0\xaf\"", {"bytes that are not UTF-8"});
  expect_mistakes("title = \"@\xf4\x90\x80\x80\"", {"bytes that are not UTF-8"});
}

TEST(Mistakes, ColumnsCountLettersNotBytes) {
  expect_mistakes("title = \"x\"\nsource = \"äöü\" @q = 1", {"goes on behind its value"});
  expect_mistakes(
      "title = \"x\"\n[[step]]\ndo = \"show\"\ncaption = \"Gespenster: äöü @{nodse}\"\n",
      {"cannot quote 'nodse'"});
}

TEST(Mistakes, OfNestingDoNotOverflowTheStack) {
  for (const std::string open : {"[", "{a=", "{a.b.c.d.e.f.g.h="}) {
    std::string text = "x = ";
    while (text.size() < 1'000'000) text += open;
    EXPECT_EQ(mistakes(text).size(), 1u) << open;
  }
  std::string dotted = "a";
  while (dotted.size() < 1'000'000) dotted += ".a";
  EXPECT_EQ(mistakes(dotted + " = 1").size(), 1u);
  EXPECT_EQ(mistakes("[" + dotted + "]").size(), 1u);
  expect_mistakes("a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p@.q = 1", {"more than 16 parts"});
  // What stands in a text or a comment is no nesting.
  good(
      "title = \"1.2.3.4.5.6.7.8.9.10.11.12.13.14.15.16.17.18\" # "
      "a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r\n"
      "[[step]]\ndo = \"show\"\n");
}

TEST(Mistakes, OfVeryManyDottedKeysAreFoundInGoodTime) {
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += "k" + std::to_string(i) + ".a = 1\n";
  const auto found = mistakes(text);
  ASSERT_EQ(found.size(), 1u) << "toml++ would search 200000 tables 200000 times";
  EXPECT_EQ(found[0].message, "more than 40000 dots in keys");
}

TEST(Mistakes, AByteOrderMarkAndWindowsLineBreaksAreFine) {
  EXPECT_EQ(good("\xef\xbb\xbftitle = \"x\"\r\n[[step]]\r\ndo = \"show\"\r\n").title, "x");
  const auto found = mistakes("\xef\xbb\xbftitel = \"x\"\n[[step]]\ndo = \"show\"\n");
  ASSERT_EQ(found.size(), 2u) << shown(found);
  EXPECT_EQ(found[0].where.column, 1);
  EXPECT_EQ(found[0].source_line, "titel = \"x\"") << "the mark is no part of the line";
}

TEST(Mistakes, OfAnEmptyFileTellTheLeastScenario) {
  for (const std::string text : {"", " \n\t\r\n", "\xef\xbb\xbf"}) {
    const auto found = mistakes(text);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].message, "the file is empty");
    EXPECT_NE(found[0].suggestion.find("title"), std::string::npos);
    EXPECT_NE(found[0].suggestion.find("[[step]]"), std::string::npos);
  }
  expect_mistakes("@@# only a comment\n", {"no 'title'", "no 'step'"});
  expect_mistakes("title = \"x\"\nstep = @[]\n", {"has no step"});
}

// --- files ---

fs::path folder() {
  const fs::path path = fs::path(LANTERN_TEST_OUTPUT) / "mistakes";
  fs::create_directories(path);
  return path;
}

TEST(Mistakes, OfFilesThatCannotBeReadAreIoErrors) {
  EXPECT_THROW(load_scenario("no/such/file.toml"), IoError);
  EXPECT_THROW(load_scenario("/"), IoError);
  EXPECT_THROW(load_scenario("/dev/zero"), IoError) << "a device never ends";
}

TEST(Mistakes, AHugeFileIsRefusedUnread) {
  const fs::path file = folder() / "huge.toml";
  std::ofstream(file).close();
  ASSERT_EQ(::truncate(file.c_str(), off_t{1} << 40), 0) << "a sparse file: reading it would fail";
  try {
    load_scenario(file.string());
    ADD_FAILURE() << "a file of a terabyte was read";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("1099511627776 bytes, the limit is 4194304"),
              std::string::npos)
        << error.what();
  }
  fs::remove(file);
  EXPECT_THROW(parse_scenario(std::string(kMostFileBytes + 1, '#'), "x.toml"), ScenarioError);
}

TEST(Mistakes, TheFileNamesTheScenarioIfItCan) {
  const std::string text = "title = \"x\"\n[[step]]\ndo = \"show\"\n";
  EXPECT_EQ(parse_scenario(text, "a/b/ghosts_2.toml").name, "ghosts_2");
  EXPECT_EQ(parse_scenario(text, "a/Ghost Tree (2).toml").name, "ghost_tree_2")
      << "a name with spaces would make a folder with spaces";
  EXPECT_EQ(parse_scenario("name = \"g\"\n" + text, "a/Ghost Tree (2).toml").name, "g");
  EXPECT_THROW(parse_scenario(text, ""), ScenarioError);
  EXPECT_THROW(parse_scenario(text, ".."), ScenarioError);
  EXPECT_THROW(parse_scenario(text, "日本.toml"), ScenarioError);
}

// --- things that belong together ---

TEST(Mistakes, OfAWorldsExtent) {
  const std::string rest = "[[step]]\ndo = \"show\"\n";
  expect_mistakes("title = \"x\"\n[world]\n@min = [0, 0]\n" + rest, {"no 'max'"});
  expect_mistakes("title = \"x\"\n[world]\n@max = [0, 0]\n" + rest, {"no 'min'"});
  expect_mistakes("title = \"x\"\n[world]\nmin = [0, 0]\nmax = @[1, 0]\n" + rest, {"at least"});
  expect_mistakes("title = \"x\"\n[world]\nmin = [0, 0]\nmax = @[-1, 1]\n" + rest, {"upper right"});
  expect_mistakes("title = \"x\"\n[world]\nsize = [1, 1]\n@min = [0, 0]\nmax = [1, 1]\n" + rest,
                  {"one of them is enough"});
  const Box<3> box =
      good("title = \"x\"\n[world]\nmin = [-1, -2]\nmax = [3, 4]\n" + rest).world.bounds;
  EXPECT_EQ(box, (Box<3>{{-1, -2, 0}, {3, 4, 0}}));
}

TEST(Mistakes, OfWhatIsMissingAround) {
  const std::string step = "[[step]]\ndo = \"show\"\n";
  const std::string red = "[[body]]\nname = \"red\"\nradius = 1\nposition = [1, 1]\n";
  expect_mistakes("title = \"x\"\n@" + red + step, {"bodies need a [world]"});
  expect_mistakes("title = \"x\"\n@[structure]\nkind = \"quadtree\"\n" + step, {"needs a [world]"});
  expect_mistakes(
      "title = \"x\"\n[world]\nsize = [1, 1]\n@[structure]\nkind = \"quadtree\"\n" + step,
      {"needs bodies"});
  expect_mistakes("title = \"x\"\n@[[texture]]\nname = \"A\"\nsize = [1, 1]\n" + step,
                  {"textures need an [atlas]"});
  expect_mistakes(kScene + "@[atlas]\nsize = [8, 8]\n" + step, {"not both"});
  expect_mistakes("title = \"x\"\n[[step]]\ndo = @\"run\"\nseconds = 1\n", {"needs a [world]"});
  expect_mistakes("title = \"x\"\n[[step]]\ndo = @\"pack\"\ntextures = [\"A\"]\n",
                  {"add [atlas] with size"});
  expect_mistakes(kAtlasScene + "[[step]]\ndo = @\"insert\"\nbodies = [\"A\"]\n",
                  {"an atlas knows pack, ask_room and draw"});
  expect_mistakes("title = \"x\"\n@[[step]]\nname = \"a\"\n[[step]]\ndo = \"show\"\n",
                  {"a step has no 'do'"});
}

TEST(Mistakes, BringAboutNoOthers) {
  const std::string red = "[[body]]\nname = \"red\"\nradius = 1\nposition = [1, 1]\n";
  const std::string insert = "[[step]]\ndo = \"insert\"\nbodies = [\"red\"]\n";
  const std::string quote = "caption = \"{pairs:pair}\"\nexpect = { nodes = 1 }\n";
  const std::string world = "title = \"x\"\n[world]\nsize = [9, 9]\n";
  expect_mistakes(world + "[structure]\nkind = @\"quadtre\"\n" + red + insert + quote,
                  {"'quadtree'"});
  expect_mistakes(world + "@[structure]\ncapacity = 2\n" + red + insert + quote, {"no 'kind'"});
  expect_mistakes(world + red + insert + "[[step]]\ndo = \"rebuild\"\nkind = @\"bps\"\n" + quote,
                  {"cannot be 'bps'"});
  expect_mistakes("title = \"x\"\nworld = @3\n" + red + insert, {"must be a table"});
  expect_mistakes(
      "title = \"x\"\natlas = @3\n[[texture]]\nname = \"A\"\nsize = [8, 8]\n"
      "[[step]]\ndo = \"pack\"\ntextures = [\"A\"]\n",
      {"must be a table"});
  expect_mistakes(world +
                      "[structure]\nkind = \"quadtree\"\n[[body]]\nname = \"red\"\n"
                      "radius = @\"big\"\nposition = [1, 1]\nvelocity = [1, 0]\n" +
                      insert + quote,
                  {"must be a number"});
}

// Whatever names what would be in it is not told.
TEST(Mistakes, OfATablesNameAreToldAlone) {
  const std::string bodies =
      "[[body]]\nname = \"red\"\nradius = 1\nposition = [1, 1]\n"
      "[[pattern]]\nname = \"dot\"\ncount = 3\nradius = 1\n";
  const std::string world = "title = \"x\"\n[world]\nsize = [9, 9]\n";
  const std::string insert =
      "[[step]]\ndo = \"insert\"\nbodies = [\"red\", \"dot\"]\nexpect = { bodies = 4 }\n";
  expect_mistakes("title = \"x\"\n[@wordl]\nsize = [9, 9]\n" + bodies + insert,
                  {"did you mean 'world'?"});
  expect_mistakes(world + "[[@bodies]]\nname = \"red\"\nradius = 1\nposition = [1, 1]\n" + insert,
                  {"did you mean 'body'?"});
  expect_mistakes(world + "[@structur]\nkind = \"quadtree\"\n" + bodies + insert,
                  {"did you mean 'structure'?"});
}

TEST(Mistakes, OfSettingsThatAStructureHasNot) {
  const std::string scene =
      "title = \"x\"\n[world]\nsize = [9, 9]\n[[body]]\nname = \"red\"\nradius = 1\n"
      "position = [1, 1]\n[structure]\nkind = \"sort_and_sweep\"\n";
  const std::string show = "[[step]]\ndo = \"show\"\n";
  expect_mistakes(scene + "@capacity = 2\n@max_depth = 3\n" + show,
                  {"'sort_and_sweep' has no 'capacity'", "has no 'max_depth'"});
  expect_mistakes(scene + "@margin = 0.5\n" + show, {"has no margin"});
  good(scene + "capacity = 2\n" + show + "[[step]]\ndo = \"rebuild\"\nkind = \"quadtree\"\n");
  expect_mistakes(scene + "@cell = 2\n@levels = 3\n@open = true\n" + show,
                  {"'sort_and_sweep' has no 'cell'", "no 'levels'", "no 'open'"});
  expect_mistakes(scene + "@following = \"refit\"\n" + show, {"follows no bodies"});
  expect_mistakes(scene + "axis = @\"z\"\n" + show, {"no z axis"});
  expect_mistakes(scene + "axis = \"y\"\n" + show +
                      "[[step]]\ndo = \"rebuild\"\nkind = \"grid\"\n@axis = \"x\"\n",
                  {"has no axis"});
  good(scene + "axis = \"y\"\n" + show + "[[step]]\ndo = \"sweep\"\nexpect = { swaps = 0 }\n");
  expect_mistakes(scene + show + "[[step]]\ndo = \"rebuild\"\nkind = \"quadtree\"\n" +
                      "[[step]]\ndo = @\"sweep\"\n",
                  {"there is no sort_and_sweep"});
  expect_mistakes(scene + show + "[[step]]\ndo = \"phases\"\nevents = @[\"approach\"]\n",
                  {"nothing"});
  good(scene + "cell = 2\n" + show + "[[step]]\ndo = \"rebuild\"\nkind = \"grid\"\n");
}

TEST(Mistakes, OfAGridOfTooManyCells) {
  const std::string scene =
      "title = \"x\"\n[world]\nsize = [9, 9]\n[[body]]\nname = \"red\"\nradius = 1\n"
      "position = [1, 1]\n[[step]]\ndo = \"show\"\n[structure]\nkind = \"grid\"\n";
  expect_mistakes(scene + "@cell = 0.001\n", {"8.1e+07 cells"});
  expect_mistakes(scene + "@capacity = 2\n", {"'grid' has no 'capacity'"});
  good(scene + "cell = 0.001\nopen = true\n");
  good(scene + "cell = 0.01\nlevels = 3\n");
}

TEST(Mistakes, OfPanelsThatCannotBe) {
  expect_mistakes("panels = [\"world\", @\"atlas\"]\n" + kScene + "[[step]]\ndo = \"show\"\n",
                  {"needs an [atlas]"});
  expect_mistakes("panels = [@\"world\"]\n" + kAtlasScene + "[[step]]\ndo = \"show\"\n",
                  {"needs a [world]"});
  expect_mistakes("title = \"x\"\npanels = [@\"tree\"]\n[[step]]\ndo = \"show\"\n",
                  {"needs a [structure], a [level] or an [atlas]"});
  expect_mistakes("panels = [@\"ledger\"]\n" + kAtlasScene + "[[step]]\ndo = \"show\"\n",
                  {"needs a [structure], whose pairs it shows"});
  expect_mistakes("panels = [@\"sparkline\"]\n" + kScene + "[[step]]\ndo = \"show\"\n",
                  {"needs a [structure] and a step that runs"});
  expect_mistakes("panels = [@\"difference\"]\n" + kAtlasScene + "[[step]]\ndo = \"show\"\n",
                  {"needs a flat world and two bodies"});
  expect_mistakes("panels = [@\"axes\"]\n" + kScene + "[[step]]\ndo = \"show\"\n",
                  {"needs a `separate`"});
  expect_mistakes("panels = [@\"islands\"]\n" + kScene + "[[step]]\ndo = \"run\"\nseconds = 1\n",
                  {"contacts, springs or joints that hold"});
  expect_mistakes(kScene + "[[step]]\ndo = \"show\"\ncaption = \"@{islands}\"\n",
                  {"there is no panel 'islands'"});
  expect_mistakes("panels = [@\"code\"]\n" + kScene + "[[step]]\ndo = \"show\"\n",
                  {"needs a step with 'code'"});
  expect_mistakes("panels = [@\"collisions\"]\n" + kScene + "[[step]]\ndo = \"show\"\n",
                  {"contacts = \"lecture\", which remembers them"});
  expect_mistakes(kScene + "[[step]]\ndo = \"show\"\ncode = @{ function = \"Insert\" }\n",
                  {"name it: panels ="});
}

TEST(Mistakes, OfNamesThatAreTaken) {
  const std::string step = "[[step]]\ndo = \"show\"\n";
  expect_mistakes(kScene +
                      "[[body]]\nname = @\"red\"\nradius = 1\nposition = [1, 1]\n"
                      "[[pattern]]\nname = @\"pink\"\ncount = 2\nradius = 1\n"
                      "[[pattern]]\nname = @\"dot\"\ncount = 2000\nradius = 1\n" +
                      step,
                  {"line 7 has it", "line 11 has it", "line 15 has it"});
  expect_mistakes(
      kAtlasScene +
          "[[texture]]\nname = @\"A\"\nsize = [1, 1]\n"
          "[[texture_pattern]]\nname = @\"t\"\ncount = 9\nmin = [1, 1]\nmax = [1, 1]\n" +
          step,
      {"line 5 has it", "line 8 has it"});
}

TEST(Mistakes, OfAPatternsMembersWhoseNamesAreTaken) {
  const auto found = mistakes(kScene +
                              "[[body]]\nname = \"dot2\"\nradius = 1\nposition = [1, 1]\n"
                              "[[step]]\ndo = \"show\"\n");
  ASSERT_EQ(found.size(), 1u) << shown(found);
  EXPECT_EQ(found[0].message, "the name 'dot2' is taken");
  EXPECT_EQ(found[0].where.line, 15) << "the pattern makes the second one";
  EXPECT_EQ(found[0].suggestion, "line 19 has it");
}

// What a step names may be nobody, many, or somebody who clashes: each verb is read to its end, and
// nothing is walked or run.
TEST(Mistakes, OfWhatAStepNames) {
  const std::string acts[] = {
      "do = \"move\"\nbody = WHO\nto = [0, 0]\n",
      "do = \"force\"\nbody = WHO\nforce = [1, 0]\n",
      "do = \"impulse\"\nbody = WHO\nimpulse = [1, 0]\n",
      "do = \"insert\"\nbodies = [WHO]\n",
      "do = \"remove\"\nbodies = [WHO]\n",
      "do = \"sleep\"\nbodies = [WHO]\n",
      "do = \"wake\"\nbodies = [WHO]\n",
      "do = \"wait\"\nevent = \"touch\"\nbodies = [WHO, WHO]\nat_most = 1\n",
  };
  const auto said = [](std::string act, const std::string& who) {
    for (std::size_t at; (at = act.find("WHO")) != std::string::npos;) act.replace(at, 3, who);
    return act;
  };
  const std::string world = "title = \"x\"\n[world]\nsize = [9, 9]\ngravity = [0, -1]\n";
  const std::string clash =
      "[[body]]\nname = \"dot3\"\nradius = 1\nposition = [3, 3]\n"
      "[[pattern]]\nname = \"dot\"\ncount = 3\nradius = 1\n";
  for (const std::string& act : acts)
    for (const std::string& around : {std::string(), clash, kScene.substr(kScene.find("[[body]]"))})
      for (const std::string who : {"\"nobody\"", "\"dot\"", "\"\"", "7"}) {
        const bool good_there = act.find("bodies = [WHO]") != std::string::npos &&
                                who == "\"dot\"" && around.find("pink") != std::string::npos;
        if (good_there) continue;
        const std::string text = world + around + "[[step]]\n" + said(act, who);
        EXPECT_FALSE(mistakes(text).empty()) << text;
      }
}

// A scenario is right, or it is none: what code makes of nothing is a broken invariant.
TEST(Mistakes, OfCodeStopTheProgram) {
  ScenarioSpec spec;
  spec.steps.emplace_back().verb = ApplyForce{0, Vec<3>(1.0), Vec<3>(0.0)};
  EXPECT_DEATH(Scenario{spec},
               "broken invariant: i < spec_.bodies.size\\(\\) \\(left 0, right 0\\)");
  spec.bodies.emplace_back();
  EXPECT_EQ(Scenario(spec).steps.size(), 1u);
}

TEST(Mistakes, OfTooMuchInAll) {
  std::string text = "title = \"x\"\n[world]\nsize = [9, 9]\n";
  for (const char* name : {"a", "b"})
    text += std::string("[[pattern]]\nname = \"") + name +
            "\"\nradius = 1\ncount = " + (*name == 'b' ? "@" : "") + "10001\n";
  // Those who name them do not err.
  text += "[[spring]]\nalong = \"b\"\nstiffness = 1\n";
  expect_mistakes(text + "[[step]]\ndo = \"insert\"\nbodies = [\"a\", \"b\"]\n",
                  {"20002 bodies in all, the limit is 20000"});
  expect_mistakes(
      "title = \"x\"\n[atlas]\nsize = [64, 64]\n[[texture]]\nname = \"a\"\nsize = [1, 1]\n"
      "[[texture_pattern]]\nname = \"b\"\ncount = @20000\nmin = [1, 1]\nmax = [2, 2]\n"
      "[[step]]\ndo = \"pack\"\ntextures = [\"a\", \"b\"]\n",
      {"20001 textures in all, the limit is 20000"});

  std::string steps;
  for (std::size_t i = 0; i <= kMostSteps; ++i) steps += "{ do = \"show\" }, ";
  const auto found = mistakes("title = \"x\"\nstep = [" + steps + "]");
  ASSERT_EQ(found.size(), 1u) << shown(found);
  EXPECT_EQ(found[0].message, "10001 of [[step]], the limit is 10000");
}

TEST(Mistakes, OfZeroSizesAndStillBodies) {
  const std::string world = "title = \"x\"\n[world]\nsize = [9, 9]\n";
  const std::string body = world + "[[body]]\nname = \"a\"\nposition = [1, 1]\n";
  const std::string step = "[[step]]\ndo = \"show\"\n";
  good(body + "radius = 0\n" + step);
  good(body + "radius = 0\nstatic = true\n" + step);
  good(body + "half_size = [0, 2]\nvelocity = [1, 0]\n" + step);
  expect_mistakes(body + "radius = @0\nvelocity = [1, 0]\n" + step,
                  {"a body that moves needs a size"});
  expect_mistakes(body + "half_size = @[0, 0]\nvelocity = [0, 1]\n" + step,
                  {"'half_size' is zero"});
  expect_mistakes(body + "radius = 1\nstatic = true\nvelocity = @[0, 1]\n" + step,
                  {"a static body has no velocity"});
  expect_mistakes(world + "[[pattern]]\nname = \"p\"\ncount = 2\nradius = @0\nspeed = 1\n" + step,
                  {"needs a size"});
}

}  // namespace
}  // namespace lantern::run
