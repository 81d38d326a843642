// What a file says for nothing: it is legal, changes no frame and fails no check, and is surely not
// meant.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "base/number.hpp"
#include "geometry/vec.hpp"
#include "language/counts.hpp"
#include "language/keys/key.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

constexpr const char* kCannotFail = "so this cannot fail";
constexpr double kBeyondAll = 1e15;  // no measure of a lecture's world comes near
constexpr double kWide = 1e6;        // a tolerance of so many times what is expected is none

// --- expectations ---

// How deep trees become, if all structures of the script are trees that split down to a limit.
std::optional<double> deepest(const ScenarioSpec& s) {
  double depth = 0;
  for (const StructureSpec* one : s.structures()) {
    const StructureTraits& traits = traits_of(one->kind);
    if (!traits.has(Setting::max_depth) || traits.is_own) return std::nullopt;
    depth = std::max<double>(depth, one->max_depth);
  }
  return depth;
}

// What no frame of the scenario can count more of. To expect just that is to say so.
double most_of(const CountDoc& count, const ScenarioSpec& s, const std::optional<double>& depth) {
  const auto bodies = static_cast<double>(s.bodies.size());
  if (count.most == Most::bodies) return bodies;
  if (count.most == Most::pairs) return bodies * (bodies - 1) / 2;
  if (count.most == Most::parts) return 1e8;  // structures refuse far fewer
  if (count.most == Most::depth) return depth.value_or(kMostWhole);
  if (count.most == Most::part_of_step) return std::nextafter(1.0, 0.0);
  return find_in(known_counts(), count.name) ? kMostWhole : kBeyondAll;
}

// How far anything may get in the script by itself, and how fast. Bodies leave the world, and turn
// more than once.
double reach_of(const ScenarioSpec& s) {
  double seconds = 1, fastest = 0;
  for (const Step& step : s.steps) seconds += seconds_of(step.verb, s.world.time_step);
  for (const BodySpec& body : s.bodies)
    fastest =
        std::max({fastest, glm::length(body.velocity), body.brain_speed, std::abs(body.spin)});
  return std::max(glm::length(s.world.bounds.size()),
                  (fastest + glm::length(s.world.gravity) * seconds) * seconds);
}

// How far from what it should be anything may be without failing; nothing if that is not too far.
std::optional<std::string> too_wide(const Expectation& e, double reach) {
  using enum Expectation::Kind;
  static constexpr std::array kTolerant = {position, velocity, half_size, turned, measure};
  if (std::ranges::find(kTolerant, e.kind) == kTolerant.end()) return std::nullopt;
  const double usual = std::max({1.0, std::abs(e.number), glm::length(e.position), reach});
  if (!(e.tolerance >= kWide * usual)) return std::nullopt;
  const double unit = e.kind == turned ? kDegree : 1;
  return fmt::format("a tolerance of {:.6g} for '{}' takes whatever comes", e.tolerance / unit,
                     e.name);
}

// Why the expectation holds whatever happens; nothing if it may fail.
std::optional<std::string> why_it_holds(const Expectation& e, const ScenarioSpec& s,
                                        const std::optional<double>& depth, double reach) {
  using enum Expectation::Kind;
  const CountDoc* doc = find_in(known_body_measures(), e.name.substr(0, e.name.find('.')));
  if (!is_of_body(e.name)) doc = find_count(e.name);
  const bool counts = find_in(known_counts(), e.name) != nullptr;
  const bool has_root = depth && (e.name == "nodes" || e.name == "leaves");
  const double least = has_root                                          ? 1
                       : counts || (doc && doc->most != Most::unbounded) ? 0
                                                                         : -kBeyondAll;
  if (e.kind == at_least && e.number <= least)
    return fmt::format("'{}' is always at least {:.6g}", e.name, e.number);
  const double most = doc ? most_of(*doc, s, depth) : kBeyondAll;
  if (e.kind == at_most && e.number > most)
    return fmt::format("'{}' is always at most {:.6g}", e.name, e.number);
  if ((e.kind == asleep || e.kind == awake) && e.names.empty())
    return fmt::format("'{}' names no body", e.kind == asleep ? "asleep" : "awake");
  return too_wide(e, reach);
}

void notice_expectations(Draft& draft) {
  const std::optional<double> depth = deepest(draft.scenario);
  const double reach = reach_of(draft.scenario);
  for (const Step& step : draft.scenario.steps)
    for (const auto* list : {&step.expect, &step.always})
      for (const Expectation& e : *list)
        if (const auto why = why_it_holds(e, draft.scenario, depth, reach))
          draft.notice(Warning::expect, e.where, fmt::format("{}, {}", *why, kCannotFail),
                       "give it a limit that a mistake would break");
}

