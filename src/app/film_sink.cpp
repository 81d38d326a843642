#include <optional>

#include <fmt/format.h>

#include "app/file_sink.hpp"
#include "app/film_clock.hpp"
#include "app/frame_walk.hpp"
#include "app/in_betweens.hpp"
#include "app/named_files.hpp"
#include "app/terminal.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "publish/film.hpp"
#include "render/renderer.hpp"

namespace lantern::app {
namespace {

namespace fs = std::filesystem;

FilmSettings film_settings(const Sequence& s) {
  FilmSettings film;
  film.kind = *film_kind(s.to.ending());
  film.width = s.job.picture.width;
  film.height = s.job.picture.height;
  film.rate = s.job.options.fps.value_or(usual_rate(film.kind));
  film.transparent = s.job.options.transparent;
  film.title = s.scenario.title;
  if (const auto problem = film_problem(film)) throw UsageError(*problem);
  if (s.to.is_by("frame"))
    throw UsageError(
        "a film has many frames: write {step} in its name for a clip a step, or name pictures, "
        "such as {frame}.png");
  return film;
}

// All chosen frames as one film, or, where {step} stands in its name, as a clip a step. A clip
// begins with the still that the one before ended on.
class FilmSink : public FileSink {
 public:
  explicit FilmSink(const Sequence& s)
      : job_(s.job),
        to_(s.to),
        scenario_(s.scenario),
        selection_(s.selection),
        work_(s.work),
        settings_(film_settings(s)),
        ffmpeg_(require_ffmpeg()),
        is_clips_(s.to.is_by("step")),
        walk_(s.job, s.work),
        clock_({settings_.rate, s.job.options.hold, s.job.options.tween}) {}

  Made made() const override { return made_; }

 protected:
  void draw(const Frame& frame, const Staging& staging) override {
    if (!selection_.takes(frame)) return;
    walk_.go_on(frame, staging);
    walk_.page();  // while the staging is there
    ++made_.frames;
    if (const Frame* before = walk_.before()) leave(*before, frame);
  }

  void close(const DirectorReport&) override {
    selection_.require_some();
    const Frame& last = walk_.here();
    show(last, walk_.page(), clock_.now());
    clock_.hold(last);
    finish_film();
    Folder(folder_of(made_.files.back())).settle();
  }

 private:
  void leave(const Frame& before, const Frame& frame) {
    const bool goes_on = walk_.goes_on();
    if (FilmClock::is_still(before, frame, goes_on)) {
      show(before, walk_.page_before(), clock_.now());
      clock_.hold(before);
      if (is_clips_ && before.step != frame.step) {
        finish_film();
        if (goes_on) show(frame, walk_.page_before(), clock_.now() - 1);
      }
    }
    for (const FilmClock::Shot& shot : clock_.way(before, frame, goes_on)) {
      if (shot.t > 0)
        show(frame, walk_.in_between(shot.t), shot.moment);
      else
        show(before, walk_.page_before(), shot.moment);
    }
  }

  // `of` says which step the picture belongs to.
  void show(const Frame& of, const DrawList& list, std::uint64_t moment) {
    if (++pictures_ > InBetweens::kMostPictures)
      throw UsageError(
          fmt::format("{}: more than {} pictures; choose fewer frames, or a lower "
                      "--fps",
                      scenario_.name, InBetweens::kMostPictures));
    try {
      Renderer& painter = renderer();
      if (!film_) begin_film(of, moment);
      painter.draw(list, job_.picture.theme, settings_.transparent, film_->blank());
      ++work_.frames_drawn;
      film_->show(moment - begun_);
    } catch (const Refused& too_large) {  // by the command line, not by the scenario
      throw UsageError(too_large.what());
    }
  }

  void begin_film(const Frame& of, std::uint64_t moment) {
    file_ = to_.file({scenario_.name, of.step, of.index});
    film_.emplace(ffmpeg_, settings_, make_place(file_, to_.users_folder()));
    begun_ = moment;
  }

  void finish_film() {
    const std::uint64_t length = clock_.now() - begun_;
    work_.bytes_written += film_->finish(length);
    ++work_.frames_written;
    film_.reset();
    made_.files.push_back(file_);
    made_.seconds = made_.seconds.value_or(0) + static_cast<double>(length) / settings_.rate;
    made_.rate = settings_.rate;
  }

  Renderer& renderer() {
    if (!renderer_) {
      renderer_.emplace(Context::create(job_.backend), settings_.width, settings_.height);
      ++work_.graphics_contexts;
    }
    return *renderer_;
  }

  const RenderJob& job_;
  const Destination& to_;
  const Scenario& scenario_;
  Selection& selection_;
  Work& work_;
  const FilmSettings settings_;
  const fs::path ffmpeg_;
  const bool is_clips_;
  FrameWalk walk_;
  FilmClock clock_;
  std::optional<Renderer> renderer_;
  std::optional<Film> film_;  // that is being made,
  fs::path file_;             // of this name,
  std::uint64_t begun_ = 0;   // begun at this moment
  std::uint64_t pictures_ = 0;
  Made made_;
};

}  // namespace

std::unique_ptr<FileSink> make_film_sink(const Sequence& sequence) {
  return std::make_unique<FilmSink>(sequence);
}

}  // namespace lantern::app
