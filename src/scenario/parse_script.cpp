// The script, step by step. A body that is inserted twice, or moved while it is not there, is found
// here and not when the scenario runs.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenario/script.hpp"

namespace lantern {
namespace {

// Names the bodies or textures of a step, and turns them into indices.
class Cast {
 public:
  Cast(Names& names, const char* kind, Problems& problems, ScriptState& state)
      : names_(names), kind_(kind), problems_(problems), state_(state) {}

  // Each must not yet have `mark` and is given it; `clash` says what is wrong otherwise.
  std::vector<std::size_t> take(const std::vector<Named>& written, std::vector<bool>& marks,
                                bool mark, std::string_view clash) {
    std::vector<std::size_t> found;
    for (const Named& named : written) {
      const NamedRange* range = find(named);
      if (!range || !has_room_for(range->count, named.where)) continue;
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

  // Adds a problem if there is no such name.
  const NamedRange* find(const Named& named) {
    const NamedRange* range = names_.find(named.name);
    if (!range)
      problems_.add(
          named.where, fmt::format("there is no {} {}", kind_, in_quotes(named.name)),
          [&known = names_, name = named.name] { return nearest(name, known.declared()); });
    return range;
  }

 private:
  // All steps together name a bounded number, or a small file could fill the memory.
  bool has_room_for(std::size_t count, Place where) {
    const bool had_room = state_.named <= kMostNamed;
    state_.named += count;
    if (state_.named > kMostNamed && had_room)
      problems_.add(
          where, fmt::format("the steps name more than {} bodies or textures in all", kMostNamed));
    return state_.named <= kMostNamed;
  }

  Names& names_;
  const char* kind_;
  Problems& problems_;
  ScriptState& state_;
};

class ScriptReader {
 public:
  explicit ScriptReader(Draft& draft)
      : draft_(draft),
        bodies_(draft.bodies, "body", draft.problems, state_),
        textures_(draft.textures, "texture", draft.problems, state_) {
    state_.in_world.resize(draft.scenario.bodies.size());
    state_.packed.resize(draft.scenario.textures.size());
    state_.structure = draft.scenario.structure;
  }

  void read(const TomlValue& value) {
    const auto& entries = std::get<TomlTable>(value.data);
    const TableDoc* doc = verb_of(entries, value.where);
    if (!doc) return;
    const TableReader table(entries, value.where, *doc, draft_.problems,
                            fmt::format("a step with {}", doc->heading));
    Step step;
    step.where = draft_.position(value.where);
    step.name = table.text("name").value_or("");
    step.part = table.text("part").value_or("");
    step.caption = table.text("caption").value_or("");
    frames_ = 1;
    if (has_surroundings(table, doc->name)) read_verb(table, doc->name, step);
    count_frames(table);
    check_caption(table, draft_, state_);
    for (const TomlValue* promises : table.tables("expect"))
      step.expect = read_expectations(*promises, "expect", draft_, state_);
    for (const TomlValue* promises : table.tables("always"))
      step.always = read_expectations(*promises, "always", draft_, state_);
    draft_.scenario.steps.push_back(std::move(step));
  }

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

  // Does the scenario have what the verb works on?
  bool has_surroundings(const TableReader& table, std::string_view verb) {
    const bool on_atlas = verb == "pack" || verb == "ask_room";
    const bool has_atlas = draft_.scenario.atlas.has_value();
    if (verb == "show") return true;
    std::string_view lacks, hint;
    if (on_atlas && !has_atlas) {
      lacks = "an [atlas]";
      hint = "add [atlas] with size = [512, 512]";
    } else if (!on_atlas && !draft_.has_world) {
      lacks = "a [world]";
      hint = has_atlas ? "an atlas knows pack and ask_room" : "add [world] with size = [64, 64]";
    } else if (verb == "rebuild" && draft_.bodies.empty()) {
      lacks = "bodies";
      hint = "add a [[body]] or a [[pattern]]";
    } else {
      return true;
    }
    draft_.problems.add(table.place("do"),
                        fmt::format("'{}' needs {}, the scenario has none", verb, lacks),
                        std::string(hint));
    return false;
  }

  void read_verb(const TableReader& table, std::string_view verb, Step& step) {
    if (verb == "insert") {
      step.verb = Insert{
          bodies_.take(table.texts("bodies"), state_.in_world, true, "is in the world already")};
      read_watching(table, step);
    }
    if (verb == "remove")
      step.verb = Remove{bodies_.take(table.texts("bodies"), state_.in_world, false,
                                      "is not in the world at this step")};
    if (verb == "move") step.verb = read_move(table);
    if (verb == "run") step.verb = read_run(table);
    if (verb == "rebuild") {
      state_.structure = read_structure(table, state_.structure, draft_);
      step.verb = Rebuild{state_.structure};
    }
    if (verb == "pack") {
      step.verb = read_pack(table);
      read_watching(table, step);
    }
    if (verb == "ask_room") {
      const Vec<2> size = table.point("size").value_or(Vec<2>(1.0));
      state_.asked_for_room = true;
      step.verb = AskRoom{static_cast<int>(size.x), static_cast<int>(size.y)};
    }
  }

  static void read_watching(const TableReader& table, Step& step) {
    if (const auto pace = table.choice("pace")) step.pace = static_cast<Pace>(*pace);
    for (const Named& event : table.texts("events")) step.events.push_back(event.name);
  }

  Move read_move(const TableReader& table) {
    Move move{0, table.point("to"), table.point("velocity")};
    const auto name = table.text("body");
    const NamedRange* range = name ? bodies_.find({*name, table.place("body")}) : nullptr;
    if (!range) return move;
    move.body = range->first;
    if (range->count > 1)
      draft_.problems.add(table.place("body"), fmt::format("'{}' is a pattern, not a body", *name),
                          fmt::format("its bodies are '{0}1' to '{0}{1}'", *name, range->count));
    else if (!state_.in_world[move.body])
      draft_.problems.add(table.place("body"),
                          fmt::format("'{}' is not in the world at this step", *name),
                          "insert it first");
    const BodySpec& body = draft_.scenario.bodies[move.body];
    if (move.velocity.value_or(Vec<2>(0.0)) != Vec<2>(0.0)) {
      const bool no_size = bounding_box(body.shape, Vec<2>(0.0)).size() == Vec<2>(0.0);
      if (body.is_static || no_size)
        draft_.problems.add(table.place("velocity"),
                            fmt::format("'{}' {}, it can have no velocity", *name,
                                        body.is_static ? "is static" : "has no size"));
    }
    return move;
  }

  Run read_run(const TableReader& table) {
    const auto seconds = table.number("seconds");
    if (!seconds) return {};
    const double h = draft_.scenario.time_step;
    const double ticks = *seconds / h;
    const double whole = std::max(1.0, std::round(ticks));
    // A file's decimals are rounded: a millionth of the time is no mistake.
    constexpr double kRounding = 1e-6;
    const Place where = table.place("seconds");
    if (whole > static_cast<double>(kMostScriptFrames)) {
      draft_.problems.add(where,
                          fmt::format("{} s are {} time steps, the limit is {} frames in all",
                                      *seconds, whole, kMostScriptFrames),
                          "run for a shorter time, or take a larger time_step");
    } else if (std::abs(ticks - whole) > kRounding * whole) {
      const double less = std::max(1.0, std::floor(ticks));
      draft_.problems.add(where,
                          fmt::format("{} s are {:.6g} time steps of {:.6g} s, not a whole number",
                                      *seconds, ticks, h),
                          fmt::format("{:.10g} s or {:.10g} s would be {} or {}", h * less,
                                      h * (less + 1), less, less + 1));
    } else {
      frames_ = static_cast<std::uint64_t>(whole);
    }
    return Run{*seconds};
  }

  Pack read_pack(const TableReader& table) {
    Pack pack;
    pack.textures =
        textures_.take(table.texts("textures"), state_.packed, true, "is packed already");
    pack.each = table.truth("each");
    pack.free_name = table.text("free_name").value_or("");
    if (pack.each && !pack.textures.empty()) frames_ = pack.textures.size();
    return pack;
  }

  void count_frames(const TableReader& table) {
    const bool had_room = state_.frames <= kMostScriptFrames;
    state_.frames += frames_;
    if (state_.frames <= kMostScriptFrames || !had_room) return;
    draft_.problems.add(table.place(table.has("seconds") ? "seconds" : "do"),
                        fmt::format("the steps up to here have {} frames in all, the limit is {}",
                                    state_.frames, kMostScriptFrames));
  }

  Draft& draft_;
  ScriptState state_;
  Cast bodies_;
  Cast textures_;
  std::uint64_t frames_ = 1;  // of the step that is being read, in step pace
};

}  // namespace

void read_script(const TableReader& file, Draft& draft) {
  if (file.has("step") && file.tables("step").empty() && !draft.problems.any())
    draft.problems.add(file.place("step"), "the script has no step",
                       "add [[step]] with do = \"show\"");
  ScriptReader reader(draft);
  for (const TomlValue* value : file.tables("step")) reader.read(*value);
}

}  // namespace lantern
