// Many bodies that come to rest, or should stay there. No closed form tells where each of them
// lies; what must hold is known all the same: they neither sink into each other nor wander.
#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "measure/energy_meter.hpp"
#include "measure/error_metrics.hpp"

namespace lantern::measure {
namespace {

// The least half width of all that moves.
double smallest_half(const Scenario& scenario, const std::vector<std::size_t>& bodies) {
  double least = reach_along(scenario.bodies[bodies.front()], Vec<3>(0, 1, 0));
  for (const std::size_t i : bodies)
    for (int axis = 0; axis < scenario.world.dimension; ++axis) {
      Vec<3> along(0.0);
      along[axis] = 1;
      least = std::min(least, reach_along(scenario.bodies[i], along));
    }
  return least;
}

// How deep they lie in each other and how far they wander in the last part of the run, which
// begins at a sample.
class Heap : public ErrorMetric {
 public:
  Heap(const Scenario& scenario, double quiet)
      : bodies_(moving_bodies(scenario)),
        size_(smallest_half(scenario, bodies_)),
        quiet_from_(quiet * scenario.problem->seconds * (1 - 1e-9)),
        energy_(scenario) {
    require_links(scenario, 0);
    if (glm::length(scenario.world.gravity) == 0) refuse_problem(scenario, "there is no gravity");
  }

  void look(const Observation& now) override {
    const Kept kept = energy_.look(now);
    if (now.time < quiet_from_) return;
    if (quiet_.empty()) quiet_ = now.states;
    depth_.meet(kept.penetration);
    mean_.meet(kept.mean_penetration);
    for (const std::size_t i : bodies_)
      creep_.meet(glm::length(now.states[i].position - quiet_[i].position));
  }

  std::vector<Norm> norms() const override {
    return {{"depth", depth_.value(), "units", "deepest overlap of two bodies, once they lie"},
            {"mean", mean_.value(), "units", "largest mean overlap of those that overlap"},
            {"creep", creep_.value(), "units",
             fmt::format("farthest that a body wanders after {:.3g} s", quiet_from_)},
            energy_.gain_norm()};
  }

 protected:
  const std::vector<std::size_t>& bodies() const { return bodies_; }
  double size() const { return size_; }

 private:
  std::vector<std::size_t> bodies_;
  double size_;
  double quiet_from_;
  EnergyMeter energy_;
  std::vector<BodyState> quiet_;
  Worst depth_, mean_, creep_;
};

// They fall into a container of static bodies, and none may get out of it.
class Contained : public Heap {
 public:
  explicit Contained(const Scenario& scenario) : Heap(scenario, 0.75) {
    for (const BodySpec& body : scenario.bodies) {
      if (body.kind != BodyKind::static_body) continue;
      if (std::holds_alternative<HalfSpace<3>>(body.shape))
        refuse_problem(scenario, "its container must be made of boxes");
      const Vec<3> reach(reach_along(body, {1, 0, 0}), reach_along(body, {0, 1, 0}),
                         reach_along(body, {0, 0, 1}));
      const Box<3> box{body.position - reach, body.position + reach};
      container_ = container_ ? united(*container_, box) : box;
    }
    if (!container_) refuse_problem(scenario, "it has no container");
  }

  void look(const Observation& now) override {
    Heap::look(now);
    out_ = 0;
    for (const std::size_t i : bodies()) {
      const Vec<3>& at = now.states[i].position;
      out_ += at.x < container_->lo.x || at.x > container_->hi.x || at.y < container_->lo.y ||
              at.z < container_->lo.z || at.z > container_->hi.z;
    }
  }
  std::optional<std::string> collapse() const override {
    if (out_ == 0) return std::nullopt;
    return fmt::format("{} of {} bodies have left the container", out_, bodies().size());
  }

 private:
  std::optional<Box<3>> container_;
  int out_ = 0;
};

// They begin at rest and should not move. What has come half its size away has fallen.
class Standing : public Heap {
 public:
  explicit Standing(const Scenario& scenario) : Heap(scenario, 0.5) {
    for (const std::size_t i : bodies()) {
      require_at_rest(scenario, i);
      starts_.push_back(scenario.bodies[i].position);
    }
  }

  void look(const Observation& now) override {
    Heap::look(now);
    for (std::size_t n = 0; n < starts_.size(); ++n)
      moved_.meet(glm::length(now.states[bodies()[n]].position - starts_[n]));
  }
  std::vector<Norm> norms() const override {
    std::vector<Norm> all = Heap::norms();
    all.push_back({"moved", moved_.value(), "units", "farthest that a body gets from its start"});
    return all;
  }
  std::optional<std::string> collapse() const override {
    if (!(moved_.value() > size())) return std::nullopt;
    return fmt::format("a body has moved by {:.2g} units", moved_.value());
  }

 private:
  std::vector<Vec<3>> starts_;
  Worst moved_;
};

}  // namespace

OwnMetric pile_metric(const Scenario& s) { return std::make_unique<Contained>(s); }
OwnMetric standing_metric(const Scenario& s) { return std::make_unique<Standing>(s); }

}  // namespace lantern::measure
