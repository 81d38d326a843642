#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "report/measure_document.hpp"
#include "report/sample_rows.hpp"

namespace lantern::report {
namespace {

// A reader of RFC 4180, written from its grammar.
std::vector<std::vector<std::string>> read_csv(const std::string& text) {
  std::vector<std::vector<std::string>> records(1, std::vector<std::string>(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& field = records.back().back();
    if (quoted) {
      if (text[i] != '"')
        field += text[i];
      else if (i + 1 < text.size() && text[i + 1] == '"')
        field += text[i++];
      else
        quoted = false;
    } else if (text[i] == '"') {
      quoted = true;
    } else if (text[i] == ',') {
      records.back().emplace_back();
    } else if (text.compare(i, 2, "\r\n") == 0) {
      ++i;
      if (i + 1 < text.size()) records.emplace_back(1);
    } else {
      field += text[i];
    }
  }
  return records;
}

Measurement awkward() {
  Measurement m = samples::measurement(2);
  m.rows.resize(6);
  m.circumstances.processor = "a \"quoted\" name, with a comma\nand a line";
  m.circumstances.seed = ~0ull;
  Row& r = m.rows[1];
  r.reason = "it said \"no\", twice\r\nand \xff\xc3 no UTF-8 ü";
  r.norms = {{"traj", 0.1}, {"apex", std::nan("")}, {"x", 5e-324}};
  r.drift.momentum = -0.0;
  r.drift.energy = HUGE_VAL;
  r.penetration = 1.0 / 3;
  r.samples = {{0.1, 1e-9, 0.25}, {1.5, std::nan(""), std::nullopt}};
  r.hash = ~0ull;
  r.text_hash = 1;
  r.counted.pair_tests = ~0ull;
  r.status = Status::refused;
  r.step = std::numeric_limits<double>::max();
  r.reference_error = 1e-9;
  m.rows[4].status = Status::left_out;
  m.rows[2].norms.clear();
  m.rows[2].timing = m.rows[2].processor = {};
  m.rows[3].method = "a,b";
  return m;
}

void expect_same(const std::optional<double>& a, const std::optional<double>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_TRUE(*a == *b || (!std::isfinite(*a) && std::isnan(*b))) << *a << " became " << *b;
}

TEST(MeasureJson, IsReadBackAsItWas) {
  const Measurement m = awkward();
  const auto back = read_measurement(to_json(m));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->circumstances.version, m.circumstances.version);
  EXPECT_EQ(back->circumstances.compiler, m.circumstances.compiler);
  EXPECT_EQ(back->circumstances.flags, m.circumstances.flags);
  EXPECT_EQ(back->circumstances.processor, m.circumstances.processor);
  EXPECT_EQ(back->circumstances.seed, m.circumstances.seed);
  EXPECT_EQ(back->circumstances.effort, m.circumstances.effort);
  ASSERT_EQ(back->rows.size(), m.rows.size());
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const Row &a = m.rows[i], &b = back->rows[i];
    EXPECT_EQ(a.problem, b.problem);
    EXPECT_EQ(a.family, b.family);
    EXPECT_EQ(a.variant, b.variant);
    EXPECT_EQ(a.file, b.file);
    EXPECT_EQ(a.text_hash, b.text_hash);
    EXPECT_EQ(a.method, b.method);
    EXPECT_EQ(a.version, b.version);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.reference, b.reference);
    ASSERT_EQ(a.norms.size(), b.norms.size());
    for (std::size_t n = 0; n < a.norms.size(); ++n) {
      EXPECT_EQ(a.norms[n].name, b.norms[n].name);
      EXPECT_EQ(a.norms[n].unit, b.norms[n].unit);
      EXPECT_EQ(a.norms[n].meaning, b.norms[n].meaning);
      expect_same(a.norms[n].value, b.norms[n].value);
    }
    expect_same(a.drift.energy, b.drift.energy);
    expect_same(a.drift.momentum, b.drift.momentum);
    expect_same(a.drift.angular_momentum, b.drift.angular_momentum);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (std::size_t n = 0; n < a.samples.size(); ++n) {
      EXPECT_EQ(a.samples[n].time, b.samples[n].time);
      expect_same(a.samples[n].error, b.samples[n].error);
      expect_same(a.samples[n].energy, b.samples[n].energy);
    }
    EXPECT_EQ(a.penetration, b.penetration);
    EXPECT_EQ(a.timing.median, b.timing.median);
    EXPECT_EQ(a.timing.repeats, b.timing.repeats);
    EXPECT_EQ(a.processor, b.processor);
    EXPECT_EQ(a.reference_error, b.reference_error);
    EXPECT_EQ(a.counted.steps, b.counted.steps);
    EXPECT_EQ(a.counted.force_evaluations, b.counted.force_evaluations);
    EXPECT_EQ(a.counted.constraint_rows, b.counted.constraint_rows);
    EXPECT_EQ(a.counted.pair_tests, b.counted.pair_tests);
    EXPECT_EQ(a.hash, b.hash);
  }
  EXPECT_EQ(back->rows[1].reason, "it said \"no\", twice\r\nand \ufffd\ufffd no UTF-8 ü");
  EXPECT_EQ(to_json(*back), to_json(m)) << "the second file differs from the first";
}

TEST(MeasureJson, HasNoNumberThatIsNotFinite) {
  const std::string text = to_json(awkward());
  for (const char* word : {"nan,", "inf", "NaN", "Inf"})
    EXPECT_EQ(text.find(word), std::string::npos) << word;
  EXPECT_TRUE(nlohmann::json::accept(text));
}

