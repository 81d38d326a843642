#include "measure/stress.hpp"

#include <iterator>

#include "embedded/stress_scenarios.hpp"
#include "measure/stress_scene.hpp"
#include "run/director.hpp"

namespace lantern::measure {
namespace {

// All that the scenario expects must hold.
StressResult as_expected(const Scenario& scenario) {
  Work work;
  const DirectorReport report =
      direct(scenario, Pace::step, work, [](const Frame&) { return true; });
  std::string detail = fmt::format("do not hold, of {}", report.expectations);
  if (!report.unmet.empty()) detail += "; first: " + report.unmet.told().front().message;
  return at_most(0, static_cast<double>(report.unmet.count()), "expectations", std::move(detail));
}

// The files of scenarios/stress/: what must happen is the scenario's idea, its source the group.
std::vector<StressCase> scenario_cases() {
  static std::vector<Scenario> scenarios;
  for (const auto& [name, text] : stress_scenario::files())
    scenarios.push_back(parse_scenario(text, fmt::format("scenarios/stress/{}.toml", name)));
  return mapped(scenarios, [](const Scenario& one) {
    return StressCase{one.name, one.source, one.idea, [&one] { return as_expected(one); }};
  });
}

using namespace stress;

// A world with a pile, and what it did with the bad values that it was given.
template <int D>
class Guard {
 public:
  Guard() : world_(with_gravity<D>()) {
    world_.add(make_floor<D>());
    world_.add(make_box<D>(at<D>(0, 0.5)));
    world_.add(make_box<D>(at<D>(0, 1.5)));
    run(world_, 0.1);
  }

  // The action must be refused with both words in its message, and leave the hash as it was.
  void expect(const std::string& who, const std::string& field, auto&& action) {
    const std::uint64_t before = world_.hash();
    const auto why = refusal([&] { action(world_); });
    ++tried;
    const bool named =
        why && why->find(who) != std::string::npos && why->find(field) != std::string::npos;
    if (named && world_.hash() == before) return;
    ++wrong;
    if (first.empty()) first = fmt::format("; first: {} {}", who, field);
  }

  // A body with one field spoilt, by each of the bad values.
  void expect_body(const char* field, std::initializer_list<double> bad, auto&& spoil) {
    for (const double value : bad) {
      Body<D> body = make_box<D>(at<D>(5, 5));
      body.name = "ghost";
      spoil(body, value);
      expect("'ghost'", field, [&](World<D>& world) { world.add(body); });
    }
  }

  int tried = 0, wrong = 0;
  std::string first;

