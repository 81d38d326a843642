#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/suggest.hpp"
#include "language/language.hpp"
#include "language/panel_rules.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {

template <class V>
bool some_step(const Draft& draft) {
  return std::ranges::any_of(draft.scenario.steps,
                             [](const Step& step) { return std::holds_alternative<V>(step.verb); });
}
template bool some_step<Compare>(const Draft&);
template bool some_step<DrawScreen>(const Draft&);
template bool some_step<See>(const Draft&);
template bool some_step<Separate>(const Draft&);

namespace {

// A structure of which this holds stands at some time.
bool some_structure(const Draft& draft, const auto& holds) {
  return std::ranges::any_of(draft.scenario.structures(), [&](const StructureSpec* one) {
    return one->kind != StructureKind::none && holds(traits_of(one->kind));
  });
}

bool compiles_level(const Draft& draft) {
  return draft.scenario.level && some_step<CompileLevel>(draft);
}

bool runs(const Draft& draft) { return draft.scenario.world_steps > 0; }

std::vector<PanelKind>& kinds() {
  static std::vector<PanelKind> all;
  return all;
}

}  // namespace

bool has_world(const Draft& draft) { return draft.has_world; }
bool has_bodies_or_level(const Draft& draft) {
  return !draft.scenario.bodies.empty() || draft.scenario.level;
}
bool has_two_flat_bodies(const Draft& draft) {
  return draft.scenario.bodies.size() > 1 && draft.dimension == 2;
}
bool has_structure(const Draft& draft) {
  return (compiles_level(draft) && !draft.scenario.bodies.empty()) ||
         some_structure(draft, [](const StructureTraits&) { return true; });
}
bool has_array(const Draft& draft) {
  return some_structure(draft, [](const StructureTraits& of) { return of.shares_array; });
}
bool has_pool(const Draft& draft) {
  return some_structure(draft, [](const StructureTraits& of) {
    return of.shares_array || of.is_plain || of.is_fitted;
  });
}
bool has_tree(const Draft& draft) {
  return has_structure(draft) || compiles_level(draft) || has_atlas(draft);
}
bool has_nodes(const Draft& draft) {
  return has_atlas(draft) || compiles_level(draft) ||
         some_structure(draft, [](const StructureTraits& of) { return of.is_tree; });
}
bool has_atlas(const Draft& draft) { return draft.scenario.atlas.has_value(); }
bool has_chart(const Draft& draft) { return draft.scenario.chart.has_value(); }
bool has_code(const Draft& draft) {
  return std::ranges::any_of(draft.scenario.steps,
                             [](const Step& step) { return step.code.has_value(); });
}
bool remembers_collisions(const Draft& draft) {
  return draft.scenario.world.contacts == ContactMethod::lecture;
}
bool runs_with_structure(const Draft& draft) { return runs(draft) && has_structure(draft); }
bool runs_with_what_holds(const Draft& draft) {
  return runs(draft) && (draft.scenario.has_contacts() || !draft.scenario.links.empty());
}
bool sees_in_level(const Draft& draft) { return draft.scenario.level && some_step<See>(draft); }

std::string example_of(std::string_view scenario) { return std::string(example(scenario)); }
std::string example_with(std::string_view scenario, std::string_view verb) {
  return fmt::format("{}\n{}", example(scenario), example_of_verb(verb));
}
std::string running_example() {
  return fmt::format("{}\n[[step]]\ndo = \"run\"\nseconds = 4\n", example("world"));
}

std::span<const PanelKind> panel_kinds() { return kinds(); }

const PanelKind& kind_of(Panel panel) { return kinds().at(static_cast<std::size_t>(panel)); }

Panel panel_named(std::string_view name) {
  const auto at = std::ranges::find(kinds(), name, &PanelKind::name) - kinds().begin();
  LANTERN_CHECK(at, <, std::ssize(kinds()));
  return static_cast<Panel>(at);
}

bool is(Panel panel, std::string_view name) { return kind_of(panel).name == name; }

bool shows(const std::vector<Panel>& panels, std::string_view name) {
  return std::ranges::any_of(panels, [&](Panel panel) { return is(panel, name); });
}

std::vector<Panel> derived_panels(std::span<const Draft* const> drafts) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < kinds().size(); ++i)
    if (const auto holds = kinds()[i].by_itself;
        holds && std::ranges::any_of(drafts, [&](const Draft* draft) { return holds(*draft); }))
      panels.push_back(static_cast<Panel>(i));
  std::ranges::sort(panels, {}, [](Panel panel) { return kind_of(panel).place; });
  return panels;
}

void add_panel(PanelKind kind) {
  require_own_name("panel", kind.name,
                   std::ranges::count(kinds(), kind.name, &PanelKind::name) > 0);
  kinds().push_back(std::move(kind));
}

std::vector<std::string_view> names(Panel) { return mapped(kinds(), &PanelKind::name); }

}  // namespace lantern::language
