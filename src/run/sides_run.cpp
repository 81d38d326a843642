// The script under the settings of every side, on one clock.
#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/memory.hpp"
#include "base/words.hpp"
#include "language/counts.hpp"
#include "run/script_run.hpp"

namespace lantern::run {
namespace {

// A frame of one side, with the texts that a caption may quote of it.
struct Shown {
  Frame frame;
  std::map<std::string, std::string, std::less<>> texts;
};

// What a placeholder stands for: words, or a count, which may have a noun.
struct Quote {
  std::optional<std::string> words;
  std::optional<std::int64_t> count;
  bool operator==(const Quote&) const = default;
};

class Side {
 public:
  Side(const Scenario& scenario, Pace pace, Work& work, RunWatch* watch)
      : scenario_(scenario), run_(scenario, pace, work, sink_, watch) {}
  Side& operator=(Side&&) = delete;  // nor any other copy or move

  // Its frames of the step; the first has number `frame`. Adds their bytes.
  void play(const Scenario& as, std::size_t step, std::uint32_t frame, std::uint64_t& bytes) {
    shown_.clear();
    bytes_ = &bytes;
    run_.frames.go_on_at(frame);
    run_.play(as, step);
  }

  const std::string& name() const { return scenario_.side; }
  std::size_t frames() const { return shown_.size(); }
  bool holds(std::size_t k) const { return k >= shown_.size(); }
  const Shown& at(std::size_t k) const { return shown_[std::min(k, shown_.size() - 1)]; }

  Quote quote(std::string_view name, std::size_t k) const {
    const Shown& shown = at(k);
    if (name == "time") return {say("{:.2f}", shown.frame.time), std::nullopt};
    if (const auto text = shown.texts.find(name); text != shown.texts.end())
      return {text->second, std::nullopt};
    if (const auto measured = shown.frame.measure(name))
      return {say("{:.4g}", *measured), std::nullopt};
    return {std::nullopt, shown.frame.count(name)};
  }

  DirectorReport report() { return run_.report(); }

 private:
  bool take(const Frame& frame) {
    *bytes_ += estimated_bytes(frame);
    require_memory(*bytes_, "the frames of this step on all sides",
                   "cut it in two steps, or show fewer frames with a larger 'every'");
    Shown& shown = shown_.emplace_back();
    shown.frame = frame;
    for (const std::string_view name : {"texture", "refused_names"})
      if (auto text = run_.frames.text_of(name, frame)) shown.texts.emplace(name, std::move(*text));
    return true;
  }

  const Scenario& scenario_;
  std::function<bool(const Frame&)> sink_ = [this](const Frame& frame) { return take(frame); };
  ScriptRun run_;
  std::vector<Shown> shown_;  // of the step
  std::uint64_t* bytes_ = nullptr;
};

// Does a step show one side other code than another?
bool has_code_by_side(const Scenario& scenario) {
  const auto shown = [](const Step& step) {
    return step.code ? step.code->function + '\n' + step.code->line : std::string();
  };
  const auto& first = scenario.sides[0]->steps;
  return std::ranges::any_of(scenario.sides, [&](const auto& side) {
    return !std::ranges::equal(side->steps, first, {}, shown, shown);
  });
}

class SidesRun : public Performance {
 public:
  SidesRun(const Scenario& scenario, Pace pace, Work& work,
           const std::function<bool(const Frame&)>& sink, RunWatch* watch)
      : scenario_(scenario), sink_(sink) {
    for (std::size_t i = 0; i < scenario.sides.size(); ++i)
      sides_.emplace_back(*scenario.sides[i], pace, work, watch ? &watch->of_side(i) : nullptr);
    if (scenario.chart) plotter_.emplace(scenario);
  }

  DirectorReport report() override {
    for (Side& side : sides_) add(side.report());
    return std::move(report_);
  }
  bool stopped() const override { return stopped_; }

  void play(const Scenario& as, std::size_t index) override {
    const Step& step = as.steps[index];
    std::uint64_t bytes = 0;
    std::size_t frames = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      Side& side = sides_[i];
      side.play(*as.sides[i], index, report_.frames, bytes);
      LANTERN_CHECK(side.frames(), >, std::size_t{0});  // a step ends with one
      frames = std::max(frames, side.frames());
    }
    if (!step.part.empty()) part_ = step.part;
    if (plotter_) plotter_->begin_part(part_, time_);
    told_ = false;
    for (std::size_t k = 0; k < frames && !stopped_; ++k) {
      Frame frame = together(k);
      plot(step, k + 1 == frames, frame);
      frame.caption = caption(step, k, k + 1 == frames, frame);
      if (k + 1 == frames && !step.question.empty())
        frame.add<FrameQuestion>() =
            FrameQuestion{step.question, filled(step, step.answer, k, frame), step.predict};
      ++report_.frames;
      stopped_ = !sink_(frame);
    }
  }

