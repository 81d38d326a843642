#include "measure/records.hpp"

#include <cstdlib>
#include <ctime>
#include <fstream>

#include <fmt/chrono.h>
#include <sched.h>

#include "embedded/lab_version.hpp"

namespace lantern::measure {

void CsvTable::add(std::string_view field) {
  if (!fresh_) text_ += ',';
  fresh_ = false;
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += field;
    return;
  }
  text_ += '"';
  for (const char c : field) (c == '"' ? text_ += c : text_) += c;
  text_ += '"';
}

void CsvTable::end_record() {
  text_ += "\r\n";
  fresh_ = true;
}

void JsonFields::enter(std::string_view group) {
  if (group == group_) return;
  if (!group_.empty()) json_.end_object();
  if (!group.empty()) json_.key(group).begin_object();
  group_ = group;
}

void JsonFields::write(std::string_view name, double value) {
  json_.key(name);
  std::isfinite(value) ? json_.value(value) : json_.null();
}

void JsonFields::write(std::string_view name, const std::vector<Norm>& norms) {
  json_.key(name).begin_array();
  for (const Norm& norm : norms) {
    json_.begin_object().member("name", norm.name);
    write("value", norm.value);
    json_.member("unit", norm.unit).member("meaning", norm.meaning).end_object();
  }
  json_.end_array();
}

void JsonFields::write(std::string_view name, const std::vector<DriftSample>& samples) {
  json_.key(name).begin_array();
  for (const DriftSample& sample : samples) {
    json_.begin_object();
    write("time", sample.time);
    write("error", sample.error);
    write("energy", sample.energy);
    json_.end_object();
  }
  json_.end_array();
}

namespace {

std::string compiler() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

double load_of_machine() {
  double load = 0;
  return ::getloadavg(&load, 1) == 1 ? load : std::nan("");
}

Circumstances here() {
  cpu_set_t usable;
  const bool known = ::sched_getaffinity(0, sizeof(usable), &usable) == 0;
  const double load = load_of_machine();
  return {std::string(kVersion),
          std::string(kLabHash),
          compiler(),
          LANTERN_FLAGS,
          processor(),
          1,
          "",
          fmt::format("{:%F %R} UTC", fmt::gmtime(std::time(nullptr))),
          known ? CPU_COUNT(&usable) : 0,
          load,
          load};
}

}  // namespace lantern::measure
