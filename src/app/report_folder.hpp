// A folder for a report's files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.hpp"
#include "draw/draw_list.hpp"

namespace lantern::app {

// What `measure` keeps for later runs, and what marks its folder.
inline constexpr const char* kMeasurement = "measure.json";

struct ReportPage {
  std::string name;  // of its files, without an ending
  DrawList list;
};

// Without a path everything is dropped.
class ReportFolder {
 public:
  // Makes the folder, keeps other processes out of it, and tries to write into it, before there is
  // anything to lose. `report` names the kind of report: "measure". Throws IoError, and
  // UsageError if the run reads what the report would write over.
  ReportFolder(const std::string& path, std::string_view report);
  // Takes away what folders it made and nothing was written into.
  ~ReportFolder();
  ReportFolder& operator=(ReportFolder&&) = delete;  // nor any other copy or move

  bool wanted() const { return !path_.empty(); }
  const fs::path& path() const { return path_; }

  // What an earlier run has left there; nothing if there is no such file. Throws IoError.
  std::optional<std::string> earlier(std::string_view name, std::size_t most_bytes) const;

  // With the first file of a new report, the pages of an older one of its kind go: they would tell
  // of other numbers.
  void write(std::string_view name, std::string_view bytes);
  // NAME.svg and NAME.png for each page, a pixel a page unit; each says of which report it is a
  // page. Throws BackendError, when the SVG files are there, if there is no OpenGL.
  void draw(const std::vector<ReportPage>& pages, const std::string& theme,
            const std::string& backend = "auto") const;
  // The report is whole: on return it would outlast a power cut. Throws IoError.
  void finish() const;

 private:
  void remove_old_pages();

  fs::path path_;
  std::optional<Folder> folder_;
  std::string report_;
  std::optional<FolderLock> lock_;
  bool begun_ = false;
  std::vector<fs::path> made_;  // folders, the innermost first
};

}  // namespace lantern::app
