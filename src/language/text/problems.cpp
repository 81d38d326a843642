#include "language/text/problems.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "base/error.hpp"
#include "base/number.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "language/scenario.hpp"

namespace lantern::language {
namespace {

constexpr std::string_view kMark = "\xef\xbb\xbf";  // U+FEFF, the byte order mark

// A letter that may stand in a scenario.
bool is_good(const Letter& letter) { return letter.code && *letter.code != 0; }

constexpr std::size_t kMostShown = 50;
constexpr std::size_t kMostKept = 2000;  // a file of nothing but mistakes must not fill the memory

constexpr int kMostKeyParts = 16;
constexpr int kMostKeyDots = 40'000;  // in a whole file

struct Harm {
  std::size_t offset = 0;  // in bytes
  std::string message;
};

// What must not be given to toml++ 3.3, which takes well-formed brackets and headers for granted in
// a few places and has no bound on some of its work:
//   a key of very many parts, each of which is a table in a table, torn down by recursion
//   very many dotted keys, whose tables are searched one after another
//   a [header] that does not begin with a name, a '}' in a list that is not closed
//   a letter beyond ASCII that is in no text and no comment
// One walk over the text, of valid UTF-8, that knows just enough TOML: comments, strings, brackets,
// and whether it is in a key or in a value. A text without harm may still be no TOML.
class Guard {
 public:
  explicit Guard(std::string_view text) : text_(text) {}

  // The first in the text, if there is one.
  std::optional<Harm> harm() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (c == '"' || c == '\'')
        skip_string(c);
      else if ((c & 0x80) != 0)
        return Harm{at_, "not valid TOML: a letter that may stand only in a \"text\""};
      else if (std::string message = pass(c); !message.empty())
        return Harm{at_, std::move(message)};
      else
        ++at_;
    }
    return std::nullopt;
  }

 private:
  // Says what is wrong with `c` at this place; empty if nothing is.
  std::string pass(char c) {
    const bool line_start = line_start_;
    line_start_ = c == '\n' || (line_start && (c == ' ' || c == '\t'));
    if (c == '.') return in_key_ ? pass_dot() : "";
    if (c == '=') return enter_key(false);
    if (c == ',') return enter_key(open_.ends_with('{'));
    if (c == '\n') return open_.empty() ? enter_key(true) : "";
    if (c == '[') return pass_bracket(line_start && open_.empty());
    if (c == ']' || c == '}') return pass_closing(c);
    if (c != '{') return "";
    open_ += c;
    return enter_key(true);
  }

  std::string enter_key(bool is_key) {
    in_key_ = is_key;
    parts_ = 1;
    return "";
  }

  std::string pass_dot() {
    if (++parts_ > kMostKeyParts) return fmt::format("a key of more than {} parts", kMostKeyParts);
    if (++dots_ > kMostKeyDots) return fmt::format("more than {} dots in keys", kMostKeyDots);
    return "";
  }

  std::string pass_bracket(bool is_header) {
    if (is_header && !has_name()) return "not valid TOML: a [header] without a name";
    const bool is_second = in_key_ && open_ == "[";  // of a [[header]]
    open_ += '[';
    return enter_key(is_header || is_second);
  }

  std::string pass_closing(char c) {
    if (c == '}' && open_.ends_with('['))
      return "not valid TOML: a '}' in a list that is not closed";
    if (!open_.empty()) open_.pop_back();
    return enter_key(false);
  }

  // Is there a name, or what toml++ can tell from one, behind the header's brackets?
  bool has_name() const {
    std::size_t next = at_ + (text_.substr(at_).starts_with("[[") ? 2 : 1);
    next = text_.find_first_not_of(" \t", next);
    if (next == std::string_view::npos) return true;
    const char c = text_[next];
    const bool is_bare = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_bare || std::string_view("-_\"']").find(c) != std::string_view::npos;
  }

