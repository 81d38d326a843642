#include "app/film_clock.hpp"

#include <algorithm>
#include <cmath>

#include "app/in_betweens.hpp"
#include "base/utf8.hpp"

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

}  // namespace

bool FilmClock::is_still(const Frame& a, const Frame& b, bool goes_on) {
  return !goes_on || a.step != b.step || !InBetweens::is_one_movement(a, b);
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
  now_ += pictures(seconds_of(still), settings_.rate);
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
  if (InBetweens::is_one_movement(a, b)) {
    move(a, b, shots);
  } else if (settings_.in_betweens != 0u) {
    const std::uint64_t all = pictures(InBetweens::kChange, settings_.rate);
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

}  // namespace lantern::app