// Neither of all sides nor of one.
bool expects_nothing(const TomlTable& table) {
  return std::ranges::all_of(table, [](const TomlEntry& e) {
    const auto* inner = std::get_if<TomlTable>(&e.value.data);
    return e.key == "tolerance" || (inner && expects_nothing(*inner));
  });
}

// --- settings ---

// The first place of a key that changes nothing, how often it is there, and why.
class IdleKeys {
 public:
  struct Reason {
    std::string why, instead;
  };
  void see(const TomlValue& table, std::initializer_list<std::string_view> keys,
           const Reason& reason) {
    for (const std::string_view key : keys)
      if (const TomlEntry* entry = entry_of(std::get<TomlTable>(table.data), key)) {
        Seen& seen = found_.try_emplace(key, Seen{entry->where, 0, reason}).first->second;
        seen.first = std::min(seen.first, entry->where);
        ++seen.times;
      }
  }
  void tell(Draft& draft) const {
    for (const auto& [key, seen] : found_)
      draft.notice(
          Warning::settings, draft.position(seen.first),
          fmt::format("'{}' changes nothing{}: {}", key,
                      seen.times > 1 ? ", here and " + counted(seen.times - 1, "time") + " more"
                                     : std::string(),
                      seen.reason.why),
          fmt::format("{}, or leave it out", seen.reason.instead));
  }

 private:
  struct Seen {
    Place first;
    std::size_t times = 0;
    Reason reason;
  };
  std::map<std::string_view, Seen> found_;
};

// Of the whole script.
std::vector<ContactMethod> methods_of(const ScenarioSpec& s) {
  std::vector<ContactMethod> all = {s.world.contacts};
  for (const Step& step : s.steps)
    if (const auto* by = std::get_if<SolveBy>(&step.verb)) all.push_back(by->contacts);
  return all;
}

// How finely one method works, where only others do.
void see_idle_efforts(const TomlValue& table, ContactMethod used, const ScenarioSpec& s,
                      IdleKeys& keys) {
  static constexpr std::pair<std::string_view, ContactMethod> kEfforts[] = {
      {"iterations", ContactMethod::impulse}, {"sub_steps", ContactMethod::soft}};
  for (const auto& [key, method] : kEfforts)
    if (std::ranges::count(methods_of(s), method) == 0)
      keys.see(table, {key},
               {fmt::format("only contacts = \"{}\" have {}, and these are \"{}\"",
                            to_string(method), key, to_string(used)),
                fmt::format("give contacts = \"{}\"", to_string(method))});
}

// Why contacts do nothing although there may be some; nothing if they may do something.
std::optional<IdleKeys::Reason> why_idle(const ScenarioSpec& s) {
  const auto passes_time = [](const Step& step) {
    return traits_of(step.verb).passes_time || std::holds_alternative<Compare>(step.verb);
  };
  if (s.bodies.size() < 2) return {{"there are no two bodies", "add what may be touched"}};
  if (!s.has_body_of(BodyKind::dynamic_body) && !s.has_body_of(BodyKind::kinematic_body))
    return {{"all bodies are static", "add one that moves"}};
  if (std::ranges::none_of(s.steps, passes_time))
    return {{"no step lets time pass", "add one that does, as do = \"run\""}};
  return std::nullopt;
}

const IdleKeys::Reason kLectures{"contacts = \"lecture\" know neither friction nor times of impact",
                                 "give contacts = \"impulse\""};
const IdleKeys::Reason kLecturesKeepNone{"contacts = \"lecture\" keep no error",
                                         "give contacts = \"impulse\""};

bool only_lectures(const ScenarioSpec& s) {
  return std::ranges::all_of(methods_of(s),
                             [](ContactMethod method) { return method == ContactMethod::lecture; });
}

// `lantern measure` tries a problem under all methods.
void notice_settings(const TableReader& file, Draft& draft) {
  const ScenarioSpec& s = draft.scenario;
  const bool touches = s.has_contacts();
  const auto idle = touches ? why_idle(s) : IdleKeys::Reason{kNothingTouches, kGiveContacts};
  if (touches && s.problem) return;
  IdleKeys keys;
  const auto see_methods = [&](const TomlValue& table, ContactMethod used) {
    if (touches && !idle) {
      if (only_lectures(s)) keys.see(table, {"impact_budget"}, kLectures);
      if (only_lectures(s)) keys.see(table, {"wanted_error"}, kLecturesKeepNone);
      return see_idle_efforts(table, used, s, keys);
    }
    // Joints are solved in as many sweeps or parts.
    if (!touches || !s.has_joints()) keys.see(table, {"iterations", "impact_budget"}, *idle);
    if (!touches && !s.has_joints()) keys.see(table, {"sub_steps", "wanted_error"}, *idle);
  };
  for (const TomlValue* world : file.tables("world")) see_methods(*world, s.world.contacts);
  const std::vector<const TomlValue*> steps = file.tables("step");
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (const auto* solve_by = std::get_if<SolveBy>(&s.steps[i].verb))
      see_methods(*steps[i], solve_by->contacts);
  for (const char* owner : {"prototype", "body", "pattern"})
    for (const TomlValue* body : file.tables(owner)) {
      if (idle) keys.see(*body, {"restitution", "friction"}, *idle);
      if (!idle && only_lectures(s)) keys.see(*body, {"friction"}, kLectures);
    }
  keys.tell(draft);
}

