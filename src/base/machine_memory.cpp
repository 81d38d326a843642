#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <limits>

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/memory.hpp"

namespace lantern {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kEndless = std::numeric_limits<std::uint64_t>::max();

// The number that a file begins with; endless for "max" and for what cannot be read.
std::uint64_t number_in(const fs::path& path) {
  std::ifstream file(path);
  std::uint64_t number = 0;
  return file >> number ? number : kEndless;
}

// Of the group and all above it. In a container the group's own path may not be there, its root is.
std::uint64_t group_limit(const fs::path& root, fs::path group, const char* name) {
  std::uint64_t least = number_in(root / name);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path())
    least = std::min(least, number_in(root / group / name));
  return least;
}

// Lines such as "0::/user.slice" (version 2) and "4:cpu,memory:/docker/1" (version 1).
std::uint64_t control_group_limit() {
  std::uint64_t least = kEndless;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string kinds = ',' + line.substr(first + 1, second - first - 1) + ',';
    const std::string group = line.substr(second + 1);
    if (kinds == ",,") least = std::min(least, group_limit("/sys/fs/cgroup", group, "memory.max"));
    if (kinds.find(",memory,") != std::string::npos)
      least = std::min(least, group_limit("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

std::uint64_t own_limit(int resource) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0) return kEndless;
  return limit.rlim_cur == RLIM_INFINITY ? kEndless : std::uint64_t{limit.rlim_cur};
}

// Bytes that count against the limit.
std::uint64_t in_use(int resource) {
  std::ifstream file("/proc/self/statm");
  std::array<std::uint64_t, 6> pages{};
  for (std::uint64_t& n : pages) file >> n;
  const std::uint64_t counted = resource == RLIMIT_DATA ? pages[5] : pages[0];
  return file ? counted * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

// The address sanitizer maps more than there is.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kHasWall = false;
#else
constexpr bool kHasWall = true;
#endif

std::atomic<std::uint64_t> budget{0};          // 0: not yet known
std::atomic<bool> budget_set{false};           // by the user
std::atomic<std::uint64_t> own_data_limit{0};  // before the budget was enforced; 0: it was not

}  // namespace

std::uint64_t machine_memory() {
  const auto pages = static_cast<std::uint64_t>(std::max(::sysconf(_SC_PHYS_PAGES), 1L));
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return std::min(
      {pages * page, control_group_limit(), own_limit(RLIMIT_AS), own_limit(RLIMIT_DATA)});
}

std::uint64_t memory_budget() {
  if (budget == 0) budget = machine_memory() / 2;
  return budget;
}

void set_memory_budget(std::uint64_t bytes) {
  budget = bytes;
  budget_set = true;
}

void enforce_memory_budget() {
  rlimit limit{};
  if (!kHasWall || ::getrlimit(RLIMIT_DATA, &limit) != 0) return;
  own_data_limit = limit.rlim_cur;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, memory_budget() + in_use(RLIMIT_DATA));
  ::setrlimit(RLIMIT_DATA, &limit);
}

std::optional<std::uint64_t> budget_needed(std::uint64_t bytes) {
  const std::uint64_t wall = own_limit(RLIMIT_DATA), space = own_limit(RLIMIT_AS);
  const std::uint64_t wanted = in_use(RLIMIT_DATA) + bytes;
  // Nobody's wish: half of what those limits leave.
  const bool is_of_limits =
      !budget_set && std::min<std::uint64_t>(own_data_limit, space) < kEndless;
  if (own_data_limit == 0 || is_of_limits || wanted <= wall || wanted > own_data_limit ||
      in_use(RLIMIT_AS) + bytes > space)
    return std::nullopt;
  return wanted - (wall - memory_budget());
}

void keep_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that it takes
  ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

}  // namespace lantern
