#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/output/sinks.hpp"
#include "app/output/watch.hpp"
#include "app/progress.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/memory.hpp"
#include "base/number.hpp"
#include "draw/page.hpp"
#include "publish/lesson.hpp"

namespace lantern::app {

namespace {

// A page is opened as a whole: what a browser unpacks at once, and steps through, has an end.
constexpr std::uint64_t kMostPageFrames = 20'000;
constexpr std::uint64_t kMostPageBytes = std::uint64_t{192} << 20;  // before they are compressed
// From so many frames on the size of all is estimated.
constexpr std::uint64_t kSample = 24;

constexpr const char* kFewer =
    "choose fewer with --frames or --at, or give the steps that run fewer frames with 'every'";

// The page shows title, caption and the numbers beside it as text of its own, and the picture
// between them.
RenderOptions of_picture(const RenderJob& job) {
  RenderOptions options = job.options;
  const double height = (1 - publish::kLessonWords) * job.picture.height;
  options.size =
      fmt::format("{}x{}", job.picture.width, std::max(16, static_cast<int>(std::lround(height))));
  options.no_title = options.no_caption = options.no_counters = true;
  return options;
}

class PageSink : public FileSink {
 public:
  explicit PageSink(const Sequence& s)
      : FileSink(s),
        expected_(s.selection.most() ? s.selection.most() : extent_of(s.scenario, s.pace).frames),
        lesson_({s.scenario.name, s.scenario.title, s.scenario.idea, s.scenario.lecture,
                 s.scenario.needs, s.scenario.steps.size()},
                options_.theme) {
    if (s.to.is_by("step") || s.to.is_by("frame"))
      throw UsageError(
          "a lesson page holds all steps: of placeholders only {scenario} may stand in its name");
    if (job_.in_betweens.wanted())
      throw UsageError(
          "a lesson page makes in-betweens itself, while it plays: leave out --tween and --fps");
    if (options_.transparent)
      throw UsageError(
          "a lesson page has a ground of its own: leave out --transparent, and open it as "
          "lesson.html?ground=none");
    if (s.selection.takes_all()) require_few(expected_.value_or(0));
    if (s.next) lesson_.set_next(s.to.file({s.next->name}).filename().string(), s.next->title);
    if (!options_.live) return;
    engine_ = &packed_engine(options_.engine);
    lesson_.make_live({{live_scenario(s.scenario)}, has_list_beside() ? "" : *engine_});
  }

 protected:
  void take(const Frame& frame, const Staging& staging) override {
    require_few(lesson_.frames() + 1);
    lesson_.add(frame, job_.page_of(frame, staging, of_.work), words_of(frame));
    last_.time = frame.time;
    require_room();
  }

  void end() override {
    const FilePlace place = place_of(file_);
    if (engine_ && has_list_beside() && !publish::write_engine(place.folder, *engine_))
      of_.refuse(fmt::format("{} stands there, and is not an engine's", publish::kEngineFile));
    std::string html = lesson_.html();
    if (options_.reloading) {
      require_version_place(place);
      html.insert(html.rfind("</body>"), reload_script(file_));
    }
    write_file(place, html);
    if (options_.reloading) tell_version(place, html);
    made_ = {lesson_.frames(), {file_}};
  }

 private:
  // Then the engine stands there, too, once for all pages.
  bool has_list_beside() const { return of_.to.is_a_folder_of_scenarios(); }

  publish::FrameWords words_of(const Frame& frame) const {
    publish::FrameWords words = publish::words_of(last_, frame, of_.scenario);
    if (of_.job.options.no_counters) words.counters.clear();
    return words;
  }

  void require_few(std::uint64_t frames) const {
    if (frames <= kMostPageFrames) return;
    throw UsageError("{}: up to {} frames; a lesson page holds at most {}: {}", of_.scenario.name,
                     lantern::grouped(frames, " "), lantern::grouped(kMostPageFrames, " "), kFewer);
  }

  // Of those to come each is taken for as large as those so far.
  void require_room() const {
    const std::uint64_t frames = lesson_.frames();
    if (frames < kSample) return;
    const std::uint64_t all = of_.selection.takes_all() ? expected_.value_or(0) : 0;
    const double bytes = static_cast<double>(lesson_.bytes()) / static_cast<double>(frames) *
                         static_cast<double>(std::max(all, frames));
    if (bytes <= static_cast<double>(kMostPageBytes)) return;
    throw UsageError(
        "{}: a page of {} frames would hold about {}, before it is compressed; at most {} can be "
        "stepped through: {}",
        of_.scenario.name, lantern::grouped(std::max(all, frames), " "),
        memory_text(static_cast<std::uint64_t>(bytes)), memory_text(kMostPageBytes), kFewer);
  }

  RenderOptions options_ = of_picture(of_.job);
  RenderJob job_{options_};
  fs::path file_ = of_.to.file({of_.scenario.name});
  std::optional<std::uint64_t> expected_;  // frames, at most
  publish::Lesson lesson_;
  const std::string* engine_ = nullptr;  // of a live page
  Frame last_;                           // of the one before only the time
};

}  // namespace

std::unique_ptr<FileSink> make_page_sink(const Sequence& sequence) {
  return std::make_unique<PageSink>(sequence);
}

}  // namespace lantern::app
