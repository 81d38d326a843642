#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "report/measure_tables.hpp"
#include "report/row_fields.hpp"

namespace lantern {
namespace {

constexpr std::string_view kFormat = "lantern.measure/1";

using Json = nlohmann::json;

struct Damaged {};

const Json& part(const Json& json, std::string_view name) {
  if (!json.is_object() || !json.contains(name)) throw Damaged();
  return json.at(std::string(name));
}

void take(const Json& json, std::string& text) {
  if (!json.is_string()) throw Damaged();
  text = json.get<std::string>();
}

void take(const Json& json, double& number) {
  if (json.is_null()) {
    number = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  if (!json.is_number()) throw Damaged();
  number = json.get<double>();
}

void take(const Json& json, std::uint64_t& count) {
  if (!json.is_number_unsigned()) throw Damaged();
  count = json.get<std::uint64_t>();
}

void take(const Json& json, int& repeats) {
  std::uint64_t count = 0;
  take(json, count);
  if (count > 1'000'000'000) throw Damaged();
  repeats = static_cast<int>(count);
}

void take(const Json& json, Status& status) {
  std::string name;
  take(json, name);
  const auto known = std::ranges::find(kStatusNames, name);
  if (known == kStatusNames.end()) throw Damaged();
  status = static_cast<Status>(known - kStatusNames.begin());
}

void take(const Json& json, Hashed<std::uint64_t> hash) {
  std::string digits;
  take(json, digits);
  if (digits.size() != 16 || digits.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw Damaged();
  hash.value = std::stoull(digits, nullptr, 16);
}

void take(const Json& json, std::vector<Norm>& norms) {
  if (!json.is_array()) throw Damaged();
  for (const Json& one : json) {
    Norm& norm = norms.emplace_back();
    take(part(one, "name"), norm.name);
    take(part(one, "value"), norm.value);
    take(part(one, "unit"), norm.unit);
    take(part(one, "meaning"), norm.meaning);
  }
}

template <class T>
T read_fields(const Json& json) {
  T read;
  each_field(read, [&]<class V>(const Field& field, V&& value) {
    const Json& object = field.group.empty() ? json : part(json, field.group);
    const auto take_if_there = [&](double& number) {
      if (!object.is_object()) throw Damaged();
      const bool there = object.contains(field.name);
      if (there) take(part(object, field.name), number);
      return there;
    };
    using Value = std::remove_cvref_t<V>;
    if constexpr (std::same_as<Value, IfTimed<double>>) {
      take_if_there(value.value);
    } else if constexpr (std::same_as<Value, std::optional<double>>) {
      double number = 0;
      if (take_if_there(number)) value = number;
    } else if constexpr (!std::same_as<Value, IfTimed<const double>>) {  // that is derived
      take(part(object, field.name), value);
    }
  });
  return read;
}

}  // namespace

std::string to_csv(const Measurement& measurement) {
  std::size_t norms = 0;
  for (const Row& row : measurement.rows) norms = std::max(norms, row.norms.size());
  return csv_of(measurement.rows, norms);
}

std::string to_csv(const Circumstances& c) {
  CsvTable csv;
  csv.add("key");
  csv.add("value");
  csv.end_record();
  each_field(c, [&](const Field& field, const auto& value) {
    csv.add(field.column);
    csv.add(value);
    csv.end_record();
  });
  return csv.text();
}

std::string to_json(const Measurement& measurement) {
  JsonWriter json;
  json.begin_object().line().member("format", kFormat).line().key("circumstances");
  write_json(measurement.circumstances, json);
  json.line().key("rows").begin_array();
  for (const Row& row : measurement.rows) write_json(row, json.line());
  json.line().end_array().line().end_object();
  return json.text() + "\n";
}

std::optional<Measurement> read_measurement(std::string_view text) {
  const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  try {
    if (part(json, "format") != kFormat) return std::nullopt;
    Measurement measurement{read_fields<Circumstances>(part(json, "circumstances")), {}};
    const Json& rows = part(json, "rows");
    if (!rows.is_array()) throw Damaged();
    for (const Json& row : rows) measurement.rows.push_back(read_fields<Row>(row));
    return measurement;
  } catch (const Damaged&) {
    return std::nullopt;
  }
}

}  // namespace lantern
