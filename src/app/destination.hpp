// Where the pictures of a run go: what stands after -o decides.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lantern::app {

enum class OutputKind {
  folder,           // DIR/<scenario>/: a picture and facts a frame, and a manifest
  standard_output,  // "-": one picture
  picture,          // figure.png, .svg: a file a frame
  film,             // .mp4, .webm, .gif, .apng, .webp
  document,         // .pdf: a page a frame
  sheet,            // --sheet 3x2 with .pdf or .png: several frames a page
  page,             // .html: a lesson that is stepped through
};

// What {scenario}, {step} and {frame} stand for in a name.
struct NameParts {
  std::string scenario;
  std::uint32_t step = 0, frame = 0;
};

class Destination {
 public:
  // `words` is what the user wrote; its ending chooses. Throws UsageError, naming what there is,
  // for an ending or a placeholder that does not exist, or stands in the name of a folder.
  Destination(const std::string& words, bool sheet);

  OutputKind kind() const { return kind_; }
  // A file, or one for each step or frame, and neither a folder nor standard output.
  bool is_file() const { return kind_ > OutputKind::standard_output; }
  const std::string& ending() const { return ending_; }  // "mp4"; empty for a folder
  bool is_by(std::string_view placeholder) const;        // is_by("step")

  // The file for these parts; numbers have as many digits as the names of frames in a folder.
  std::filesystem::path file(const NameParts& parts) const;
  // What of these files' folders stands before the first placeholder.
  std::filesystem::path users_folder() const;

 private:
  std::string words_, ending_;
  OutputKind kind_ = OutputKind::folder;
};

}  // namespace lantern::app
