#include "live/edit.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "language/text/problems.hpp"

namespace lantern::live {
namespace {

constexpr std::string_view kBareKey =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

using PathPart = std::variant<std::string, std::size_t>;  // a key, or an index in a list
using TomlPath = std::vector<PathPart>;
constexpr std::size_t kMostParts = 64;  // of a path: each is a call within the one before

TomlTable tree_of(std::string_view text, std::string_view what) {
  Problems problems;
  TomlTable tree = read_toml(without_mark(text), problems);
  try {
    problems.raise("", text);
  } catch (const ScenarioError& error) {
    const Diagnostic& first = error.diagnostics().front();
    throw Refused("{}, line {}: {}", what, first.where.line, first.message);
  }
  return tree;
}

// `key` in quotes where it needs them.
std::string written_key(const std::string& key) {
  if (!key.empty() && key.find_first_not_of(kBareKey) == std::string::npos) return key;
  std::string quoted = "\"";
  for (const char c : key)
    quoted += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
  return quoted + '"';
}

// Keys with dots between them; an index says no more than a [[header]] does.
std::string written_keys(std::span<const PathPart> path) {
  std::string keys;
  for (const PathPart& part : path)
    if (const auto* key = std::get_if<std::string>(&part))
      keys += (keys.empty() ? "" : ".") + written_key(*key);
  return keys;
}

// Where something is written: a header from `begin` to `end`, a pair from its key at `begin` and
// its value at `value`, an element of a list from `begin` and `value`.
struct TomlSpot {
  enum Form { header, line, inner, element };
  Form form = header;
  TomlPath path;
  std::size_t base = 0;  // how many parts of the path are of the table that it is written in
  std::size_t begin = 0, value = 0, end = 0;

  bool is_pair() const { return form == line || form == inner; }
};

bool is_within(const TomlPath& path, std::span<const PathPart> outer) {
  return path.size() >= outer.size() &&
         std::ranges::equal(outer, std::span(path).first(outer.size()));
}

// All spots of a text that is TOML, in their order.
class SpotScanner {
 public:
  explicit SpotScanner(std::string_view text) : text_(text) {
    for (pass_blanks(); at_ < text_.size(); pass_blanks())
      if (text_[at_] == '[')
        take_header();
      else
        take_pair(TomlPath(section_), TomlSpot::line);
  }

  std::vector<TomlSpot> spots;

  // The keys from the start of the text on, with their [indexes]; nothing if there is more.
  static std::optional<TomlPath> path_of(std::string_view text) {
    SpotScanner scanner("");
    scanner.text_ = text;
    TomlPath path;
    while (scanner.at_ < text.size()) {
      const char c = text[scanner.at_];
      if (c == '[' && !path.empty()) {
        const std::size_t end =
            std::min(text.find_first_not_of("0123456789", ++scanner.at_), text.size());
        const std::string digits(text.substr(scanner.at_, end - scanner.at_));
        if (digits.empty() || digits.size() > 9 || !text.substr(end).starts_with(']')) return {};
        path.emplace_back(std::stoul(digits));
        scanner.at_ = end + 1;
      } else {
        if (path.empty() == (c == '.')) return {};
        scanner.at_ += c == '.';
        const std::size_t before = scanner.at_;
        path.emplace_back(scanner.key(".["));
        if (scanner.at_ == before) return {};
      }
    }
    if (path.empty() || path.size() > kMostParts) return {};
    return path;
  }

 private:
  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  // And comments, line breaks and commas.
  void pass_blanks() {
    while (at_ < text_.size() && std::string_view(" \t\r\n,#").find(text_[at_]) != text_.npos)
      at_ = text_[at_] == '#' ? std::min(text_.find('\n', at_), text_.size()) : at_ + 1;
  }

  void pass_string() {
    const char quote = here();
    const bool is_long = text_.substr(at_ + 1).starts_with(std::string(2, quote));
    const std::string end(is_long ? 3 : 1, quote);
    at_ += end.size();
    while (at_ < text_.size() && !text_.substr(at_).starts_with(end))
      at_ += quote == '"' && here() == '\\' ? 2 : 1;
    at_ = std::min(at_ + end.size(), text_.size());
    for (int more = 0; is_long && more < 2 && here() == quote; ++more) ++at_;
  }

