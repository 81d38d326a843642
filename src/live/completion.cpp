// Completion: a reader that takes each line as well as it can, since what is being written is
// mostly no TOML, and notes where the cursor is.
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "language/counts.hpp"
#include "language/language.hpp"
#include "live/controls.hpp"

namespace lantern::live {
namespace {

using language::KeyDoc;
using language::KeyType;
using language::TableDoc;

constexpr std::size_t kNone = std::string_view::npos;
constexpr int kDeepest = 64;  // lists and tables within each other: the stack has an end

// One that is written: [x], { … }, or what dotted keys name.
struct WrittenTable {
  std::size_t parent = kNone;
  std::string key;                                         // in the parent
  std::map<std::string, std::string, std::less<>> keys{};  // with their texts, where they are some
  int depth = 0;
};

struct Cursor {
  enum class In { nothing, heading, key, value };
  In in = In::nothing;
  std::size_t from = 0;  // where the word begins
  std::size_t table = 0;
  std::string key{};       // of the value
  bool is_quoted = false;  // within the quotes of a text
};

class LooseReader {
 public:
  LooseReader(std::string_view text, std::size_t cursor) : text_(text), cursor_at_(cursor) {
    tables_.push_back({});
    while (at_ <= text_.size()) read_statement();
  }

  const Cursor& cursor() const { return cursor_; }
  const WrittenTable& table(std::size_t i) const { return tables_[i]; }

  // Null where the language has none.
  const TableDoc* doc_of(std::size_t i) const {
    const WrittenTable& table = tables_[i];
    if (table.parent == kNone) return &language::language_table("");
    const TableDoc* parent = doc_of(table.parent);
    const KeyDoc* key = parent ? parent->find(table.key) : nullptr;
    if (!key) return parent && parent->by_side ? parent : nullptr;
    const auto find = [](auto tables, std::string_view name) {
      const auto found = std::ranges::find(tables, name, &TableDoc::name);
      return found == tables.end() ? nullptr : &*found;
    };
    if (const auto verb = table.keys.find("do"); key->of == "step" && verb != table.keys.end())
      if (const TableDoc* found = find(language::language_verbs(), verb->second)) return found;
    return find(language::language_tables(), key->of.empty() ? "no table" : key->of);
  }

  // Of all tables [[list]], what `name` says there.
  void add_names(std::string_view list, std::vector<std::string>& names) const {
    for (const WrittenTable& table : tables_)
      if (const auto name = table.keys.find("name");
          table.parent == 0 && table.key == list && name != table.keys.end())
        names.push_back(name->second);
  }

 private:
  char now() const { return at_ < text_.size() ? text_[at_] : '\n'; }
  bool is_cursor_from(std::size_t begin) const { return begin <= cursor_at_ && cursor_at_ <= at_; }
  void skip_until(std::string_view ends) {
    while (at_ < text_.size() && ends.find(text_[at_]) == kNone) ++at_;
  }
  // Blanks, within which a key or value may begin.
  void skip(std::string_view blanks, Cursor if_here) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && blanks.find(text_[at_]) != kNone) ++at_;
    if_here.from = cursor_at_;
    if (is_cursor_from(begin)) cursor_ = std::move(if_here);
  }
  void skip_comment() {
    const std::size_t begin = at_ + 1;
    skip_until("\n");
    if (is_cursor_from(begin)) cursor_ = {};
  }

  void read_statement() {
    skip(" \t\r", {Cursor::In::key, 0, here_});
    if (now() == '[')
      read_heading();
    else if (now() != '\n' && now() != '#')
      read_key(here_);
    if (begins_statement()) return;  // a list was left open
    skip_until("\n#");
    if (now() == '#') skip_comment();
    ++at_;
  }

  // Does a line begin here that can only be a statement, whatever is open?
  bool begins_statement() const {
    std::size_t i = at_;
    while (i > 0 && (text_[i - 1] == ' ' || text_[i - 1] == '\t')) --i;
    if (i > 0 && text_[i - 1] != '\n') return false;
    const std::string_view line = text_.substr(at_, text_.find('\n', at_) - at_);
    const std::size_t begin = line.find_first_not_of('[');
    if (begin == kNone || begin > 2) return false;
    std::size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_.", begin);
    if (end == kNone || end == begin) return false;
    if (begin > 0) return line[end] == ']';
    end = line.find_first_not_of(" \t", end);
    return end != kNone && line[end] == '=';
  }

