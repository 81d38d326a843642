// A warning of bodies that are crushed between others.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "run/watcher.hpp"

namespace lantern::run {
namespace {

class CrushWatch : public Watcher {
 public:
  explicit CrushWatch(const Scenario& scenario) : scenario_(scenario) {}

  bool sees_worlds() const override { return true; }
  void see_world(const Players<2>& players) override { look(players.world()); }
  void see_world(const Players<3>& players) override { look(players.world()); }

  std::vector<Diagnostic> warnings() const override {
    return found_.list("pairs of bodies crush one of them");
  }

 private:
  template <int D>
  void look(const World<D>& world) {
    for (const ContactEvent& event : world.events())
      if (event.crushes && told_.insert({event.a, event.b}).second)
        found_.add([&] { return crushed(world, {event.a, event.b}); });
  }

  template <int D>
  Diagnostic crushed(const World<D>& world, const Pair& pair) const {
    const auto contact = std::ranges::lower_bound(world.contacts(), pair, {}, &Contact<D>::pair);
    double depth = 0;
    for (const ManifoldPoint<D>& p : contact->manifold.points())
      depth = std::max(depth, -p.separation);
    return warning(
        scenario_, place_of_firmness(scenario_.world),
        fmt::format("'{}' and '{}' are pressed {:.3g} into each other at {:.4g} s: one "
                    "of them is crushed against a third",
                    world.find(pair.a)->name, world.find(pair.b)->name, depth, world.time()),
        "let what pushes it stop, or " + firmer(scenario_.world) +
            if_meant(scenario_, Warning::crush));
  }

  const Scenario& scenario_;
  std::set<Pair> told_;
  Diagnostics found_;
};

}  // namespace

Watching watch_crush(const Scenario& scenario) {
  if (!scenario.has_contacts() || scenario.bodies.size() < 3) return nullptr;
  return std::make_unique<CrushWatch>(scenario);
}

}  // namespace lantern::run
