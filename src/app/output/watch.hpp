// Scenarios that are saved again and again, and pages that load themselves again then.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/file.hpp"

namespace lantern::app {

// A file counts as changed when its bytes have, whoever has written them and however: in place, or
// under another name that then became its own. It is looked at by its name, not followed by its
// inode, so this holds on every file system, those of a network among them. One that is gone is
// waited for.
class WatchedFiles {
 public:
  // As they are now is what they have changed from.
  explicit WatchedFiles(const std::vector<std::string>& files);

  // Those that have changed since they were told last, and have rested for one more look. Each is
  // told once.
  std::vector<std::string> changed();
  // Those that were not there in its last two looks and had been before, and those that are back.
  const std::vector<std::string>& gone() const { return gone_; }
  const std::vector<std::string>& back() const { return back_; }

 private:
  // When it was written, its size, and which file it is; nothing if there is none.
  using Stamp = std::optional<std::tuple<fs::file_time_type, std::uintmax_t, std::uint64_t>>;
  struct Watched {
    std::string file;
    Stamp looked_at, told;   // last
    std::uint64_t hash = 0;  // of the bytes told last
    bool is_gone = false;    // and this has been told
  };
  static Stamp stamp_of(const std::string& file);

  std::vector<Watched> files_;
  std::vector<std::string> gone_, back_;
};

// A <script> element for the page that will stand at `page`. From a file a page may not read
// others, but may run a script that lies beside it: it runs PAGE.version.js twice a second, and
// loads itself again when that tells of another version. What is after the # stays.
std::string reload_script(const fs::path& page);

// Is asked before the page is written. Throws UsageError if something stands at PAGE.version.js
// that no watch has written, and IoError.
void require_version_place(const FilePlace& page);

// Writes PAGE.version.js, when the page stands with these bytes. Throws IoError.
void tell_version(const FilePlace& page, std::string_view bytes);

// Tells all such pages what is wrong with what they were made from, which they then show; empty
// text takes it away. Throws IoError.
void tell_error(const std::string& error);

// Removes what tell_version wrote in this process, where it stands as it was written: nobody makes
// the pages again. One that a killed process has left tells a page what it knows, until the next
// one writes it anew.
void forget_versions() noexcept;

}  // namespace lantern::app