 private:
  World<D> world_;
};

// The case for what `try_all(guard)` gives to worlds of both dimensions.
StressResult refused_case(auto&& try_all) {
  Guard<2> flat;
  Guard<3> solid;
  try_all(flat, std::integral_constant<int, 2>());
  try_all(solid, std::integral_constant<int, 3>());
  return at_most(0, flat.wrong + solid.wrong, "values",
                 fmt::format("of {} not refused by name, or the world changed{}{}",
                             flat.tried + solid.tried, flat.first, solid.first));
}

StressResult bad_sizes() {
  return refused_case([]<int D>(Guard<D>& guard, std::integral_constant<int, D>) {
    const auto bad = {-1.0, -1e-300, kNan, kInfinity, -kInfinity};
    guard.expect_body("radius", bad, [](Body<D>& b, double v) { b.shape = Sphere{v}; });
    guard.expect_body("radius", bad, [](Body<D>& b, double v) { b.shape = Capsule{v, 1}; });
    guard.expect_body("half_length", bad, [](Body<D>& b, double v) { b.shape = Capsule{1, v}; });
    for (int i = 0; i < D; ++i) {
      const auto half = [i](double v) {
        Vec<D> size(1.0);
        size[i] = v;
        return size;
      };
      guard.expect_body("half_size", bad,
                        [&](Body<D>& b, double v) { b.shape = AxisBox<D>{half(v)}; });
      guard.expect_body("half_size", bad,
                        [&](Body<D>& b, double v) { b.shape = OrientedBox<D>{half(v)}; });
      guard.expect_body("normal", {0.0, 2.0, kNan, kInfinity}, [i](Body<D>& b, double v) {
        HalfSpace<D> space;
        space.normal[i] = v;
        b.shape = space;
        b.kind = BodyKind::static_body;
      });
    }
  });
}

StressResult bad_masses() {
  return refused_case([]<int D>(Guard<D>& guard, std::integral_constant<int, D>) {
    const auto bad = {-1.0, -1e-300, kNan, kInfinity};
    guard.expect_body("mass", bad, [](Body<D>& b, double v) { b.mass = v; });
    guard.expect_body("density", bad, [](Body<D>& b, double v) { b.density = v; });
    guard.expect_body("restitution", bad, [](Body<D>& b, double v) { b.material.restitution = v; });
    guard.expect_body("friction", bad, [](Body<D>& b, double v) { b.material.friction = v; });
    guard.expect_body("linear_drag", bad, [](Body<D>& b, double v) { b.linear_drag = v; });
    guard.expect_body("angular_drag", bad, [](Body<D>& b, double v) { b.angular_drag = v; });
    guard.expect_body("mass", {0.0}, [](Body<D>& b, double v) { b.shape = Sphere{v}; });
  });
}

StressResult bad_states() {
  return refused_case([]<int D>(Guard<D>& guard, std::integral_constant<int, D>) {
    const auto bad = {kNan, kInfinity, -kInfinity};
    for (int i = 0; i < D; ++i) {
      guard.expect_body("position", bad, [i](Body<D>& b, double v) { b.position[i] = v; });
      guard.expect_body("velocity", bad, [i](Body<D>& b, double v) { b.velocity[i] = v; });
    }
    guard.expect_body("orientation", bad, [](Body<D>& b, double v) {
      if constexpr (D == 2)
        b.orientation.angle = v;
      else
        b.orientation.q.x = v;
    });
    guard.expect_body("angular_momentum", bad,
                      [](Body<D>& b, double v) { b.angular_momentum = Spin<D>(v); });
  });
}

// What a script may do to body 1 of the world: every number of every verb.
StressResult bad_scripts() {
  return refused_case([]<int D>(Guard<D>& guard, std::integral_constant<int, D>) {
    const Vec<D> none(0.0);
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
      for (int i = 0; i < D; ++i) {
        Vec<D> v(0.0);
        v[i] = bad;
        guard.expect("", "velocity", [&](World<D>& w) { w.set_velocity(1, v); });
        guard.expect("", "impulse", [&](World<D>& w) { w.apply_impulse(1, v, none); });
        guard.expect("", "impulse", [&](World<D>& w) { w.apply_impulse(1, none, v); });
        guard.expect("", "force", [&](World<D>& w) { w.push(1, v, none); });
        guard.expect("", "force", [&](World<D>& w) { w.push(1, none, v); });
        guard.expect("", "position", [&](World<D>& w) { w.place(1, v, none); });
        guard.expect("", "velocity", [&](World<D>& w) { w.place(1, none, v); });
        guard.expect("", "gravity", [&](World<D>& w) { w.set_gravity(v); });
      }
      guard.expect("", "velocity", [&](World<D>& w) { w.set_angular_velocity(1, Spin<D>(bad)); });
      guard.expect("", "seconds", [&](World<D>& w) { w.push(1, none, none, bad); });
    }
    for (const double bad : {-1.0, 0.0})
      guard.expect("", "seconds", [&](World<D>& w) { w.push(1, none, none, bad); });
    guard.expect("no body 7", "", [&](World<D>& w) { w.set_velocity(7, none); });
    guard.expect("no body 7", "", [&](World<D>& w) { w.push(7, none, none); });
    guard.expect("no body 7", "", [&](World<D>& w) { w.place(7, none, none); });
  });
}

StressResult bad_links() {
  return refused_case([]<int D>(Guard<D>& guard, std::integral_constant<int, D>) {
    const auto spring = [&](const char* field, auto&& spoil) {
      Spring<D> s{.a = 1, .b = 2};
      spoil(s);
      guard.expect("", field, [&](World<D>& w) { w.add_spring(s); });
    };
    const auto joint = [&](const char* field, auto&& spoil) {
      Joint<D> j{.kind = JointKind::distance, .a = 1, .b = 2, .length = 1};
      spoil(j);
      guard.expect("", field, [&](World<D>& w) { w.add_joint(j); });
    };
    for (const double bad : {-1.0, kNan, kInfinity}) {
      spring("stiffness", [&](Spring<D>& s) { s.stiffness = bad; });
      spring("damping", [&](Spring<D>& s) { s.damping = bad; });
      spring("rest_length", [&](Spring<D>& s) { s.rest_length = bad; });
      joint("length", [&](Joint<D>& j) { j.length = bad; });
      if (bad == -1) continue;
      spring("at_a", [&](Spring<D>& s) { s.at_a.y = bad; });
      spring("at_b", [&](Spring<D>& s) { s.at_b.x = bad; });
      joint("at_a", [&](Joint<D>& j) { j.at_a.y = bad; });
      joint("at_b", [&](Joint<D>& j) { j.at_b.x = bad; });
    }
    joint("length", [](Joint<D>& j) { j.length = 0; });
    spring("7", [](Spring<D>& s) { s.b = 7; });
    joint("7", [](Joint<D>& j) { j.b = 7; });
    joint("itself", [](Joint<D>& j) { j.b = 1; });
  });
}

StressResult bad_configs() {
  int tried = 0, taken = 0;
  const auto expect = [&]<int D>(std::integral_constant<int, D>, auto&& spoil) {
    WorldConfig<D> config;
    spoil(config);
    ++tried;
    taken += !refusal([&] { World<D>{config}; });
  };
  const auto both = [&](auto&& spoil) {
    expect(std::integral_constant<int, 2>(), spoil);
    expect(std::integral_constant<int, 3>(), spoil);
  };
  for (const int bad : {0, -1, 1 << 30}) {
    both([&](auto& c) { c.sub_steps = bad; });
    both([&](auto& c) { c.iterations = bad; });
  }
  both([](auto& c) { c.impact_budget = -1; });
  both([](auto& c) { c.broad_phase.capacity = 0; });
  both([](auto& c) { c.broad_phase.max_depth = 1000; });
  for (const double bad : {-1.0, kNan, kInfinity}) {
    both([&](auto& c) { c.sleep_after = bad; });
    both([&](auto& c) { c.sleep_speed = bad; });
    both([&](auto& c) { c.sleep_spin = bad; });
    both([&](auto& c) { c.broad_phase.bounds.hi.x = bad * 1e9; });
    if (bad != -1) both([&](auto& c) { c.gravity.y = bad; });
  }
  return at_most(0, taken, "worlds", fmt::format("made, of {} with a bad setting", tried));
}

}  // namespace