  // The latest of its name in the parent, or a new one; far too deep it is the parent.
  std::size_t child(std::size_t parent, const std::string& key, bool is_new) {
    const int depth = tables_[parent].depth + 1;
    if (depth > kDeepest) return parent;
    tables_[parent].keys.try_emplace(key);
    const auto [latest, is_first] = latest_.try_emplace({parent, key}, tables_.size());
    if (!is_first && !is_new) return latest->second;
    latest->second = tables_.size();
    tables_.push_back({parent, key, {}, depth});
    return latest->second;
  }

  static std::string without_blanks(std::string_view text) {
    std::string bare(text);
    std::erase_if(bare, [](char c) { return std::string_view(" \t\r\"'[]").find(c) != kNone; });
    return bare;
  }
  // The table that all names but the last lead to, and the last.
  std::pair<std::size_t, std::string> way_of(std::size_t table, std::string_view dotted) {
    for (std::size_t dot; (dot = dotted.find('.')) != kNone; dotted.remove_prefix(dot + 1))
      table = child(table, without_blanks(dotted.substr(0, dot)), false);
    return {table, without_blanks(dotted)};
  }

  void read_heading() {
    const std::size_t begin = at_;
    skip_until("\n#");
    if (is_cursor_from(begin)) {
      cursor_ = {Cursor::In::heading, begin};
      return;  // it is being written
    }
    const auto [parent, key] = way_of(0, text_.substr(begin, at_ - begin));
    here_ = child(parent, key, true);
  }

  void read_key(std::size_t table) {
    const std::size_t begin = at_;
    skip_until("=\n,{}[]#");
    const bool is_here = is_cursor_from(begin);
    const std::string_view written = text_.substr(begin, at_ - begin);
    if (is_here) {
      const std::string_view before = text_.substr(begin, cursor_at_ - begin);
      const std::size_t dot = before.rfind('.');
      const std::size_t from = dot == kNone ? begin : begin + dot + 1;
      cursor_ = {Cursor::In::key, from, way_of(table, before).first};
    }
    if (now() != '=') return;
    ++at_;
    const auto [owner, key] = way_of(table, written);
    if (!is_here) tables_[owner].keys.try_emplace(key);
    read_value(owner, key);
  }

  void read_value(std::size_t table, const std::string& key) {
    const Cursor if_here{Cursor::In::value, 0, table, key};
    skip(" \t\r", if_here);
    const std::size_t begin = at_;
    const bool is_nested = now() == '[' || now() == '{';
    if (is_nested && depth_ == kDeepest) return void(++at_);
    depth_ += is_nested;
    read_one_value(table, key, begin);
    depth_ -= is_nested;
  }

  void read_one_value(std::size_t table, const std::string& key, std::size_t begin) {
    switch (now()) {
      case '"':
      case '\'':
        return read_text(table, key);
      case '[':
        return read_list(table, key);
      case '{':
        return read_inline(child(table, key, true));
      default:
        skip_until(",[]{}\n# ");
        if (is_cursor_from(begin)) cursor_ = {Cursor::In::value, begin, table, key};
    }
  }

  void read_text(std::size_t table, const std::string& key) {
    const std::string_view quote = text_.substr(at_, 1);
    const bool is_long = text_.substr(at_, 3) == std::string(3, quote[0]);
    const std::size_t begin = at_ += is_long ? 3 : 1;
    while (at_ < text_.size() && (is_long || now() != '\n') &&
           (is_long ? text_.substr(at_, 3) != std::string(3, quote[0]) : now() != quote[0]))
      at_ += now() == '\\' && quote == "\"" ? 2 : 1;
    at_ = std::min(at_, text_.size());
    if (is_cursor_from(begin)) cursor_ = {Cursor::In::value, begin, table, key, true};
    tables_[table].keys[key] = text_.substr(begin, at_ - begin);
    if (now() != '\n' || is_long) at_ = std::min(at_ + (is_long ? 3 : 1), text_.size());
  }

