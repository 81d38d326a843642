// What `lantern render` is asked for, read once; a picture made so; what stands between two of
// them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/folders/frame_folder.hpp"
#include "app/terminal.hpp"
#include "base/work.hpp"
#include "draw/draw_list.hpp"
#include "draw/staging.hpp"
#include "draw/tween.hpp"
#include "frame/frame.hpp"
#include "language/scenario.hpp"
#include "render/pipeline.hpp"

namespace lantern::app {

class InBetweens {
 public:
  // More pictures than this, frames and in-betweens, are not made of one scenario.
  static constexpr std::uint64_t kMostPictures = 100'000;

  InBetweens() = default;
  // Both are asked for only of a film, which has a clock of its own (app/output/sinks.hpp).
  InBetweens(std::optional<std::uint64_t> tween, std::optional<double> fps);

  bool wanted() const { return number_ > 0; }
  // What they were asked for with: "7", "30 fps"; empty if they were not.
  std::string setting() const;
  // Before a frame there are never more.
  std::uint64_t most() const { return number_; }

  // Between two frames that follow each other. World time that goes on in small steps is shown at
  // its own speed: the more pictures a second, the more fit between two moments.
  std::uint64_t between(const Frame& a, const Frame& b) const;

  // Throws UsageError if so many frames, or two of a number that is not known, would be too many.
  void require_few(std::optional<std::uint64_t> frames) const;

 private:
  std::uint64_t number_ = 0;
  double fps_ = 0;  // pictures a second; 0: always the same number
};

struct RenderOptions {
  std::vector<std::string> files;
  std::string output = "output";  // folder or file, see Destination; "-" is standard output
  std::string sheet;              // "3x2": frames across and down a page; empty for none
  std::string frames;             // "7", "3-9", "3-", "-9"; empty for all
  std::string at;                 // an event or a time in seconds; empty for all
  std::string size;               // pixels; empty for 1600x900, and for a sheet A4 across
  std::string paper = "a4";       // of a sheet without a size: a4, letter
  std::string letters;            // the least on paper, "8pt"; empty for the usual
  std::string width;              // of a figure on paper, "8cm"; empty for what pixels make
  std::string panel;              // that is shown alone; empty for all
  int dpi = 160;                  // pixels to the inch, where a picture meets paper
  std::string format = "png";     // png, svg
  std::string text = "outlines";  // of SVG: outlines, text
  std::string theme = "light";
  std::string pace;              // step, event; empty for the scenario's own
  std::string png = "fast";      // fast, small
  std::string backend = "auto";  // auto, osmesa, egl
  bool transparent = false;
  bool no_title = false, no_caption = false, no_counters = false;  // not drawn
  bool legend = false;                                             // drawn in any case
  bool strict = false;                                             // warnings are errors
  std::optional<int> threads;                         // that encode; none for one a core
  std::optional<std::uint64_t> tween = std::nullopt;  // in-betweens before each frame but the first
  std::optional<double> fps = std::nullopt;           // or as many as a change of half a second has
  bool reloading =
      false;  // a page loads itself again when it was made again (app/output/watch.hpp)
  std::string shard = "";                        // "2/4": the second of four parts; empty for all
  std::optional<double> hold = std::nullopt;     // seconds of each still of a film
  std::optional<double> length = std::nullopt;   // or of the film
  std::string title = "";                        // of an index of lessons
  bool format_given = false, png_given = false;  // on the command line
  bool live = false;                             // a lesson page carries the engine
  std::string engine = "";                       // its file; empty for where it is looked for
  bool json = false;
  bool dpi_given = false;

  // Laid out anew for its place on paper.
  bool is_figure() const {
    return sheet.empty() && !(letters.empty() && width.empty() && panel.empty());
  }
};

// A picture laid out for its width on paper: on which page, and the part of that which is shown.
struct Figure {
  Vec<2> page{0.0};
  Box<2> part;
};

// Draws what is asked for; gives the exit code.
int draw_scenarios(const RenderOptions& options);
// Draws, and again what was saved since, until Ctrl-C: exit code 130.
int watch_scenarios(const RenderOptions& options);

// What the command line asks for, and not the scenario, may be refused: what `make` refuses is told
// as the user's mistake, between these words.
template <class Make>
auto as_asked(const Make& make, const char* before = "", const char* behind = "") try {
  return make();
} catch (const Refused& refused) {
  throw UsageError(before + std::string(refused.what()) + behind);
}

struct RenderJob {
  // Throws UsageError for a size that cannot be. The options must outlive this.
  explicit RenderJob(const RenderOptions& options);

  const RenderOptions& options;
  Pipeline::Config picture;  // how the picture of a frame is made
  Backend backend = Backend::automatic;
  FileKind format = FileKind::png;  // of a frame's picture, where it is a file
  InBetweens in_betweens;
  double letters = 0;   // on paper, points, at least; 0 for the usual ones
  double on_paper = 0;  // the width of the picture, points
  double dpi = 0;       // there

