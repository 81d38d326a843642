// A warning of joints whose ends part.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.hpp"
#include "physics/joint.hpp"
#include "run/watcher.hpp"

namespace lantern::run {
namespace {

constexpr double kMostGap = 0.01;  // of the smaller body's length

// From end to end, in the direction in which it is longest.
double length_of(const Shape<3>& shape) {
  return std::visit(
      [](const auto& s) {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, Sphere>)
          return 2 * s.radius;
        else if constexpr (std::is_same_v<S, Capsule>)
          return 2 * (s.radius + s.half_length);
        else if constexpr (std::is_same_v<S, HalfSpace<3>>)
          return 0.0;
        else
          return 2 * std::max({s.half_size.x, s.half_size.y, s.half_size.z});
      },
      shape);
}

class JointWatch : public Watcher {
 public:
  explicit JointWatch(const Scenario& scenario)
      : scenario_(scenario), worst_(scenario.links.size()) {
    for (const LinkSpec& link : scenario.links) {
      const double a = length_of(scenario.bodies[link.a].shape);
      const double b = link.b ? length_of(scenario.bodies[*link.b].shape) : 0;
      lengths_.push_back(a > 0 && b > 0 ? std::min(a, b) : std::max(a, b));
    }
  }

  bool sees_worlds() const override { return true; }
  void see_world(const Players<2>& players) override { look(players); }
  void see_world(const Players<3>& players) override { look(players); }

  // Those that part the most come first.
  std::vector<Diagnostic> warnings() const override {
    std::vector<std::size_t> parted;
    for (std::size_t i = 0; i < worst_.size(); ++i)
      if (worst_[i].share > kMostGap) parted.push_back(i);
    std::stable_sort(parted.begin(), parted.end(), [&](std::size_t i, std::size_t j) {
      return worst_[i].share > worst_[j].share;
    });
    Diagnostics found;
    for (const std::size_t i : parted) found.add([&] { return parting(i); });
    return found.list("joints part");
  }

  bool has_fact() const override { return true; }
  std::string fact() const override {
    const auto widest = std::max_element(
        worst_.begin(), worst_.end(), [](const Gap& x, const Gap& y) { return x.size < y.size; });
    std::string told = fmt::format("joints parted by at most {:.2g}", widest->size);
    if (widest->size > 0)
      told += fmt::format(", {} at {:.4g} s",
                          named(scenario_.links[static_cast<std::size_t>(widest - worst_.begin())]),
                          widest->time);
    return told;
  }

 private:
  struct Gap {
    double size = 0;
    double share = 0;  // of the bodies' length
    double time = 0;
  };

  template <int D>
  void look(const Players<D>& players) {
    players.for_each_link(
        [&](const LinkSpec& link, const Vec<D>& from, const Vec<D>& to, double rest) {
          if (link.kind == LinkSpec::Kind::spring) return;
          const bool pin = link.kind == LinkSpec::Kind::pin;
          const double gap = physics::joint_gap<D>(
              pin ? physics::JointKind::pin : physics::JointKind::distance, rest, from, to);
          const auto i = static_cast<std::size_t>(&link - scenario_.links.data());
          LANTERN_CHECK(i, <, worst_.size());
          if (!(gap > worst_[i].size)) return;
          const double length = lengths_[i] > 0 ? lengths_[i] : rest;
          worst_[i] = {gap, length > 0 ? gap / length : 0, players.world().time()};
        });
  }

  // "the pin from 'a' to 'b'"
  std::string named(const LinkSpec& link) const {
    const std::string& a = scenario_.bodies[link.a].name;
    const char* kind = link.kind == LinkSpec::Kind::pin ? "pin" : "rod";
    return link.b ? fmt::format("the {} from '{}' to '{}'", kind, a, scenario_.bodies[*link.b].name)
                  : fmt::format("the {} of '{}'", kind, a);
  }

  Diagnostic parting(std::size_t i) const {
    const LinkSpec& link = scenario_.links[i];
    return warning(
        scenario_, link.where,
        fmt::format("{} {} by {:.3g} at {:.4g} s, {:.3g} % of its bodies' size", named(link),
                    link.kind == LinkSpec::Kind::pin ? "parts" : "stretches", worst_[i].size,
                    worst_[i].time, 100 * worst_[i].share),
        firmer(scenario_.world));
  }

  const Scenario& scenario_;
  std::vector<double> lengths_;  // of the smaller body of each link
  std::vector<Gap> worst_;       // of each link
};

}  // namespace

Watching watch_joints(const Scenario& scenario) {
  return scenario.has_joints() ? std::make_unique<JointWatch>(scenario) : nullptr;
}

}  // namespace lantern::run
