#include "base/folder_lock.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/stop.hpp"

namespace lantern {

// Opened anew: copies of a descriptor share their locks.
FolderLock::FolderLock(const Folder& folder)
    : descriptor_(::openat(folder.descriptor(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw IoError(
        fmt::format("cannot open '{}': {}", folder.path().string(), std::strerror(errno)));
  // A run that was killed a moment ago may not be quite gone.
  constexpr int kTries = 100;
  constexpr auto kPause = std::chrono::milliseconds(20);
  for (int tries = 0; tries < kTries; ++tries) {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    if (stop_asked()) break;
    std::this_thread::sleep_for(kPause);
  }
  ::close(descriptor_);
  stop_if_asked();
  throw IoError(
      fmt::format("another run is writing into '{}'; wait for it, or give -o another folder",
                  folder.path().string()));
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace lantern
