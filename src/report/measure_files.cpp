
#include <nlohmann/json.hpp>

#include "measure/records.hpp"
#include "report/measure_document.hpp"

// Where the rows are, since they are found by the rows' type.
namespace lantern::measure {

// What CSV and JSON hold, and what is read back from JSON.
// `R` is Row or const Row.
template <class R, class Visit>
requires std::same_as<std::remove_const_t<R>, Row>
void each_field(R& row, Visit&& visit) {
  visit_fields(visit, "problem", row.problem, "family", row.family, "variant", row.variant, "file",
               row.file, "text_hash", Hashed(row.text_hash), "method", row.method, "version",
               row.version, "step", row.step, "status", row.status, "reference", row.reference,
               "reference_error", row.reference_error, "reason", row.reason, "norms", row.norms);
  visit(Field("energy", "drift_energy", "drift"), row.drift.energy);
  visit(Field("momentum", "drift_momentum", "drift"), row.drift.momentum);
  visit(Field("angular_momentum", "drift_angular_momentum", "drift"), row.drift.angular_momentum);
  visit(Field("samples", ""), row.samples);
  visit_fields(visit, "penetration", row.penetration, "skin", row.skin);
  each_timing(row.timing, "timing", "spread", "seconds_spread", visit);
  const bool timed = row.timing.repeats > 0;
  const auto processor = [&](const char* name, const char* column, auto& seconds) {
    visit(Field(name, column, "processor"), IfTimed(seconds, timed));
  };
  processor("median", "processor_seconds_median", row.processor.median);
  processor("low", "processor_seconds_low", row.processor.low);
  processor("high", "processor_seconds_high", row.processor.high);
  processor("least", "processor_seconds_least", row.processor.least);
  processor("lower_quartile", "processor_seconds_lower_quartile", row.processor.lower_quartile);
  processor("upper_quartile", "processor_seconds_upper_quartile", row.processor.upper_quartile);
  visit(Field("steps", "steps", "counted"), row.counted.steps);
  visit(Field("force_evaluations", "force_evaluations", "counted"), row.counted.force_evaluations);
  visit(Field("constraint_rows", "constraint_rows", "counted"), row.counted.constraint_rows);
  visit(Field("pair_tests", "pair_tests", "counted"), row.counted.pair_tests);
  visit(Field("hash"), Hashed(row.hash));
}

template <class C, class Visit>
requires std::same_as<std::remove_const_t<C>, Circumstances>
void each_field(C& c, Visit&& visit) {
  visit_fields(visit, "version", c.version, "sources", c.sources, "compiler", c.compiler, "flags",
               c.flags, "processor", c.processor, "seed", c.seed, "effort", c.effort, "date",
               c.date, "cores", c.cores, "load_at_start", c.load_at_start, "load_at_end",
               c.load_at_end);
}

template <class P, class Visit>
requires std::same_as<std::remove_const_t<P>, PeerRecord>
void each_field(P& peer, Visit&& visit) {
  visit_fields(visit, "method", peer.name, "version", peer.version, "precision",
               peer.settings.precision, "integrator", peer.settings.integrator, "solver",
               peer.settings.solver, "iterations", peer.settings.iterations, "joints",
               peer.settings.joints, "flags", peer.settings.flags, "source", peer.settings.source);
}

}  // namespace lantern::measure

