#include "live/edit.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "language/text/problems.hpp"
#include "live/written.hpp"

namespace lantern::live {
namespace {

constexpr std::string_view kBareKey =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

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

// Keys with dots between them, in quotes where they need them; an index says no more than a
// [[header]] does.
std::string written_keys(std::span<const PathPart> path) {
  std::string keys;
  for (const PathPart& part : path)
    if (const auto* key = std::get_if<std::string>(&part)) {
      const bool is_bare = !key->empty() && key->find_first_not_of(kBareKey) == key->npos;
      keys += (keys.empty() ? "" : ".") + (is_bare ? *key : json_string(*key));
    }
  return keys;
}

TomlPath checked_path(std::string_view text) {
  TomlPath path = path_of(text);
  if (path.empty()) throw Refused("{} is no path of a value", in_quotes(text));
  return path;
}

void check_value(std::string_view value) {
  const std::string line = fmt::format("v = {}", value);
  if (tree_of(line, "the value").size() != 1 || read_written(line).all.at(1).end != line.size())
    throw Refused("{} is not one value", in_quotes(value));
}

// One change to a text.
class Edit {
 public:
  explicit Edit(std::string_view text) : text_(text), written_(read_written(whole())) {
    tree_of(text, "the text");  // that it is TOML
    const std::size_t first = whole().find('\n');
    if (first != 0 && first != text.npos && whole()[first - 1] == '\r') line_end_ = "\r\n";
  }

  // Without its byte order mark, which no place counts.
  std::string_view whole() const { return without_mark(text_); }

  // Where the value is written, if that is one place.
  const Written* spot_of(const TomlPath& path) const {
    const auto [at, known] = way_of(path);
    return known == path.size() && all()[at].is_value() ? &all()[at] : nullptr;
  }

  std::string replaced(const TomlPath& path, std::string_view value) {
    check_value(value);
    if (const Written* spot = spot_of(path))
      splice(spot->value, spot->end, std::string(value));
    else
      add(path, value);
    return result();
  }

  std::string removed(const TomlPath& path) {
    const Written* spot = spot_of(path);
    if (!spot) return std::string(text_);  // it is not there
    spot->form == Written::line ? remove_line(*spot) : remove_item(*spot);
    return result();
  }

  // Behind the one of this index, or the last one.
  std::string with_table(const std::string& list, std::size_t behind, std::string_view lines) {
    const std::string header = fmt::format("[[{}]]", list);
    std::string added(lines);
    if (!added.starts_with(header)) added = fmt::format("{}\n{}", header, added);
    while (added.ends_with('\n') || added.ends_with('\r')) added.pop_back();
    std::erase(added, '\r');
    for (std::size_t at = 0; (at = added.find('\n', at)) != added.npos; at += line_end_.size())
      added.replace(at, 1, line_end_);

    const TomlTable root = tree_of(added, "what is added");
    const auto* one = value_of<TomlArray>(root, list);
    if (root.size() != 1 || !one || one->size() != 1)
      throw Refused("these lines are not one {}: {}", header, in_quotes(lines));
    const std::size_t of = written_.find(0, list);
    const bool is_last = behind == kNone;
    while (is_last && written_.find(of, behind + 1) != kNone) ++behind;  // kNone + 1 is 0
    const std::size_t before = written_.find(of, behind);
    if (before == kNone && !is_last) throw Refused("there is no {}[{}]", list, behind);
    if (of != kNone && all()[of].is_value()) {
      add_in_list(of, before, added);
    } else if (before != kNone) {
      std::size_t end = 0;
      for (std::size_t i = before; i < all().size(); ++i)
        if (written_.is_within(i, before)) end = std::max(end, all()[i].end);
      add_below(end, line_end_ + added);
    } else {
      add_section(added);
    }
    return result();
  }

 private:
  const std::vector<Written>& all() const { return written_.all; }

