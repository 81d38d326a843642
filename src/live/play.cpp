#include "live/play.hpp"

#include <algorithm>
#include <iterator>

#include "base/check.hpp"
#include "run/shown.hpp"
#include "run/warnings.hpp"

namespace lantern::live {

using namespace run;

namespace {

constexpr std::size_t kMostFrames = 5000;
constexpr std::size_t kMostBytes = std::size_t{96} << 20;  // of what frames list

}  // namespace

void stop_every(int world_steps, std::size_t from, Scenario& scenario) {
  const auto stop = [&]<class V>(V& verb) {
    if constexpr (V::kTraits.passes_time && requires { verb.every; }) verb.every = world_steps;
  };
  for (std::size_t i = from; i < scenario.steps.size(); ++i)
    std::visit(stop, scenario.steps[i].verb);
  for (auto& side : scenario.sides) {
    auto own = std::make_shared<Scenario>(*side);
    stop_every(world_steps, from, *own);
    side = std::move(own);
  }
}

bool Play::keep(const Frame& frame) {
  place_ = frames_.empty() || frames_.back().step != frame.step ? 0 : place_ + 1;
  frames_.push_back(frame);
  bytes_ += estimated_bytes(frame);
  if (frames_.size() > kMostFrames || bytes_ > kMostBytes)
    throw Refused("a page has room for {} frames and {} MB of what they list: 'every' makes fewer",
                  kMostFrames, kMostBytes >> 20);
  return !(last_ && !last_->is_last && frame.step == last_->step && place_ == last_->place);
}

Play::Play(Scenario scenario, const Moment& before)
    : scenario_(std::move(scenario)), begun_(perform(scenario_, scenario_.pace, work_, sink_)) {
  const std::size_t steps = std::min<std::size_t>(before.step, scenario_.steps.size());
  for (std::size_t i = 0; i < steps; ++i) begun_->play(scenario_, i);
}

void Play::go_on(const Scenario& as, const Moment& until) {
  last_ = until;
  if (until.step < as.steps.size()) begun_->play(as, until.step);
}

Play::Play(Scenario scenario) : scenario_(std::move(scenario)) {
  RunWatch watch(scenario_, draw::shows_a_body);
  const DirectorReport report = direct(scenario_, scenario_.pace, work_, sink_, &watch);
  unmet_ = report.unmet.list("that do not hold");
  warnings_ = warnings_of_file(scenario_);
  std::ranges::move(watch.warnings(), std::back_inserter(warnings_));
  for (const Frame& frame : frames_) axes_.see(frame);
  for (std::span<const Frame> rest = frames_; !rest.empty();) {
    const std::span<const Frame> group = draw::Staging::first_group(rest);
    groups_.push_back({group, nullptr});
    rest = rest.subspan(group.size());
  }
}

Moment Play::moment_of(std::size_t index) const {
  const std::uint32_t step = frames_.at(index).step;
  std::size_t first = index;
  while (first > 0 && frames_[first - 1].step == step) --first;
  const bool is_last = index + 1 == frames_.size() || frames_[index + 1].step != step;
  return {step, static_cast<std::uint32_t>(index - first), is_last};
}

std::size_t Play::index_of(const Moment& moment) const {
  LANTERN_CHECK(frames_.size(), >, 0u);
  const auto first = std::ranges::lower_bound(frames_, moment.step, {}, &Frame::step);
  const auto last = std::ranges::upper_bound(frames_, moment.step, {}, &Frame::step);
  if (first == last) return static_cast<std::size_t>(std::max(last - frames_.begin(), 1L) - 1);
  const auto count = last - first;
  const auto place = std::min<std::ptrdiff_t>(moment.is_last ? count - 1 : moment.place, count - 1);
  return static_cast<std::size_t>(first - frames_.begin() + place);
}

Play::Group& Play::group_of(std::size_t index) {
  const Frame* frame = &frames_.at(index);
  const auto first = [](const Group& group) { return group.frames.data(); };
  return *std::prev(std::ranges::upper_bound(groups_, frame, {}, first));
}

const draw::Staging& Play::staging_of(std::size_t index) {
  Group& group = group_of(index);
  if (!group.staging) group.staging = std::make_unique<draw::Staging>(frames_beside(group), axes_);
  return *group.staging;
}

std::vector<const Frame*> Play::frames_beside(const Group& group) const {
  std::vector<const Frame*> all;
  const auto add = [&](const Group& some) {
    for (const Frame& frame : some.frames) all.push_back(&frame);
  };
  if (lesson)
    for (const Group& its : lesson->groups_)
      if (draw::Staging::is_one_group(its.frames.front(), group.frames.front())) add(its);
  add(group);
  return all;
}

draw::DrawList Play::picture(std::size_t index) {
  return drawn(frames_.at(index), staging_of(index), scenario_);
}

draw::DrawList Play::page(std::size_t index, int width, int height) {
  return draw_frame(frames_.at(index), staging_of(index), draw::page_for(width, height), work_);
}

draw::DrawList Play::picture(const Frame& frame, std::size_t beside, const Scenario& of) {
  const Group& group = group_of(beside);
  std::vector<const Frame*> all;
  if (draw::Staging::is_one_group(frames_.at(beside), frame)) all = frames_beside(group);
  all.push_back(&frame);
  draw::AxisRanges axes = axes_;
  if (!std::ranges::equal(of.steps, scenario_.steps, {}, &Step::plot, &Step::plot))
    axes.forget_names();
  return drawn(frame, draw::Staging(std::move(all), axes), of);
}

draw::DrawList Play::drawn(const Frame& frame, const draw::Staging& staging, const Scenario& of) {
  Frame bare = frame;
  if (!held.empty() && !traits_of(of.steps.at(frame.step).verb).asks) light_held(held, bare);
  bare.display.title = bare.display.caption = bare.display.counters = false;
  return draw_frame(bare, staging, sheet, work_);
}

}  // namespace lantern::live
