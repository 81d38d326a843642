#include "app/progress.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "base/number.hpp"

namespace lantern::app {

namespace {

std::string counted_plainly(std::uint64_t number, std::string_view noun) {
  return fmt::format("{} {}{}", lantern::grouped(number, " "), noun, number == 1 ? "" : "s");
}

std::string left_text(const std::optional<TimeLeft>& left) {
  if (!left) return "";
  return fmt::format(", {} {} left", left->at_least ? "more than" : "about",
                     duration_text(left->seconds));
}

double share_left(std::uint64_t all, std::uint64_t done, double seconds) {
  return static_cast<double>(all - std::min(all, done)) * seconds / static_cast<double>(done);
}

// Of the run. World steps take the time where there are any.
std::optional<TimeLeft> run_left(const RunExtent& extent, const RunState& state) {
  if (extent.world_steps > 0) {
    if (state.world_steps > 0)
      return TimeLeft{share_left(extent.world_steps, state.world_steps, state.step_seconds), false};
    // Something is being inserted or compiled; only after a frame can it be a world step.
    if (state.frames == 0) return std::nullopt;
    const double least = state.step_seconds * static_cast<double>(extent.world_steps);
    return least < 1 ? std::nullopt : std::optional(TimeLeft{least, true});
  }
  if (!extent.frames || state.frames == 0) return std::nullopt;
  return TimeLeft{share_left(*extent.frames, state.frames, state.seconds), false};
}

constexpr double kRedraw = 0.1;     // seconds between two drawings on a terminal
constexpr double kPlainLine = 5.0;  // and between two plain lines elsewhere
constexpr double kForecast = 0.5;   // seconds of work after which it is told what is to come,
constexpr double kMoment = 2.0;     // unless it ends so soon
constexpr double kLong = 10.0;      // more than this is worth to find out what would be quicker

bool has_listener() { return ::fcntl(STDERR_FILENO, F_GETFD) != -1; }

// The second number of statm counts pages that are in memory.
std::optional<std::size_t> memory_in_use() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  if (!(file >> all >> resident)) return std::nullopt;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

RunExtent extent_of(const Scenario& scenario, Pace pace) {
  const bool by_event =
      pace == Pace::event ||
      std::ranges::any_of(scenario.steps, [](const Step& s) { return s.pace == Pace::event; });
  return {by_event ? std::nullopt : std::optional(scenario.most_frames), scenario.world_steps};
}

// Frames that wait are drawn after the run, or a part of it: how long that takes, only those show
// that are drawn.
std::optional<TimeLeft> time_left(const RunExtent& extent, const RunState& state) {
  std::optional<TimeLeft> left = run_left(extent, state);
  if (extent.pictures && state.drawn > 0)
    return TimeLeft{share_left(*extent.pictures, state.drawn, state.draw_seconds), false};
  if (state.waiting == 0) return left;
  const std::uint64_t drawn = state.frames - state.waiting;
  if (drawn > 0 && extent.frames) {
    const double drawing = share_left(*extent.frames, drawn, state.draw_seconds);
    return TimeLeft{std::max(drawing, left ? left->seconds : 0), left && left->at_least};
  }
  if (left) left->at_least = true;
  return left && left->seconds >= 1 ? left : std::nullopt;
}

std::string forecast_text(const RunExtent& extent, const RunState& state) {
  std::string text = extent.frames     ? "up to " + counted_plainly(*extent.frames, "frame")
                     : extent.pictures ? counted_plainly(*extent.pictures, "picture")
                                       : "as many frames as there are events, not known beforehand";
  if (extent.world_steps > 0)
    text += fmt::format("{} {}", extent.frames ? " of" : "; up to",
                        counted_plainly(extent.world_steps, "world step"));
  const std::uint64_t written = extent.chosen.value_or(extent.frames.value_or(1));
  const std::uint64_t between =
      (written - std::min<std::uint64_t>(written, 1)) * extent.in_betweens;
  if (between > 0)
    text += " and " + counted_plainly(between, "in-between");
  else if (extent.in_betweens > 0)
    text += fmt::format(" and {} before each but the first",
                        counted_plainly(extent.in_betweens, "in-between"));
  const auto left = time_left(extent, state);
  text += left ? left_text(left) : ", how long cannot be told yet";
  if (state.files > 0 && extent.frames)
    text += fmt::format("; about {} on the disk",
                        memory_text(static_cast<std::uint64_t>(
                            static_cast<double>(state.bytes) / static_cast<double>(state.files) *
                            static_cast<double>(written + between))));
  if (state.memory) text += fmt::format("; {} of memory", memory_text(*state.memory));
  if (state.memory && state.budget) text += fmt::format(" (budget {})", memory_text(*state.budget));
  return text;
}

std::string progress_text(const RunExtent& extent, const RunState& state) {
  const std::uint64_t frames = state.frames - state.waiting;
  if (extent.pictures && state.drawn >= *extent.pictures)
    return counted_plainly(state.drawn, "picture") + " drawn, the file is being finished";
  if (extent.pictures && state.drawn > 0)
    return fmt::format("{} of {}{}", lantern::grouped(state.drawn, " "),
                       counted_plainly(*extent.pictures, "picture"),
                       left_text(time_left(extent, state)));
  std::string text = extent.frames
                         ? fmt::format("{} of {}", frames, counted_plainly(*extent.frames, "frame"))
                         : counted_plainly(frames, "frame");
  if (extent.in_betweens > 0) text += ", " + counted_plainly(state.in_betweens, "in-between");
  if (extent.world_steps > 0)
    text += fmt::format(", {} of {}", lantern::grouped(state.world_steps, " "),
                        counted_plainly(extent.world_steps, "world step"));
  if (state.files > 0) text += fmt::format(", {} on the disk", memory_text(state.bytes));
  if (extent.frames && frames >= *extent.frames && state.drawn > 0)
    return text + ", " + counted_plainly(state.drawn, "picture") + " drawn";
  return text + left_text(time_left(extent, state));
}

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::max(1.0, seconds));
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  if (seconds < 100 * 3600) return fmt::format("{:.0f} h", seconds / 3600);
  return fmt::format("{:.0f} days", seconds / 86400);
}

