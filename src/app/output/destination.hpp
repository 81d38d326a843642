// Where the pictures of a run go, which of its frames are wanted, and at which size.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "frame/frame.hpp"

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

// "1280x720" as width and height. Throws UsageError unless both are 16 ... `most`.
std::pair<int, int> parse_size(const std::string& text, int most);

// The frames that two words of the command line choose, asked frame by frame while they are made.
class Selection {
 public:
  // `frames` is "7", "3-9", "3-", "-9" or empty; `at` is an event's name, a time in seconds, or
  // empty. `most_frames` is how many the scenario can have, if that is known. Throws UsageError for
  // a malformed word, or a range that cannot be.
  Selection(const std::string& frames, const std::string& at,
            std::optional<std::uint64_t> most_frames);

  bool takes_all() const { return frames_.empty() && at_.empty(); }

  // How many frames it can take, if a range says so.
  std::optional<std::uint64_t> most() const {
    return last_ ? std::optional(*last_ - first_ + 1) : std::nullopt;
  }

  // Asked once for each frame, in order.
  bool takes(const Frame& frame);

  // After the last frame: throws UsageError that tells what there is when the range goes beyond it,
  // or nothing was chosen.
  void require_some() const;

 private:
  [[noreturn]] void refuse_range(std::uint64_t count) const;

  std::string frames_, at_;
  std::uint64_t first_ = 0;
  std::optional<std::uint64_t> last_;  // none: to the end
  std::optional<double> time_;         // `at` is one
  std::uint64_t asked_ = 0, taken_ = 0;
  double end_ = 0;  // time of the last frame
  std::set<std::string> events_;
};

}  // namespace lantern::app
