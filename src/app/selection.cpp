#include "app/selection.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "base/suggest.hpp"

namespace lantern::app {
namespace {

template <class T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::pair<int, int> parse_size(const std::string& text, int most) {
  constexpr int kLeast = 16;
  const std::size_t x = text.find('x');
  const std::string_view all = text;
  const auto width = number<int>(all.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : number<int>(all.substr(x + 1));
  if (!width || !height || std::min(*width, *height) < kLeast || std::max(*width, *height) > most)
    throw UsageError(
        fmt::format("--size {}: give width x height in pixels, {} to {} each, as "
                    "1280x720",
                    text, kLeast, most));
  return {*width, *height};
}

Selection::Selection(const std::string& frames, const std::string& at,
                     std::optional<std::uint64_t> most_frames)
    : frames_(frames), at_(at), time_(number<double>(at)) {
  if (time_ && !std::isfinite(*time_)) time_.reset();
  if (frames.empty()) return;
  const std::size_t dash = frames.find('-');
  const std::string_view from = std::string_view(frames).substr(0, dash);
  const std::string_view to =
      dash == std::string::npos ? from : std::string_view(frames).substr(dash + 1);
  const auto read = [&](std::string_view word) {
    const auto index = number<std::uint32_t>(word);
    if (!index)
      throw UsageError(
          fmt::format("--frames {}: give a frame or a range, as 7, 3-9, 3- or -9", frames));
    return *index;
  };
  if (!from.empty() || to.empty()) first_ = read(from);
  if (!to.empty()) last_ = read(to);
  if (last_ && first_ > *last_)
    throw UsageError(fmt::format("--frames {}: the range ends before it begins", frames));
  if (most_frames && std::max(first_, last_.value_or(0)) >= *most_frames)
    refuse_range(*most_frames);
}

void Selection::refuse_range(std::uint64_t count) const {
  throw UsageError(fmt::format(
      "--frames {}: give a frame or a range within 0-{}, as 7, 3-9, 3- or -9", frames_, count - 1));
}

bool Selection::takes(const Frame& frame) {
  ++asked_;
  end_ = frame.time;
  if (!at_.empty()) events_.insert(frame.event);
  if (frame.index < first_ || (last_ && frame.index > *last_)) return false;
  // World time is a sum of steps, so a time as written may miss it by a rounding error.
  if (time_ && (taken_ > 0 || frame.time < *time_ - 1e-9)) return false;
  if (!at_.empty() && !time_ && frame.event != at_) return false;
  ++taken_;
  return true;
}

void Selection::require_some() const {
  if (std::max(first_, last_.value_or(0)) >= asked_ && !frames_.empty()) refuse_range(asked_);
  if (taken_ > 0) return;
  if (!at_.empty() && !time_ && !events_.contains(at_)) {
    const std::vector<std::string_view> known(events_.begin(), events_.end());
    throw UsageError(
        with_suggestion(fmt::format("--at {}: no frame has this event", at_), at_, known, 40));
  }
  throw UsageError(
      fmt::format("--at {}: no frame is chosen; the last one is at {:.6g} s", at_, end_));
}

}  // namespace lantern::app
