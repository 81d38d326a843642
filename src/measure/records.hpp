// Rows as CSV and JSON from one list of their fields. A type of row has a function
//
//   template <class Visit> void each_field(const Row& row, Visit&& visit);
//
// that calls visit(Field, value) for each field in order. A list that takes `Row&` too can be read
// back (report/measure_json.cpp).
#pragma once

#include "base/json_writer.hpp"
#include "measure/row.hpp"

namespace lantern::measure {

struct Field {
  std::string_view name;    // in JSON; empty: not there
  std::string_view column;  // in CSV; empty: not there
  std::string_view group =
      "";  // the object in JSON that it stands in; fields of one stand together

  Field(const char* both) : name(both), column(both) {}
  Field(const char* in_json, const char* in_csv, const char* in_group = "")
      : name(in_json), column(in_csv), group(in_group) {}
};

// Visits fields that are called alike in JSON and in CSV: names, each before its value.
template <class Visit, class Value, class... Rest>
void visit_fields(Visit& visit, const char* name, Value&& value, Rest&&... rest) {
  visit(Field(name), std::forward<Value>(value));
  if constexpr (sizeof...(rest) > 0) visit_fields(visit, std::forward<Rest>(rest)...);
}

// A hash, written as 16 digits: many readers would round so large a number.
template <class T>
struct Hashed {
  T& value;
  std::string text() const { return fmt::format("{:016x}", value); }
};
template <class T>
Hashed(T&) -> Hashed<T>;

// Of a timing: nothing if nothing was timed.
template <class T>
struct IfTimed {
  T& value;
  bool timed = false;
};
template <class T>
IfTimed(T&, bool) -> IfTimed<T>;

// RFC 4180: a header, one record a row, lines end with CR LF. Numbers have 17 digits; what is not
// there, or not finite, is an empty field.
class CsvTable {
 public:
  void add(std::string_view field);
  void add(const char* field) { add(std::string_view(field)); }
  void add(const std::string& field) { add(std::string_view(field)); }
  void add(std::integral auto n) { add(fmt::format("{}", n)); }
  void add(double d) { add(std::isfinite(d) ? fmt::format("{:.17g}", d) : std::string()); }
  void add(const std::optional<double>& d) { d ? add(*d) : add(std::string_view()); }
  void add(Status status) { add(to_string(status)); }
  template <class T>
  void add(const Hashed<T>& hash) {
    add(hash.text());
  }
  template <class T>
  void add(const IfTimed<T>& seconds) {
    seconds.timed ? add(double{seconds.value}) : add(std::string_view());
  }
  void end_record();
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool fresh_ = true;
};

// A list of norms has four columns for each of as many norms as the longest list needs.
template <class Row>
std::string csv_of(const std::vector<Row>& rows, std::size_t norms = 0,
                   const std::vector<std::pair<const char*, std::string>>& tail = {}) {  // columns
  CsvTable csv;
  const auto each_norm = [&](const auto& write) {
    for (std::size_t i = 0; i < norms; ++i) write(i);
  };
  const Row none;
  each_field(none, [&]<class T>(const Field& field, const T&) {
    if constexpr (std::same_as<T, std::vector<Norm>>)
      each_norm([&](std::size_t i) {
        for (const char* of : {"_name", "", "_unit", "_meaning"})
          csv.add(fmt::format("norm{}{}", i + 1, of));
      });
    else if (!field.column.empty())
      csv.add(field.column);
  });
  for (const auto& [name, value] : tail) csv.add(name);
  csv.end_record();
  for (const Row& row : rows) {
    each_field(row, [&]<class T>(const Field& field, const T& value) {
      if constexpr (std::same_as<T, std::vector<Norm>>)
        each_norm([&](std::size_t i) {
          const bool there = i < value.size();
          csv.add(there ? value[i].name : "");
          csv.add(there ? std::optional(value[i].value) : std::nullopt);
          csv.add(there ? value[i].unit : "");
          csv.add(there ? value[i].meaning : "");
        });
      else if constexpr (!std::same_as<T, std::vector<DriftSample>>)
        if (!field.column.empty()) csv.add(value);
    });
    for (const auto& [name, value] : tail) csv.add(value);
    csv.end_record();
  }
  return csv.text();
}

// Members of the object that is open: what is not finite becomes null; what was not measured is
// left out.
class JsonFields {
 public:
  explicit JsonFields(JsonWriter& json) : json_(json) {}
  ~JsonFields() { enter(""); }
  JsonFields& operator=(JsonFields&&) = delete;  // nor any other copy or move

  void operator()(const Field& field, const auto& value) {
    if (field.name.empty()) return;
    enter(field.group);
    write(field.name, value);
  }

 private:
  void enter(std::string_view group);
  void write(std::string_view name, double value);
  void write(std::string_view name, const std::optional<double>& value) {
    if (value) write(name, *value);
  }
  void write(std::string_view name, Status status) { json_.member(name, to_string(status)); }
  template <class T>
  void write(std::string_view name, const Hashed<T>& hash) {
    json_.member(name, hash.text());
  }
  template <class T>
  void write(std::string_view name, const IfTimed<T>& seconds) {
    if (seconds.timed) write(name, double{seconds.value});
  }
  void write(std::string_view name, const std::vector<Norm>& norms);
  void write(std::string_view name, const std::vector<DriftSample>& samples);
  void write(std::string_view name, const auto& value) { json_.member(name, value); }

  JsonWriter& json_;
  std::string_view group_;
};

// An object of all its fields.
void write_json(const auto& row, JsonWriter& json) {
  json.begin_object();
  {
    JsonFields fields(json);
    each_field(row, fields);
  }
  json.end_object();
}

// A member that is an array of such objects, one a line.
void write_rows(std::string_view name, const auto& rows, JsonWriter& json) {
  json.line().key(name).begin_array();
  for (const auto& row : rows) write_json(row, json.line());
  json.line().end_array();
}

// Seconds are there only if they were taken; `spread` is the name of the interquartile range.
template <class T, class Visit>
void each_timing(T& t, const char* group, const char* spread, const char* spread_column,
                 Visit&& visit) {
  const bool timed = t.repeats > 0;
  const double range = t.spread();
  visit(Field("repeats", "repeats", group), t.repeats);
  visit(Field("median", "seconds_median", group), IfTimed(t.median, timed));
  visit(Field("least", "seconds_least", group), IfTimed(t.least, timed));
  visit(Field(spread, spread_column, group), IfTimed(range, timed));
  visit(Field("lower_quartile", "seconds_lower_quartile", group), IfTimed(t.lower_quartile, timed));
  visit(Field("upper_quartile", "seconds_upper_quartile", group), IfTimed(t.upper_quartile, timed));
}

}  // namespace lantern::measure
