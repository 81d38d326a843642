// Does one value fit its key of the language?
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "language/keys/key.hpp"

namespace lantern::language {
namespace {

// "a text", "a whole number", ...: what the file has.
std::string_view kind_of(const TomlValue& value) {
  constexpr std::string_view kKinds[] = {"a date",        "a text", "a whole number", "a number",
                                         "true or false", "a list", "a table"};
  return kKinds[value.data.index()];
}

class Check {
 public:
  Check(const KeyDoc& doc, int dimension, Problems& problems)
      : doc_(doc), dimension_(dimension), problems_(problems) {}

  bool operator()(const TomlValue& value) {
    (this->*kRules[static_cast<std::size_t>(doc_.type)])(value);
    return good_;
  }

 private:
  void add(Place where, std::string message, std::string hint = {}) {
    problems_.add(where, std::move(message), std::move(hint));
    good_ = false;
  }

  void wrong_type(const TomlValue& value, std::string_view wanted, std::string hint = {}) {
    add(value.where, fmt::format("'{}' must be {}, not {}", doc_.key, wanted, kind_of(value)),
        std::move(hint));
  }

  // The value's list; adds a problem and gives null if it is none.
  const TomlArray* list_in(const TomlValue& value, std::string_view wanted) {
    const auto* list = std::get_if<TomlArray>(&value.data);
    if (!list) wrong_type(value, wanted, hint());
    return list;
  }

  std::string hint() const { return "as " + form_of(doc_, dimension_); }

  void check_text(const TomlValue& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (!text) return wrong_type(value, "a text", "a text stands in \"quotes\"");
    if (!check_one_line(value.where, *text)) return;
    const std::size_t count = letters(*text);
    if (doc_.pattern) {
      if (!matches(*text, *doc_.pattern)) add_mismatch(value.where, *text);
    } else if (static_cast<double>(count) < doc_.least || static_cast<double>(count) > doc_.most) {
      add(value.where,
          fmt::format("'{}' has {} letters, allowed are {}", doc_.key, count, range_text(doc_)));
    }
  }

  // Texts are drawn and printed: nothing in them may act on a terminal or turn the direction of
  // writing.
  bool check_one_line(Place where, const std::string& text) {
    if (is_printable(text)) return true;
    add(where, fmt::format("'{}' must be one line without control characters", doc_.key),
        fmt::format("it reads {}", in_quotes(text)));
    return false;
  }

  void add_mismatch(Place where, const std::string& text) {
    add(where,
        fmt::format("'{}' cannot be {}: it takes {}", doc_.key, in_quotes(text),
                    doc_.pattern->words),
        fmt::format(
            "for example {} = \"{}\"{}", doc_.key,
            doc_.pattern->example.empty() ? legal_name(text, *doc_.pattern) : doc_.pattern->example,
            doc_.pattern->more));
  }

  void check_range(Place where, double x, const std::string& written) {
    if (!std::isfinite(x))
      return add(where, fmt::format("'{}' is {}, it must be finite", doc_.key, written));
    if (x < doc_.least || x > doc_.most || (doc_.above_least && x == doc_.least))
      add_out_of_range(where, written);
  }

  void add_out_of_range(Place where, const std::string& written) {
    add(where, fmt::format("'{}' is {}, allowed is {}", doc_.key, written, range_text(doc_)),
        doc_.type == KeyType::whole ? numbered_choices() : "");
  }

  // "1 red, 2 pink, …" of a whole number whose values have names.
  std::string numbered_choices() const {
    std::string text;
    for (std::size_t i = 0; i < doc_.choices.size(); ++i)
      text += fmt::format("{}{} {}", i > 0 ? ", " : "", i + 1, doc_.choices[i]);
    return text;
  }

  void check_whole(const TomlValue& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) {
      // Not as doubles: from 2^53 on they skip whole numbers.
      if (*whole < static_cast<std::int64_t>(doc_.least) ||
          *whole > static_cast<std::int64_t>(doc_.most))
        add_out_of_range(value.where, fmt::format("{}", *whole));
      return;
    }
    const auto* number = std::get_if<double>(&value.data);
    const bool is_whole = number && std::abs(*number) < 1e15 && std::trunc(*number) == *number;
    wrong_type(value, "a whole number",
               is_whole ? fmt::format("write {}", static_cast<std::int64_t>(*number))
                        : numbered_choices());
  }

  void check_truth(const TomlValue& value) {
    if (!std::holds_alternative<bool>(value.data)) wrong_type(value, "true or false");
  }

  void check_table(const TomlValue& value) {
    if (!std::holds_alternative<TomlTable>(value.data))
      wrong_type(value, "a table",
                 doc_.type == KeyType::part ? fmt::format("as {} = {{ … }}", doc_.key)
                                            : fmt::format("write its header: [{}]", doc_.of));
  }

