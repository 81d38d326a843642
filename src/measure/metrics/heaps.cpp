// Bodies that stand and hang. No closed form tells where each of a heap lies; what must hold is
// known all the same: they neither sink into each other nor wander.

#include "measure/metrics/reading.hpp"

namespace lantern::measure {
namespace {

// --- bodies that should hang or stand still, each carrying all later ones ---

// Newton's second law gives the mean force that held the bodies i, i+1, ... up between two looks:
//
//   F_i = sum over j >= i of m_j (g + dv_j / dt)        exact: sum of m_j g
//
// so that forces are measured whoever moves the bodies.
class Burdens {
 public:
  Burdens(const Scenario& scenario, std::vector<std::size_t> bodies)
      : bodies_(std::move(bodies)), gravity_(glm::length(scenario.world.gravity)) {
    up_ = -scenario.world.gravity / gravity_;
    for (const std::size_t i : bodies_) {
      masses_.push_back(mass_of_body(scenario, i));
      speeds_.push_back(glm::dot(scenario.bodies[i].velocity, up_));
    }
  }

  // The error of the worst, as a share of the exact force, is met by `worst`.
  void look(const Observation& now, Worst& worst) {
    const double passed = now.time - time_;
    long double gained = 0, weight = 0;  // momentum and mass of all from the last body down to here
    for (std::size_t i = bodies_.size(); i-- > 0;) {
      const double speed = glm::dot(now.states[bodies_[i]].velocity, up_);
      gained += static_cast<long double>(masses_[i]) * (speed - speeds_[i]);
      weight += masses_[i];
      speeds_[i] = speed;
      if (passed > 0) worst.meet(static_cast<double>(gained / (weight * gravity_ * passed)));
    }
    time_ = now.time;
  }

 private:
  std::vector<std::size_t> bodies_;
  std::vector<double> masses_;
  Vec<3> up_{0.0};
  double gravity_ = 0;
  double time_ = 0;
  std::vector<double> speeds_;  // upwards, at the look before
};

std::vector<std::size_t> from_below(const Scenario& scenario, const Vec<3>& up) {
  std::vector<std::size_t> bodies = moving_bodies(scenario);
  std::ranges::stable_sort(
      bodies, {}, [&](std::size_t i) { return glm::dot(scenario.bodies[i].position, up); });
  return bodies;
}

// Boxes that lie one on the other and should go on to do so. The contact below each must carry it
// and all above: in a step of h seconds by the impulse h g (sum of their masses).
class Stack : public ErrorMetric {
 public:
  explicit Stack(const Scenario& scenario)
      : ground_(ground_of(scenario)),
        bodies_(from_below(scenario, ground_.normal)),
        burdens_(scenario, bodies_) {
    require_links(scenario, 0);
    pull_onto(scenario, ground_);
    require_on_ground(scenario, ground_, bodies_.front());
    const Vec<3>& foot = scenario.bodies[bodies_.front()].position;
    double face = ground_.height;
    for (const std::size_t i : bodies_) {
      const BodySpec& body = scenario.bodies[i];
      require_at_rest(scenario, i);
      const double reach = reach_along(body, ground_.normal);
      const double at = glm::dot(body.position, ground_.normal);
      if (std::abs(at - reach - face) > 1e-9 * (reach + std::abs(face)))
        refuse_problem(scenario, fmt::format("'{}' does not lie on the one below", body.name));
      const Vec<3> off = body.position - foot;
      if (glm::length(off - ground_.normal * glm::dot(off, ground_.normal)) > 1e-9 * reach)
        refuse_problem(scenario, fmt::format("'{}' does not lie in one line", body.name));
      face = at + reach;
      reaches_.push_back(reach);
    }
  }