  // What of the frame is shown: as the scenario has it, and the command line.
  Display display_of(const Frame& frame) const;

  // The picture on paper, in points of 1/72 inch.
  Vec<2> points() const;

  // From here on pictures are such.
  void set(const Figure& figure);

  // The frame with what the command line switches on and off, and of its panels those that it
  // wants. Throws UsageError if there are none of these.
  Frame shown(const Frame& frame) const;
  // That as a page.
  DrawList page_of(const Frame& frame, const Staging& staging, Work& work) const;

  // Graphics for pictures of this size, until another size is asked for: all scenarios of a job
  // share them, since to compile the shaders takes as long as to draw some frames. Counted in
  // `work` when they are started. Throws BackendError, and UsageError for pictures that are too
  // large.
  Renderer& renderer(int width, int height, Work& work) const;
  // From the job's own pictures to files.
  std::unique_ptr<Pipeline> make_pipeline(Work& work) const;

  // Of a folder that holds no frame yet.
  Manifest manifest(const Scenario& scenario, Pace pace) const;

 private:
  // One at a time: its context is current from when it is made until another one is.
  mutable std::unique_ptr<Renderer> renderer_;
  std::optional<Figure> figure_;
};

// The frame in words, of those that are displayed: "left: The root splits. (4 nodes, 2 pairs)".
std::string description_of(const Frame& frame, const Display& of);
inline std::string description_of(const Frame& frame) { return description_of(frame, Display()); }

// What a PNG says of its frame. Beside a figure lie no facts: it is described.
std::vector<PngText> texts_of(const Frame& frame, const RenderOptions& options = {});

// A whole file, sealed, in the job's format; `as` tells size and style, which the job's own
// pictures take from job.picture.
std::string picture_of(const RenderJob& job, const Pipeline::Config& as, const Frame& frame,
                       const DrawList& list, const MadeFrom& from, Work& work);

// Stands on a frame and knows the one before it. A page is laid out when it is first asked for.
class FrameWalk {
 public:
  FrameWalk(const RenderJob& job, Work& work) : job_(job), work_(work) {}

  // On to the next chosen frame. The staging is that of the frame and must outlive the stay there.
  void go_on(const Frame& frame, const Staging& staging);

  const Frame& here() const { return here_->frame; }
  const DrawList& page() { return page_of(*here_); }
  // The one that was chosen before; null on the first.
  const Frame* before() const { return before_ ? &before_->frame : nullptr; }
  const DrawList& page_before() { return page_of(*before_); }
  // No frame lies between the two: something may be shown that does.
  bool goes_on() const { return before_ && before_->frame.index + 1 == here_->frame.index; }
  // What is seen at `t` of the way, from 0, the frame before, to 1, this one.
  DrawList in_between(double t);

 private:
  struct Stop {
    Frame frame;
    std::optional<DrawList> page = std::nullopt;
  };
  const DrawList& page_of(Stop& stop);

  const RenderJob& job_;
  Work& work_;
  const Staging* staging_ = nullptr;
  std::optional<Stop> before_, here_;
  std::optional<std::vector<Passage>> way_;  // between the two, once it was asked for
};

// Where the pictures of a run go, which of its frames are wanted, and at which size.

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
  fs::path file(const NameParts& parts) const;
  // Files of several scenarios stand in one folder.
  bool is_a_folder_of_scenarios() const {
    return is_by("scenario") && file({"a"}).parent_path() == file({"b"}).parent_path();
  }
  // A document that several scenarios can share.
  bool is_one_document() const { return ending_ == "pdf" && words_.find('{') == words_.npos; }
  // What of these files' folders stands before the first placeholder.
  fs::path users_folder() const;

 private:
  std::string words_, ending_;
  OutputKind kind_ = OutputKind::folder;
};

// "8cm", "80mm", "3.2in" or "227pt" in points of 1/72 inch. Throws UsageError that names the option
// for any other word, and for less than a point.
double parse_length(std::string_view option, const std::string& text);

// "1280x720" as width and height. Throws UsageError unless both are 16 ... `most`.
std::pair<int, int> parse_size(const std::string& text, int most);

// The frames that two words of the command line choose, asked frame by frame while they are made.
class Selection {
 public:
  // `frames` is "7", "3-9", "3-", "-9" or empty; `at` is an event's name, a time in seconds, or
  // empty. `most_frames` is how many the scenario can have, if that is known; of `whole_steps` a
  // name takes all frames, else their own event alone. Throws UsageError for a malformed word, or a
  // range that cannot be.
  Selection(const std::string& frames, const std::string& at,
            std::optional<std::uint64_t> most_frames, bool whole_steps = false);

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
  bool whole_steps_;
  std::uint64_t first_ = 0;
  std::optional<std::uint64_t> last_;  // none: to the end
  std::optional<double> time_;         // `at` is one
  std::uint64_t asked_ = 0, taken_ = 0;
  double end_ = 0;  // time of the last frame
  std::set<std::string> events_;
};

}  // namespace lantern::app
