#include "scenario/toml_tree.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "scenario/toml_guard.hpp"

namespace lantern {
namespace {

static_assert(TOML_MAX_NESTED_VALUES <= 256, "deep nesting would overflow the stack");

// What toml++ says, and how a lecturer would say it.
struct Plain {
  std::string_view technical;
  std::string_view message;
  std::string_view hint;
};
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

TomlTable read_toml(std::string_view text, Problems& problems) {
  if (const auto bad = first_bad_byte(text)) {
    const bool nul = text[*bad] == '\0';
    problems.add(place_of(text, *bad),
                 nul ? "the file has a NUL byte" : "the file has bytes that are not UTF-8",
                 "is this really a text file? Save it as UTF-8");
    return {};
  }
  if (const auto harm = harm_in(text)) {
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

}  // namespace lantern
