#include "app/watched_files.hpp"

#include <system_error>

#include <sys/stat.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"

namespace lantern::app {

namespace fs = std::filesystem;

WatchedFiles::WatchedFiles(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const Stamp stamp = stamp_of(file);
    files_.push_back({file, stamp, std::nullopt, hash_of(file).value_or(0)});
  }
}

WatchedFiles::Stamp WatchedFiles::stamp_of(const std::string& file) {
  struct stat found {};
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  if (error || ::stat(file.c_str(), &found) != 0) return std::nullopt;
  return std::tuple(written, static_cast<std::uintmax_t>(found.st_size),
                    static_cast<std::uint64_t>(found.st_ino));
}

std::optional<std::uint64_t> WatchedFiles::hash_of(const std::string& file) try {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;
  return Hash().add(read_file(file, kMostBytes)).value();
} catch (const IoError&) {
  return std::nullopt;
}

// A stamp that has rested is older than a clock tick, so that whatever is written later has
// another.
std::vector<std::string> WatchedFiles::changed() {
  std::vector<std::string> changed;
  gone_.clear();
  back_.clear();
  for (Watched& one : files_) {
    const Stamp now = stamp_of(one.file);
    const bool rests = now == one.looked_at;
    one.looked_at = now;
    if (rests && one.is_gone != !now) {
      one.is_gone = !now;
      (now ? back_ : gone_).push_back(one.file);
    }
    if (!now || !rests || now == one.told) continue;
    const auto hash = hash_of(one.file);
    if (!hash) continue;
    one.told = now;
    if (*hash == one.hash) continue;
    one.hash = *hash;
    changed.push_back(one.file);
  }
  return changed;
}

}  // namespace lantern::app
