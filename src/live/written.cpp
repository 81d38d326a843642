#include "live/written.hpp"

#include <algorithm>

#include "language/text/problems.hpp"

namespace lantern::live {
namespace {

// Lists and tables within each other, and parts of a key: TOML's reader takes no more, and the
// stack has an end.
constexpr int kDeepest = 256;
constexpr std::size_t kMostParts = 16;

class Scanner {
 public:
  Scanner(std::string_view text, std::size_t cursor) : text_(text), cursor_at_(cursor) {
    read.text = text;
  }

  void pass_all() {
    while (at_ <= text_.size()) pass_statement();
  }

  // The keys from the start of the text on, with their [indexes]; nothing if there is more.
  TomlPath pass_path() {
    TomlPath path;
    while (at_ < text_.size()) {
      if (here() == '[' && !path.empty()) {
        const std::size_t begin = ++at_;
        pass("0123456789");
        const std::string digits(text_.substr(begin, at_ - begin));
        if (digits.empty() || digits.size() > 9 || here() != ']') return {};
        path.emplace_back(std::stoul(digits));
        ++at_;
      } else {
        if (path.empty() == (here() == '.')) return {};
        at_ += here() == '.';
        const std::size_t begin = at_;
        path.emplace_back(pass_key(".["));
        if (at_ == begin) return {};
      }
    }
    return path;
  }

  WrittenText read;

 private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\n'; }
  bool is_cursor_from(std::size_t begin) const { return begin <= cursor_at_ && cursor_at_ <= at_; }
  void pass(std::string_view letters) {
    at_ = std::min(text_.find_first_not_of(letters, at_), text_.size());
  }
  void pass_until(std::string_view ends) {
    at_ = std::min(text_.find_first_of(ends, at_), text_.size());
  }

  // The table of that key, and of a list of [[tables]] the last one so far.
  std::size_t table_of(std::size_t parent, const std::string& key) {
    std::size_t table = read.find(parent, key);
    if (table == kNone) table = read.add({Written::named, parent, key});
    const std::size_t headers = read.all[table].headers;
    return headers > 0 ? read.find(table, headers - 1) : table;
  }

  void pass_blanks(std::string_view blanks, Cursor if_here) {
    const std::size_t begin = at_;
    pass(blanks);
    if_here.from = cursor_at_;
    if (is_cursor_from(begin)) read.cursor = if_here;
  }

  void pass_comment() {
    const std::size_t begin = at_ + 1;
    pass_until("\n");
    if (is_cursor_from(begin)) read.cursor = {};
  }

  // A text, which ends with its line at the latest if it is not a long one.
  void pass_quoted(std::size_t of) {
    const char quote = here();
    const bool is_long = text_.substr(at_ + 1).starts_with(std::string(2, quote));
    const std::string end(is_long ? 3 : 1, quote);
    const std::size_t begin = at_ += end.size();
    while (at_ < text_.size() && !text_.substr(at_).starts_with(end) && (is_long || here() != '\n'))
      at_ += quote == '"' && here() == '\\' ? 2 : 1;
    at_ = std::min(at_, text_.size());
    if (is_cursor_from(begin)) read.cursor = {Cursor::In::value, begin, of, true};
    if (!text_.substr(at_).starts_with(end)) return;
    at_ += end.size();
    for (int more = 0; is_long && more < 2 && here() == quote; ++more) ++at_;
  }

  std::string pass_key(std::string_view ends) {
    const std::size_t begin = at_;
    const bool is_quoted = here() == '"' || here() == '\'';
    is_quoted ? pass_quoted(0) : pass_until(ends);
    const std::string written(text_.substr(begin, at_ - begin));
    if (!is_quoted) return written;
    Problems problems;
    const TomlTable pair = read_toml(written + " = 0", problems);
    return pair.empty() ? written : pair.front().key;
  }

  // Keys with dots between them: those before the last one lead to its table.
  std::string pass_keys(std::size_t& table) {
    for (std::size_t parts = 1;; ++parts, ++at_) {
      pass_blanks(" \t", {Cursor::In::key, 0, table});
      const std::size_t begin = at_;
      std::string key = pass_key(" \t\r\n.=,{}[]#");
      if (is_cursor_from(begin)) {
        read.cursor = {Cursor::In::key, begin, table};
        key.clear();
      }
      pass(" \t");
      if (here() != '.') return key;
      if (parts < kMostParts) table = table_of(table, key);
    }
  }

  void pass_statement() {
    pass_blanks(" \t\r", {Cursor::In::key, 0, section_});
    if (here() == '[')
      pass_header();
    else if (here() != '\n' && here() != '#')
      pass_pair(section_, Written::line);
    if (begins_statement()) return;  // a list was left open
    pass_until("\n#");
    if (here() == '#') pass_comment();
    ++at_;
  }