  void skip_string(char quote) {
    const std::string_view rest = text_.substr(at_);
    const bool is_long = rest.size() > 2 && rest[1] == quote && rest[2] == quote;
    const std::string end(is_long ? 3 : 1, quote);
    at_ += end.size();
    line_start_ = false;
    while (at_ < text_.size()) {
      if (text_.substr(at_).starts_with(end)) {
        at_ += end.size();
        return;
      }
      if (!is_long && text_[at_] == '\n') return;
      at_ += quote == '"' && text_[at_] == '\\' ? 2 : 1;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string open_;  // brackets and braces that are not closed yet
  bool line_start_ = true;
  bool in_key_ = true;
  int parts_ = 1;  // of the key at `at_`
  int dots_ = 0;   // in keys so far
};

static_assert(TOML_MAX_NESTED_VALUES <= 256, "deep nesting would overflow the stack");

// What toml++ says, and how a lecturer would say it.
struct Plain {
  std::string_view technical;
  std::string_view message;
  std::string_view hint;
};
constexpr std::string_view kValues =
    "a value is a number, a \"text\", true, false, [a list] or { a = table }";
constexpr std::array kPlain = {
    Plain{"string: encountered end-of-file", "the file ends inside a text",
          "a closing quote is missing"},
    Plain{"control character", "a line break or control character where none may stand",
          "a text in \"quotes\" begins and ends on one line"},
    Plain{"unknown escape sequence", "an unknown \\ sequence in a text",
          "write \\\\ for a backslash, or put the text in 'single quotes'"},
    Plain{"array: encountered end-of-file", "the file ends inside a list", "a ']' is missing"},
    Plain{"expected comma or closing ']'", "two elements of a list need a comma between them", ""},
    Plain{"inline table: encountered end-of-file", "the file ends inside { }", "a '}' is missing"},
    Plain{"inline table: expected key or closing '}', saw '\\n'", "{ } must stand on one line",
          "use a table with its own header, as [step.expect], for more room"},
    Plain{"dangling comma", "no comma may stand before '}'", ""},
    Plain{"table header: encountered end-of-file", "the file ends inside a [header]",
          "a ']' is missing"},
    Plain{"table header: expected ']'", "a ']' is missing", "[[name]] has two on either side"},
    Plain{"leading zeroes", "a number may not begin with 0", ""},
    Plain{"could not be interpreted as a value", "this number is too large", ""},
    Plain{"is not representable in 64 bits", "this number is too large", ""},
    Plain{"boolean: ", "this is no value", "write true or false, in small letters"},
    Plain{"could not determine value type", "this is no value",
          "a text stands in \"quotes\"; numbers, true and false without"},
    Plain{"key-value pair: encountered end-of-file", "the file ends where a value is needed", ""},
    Plain{"value: encountered end-of-file", "the file ends where a value is needed", ""},
    Plain{"expected '=', saw '\\n'", "this line has a name but no value",
          "write name = value; a table's header stands in [brackets]"},
    Plain{"expected '='", "a '=' is missing after the key", "write name = value"},
    Plain{"pair: expected a comment or whitespace", "the line goes on behind its value",
          "one key a line"},
    Plain{"header: expected a comment or whitespace", "the line goes on behind its [header]", ""},
    Plain{"bare key starting character", "a key begins with a letter, a digit, - or _",
          "other letters need \"quotes\""},
    Plain{"expected keys, tables, whitespace", "a line begins with a key or a [header]", ""},
    Plain{"cannot exceed", "this value is too long", ""},
    Plain{"nested value depth", "lists within lists, far too deep", ""},
    Plain{"floating-point: expected decimal digit, saw '.'",
          "a number needs a digit before its dot", "write 0.5, not .5"},
    Plain{"closing ']', saw comma", "a value is missing before this comma", ""},
    Plain{"expected value, saw", "a value is missing", ""},
    Plain{"expected comma or closing '}'", "two pairs in { } need a comma between them", ""},
    Plain{"inclusive", "there is no such date or time", ""},
    Plain{"digit", "this is no number", kValues},
    Plain{"underscores", "this is no number", kValues},
    Plain{"expected value-terminator", "this is no value", kValues},
    Plain{"expected '", "this is no value", kValues},
};

// "cannot redefine existing integer 'a' as table": the name is all that matters.
bool add_redefined(Place where, std::string_view reason, Problems& problems) {
  constexpr std::string_view kRedefined = "cannot redefine existing ";
  const std::size_t at = reason.find(kRedefined);
  const std::size_t open = reason.find('\'', at);
  const std::size_t close = reason.rfind('\'');
  if (at == std::string_view::npos || open == std::string_view::npos || close <= open) return false;
  const std::string_view name = reason.substr(open + 1, close - open - 1);
  problems.add(where, fmt::format("{} is there already", in_quotes(name)),
               "each key and each [table] stands once; many of a kind are [[tables]]");
  return true;
}

void add_syntax_error(const toml::parse_error& error, Problems& problems) {
  const Place where{static_cast<int>(error.source().begin.line),
                    static_cast<int>(error.source().begin.column)};
  const std::string_view reason = error.description();
  if (add_redefined(where, reason, problems)) return;
  for (const Plain& plain : kPlain)
    if (reason.find(plain.technical) != std::string_view::npos)
      return problems.add(where, fmt::format("not valid TOML: {}", plain.message),
                          std::string(plain.hint));
  const std::size_t colon = reason.find(": ");
  const std::string_view rest = colon == std::string_view::npos ? reason : reason.substr(colon + 2);
  std::string shown = in_quotes(rest);
  problems.add(where, "not valid TOML: " + shown.substr(1, shown.size() - 2));
}

Place place_in(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

TomlValue converted(const toml::node& node);

TomlTable converted(const toml::table& table) {
  TomlTable entries;
  entries.reserve(table.size());
  for (const auto& [key, node] : table)
    entries.push_back({std::string(key.str()), place_in(key.source()), converted(node)});
  return entries;
}

TomlArray converted(const toml::array& array) {
  TomlArray values;
  values.reserve(array.size());
  for (const toml::node& node : array) values.push_back(converted(node));
  return values;
}

TomlValue converted(const toml::node& node) {
  TomlValue value{place_in(node.source()), TomlDate{}};
  if (const auto* table = node.as_table()) value.data = converted(*table);
  if (const auto* array = node.as_array()) value.data = converted(*array);
  if (const auto* text = node.as_string()) value.data = text->get();
  if (const auto* whole = node.as_integer()) value.data = whole->get();
  if (const auto* number = node.as_floating_point()) value.data = number->get();
  if (const auto* truth = node.as_boolean()) value.data = truth->get();
  return value;
}

}  // namespace

std::optional<std::size_t> first_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const Letter letter = first_letter(text.substr(i));
    if (!is_good(letter)) return i;
    i += letter.bytes;
  }
  return std::nullopt;
}

