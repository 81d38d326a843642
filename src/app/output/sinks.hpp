// Where frames go that are drawn: they wait until all are there that share a layout with them.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/folders/shard.hpp"
#include "app/output/render_job.hpp"
#include "app/run_scenario.hpp"
#include "base/file.hpp"
#include "base/work.hpp"
#include "draw/staging.hpp"
#include "publish/lesson.hpp"
#include "publish/paper.hpp"

namespace lantern::app {

// Keeps the frames of a sequence, up to a bound, and then gives each with what its group
// shares; the axes of charts are those of all that were kept. A frame's picture depends on the
// scenario alone: the bound is counted in frames and in bytes estimated from what a frame lists.
// When a run is stopped before its end, frames that were waiting are not drawn.
class StagedSink : public FrameSink {
 public:
  void frame(const Frame& frame) final;
  void finish(const DirectorReport& report) final;
  std::uint64_t waiting() const final { return undrawn_; }

 protected:
  // Every frame of the run, in order.
  virtual void draw(const Frame& frame, const Staging& staging) = 0;
  // After the last one.
  virtual void close(const DirectorReport& report) = 0;
  // Is the frame that is being drawn the last one of its step?
  bool ends_step() const { return ends_step_; }

 private:
  void flush(const Frame* next);

  bool ends_step_ = false;

  std::vector<Frame> waiting_;
  std::size_t bytes_ = 0;  // of those
  std::atomic<std::uint64_t> undrawn_{0};
};

// A document of several scenarios, each with an entry of its own in the table of contents.
struct PaperForAll {
  std::optional<publish::PdfDocument> pdf;
  publish::PdfWords words;  // of all so far
  std::optional<FilePlace> place;
};

// What a sink is made for. All of it must outlive the sink.
struct Sequence {
  const RenderJob& job;
  const Destination& to;
  const Scenario& scenario;
  Pace pace;
  Selection& selection;
  Work& work;
  PaperForAll* paper = nullptr;    // the document that all scenarios share, if they do
  const Scenario* next = nullptr;  // whose lesson page comes after this one

  // Of a sheet a picture a step, the last one, unless frames are chosen or events asked for.
  bool is_by_step() const;
  bool takes(const Frame& frame, bool ends_step, Selection& asked) const {
    return asked.takes(frame) && (ends_step || !is_by_step());
  }
  fs::path file_of(const Frame& frame) const {
    return to.file({scenario.name, frame.step, frame.index});
  }
  // That `why` speaks against what stands after -o.
  [[noreturn]] void refuse(const std::string& why) const;
};

// Frames into DIR/<scenario>/: a picture and facts each, a manifest, and the finished atlas. Each
// chosen frame is drawn when its group is whole, unless its picture stands there already; of a part
// only that part's, and the atlas with the last frame. The disk is left as it was until the first
// one. Its run throws IoError, BackendError, and UsageError for a picture that is too large and if
// no frame was chosen.
struct FolderMade {
  fs::path path;
  std::size_t drawn = 0, kept = 0;
  std::uint64_t chosen = 0;     // of the whole run, whoever draws them
  std::size_t in_betweens = 0;  // there now
  bool has_atlas = false;       // it stands there, whole
};
// What it has made is told to `made`, which must outlive it.
std::unique_ptr<StagedSink> make_folder_sink(const Sequence& sequence, const Part& part,
                                             FolderMade& made);

// Frames into files that the user names, or onto standard output. A file has its name only when it
// is whole: when a run fails or is interrupted, what stood there before still does. Each kind
// throws UsageError for what it cannot do, before the run if it can be known then.
class FileSink : public StagedSink {
 public:
  struct Made {
    std::uint64_t frames = 0;                      // in the files
    std::vector<fs::path> files;                   // whole, in order
    std::optional<double> seconds = std::nullopt;  // that films take in all,
    double rate = 0;                               // at so many pictures a second
  };
  explicit FileSink(const Sequence& sequence) : of_(sequence) {}
  // After finish().
  const Made& made() const { return made_; }

 protected:
  // Every chosen frame, in order.
  virtual void take(const Frame& frame, const Staging& staging) = 0;
  // After the last one; there was one.
  virtual void end() = 0;

  // Where a file of this name goes, see make_place().
  FilePlace place_of(const fs::path& file) const;
  // Makes the folder and writes the whole file, in which so many frames are. Throws IoError; what
  // stood there before then still does.
  void write(const fs::path& file, std::string_view bytes, std::uint64_t frames);

  const Sequence of_;
  Made made_;

