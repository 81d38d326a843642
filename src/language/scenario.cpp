#include "language/scenario.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "language/keys/key.hpp"

namespace lantern::language {
namespace {

// Every index that the spec holds.
class Indices {
 public:
  explicit Indices(const ScenarioSpec& spec) : spec_(spec) {}

  void check() const {
    for (const BodySpec& b : spec_.bodies)
      if (b.brain == Brain::follow) body(b.follows);
    for (const LinkSpec& link : spec_.links) {
      body(link.a);
      if (link.b) body(*link.b);
    }
    for (const BodyMeasureSpec& measure : spec_.body_measures) body(measure.body);
    for (const Step& step : spec_.steps)
      std::visit([&](const auto& verb) { see(verb); }, step.verb);
  }

 private:
  void body(std::size_t i) const { LANTERN_CHECK(i, <, spec_.bodies.size()); }

  // Verbs name bodies, one body, textures, or none.
  void see(const auto& verb) const {
    if constexpr (requires { verb.bodies; })
      for (const std::size_t i : verb.bodies) body(i);
    if constexpr (requires { verb.body; }) body(verb.body);
    if constexpr (requires { verb.textures; })
      for (const std::size_t i : verb.textures) LANTERN_CHECK(i, <, spec_.textures.size());
    if constexpr (std::is_same_v<std::decay_t<decltype(verb)>, Wait>)
      if (verb.event != Wait::Event::asleep) LANTERN_CHECK(verb.bodies.size(), ==, std::size_t{2});
  }

  const ScenarioSpec& spec_;
};

}  // namespace

bool ScenarioSpec::is_quiet(Warning kind) const {
  const std::vector<Warning>& quiet = atlas ? atlas->quiet : world.quiet;
  return std::ranges::find(quiet, kind) != quiet.end();
}

bool ScenarioSpec::has_forces() const {
  return world.gravity != Vec<3>(0.0) || world.gravitation > 0 || !links.empty();
}

bool ScenarioSpec::has_joints() const {
  return std::any_of(links.begin(), links.end(),
                     [](const LinkSpec& link) { return link.kind != LinkSpec::Kind::spring; });
}

bool ScenarioSpec::tells_sleepers() const {
  return has_contacts() || world.may_sleep || structure.split_static;
}

bool ScenarioSpec::has_body_of(BodyKind kind) const {
  return std::ranges::find(bodies, kind, &BodySpec::kind) != bodies.end();
}

bool ScenarioSpec::shows_trails() const {
  return display.trail > 0 || std::ranges::any_of(steps, [](const Step& step) {
           return step.display && step.display->trail > 0;
         });
}

std::vector<const StructureSpec*> ScenarioSpec::structures() const {
  std::vector<const StructureSpec*> all = {&structure};
  for (const Step& step : steps)
    if (const auto* rebuild = std::get_if<Rebuild>(&step.verb)) all.push_back(&rebuild->structure);
  return all;
}

Scenario::Scenario(ScenarioSpec spec) : ScenarioSpec(std::move(spec)) { Indices(*this).check(); }

std::optional<ScenarioName> ScenarioName::of(std::string_view text) {
  return matches(text, kFilePattern) ? std::optional(ScenarioName(text)) : std::nullopt;
}

ScenarioName name_of(const Scenario& scenario) {
  const auto name = ScenarioName::of(scenario.name);
  LANTERN_CHECK(name ? scenario.name : "a scenario's name", ==, scenario.name);
  return *name;
}

}  // namespace lantern::language