namespace lantern::report {
namespace {

constexpr std::string_view kFormat = "lantern.measure/2";

using Json = nlohmann::json;

// What is not as to_json() writes it: "problem is \"../x\"".
struct Damaged {
  std::string what;
};

void take(const Json& json, std::string& text) { text = json.get_ref<const std::string&>(); }

void take(const Json& json, double& number) {
  number = json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

void take(const Json& json, std::uint64_t& count) {
  count = json.get_ref<const Json::number_unsigned_t&>();
}

void take(const Json& json, int& repeats) {
  std::uint64_t count = 0;
  take(json, count);
  if (count > 1'000'000'000) throw Damaged{"too many"};
  repeats = static_cast<int>(count);
}

void take(const Json& json, Status& status) {
  std::string name;
  take(json, name);
  const auto known = std::ranges::find(kStatusNames, name);
  if (known == kStatusNames.end()) throw Damaged{"no status"};
  status = static_cast<Status>(known - kStatusNames.begin());
}

void take(const Json& json, Hashed<std::uint64_t> hash) {
  std::string digits;
  take(json, digits);
  if (digits.size() != 16 || digits.find_first_not_of("0123456789abcdef") != std::string::npos)
    throw Damaged{"no hash"};
  hash.value = std::stoull(digits, nullptr, 16);
}

void take(const Json& json, std::vector<Norm>& norms) {
  for (const Json& one : json.get_ref<const Json::array_t&>()) {
    Norm& norm = norms.emplace_back();
    take(one.at("name"), norm.name);
    take(one.at("value"), norm.value);
    take(one.at("unit"), norm.unit);
    take(one.at("meaning"), norm.meaning);
  }
}

void take(const Json& json, std::vector<DriftSample>& samples) {
  for (const Json& one : json.get_ref<const Json::array_t&>()) {
    DriftSample& sample = samples.emplace_back();
    take(one.at("time"), sample.time);
    take(one.at("error"), sample.error);
    if (one.contains("energy")) take(one.at("energy"), sample.energy.emplace());
  }
}

// "is \"../x\"", short.
std::string shown(const Json& json) {
  if (json.is_structured()) return "is a list or an object";
  constexpr std::size_t kMostShown = 60;
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  return "is " + (text.size() > kMostShown ? text.substr(0, kMostShown) + "…" : text);
}

// take(), and whose fault it was.
void take_member(const Json& object, const std::string& name, auto&& value) {
  const auto& members = object.get_ref<const Json::object_t&>();
  const auto there = members.find(name);
  if (there == members.end()) throw Damaged{name + " is missing"};
  try {
    take(there->second, value);
  } catch (const Damaged& why) {
    throw Damaged{fmt::format("{} {}: {}", name, shown(there->second), why.what)};
  } catch (const Json::exception&) {  // of another type
    throw Damaged{fmt::format("{} {}", name, shown(there->second))};
  }
}

template <class T>
T read_fields(const Json& json) {
  T read;
  each_field(read, [&]<class V>(const Field& field, V&& value) {
    const Json& object = field.group.empty() ? json : json.at(std::string(field.group));
    const std::string name(field.name);
    const auto take_if_there = [&](double& number) {
      const auto& members = object.get_ref<const Json::object_t&>();
      const auto there = members.find(name);
      if (there != members.end()) take(there->second, number);
      return there != members.end();
    };
    using Value = std::remove_cvref_t<V>;
    if constexpr (std::same_as<Value, IfTimed<double>>) {
      take_if_there(value.value);
    } else if constexpr (std::same_as<Value, std::optional<double>>) {
      double number = 0;
      if (take_if_there(number)) value = number;
    } else if constexpr (!std::same_as<Value, IfTimed<const double>>) {  // that is derived
      take_member(object, name, value);
    }
  });
  return read;
}

// What plots and sentences are made from.
void require_sane(const Row& row, const Json& json) {
  if (!ScenarioName::of(row.problem))
    throw Damaged{fmt::format("problem {}: a scenario's name is 1 to 64 of a–z, 0–9 and _",
                              shown(json.at("problem")))};
  if (!(row.step >= 0 && std::isfinite(row.step)))
    throw Damaged{fmt::format("step {}: it is no step", shown(json.at("step")))};
  constexpr double kMost = std::numeric_limits<double>::max();
  const auto require_order = [&](const char* name, std::initializer_list<double> in_order) {
    if (!std::ranges::is_sorted(in_order) ||
        std::ranges::any_of(in_order, [](double x) { return std::isnan(x); }))
      throw Damaged{
          fmt::format("{} {}: its quartiles are in no order", name, json.at(name).dump())};
  };
  const Timing &t = row.timing, &p = row.processor;
  require_order("timing", {0, t.least, t.lower_quartile, t.median, t.upper_quartile, kMost});
  require_order("processor", {0, p.least, p.lower_quartile, p.median, p.upper_quartile, kMost});
  require_order("processor", {p.least, p.low, p.median, p.high, kMost});
}

}  // namespace

std::string to_csv(const Measurement& measurement) {
  std::size_t norms = 0;
  for (const Row& row : measurement.rows) norms = std::max(norms, row.norms.size());
  return csv_of(measurement.rows, norms);
}

std::string drift_csv(const Measurement& measurement) {
  CsvTable csv;
  for (const char* column : {"problem", "method", "version", "step", "time", "error", "energy"})
    csv.add(column);
  csv.end_record();
  for (const Row& row : measurement.rows)
    for (const DriftSample& sample : row.samples) {
      csv.add(row.problem);
      csv.add(row.method);
      csv.add(row.version);
      for (const double number : {row.step, sample.time, sample.error}) csv.add(number);
      csv.add(sample.energy);
      csv.end_record();
    }
  return csv.text();
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

std::string to_csv(const std::vector<PeerRecord>& peers) { return csv_of(peers); }

std::string to_json(const Measurement& measurement) {
  JsonWriter json;
  json.begin_object().line().member("format", kFormat).line().key("circumstances");
  write_json(measurement.circumstances, json);
  write_rows("peers", measurement.peers, json);
  write_rows("rows", measurement.rows, json);
  json.line().end_object();
  return json.text() + "\n";
}

std::optional<Measurement> read_measurement(std::string_view text, std::string* why) {
  std::string place;
  try {
    const Json json = Json::parse(text.begin(), text.end());
    if (json.at("format") != kFormat) throw Damaged{"format " + shown(json.at("format"))};
    Measurement measurement{read_fields<Circumstances>(json.at("circumstances")), {}, {}};
    for (const Json& peer : json.at("peers").get_ref<const Json::array_t&>())
      measurement.peers.push_back(read_fields<PeerRecord>(peer));
    for (const Json& row : json.at("rows").get_ref<const Json::array_t&>()) {
      place = fmt::format("rows[{}].", measurement.rows.size());
      Row& read = measurement.rows.emplace_back(read_fields<Row>(row));
      read.processor.repeats = read.timing.repeats;
      require_sane(measurement.rows.back(), row);
    }
    return measurement;
  } catch (const Damaged& damaged) {
    if (why) *why = place + damaged.what;
  } catch (const Json::exception&) {  // no JSON, or what is missing, or of another type
    if (why)
      *why = fmt::format("{} is damaged", place.empty() ? "it" : place.substr(0, place.size() - 1));
  }
  return std::nullopt;
}

}  // namespace lantern::report
