// The script, step by step. A body that is inserted twice, or moved while it is not there, is found
// here and not when the scenario runs.
#include <algorithm>

#include <fmt/format.h>

#include "scenario/script.hpp"

namespace lantern {

std::vector<std::size_t> Cast::take(const std::vector<Named>& written, std::vector<bool>& marks,
                                    bool mark, std::string_view clash) {
  std::vector<std::size_t> found;
  for (const Named& named : written) {
    const NamedRange* range = find(named);
    if (!range) continue;
    std::size_t clashes = 0, example = 0;
    for (std::size_t i = range->first; i < range->first + range->count; ++i) {
      if (marks[i] == mark && ++clashes == 1) example = i - range->first + 1;
      marks[i] = mark;
      found.push_back(i);
    }
    if (clashes == 0) continue;
    const std::string who =
        range->count == 1 ? named.name : fmt::format("{}{}", named.name, example);
    problems_.add(named.where, fmt::format("'{}' {}", who, clash));
  }
  return found;
}

std::vector<std::size_t> Cast::present(const std::vector<Named>& written) {
  std::vector<std::size_t> found;
  std::vector<bool> named_before(state_.in_world.size());
  for (const Named& named : written) {
    const NamedRange* range = find(named);
    if (!range) continue;
    std::string_view clash;
    for (std::size_t i = range->first; i < range->first + range->count; ++i) {
      if (named_before[i]) clash = "is named twice";
      if (!state_.in_world[i]) clash = "is not in the world at this step";
      named_before[i] = true;
      found.push_back(i);
    }
    if (!clash.empty()) problems_.add(named.where, fmt::format("'{}' {}", named.name, clash));
  }
  return found;
}

const NamedRange* Cast::find(const Named& named) {
  const NamedRange* range = names_.find(named.name);
  if (!range)
    problems_.add(named.where, fmt::format("there is no {} {}", kind_, in_quotes(named.name)),
                  [&known = names_, name = named.name] { return nearest(name, known.declared()); });
  return range && has_room_for(range->count, named.where) ? range : nullptr;
}

// All steps together name a bounded number, or a small file could fill the memory.
bool Cast::has_room_for(std::size_t count, Place where) {
  const bool had_room = state_.named <= kMostNamed;
  state_.named += count;
  if (state_.named > kMostNamed && had_room)
    problems_.add(where,
                  fmt::format("the steps name more than {} bodies or textures in all", kMostNamed));
  return state_.named <= kMostNamed;
}

namespace {

class ScriptReader {
 public:
  explicit ScriptReader(Draft& draft)
      : draft_(draft),
        scope_{draft, state_, Cast(draft.bodies, "body", draft.problems, state_),
               Cast(draft.textures, "texture", draft.problems, state_)} {
    state_.in_world.resize(draft.scenario.bodies.size());
    state_.packed.resize(draft.scenario.textures.size());
    state_.structure = draft.scenario.structure;
  }

  void read(const TomlValue& value) {
    const auto& entries = std::get<TomlTable>(value.data);
    const TableDoc* doc = verb_of(entries, value.where);
    if (!doc) return;
    const TableReader table =
        open(value, *doc, draft_, fmt::format("a step with {}", doc->heading));
    Step step;
    step.where = draft_.position(value.where);
    step.name = table.text("name").value_or("");
    step.part = table.text("part").value_or("");
    step.caption = table.text("caption").value_or("");
    scope_.frames = 1;
    if (has_surroundings(table, doc->name)) step.verb = read_verb(table, doc->name);
    if (doc->find("events")) read_watching(table, step);
    count_frames(table);
    step.plot = read_plot(table, draft_, state_);
    check_caption(table, draft_, state_);
    for (const TomlValue* promises : table.tables("expect"))
      step.expect = read_expectations(*promises, "expect", draft_, state_);
    for (const TomlValue* promises : table.tables("always"))
      step.always = read_expectations(*promises, "always", draft_, state_);
    draft_.scenario.steps.push_back(std::move(step));
  }

  const ScriptState& state() const { return state_; }

