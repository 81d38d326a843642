// A page that is open in a browser loads itself again when it was made again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/file.hpp"

namespace lantern::app {

// A <script> element for the page that will stand at `page`. From a file a page may not read
// others, but may run a script that lies beside it: it runs PAGE.version.js twice a second, and
// loads itself again when that tells of another version. What is after the # stays.
std::string reload_script(const std::filesystem::path& page);

// Is asked before the page is written. Throws UsageError if something stands at PAGE.version.js
// that no watch has written, and IoError.
void require_version_place(const FilePlace& page);

// Writes PAGE.version.js, when the page stands with these bytes. Throws IoError.
void tell_version(const FilePlace& page, std::string_view bytes);

// Removes what tell_version wrote in this process, where it stands as it was written: nobody makes
// the pages again. One that a killed process has left tells a page what it knows, until the next
// one writes it anew.
void forget_versions() noexcept;

}  // namespace lantern::app
