// A folder for a report's files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "report/pictures.hpp"

namespace lantern {

// Without a path everything is dropped.
class ReportFolder {
 public:
  // Makes the folder and tries to write into it, before there is anything to lose. Throws IoError.
  explicit ReportFolder(const std::string& path);
  // Takes away what folders it made and nothing was written into.
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  bool wanted() const { return !path_.empty(); }
  const std::filesystem::path& path() const { return path_; }

  void write(std::string_view name, std::string_view bytes) const;
  // As SVG and PNG; throws BackendError, when the SVG files are there, if there is no OpenGL.
  void draw(const std::vector<ReportPage>& pages, const std::string& theme,
            const std::string& backend = "auto") const;
  // The report is whole: on return it would outlast a power cut. Throws IoError.
  void finish() const;

 private:
  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  // folders, the innermost first
};

}  // namespace lantern