 private:
  // The language's table of the step's verb. Adds a problem and gives null if there is none.
  const TableDoc* verb_of(const TomlTable& entries, Place where) {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [](const TomlEntry& e) { return e.key == "do"; });
    if (found == entries.end()) {
      draft_.problems.add(where, "a step has no 'do'", "say what it does, as do = \"insert\"");
      return nullptr;
    }
    const auto* name = std::get_if<std::string>(&found->value.data);
    std::vector<std::string_view> verbs;
    for (const TableDoc& verb : language_verbs()) {
      if (name && *name == verb.name) return &verb;
      verbs.push_back(verb.name);
    }
    draft_.problems.add(found->value.where,
                        name ? fmt::format("there is no verb {}", in_quotes(*name))
                             : "'do' must be a text, one of the verbs",
                        nearest(name ? *name : "", verbs));
    return nullptr;
  }

  // What the verb works on and the scenario lacks, and how to mend it; empty if nothing.
  struct Lack {
    std::string_view what;
    std::string_view hint;
  };
  Lack lack_of(std::string_view verb) const {
    const auto is = [&](std::initializer_list<std::string_view> verbs) {
      return std::find(verbs.begin(), verbs.end(), verb) != verbs.end();
    };
    const bool has_atlas = draft_.scenario.atlas.has_value();
    if (is({"show"})) return {};
    if (is({"pack", "ask_room"}))
      return has_atlas ? Lack{} : Lack{"an [atlas]", "add [atlas] with size = [512, 512]"};
    if (!draft_.has_world)
      return {"a [world]",
              has_atlas ? "an atlas knows pack and ask_room" : "add [world] with size = [64, 64]"};
    if (is({"compile", "locate", "order"}))
      return draft_.scenario.level ? Lack{} : Lack{"a [level]", "add [level] with its loops"};
    if (is({"rebuild", "phases", "solve_by", "ray", "cull", "query"}) && draft_.bodies.empty())
      return {"bodies", "add a [[body]] or a [[pattern]]"};
    return {};
  }

  bool has_surroundings(const TableReader& table, std::string_view verb) {
    const Lack lack = lack_of(verb);
    if (lack.what.empty()) return true;
    draft_.problems.add(table.place("do"),
                        fmt::format("'{}' needs {}, the scenario has none", verb, lack.what),
                        std::string(lack.hint));
    return false;
  }

  Verb read_verb(const TableReader& table, std::string_view verb) {
    for (const auto read : {read_body_verb, read_time_verb, read_query_verb, read_atlas_verb})
      if (auto found = read(table, verb, scope_)) return *std::move(found);
    return Show{};
  }

  static void read_watching(const TableReader& table, Step& step) {
    if (const auto pace = table.choice("pace")) step.pace = static_cast<Pace>(*pace);
    for (const Named& event : table.texts("events")) step.events.push_back(event.name);
  }

  void count_frames(const TableReader& table) {
    const bool had_room = state_.frames <= kMostScriptFrames;
    state_.frames += scope_.frames;
    if (state_.frames <= kMostScriptFrames || !had_room) return;
    const char* key = table.has("seconds") ? "seconds" : table.has("at_most") ? "at_most" : "do";
    draft_.problems.add(table.place(key),
                        fmt::format("the steps up to here have {} frames in all, the limit is {}",
                                    state_.frames, kMostScriptFrames));
  }

  Draft& draft_;
  ScriptState state_;
  Scope scope_;
};

}  // namespace

void read_script(const TableReader& file, Draft& draft) {
  if (file.has("step") && file.tables("step").empty() && !draft.problems.any())
    draft.problems.add(file.place("step"), "the script has no step",
                       "add [[step]] with do = \"show\"");
  ScriptReader reader(draft);
  for (const TomlValue* value : file.tables("step")) reader.read(*value);
  draft.scenario.most_frames = reader.state().frames;
  draft.scenario.world_steps = reader.state().ticks;
  if (draft.scenario.chart && !draft.scenario.chart->over_time() && !reader.state().has_plot &&
      !draft.problems.any())
    draft.problems.add(file.place("chart"), "no step adds anything to the chart",
                       "give steps a label in 'plot'");
}

}  // namespace lantern