  void pass_header() {
    const std::size_t begin = at_;
    const bool is_list = text_.substr(at_).starts_with("[[");
    at_ += is_list ? 2 : 1;
    std::size_t table = 0;
    const std::string key = pass_keys(table);
    pass("]");
    const std::size_t end = at_;
    pass_until("\n#");
    if (is_cursor_from(begin)) return void(read.cursor = {Cursor::In::heading, begin});
    if (is_list) {
      std::size_t list = read.find(table, key);
      if (list == kNone) list = read.add({Written::named, table, key});
      table = read.add({Written::header, list, read.all[list].headers});
      ++read.all[list].headers;
    } else {
      table = table_of(table, key);
    }
    section_ = table;
    read.all[table].form = Written::header;
    read.all[table].begin = begin;
    read.all[table].end = end;
  }

  void pass_pair(std::size_t table, Written::Form form) {
    const std::size_t begin = at_, above = table;
    const std::string key = pass_keys(table);
    if (here() != '=') return;
    ++at_;
    pass_value(read.add({form, table, key, above, begin}));
  }

  void pass_value(std::size_t of) {
    pass_blanks(" \t\r", {Cursor::In::value, 0, of});
    const std::size_t begin = read.all[of].value = at_;
    const char c = here();
    if (c == '"' || c == '\'') {
      pass_quoted(of);
    } else if (c == '[' || c == '{') {
      ++at_;
      if (++depth_ <= kDeepest) c == '[' ? pass_list(of) : pass_braces(of);
      --depth_;
    } else {  // a date may have a blank within
      pass_until(",[]{}#\n");
      while (at_ > begin && std::string_view(" \t\r").find(text_[at_ - 1]) != kNone) --at_;
      if (is_cursor_from(begin)) read.cursor = {Cursor::In::value, begin, of};
    }
    read.all[of].end = at_;
  }

  void pass_list(std::size_t of) {
    std::size_t i = 0;
    do {
      pass_blanks(" \t\r\n,", {Cursor::In::value, 0, of});
      if (at_ == text_.size() || here() == '}' || begins_statement()) return;
      if (here() == '#')
        pass_comment();
      else if (here() == ']')
        return void(++at_);
      else
        pass_value(read.add({Written::element, of, i++, of, at_}));
    } while (at_ < text_.size());
  }

  void pass_braces(std::size_t of) {
    do {
      pass_blanks(" \t\r,", {Cursor::In::key, 0, of});
      if (here() == '}') return void(++at_);
      if (here() == '\n' || here() == '#' || here() == ']') return;
      if (here() == '[' || here() == '{')
        ++at_;
      else
        pass_pair(of, Written::inner);
    } while (at_ < text_.size());
  }

  // Does a line begin here that can only be a statement, whatever is open?
  bool begins_statement() const {
    if (cursor_at_ == kNone) return false;  // of TOML all is closed
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

  std::string_view text_;
  std::size_t cursor_at_;
  std::size_t at_ = 0;
  std::size_t section_ = 0;  // whose header stands above
  int depth_ = 0;            // of the value that is read
};

}  // namespace

WrittenText read_written(std::string_view text, std::size_t cursor) {
  Scanner scanner(text, cursor);
  scanner.pass_all();
  return std::move(scanner.read);
}

TomlPath path_of(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  const TomlPath path = Scanner(text, kNone).pass_path();
  return path.size() > kLongest ? TomlPath() : path;
}

std::size_t WrittenText::find(std::size_t parent, const PathPart& name) const {
  const auto found = latest.find({parent, name});
  return found == latest.end() ? kNone : found->second;
}

bool WrittenText::is_within(std::size_t one, std::size_t outer) const {
  while (one != kNone && one != outer) one = all[one].parent;
  return one != kNone;
}

std::string_view WrittenText::text_of(std::size_t parent, const PathPart& name) const {
  const std::size_t found = find(parent, name);
  if (found == kNone) return {};
  std::string_view value = text.substr(all[found].value, all[found].end - all[found].value);
  if (!value.starts_with('"') && !value.starts_with('\'')) return {};
  const char quote = value[0];
  value.remove_prefix(std::min(value.find_first_not_of(quote), value.size()));
  return value.substr(0, value.find_last_not_of(quote) + 1);
}

std::size_t WrittenText::add(Written written) {
  latest[{written.parent, written.name}] = all.size();
  all.push_back(std::move(written));
  return all.size() - 1;
}

}  // namespace lantern::live
