// Writes JSON in a fixed order. Numbers carry 17 significant digits, so that a reader gets back the
// very same double; non-finite ones are a broken invariant, since none may enter the engine.
#pragma once

#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/printable.hpp"

namespace lantern {
struct Diagnostic;

class JsonWriter {
 public:
  JsonWriter& begin_object() { return open('{'); }
  JsonWriter& end_object() { return close('}'); }
  JsonWriter& begin_array() { return open('['); }
  JsonWriter& end_array() { return close(']'); }

  JsonWriter& key(std::string_view name) {
    separate();
    text_ += json_string(name) + ": ";
    fresh_ = true;
    return *this;
  }
  JsonWriter& value(std::string_view s) { return raw(json_string(s)); }
  JsonWriter& value(const char* s) { return value(std::string_view(s)); }
  JsonWriter& value(bool b) { return raw(b ? "true" : "false"); }
  JsonWriter& value(std::integral auto i) { return raw(fmt::format("{}", i)); }
  JsonWriter& value(double d) {
    LANTERN_CHECK(std::isfinite(d), ==, true);
    return raw(fmt::format("{:.17g}", d == 0 ? 0.0 : d));
  }
  // {"severity", "line", "column", "message", "suggestion"}, with line 0 for the file as a whole.
  JsonWriter& value(const Diagnostic& d);
  JsonWriter& null() { return raw("null"); }
  // Null if there is none.
  template <class T>
  JsonWriter& value(const std::optional<T>& v) {
    return v ? value(*v) : null();
  }
  // An array, in a line.
  template <class T>
  JsonWriter& value(const std::vector<T>& all) {
    begin_array();
    for (const T& one : all) value(one);
    return end_array();
  }

  // A line break before the next element: long arrays stay readable, one element a line.
  JsonWriter& line() {
    line_ = true;
    return *this;
  }

  template <class T>
  JsonWriter& member(std::string_view name, const T& v) {
    return key(name).value(v);
  }

  // Names and values in turn: within a line, or each on a line of its own.
  template <class T, class... More>
  JsonWriter& members(std::string_view name, const T& v, const More&... more) {
    member(name, v);
    if constexpr (sizeof...(more) > 0) members(more...);
    return *this;
  }
  // An object of these.
  JsonWriter& object(const auto&... named) { return begin_object().members(named...).end_object(); }
  template <class T, class... More>
  JsonWriter& lines(std::string_view name, const T& v, const More&... more) {
    line().member(name, v);
    if constexpr (sizeof...(more) > 0) lines(more...);
    return *this;
  }

  const std::string& text() const { return text_; }

 private:
  JsonWriter& open(char bracket) {
    separate();
    text_ += bracket;
    fresh_ = true;
    return *this;
  }
  JsonWriter& close(char bracket) {
    if (line_) text_ += '\n';
    line_ = false;
    text_ += bracket;
    fresh_ = false;
    return *this;
  }
  JsonWriter& raw(std::string_view s) {
    separate();
    text_ += s;
    return *this;
  }
  void separate() {
    if (!fresh_) text_ += line_ ? "," : ", ";
    if (line_) text_ += '\n';
    fresh_ = line_ = false;
  }

  std::string text_;
  bool fresh_ = true;
  bool line_ = false;
};

}  // namespace lantern