TEST(MeasureJson, ADamagedFileIsNothing) {
  const std::string whole = to_json(samples::measurement(1));
  ASSERT_TRUE(read_measurement(whole));
  for (std::size_t n = 0; n + 2 < whole.size(); n += 1 + whole.size() / 400)
    EXPECT_FALSE(read_measurement(whole.substr(0, n))) << "cut after " << n << " bytes";
  for (const char* text :
       {"", "{}", "[]", "null", "3", "\"lantern.measure/2\"",
        R"({"format": "lantern.measure/2", "rows": []})",
        R"({"format": "lantern.measure/2", "rows": []})", R"({"format": 1})", "\xff"})
    EXPECT_FALSE(read_measurement(text)) << text;
}

TEST(MeasureJson, AFieldOfTheWrongKindIsDamageNotACrash) {
  const nlohmann::json good = nlohmann::json::parse(to_json(samples::measurement(1)));
  const nlohmann::json wrong[] = {
      nullptr, -1, 1.5, "x", true, nlohmann::json::array(), nlohmann::json::object()};
  std::size_t refused = 0;
  for (const auto& field : good["rows"][0].items())
    for (const nlohmann::json& value : wrong) {
      nlohmann::json bad = good;
      bad["rows"][0][field.key()] = value;
      refused += !read_measurement(bad.dump());
      bad["rows"][0].erase(field.key());
      EXPECT_FALSE(read_measurement(bad.dump())) << field.key() << " is missing";
    }
  EXPECT_GT(refused, 80u) << "most of these are no rows";
}

TEST(MeasureJson, RandomDamageNeverCrashes) {
  const std::string whole = to_json(awkward());
  Random random(3);
  for (int i = 0; i < 600; ++i) {
    std::string bad = whole;
    for (int k = 0; k < 3; ++k)
      bad[static_cast<std::size_t>(random.whole(0, std::int64_t(bad.size()) - 1))] =
          static_cast<char>(random.whole(0, 255));
    const auto read = read_measurement(bad);
    EXPECT_TRUE(!read || !to_json(*read).empty());
  }
}

TEST(MeasureCsv, EveryRecordHasEveryFieldAndReadsBack) {
  const Measurement m = awkward();
  const auto records = read_csv(to_csv(m));
  ASSERT_EQ(records.size(), m.rows.size() + 1);
  std::map<std::string, std::size_t> column;
  for (std::size_t i = 0; i < records[0].size(); ++i) column[records[0][i]] = i;
  EXPECT_EQ(column.size(), records[0].size()) << "two columns share a name";
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const auto& record = records[i + 1];
    ASSERT_EQ(record.size(), records[0].size()) << "row " << i;
    const Row& row = m.rows[i];
    EXPECT_EQ(record[column.at("method")], row.method);
    EXPECT_EQ(record[column.at("reason")], row.reason);
    EXPECT_EQ(record[column.at("reference")], row.reference);
    EXPECT_EQ(std::stod(record[column.at("step")]), row.step);
    EXPECT_EQ(std::stoull(record[column.at("pair_tests")]), row.counted.pair_tests);
    EXPECT_EQ(record[column.at("seconds_median")].empty(), row.timing.repeats == 0);
    if (!row.norms.empty()) {
      EXPECT_EQ(record[column.at("norm1_name")], row.norms[0].name);
      EXPECT_EQ(std::stod(record[column.at("norm1")]), row.norms[0].value);
      EXPECT_EQ(record[column.at("norm1_unit")], row.norms[0].unit);
      EXPECT_EQ(record[column.at("norm1_meaning")], row.norms[0].meaning);
    }
  }
  EXPECT_EQ(records[2][column.at("norm2")], "") << "NaN is an empty field";
  EXPECT_EQ(records[2][column.at("norm3_name")], "x");
  EXPECT_EQ(records[2][column.at("drift_energy")], "");
  EXPECT_EQ(records[3][column.at("norm1")], "");
}

TEST(MeasureCsv, DriftHasARecordForEachSample) {
  const auto records = read_csv(drift_csv(awkward()));
  std::size_t samples = 0;
  for (const auto& row : awkward().rows) samples += row.samples.size();
  ASSERT_EQ(records.size(), 1 + samples);
  EXPECT_EQ(records[0].back(), "energy");
  for (const auto& record : records) ASSERT_EQ(record.size(), records[0].size());
  const auto any = [&](const auto& is) { return std::ranges::any_of(records, is); };
  EXPECT_TRUE(any([](const auto& record) {
    return record[4] == "0.10000000000000001" && record[6] == "0.25";
  })) << "numbers are whole";
  EXPECT_TRUE(any([](const auto& record) { return record[5].empty() && record[6].empty(); }))
      << "NaN is an empty field";
}

TEST(MeasureCsv, CircumstancesAreKeysAndValues) {
  const Measurement m = awkward();
  const auto records = read_csv(to_csv(m.circumstances));
  ASSERT_GT(records.size(), 5u);
  std::map<std::string, std::string> told;
  for (const auto& record : records) {
    ASSERT_EQ(record.size(), 2u);
    told[record[0]] = record[1];
  }
  EXPECT_EQ(told["processor"], m.circumstances.processor);
  EXPECT_EQ(told["seed"], "18446744073709551615");
}

TEST(MeasureTable, FitsOnAHundredColumnsAndNamesAll) {
  const Measurement m = samples::measurement();
  const std::string table = to_table(m);
  std::size_t width = 0;
  for (const char c : table) {
    if (c == '\n') {
      EXPECT_LE(width, 100u);
      width = 0;
    } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) {
      ++width;
    }
  }
  for (const Row& row : m.rows) {
    EXPECT_NE(table.find(row.problem), std::string::npos) << row.problem;
    EXPECT_NE(table.find(row.method), std::string::npos) << row.method;
  }
  EXPECT_EQ(to_table(Measurement{}), "");
}

}  // namespace
}  // namespace lantern::report
