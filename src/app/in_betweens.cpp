#include "app/in_betweens.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/grouped.hpp"

namespace lantern::app {
namespace {

// Between the picture at a time's begin and the one at its end.
std::uint64_t within(double seconds, double fps) {
  return static_cast<std::uint64_t>(std::max(0.0, std::floor(seconds * fps + 0.5) - 1));
}

}  // namespace

InBetweens::InBetweens(std::optional<std::uint64_t> tween, std::optional<double> fps) {
  number_ = tween.value_or(0);
  if (fps) {
    fps_ = *fps;
    number_ = within(kChange, fps_);
  }
}

std::string InBetweens::setting() const {
  if (!wanted()) return "";
  return fps_ > 0 ? fmt::format("{} fps", fps_) : fmt::format("{}", number_);
}

std::uint64_t InBetweens::between(const Frame& a, const Frame& b) const {
  return fps_ > 0 && is_one_movement(a, b) ? within(b.time - a.time, fps_) : number_;
}

bool InBetweens::is_one_movement(const Frame& a, const Frame& b) {
  const double passed = b.time - a.time;
  return passed > 0 && passed < kChange;
}

Motion InBetweens::motion(const Frame& a, const Frame& b) {
  return is_one_movement(a, b) ? Motion::steady : Motion::eased;
}

void InBetweens::require_few(std::optional<std::uint64_t> frames) const {
  const std::uint64_t known = std::max<std::uint64_t>(frames.value_or(2), 1);
  if (!wanted() || (number_ <= kMostPictures && known + (known - 1) * number_ <= kMostPictures))
    return;
  throw UsageError(
      fmt::format("--tween {}: up to {} frames and {} in-betweens before each but the "
                  "first are more than {} pictures; ask for fewer",
                  number_, known, number_, grouped(static_cast<std::int64_t>(kMostPictures), " ")));
}

}  // namespace lantern::app
