#include "app/kept_files.hpp"

#include <algorithm>
#include <array>
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

// Is there a file of this name in it that says so in its first line or the next?
bool says(const Folder& folder, const char* name, std::string_view format) try {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28, kFirst = 200;
  const auto bytes = folder.read(name, kMostBytes);
  return bytes && std::string_view(*bytes).substr(0, kFirst).find(format) != std::string_view::npos;
} catch (const IoError&) {
  return false;
}

// Of whatever scenario: the folder may have been given another name since.
bool is_some_frame(std::string_view file) {
  for (std::size_t end = file.find('_'); end != file.npos; end = file.find('_', end + 1))
    if (is_frame_file(file, file.substr(0, end))) return true;
  return false;
}

[[noreturn]] void refuse(const fs::path& file, std::string_view what) {
  throw UsageError(fmt::format("'{}' is {}; name another file", file.string(), what));
}

}  // namespace

void require_kept_for(KeptFor wanted, const Folder& folder) {
  for (const Kept& kept : kKept)
    if (kept.what != wanted && says(folder, kept.list, kept.format))
      throw UsageError(fmt::format("'{}' holds {}, of which {} tells; give another folder",
                                   folder.path().string(), kept.words, kept.list));
}

bool is_foreign(const Folder& folder, const char* list) {
  return folder.has(list) && std::ranges::none_of(kKept, [&](const Kept& kept) {
           return std::string_view(kept.list) == list && says(folder, list, kept.format);
         });
}

void require_free(const fs::path& file) {
  std::error_code none;
  if (fs::is_directory(file, none)) refuse(file, "a folder");
  if (fs::is_other(file, none)) refuse(file, "a device or a pipe");
  if (file.extension() == ".toml") refuse(file, "called as scenarios are");
  if (file.filename() == kMeasurement) refuse(file, "called as a measurement is");
  for (const Kept& kept : kKept)
    if (file.filename() == kept.list)
      refuse(file, fmt::format("called as the list of {} is", kept.words));
  if (!fs::is_directory(folder_of(file), none)) return;
  if (is_input(file)) refuse(file, "read by this run, so it cannot be its output");
  const Folder folder(folder_of(file));
  const std::string name = file.filename().string();
  for (const Kept& kept : kKept)
    if (is_some_frame(name) && says(folder, kept.list, kept.format))
      refuse(file, fmt::format("called as one of {} there", kept.words));
}

}  // namespace lantern::app