StressResult at_most(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, false, figure <= bound, std::move(detail)};
}

StressResult at_least(double bound, double figure, std::string unit, std::string detail) {
  return {figure, std::move(unit), bound, true, figure >= bound, std::move(detail)};
}

std::span<const StressCase> stress_cases() {
  static const std::vector<StressCase> cases = [] {
    std::vector<StressCase> all;
    for (StressTopic* const topic :
         {tree_cases, input_cases, shape_cases, origin_cases, step_cases, contact_cases,
          stiff_cases, stability_cases, energy_cases, law_cases, scenario_cases})
      std::ranges::copy(topic(), std::back_inserter(all));
    return all;
  }();
  return cases;
}

StressOutcome run_case(const StressCase& stress_case) {
  StressOutcome outcome{stress_case, {}};
  try {
    outcome.result = stress_case.run();
  } catch (const Stopped&) {
    throw;
  } catch (const std::exception& error) {
    outcome.result.detail = error.what();
  }
  return outcome;
}

// Bad values, field by field: each is refused where it enters, by name, and changes nothing.

std::vector<StressCase> input_cases() {
  constexpr const char* kGroup = "extreme input";
  return {
      {"bad_sizes", kGroup, "A size that is negative or no number is refused by name.", bad_sizes},
      {"bad_masses", kGroup,
       "A mass, density, drag or material that is negative or no number is refused by name.",
       bad_masses},
      {"bad_states", kGroup, "A pose, velocity or momentum that is no number is refused by name.",
       bad_states},
      {"bad_scripts", kGroup, "What a script tells a body is refused by name if it is no number.",
       bad_scripts},
      {"bad_links", kGroup, "A bad number of a spring or joint is refused by name.", bad_links},
      {"bad_configs", kGroup, "A world with a setting out of its range is not made.", bad_configs}};
}

}  // namespace lantern::measure
