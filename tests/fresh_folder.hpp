// A folder for what a test writes.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include <unistd.h>

namespace lantern {

// Empty, and this process's own: tests may run at the same time. It goes when the process ends.
inline std::filesystem::path fresh_folder(const std::string& name) {
  static const struct Home {
    std::filesystem::path path =
        std::filesystem::path(LANTERN_TEST_OUTPUT) / std::to_string(::getpid());
    ~Home() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  } home;
  const std::filesystem::path folder = home.path / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace lantern