  // A bare key goes on to one of `ends`.
  std::string key(std::string_view ends = " \t.=]") {
    const std::size_t begin = at_;
    const bool is_quoted = here() == '"' || here() == '\'';
    if (is_quoted)
      pass_string();
    else
      at_ = std::min(text_.find_first_of(ends, at_), text_.size());
    const std::string written(text_.substr(begin, at_ - begin));
    return is_quoted ? tree_of(written + " = 0", "this key").front().key : written;
  }

  std::vector<std::string> keys() {
    std::vector<std::string> found;
    for (;; ++at_) {
      pass_blanks();
      found.push_back(key());
      pass_blanks();
      if (here() != '.') return found;
    }
  }

  // A header's keys mean the last table so far of each list on their way.
  void take_header() {
    TomlSpot spot;
    spot.begin = at_;
    const bool is_list = text_.substr(at_).starts_with("[[");
    at_ += is_list ? 2 : 1;
    const std::vector<std::string> names = keys();
    for (std::size_t i = 0; i < names.size(); ++i) {
      spot.path.emplace_back(names[i]);
      std::size_t& tables = tables_[spot.path];
      if (is_list && i + 1 == names.size()) ++tables;
      if (tables > 0) spot.path.emplace_back(tables - 1);
    }
    at_ += is_list ? 2 : 1;
    spot.base = spot.path.size();
    spot.value = spot.end = at_;
    section_ = spot.path;
    spots.push_back(std::move(spot));
  }

  void take_pair(TomlPath path, TomlSpot::Form form) {
    const std::size_t base = path.size(), begin = at_;
    for (std::string& name : keys()) path.emplace_back(std::move(name));
    ++at_;  // '='
    pass_blanks();
    take_value({form, std::move(path), base, begin, at_});
  }

  void take_value(TomlSpot spot) {
    const std::size_t index = spots.size();
    const TomlPath path = spot.path;
    spots.push_back(std::move(spot));
    const char c = here();
    if (c == '[' || c == '{') {
      ++at_;
      pass_blanks();
      for (std::size_t i = 0; at_ < text_.size() && here() != (c == '[' ? ']' : '}'); ++i) {
        if (c == '[') {
          TomlPath inner = path;
          inner.emplace_back(i);
          take_value({TomlSpot::element, std::move(inner), path.size(), at_, at_});
        } else {
          take_pair(path, TomlSpot::inner);
        }
        pass_blanks();
      }
      ++at_;
    } else if (c == '"' || c == '\'') {
      pass_string();
    } else {  // a date may have a blank within
      const std::size_t begin = at_;
      at_ = std::min(text_.find_first_of(",]}#\r\n", at_), text_.size());
      while (at_ > begin && (text_[at_ - 1] == ' ' || text_[at_ - 1] == '\t')) --at_;
    }
    spots[index].end = at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  TomlPath section_;
  std::map<TomlPath, std::size_t> tables_;  // of each [[list]] so far
};

TomlPath checked_path(std::string_view path) {
  const auto found = SpotScanner::path_of(path);
  if (!found) throw Refused("{} is no path of a value", in_quotes(path));
  return *found;
}

// What is there; null if nothing is.
const TomlValue* value_in(const TomlValue& root, std::span<const PathPart> path) {
  const TomlValue* at = &root;
  for (const PathPart& part : path) {
    if (const auto* key = std::get_if<std::string>(&part)) {
      const auto* table = std::get_if<TomlTable>(&at->data);
      const TomlEntry* entry = table ? entry_of(*table, *key) : nullptr;
      at = entry ? &entry->value : nullptr;
    } else {
      const auto* list = std::get_if<TomlArray>(&at->data);
      const std::size_t index = std::get<std::size_t>(part);
      at = list && index < list->size() ? &(*list)[index] : nullptr;
    }
    if (!at) return nullptr;
  }
  return at;
}

// Puts the value there, or takes out what is there, and the tables that only the last `written`
// parts of the path have made.
void put(TomlValue& at, std::span<const PathPart> path, const TomlValue* value,
         std::size_t written = 1) {
  if (path.empty()) {
    at = *value;
  } else if (const auto* index = std::get_if<std::size_t>(&path[0])) {
    auto& list = std::get<TomlArray>(at.data);
    if (value || path.size() > 1) return put(list.at(*index), path.subspan(1), value, written);
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(*index));
  } else {
    const auto& key = std::get<std::string>(path[0]);
    auto& table = std::get<TomlTable>(at.data);
    auto entry = std::ranges::lower_bound(table, key, {}, &TomlEntry::key);
    if (entry == table.end() || entry->key != key)
      entry = table.insert(entry, {key, {}, {{}, TomlTable{}}});
    if (value || path.size() > 1) put(entry->value, path.subspan(1), value, written);
    const auto* rest = std::get_if<TomlTable>(&entry->value.data);
    if (!value && (path.size() == 1 || (path.size() <= written && rest && rest->empty())))
      table.erase(entry);
  }
}

bool is_same(const TomlValue& a, const TomlValue& b) {
  return std::visit(
      [&](const auto& mine) {
        using Data = std::decay_t<decltype(mine)>;
        const auto* other = std::get_if<Data>(&b.data);
        if (!other) return false;
        if constexpr (std::is_same_v<Data, TomlArray>)
          return std::ranges::equal(mine, *other, is_same);
        else if constexpr (std::is_same_v<Data, TomlTable>)
          return std::ranges::equal(mine, *other, [](const TomlEntry& x, const TomlEntry& y) {
            return x.key == y.key && is_same(x.value, y.value);
          });
        else if constexpr (std::is_same_v<Data, TomlDate>)
          return true;
        else
          return mine == *other || (mine != mine && *other != *other);  // nan
      },
      a.data);
}

// One change to a text: what it is now, and what it shall say then.
class Edit {
 public:
  explicit Edit(std::string_view text)
      : text_(text), tree_{{}, tree_of(text, "the text")}, spots_(SpotScanner(whole()).spots) {
    const std::size_t first = whole().find('\n');
    if (first != 0 && first != text.npos && whole()[first - 1] == '\r') line_end_ = "\r\n";
  }

