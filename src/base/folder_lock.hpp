// One process at a time writes into a folder.
#pragma once

#include "base/file.hpp"

namespace lantern {

// Held until destroyed, or until the process ends, however it does. On disks that know no locks it
// keeps nobody out.
class FolderLock {
 public:
  // Waits up to two seconds for it. Throws IoError if another process holds it then; Stopped if
  // that is wished meanwhile.
  explicit FolderLock(const Folder& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace lantern
