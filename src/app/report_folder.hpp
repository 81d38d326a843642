// A folder for a measurement's files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"

namespace lantern {

// Without a path everything is dropped.
class ReportFolder {
 public:
  // Makes the folder and tries to write into it, before there is anything to lose. Throws IoError.
  explicit ReportFolder(const std::string& path);

  bool wanted() const { return !path_.empty(); }
  void write(std::string_view name, std::string_view bytes) const;

  // Pages of 1600 x 900 as PNG, by file names without ending.
  void draw(const std::vector<std::pair<std::string, DrawList>>& pages,
            const std::string& theme) const;

 private:
  std::filesystem::path path_;
};

}  // namespace lantern
