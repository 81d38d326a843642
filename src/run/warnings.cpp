#include "run/warnings.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "run/watcher.hpp"

namespace lantern::run {
namespace {

bool contains(const std::vector<Diagnostic>& all, const Diagnostic& one) {
  return std::ranges::any_of(all, [&](const Diagnostic& d) {
    return d.message == one.message && d.where.line == one.where.line &&
           d.where.column == one.where.column;
  });
}

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
    const auto thing = std::ranges::find_if(frame.bodies, is_thing);
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
  explicit OutsideWatch(const Scenario& scenario) : scenario_(scenario) {}

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
  std::unordered_map<std::string_view, const BodySpec*> specs_ = bodies_by_name(scenario_);
  std::vector<Was> was_;  // by id
  Diagnostics found_;
};

}  // namespace

std::vector<Diagnostic> warnings_of_file(const Scenario& scenario) {
  static constexpr std::pair<Warning, const char*> kOthers[] = {
      {Warning::expect, "expectations cannot fail"},
      {Warning::settings, "settings change nothing"},
      {Warning::bodies, "names of bodies never enter the world"},
      {Warning::prototypes, "prototypes have nobody like them"},
      {Warning::letters, "letters stand nowhere in the map"},
      {Warning::links, "springs and joints are there twice"},
      {Warning::paint, "paints stand out little"}};
  std::vector<Diagnostic> all;
  for (const auto& [kind, others] : kOthers) {
    Diagnostics found;
    for (const Noticed& one : scenario.noticed)
      if (one.kind == kind)
        found.add([&] { return warning(scenario, one.where, one.message, one.suggestion); });
    std::ranges::move(found.list(others), std::back_inserter(all));
  }
  return all;
}

RunWatch::RunWatch(const Scenario& scenario, std::function<bool(const Frame&)> shows_a_body,
                   WorldWatch* onlooker)
    : onlooker_(onlooker) {
  for (const auto& side : scenario.sides)
    sides_.emplace_back(side->side, std::make_unique<RunWatch>(*side, shows_a_body, onlooker));
  if (!sides_.empty()) return;
  const auto add = [&](Warning kind, Watching watcher) {
    const bool is_quiet = scenario.is_quiet(kind);
    if (watcher && (!is_quiet || watcher->has_fact()))
      watchers_.push_back({kind, std::move(watcher), is_quiet});
  };
  if (scenario.bodies.empty()) return;
  add(Warning::view, watch_view(scenario, std::move(shows_a_body)));
  add(Warning::outside, watch_outside(scenario));
  add(Warning::contacts, watch_contacts(scenario));
  add(Warning::joints, watch_joints(scenario));
  add(Warning::energy, watch_energy(scenario));
  add(Warning::through, watch_through(scenario));
  add(Warning::crush, watch_crush(scenario));
}

RunWatch::RunWatch(WorldWatch& onlooker) : onlooker_(&onlooker) {}
RunWatch::~RunWatch() = default;

void RunWatch::begin(const Step& step) {
  for (const Watch& watch : watchers_) watch.watcher->begin(step);
}

void RunWatch::passed(const Engine& engine) {
  for (const Watch& watch : watchers_) engine.show(*watch.watcher);
  if (onlooker_ != nullptr) engine.show(*onlooker_);
}

void RunWatch::see(const Frame& frame) {
  for (const Watch& watch : watchers_) watch.watcher->see_frame(frame);
}

std::vector<Diagnostic> RunWatch::warnings() const {
  std::vector<Diagnostic> all;
  for (const auto& [name, side] : sides_)
    for (Diagnostic& found : side->warnings()) {
      const auto has = [&](const auto& other) { return contains(other.second->warnings(), found); };
      if (std::ranges::all_of(sides_, has)) {
        if (&side != &sides_[0].second) continue;  // told already
      } else {
        found.message += fmt::format(", on the side '{}'", name);
      }
      all.push_back(std::move(found));
    }
  for (const Watch& watch : watchers_)
    if (!watch.quiet)
      for (Diagnostic& found : watch.watcher->warnings()) all.push_back(std::move(found));
  return all;
}

std::vector<std::string> RunWatch::facts() const {
  std::vector<std::string> all;
  for (const auto& [name, side] : sides_)
    for (const std::string& fact : side->facts()) all.push_back(fmt::format("{}: {}", name, fact));
  for (const Watch& watch : watchers_)
    if (std::string fact = watch.watcher->fact(); !fact.empty()) all.push_back(std::move(fact));
  return all;
}

std::vector<Warning> RunWatch::kinds() const {
  if (!sides_.empty()) return sides_[0].second->kinds();
  std::vector<Warning> kinds;
  for (const Watch& watch : watchers_)
    if (!watch.quiet) kinds.push_back(watch.kind);
  return kinds;
}

Diagnostic warning(const Scenario& scenario, const SourcePosition& where, std::string message,
                   std::string suggestion) {
  Diagnostic found = diagnose(scenario, where, std::move(message), std::move(suggestion));
  found.severity = Severity::warning;
  return found;
}

std::unordered_map<std::string_view, const BodySpec*> bodies_by_name(const Scenario& scenario) {
  std::unordered_map<std::string_view, const BodySpec*> found;
  for (const BodySpec& body : scenario.bodies) found.emplace(body.name, &body);
  return found;
}

std::string firmer(const WorldSpec& world) {
  const bool sweeps = world.contacts == ContactMethod::impulse;
  if (world.contacts == ContactMethod::lecture)
    return fmt::format("give [world] contacts = \"soft\", or a time_step below {:.3g} s",
                       world.time_step);
  return fmt::format("give [world] more {} than {}, or a time_step below {:.3g} s",
                     sweeps ? "iterations" : "sub_steps",
                     sweeps ? world.iterations : world.sub_steps, world.time_step);
}

const SourcePosition& place_of_firmness(const WorldSpec& world) {
  return world.contacts == ContactMethod::impulse ? world.place_of({"iterations", "time_step"})
                                                  : world.place_of({"sub_steps", "time_step"});
}

// Warnings of pictures in which there is nothing to see, and of bodies beyond the world's bounds.

Watching watch_view(const Scenario& scenario, std::function<bool(const Frame&)> shows_a_body) {
  if (!shows(scenario.panels, "world")) return nullptr;
  return std::make_unique<ViewWatch>(scenario, std::move(shows_a_body));
}

Watching watch_outside(const Scenario& scenario) {
  return std::make_unique<OutsideWatch>(scenario);
}

}  // namespace lantern::run