  void look(const Observation& now) override {
    const bool begun = now.time > 0;  // before, skins overlap that no step could part
    double face = ground_.height + now.skin(ground_.body), place = ground_.height;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const double at = glm::dot(now.states[bodies_[i]].position, ground_.normal);
      const double reach = reaches_[i] + now.skin(bodies_[i]);
      if (begun) depth_.meet(face - (at - reach));
      face = at + reach;
      place += reaches_[i];
      if (!(at >= place - reaches_[i])) has_fallen_ = true;
      place += reaches_[i];
    }
    burdens_.look(now, impulse_);
  }

  std::optional<std::string> collapse() const override {
    if (!has_fallen_) return std::nullopt;
    return "a box lies half its height below its place";
  }

 private:
  Footing ground_;
  std::vector<std::size_t> bodies_;  // from below
  std::vector<double> reaches_;      // half heights
  Burdens burdens_;
  bool has_fallen_ = false;
  Worst& depth_ =
      norm("depth", "units",
           "largest error of the height between two neighbouring centres over the run, an "
           "overlap or a gap, an engine's skin taken for a part of the shape; it starts "
           "at 0, and tilts are not seen");
  Worst& impulse_ = norm("impulse", "1",
                         "largest error of a contact's mean impulse between two samples, relative");
};

bool are_nearly_parallel(const Vec<3>& a, const Vec<3>& b) {
  return glm::length(glm::cross(a, b)) <= 1e-9 * (glm::length(a) + 1) * glm::length(b);
}

// Joints in order from above, each turned so that `a` is its lower end.
std::vector<LinkSpec> from_above(const Scenario& scenario) {
  const auto is_fixed = [&](const std::optional<std::size_t>& body) {
    return !body || scenario.bodies[*body].kind == BodyKind::static_body;
  };
  if (scenario.world.gravity == Vec<3>(0.0)) refuse_problem(scenario, "there is no gravity");
  if (scenario.links.size() != moving_bodies(scenario).size())
    refuse_problem(scenario, "it needs one joint for each body");
  std::vector<LinkSpec> chain;
  std::vector<bool> used(scenario.links.size());
  std::optional<std::size_t> above;  // nothing: fixed
  while (chain.size() < used.size()) {
    const std::size_t before = chain.size();
    for (std::size_t i = 0; i < used.size() && chain.size() == before; ++i) {
      LinkSpec link = scenario.links[i];
      if (link.kind == LinkSpec::Kind::spring) refuse_problem(scenario, "it has a spring");
      const auto hangs_on = [&](const std::optional<std::size_t>& end) {
        return above ? end == above : is_fixed(end);
      };
      if (used[i] || (!hangs_on(link.b) && !(link.b && hangs_on(link.a)))) continue;
      if (!hangs_on(link.b)) {
        link.b = std::exchange(link.a, *link.b);
        std::swap(link.at_a, link.at_b);
      }
      used[i] = true;
      above = link.a;
      chain.push_back(link);
    }
    if (chain.size() == before || is_fixed(above))
      refuse_problem(scenario, "its joints are no chain that hangs from one fixed point");
  }
  return chain;
}

// A chain that hangs straight down from a fixed point. No link should grow, and the pull in each is
// the weight of all below it.
class HangingChain : public ErrorMetric {
 public:
  explicit HangingChain(const Scenario& scenario)
      : links_(from_above(scenario)), burdens_(scenario, bodies_) {
    const Vec<3>& g = scenario.world.gravity;
    for (const std::size_t i : moving_bodies(scenario)) require_at_rest(scenario, i);
    const std::vector<BodyState> states = first_states(scenario);
    for (const LinkSpec& link : links_) {
      const Vec<3> span = far_end(link, states) - lower(link, states);
      if (glm::dot(span, g) > 0 || !are_nearly_parallel(span, g))
        refuse_problem(scenario, "it does not hang straight down");
      const bool is_pin = link.kind == LinkSpec::Kind::pin;
      const double length = is_pin ? 0 : link.rest_length.value_or(glm::length(span));
      if (std::abs(length - glm::length(span)) > 1e-9 * (length + 1))
        refuse_problem(scenario, "a joint is not as long as it is at first");
      length_ += length;
    }
    for (const std::size_t i : bodies_) {
      const Vec<3> off = scenario.bodies[i].position - scenario.bodies[bodies_.front()].position;
      if (!are_nearly_parallel(off, g)) refuse_problem(scenario, "it does not hang straight down");
    }
  }

