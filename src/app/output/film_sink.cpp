#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/output/sinks.hpp"
#include "app/terminal.hpp"
#include "base/file.hpp"
#include "base/printable.hpp"
#include "publish/film.hpp"
#include "render/renderer.hpp"

namespace lantern::app {

namespace {

// Numbers are looked at, not read: a caption in which only they change is the same one.
std::string words_of(const std::string& caption) {
  std::string words;
  std::copy_if(caption.begin(), caption.end(), std::back_inserter(words),
               [](char c) { return c < '0' || c > '9'; });
  return words;
}

std::uint64_t pictures(double seconds, double rate) {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(seconds * rate)));
}

FilmSettings film_settings(const Sequence& s) {
  FilmSettings film{.kind = *film_kind(s.to.ending()),
                    .width = s.job.picture.width,
                    .height = s.job.picture.height};
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

FilmPlan plan_of(const Sequence& of, double rate) {
  const RenderOptions& o = of.job.options;
  const FilmClock::Settings clock{rate, o.hold, o.tween};
  const bool clips = of.to.is_by("step");
  std::vector<Frame> chosen;  // of each what a plan needs
  look_at_chosen(of, [&](const Frame& frame, const Staging&) {
    Frame& one = chosen.emplace_back();
    one.index = frame.index, one.step = frame.step, one.time = frame.time;
    one.caption = frame.caption;
  });
  const FilmPlan plan = o.length ? film_plan_for(pictures(*o.length, rate), chosen, clock, clips)
                                 : film_plan(chosen, clock, clips);
  say(fmt::format("{}: {:.1f} s, {} pictures to draw", of.scenario.name,
                  static_cast<double>(plan.moments) / rate, plan.pictures));
  return plan;
}

// All chosen frames as one film, or, where {step} stands in its name, as a clip a step. A clip
// begins with the still that the one before ended on.
class FilmSink : public FileSink {
 public:
  using FileSink::FileSink;
  std::optional<std::uint64_t> pictures() const override { return plan_.pictures; }

 protected:
  void take(const Frame& frame, const Staging& staging) override {
    walk_.go_on(frame, staging);
    walk_.page();  // while the staging is there
    ++made_.frames;
    if (const Frame* before = walk_.before()) leave(*before, frame);
  }

  void end() override {
    const Frame& last = walk_.here();
    show(last, walk_.page(), clock_.now());
    clock_.hold(last);
    clock_.hold_until(plan_.moments - plan_.twice);
    finish_film();
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
      throw UsageError("{}: more than {} pictures; choose fewer frames, or a lower --fps",
                       of_.scenario.name, InBetweens::kMostPictures);
    as_asked([&] {
      Renderer& renderer = of_.job.renderer(settings_.width, settings_.height, of_.work);
      if (!film_) begin_film(of, moment);
      film_->show(renderer.draw(list, of_.job.picture.theme, settings_.transparent),
                  moment - begun_);
      ++of_.work.frames_drawn;
    });
  }

  void begin_film(const Frame& of, std::uint64_t moment) {
    file_ = of_.file_of(of);
    film_.emplace(ffmpeg_, settings_, place_of(file_));
    begun_ = moment;
  }

  void finish_film() {
    const std::uint64_t length = clock_.now() - begun_;
    of_.work.bytes_written += film_->finish(length);
    ++of_.work.frames_written;
    film_.reset();
    made_.files.push_back(file_);
    made_.seconds = made_.seconds.value_or(0) + static_cast<double>(length) / settings_.rate;
    made_.rate = settings_.rate;
  }

  const FilmSettings settings_ = film_settings(of_);
  const fs::path ffmpeg_ = require_ffmpeg();
  const bool is_clips_ = of_.to.is_by("step");
  FrameWalk walk_{of_.job, of_.work};
  const FilmPlan plan_ = plan_of(of_, settings_.rate);
  FilmClock clock_{plan_.clock};
  std::optional<Film> film_;  // that is being made,
  fs::path file_;             // of this name,
  std::uint64_t begun_ = 0;   // begun at this moment
  std::uint64_t pictures_ = 0;
};

}  // namespace

