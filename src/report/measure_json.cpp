#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/json_writer.hpp"
#include "report/measure_tables.hpp"

namespace lantern {
namespace {

constexpr std::string_view kFormat = "lantern.measure/1";

class Writer {
 public:
  void text(std::string_view name, std::string_view value) { json.member(name, value); }
  void number(std::string_view name, double value) {
    json.key(name);
    std::isfinite(value) ? json.value(value) : json.null();
  }
  // What was not measured is left out; what was, but is not finite, is null.
  void number(std::string_view name, const std::optional<double>& value) {
    if (value) number(name, *value);
  }
  JsonWriter json;
};

// As text: many readers would round so large a number.
std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

void write(const Row& row, Writer& w) {
  w.json.line().begin_object();
  w.text("problem", row.problem);
  w.text("family", row.family);
  w.text("variant", row.variant);
  w.text("file", row.file);
  w.text("text_hash", hash_text(row.text_hash));
  w.text("method", row.method);
  w.text("version", row.version);
  w.number("step", row.step);
  w.text("status", to_string(row.status));
  w.text("reference", row.reference);
  w.text("reason", row.reason);
  w.json.key("norms").begin_array();
  for (const Norm& norm : row.norms) {
    w.json.begin_object();
    w.text("name", norm.name);
    w.number("value", norm.value);
    w.json.end_object();
  }
  w.json.end_array().key("drift").begin_object();
  w.number("energy", row.drift.energy);
  w.number("momentum", row.drift.momentum);
  w.number("angular_momentum", row.drift.angular_momentum);
  w.json.end_object();
  w.number("penetration", row.penetration);
  w.json.key("timing").begin_object().member("repeats", row.timing.repeats);
  w.number("median", row.timing.median);
  w.number("least", row.timing.least);
  w.number("spread", row.timing.spread);
  w.json.end_object().key("counted").begin_object();
  w.json.member("steps", row.counted.steps);
  w.json.member("force_evaluations", row.counted.force_evaluations);
  w.json.member("constraint_rows", row.counted.constraint_rows);
  w.json.member("pair_tests", row.counted.pair_tests).end_object();
  w.text("hash", hash_text(row.hash));
  w.json.end_object();
}

using Json = nlohmann::json;

struct Damaged {};

const Json& part(const Json& json, const char* name) {
  if (!json.is_object()) throw Damaged();
  const auto found = json.find(name);
  if (found == json.end()) throw Damaged();
  return *found;
}

std::string text(const Json& json, const char* name) {
  const Json& value = part(json, name);
  if (!value.is_string()) throw Damaged();
  return value.get<std::string>();
}

double number(const Json& json, const char* name) {
  const Json& value = part(json, name);
  if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!value.is_number()) throw Damaged();
  return value.get<double>();
}

std::optional<double> maybe(const Json& json, const char* name) {
  if (!json.is_object()) throw Damaged();
  if (!json.contains(name)) return std::nullopt;
  return number(json, name);
}

std::uint64_t count(const Json& json, const char* name) {
  const Json& value = part(json, name);
  if (!value.is_number_unsigned()) throw Damaged();
  return value.get<std::uint64_t>();
}

Status status(const std::string& name) {
  for (const Status s : {Status::ok, Status::diverged, Status::nan, Status::refused})
    if (to_string(s) == name) return s;
  throw Damaged();
}

std::uint64_t hash(const std::string& digits) {
  if (digits.size() != 16 || digits.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw Damaged();
  return std::stoull(digits, nullptr, 16);
}

const Json& list(const Json& json, const char* name) {
  const Json& value = part(json, name);
  if (!value.is_array()) throw Damaged();
  return value;
}

Row read_row(const Json& json) {
  Row row;
  row.problem = text(json, "problem");
  row.family = text(json, "family");
  row.variant = text(json, "variant");
  row.file = text(json, "file");
  row.text_hash = hash(text(json, "text_hash"));
  row.method = text(json, "method");
  row.version = text(json, "version");
  row.step = number(json, "step");
  row.status = status(text(json, "status"));
  row.reference = text(json, "reference");
  row.reason = text(json, "reason");
  for (const Json& norm : list(json, "norms"))
    row.norms.push_back({text(norm, "name"), number(norm, "value")});
  const Json& drift = part(json, "drift");
  row.drift = {maybe(drift, "energy"), maybe(drift, "momentum"), maybe(drift, "angular_momentum")};
  row.penetration = number(json, "penetration");
  const Json& timing = part(json, "timing");
  const std::uint64_t repeats = count(timing, "repeats");
  if (repeats > 1'000'000'000) throw Damaged();
  row.timing = {static_cast<int>(repeats), number(timing, "median"), number(timing, "least"),
                number(timing, "spread")};
  const Json& counted = part(json, "counted");
  row.counted = {count(counted, "steps"), count(counted, "force_evaluations"),
                 count(counted, "constraint_rows"), count(counted, "pair_tests")};
  row.hash = hash(text(json, "hash"));
  return row;
}

}  // namespace

std::string to_json(const Measurement& measurement) {
  const Circumstances& c = measurement.circumstances;
  Writer w;
  w.json.begin_object().line().member("format", kFormat);
  w.json.line().key("circumstances").begin_object();
  w.text("version", c.version);
  w.text("sources", c.sources);
  w.text("compiler", c.compiler);
  w.text("flags", c.flags);
  w.text("processor", c.processor);
  w.text("effort", c.effort);
  w.json.member("seed", c.seed).end_object();
  w.json.line().key("rows").begin_array();
  for (const Row& row : measurement.rows) write(row, w);
  w.json.line().end_array().line().end_object();
  return w.json.text() + "\n";
}

std::optional<Measurement> read_measurement(std::string_view json) {
  const Json all = Json::parse(json.begin(), json.end(), nullptr, false);
  if (all.is_discarded()) return std::nullopt;
  try {
    if (text(all, "format") != kFormat) return std::nullopt;
    Measurement measurement;
    Circumstances& c = measurement.circumstances;
    const Json& told = part(all, "circumstances");
    c.version = text(told, "version");
    c.sources = text(told, "sources");
    c.compiler = text(told, "compiler");
    c.flags = text(told, "flags");
    c.processor = text(told, "processor");
    c.seed = count(told, "seed");
    c.effort = text(told, "effort");
    for (const Json& row : list(all, "rows")) measurement.rows.push_back(read_row(row));
    return measurement;
  } catch (const Damaged&) {
    return std::nullopt;
  }
}

}  // namespace lantern
