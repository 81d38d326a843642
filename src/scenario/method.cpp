#include "scenario/method.hpp"

#include <charconv>

namespace lantern {
namespace {

struct Known {
  explicit Known(std::string_view called) : name(called) {}
  std::string_view name;
  Method method;
};

const std::vector<Known>& known() {
  static const std::vector<Known> table = [] {
    std::vector<Known> t;
    for (int i = 0; i < 6; ++i) {
      const auto integrator = static_cast<Integrator>(i);
      t.emplace_back(to_string(integrator)).method.integrator = integrator;
    }
    for (int i = 0; i < 3; ++i) {
      const auto rotation = static_cast<RotationMethod>(i);
      t.emplace_back(to_string(rotation)).method.rotation = rotation;
    }
    for (const std::string_view name : contact_method_names())
      if (const auto contacts = *contact_method_named(name); contacts != ContactMethod::none)
        t.emplace_back(name).method.contacts = contacts;
    return t;
  }();
  return table;
}

// "16": nothing if it is no number from 1 on.
std::optional<int> effort_of(std::string_view text) {
  int effort = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), effort);
  if (error != std::errc() || end != text.data() + text.size() || effort < 1) return std::nullopt;
  return effort;
}

}  // namespace

std::optional<Method> method_named(std::string_view name) {
  const std::size_t colon = name.find(':');
  for (const Known& k : known()) {
    if (k.name != name.substr(0, colon)) continue;
    Method method = k.method;
    method.name = name;
    if (colon == std::string_view::npos) return method;
    method.effort = effort_of(name.substr(colon + 1));
    const int most = method.contacts == ContactMethod::soft      ? 1000
                     : method.contacts == ContactMethod::impulse ? 100'000
                                                                 : 0;
    if (!method.effort || *method.effort > most) return std::nullopt;
    return method;
  }
  return std::nullopt;
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const Known& k : known()) names.push_back(k.name);
  return names;
}

Scenario moved_by(Scenario scenario, const Method& method, double h) {
  WorldSpec& world = scenario.world;
  world.time_step = h;
  if (method.integrator) world.integrator = *method.integrator;
  if (method.rotation) world.rotation = *method.rotation;
  if (method.contacts) world.contacts = *method.contacts;
  for (BodySpec& body : scenario.bodies) {
    if (method.integrator) body.integrator.reset();
    if (method.rotation) body.rotation.reset();
  }
  if (method.contacts)
    for (Step& step : scenario.steps)
      if (std::holds_alternative<SolveBy>(step.verb)) step.verb = Show{};
  if (method.effort)
    (world.contacts == ContactMethod::soft ? world.sub_steps : world.iterations) = *method.effort;
  return scenario;
}

}  // namespace lantern