  void look(const Observation& now) override {
    double grown = -length_;
    for (const LinkSpec& link : links_)
      grown += glm::length(far_end(link, now.states) - lower(link, now.states));
    stretch_.meet(grown);
    burdens_.look(now, tension_);
  }

 private:
  Vec<3> lower(const LinkSpec& link, const std::vector<BodyState>& states) const {
    return point_of(states[link.a], link.at_a);
  }

  std::vector<LinkSpec> links_;  // from above
  std::vector<std::size_t> bodies_ = mapped(links_, &LinkSpec::a);
  Burdens burdens_;
  double length_ = 0;
  Worst& stretch_ =
      norm("stretch", "units",
           "largest change of the chain's length over the run; it starts at rest with "
           "its exact length, so 0 means undisturbed");
  Worst& tension_ = norm("tension", "1",
                         "largest error of the mean pull of a joint between two samples, relative");
};

// --- many bodies that come to rest, or should stay there ---

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
    gain_.set(energy_.gain());
    if (now.time < quiet_from_) return;
    if (quiet_.empty()) quiet_ = now.states;
    depth_.meet(kept.penetration);
    if (kept.overlapping > 0) mean_.meet(kept.penetrations / static_cast<double>(kept.overlapping));
    for (const std::size_t i : bodies_)
      creep_.meet(glm::length(now.states[i].position - quiet_[i].position));
  }

 protected:
  std::vector<std::size_t> bodies_;
  double size_;

 private:
  double quiet_from_;
  EnergyMeter energy_;
  std::vector<BodyState> quiet_;
  Worst& depth_ = norm("depth", "units", "deepest overlap of two bodies, once they lie");
  Worst& mean_ = norm("mean", "units", "largest mean overlap of those that overlap");
  Worst& creep_ = norm("creep", "units",
                       fmt::format("farthest that a body wanders after {:.3g} s", quiet_from_));
  Worst& gain_ = norm("gain", "1", EnergyMeter::kGainMeaning);
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
    for (const std::size_t i : bodies_) {
      const Vec<3>& at = now.states[i].position;
      out_ += at.x < container_->lo.x || at.x > container_->hi.x || at.y < container_->lo.y ||
              at.z < container_->lo.z || at.z > container_->hi.z;
    }
  }
  std::optional<std::string> collapse() const override {
    if (out_ == 0) return std::nullopt;
    return fmt::format("{} of {} bodies have left the container", out_, bodies_.size());
  }

 private:
  std::optional<Box<3>> container_;
  int out_ = 0;
};

// They begin at rest and should not move. What has come half its size away has fallen.
class Standing : public Heap {
 public:
  explicit Standing(const Scenario& scenario) : Heap(scenario, 0.5) {
    for (const std::size_t i : bodies_) {
      require_at_rest(scenario, i);
      starts_.push_back(scenario.bodies[i].position);
    }
  }

  void look(const Observation& now) override {
    Heap::look(now);
    for (std::size_t n = 0; n < starts_.size(); ++n)
      moved_.meet(glm::length(now.states[bodies_[n]].position - starts_[n]));
  }
  std::optional<std::string> collapse() const override {
    if (!(moved_.value() > size_)) return std::nullopt;
    return fmt::format("a body has moved by {:.2g} units", moved_.value());
  }

 private:
  std::vector<Vec<3>> starts_;
  Worst& moved_ = norm("moved", "units", "farthest that a body gets from its start");
};

}  // namespace

std::span<const Problem> heaps_problems() {
  static constexpr Problem kAll[] = {{Solution::stack, made_of<Stack>},
                                     {Solution::hanging_chain, made_of<HangingChain>},
                                     {Solution::pile, made_of<Contained>},
                                     {Solution::standing, made_of<Standing>}};
  return kAll;
}

}  // namespace lantern::measure