  // How far the path leads: to what, and by how many of its parts.
  std::pair<std::size_t, std::size_t> way_of(const TomlPath& path) const {
    std::size_t at = 0, known = 0;
    for (std::size_t next; known < path.size(); ++known, at = next)
      if (next = written_.find(at, path[known]); next == kNone) break;
    return {at, known};
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

  // Lines under a header of their own, above the first [[step]] if there is one.
  void add_section(const std::string& lines) {
    if (const Written* step = first_header(written_.find(0, "step")))
      return add_above(step->begin, lines);
    const std::string open = whole().empty() || whole().ends_with('\n') ? "" : line_end_;
    result_ = fmt::format("{}{}{}{}{}", whole(), open, whole().empty() ? "" : line_end_, lines,
                          line_end_);
  }

  void add_pair(const Written& last, const std::string& pair) {
    if (last.form == Written::line)
      add_below(last.end, fmt::format("{}{}", indent_of(last.begin), pair));
    else
      splice(last.end, last.end, ", " + pair);
  }

  // The first header of this table, or of one in it; null if there is none.
  const Written* first_header(std::size_t table) const {
    const Written* first = nullptr;
    for (std::size_t i = 0; i < all().size(); ++i)
      if (all()[i].form == Written::header && written_.is_within(i, table) &&
          (!first || all()[i].begin < first->begin))
        first = &all()[i];
    return first;
  }

  // The last pair in this table that stands in it, or in one that it is in.
  const Written* last_pair(std::size_t table) const {
    for (std::size_t i = all().size() - 1; i > table; --i)
      if (all()[i].is_pair() && written_.is_within(i, table) &&
          written_.is_within(table, all()[i].table))
        return &all()[i];
    return nullptr;
  }

  // A key that is not written yet.
  void add(const TomlPath& path, std::string_view value) {
    const auto [table, known] = way_of(path);
    const Written& own = all()[table];
    const auto names = std::span(path).subspan(known);
    if (names.empty()) throw Refused("{} is a table of many lines", written_keys(path));
    if (own.headers > 0 || (own.is_value() && whole()[own.value] != '{') ||
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

    if (table == 0 && names.size() > 1) {  // in a [table] of its own
      add_section(fmt::format("[{}]{}{}", written_keys(names.first(1)), line_end_,
                              pair(names.subspan(1, 1), 2)));
    } else if (const Written* behind = last_pair(table)) {
      std::size_t base = known;  // so many parts lead to where that one stands
      for (std::size_t at = table; at != behind->table; at = all()[at].parent) --base;
      add_pair(*behind, pair(std::span(path).subspan(base, known + 1 - base), 1));
    } else if (own.form == Written::header) {
      add_below(own.end, pair(names.first(1), 1));
    } else if (own.is_value()) {
      splice(own.value, own.end, fmt::format("{{ {} }}", pair(names.first(1), 1)));
    } else if (const Written* header = first_header(table)) {
      const std::string title =
          known == 0 ? ""
                     : fmt::format("[{}]{}", written_keys(std::span(path).first(known)), line_end_);
      add_above(header->begin, title + pair(names.first(1), 1));
    } else {  // a text without any key
      result_ = fmt::format("{}{}{}", whole(), pair(names.first(1), 1), line_end_);
    }
  }

  void remove_line(const Written& spot) {
    std::size_t begin = line_begin(spot.begin);
    const std::size_t end = whole().find('\n', spot.end);
    if (end != whole().npos) return splice(begin, end + 1, "");
    begin -=
        std::min(begin, line_end_.size());  // the last line has no end: the one before has none
    splice(begin, whole().size(), "");
  }

  // A pair in braces or an element, with one comma.
  void remove_item(const Written& spot) {
    const std::size_t comma = next_of(spot.end), before = behind_last(spot.begin);
    if (comma < whole().size() && whole()[comma] == ',')
      splice(spot.begin, next_of(comma + 1), "");
    else
      splice(whole()[before - 1] == ',' ? behind_last(before - 1) : before, spot.end, "");
  }

  // As { } in a `step = [...]`, behind one of its elements if there is any.
  void add_in_list(std::size_t list, std::size_t behind, const std::string& added) {
    std::string pairs;
    for (const WrittenText table = read_written(added); const Written& s : table.all) {
      if (s.form == Written::header && s.begin > 0)
        throw Refused("a table in braces has no tables with headers of their own");
      if (s.form == Written::line)
        pairs += (pairs.empty() ? " " : ", ") + added.substr(s.begin, s.end - s.begin);
    }
    const std::size_t at = behind == kNone ? all()[list].value + 1 : all()[behind].end;
    if (behind == kNone) return splice(at, at, fmt::format("{{{} }}", pairs));
    const bool is_alone = next_of(line_begin(all()[behind].begin)) == all()[behind].begin;
    const std::string line = fmt::format("{}{}", line_end_, indent_of(all()[behind].begin));
    splice(at, at, fmt::format(",{}{{{} }}", is_alone ? line : " ", pairs));
  }

  std::string result() const {
    return fmt::format("{}{}", text_.substr(0, text_.size() - whole().size()), result_);
  }

  std::string_view text_;
  WrittenText written_;
  std::string line_end_ = "\n";
  std::string result_;
};

}  // namespace

std::string value_at(std::string_view text, std::string_view path) {
  const Edit edit(text);
  const Written* spot = edit.spot_of(checked_path(path));
  return spot ? std::string(edit.whole().substr(spot->value, spot->end - spot->value)) : "";
}

std::string with_value(std::string_view text, std::string_view path, std::string_view value) {
  const TomlPath where = checked_path(path);
  return value.empty() ? Edit(text).removed(where) : Edit(text).replaced(where, value);
}

std::string Slot::with(const std::string& value) {
  if (around_) return around_->first + value + around_->second;
  const std::string first = with_value(text_, path_, value);
  const Edit edit(first);
  if (const Written* spot = edit.spot_of(checked_path(path_)))
    around_ = {first.substr(0, first.size() - edit.whole().size() + spot->value),
               std::string(edit.whole().substr(spot->end))};
  return first;
}

std::string with_step(std::string_view text, std::size_t step, std::string_view lines) {
  const std::string open = with_value(text, fmt::format("step[{}].ending", step), "");
  return Edit(open).with_table("step", step, lines);
}

std::string with_body(std::string_view text, std::string_view lines) {
  return Edit(text).with_table("body", kNone, lines);
}

std::optional<std::size_t> index_of(std::string_view text, std::string_view list,
                                    std::string_view name) {
  const TomlTable tree = tree_of(text, "the text");
  const auto* tables = value_of<TomlArray>(tree, list);
  for (std::size_t i = 0; tables && i < tables->size(); ++i) {
    const auto* table = std::get_if<TomlTable>(&(*tables)[i].data);
    const auto* own = table ? value_of<std::string>(*table, "name") : nullptr;
    if (own && *own == name) return i;
  }
  return std::nullopt;
}

}  // namespace lantern::live
