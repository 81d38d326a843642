// Words in another language: forms of nouns, sentences, tables that are wrong, texts of a scenario.
#include "language/words.hpp"

#include <string>

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "run/director.hpp"
#include "scenario/parsing.hpp"

namespace lantern::run {
namespace {

std::string forms_by(Plural plural, std::string_view forms, std::initializer_list<int> numbers) {
  WordTable words;
  words.plural = plural;
  const Speaking speaking(&words);
  std::string text;
  for (const int n : numbers) text += own_noun(forms, n) + " ";
  return text;
}

TEST(Words, NounsTakeTheFormOfTheirNumber) {
  EXPECT_EQ(forms_by(Plural::one, "a/b", {0, 1, 2, 11}), "b a b b ");
  EXPECT_EQ(forms_by(Plural::up_to_one, "a/b", {0, 1, 2}), "a a b ");
  EXPECT_EQ(forms_by(Plural::polish, "a/b/c", {0, 1, 2, 5, 12, 22, 112}), "c a b c c b c ");
  EXPECT_EQ(forms_by(Plural::russian, "a/b/c", {1, 11, 21, 3, 13}), "a c a b c ");
  EXPECT_EQ(forms_by(Plural::czech, "a/b/c", {1, 4, 5, 22}), "a b c c ");
  EXPECT_EQ(forms_by(Plural::none, "a", {0, 1, 7}), "a a a ");
  EXPECT_EQ(forms_by(Plural::polish, "a/b", {5}), "b ") << "of too few the last";
  EXPECT_EQ(forms_by(Plural::none, "a/b", {1, 5}), "a b ") << "another language's";
}

TEST(Words, SentencesTakeTheirValuesInAnotherOrder) {
  EXPECT_EQ(say("{} holds {:.2f}", "red", 1.5), "red holds 1.50");
  WordTable words;
  words.decimal = ',';
  words.said["{} holds {:.2f}"] = "{1:.2f} von {0}";
  const Speaking speaking(&words);
  EXPECT_EQ(say("{} holds {:.2f}", "red", 1.5), "1,50 von red");
  EXPECT_EQ(word("no such word"), "no such word");
  EXPECT_EQ(say_count(2, "leaf/leaves"), "2 leaves");
}

// Every table says all words; which are wrong is found when it is read.
TEST(Words, EveryLanguageHasAllOfThem) {
  ASSERT_GE(language::languages().size(), 5u);
  for (const std::string_view mark : language::languages()) {
    const auto words = language::words_in(mark);
    ASSERT_TRUE(words) << mark;
    EXPECT_EQ(words->missing, std::vector<std::string>()) << mark;
  }
}

std::string mistake_in(const std::string& table) {
  try {
    language::read_words(table, "sv.toml", WordTable());
  } catch (const ScenarioError& e) {
    return e.diagnostics().at(0).message + " | " + e.diagnostics().at(0).suggestion;
  }
  return "";
}

TEST(Words, ATableThatIsWrongIsToldWhere) {
  EXPECT_EQ(mistake_in("language = \"sv\"\n[words]\n\"root\" = \"rot\"\n"), "");
  EXPECT_NE(mistake_in("[words]\n\"rot\" = \"x\"\n").find("no picture says 'rot'"),
            std::string::npos);
  EXPECT_NE(mistake_in("[words]\n\"{} reused\" = \"x\"\n").find("'{0}' is missing"),
            std::string::npos);
  EXPECT_NE(mistake_in("[words]\n\"{} reused\" = \"{} {}\"\n").find("has no '{1}'"),
            std::string::npos);
  EXPECT_NE(mistake_in("[words]\n\"gap {:.2g}\" = \"{:d}\"\n").find("has no '{0:d}'"),
            std::string::npos);
  EXPECT_NE(mistake_in("[words]\n\"root\" = \"{\"\n").find("a brace"), std::string::npos);
  EXPECT_NE(mistake_in("plural = \"polish\"\n[words]\n\"leaf/leaves\" = \"a/b\"\n")
                .find("2 forms, and the rule 'polish' has 3"),
            std::string::npos);
  EXPECT_NE(mistake_in("plural = \"polnish\"\n").find("did you mean 'polish'"), std::string::npos);
  EXPECT_NE(mistake_in("langage = \"sv\"\n").find("'langage'"), std::string::npos);
}

TEST(Words, ATextStandsForTheScenariosOwn) {
  language::ScenarioSpec scenario = language::parse_scenario(
      "title = \"One\"\n[world]\nsize = [16, 9]\n[[body]]\nname = \"red\"\nradius = 1\nposition = "
      "[3, "
      "3]\n[[step]]\ndo = \"insert\"\nbodies = [\"red\"]\ncaption = \"{bodies:body} here.\"\n",
      "one.toml");
  EXPECT_EQ(language::texts_of(scenario),
            (std::vector<std::string>{"One", "{bodies:body} here.", "red"}));
  WordTable words;
  words.texts = {{"One", "Eins"}, {"red", "Käfer"}};
  words.idle = {"One", "rot"};
  language::ScenarioSpec translated = scenario;
  language::translate(translated, words);
  EXPECT_EQ(translated.title, "Eins");
  EXPECT_EQ(translated.bodies[0].called(), "Käfer");
  EXPECT_EQ(translated.words->idle, std::vector<std::string>{"rot"});
  EXPECT_EQ(translated.words->missing, std::vector<std::string>{"{bodies:body} here."});
  EXPECT_NE(translated.text_hash, scenario.text_hash);
  words.texts["{bodies:body} here."] = "{pairs:Paar/Paare} hier.";
  EXPECT_THROW(language::translate(scenario, words), ScenarioError);
}

std::string caption_of(language::ScenarioSpec spec, const WordTable& words) {
  language::translate(spec, words);
  const Speaking speaking(spec.words.get());
  std::string caption;
  Work work;
  direct(language::Scenario(std::move(spec)), Pace::step, work, [&](const Frame& frame) {
    caption = frame.caption;
    return true;
  });
  return caption;
}

TEST(Words, ACaptionThatIsNotTranslatedIsInItsOwnLanguage) {
  const language::ScenarioSpec scenario = language::parse_scenario(
      "title = \"T\"\n[world]\nsize = [16, 9]\n[[body]]\nname = \"a\"\nradius = 1\nposition = [3, "
      "3]\n"
      "[[body]]\nname = \"b\"\nradius = 1\nposition = [9, 3]\n"
      "[[step]]\ndo = \"insert\"\nbodies = [\"a\", \"b\"]\n"
      "caption = \"{bodies:body/bodies} at {time} s.\"\n",
      "two.toml");
  WordTable words;
  words.language = "xx";
  words.plural = Plural::none;
  words.decimal = ',';
  EXPECT_EQ(caption_of(scenario, words), "2 bodies at 0.00 s.");
  words.texts["{bodies:body/bodies} at {time} s."] = "{time} s: {bodies:X}.";
  EXPECT_EQ(caption_of(scenario, words), "0,00 s: 2 Xs.");
}

}  // namespace
}  // namespace lantern::run