 private:
  // What the sides share, and the frame of each.
  Frame together(std::size_t k) {
    Frame frame;
    static_cast<FramePage&>(frame) = sides_[0].at(k).frame;
    frame.index = report_.frames;
    std::erase_if(frame.panels, [&](Panel panel) { return panel == own_panel_; });
    if (const auto* code = sides_[0].at(k).frame.find<FrameCode>(); code && !own_panel_)
      frame.add<FrameCode>() = *code;  // drawn once, for all
    for (const Side& side : sides_) {
      Frame& shown = frame.sides.emplace_back(side.at(k).frame);
      const bool held = shown.add<FrameSide>().held = side.holds(k);
      shown.index = frame.index;
      shown.drop<FrameChart>();  // drawn once, for all
      std::erase_if(shown.panels, [&](Panel panel) {
        return kind_of(panel).of_all_sides && panel != own_panel_;
      });
      if (held) shown.since_last_frame.reset();
      if (frame.event.empty() && !held) frame.event = shown.event;
      if (!held) frame.step_name = shown.step_name;
      frame.time = std::max(frame.time, shown.time);
    }
    frame.hash = state_hash(frame);
    return frame;
  }

  void plot(const Step& step, bool last, Frame& frame) {
    if (!plotter_) return;
    // In the midst of what an algorithm does no time passes.
    if (plotter_->over_time() && (last || frame.time > time_)) plotter_->add_moment(frame);
    if (!plotter_->over_time() && last && step.plot) plotter_->add(*step.plot, part_, frame);
    time_ = frame.time;
    frame.add<FrameChart>() = plotter_->chart();
  }

  // What the algorithm does on all sides alike, or, when all are done, the step's own words. What
  // one side does that the others do not is said by that side.
  std::string caption(const Step& step, std::size_t k, bool last, Frame& frame) {
    const auto speaks = [](const Frame& side) {
      return !side.get<FrameSide>().held && !side.caption.empty();
    };
    if (std::ranges::none_of(frame.sides, speaks)) return filled(step, step.words(last), k, frame);
    const std::string words = frame.sides[0].caption;
    for (const Frame& side : frame.sides)
      if (side.caption != words) return "";
    for (Frame& side : frame.sides) side.caption.clear();
    return words;
  }

  std::string filled(const Step& step, const std::string& text, std::size_t k, const Frame& frame) {
    std::map<std::string, Quote, std::less<>> known;  // a name is asked for as words, then as count
    const auto quote = [&](std::string_view name) -> const Quote& {
      const auto found = known.find(name);
      if (found != known.end()) return found->second;
      return known.emplace(name, quoted(step, name, k, frame)).first->second;
    };
    const Speaking speaking(scenario_.words_of(text));
    return fill_caption(
        text, [&](std::string_view name) { return quote(name).words; },
        [&](std::string_view name) { return quote(name).count; });
  }

  // Of one side by its name; without one, what all sides have in common.
  Quote quoted(const Step& step, std::string_view name, std::size_t k, const Frame& frame) {
    const std::size_t dot = name.find('.');
    const auto named = std::ranges::find(sides_, name.substr(0, dot), &Side::name);
    if (dot != std::string_view::npos && named != sides_.end())
      return named->quote(name.substr(dot + 1), k);
    Quote common = sides_[0].quote(name, k);
    for (const Side& side : sides_)
      if (side.quote(name, k) != common) tell_apart(step, name, side, frame);
    return common;
  }

  // A caption must not say of all sides what only one shows.
  void tell_apart(const Step& step, std::string_view name, const Side& other, const Frame& frame) {
    if (std::exchange(told_, true)) return;
    report_.unmet.add([&] {
      return diagnose(
          scenario_, step.where,
          fmt::format("the caption quotes '{}', which is not the same on the sides '{}' and '{}' "
                      "(frame {}, time {:.6g} s)",
                      name, sides_[0].name(), other.name(), frame.index, frame.time),
          fmt::format("say of which side it is, as {{{}.{}}}", sides_[0].name(), name));
    });
  }

  void add(DirectorReport of_side) {
    report_.expectations += of_side.expectations;
    report_.unmet.add_all(of_side.unmet);
    for (const WorldCounter& counter : kWorldCounters)
      report_.world.*counter.count += of_side.world.*counter.count;
    report_.world.islands += of_side.world.islands;
    report_.world.asleep += of_side.world.asleep;
  }

  const Scenario& scenario_;
  // Of code, where each side has its own; else all have one.
  const std::optional<Panel> own_panel_ =
      has_code_by_side(scenario_) ? std::optional(language::panel_named("code")) : std::nullopt;
  const std::function<bool(const Frame&)>& sink_;
  std::deque<Side> sides_;
  std::optional<Plotter> plotter_;
  DirectorReport report_;
  std::string part_;
  double time_ = 0;    // of the last frame
  bool told_ = false;  // that the step's caption is not true of all sides
  bool stopped_ = false;
};

}  // namespace

std::unique_ptr<Performance> perform_sides(const Scenario& scenario, Pace pace, Work& work,
                                           const std::function<bool(const Frame&)>& sink,
                                           RunWatch* watch) {
  return std::make_unique<SidesRun>(scenario, pace, work, sink, watch);
}

}  // namespace lantern::run
