// What can be counted at each step: captions quote it, and the chart plots it.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/caption.hpp"
#include "scenario/script_reading.hpp"
#include "scenario/table_side.hpp"

namespace lantern::scenario {
namespace {

// Names that can be counted or quoted here, for suggestions.
std::vector<std::string_view> quotable(const Draft& draft, const ScriptState& state) {
  std::vector<std::string_view> names;
  for (const auto docs : {known_counts(), known_texts(), known_measures()})
    for (const CountDoc& doc : docs)
      if (why_not_counted(doc.name, draft, state).empty()) names.push_back(doc.name);
  return names;
}

// The place of a byte of a text that is written on one line without escapes; otherwise the place of
// the text.
Place place_within(std::string_view file, Place where, std::string_view text, std::size_t offset) {
  const std::string line = line_of(file, where.line);
  std::size_t at = 0;
  for (int column = 1; column < where.column && at < line.size(); ++column) do
      ++at;
    while (at < line.size() && (line[at] & 0xc0) == 0x80);
  const std::string_view before = text.substr(0, offset);
  if (at + 1 >= line.size() || !std::string_view(line).substr(at + 1).starts_with(before))
    return where;
  return {where.line, where.column + 1 + static_cast<int>(letters(before))};
}

// Those that are built of an orthtree's nodes.
bool shares_an_array(StructureKind kind) {
  return kind == StructureKind::quadtree || kind == StructureKind::octree;
}

// Of the structure that stands at this step.
std::string why_not_in(const StructureSpec& structure, CountNeed need,
                       const ScenarioSpec& scenario) {
  const StructureKind kind = structure.kind;
  if (kind == StructureKind::none) return "there is no structure at this step";
  if (need == CountNeed::kd_tree && kind != StructureKind::kd_tree)
    return "there is no kd_tree at this step";
  if (need == CountNeed::sweep && kind != StructureKind::sort_and_sweep)
    return "there is no sort_and_sweep at this step";
  if (need == CountNeed::boxes && kind != StructureKind::aabb_tree)
    return "there is no aabb_tree at this step";
  if (need == CountNeed::inside && traits_of(kind).is_own)
    return fmt::format("'{}' is seen from outside, nobody counts its tests and its memory",
                       to_string(kind));
  if (need == CountNeed::split && !structure.split_static)
    return "the structure has no split_static";
  if (need == CountNeed::asleep_nodes && !scenario.tells_sleepers())
    return "in this world nothing sleeps";
  if (need == CountNeed::array && !shares_an_array(kind))
    return fmt::format("the leaves of '{}' share no array", to_string(kind));
  return {};
}

// Of a level, at this step.
std::string why_not_in_level(CountNeed need, const ScenarioSpec& scenario,
                             const ScriptState& state) {
  if (!scenario.level) return "the scenario has no [level]";
  if (!state.compiled) return "no step has compiled the level yet";
  if (need == CountNeed::located && !state.located) return "no step has located a point yet";
  if (need == CountNeed::sighted && !state.sighted) return "no step has asked who sees whom yet";
  if (need == CountNeed::eyed && !state.eyed) return "no eye has looked yet";
  return {};
}

// Of a world, at this step.
std::string why_not_there(CountNeed need, const Draft& draft, const ScriptState& state) {
  const ScenarioSpec& s = draft.scenario;
  switch (need) {
    case CountNeed::bodies:
    case CountNeed::atlas:
    case CountNeed::room:
    case CountNeed::drawn:
      return {};
    case CountNeed::tree:
    case CountNeed::structure:
    case CountNeed::kd_tree:
    case CountNeed::sweep:
    case CountNeed::boxes:
    case CountNeed::array:
    case CountNeed::inside:
    case CountNeed::split:
    case CountNeed::asleep_nodes:
      return why_not_in(state.structure, need, s);
    case CountNeed::contacts:
      return s.has_contacts() ? "" : "this world has no contacts";
    case CountNeed::joints:
      return s.has_joints() ? "" : "this world has no joints";
    case CountNeed::sleep:
      return s.tells_sleepers() ? "" : "in this world nothing sleeps";
    case CountNeed::physics:
      return s.has_physics() ? "" : "this world has no contacts, gravity, springs or joints";
    case CountNeed::islands:
      return shows(s.panels, "islands") ? "" : "there is no panel 'islands'";
    case CountNeed::query:
      return state.queried ? "" : "no step has sent a ray, culled or queried yet";
    case CountNeed::shapes:
      return state.shapes_tested ? "" : "no step has tested shapes yet";
    case CountNeed::separated:
      return state.separated ? "" : "no step has separated two bodies yet";
    case CountNeed::searched:
      return state.searched ? "" : "no step has asked for a distance by gjk yet";
    case CountNeed::compared:
      return state.rows_compared > 0 ? "" : "no step has compared structures yet";
    case CountNeed::compiled:
    case CountNeed::located:
    case CountNeed::sighted:
    case CountNeed::eyed:
      return why_not_in_level(need, s, state);
  }
  return {};
}

bool is_of_level(CountNeed need) {
  return need == CountNeed::compiled || need == CountNeed::located || need == CountNeed::sighted ||
         need == CountNeed::eyed;
}

constexpr std::size_t kMostNoted = 64;  // each costs time on every frame

// Empty if a body of this world has it.
std::string why_not_measured(const CountDoc& doc, const Draft& draft) {
  if (doc.need == CountNeed::contacts && !draft.scenario.has_contacts())
    return "this world has no contacts";
  const bool is_3d = doc.name == "z" || doc.name.starts_with("own_spin");
  return is_3d && draft.dimension == 2 ? "this world is 2D" : "";
}

}  // namespace

std::string why_not_counted(std::string_view name, const Draft& draft, const ScriptState& state) {
  const CountDoc* doc = find_count(name);
  if (!doc) doc = find_in(known_texts(), name);
  const bool has_bodies = draft.has_world && !draft.bodies.empty();
  const bool has_atlas = draft.scenario.atlas.has_value();
  if (doc->need == CountNeed::room && has_atlas && !state.asked_for_room)
    return "no step has asked for room yet";
  if (doc->need == CountNeed::drawn && has_atlas && state.ways == 0)
    return "no step has drawn the screen yet";
  if (doc->for_atlas() && has_atlas) return {};
  if (!doc->for_world()) return "the scenario has no [atlas]";
  if (name == "time" && draft.has_world) return {};
  if (doc->need == CountNeed::tree && draft.scenario.level && state.compiled) return {};
  if (!has_bodies && !is_of_level(doc->need))
    return has_atlas ? "an atlas has none" : "the scenario has no bodies";
  return why_not_there(doc->need, draft, state);
}

void check_caption(const TableReader& step, Draft& draft, const ScriptState& state) {
  check_quotes(step, "caption", draft, state);
  check_quotes(step, "answer", draft, state);
}

void check_quotes(const TableReader& table, std::string_view key, Draft& draft,
                  const ScriptState& state) {
  const std::string text = table.get<std::string>(key).value_or("");
  const auto kind_of = [](std::string_view name) {
    if (find_in(known_counts(), name)) return Placeholder::count;
    if (is_of_body(name)) return Placeholder::text;
    const bool is_text = find_in(known_texts(), name) || find_in(known_measures(), name);
    return is_text ? Placeholder::text : Placeholder::unknown;
  };
  const auto can_be_quoted = [&](std::string_view name) {
    if (is_of_body(name)) return note_body_measure({std::string(name), table.place(key)}, draft);
    return kind_of(name) != Placeholder::unknown && why_not_counted(name, draft, state).empty();
  };
  // What is said of another side is checked when that one is read.
  const auto known_here = [&](std::string_view written) {
    const std::string_view side = side_of(written, draft.sides);
    const std::string_view name = within_side(written, draft.sides);
    if (!side.empty() && side != draft.scenario.side) return Placeholder::count;
    return can_be_quoted(name) ? kind_of(name) : Placeholder::unknown;
  };
  for (CaptionProblem& p : caption_problems(text, known_here)) {
    const Place where = place_within(draft.text, table.place(key), text, p.offset);
    p.unknown = std::string(within_side(p.unknown, draft.sides));
    if (!p.message.empty())
      draft.problems.add(where, fmt::format("in the {}: {}", key, p.message),
                         "write {{ and }} for the braces themselves");
    else if (is_of_body(p.unknown))
      continue;  // told already
    else if (kind_of(p.unknown) == Placeholder::unknown)
      draft.problems.add(
          where, fmt::format("a {} cannot quote {}", key, in_quotes(p.unknown)),
          [name = p.unknown, known = quotable(draft, state)] { return nearest(name, known); });
    else
      draft.problems.add(where, fmt::format("'{}' is not counted here: {}", p.unknown,
                                            why_not_counted(p.unknown, draft, state)));
  }
}

void check_plot(const TableReader& step, Draft& draft, ScriptState& state) {
  if (step.has("plot")) state.has_plot = true;
  if (!step.is_good("plot")) return;
  const auto& chart = draft.scenario.chart;
  if (!chart)
    return step.bad_key("plot", "'plot' needs a [chart], the scenario has none",
                        "add [chart] with bars = \"pairs\"");
  if (chart->over_time())
    return step.bad_key("plot", "over time every frame is plotted by itself", "leave out 'plot'");
  std::vector<std::string> counts = chart->y;
  if (!chart->x.empty()) counts.push_back(chart->x);
  for (const std::string& count : counts) {
    const std::string why = find_count(count) ? why_not_counted(count, draft, state) : "";
    if (!why.empty())
      step.bad_key("plot", fmt::format("the chart's '{}' is not counted here: {}", count, why));
  }
}

bool note_body_measure(const Named& name, Draft& draft) {
  const std::size_t dot = name.name.find('.');
  const std::string measure = name.name.substr(0, dot);
  const CountDoc* doc = find_in(known_body_measures(), measure);
  if (!doc) {
    draft.problems.add(
        name.where,
        draft.sides.empty()
            ? fmt::format("there is no measure {} of a body", in_quotes(measure))
            : fmt::format("there is no side {0}, and no measure {0} of a body", in_quotes(measure)),
        [measure, &sides = draft.sides] {
          std::vector<std::string_view> known(sides.begin(), sides.end());
          for (const CountDoc& k : known_body_measures()) known.push_back(k.name);
          return nearest(measure, known);
        });
    return false;
  }
  if (const std::string why = why_not_measured(*doc, draft); !why.empty()) {
    draft.problems.add(name.where, fmt::format("'{}' is not measured here: {}", name.name, why));
    return false;
  }
  const auto body = one_body({name.name.substr(dot + 1), name.where}, draft);
  if (!body) return false;
  std::vector<BodyMeasureSpec>& noted = draft.scenario.body_measures;
  if (std::any_of(noted.begin(), noted.end(), [&](const auto& n) { return n.name == name.name; }))
    return true;
  if (noted.size() == kMostNoted) {
    draft.problems.add(name.where,
                       fmt::format("more than {} measures of single bodies", kMostNoted));
    return false;
  }
  const auto what = static_cast<BodyMeasure>(doc - known_body_measures().data());
  noted.push_back({name.name, what, *body});
  return true;
}

}  // namespace lantern::scenario
