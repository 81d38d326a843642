// What a file says for nothing is told; its near twin is not.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "run/warnings.hpp"
#include "scenario/directing.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {
namespace notices {  // other tests have helpers of these names

std::vector<Diagnostic> noticed(const std::string& text) { return warnings_of_file(good(text)); }

void expect_quiet(const std::string& text) {
  const std::vector<Diagnostic> found = noticed(text);
  EXPECT_TRUE(found.empty()) << text << "\n" << shown(found);
}

// Says `words` at the one mark @ in the text, which is taken out, and is still when `kind` is
// meant.
void expect_notice(std::string text, const std::string& words, const std::string& kind) {
  const std::size_t at = text.find('@');
  ASSERT_NE(at, std::string::npos) << text;
  text.erase(at, 1);
  const std::string before = text.substr(0, at);
  const std::vector<Diagnostic> found = noticed(text);
  ASSERT_EQ(found.size(), 1u) << text << "\n" << shown(found);
  EXPECT_NE(found[0].message.find(words), std::string::npos) << shown(found);
  EXPECT_EQ(found[0].where.line, 1 + std::count(before.begin(), before.end(), '\n'))
      << shown(found);
  EXPECT_EQ(found[0].where.column, int(before.size() - (before.rfind('\n') + 1)) + 1)
      << shown(found);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_FALSE(found[0].source_line.empty());
  const std::string hint = "; if this is intended, add quiet = [\"" + kind + "\"] to [world]";
  EXPECT_TRUE(found[0].suggestion.ends_with(hint)) << shown(found);
  const std::size_t world = text.find("[world]\n");
  ASSERT_NE(world, std::string::npos);
  expect_quiet(text.insert(world + 8, "quiet = [\"" + kind + "\"]\n"));
}

std::string disc(const std::string& name, const std::string& keys = "") {
  return "[[body]]\nname = \"" + name + "\"\nradius = 0.5\nposition = [4, 4]\n" + keys;
}

std::string world(const std::string& rest, const std::string& keys = "") {
  return world_text("size = [8, 8]\n" + keys, rest);
}

std::string insert(const std::string& names, const std::string& more = "") {
  return "[[step]]\ndo = \"insert\"\nbodies = [" + names + "]\n" + more;
}

// --- expectations ---

std::string expecting(const std::string& what) {
  return world(kTree + disc("ann") + disc("bob") + insert("\"ann\", \"bob\"", what + "\n"),
               "gravity = [0, -9]\n");
}

TEST(Notices, OfExpectationsThatCannotFail) {
  const std::pair<std::string, std::string> cases[] = {
      {"expect = { at_least = { @bodies = -5 } }", "'bodies' is always at least -5"},
      {"expect = { at_least = { @pairs = 0 } }", "'pairs' is always at least 0"},
      {"always = { at_least = { @kinetic_energy = 0 } }", "'kinetic_energy' is always at least 0"},
      {"expect = { at_least = { @\"speed.bob\" = -1 } }", "'speed.bob' is always at least -1"},
      {"expect = { at_least = { @energy = -1e300 } }", "'energy' is always at least -1e+300"},
      {"expect = { at_most = { @bodies = 1e300 } }", "'bodies' is always at most 1e+300"},
      {"expect = { at_most = { @bodies = 3 } }", "'bodies' is always at most 3"},
      {"expect = { at_most = { @pairs = 2 } }", "'pairs' is always at most 2"},
      {"expect = { at_most = { @energy = 1e300 } }", "'energy' is always at most 1e+300"},
      {"expect = { at_most = { @depth = 7 } }", "'depth' is always at most 7"},
      {"expect = { at_most = { @nodes = 1e9 } }", "'nodes' is always at most 1e+09"},
      {"expect = { at_most = { @leaves = 1e9 } }", "'leaves' is always at most 1e+09"},
      {"expect = { at_most = { @entries = 1e9 } }", "'entries' is always at most 1e+09"},
      {"expect = { at_most = { @most_in_leaf = 3 } }", "'most_in_leaf' is always at most 3"},
      {"expect = { at_least = { @nodes = 1 } }", "'nodes' is always at least 1"},
      {"expect = { at_least = { @leaves = 1 } }", "'leaves' is always at least 1"},
      {"expect = { position = { @bob = [4, 4] }, tolerance = 1e9 }",
       "a tolerance of 1e+09 for 'bob' takes whatever comes"},
      {"expect = { velocity = { @bob = [0, 0] }, tolerance = 1e9 }", "takes whatever comes"},
      {"expect = { turned = { @bob = 0 }, tolerance = 1e9 }", "a tolerance of 1e+09 for 'bob'"},
      {"expect = { @energy = 10, tolerance = 1e9 }", "a tolerance of 1e+09 for 'energy'"},
      {"@expect = {}", "'expect' expects nothing"},
      {"@always = {}", "'always' expects nothing"},
  };
  for (const auto& [what, words] : cases)
    expect_notice(expecting(what), words + (words.ends_with("nothing") ? ", so" : ""), "expect");
}

TEST(Notices, OfExpectationsThatMayFailAreNotGiven) {
  for (const char* what :
       {"expect = { bodies = 2 }", "expect = { at_least = { bodies = 1 } }",
        "expect = { at_most = { bodies = 2 } }", "expect = { at_most = { pairs = 1 } }",
        "expect = { at_least = { energy = -5 } }", "expect = { at_least = { \"y.bob\" = -3 } }",
        "expect = { at_most = { energy = 1e6 } }", "expect = { at_most = { nodes = 1000 } }",
        "expect = { at_most = { depth = 6 } }", "expect = { at_least = { nodes = 2 } }",
        "expect = { at_most = { most_in_leaf = 2 } }",
        // Bodies leave the world, and turn more than once.
        "expect = { position = { bob = [4, 4] }, tolerance = 50 }",
        "expect = { half_size = { bob = [0.5, 0.5] }, tolerance = 50 }",
        "expect = { turned = { bob = 0 }, tolerance = 360 }",
        "expect = { energy = 72, tolerance = 100 }",
        "expect = { pairs_are = [[\"ann\", \"bob\"]] }"})
    expect_quiet(expecting(what));
}

TEST(Notices, OfTolerancesKnowHowFarBodiesGet) {
  const auto flown = [](const std::string& tolerance) {
    return world(disc("ann", "velocity = [1e8, 0]\n") + insert("\"ann\"") +
                 "[[step]]\ndo = \"run\"\nseconds = 100\nevery = 1000\n"
                 "expect = { position = { ann = [0, 0] }, tolerance = " +
                 tolerance + " }\n");
  };
  expect_quiet(flown("1e9"));
}

// What a structure cannot be follows from all that the script has.
TEST(Notices, OfNodesAreThoseOfTreesThatSplitToALimit) {
  const auto text = [](const std::string& structure, const std::string& limit,
                       const std::string& before = "") {
    return world(structure + disc("ann") + insert("\"ann\"") + before +
                 "[[step]]\ndo = \"show\"\nexpect = { " + limit + " }\n");
  };
  const std::string rebuild = "[[step]]\ndo = \"rebuild\"\nmax_depth = 8\n";
  expect_notice(text(kTree, "at_most = { @depth = 9 }", rebuild), "'depth' is always", "expect");
  expect_quiet(text(kTree, "at_most = { depth = 8 }", rebuild));
  const std::string remove = "[[step]]\ndo = \"remove\"\nbodies = [\"ann\"]\n";
  for (const std::string kind : {"quadtree", "lecture_quadtree", "kd_tree"}) {
    const std::string structure = "[structure]\nkind = \"" + kind + "\"\n";
    const std::string empty = text(structure, "at_least = { @nodes = 1 }", remove);
    expect_notice(empty, "'nodes' is always at least 1", "expect");
  }
  const std::string boxes = "[structure]\nkind = \"aabb_tree\"\n";
  expect_quiet(text(boxes, "at_least = { nodes = 1 }"));
  expect_quiet(text(boxes, "at_most = { depth = 9 }"));
}

TEST(Notices, OfQuestionsAndImpactsThatCannotFail) {
  const auto asked = [](const std::string& limit) {
    return world(kTree + disc("ann") + disc("bob") + insert("\"ann\", \"bob\"") +
                 "[[step]]\ndo = \"ray\"\nfrom = [0, 4]\nto = [8, 4]\nexpect = { at_most = { " +
                 limit + " } }\n");
  };
  expect_notice(asked("@hits = 3"), "'hits' is always at most 3", "expect");
  expect_notice(asked("@objects_tested = 3"), "'objects_tested' is always at most 3", "expect");
  expect_quiet(asked("hits = 2, objects_tested = 2"));
  const auto struck = [](const std::string& limit) {
    return world(disc("ann") + insert("\"ann\"", "expect = { at_most = { " + limit + " } }\n"),
                 "contacts = \"impulse\"\n");
  };
  expect_notice(struck("@time_of_impact = 1"), "'time_of_impact' is always at most 1", "expect");
  expect_quiet(struck("time_of_impact = 0.99"));
}

TEST(Notices, OfSidesAreThoseThatNoneOfThemCanBreak) {
  const auto sides = [](const std::string& expect) {
    return world("[structure]\nkind = \"quadtree\"\nmax_depth = 2\n" + disc("ann") +
                 "[[side]]\nname = \"shallow\"\n[[side]]\nname = \"deep\"\n"
                 "structure = { max_depth = 8 }\n" +
                 insert("\"ann\"", "expect = { " + expect + " }\n"));
  };
  expect_quiet(sides("at_most = { depth = 4 }"));
  expect_quiet(sides("at_most = { depth = 8 }"));
  expect_notice(sides("at_most = { @depth = 9 }"), "'depth' is always at most 9", "expect");
  expect_notice(sides("shallow = { at_most = { @depth = 4 } }"), "'depth' is always at most 4",
                "expect");
}

// --- settings ---

const std::string kRun = "[[step]]\ndo = \"run\"\nseconds = 1\n";

TEST(Notices, OfSettingsOfContactsWhereNothingTouches) {
  const std::string rest = disc("ann") + disc("bob") + insert("\"ann\", \"bob\"") + kRun;
  for (const std::string key :
       {"iterations = 20", "sub_steps = 4", "wanted_error = 0.01", "impact_budget = 100"}) {
    const std::string name = key.substr(0, key.find(' '));
    expect_notice(world(rest, "@" + key + "\n"),
                  "'" + name + "' changes nothing: in this world nothing touches", "settings");
    const std::string method = name == "iterations" ? "impulse" : "soft";
    expect_quiet(world(rest, key + "\ncontacts = \"" + method + "\"\n"));
  }
  expect_notice(world(disc("ann", "@restitution = 1\n") + insert("\"ann\"")),
                "'restitution' changes nothing: ", "settings");
  expect_notice(world(disc("ann", "@friction = 1\n") + disc("bob", "friction = 1\n") +
                      insert("\"ann\", \"bob\"")),
                "'friction' changes nothing, here and 1 time more: ", "settings");
  expect_quiet(world(disc("eve", "restitution = 1\n") + insert("\"eve\"") + rest,
                     "contacts = \"impulse\"\n"));
  expect_notice(world(rest, "contacts = \"lecture\"\n@wanted_error = 0.01\n"),
                "'wanted_error' changes nothing: contacts = \"lecture\" keep no error", "settings");
  expect_quiet(world(rest, "contacts = \"impulse\"\nwanted_error = 0.01\n"));
  // Each method has an effort of its own; a method may come in later.
  expect_notice(world(rest, "contacts = \"soft\"\n@iterations = 20\n"),
                "'iterations' changes nothing: only contacts = \"impulse\" have iterations, and "
                "these are \"soft\"",
                "settings");
  expect_notice(world(rest, "contacts = \"direct\"\n@sub_steps = 4\n"),
                "'sub_steps' changes nothing: only contacts = \"soft\" have sub_steps", "settings");
  const std::string later = "[[step]]\ndo = \"solve_by\"\ncontacts = \"impulse\"\n";
  expect_quiet(world(rest + later, "contacts = \"soft\"\niterations = 20\n"));
  expect_notice(
      world(rest + "[[step]]\ndo = \"solve_by\"\ncontacts = \"impulse\"\n@sub_steps = 4\n",
            "contacts = \"direct\"\n"),
      "'sub_steps' changes nothing: only contacts = \"soft\" have sub_steps, and these "
      "are \"impulse\"",
      "settings");
  // Joints are solved in sub-steps, too.
  const std::string pin = "[[joint]]\na = \"ann\"\nto = [4, 6]\nkind = \"pin\"\n";
  expect_quiet(world(disc("ann") + pin + insert("\"ann\""), "sub_steps = 4\n"));
}

TEST(Notices, OfSettingsOfContactsThatNeverComeAbout) {
  const std::string both = insert("\"ann\", \"bob\"");
  const std::string impulse = "contacts = \"impulse\"\n";
  const auto idle = [](const std::string& why) { return "changes nothing: " + why; };
  expect_notice(world(disc("ann", "@friction = 1\n") + insert("\"ann\"") + kRun, impulse),
                idle("there are no two bodies"), "settings");
  const std::string fixed = disc("ann", "static = true\n") + disc("bob", "static = true\n");
  expect_notice(world(fixed + both + kRun, impulse + "@iterations = 20\n"),
                idle("all bodies are static"), "settings");
  const std::string still = disc("ann", "@restitution = 1\n") + disc("bob") + both;
  expect_notice(world(still, impulse), idle("no step lets time pass"), "settings");
  const std::string compare =
      "[[step]]\ndo = \"compare\"\nbodies = [\"ann\", \"bob\"]\nrow = \"a\"\n";
  expect_quiet(
      world(kTree + disc("ann", "restitution = 1\n") + disc("bob") + both + compare, impulse));
  // A pin is solved in as many sweeps.
  const std::string pin = "[[joint]]\na = \"ann\"\nto = [4, 6]\nkind = \"pin\"\n";
  expect_quiet(world(disc("ann") + pin + insert("\"ann\"") + kRun, impulse + "iterations = 20\n"));
  // `lantern measure` lets the time of a problem pass.
  expect_quiet(world(disc("ann", "restitution = 1\n") + kShow +
                         "[problem]\nsolution = \"bouncing_ball\"\nseconds = 1\nstep = 0.1\n",
                     impulse));
}

TEST(Notices, OfSettingsThatTheLectureDoesNotHave) {
  const std::string both = insert("\"ann\", \"bob\"") + kRun;
  const std::string lecture = "contacts = \"lecture\"\n";
  const std::string why = "contacts = \"lecture\" know neither friction nor times of impact";
  expect_notice(world(disc("ann", "@friction = 1\n") + disc("bob") + both, lecture),
                "'friction' changes nothing: " + why, "settings");
  expect_notice(world(disc("ann") + disc("bob") + both, lecture + "@impact_budget = 9\n"),
                "'impact_budget' changes nothing: " + why, "settings");
  expect_quiet(world(disc("ann", "restitution = 0.5\n") + disc("bob") + both, lecture));
  expect_quiet(world(disc("ann", "friction = 1\n") + disc("bob") + both +
                         "[[step]]\ndo = \"solve_by\"\ncontacts = \"impulse\"\n",
                     lecture));
  // It moves, though it never has to turn.
  expect_quiet(world(disc("ann", "wander = true\nspeed = 1\n") + insert("\"ann\"") + kRun));
}

TEST(Notices, OfSettingsOfStructuresThatTheScriptNeverHas) {
  const auto structure = [](const std::string& lines, const std::string& later = "") {
    return world("[structure]\n" + lines + disc("ann") + insert("\"ann\"") + later);
  };
  const std::string rebuild = "[[step]]\ndo = \"rebuild\"\nkind = \"quadtree\"\n";
  for (const std::string kind : {"kind = \"kd_tree\"\n", "kind = \"lecture_quadtree\"\n"}) {
    for (const std::string key : {"children = \"eager\"\n", "no_progress_stop = true\n"}) {
      expect_notice(
          structure(kind + "@" + key),
          "'" + key.substr(0, key.find(' ')) + "' changes nothing: no structure here has it",
          "settings");
      expect_quiet(structure(kind + key, rebuild));
    }
    expect_quiet(structure(kind + "capacity = 2\nmax_depth = 3\n"));
  }
  for (const std::string key :
       {"capacity = 2", "max_depth = 3", "cell = 1", "open = true", "margin = 0"})
    expect_notice(structure("kind = \"none\"\n@" + key + "\n"),
                  "'" + key.substr(0, key.find(' ')) + "' changes nothing", "settings");
  expect_notice(structure("kind = \"quadtree\"\n@margin = 0\n"),
                "'margin' changes nothing: no structure here has it", "settings");
  expect_quiet(structure("kind = \"quadtree\"\nmargin = 0\n",
                         "[[step]]\ndo = \"rebuild\"\nkind = \"aabb_tree\"\n"));
  expect_notice(
      structure("kind = \"kd_tree\"\n", "[[step]]\ndo = \"rebuild\"\n@children = \"eager\"\n"),
      "'children' changes nothing", "settings");
}

// --- what is never used ---

TEST(Notices, OfBodiesThatNeverEnter) {
  const std::string pattern = "[[pattern]]\nname = @\"dot\"\ncount = 9\nradius = 0.1\n";
  std::string quiet = pattern;
  quiet.erase(quiet.find('@'), 1);
  expect_notice(world("[[body]]\nname = @\"bob\"\nradius = 1\nposition = [1, 1]\n" + disc("ann") +
                      insert("\"ann\"")),
                "'bob' never enters the world", "bodies");
  expect_notice(world(pattern + disc("ann") + insert("\"ann\"")),
                "none of the 9 bodies of 'dot' enters the world", "bodies");
  expect_quiet(world(quiet + insert("\"dot\"")));
  expect_notice(world(pattern + insert("\"dot2..dot3\"")),
                "7 of the 9 bodies of 'dot' never enter the world", "bodies");
  expect_notice(world(pattern + insert("\"dot2..dot9\"")),
                "1 of the 9 bodies of 'dot' never enters the world", "bodies");
  // The first comes at once.
  const std::string emit = "[[step]]\ndo = \"emit\"\nbodies = [\"dot\"]\nevery = 0.1\n";
  const std::string run = "[[step]]\ndo = \"run\"\nseconds = 0.";
  expect_quiet(world(quiet + emit + run + "8\n"));
  expect_notice(world(pattern + emit), "8 of the 9 bodies of 'dot' never enter", "bodies");
  expect_notice(world(pattern + run + "8\n" + emit + run + "4\n" + run + "3\n"),
                "1 of the 9 bodies of 'dot' never enters", "bodies");
  const std::string late = "[[body]]\nname = @\"late\"\nradius = 0.1\nposition = [1, 1]\n";
  expect_notice(world(late + disc("ann") +
                      "[[step]]\ndo = \"emit\"\nbodies = [\"ann\", \"late\"]\nevery = 1\n"),
                "'late' never enters the world", "bodies");
  expect_quiet(
      world(kTree + quiet + "[[step]]\ndo = \"compare\"\nbodies = [\"dot\"]\nrow = \"nine\"\n"));
  // `lantern measure` has all bodies of a problem there from the start.
  expect_quiet(world(disc("ann") + kShow +
                     "[problem]\nsolution = \"projectile\"\nseconds = 1\nstep = 0.1\n"));
}

TEST(Notices, OfManyAreTenLinesAndOneForTheOthers) {
  std::string bodies;
  for (int i = 0; i < 13; ++i) bodies += disc("d" + std::to_string(i));
  const std::vector<Diagnostic> found = noticed(world(bodies + kShow));
  ASSERT_EQ(found.size(), 11u);
  EXPECT_EQ(found[10].message, "3 more names of bodies never enter the world");
}

TEST(Notices, OfPrototypesThatNobodyIsLike) {
  const std::string ball = "@[[prototype]]\nname = \"ball\"\nradius = 1\n";
  const std::string used = ball.substr(1);
  expect_notice(world(ball + disc("ann") + insert("\"ann\"")),
                "nobody is like the prototype 'ball'", "prototypes");
  expect_quiet(world(used + "[[body]]\nname = \"ann\"\nlike = \"ball\"\nposition = [4, 4]\n" +
                     insert("\"ann\"")));
  expect_quiet(
      world(used + "[[pattern]]\nname = \"p\"\nlike = \"ball\"\ncount = 2\n" + insert("\"p\"")));
  expect_quiet(world(used + "[[prototype]]\nname = \"red\"\nlike = \"ball\"\n" +
                     "[[body]]\nname = \"ann\"\nlike = \"red\"\nposition = [4, 4]\n" +
                     insert("\"ann\"")));
  expect_quiet(world(used + "[map]\nrows = \"\"\"\n.o\n\"\"\"\nlegend = { o = \"ball\" }\n" +
                     insert("\"ball\"")));
}

TEST(Notices, OfLettersThatStandNowhere) {
  const std::string kinds = "[[prototype]]\nname = \"ball\"\nradius = 0.4\n";
  const auto map = [&](const std::string& legend) {
    return world(kinds + "[map]\nrows = \"\"\"\n.o\n\"\"\"\n" + legend + insert("\"ball\""));
  };
  expect_notice(map("legend = { o = \"ball\", @x = \"ball\" }\n"),
                "the letter 'x' stands nowhere in the map", "letters");
  expect_quiet(map("legend = { o = \"ball\" }\n"));
}

TEST(Notices, OfSpringsAndJointsThatAreThereTwice) {
  const std::string bodies = disc("ann") + disc("bob");
  const std::string spring =
      "[[spring]]\na = \"ann\"\nb = \"bob\"\nat_a = [0.1, 0]\nstiffness = 5\n";
  const auto text = [&](const std::string& links) {
    return world(bodies + links + insert("\"ann\", \"bob\""));
  };
  expect_notice(text(spring + "@" + spring),
                "the spring from 'ann' to 'bob' is there twice, first "
                "in line 13",
                "links");
  expect_notice(text(spring + "@[[spring]]\na = \"bob\"\nb = \"ann\"\nat_b = [0.1, 0]\n"
                              "stiffness = 5\n"),
                "the spring from 'bob' to 'ann' is there twice", "links");
  const std::string pin = "[[joint]]\na = \"ann\"\nto = [4, 6]\nkind = \"pin\"\n";
  expect_notice(text(pin + "@" + pin), "the joint of 'ann' is there twice", "links");
  expect_quiet(text(spring + "[[spring]]\na = \"ann\"\nb = \"bob\"\nat_a = [0.1, 0]\n"
                             "stiffness = 6\n"));
  expect_quiet(text(spring + "[[spring]]\na = \"ann\"\nb = \"bob\"\nat_a = [0.2, 0]\n"
                             "stiffness = 5\n"));
  expect_quiet(text(pin + "[[joint]]\na = \"bob\"\nto = [4, 6]\nkind = \"pin\"\n"));
}

// --- sides, atlases ---

std::string sided(const std::string& first, const std::string& second, const std::string& step,
                  const std::string& keys = "") {
  return world("[[side]]\nname = \"one\"\n" + first + "[[side]]\nname = \"two\"\n" + second +
                   disc("ann") + insert("\"ann\"", step),
               keys);
}

TEST(Notices, OfSidesAreGivenOnce) {
  expect_notice(sided("", "", "expect = { at_least = { @bodies = 0 } }\n"), "'bodies' is always",
                "expect");
  expect_notice(sided("", "", "expect = { one = { at_least = { @bodies = 0 } } }\n"),
                "'bodies' is always", "expect");
  expect_notice(sided("", "", "@expect = { one = {} }\n"), "'expect' expects nothing", "expect");
  expect_quiet(sided("", "", "expect = { one = { bodies = 1 } }\n"));
  expect_notice(sided("", "", "", "@iterations = 20\n"), "'iterations' changes nothing",
                "settings");
  expect_quiet(sided("world = { contacts = \"impulse\" }\n", "", "", "iterations = 20\n"));
}

TEST(Notices, OfAnAtlasCanBeMeant) {
  const auto atlas = [](const std::string& quiet) {
    return "title = \"t\"\n[atlas]\nsize = [64, 64]\n" + quiet +
           "[[texture]]\nname = \"a\"\nsize = [8, 8]\n[[step]]\ndo = \"pack\"\n"
           "textures = [\"a\"]\nexpect = { at_least = { refused = 0 } }\n";
  };
  const std::vector<Diagnostic> found = noticed(atlas(""));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(
      found[0].suggestion.ends_with("if this is intended, add quiet = [\"expect\"] to [atlas]"));
  expect_quiet(atlas("quiet = [\"expect\"]\n"));
}

TEST(Notices, OfWhatComesWithLanternAreNotGiven) {
  for (const std::string& name : all_files()) {
    const std::vector<Diagnostic> found = warnings_of_file(shipped(name));
    EXPECT_TRUE(found.empty()) << shown(found);
  }
}

}  // namespace notices
}  // namespace
}  // namespace lantern::run