Place place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_break = before.rfind('\n');
  const std::size_t start = line_break == std::string_view::npos ? 0 : line_break + 1;
  return {1 + static_cast<int>(std::ranges::count(before, '\n')),
          1 + static_cast<int>(letters(before.substr(start)))};
}

std::string line_of(std::string_view text, int line) {
  if (line < 1) return {};
  text = without_mark(text);
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  std::string clean;
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    clean += is_good(letter) ? text.substr(0, letter.bytes) : "?";
    text.remove_prefix(letter.bytes);
  }
  return clean;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMostBytes = 60;
  std::size_t end = 0;
  while (end < text.size() && end + first_letter(text.substr(end)).bytes <= kMostBytes)
    end += first_letter(text.substr(end)).bytes;
  return "'" + printable(text.substr(0, end)) + (end < text.size() ? "…'" : "'");
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

Diagnostic diagnose(const Scenario& scenario, const SourcePosition& where, std::string message,
                    std::string suggestion) {
  return {where, std::move(message), line_of(scenario.text, where.line), std::move(suggestion),
          Severity::error};
}

void Problems::add(Place where, std::string message, Hint hint, bool once) {
  found_.push_back({where, std::move(message), std::move(hint), once});
  if (found_.size() > kMostKept) drop_the_latest();
}

void Problems::add(Place where, std::string message, std::string hint) {
  add(where, std::move(message), Hint([text = std::move(hint)] { return text; }));
}

void Problems::add(Place where, std::string message, const char* hint) {
  add(where, std::move(message), std::string(hint));
}

