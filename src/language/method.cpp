#include "language/method.hpp"

#include <charconv>

namespace lantern::language {
namespace {

// One of each name, but for the numbers.
std::vector<Method> made() {
  std::vector<Method> methods;
  const auto add = [&]<class E>(std::optional<E> Method::*member, E first) {
    const auto all = names(first);
    for (auto i = static_cast<std::size_t>(first); i < all.size(); ++i) {
      Method& method = methods.emplace_back();
      method.name = all[i];
      method.*member = static_cast<E>(i);
    }
  };
  add(&Method::integrator, Integrator());
  add(&Method::rotation, RotationMethod());
  add(&Method::contacts, ContactMethod::impulse);
  return methods;
}

const std::vector<Method>& known() {
  static const std::vector<Method> methods = made();
  return methods;
}

// "16": nothing if it is no such number.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<Method> method_named(std::string_view name) {
  const std::size_t colon = name.find(':');
  for (Method method : known()) {
    if (method.name != name.substr(0, colon)) continue;
    method.name = name;
    if (colon == std::string_view::npos) return method;
    const std::string_view number = name.substr(colon + 1);
    method.wanted_error = number_of<double>(number);
    if (method.contacts == ContactMethod::soft && method.wanted_error > 0.0 &&
        method.wanted_error < 1.0)
      return method;
    method.wanted_error.reset();
    method.effort = number_of<int>(number);
    const int most = method.contacts == ContactMethod::soft      ? 1000
                     : method.contacts == ContactMethod::impulse ? 100'000
                                                                 : 0;
    if (!method.effort || *method.effort < 1 || *method.effort > most) return std::nullopt;
    return method;
  }
  return std::nullopt;
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for (const Method& method : known()) names.push_back(method.name);
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
  if (method.contacts) world.wanted_error = method.wanted_error.value_or(0);
  if (method.effort)
    (world.contacts == ContactMethod::soft ? world.sub_steps : world.iterations) = *method.effort;
  return scenario;
}

}  // namespace lantern::language
