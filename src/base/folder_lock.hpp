// One process at a time writes into a folder.
#pragma once

#include <filesystem>

namespace lantern {

// Held until destroyed, or until the process ends, however it does. On disks that know no locks it
// keeps nobody out.
class FolderLock {
 public:
  // Waits up to two seconds for it. Throws IoError if another process holds it then, or if the
  // folder cannot be opened; Stopped if that is wished meanwhile.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace lantern