FilmPlan film_plan(const std::vector<Frame>& frames, const FilmClock::Settings& clock, bool clips) {
  FilmPlan plan{clock};
  FilmClock now(clock);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Frame &a = frames[i - 1], &b = frames[i];
    const bool goes_on = a.index + 1 == b.index;
    if (FilmClock::is_still(a, b, goes_on)) {
      now.hold(a);
      ++plan.pictures;
      plan.twice += clips && goes_on && a.step != b.step;
    }
    plan.pictures += now.way(a, b, goes_on).size();
  }
  now.hold(frames.back());
  plan.pictures += 1 + plan.twice;
  plan.moments = now.now() + plan.twice;
  return plan;
}

FilmPlan film_plan_for(std::uint64_t moments, const std::vector<Frame>& frames,
                       FilmClock::Settings clock, bool clips) {
  const auto at = [&](double slower) {
    clock.slower = slower;
    return film_plan(frames, clock, clips);
  };
  FilmPlan best = at(0);
  if (best.moments > moments) {
    clock.in_betweens = 0;
    throw UsageError("--length {:.4g}: what moves takes {:.2f} s; choose fewer frames (--frames){}",
                     static_cast<double>(moments) / clock.rate,
                     std::ceil(100 * static_cast<double>(best.moments) / clock.rate) / 100,
                     at(0).moments <= moments ? ", or cut from each to the next (--tween 0)" : "");
  }
  constexpr double kSlowest = 1e6;
  double least = 0, most = 1;
  while (most < kSlowest && at(most).moments <= moments) most *= 2;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (least + most);
    FilmPlan plan = at(middle);
    const bool fits = plan.moments <= moments;
    (fits ? least : most) = middle;
    if (fits) best = std::move(plan);
  }
  best.moments = moments;
  return best;
}

bool FilmClock::is_still(const Frame& a, const Frame& b, bool goes_on) {
  return !goes_on || a.step != b.step || !is_one_movement(a, b);
}

void FilmClock::see(const Frame& frame) {
  std::string words = words_of(frame.caption);
  if (words == words_) return;
  words_ = std::move(words);
  words_since_ = now_;
}

double FilmClock::seconds_of(const Frame& still) {
  if (settings_.hold) return *settings_.hold;
  const double seen = static_cast<double>(now_ - words_since_) / settings_.rate;
  return std::max(kLook, static_cast<double>(letters(still.caption)) / kLettersPerSecond - seen);
}

void FilmClock::hold(const Frame& still) {
  see(still);
  now_ += pictures(settings_.slower * seconds_of(still), settings_.rate);
  moving_ = false;
}

// The last of so many different pictures that has come.
double FilmClock::quantized(double t) const {
  if (!settings_.in_betweens) return t;
  const auto parts = static_cast<double>(*settings_.in_betweens + 1);
  return std::floor(t * parts + 1e-9) / parts;
}

std::vector<FilmClock::Shot> FilmClock::way(const Frame& a, const Frame& b, bool goes_on) {
  std::vector<Shot> shots;
  if (!goes_on) return shots;
  see(b);
  if (is_one_movement(a, b)) {
    move(a, b, shots);
  } else if (settings_.in_betweens != 0u) {
    const std::uint64_t all = pictures(kChangeSeconds, settings_.rate);
    for (std::uint64_t k = 1; k < all; ++k, ++now_) {
      const double t = quantized(static_cast<double>(k) / static_cast<double>(all));
      if (t > 0 && (shots.empty() || t != shots.back().t)) shots.push_back({t, now_});
    }
  }
  return shots;
}

// By the world's clock, so that nothing is lost or gained by rounding from frame to frame.
void FilmClock::move(const Frame& a, const Frame& b, std::vector<Shot>& shots) {
  if (!moving_) {
    moving_ = true;
    from_time_ = a.time;
    from_moment_ = now_ > 0 ? now_ - 1 : 0;  // the last one of the still before it
  }
  const double nearly = 1e-3 / settings_.rate;
  for (;; ++now_) {
    const double time =
        from_time_ + static_cast<double>(now_ - from_moment_) / settings_.rate + nearly;
    if (time >= b.time) return;
    const double t = quantized(std::max(0.0, time - nearly - a.time) / (b.time - a.time));
    if (shots.empty() || t != shots.back().t) shots.push_back({t, now_});
  }
}

std::unique_ptr<FileSink> make_film_sink(const Sequence& sequence) {
  return std::make_unique<FilmSink>(sequence);
}

}  // namespace lantern::app