 private:
  void draw(const Frame& frame, const Staging& staging) final;
  void close(const DirectorReport& report) final;
};

// When the pictures of a film are seen: the speed of what moves, how long stands what is read.
// Moments are counted in pictures of the film's rate, from 0. World time that goes on in small
// steps is shown at its own speed, whatever lies between two frames; any other change takes
// kChangeSeconds. A still is a frame that nothing goes on from at once: the last of
// each step, and each that the next one differs from by more than a small step of time.
class FilmClock {
 public:
  // A still stands until its words have been on the screen as long as it takes to read them at this
  // speed, which is that of subtitles, and at least kLook.
  static constexpr double kLettersPerSecond = 15;
  static constexpr double kLook = 1;  // seconds

  struct Settings {
    double rate = 30;                           // pictures a second
    std::optional<double> hold = std::nullopt;  // seconds of each still, whatever its words
    // Different ones between two frames; none: all that the rate has room for; 0: cuts.
    std::optional<std::uint64_t> in_betweens = std::nullopt;
    double slower = 1;  // stills stand so many times as long
  };
  explicit FilmClock(const Settings& settings) : settings_(settings) {}

  // The first moment that is still free.
  std::uint64_t now() const { return now_; }

  // Is `a` a still, if `b` is chosen next? `goes_on`: it is the next one of the run, too.
  static bool is_still(const Frame& a, const Frame& b, bool goes_on);

  // The frame is shown from now on, as a still. When that ends is the new now().
  void hold(const Frame& still);
  // And until this moment.
  void hold_until(std::uint64_t moment) { now_ = std::max(now_, moment); }

  // What is shown on the way from `a` to `b`, `b` itself left out; 0 is `a`. Then it is b's turn.
  struct Shot {
    double t = 0;  // of the way
    std::uint64_t moment = 0;
  };
  std::vector<Shot> way(const Frame& a, const Frame& b, bool goes_on);

 private:
  double seconds_of(const Frame& still);
  void move(const Frame& a, const Frame& b, std::vector<Shot>& shots);
  double quantized(double t) const;
  void see(const Frame& frame);

  Settings settings_;
  std::uint64_t now_ = 0;
  bool moving_ = false;            // a movement is under way:
  double from_time_ = 0;           // at this world time
  std::uint64_t from_moment_ = 0;  // it was this moment
  std::string words_;              // on the screen,
  std::uint64_t words_since_ = 0;  // from this moment on
};

// A run in which the chosen frames are only looked at, before that in which they are drawn.
void look_at_chosen(const Sequence& sequence,
                    const std::function<void(const Frame&, const Staging&)>& look);

// Lays the chosen frames out for paper, in a run of their own, so that all have room on one page,
// and tells the job. Throws UsageError if they have none.
void lay_out_figure(const Sequence& sequence, RenderJob& job);

// How long a film of these frames is, and of how many pictures. Of a frame counts when it is, its
// step and its caption.
struct FilmPlan {
  FilmClock::Settings clock;
  std::uint64_t moments = 0, pictures = 0;
  std::uint64_t twice = 0;  // of the moments: with what one clip ends the next one begins
};
FilmPlan film_plan(const std::vector<Frame>& frames, const FilmClock::Settings& clock, bool clips);
// The same of a film that lasts so many moments: its stills stand as much longer or shorter, and
// the last one for what is left. Throws UsageError if what moves takes longer.
FilmPlan film_plan_for(std::uint64_t moments, const std::vector<Frame>& frames,
                       FilmClock::Settings clock, bool clips);

// The sink for this kind of output, which is no folder.
std::unique_ptr<FileSink> make_file_sink(const Sequence& sequence);
// Of the kinds that have a file of their own.
std::unique_ptr<FileSink> make_film_sink(const Sequence& sequence);
std::unique_ptr<FileSink> make_document_sink(const Sequence& sequence);
std::unique_ptr<FileSink> make_sheet_sink(const Sequence& sequence);
std::unique_ptr<FileSink> make_page_sink(const Sequence& sequence);

// The engine for a page, from the file named, or from lantern.wasm beside the program or where it
// is installed. Throws IoError, and UsageError, which says how to get it, if there is none, or it
// is not of the same sources.
const std::string& packed_engine(const std::string& named);
// As the engine opens it.
publish::LiveScenario live_scenario(const Scenario& scenario);

// Where a file goes that an option names, if it may be written: see require_free(). Its folder is
// made: `users`, which the user has named, links and all; and what is below, through no link.
FilePlace make_place(const fs::path& file, const fs::path& users);

}  // namespace lantern::app