  // Without its byte order mark, which no place counts.
  std::string_view whole() const { return without_mark(text_); }
  const TomlValue& tree() const { return tree_; }

  // Where the value is written, if that is one place.
  const TomlSpot* spot_of(const TomlPath& path) const {
    const auto found = std::ranges::find_if(spots_, [&](const TomlSpot& spot) {
      return spot.form != TomlSpot::header && spot.path == path;
    });
    return found == spots_.end() ? nullptr : &*found;
  }

  std::string replaced(const TomlPath& path, std::string_view value) {
    const TomlValue read = one_value(value);
    if (const TomlSpot* spot = spot_of(path))
      splice(spot->value, spot->end, std::string(value));
    else
      add(path, value);
    put(tree_, path, &read);
    return checked();
  }

  std::string removed(const TomlPath& path) {
    const TomlSpot* spot = spot_of(path);
    if (!spot) return std::string(text_);  // it is not there
    put(tree_, path, nullptr, path.size() - spot->base);
    spot->form == TomlSpot::line ? remove_line(*spot) : remove_item(*spot);
    return checked();
  }

  std::string with_step(std::size_t step, std::string_view lines) {
    constexpr std::string_view kHeader = "[[step]]";
    std::string added(lines);
    if (!added.starts_with(kHeader)) added = fmt::format("{}\n{}", kHeader, added);
    while (added.ends_with('\n') || added.ends_with('\r')) added.pop_back();
    std::erase(added, '\r');
    for (std::size_t at = 0; (at = added.find('\n', at)) != added.npos; at += line_end_.size())
      added.replace(at, 1, line_end_);

    const TomlTable root = tree_of(added, "the step");
    const auto* one = value_of<TomlArray>(root, "step");
    if (root.size() != 1 || !one || one->size() != 1)
      throw Refused("these lines are not one step: {}", in_quotes(lines));
    const TomlPath path{"step", step};
    if (!value_in(tree_, path)) throw Refused("there is no step[{}]", step);
    if (const TomlSpot* spot = spot_of(path))
      add_step_in_list(*spot, added);
    else
      add_below(std::ranges::find_if(spots_.rbegin(), spots_.rend(),
                                     [&](const TomlSpot& s) { return is_within(s.path, path); })
                    ->end,
                line_end_ + added);
    TomlValue steps = *value_in(tree_, TomlPath{"step"});
    auto& list = std::get<TomlArray>(steps.data);
    list.insert(list.begin() + static_cast<std::ptrdiff_t>(step) + 1, one->front());
    put(tree_, TomlPath{"step"}, &steps);
    return checked();
  }