  void read_list(std::size_t table, const std::string& key) {
    ++at_;
    do {
      skip(" \t\r\n", {Cursor::In::value, 0, table, key});
      if (begins_statement() || now() == '}') return;
      if (now() == '#')
        skip_comment();
      else if (now() == ',')
        ++at_;
      else if (now() == ']')
        return void(++at_);
      else
        read_value(table, key);
    } while (at_ < text_.size());
  }

  void read_inline(std::size_t table) {
    ++at_;
    do {
      skip(" \t\r", {Cursor::In::key, 0, table});
      if (now() == '}') return void(++at_);
      if (now() == '\n' || now() == '#' || now() == ']') return;
      if (now() == ',' || now() == '[' || now() == '{')
        ++at_;
      else
        read_key(table);
    } while (at_ < text_.size());
  }

  std::string_view text_;
  std::size_t cursor_at_;
  std::size_t at_ = 0;
  std::size_t here_ = 0;  // whose heading stands above
  int depth_ = 0;         // of the value that is read
  std::vector<WrittenTable> tables_;
  std::map<std::pair<std::size_t, std::string>, std::size_t> latest_;
  Cursor cursor_;
};

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
      : reader_(text, cursor),
        cursor_(reader_.cursor()),
        begun_(text.substr(cursor_.from, cursor - cursor_.from)) {
    if (cursor_.in == Cursor::In::heading) add_headings();
    if (cursor_.in == Cursor::In::key) add_keys();
    if (cursor_.in == Cursor::In::value) add_values();
  }

  nlohmann::ordered_json words = nlohmann::ordered_json::array();

 private:
  void add(std::string_view word, std::string_view means) {
    if (word.starts_with(begun_)) words.push_back({{"word", word}, {"means", means}});
  }
  void add_text(std::string_view text, std::string_view means) {
    add(cursor_.is_quoted ? std::string(text) : '"' + std::string(text) + '"', means);
  }

  // A table that there is once is not written twice.
  void add_headings() {
    for (const TableDoc& table : language::language_tables())
      if (table.heading.starts_with("[[") ||
          (table.heading.starts_with("[") && !reader_.table(0).keys.contains(table.name)))
        add(table.heading.substr(0, table.heading.find(' ')), table.doc);
  }

  void add_keys() {
    const TableDoc* doc = reader_.doc_of(cursor_.table);
    const WrittenTable& table = reader_.table(cursor_.table);
    if (!doc) return add_names_for_keys(table);
    for (const KeyDoc& key : doc->keys) {
      const bool has_heading = key.type == KeyType::table || key.type == KeyType::tables;
      if (!table.keys.contains(key.key) && !(has_heading && cursor_.table == 0))
        add(key.key, key.doc);
    }
  }

  // Of `in_leaves = { pink = 2 }`.
  void add_names_for_keys(const WrittenTable& table) {
    const TableDoc* parent = table.parent == kNone ? nullptr : reader_.doc_of(table.parent);
    const KeyDoc* key = parent ? parent->find(table.key) : nullptr;
    if (!key || key->type < KeyType::name_pairs || key->type > KeyType::name_points) return;
    for (const std::string& name : names({"body", "pattern"}))
      if (!table.keys.contains(name)) add(name, key->doc);
  }

  void add_values() {
    const TableDoc* doc = reader_.doc_of(cursor_.table);
    const KeyDoc* key = doc ? doc->find(cursor_.key) : nullptr;
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
      for (const std::string& name : names(naming->lists)) add_text(name, key->doc);
  }

  std::vector<std::string> names(const std::vector<std::string_view>& lists) const {
    std::vector<std::string> found;
    for (const std::string_view list : lists) reader_.add_names(list, found);
    return found;
  }

  LooseReader reader_;
  const Cursor& cursor_;
  std::string_view begun_;

 public:
  std::size_t from() const { return cursor_.in == Cursor::In::nothing ? kNone : cursor_.from; }
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
  const std::size_t from = std::min(completion.from(), at);
  const auto letters = std::ranges::count_if(text.substr(begin, from - begin), begins_letter);
  const nlohmann::ordered_json answer{{"from", letters + 1}, {"words", completion.words}};
  return answer.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace lantern::live