void Problems::add_unknown(Place where, std::string_view kind, const std::string& name,
                           Known known) {
  add(
      where, fmt::format("there is no {} {}", kind, in_quotes(name)),
      [name, known = std::move(known)] { return nearest(name, known()); }, true);
}

void Problems::add_readings(const std::vector<std::pair<std::string, const Problems*>>& readings) {
  using Key = std::pair<Place, std::string>;
  std::map<Key, std::set<const Problems*>> finders;
  for (const auto& [name, problems] : readings)
    for (const Found& f : problems->found_) finders[{f.where, f.message}].insert(problems);
  for (const Found& f : found_) finders.erase({f.where, f.message});
  for (const auto& [name, problems] : readings) {
    dropped_ += problems->dropped_;
    for (const Found& f : problems->found_) {
      const auto at = finders.find({f.where, f.message});
      if (at == finders.end()) continue;
      const bool by_all = at->second.size() == readings.size();
      if (by_all) finders.erase(at);
      add(f.where, by_all ? f.message : fmt::format("{}, on the side '{}'", f.message, name),
          f.hint, f.once);
    }
  }
}

// Keeps those that will be shown, and the one after them.
void Problems::drop_the_latest() {
  std::ranges::stable_sort(found_, {}, &Found::where);
  dropped_ += found_.size() - (kMostShown + 1);
  found_.resize(kMostShown + 1);
}

void Problems::tell_unknown_once() {
  std::map<std::string, std::size_t> times;
  for (const Found& f : found_) times[f.message] += f.once;
  std::set<std::string> told;
  std::erase_if(found_, [&](const Found& f) { return f.once && !told.insert(f.message).second; });
  for (Found& f : found_)
    if (const std::size_t others = times[f.message]; f.once && others > 1)
      f.message += fmt::format(", here and {} more", counted(others - 1, "time"));
}

void Problems::raise(const std::string& file, std::string_view text) {
  if (found_.empty()) return;
  std::ranges::stable_sort(found_, {}, &Found::where);
  // A mistake in a prototype is found again in each body that is like it.
  const auto repeats = std::ranges::unique(found_, [](const Found& a, const Found& b) {
    return a.where == b.where && a.message == b.message;
  });
  found_.erase(repeats.begin(), repeats.end());
  tell_unknown_once();
  std::vector<Diagnostic> diagnostics;
  for (const Found& f : found_) {
    const SourcePosition where{file, f.where.line, f.where.column};
    if (diagnostics.size() == kMostShown) {
      const std::size_t more = found_.size() - kMostShown + dropped_;
      diagnostics.push_back(
          {where, fmt::format("and {} more mistake{}", more, more == 1 ? "" : "s"), "", ""});
      break;
    }
    diagnostics.push_back({where, f.message, line_of(text, f.where.line), f.hint ? f.hint() : ""});
  }
  throw ScenarioError(std::move(diagnostics));
}

std::string nearest(std::string_view name, std::vector<std::string_view> candidates) {
  constexpr std::size_t kMostCompared = 1000;
  if (candidates.size() > kMostCompared) candidates.resize(kMostCompared);
  return suggestion(name, candidates, 40);
}

const TomlEntry* entry_of(const TomlTable& table, std::string_view key) {
  const auto found = std::ranges::find(table, key, &TomlEntry::key);
  return found == table.end() ? nullptr : &*found;
}

TomlTable read_toml(std::string_view text, Problems& problems) {
  if (const auto bad = first_bad_byte(text)) {
    const bool nul = text[*bad] == '\0';
    problems.add(place_of(text, *bad),
                 nul ? "the file has a NUL byte" : "the file has bytes that are not UTF-8",
                 "is this really a text file? Save it as UTF-8");
    return {};
  }
  if (const auto harm = Guard(text).harm()) {
    problems.add(place_of(text, harm->offset), harm->message);
    return {};
  }
  try {
    return converted(toml::parse(text));
  } catch (const toml::parse_error& error) {
    add_syntax_error(error, problems);
  }
  return {};
}

}  // namespace lantern::language
