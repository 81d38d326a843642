#include "measure/records.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>

#include <fmt/chrono.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "base/memory.hpp"
#include "base/number.hpp"
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

std::string first_line(const char* path) {
  std::string line;
  std::getline(std::ifstream(path) >> std::ws, line);
  return line;
}

// "AMD EPYC (family 25, model 1, stepping 1, cache 512 KB), 2 cores, 23.5 GB, Linux 6.1.0, governor
// performance": a virtual machine's processor may have no more of a name.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  std::map<std::string, std::string> of_first;
  for (std::string line; std::getline(file, line) && !line.empty();) {
    const std::size_t colon = std::min(line.find(':'), line.size());
    const std::string key = line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1);
    if (colon + 2 < line.size()) of_first[key] = line.substr(colon + 2);
  }
  std::string text = of_first.contains("model name") ? of_first["model name"] : "unknown", more;
  for (const auto& [key, name] :
       {std::pair("cpu family", "family"), std::pair("model", "model"),
        std::pair("stepping", "stepping"), std::pair("cache size", "cache")})
    if (of_first.contains(key))
      more += fmt::format("{}{} {}", more.empty() ? "" : ", ", name, of_first[key]);
  if (!more.empty()) text += fmt::format(" ({})", more);
  const auto pages = static_cast<std::uint64_t>(std::max(::sysconf(_SC_PHYS_PAGES), 1L)),
             page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  text += fmt::format(", {}, {}", counted(::sysconf(_SC_NPROCESSORS_ONLN), "core"),
                      memory_text(pages * page));
  if (utsname system{}; ::uname(&system) == 0)
    text += fmt::format(", {} {}", system.sysname, system.release);
  const std::string governor = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  return governor.empty() ? text : text + ", governor " + governor;
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