Progress::Progress(std::string name, const RunExtent& extent, const Work& work,
                   std::optional<std::size_t> memory_budget, std::function<std::uint64_t()> waiting)
    : name_(std::move(name)),
      extent_(extent),
      work_(&work),
      waiting_(std::move(waiting)),
      steps_before_(work.world_steps),
      files_before_(work.frames_written),
      bytes_before_(work.bytes_written),
      between_before_(work.in_betweens),
      drawn_before_(work.frames_drawn),
      budget_(memory_budget) {
  start();
}

Progress::Progress(std::string name, std::uint64_t total, std::string unit)
    : name_(std::move(name)), total_(total), unit_(std::move(unit)) {
  start();
}

// A system that gives no thread gets no progress; the work goes on.
void Progress::start() {
  if (is_quiet() || !has_listener()) return;
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (const std::system_error&) {
  }
}

Progress::~Progress() {
  {
    const std::lock_guard guard(lock_);
    ended_ = true;
  }
  end_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Progress::tell(std::string words) {
  const std::lock_guard guard(lock_);
  told_ = std::move(words);
}

void Progress::watch() try {
  const bool on_terminal = animated();
  double last_line = 0;
  bool forecast = false;
  std::unique_lock guard(lock_);
  while (!end_.wait_for(guard, std::chrono::duration<double>(kRedraw), [&] { return ended_; })) {
    RunState state;
    look(state);
    const auto left = extent_ ? time_left(*extent_, state) : std::nullopt;
    if (extent_ && !forecast && state.seconds >= kForecast) {
      // What waits may be drawn in a moment.
      const bool is_open =
          state.waiting > 0 && state.waiting == state.frames && state.seconds < kMoment;
      if ((left && left->seconds > kMoment) || (!is_open && (!left || left->at_least))) {
        say(fmt::format("{}: {}", name_, forecast_text(*extent_, state)));
        forecast = true;
      }
    }
    long_left_ = forecast && left && left->seconds > kLong ? left->seconds : 0;
    if (!on_terminal && state.seconds - last_line < kPlainLine) continue;
    last_line = state.seconds;
    const std::string line = extent_          ? progress_text(*extent_, state)
                             : !told_.empty() ? told_
                                              : words();
    if (line.empty()) continue;
    if (on_terminal)
      show_status(fmt::format("{}: {}", name_, line));
    else
      say(fmt::format("{}: {}", name_, line));
  }
  clear_status();
} catch (const std::exception&) {
  // No memory for words: none are said.
}

// What can be read of the work from another thread.
void Progress::look(RunState& state) {
  state.seconds = watch_.seconds();
  if (!extent_) return;
  // Read first: what is drawn meanwhile was done before.
  const std::uint64_t waiting = waiting_();
  state.frames = count_;
  state.waiting = std::min(waiting, state.frames);
  state.world_steps = work_->world_steps - steps_before_;
  state.files = work_->frames_written - files_before_;
  state.bytes = work_->bytes_written - bytes_before_;
  state.in_betweens = work_->in_betweens - between_before_;
  state.drawn = work_->frames_drawn - drawn_before_;
  state.memory = memory_in_use();
  state.budget = budget_;
  if (state.world_steps == 0 && state.frames != last_frames_) {
    last_frames_ = state.frames;
    last_change_ = state.seconds;
  }
  state.step_seconds = state.seconds - last_change_;
  if (state.frames == state.waiting) undrawn_until_ = state.seconds;
  state.draw_seconds = state.seconds - undrawn_until_;
}

std::string Progress::words() {
  const std::uint64_t count = count_;
  if (count == 0) return fmt::format("0 of {} {}", total_, unit_);
  const double rate = static_cast<double>(count) / watch_.seconds();
  return fmt::format("{} of {} {}, {:.3g} a second, about {} left", count, total_, unit_, rate,
                     duration_text(static_cast<double>(total_ - count) / rate));
}

}  // namespace lantern::app
