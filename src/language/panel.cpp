#include <utility>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/suggest.hpp"
#include "language/language.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

// A verb of this kind is somewhere in the script.
template <class V>
bool some_step(const Draft& draft) {
  return std::ranges::any_of(draft.scenario.steps,
                             [](const Step& step) { return std::holds_alternative<V>(step.verb); });
}

// A structure of which this holds stands at some time.
template <class F>
bool some_structure(const Draft& draft, const F& holds) {
  return std::ranges::any_of(draft.scenario.structures(),
                             [&](const StructureSpec* one) { return holds(*one); });
}

template <bool StructureTraits::*trait>
bool some_structure_has(const Draft& draft) {
  return some_structure(draft, [](const StructureSpec& of) {
    return of.kind != StructureKind::none && traits_of(of.kind).*trait;
  });
}

bool compiles_level(const Draft& draft) {
  return draft.scenario.level && some_step<CompileLevel>(draft);
}

bool has_structure(const Draft& draft) {
  return (compiles_level(draft) && !draft.scenario.bodies.empty()) ||
         some_structure(draft,
                        [](const StructureSpec& s) { return s.kind != StructureKind::none; });
}

bool has_array(const Draft& draft) {
  return some_structure_has<&StructureTraits::shares_array>(draft);
}

bool has_pool(const Draft& draft) {
  return has_array(draft) || some_structure_has<&StructureTraits::is_plain>(draft) ||
         some_structure_has<&StructureTraits::is_fitted>(draft);
}

bool has_atlas(const Draft& draft) { return draft.scenario.atlas.has_value(); }
bool has_chart(const Draft& draft) { return draft.scenario.chart.has_value(); }
bool runs(const Draft& draft) { return draft.scenario.world_steps > 0; }

// A scenario, with the example of a verb behind it.
std::string with_verb(std::string_view scenario, std::string_view verb) {
  return fmt::format("{}\n{}", example(scenario), example_of_verb(verb));
}

std::string running_example() {
  return fmt::format("{}\n[[step]]\ndo = \"run\"\nseconds = 4\n", example("world"));
}

std::vector<PanelKind>& kinds() {
  static std::vector<PanelKind> all = {
      {.name = "world",
       .needs = "it needs a [world]",
       .possible = [](const Draft& d) { return d.has_world; },
       .place = 1,
       .by_itself = [](const Draft& d) { return !d.scenario.bodies.empty() || d.scenario.level; }},
      {.name = "tree",
       .needs = "it needs a [structure], a [level] or an [atlas]",
       .possible =
           [](const Draft& d) { return has_structure(d) || compiles_level(d) || has_atlas(d); },
       .place = 4,
       .by_itself =
           [](const Draft& d) {
             return has_atlas(d) || compiles_level(d) ||
                    some_structure_has<&StructureTraits::is_tree>(d);
           }},
      {.name = "atlas",
       .needs = "it needs an [atlas]",
       .possible = has_atlas,
       .place = 3,
       .by_itself = has_atlas,
       .example = [] { return with_verb("atlas", "pack"); }},
      {.name = "chart",
       .needs = "it needs a [chart]",
       .possible = has_chart,
       .place = 5,
       .by_itself = has_chart,
       .of_all_sides = true,
       .example = [] { return std::string(example("chart")); }},
      {.name = "memory", .needs = "it needs a [structure]", .possible = has_structure},
      {.name = "ledger",
       .needs = "it needs a [structure], whose pairs it shows",
       .possible = has_structure},
      {.name = "pool",
       .needs = "it needs a quadtree, an octree or a kd_tree, whose nodes lie in a pool",
       .possible = has_pool},
      {.name = "bytes",
       .needs = "it needs a quadtree or an octree, whose nodes have their bytes counted",
       .possible = has_array},
      {.name = "sparkline",
       .needs = "it needs a [structure] and a step that runs",
       .possible = [](const Draft& d) { return runs(d) && has_structure(d); },
       .example = running_example},
      {.name = "difference",
       .needs = "it needs a flat world and two bodies",
       .possible = [](const Draft& d) { return d.scenario.bodies.size() > 1 && d.dimension == 2; }},
      {.name = "axes",
       .needs = "it needs a `separate`",
       .possible = some_step<Separate>,
       .example = [] { return with_verb("world", "separate"); }},
      {.name = "comparison",
       .needs = "it needs a step with do = \"compare\"",
       .possible = some_step<Compare>,
       .place = 6,
       .by_itself = some_step<Compare>,
       .example = [] { return with_verb("world", "compare"); }},
      {.name = "islands",
       .needs =
           "it needs a step that runs, and contacts, springs or joints that hold bodies together",
       .possible =
           [](const Draft& d) {
             return runs(d) && (d.scenario.has_contacts() || !d.scenario.links.empty());
           },
       .example = running_example},
      {.name = "code",
       .needs = "it needs a step with 'code'",
       .possible =
           [](const Draft& d) {
             return std::ranges::any_of(d.scenario.steps,
                                        [](const Step& step) { return step.code.has_value(); });
           },
       .example =
           [] {
             return fmt::format(
                 "{}\n[[step]]\ndo = \"show\"\n"
                 "code = {{ function = \"Insert\", line = \"Split();\" }}\n",
                 example("world"));
           }},
      {.name = "collisions",
       .needs = "it needs [world] contacts = \"lecture\", which remembers them",
       .possible =
           [](const Draft& d) { return d.scenario.world.contacts == ContactMethod::lecture; },
       .example = [] { return std::string(example("collisions")); }},
      {.name = "matrix",
       .needs = "it needs a [level] and a step with do = \"see\"",
       .possible = [](const Draft& d) { return d.scenario.level && some_step<See>(d); },
       .example = [] { return with_verb("level", "see"); }},
      {.name = "screen",
       .needs = "it needs [[element]]s and a step that draws them",
       .possible = some_step<DrawScreen>,
       .place = 2,
       .by_itself = some_step<DrawScreen>,
       .example = [] { return with_verb("atlas", "draw"); }},
  };
  return all;
}

}  // namespace

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

std::vector<std::string_view> names(Panel) {
  std::vector<std::string_view> all;
  for (const PanelKind& kind : kinds()) all.push_back(kind.name);
  return all;
}

}  // namespace lantern::language