// Of structures that the script never has. Those of a user's own may have any, and one that is
// compared is set as the one that stands.
void notice_structures(const TableReader& file, Draft& draft) {
  const ScenarioSpec& s = draft.scenario;
  for (const Step& step : s.steps)
    if (std::holds_alternative<Compare>(step.verb)) return;
  const std::vector<const StructureSpec*> all = s.structures();
  std::vector<const TomlValue*> tables = file.tables("structure");
  const std::vector<const TomlValue*> steps = file.tables("step");
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (std::holds_alternative<Rebuild>(s.steps[i].verb)) tables.push_back(steps[i]);
  IdleKeys keys;
  for (std::size_t i = 0; i < std::size(kSettingNames); ++i) {
    const auto setting = static_cast<Setting>(i);
    const auto has = [&](const StructureSpec* one) {
      return one->kind >= StructureKind::own || traits_of(one->kind).has(setting);
    };
    if (std::ranges::any_of(all, has)) continue;
    for (const TomlValue* table : tables)
      keys.see(*table, {to_string(setting)},
               {"no structure here has it",
                fmt::format("take kind = \"{}\"", to_string(kinds_with(setting).front()))});
  }
  keys.tell(draft);
}

// --- what is declared and not used ---

// Those that a step lets in, or stands up in a world of their own. A problem has all of them.
void notice_bodies(Draft& draft) {
  const ScenarioSpec& s = draft.scenario;
  if (s.problem) return;
  std::vector<bool> used(s.bodies.size());
  double left = 0;  // seconds until the end, at most
  for (auto step = s.steps.rbegin(); step != s.steps.rend(); ++step) {
    left += seconds_of(step->verb, s.world.time_step);
    const auto* emit = std::get_if<Emit>(&step->verb);
    const auto* compare = std::get_if<Compare>(&step->verb);
    const auto* bodies = compare ? &compare->bodies : entering(step->verb);
    const auto ticks = static_cast<std::uint64_t>(std::llround(left / s.world.time_step));
    for (std::size_t i = 0; bodies && i < bodies->size(); ++i)
      if (!emit || i * emit->every <= ticks) used[(*bodies)[i]] = true;
  }
  for (const std::string_view name : draft.bodies.declared()) {
    const NamedRange& range = *draft.bodies.find(std::string(name));
    const auto first = used.begin() + static_cast<std::ptrdiff_t>(range.first);
    const auto out = static_cast<std::size_t>(
        std::count(first, first + static_cast<std::ptrdiff_t>(range.count), false));
    if (out == 0) continue;
    const std::string bodies = fmt::format("of the {} bodies of '{}'", range.count, name);
    draft.notice(Warning::bodies, draft.position(range.where),
                 range.count == 1     ? fmt::format("'{}' never enters the world", name)
                 : out == range.count ? fmt::format("none {} enters the world", bodies)
                                      : fmt::format("{} {} never enter{} the world", out, bodies,
                                                    out == 1 ? "s" : ""),
                 out == range.count || range.count == 1
                     ? fmt::format("insert it, as bodies = [\"{}\"], or leave it out", name)
                     : "insert them, let time pass until they are emitted, or leave them out");
  }
}

void notice_prototypes(const TableReader& file, Draft& draft) {
  const auto text_in = [](const TomlValue& table, std::string_view key) {
    const auto* text = value_of<std::string>(std::get<TomlTable>(table.data), key);
    return text ? *text : std::string();
  };
  std::set<std::string> used;
  for (const char* owner : {"prototype", "body", "pattern"})
    for (const TomlValue* table : file.tables(owner)) used.insert(text_in(*table, "like"));
  for (const TomlValue* map : file.tables("map"))
    for (const TomlEntry& e : *value_of<TomlTable>(std::get<TomlTable>(map->data), "legend"))
      used.insert(std::get<std::string>(e.value.data));
  for (const TomlValue* table : file.tables("prototype"))
    if (const std::string name = text_in(*table, "name"); !used.contains(name))
      draft.notice(Warning::prototypes, draft.position(table->where),
                   fmt::format("nobody is like the prototype '{}'", name),
                   fmt::format("give a body like = \"{}\", or leave it out", name));
}

