// The parts of a RunWatch: one for each kind of warning.
#pragma once

#include <functional>
#include <memory>
#include <unordered_map>

#include "frame/frame.hpp"
#include "run/players.hpp"

namespace lantern::run {

class Watcher : public WorldWatch {
 public:
  virtual void begin(const Step&) {}
  virtual void see_frame(const Frame&) {}
  // After a world step.
  void see_world(const Players<2>&) override {}
  void see_world(const Players<3>&) override {}
  virtual std::vector<Diagnostic> warnings() const = 0;
  // What is told whether it is worth a warning or not; empty if there is nothing.
  virtual std::string fact() const { return {}; }
  virtual bool has_fact() const { return false; }
};

// Each gives nothing for a scenario that cannot show what it watches for.
using Watching = std::unique_ptr<Watcher>;
Watching watch_view(const Scenario& scenario, std::function<bool(const Frame&)> shows_a_body);
Watching watch_outside(const Scenario& scenario);
Watching watch_contacts(const Scenario& scenario);
Watching watch_joints(const Scenario& scenario);
Watching watch_energy(const Scenario& scenario);
Watching watch_through(const Scenario& scenario);
Watching watch_crush(const Scenario& scenario);

Diagnostic warning(const Scenario& scenario, const SourcePosition& where, std::string message,
                   std::string suggestion);

// The bodies of a scenario by their names. It must outlive the map.
std::unordered_map<std::string_view, const BodySpec*> bodies_by_name(const Scenario& scenario);

// "more sub_steps than 8, or a time_step below 0.0167 s": what makes joints and contacts firmer.
std::string firmer(const WorldSpec& world);
// Where those keys stand.
const SourcePosition& place_of_firmness(const WorldSpec& world);

}  // namespace lantern::run