  void check_number(const TomlValue& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data))
      return check_range(value.where, static_cast<double>(*whole), fmt::format("{}", *whole));
    const auto* number = std::get_if<double>(&value.data);
    if (!number) return wrong_type(value, "a number");
    check_range(value.where, *number, fmt::format("{}", *number));
  }

  void check_choice(const TomlValue& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (!text) return wrong_type(value, "a text", "a text stands in \"quotes\"");
    if (std::ranges::find(doc_.choices, *text) != doc_.choices.end()) return;
    good_ = false;
    problems_.add(value.where, fmt::format("'{}' cannot be {}", doc_.key, in_quotes(*text)),
                  [&doc = doc_, &written = *text] {
                    const std::string hint = suggestion(written, doc.choices, doc.choices.size());
                    return doc.advice.empty() ? hint : fmt::format("{} ({})", hint, doc.advice);
                  });
  }

  void check_two(const TomlValue& value) {
    const bool is_size = doc_.type == KeyType::size;
    const auto* list =
        list_in(value, is_size ? "two whole numbers" : fmt::format("two numbers {}", doc_.form));
    if (!list) return;
    if (list->size() != 2)
      return add(value.where,
                 fmt::format("'{}' must have two numbers, not {}", doc_.key, list->size()), hint());
    for (const TomlValue& element : *list) is_size ? check_whole(element) : check_number(element);
  }

  // As many numbers as the world has dimensions.
  void check_point(const TomlValue& value) {
    constexpr std::string_view kHowMany[] = {"two or three numbers", "", "two numbers",
                                             "three numbers"};
    constexpr std::string_view kForms[] = {"[x, y] in a 2D world, [x, y, z] in a 3D one", "",
                                           "[x, y]", "[x, y, z]"};
    const std::string_view how_many = kHowMany[dimension_], form = kForms[dimension_];
    const auto* list = list_in(value, fmt::format("{} {}", how_many, form));
    if (!list) return;
    const auto count = static_cast<int>(std::min<std::size_t>(list->size(), 4));
    if (dimension_ == 2 && count == 3 && doc_.key.starts_with("camera_"))
      return add(value.where, "a 2D world has no camera", "for a 3D one, size = [16, 9, 16]");
    if (dimension_ == 0 ? count != 2 && count != 3 : count != dimension_)
      return add(value.where,
                 fmt::format("'{}' must have {}, not {}", doc_.key, how_many, list->size()),
                 dimension_ == 0 ? fmt::format("write {}", form)
                                 : fmt::format("this world is {}D: write {}", dimension_, form));
    for (const TomlValue& element : *list) check_number(element);
  }

  void check_whole_or_names(const TomlValue& value) {
    if (std::holds_alternative<TomlArray>(value.data)) return check_list(value);
    if (std::holds_alternative<std::int64_t>(value.data)) return check_whole(value);
    wrong_type(value, "a whole number or a list of names", hint());
  }

  void check_loops(const TomlValue& value) {
    const auto* list = list_in(value, "a list of polygons");
    if (!list) return;
    if (list->empty()) return add(value.where, fmt::format("'{}' must not be empty", doc_.key));
    for (const TomlValue& loop : *list) {
      const auto* corners = std::get_if<TomlArray>(&loop.data);
      if (!corners) {
        add(loop.where, "a polygon is a list of corners [x, y]", hint());
        continue;
      }
      if (corners->size() < 3)
        add(loop.where,
            fmt::format("a polygon must have at least 3 corners, not {}", corners->size()), hint());
      for (const TomlValue& corner : *corners) check_corner(corner);
    }
  }

  void check_corner(const TomlValue& corner) {
    const auto* pair = std::get_if<TomlArray>(&corner.data);
    if (!pair || pair->size() != 2) return add(corner.where, "a corner is two numbers [x, y]");
    for (const TomlValue& element : *pair) check_number(element);
  }

  void check_list(const TomlValue& value) {
    const auto* list = list_in(value, "a list");
    if (!list) return;
    if (list->empty() && doc_.type != KeyType::names && !doc_.may_be_empty)
      return add(value.where, fmt::format("'{}' must not be empty", doc_.key));
    if (doc_.may_be_empty && static_cast<double>(list->size()) > doc_.most)
      return add(value.where, fmt::format("{} names in '{}', the limit is {}", list->size(),
                                          doc_.key, doc_.most));
    std::set<std::string_view> seen;
    for (const TomlValue& element : *list) {
      const auto* text = std::get_if<std::string>(&element.data);
      if (doc_.type == KeyType::choices_list) {
        check_choice(element);
        if (text && !seen.insert(*text).second)
          add(element.where, fmt::format("{} stands twice in '{}'", in_quotes(*text), doc_.key));
      } else if (text) {
        check_one_line(element.where, *text);
      } else {
        wrong_type(element, "a list of texts");
      }
    }
  }

  // Only its line breaks are control characters.
  void check_lines(const TomlValue& value) {
    const auto* text = std::get_if<std::string>(&value.data);
    if (!text) return wrong_type(value, "a text", hint());
    std::string_view rest = *text;
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      std::string_view line = rest.substr(0, end);
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (!is_printable(line))
        return add(value.where, fmt::format("'{}' must have no control characters", doc_.key),
                   fmt::format("a line reads {}", in_quotes(line)));
      rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
    }
  }

  // A number, or { angle = 20, axis = [1, 0, 0] }.
  void check_turn(const TomlValue& value) {
    const auto* table = std::get_if<TomlTable>(&value.data);
    const std::string form = fmt::format("{{ {} = 45, axis = [0, 0, 1] }}", doc_.of);
    if (!table) {
      const bool is_number = std::holds_alternative<std::int64_t>(value.data) ||
                             std::holds_alternative<double>(value.data);
      return is_number ? check_number(value)
                       : wrong_type(value, "a number or a table", "as " + form);
    }
    bool has_amount = false;
    for (const TomlEntry& e : *table) {
      has_amount = has_amount || e.key == doc_.of;
      if (e.key == doc_.of)
        std::holds_alternative<TomlTable>(e.value.data) ? wrong_type(e.value, "a number")
                                                        : check_number(e.value);
      else if (e.key == "axis")
        check_axis(e.value);
      else
        add(e.where, fmt::format("unknown key {} in '{}'", in_quotes(e.key), doc_.key),
            "as " + form);
    }
    if (!has_amount)
      add(value.where, fmt::format("'{}' has no '{}'", doc_.key, doc_.of), "as " + form);
  }

  void check_axis(const TomlValue& axis) {
    if (dimension_ == 2)
      return add(axis.where, "a 2D world has no other axis to turn about", "leave it out");
    KeyDoc doc{.key = "axis", .type = KeyType::point, .least = -kFar, .most = kFar};
    good_ = Check(doc, dimension_, problems_)(axis) && good_;
  }

  void check_name_texts(const TomlValue& value) {
    const auto* table = std::get_if<TomlTable>(&value.data);
    if (!table) return wrong_type(value, "a table of letters", hint());
    for (const TomlEntry& e : *table) {
      check_one_line(e.where, e.key);
      if (const auto* text = std::get_if<std::string>(&e.value.data))
        check_one_line(e.value.where, *text);
      else
        wrong_type(e.value, "a table from letters to names");
    }
  }

  void check_tables(const TomlValue& value) {
    const auto* list = std::get_if<TomlArray>(&value.data);
    if (!list)
      return wrong_type(value, "a list of tables",
                        fmt::format("write each with its header: [[{}]]", doc_.of));
    if (static_cast<double>(list->size()) > doc_.most)
      add(value.where,
          fmt::format("{} of [[{}]], the limit is {}", list->size(), doc_.of, doc_.most));
    for (const TomlValue& element : *list)
      if (!std::holds_alternative<TomlTable>(element.data)) wrong_type(element, "a list of tables");
  }

  void check_name_pairs(const TomlValue& value) {
    const auto* list = list_in(value, "a list of pairs");
    if (!list) return;
    for (const TomlValue& element : *list) {
      const auto* pair = std::get_if<TomlArray>(&element.data);
      const auto is_text = [](const TomlValue& name) {
        return std::holds_alternative<std::string>(name.data);
      };
      if (!pair || pair->size() != 2 || !std::ranges::all_of(*pair, is_text)) {
        add(element.where, "a pair is a list of two names", hint());
        continue;
      }
      for (const TomlValue& name : *pair)
        check_one_line(name.where, std::get<std::string>(name.data));
    }
  }

  void check_name_table(const TomlValue& value) {
    const auto* table = std::get_if<TomlTable>(&value.data);
    if (!table) return wrong_type(value, "a table of names", hint());
    for_each_named(*table, [&](const Named& name, const TomlValue& named) {
      check_one_line(name.where, name.name);
      if (doc_.type == KeyType::name_points)
        check_point(named);
      else
        doc_.type == KeyType::name_wholes ? check_whole(named) : check_number(named);
    });
  }

  // In the order of KeyType.
  static constexpr void (Check::*kRules[])(const TomlValue&) = {
      &Check::check_text,       &Check::check_whole,      &Check::check_number,
      &Check::check_truth,      &Check::check_choice,     &Check::check_point,
      &Check::check_two,        &Check::check_two,        &Check::check_list,
      &Check::check_list,       &Check::check_loops,      &Check::check_whole_or_names,
      &Check::check_list,       &Check::check_lines,      &Check::check_turn,
      &Check::check_table,      &Check::check_tables,     &Check::check_table,
      &Check::check_name_pairs, &Check::check_name_table, &Check::check_name_table,
      &Check::check_name_table, &Check::check_name_texts};

  const KeyDoc& doc_;
  int dimension_;
  Problems& problems_;
  bool good_ = true;
};

}  // namespace

bool check_value(const TomlValue& value, const KeyDoc& doc, int dimension, Problems& problems) {
  return Check(doc, dimension, problems)(value);
}

}  // namespace lantern::language