 private:
  static TomlValue one_value(std::string_view value) {
    const std::string line = fmt::format("v = {}", value);
    const TomlTable read = tree_of(line, "the value");
    if (read.size() != 1 || SpotScanner(line).spots.front().end != line.size())
      throw Refused("{} is not one value", in_quotes(value));
    return read.front().value;
  }

  void splice(std::size_t begin, std::size_t end, const std::string& by) {
    result_ = std::string(whole()).replace(begin, end - begin, by);
  }

  std::size_t line_begin(std::size_t at) const {
    return at == 0 ? 0 : whole().rfind('\n', at - 1) + 1;  // npos + 1 is 0
  }

  // The first letter behind `at` that stands behind blanks, or in front of it.
  std::size_t next_of(std::size_t at) const {
    return std::min(whole().find_first_not_of(" \t", at), whole().size());
  }
  std::size_t behind_last(std::size_t at) const {
    return whole().find_last_not_of(" \t", at - 1) + 1;
  }

  // The blanks that a line begins with.
  std::string_view indent_of(std::size_t at) const {
    const std::size_t begin = line_begin(at);
    return whole().substr(begin, next_of(begin) - begin);
  }

  // Lines of their own below the one in which something ends.
  void add_below(std::size_t at, const std::string& lines) {
    std::size_t end = std::min(whole().find('\n', at), whole().size());
    if (end > at && whole()[end - 1] == '\r') --end;
    splice(end, end, line_end_ + lines);
  }

  // Lines above a header, and above the comments that stand directly above it.
  void add_above(std::size_t header, const std::string& lines) {
    std::size_t begin = line_begin(header);
    while (begin > 0 && whole()[next_of(line_begin(begin - 1))] == '#')
      begin = line_begin(begin - 1);
    splice(begin, begin, lines + line_end_ + line_end_);
  }

  void add_pair(const TomlSpot& last, const std::string& pair) {
    if (last.form == TomlSpot::line)
      add_below(last.end, fmt::format("{}{}", indent_of(last.begin), pair));
    else
      splice(last.end, last.end, ", " + pair);
  }

  // A key that is not written yet.
  void add(const TomlPath& path, std::string_view value) {
    std::size_t known = path.size();  // so much of the path is there
    while (!value_in(tree_, std::span(path).first(known))) --known;
    const auto names = std::span(path).subspan(known);
    if (names.empty()) throw Refused("{} is a table of many lines", written_keys(path));
    const std::span table = std::span(path).first(known);
    if (!std::holds_alternative<TomlTable>(value_in(tree_, table)->data) ||
        !std::ranges::all_of(names, [](const PathPart& part) { return part.index() == 0; }))
      throw Refused("there is no place for {}: it is in no table", in_quotes(written_keys(path)));

    const auto pair = [&](std::span<const PathPart> keys, std::size_t from) {
      std::string text = written_keys(keys) + " = ";
      for (std::size_t i = from; i < names.size(); ++i)
        text += fmt::format("{{ {} = ", written_keys(names.subspan(i, 1)));
      text += value;
      for (std::size_t i = from; i < names.size(); ++i) text += " }";
      return text;
    };
    const auto last = [&](auto&& is_it) {
      const auto found = std::ranges::find_if(spots_.rbegin(), spots_.rend(), is_it);
      return found == spots_.rend() ? nullptr : &*found;
    };
    const auto first_header = [&](std::span<const PathPart> outer) {
      const auto found = std::ranges::find_if(spots_, [&](const TomlSpot& spot) {
        return spot.form == TomlSpot::header && is_within(spot.path, outer);
      });
      return found == spots_.end() ? nullptr : &*found;
    };
    const auto is_the_table = [&](const TomlSpot& spot) {
      return std::ranges::equal(spot.path, table);
    };

    const TomlPath steps{"step"};
    if (table.empty() && names.size() > 1) {  // in a [table] of its own
      const std::string lines = fmt::format("[{}]{}{}", written_keys(names.first(1)), line_end_,
                                            pair(names.subspan(1, 1), 2));
      if (const TomlSpot* step = first_header(steps)) return add_above(step->begin, lines);
      const std::string open = whole().empty() || whole().ends_with('\n') ? "" : line_end_;
      result_ = fmt::format("{}{}{}{}{}", whole(), open, whole().empty() ? "" : line_end_, lines,
                            line_end_);
    } else if (const TomlSpot* behind = last([&](const TomlSpot& spot) {
                 return spot.is_pair() && spot.base <= known && known < spot.path.size() &&
                        is_within(spot.path, table);
               })) {
      add_pair(*behind, pair(std::span(path).subspan(behind->base, known + 1 - behind->base), 1));
    } else if (const TomlSpot* own = last(is_the_table)) {
      if (own->form == TomlSpot::header) return add_below(own->end, pair(names.first(1), 1));
      splice(own->value, own->end, fmt::format("{{ {} }}", pair(names.first(1), 1)));
    } else if (const TomlSpot* header = first_header(table)) {
      const std::string title =
          known == 0 ? "" : fmt::format("[{}]{}", written_keys(table), line_end_);
      add_above(header->begin, title + pair(names.first(1), 1));
    } else {  // a text without any key
      result_ = fmt::format("{}{}{}", whole(), pair(names.first(1), 1), line_end_);
    }
  }

