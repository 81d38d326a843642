#include "run/warnings.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "run/watcher.hpp"

namespace lantern::run {

namespace {

bool contains(const std::vector<Diagnostic>& all, const Diagnostic& one) {
  return std::any_of(all.begin(), all.end(), [&](const Diagnostic& d) {
    return d.message == one.message && d.where.line == one.where.line &&
           d.where.column == one.where.column;
  });
}

}  // namespace

std::vector<Diagnostic> warnings_of_file(const Scenario& scenario) {
  static constexpr std::pair<Warning, const char*> kOthers[] = {
      {Warning::expect, "expectations cannot fail"},
      {Warning::settings, "settings change nothing"},
      {Warning::bodies, "names of bodies never enter the world"},
      {Warning::prototypes, "prototypes have nobody like them"},
      {Warning::letters, "letters stand nowhere in the map"},
      {Warning::links, "springs and joints are there twice"}};
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

RunWatch::RunWatch(const Scenario& scenario, std::function<bool(const Frame&)> shows_a_body) {
  for (const auto& side : scenario.sides)
    sides_.emplace_back(side->side, std::make_unique<RunWatch>(*side, shows_a_body));
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

RunWatch::~RunWatch() = default;

void RunWatch::begin(const Step& step) {
  for (const Watch& watch : watchers_) watch.watcher->begin(step);
}

void RunWatch::passed(const Engine& engine) {
  for (const Watch& watch : watchers_)
    if (watch.watcher->sees_worlds()) engine.show(*watch.watcher);
}

void RunWatch::see(const Frame& frame) {
  for (const Watch& watch : watchers_) watch.watcher->see_frame(frame);
}

std::vector<Diagnostic> RunWatch::warnings() const {
  std::vector<Diagnostic> all;
  for (const auto& [name, side] : sides_)
    for (Diagnostic& found : side->warnings()) {
      const auto has = [&](const auto& other) { return contains(other.second->warnings(), found); };
      if (std::all_of(sides_.begin(), sides_.end(), has)) {
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

}  // namespace lantern::run