// --- springs and joints ---

void notice_links(Draft& draft) {
  const ScenarioSpec& s = draft.scenario;
  using End = std::tuple<std::size_t, double, double, double>;
  constexpr auto kWorld = static_cast<std::size_t>(-1);
  std::map<std::tuple<LinkSpec::Kind, End, End, std::optional<double>, double, double>, int> lines;
  for (const LinkSpec& link : s.links) {
    End a{link.a, link.at_a.x, link.at_a.y, link.at_a.z};
    End b{link.b.value_or(kWorld), link.at_b.x, link.at_b.y, link.at_b.z};
    if (b < a) std::swap(a, b);
    const auto [first, is_new] = lines.try_emplace(
        {link.kind, a, b, link.rest_length, link.stiffness, link.damping}, link.where.line);
    if (is_new) continue;
    const bool spring = link.kind == LinkSpec::Kind::spring;
    const std::string from = fmt::format("'{}'", s.bodies[link.a].name);
    draft.notice(
        Warning::links, link.where,
        fmt::format(
            "the {} {} is there twice, first in line {}", spring ? "spring" : "joint",
            link.b ? fmt::format("from {} to '{}'", from, s.bodies[*link.b].name) : "of " + from,
            first->second),
        spring ? "one of twice the stiffness and damping does the same" : "leave one of them out");
  }
}

// What a side has been told of, and where it expects something.
struct SideNotices {
  explicit SideNotices(const Scenario& side) {
    for (const Noticed& one : side.noticed) told.insert(named(one));
    for (const Step& step : side.steps)
      for (const auto* list : {&step.expect, &step.always})
        for (const Expectation& e : *list) expects.insert({e.where.line, e.where.column});
  }
  static std::tuple<Warning, int, int, std::string_view> named(const Noticed& one) {
    return {one.kind, one.where.line, one.where.column, one.message};
  }
  bool has(const Noticed& one) const { return told.contains(named(one)); }
  // What one side overrides may be another's, and what cannot fail on one may on another.
  bool agrees(const Noticed& one) const {
    return has(one) ||
           !(one.kind == Warning::settings || expects.contains({one.where.line, one.where.column}));
  }

  std::set<std::tuple<Warning, int, int, std::string_view>> told;
  std::set<std::pair<int, int>> expects;
};

}  // namespace

void Draft::notice(Warning kind, SourcePosition where, std::string message,
                   const std::string& suggestion) {
  if (scenario.is_quiet(kind)) return;
  scenario.noticed.push_back(
      {kind, std::move(where), std::move(message), suggestion + if_meant(scenario, kind)});
}

std::string if_meant(const ScenarioSpec& scenario, Warning kind) {
  return fmt::format("; if this is intended, add quiet = [\"{}\"] to {}",
                     names(kind)[static_cast<std::size_t>(kind)],
                     scenario.atlas ? "[atlas]" : "[world]");
}

void notice_idle(const TableReader& file, Draft& draft) {
  notice_expectations(draft);
  notice_settings(file, draft);
  notice_structures(file, draft);
  notice_bodies(draft);
  notice_prototypes(file, draft);
  notice_links(draft);
}

void notice_empty_expectations(const TomlTable& file, Draft& draft) {
  for (const TomlValue& step : *value_of<TomlArray>(file, "step"))
    for (const char* key : {"expect", "always"})
      if (const TomlEntry* e = entry_of(std::get<TomlTable>(step.data), key);
          e && expects_nothing(std::get<TomlTable>(e->value.data)))
        draft.notice(Warning::expect, draft.position(e->where),
                     fmt::format("'{}' expects nothing, {}", key, kCannotFail),
                     "say what must hold, as { bodies = 3 }");
}

std::vector<Noticed> noticed_on(const std::vector<std::shared_ptr<const Scenario>>& sides) {
  const auto of_sides = mapped(sides, [](const auto& side) { return SideNotices(*side); });
  std::vector<Noticed> all;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (const Noticed& one : sides[i]->noticed) {
      const auto before = of_sides.begin() + static_cast<std::ptrdiff_t>(i);
      const bool is_first = std::none_of(of_sides.begin(), before,
                                         [&](const SideNotices& side) { return side.has(one); });
      const bool all_agree =
          std::ranges::all_of(of_sides, [&](const SideNotices& side) { return side.agrees(one); });
      if (is_first && all_agree) all.push_back(one);
    }
  return all;
}

}  // namespace lantern::language
