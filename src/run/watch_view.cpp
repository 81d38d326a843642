// Warnings of pictures in which there is nothing to see, and of bodies beyond the world's bounds.
#include <algorithm>

#include <fmt/format.h>

#include "run/watcher.hpp"

namespace lantern::run {
namespace {

// A half-space ends nowhere: it is ground, and never the thing that is looked at.
bool is_ground(const FrameBody& body) { return std::holds_alternative<HalfSpace<3>>(body.shape); }

class ViewWatch : public Watcher {
 public:
  ViewWatch(const Scenario& scenario, std::function<bool(const Frame&)> shows_a_body)
      : scenario_(scenario), shows_a_body_(std::move(shows_a_body)) {}

  void begin(const Step& step) override {
    if (step.view) view_ = step.view->at ? &step.view->where : nullptr;
    if (step.camera) view_ = &step.camera->where;
  }

  void see_frame(const Frame& frame) override {
    const auto is_thing = [](const FrameBody& body) { return !is_ground(body); };
    const auto thing = std::find_if(frame.bodies.begin(), frame.bodies.end(), is_thing);
    if (thing == frame.bodies.end()) return;
    ++seen_;
    if (shows_a_body_(frame) || ++empty_ > 1) return;
    name_ = thing->name;
    at_ = thing->position;
    first_ = frame.index;
    time_ = frame.time;
    at_view_ = view_;
  }

  std::vector<Diagnostic> warnings() const override {
    if (empty_ == 0) return {};
    const WorldSpec& world = scenario_.world;
    const bool aimed = world.has_camera;
    const std::string message = fmt::format(
        "frame {} ({:.4g} s) shows no body, though '{}' is in the world{}", first_, time_, name_,
        empty_ > 1 ? fmt::format("; so do {} of {} frames", empty_, seen_) : "");
    const bool flat = world.dimension == 2;
    if (at_view_)
      return {warning(scenario_, *at_view_, message,
                      flat ? fmt::format("at = [{:.4g}, {:.4g}] would show it", at_.x, at_.y)
                           : fmt::format("target = [{:.4g}, {:.4g}, {:.4g}] would look at it",
                                         at_.x, at_.y, at_.z))};
    const std::string advice =
        aimed ? fmt::format("camera_target = [{:.4g}, {:.4g}, {:.4g}] would look at it", at_.x,
                            at_.y, at_.z)
              : "give [world] another size, or the bodies another position";
    return {
        warning(scenario_,
                aimed ? world.place_of({"camera_target"}) : world.place_of({"size", "max", "min"}),
                message, advice)};
  }

 private:
  const Scenario& scenario_;
  std::function<bool(const Frame&)> shows_a_body_;
  const SourcePosition* view_ = nullptr;     // of the step that chose what is shown now
  const SourcePosition* at_view_ = nullptr;  // and on the first empty frame
  std::uint64_t seen_ = 0;                   // frames with bodies
  std::uint64_t empty_ = 0;                  // of those, that show none
  std::string name_;                         // a body that the first of them does not show
  Vec<3> at_{0.0};
  std::uint32_t first_ = 0;
  double time_ = 0;
};

class OutsideWatch : public Watcher {
 public:
  explicit OutsideWatch(const Scenario& scenario)
      : scenario_(scenario), specs_(bodies_by_name(scenario)) {}

  void see_frame(const Frame& frame) override {
    for (const FrameBody& body : frame.bodies) {
      if (was_.size() <= body.id) was_.resize(body.id + std::size_t{1}, Was::unknown);
      Was& was = was_[body.id];
      if (was == Was::outside) continue;
      if (is_ground(body) || overlap(body.box, frame.bounds)) {
        was = Was::inside;
        continue;
      }
      found_.add([&] { return outside(body, frame, was == Was::inside); });
      was = Was::outside;
    }
  }

  std::vector<Diagnostic> warnings() const override {
    return found_.list("bodies are outside the world");
  }

 private:
  enum class Was : char { unknown, inside, outside };

  Diagnostic outside(const FrameBody& body, const Frame& frame, bool left) const {
    double by = 0;
    for (int i = 0; i < frame.dimension; ++i)
      by = std::max({by, body.box.lo[i] - frame.bounds.hi[i], frame.bounds.lo[i] - body.box.hi[i]});
    const std::string message =
        fmt::format("'{}' {} the world: frame {} ({:.4g} s) has it {:.3g} beyond the bounds",
                    body.name, left ? "leaves" : "is outside", frame.index, frame.time, by);
    return warning(scenario_, specs_.at(body.name)->where, message,
                   left ? "give [world] a larger size, or the body something that stops it; if it "
                          "is meant, [world] quiet = [\"outside\"]"
                        : "give it a position within the world, or [world] a larger size");
  }

  const Scenario& scenario_;
  std::unordered_map<std::string_view, const BodySpec*> specs_;
  std::vector<Was> was_;  // by id
  Diagnostics found_;
};

}  // namespace

Watching watch_view(const Scenario& scenario, std::function<bool(const Frame&)> shows_a_body) {
  if (!shows(scenario.panels, "world")) return nullptr;
  return std::make_unique<ViewWatch>(scenario, std::move(shows_a_body));
}

Watching watch_outside(const Scenario& scenario) {
  return std::make_unique<OutsideWatch>(scenario);
}

}  // namespace lantern::run