  void remove_line(const TomlSpot& spot) {
    std::size_t begin = line_begin(spot.begin);
    const std::size_t end = whole().find('\n', spot.end);
    if (end != whole().npos) return splice(begin, end + 1, "");
    begin -=
        std::min(begin, line_end_.size());  // the last line has no end: the one before has none
    splice(begin, whole().size(), "");
  }

  // A pair in braces or an element, with one comma.
  void remove_item(const TomlSpot& spot) {
    const std::size_t comma = next_of(spot.end), before = behind_last(spot.begin);
    if (comma < whole().size() && whole()[comma] == ',')
      splice(spot.begin, next_of(comma + 1), "");
    else
      splice(whole()[before - 1] == ',' ? behind_last(before - 1) : before, spot.end, "");
  }

  // As { } in a `step = [...]`.
  void add_step_in_list(const TomlSpot& spot, const std::string& added) {
    std::string pairs;
    for (const TomlSpot& s : SpotScanner(added).spots) {
      if (s.form == TomlSpot::header && s.begin > 0)
        throw Refused("a step in braces has no tables with headers of their own");
      if (s.form == TomlSpot::line)
        pairs += (pairs.empty() ? " " : ", ") + added.substr(s.begin, s.end - s.begin);
    }
    const bool is_alone = next_of(line_begin(spot.begin)) == spot.begin;
    const std::string_view indent = indent_of(spot.begin);
    splice(
        spot.end, spot.end,
        fmt::format(",{}{{{} }}", is_alone ? fmt::format("{}{}", line_end_, indent) : " ", pairs));
  }

  // The result, if it says what it shall and nothing else.
  std::string checked() const {
    const TomlValue now{{}, tree_of(result_, "the changed text")};
    if (!is_same(now, tree_)) throw std::logic_error("broken invariant: an edit changed more");
    return fmt::format("{}{}", text_.substr(0, text_.size() - whole().size()), result_);
  }

  std::string_view text_;
  TomlValue tree_;
  std::vector<TomlSpot> spots_;
  std::string line_end_ = "\n";
  std::string result_;
};

}  // namespace

std::string value_at(std::string_view text, std::string_view path) {
  const Edit edit(text);
  const TomlSpot* spot = edit.spot_of(checked_path(path));
  return spot ? std::string(edit.whole().substr(spot->value, spot->end - spot->value)) : "";
}

std::string with_value(std::string_view text, std::string_view path, std::string_view value) {
  const TomlPath where = checked_path(path);
  return value.empty() ? Edit(text).removed(where) : Edit(text).replaced(where, value);
}

std::string with_step(std::string_view text, std::size_t step, std::string_view lines) {
  return Edit(text).with_step(step, lines);
}

std::optional<std::size_t> index_of(std::string_view text, std::string_view list,
                                    std::string_view name) {
  const Edit edit(text);
  const TomlValue* found = value_in(edit.tree(), checked_path(list));
  const auto* tables = found ? std::get_if<TomlArray>(&found->data) : nullptr;
  for (std::size_t i = 0; tables && i < tables->size(); ++i) {
    const auto* table = std::get_if<TomlTable>(&(*tables)[i].data);
    const auto* own = table ? value_of<std::string>(*table, "name") : nullptr;
    if (own && *own == name) return i;
  }
  return std::nullopt;
}

}  // namespace lantern::live
