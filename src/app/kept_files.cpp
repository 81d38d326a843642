#include "app/kept_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/frame_folder.hpp"
#include "app/golden_list.hpp"
#include "app/shard_record.hpp"
#include "app/terminal.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

struct Kept {
  const char* list;         // the file that says so
  std::string_view format;  // which its first line has
  KeptFor what;
  const char* words;
};
constexpr std::array kKept = {
    Kept{kManifest, "\"lantern.manifest/", KeptFor::frames, "the frames of a run"},
    Kept{kGoldenList, "lantern.golden_frames/", KeptFor::goldens, "the golden frames"},
    Kept{kShardFile, "\"lantern.shard/", KeptFor::shard, "the frames of a part"},
};
constexpr const char* kMeasurement = "measure.json";

// What stands at the list's name: `unknown` is a link, a folder, a device, an empty file, or one
// that cannot be read, and may be the list all the same.
enum class Standing { nothing, list, other, unknown };

Standing standing(const Folder& folder, const Kept& kept) try {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28, kFirst = 200;
  const auto bytes = folder.read(kept.list, kMostBytes);
  if (!bytes) return Standing::nothing;
  if (bytes->empty()) return Standing::unknown;
  const bool says_so = std::string_view(*bytes).substr(0, kFirst).find(kept.format) != bytes->npos;
  return says_so ? Standing::list : Standing::other;
} catch (const IoError&) {
  return Standing::unknown;
}

bool may_stand(const Folder& folder, const Kept& kept) {
  const Standing found = standing(folder, kept);
  return found == Standing::list || found == Standing::unknown;
}

// Of whatever scenario: the folder may have been given another name since.
bool is_some_frame(std::string_view file) {
  for (std::size_t end = file.find('_'); end != file.npos; end = file.find('_', end + 1))
    if (is_frame_file(file, file.substr(0, end))) return true;
  return false;
}

std::string lower_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

// As a report's tables and pages are.
bool is_some_page(const fs::path& file) {
  constexpr std::string_view kTables[] = {".csv", ".html", ".svg", ".png"};
  return std::ranges::find(kTables, lower_ending(file)) != std::end(kTables);
}

[[noreturn]] void refuse(const fs::path& file, std::string_view what) {
  throw UsageError(fmt::format("'{}' is {}; name another file", file.string(), what));
}

}  // namespace

void require_kept_for(KeptFor wanted, const Folder& folder) {
  for (const Kept& kept : kKept) {
    if (kept.what == wanted || !may_stand(folder, kept)) continue;
    const bool can_be_read = standing(folder, kept) == Standing::list;
    throw UsageError(fmt::format("'{}' {} {}, of which {} tells{}; give another folder",
                                 folder.path().string(), can_be_read ? "holds" : "may hold",
                                 kept.words, kept.list,
                                 can_be_read ? "" : ", which is empty or cannot be read"));
  }
}

bool is_foreign(const Folder& folder, const char* list) {
  return folder.has(list) && std::ranges::none_of(kKept, [&](const Kept& kept) {
           return std::string_view(kept.list) == list && standing(folder, kept) == Standing::list;
         });
}

void require_free(const fs::path& file) {
  std::error_code none;
  const fs::path name = file.filename();
  if (fs::is_directory(file, none) || name.empty() || name == "." || name == "..")
    refuse(file, "a folder");
  if (fs::is_other(file, none)) refuse(file, "a device or a pipe");
  if (lower_ending(file) == ".toml") refuse(file, "called as scenarios are");
  if (name == kMeasurement) refuse(file, "called as a measurement is");
  for (const Kept& kept : kKept)
    if (name == kept.list) refuse(file, fmt::format("called as the list of {} is", kept.words));
  if (!fs::is_directory(folder_of(file), none)) return;
  if (is_input(file)) refuse(file, "read by this run, so it cannot be its output");
  const Folder folder(folder_of(file));
  for (const Kept& kept : kKept)
    if (is_some_frame(name.string()) && may_stand(folder, kept))
      refuse(file, fmt::format("called as one of {} there", kept.words));
  if (is_some_page(name) && folder.has(kMeasurement) && folder.has(name.string()))
    refuse(file, "one of the tables and pages of a measurement there");
}

}  // namespace lantern::app
