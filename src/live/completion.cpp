// Completion: what the language has for the place where the cursor is.
#include <algorithm>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "language/counts.hpp"
#include "language/language.hpp"
#include "live/controls.hpp"
#include "live/written.hpp"

namespace lantern::live {
namespace {

using language::KeyDoc;
using language::KeyType;
using language::TableDoc;

// Keys whose texts are names, and what has these.
struct Naming {
  std::string_view key;
  std::vector<std::string_view> lists;
};
const Naming* naming_of(std::string_view key) {
  static const std::vector<std::string_view> bodies = {"body", "pattern"};
  static const std::vector<Naming> all = [] {
    std::vector<Naming> namings = {{"like", {"prototype"}},
                                   {"along", {"pattern"}},
                                   {"side", {"side"}},
                                   {"texture", {"texture", "texture_pattern"}},
                                   {"textures", {"texture", "texture_pattern"}}};
    for (const char* name : {"bodies", "body", "a", "b", "follow", "pair", "lit", "asleep", "awake",
                             "hits_are", "pairs_are", "contacts_are"})
      namings.push_back({name, bodies});
    return namings;
  }();
  const auto found = std::ranges::find(all, key, &Naming::key);
  return found == all.end() ? nullptr : &*found;
}

class Completion {
 public:
  Completion(std::string_view text, std::size_t cursor)
      : text_(read_written(text, cursor)), cursor_(text_.cursor) {
    from = std::min(cursor_.from, cursor);
    begun_ = text.substr(from, cursor - from);
    if (cursor_.in == Cursor::In::heading) add_headings();
    if (cursor_.in == Cursor::In::key) add_keys();
    if (cursor_.in == Cursor::In::value) add_values();
  }

  std::size_t from;  // where the word that is written begins
  nlohmann::ordered_json words = nlohmann::ordered_json::array();

 private:
  void add(std::string_view word, std::string_view means) {
    if (word.starts_with(begun_)) words.push_back({{"word", word}, {"means", means}});
  }
  void add_text(std::string_view text, std::string_view means) {
    add(cursor_.is_quoted ? std::string(text) : '"' + std::string(text) + '"', means);
  }

  // Of an element, the key of its list.
  const Written& key_of(std::size_t i) const {
    while (std::holds_alternative<std::size_t>(text_.all[i].name)) i = text_.all[i].parent;
    return text_.all[i];
  }
  // What the language says of it; null if nothing.
  const KeyDoc* doc_of(const Written& key) const {
    const TableDoc* table = key.parent == kNone ? nullptr : doc_of_table(key.parent);
    return table ? table->find(std::get<std::string>(key.name)) : nullptr;
  }
  const TableDoc* doc_of_table(std::size_t i) const {
    if (i == 0) return &language::language_table("");
    const Written& written = key_of(i);
    const TableDoc* parent = doc_of_table(written.parent);
    const KeyDoc* key = parent ? parent->find(std::get<std::string>(written.name)) : nullptr;
    if (!key) return parent && parent->by_side ? parent : nullptr;
    const auto named = [](auto tables, std::string_view name) {
      const auto found = std::ranges::find(tables, name, &TableDoc::name);
      return found == tables.end() ? nullptr : &*found;
    };
    if (key->of == "step")
      if (const TableDoc* verb = named(language::language_verbs(), text_.text_of(i, "do")))
        return verb;
    return named(language::language_tables(), key->of.empty() ? "no table" : key->of);
  }
  bool has(std::size_t table, std::string_view key) const {
    return text_.find(table, std::string(key)) != kNone;
  }

  // A table that there is once is not written twice.
  void add_headings() {
    for (const TableDoc& table : language::language_tables())
      if (table.heading.starts_with("[[") ||
          (table.heading.starts_with("[") && !has(0, table.name)))
        add(table.heading.substr(0, table.heading.find(' ')), table.doc);
  }

  void add_keys() {
    const TableDoc* doc = doc_of_table(cursor_.of);
    if (!doc) return add_names_for_keys();
    for (const KeyDoc& key : doc->keys) {
      const bool has_heading = key.type == KeyType::table || key.type == KeyType::tables;
      if (!has(cursor_.of, key.key) && !(has_heading && cursor_.of == 0)) add(key.key, key.doc);
    }
  }

  // Of `in_leaves = { pink = 2 }`.
  void add_names_for_keys() {
    const KeyDoc* key = doc_of(key_of(cursor_.of));
    if (!key || key->type < KeyType::name_pairs || key->type > KeyType::name_points) return;
    for (const std::string_view name : names({"body", "pattern"}))
      if (!has(cursor_.of, name)) add(name, key->doc);
  }

  void add_values() {
    const KeyDoc* key = doc_of(key_of(cursor_.of));
    if (!key) return;
    if (key->type == KeyType::truth)
      for (const char* word : {"true", "false"}) add(word, key->doc);
    for (std::size_t i = 0; i < key->choices.size(); ++i)
      key->type == KeyType::whole ? add(std::to_string(i + 1), key->choices[i])
                                  : add_text(key->choices[i], key->doc);
    if (key->key == "do")
      for (const TableDoc& verb : language::language_verbs()) add_text(verb.name, verb.doc);
    if (key->key == "headline" || key->key == "y" || key->key == "bars")
      for (const language::CountDoc& count : language::known_counts())
        add_text(count.name, count.doc);
    if (const Naming* naming = naming_of(key->key))
      for (const std::string_view name : names(naming->lists)) add_text(name, key->doc);
  }

  // Of all tables in these lists.
  std::vector<std::string_view> names(const std::vector<std::string_view>& lists) const {
    std::vector<std::string_view> found;
    for (const std::string_view name : lists)
      if (const std::size_t list = text_.find(0, std::string(name)); list != kNone)
        for (std::size_t i = list; i < text_.all.size(); ++i)
          if (text_.all[i].parent == list)
            if (const auto own = text_.text_of(i, "name"); !own.empty()) found.push_back(own);
    return found;
  }

  WrittenText text_;
  Cursor cursor_;
  std::string_view begun_;
};

bool begins_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

}  // namespace

std::string complete_json(std::string_view text, int line, int column) {
  text = language::without_mark(text);
  std::size_t begin = 0;
  for (int i = 1; i < line && begin < text.size(); ++i)
    begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  std::size_t at = begin;
  for (int i = 1; i < column && at < text.size() && text[at] != '\n'; ++i) do
      ++at;
    while (at < text.size() && !begins_letter(text[at]));
  const Completion completion(text, at);
  const auto letters =
      std::ranges::count_if(text.substr(begin, completion.from - begin), begins_letter);
  const nlohmann::ordered_json answer{{"from", letters + 1}, {"words", completion.words}};
  return answer.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lantern::live
