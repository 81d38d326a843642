// Tables of the fixed words of pictures and pages (base/words.hpp): those of this program, and a
// caller's own as TOML files.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/words.hpp"

namespace lantern::language {

class Scenario;
struct ScenarioSpec;

// The languages of the tables in this program but English; none in a page's engine, which is given
// its table.
std::vector<std::string_view> languages();

// The file of such a table, as an example for another language; empty if there is none.
std::string_view words_file(std::string_view language);
// What stands in it; null if there is none.
std::shared_ptr<const WordTable> words_in(std::string_view language);

// What a file of words says: `language`, `plural` (a name of Plural), `decimal`, and the tables
// [words], by the English words, and [texts], by what a scenario says. Upon `base`: what the file
// does not say stays. Throws ScenarioError with every mistake: a word that no picture has, another
// number of plural forms than the language's, a placeholder that the English has not.
WordTable read_words(std::string_view text, const std::string& path, const WordTable& base);

// As JSON, for a page; and back. Throws nlohmann's exceptions for what is no such table.
std::string to_json(const WordTable& words);
WordTable word_table(const std::string& json);

// What the scenario and its sides say on pages, and the names that they write there, each once:
// what a table's [texts] may stand for.
std::vector<std::string> texts_of(ScenarioSpec scenario);

// Puts the table's [texts] for what the scenario says, and gives it the table, with those that it
// lacks if it has any, to say its frames' words in. Throws ScenarioError if a text quotes another
// count than the scenario's own.
void translate(ScenarioSpec& scenario, const WordTable& words);

// The scenario of a file, with the table of words that it names, or the caller does in its place,
// and with the texts that stand for its own in a file beside it: those of ghosts.toml in German in
// de/ghosts.toml. Throws as load_scenario(path) does.
struct Wording {
  std::string language, words;  // "de", "words/sv.toml"; empty: the file's own
};
Scenario load_scenario(const std::string& path, const Wording& wording);

}  // namespace lantern::language
