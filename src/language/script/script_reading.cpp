// The script, step by step. A body that is inserted twice, or moved while it is not there, is found
// here and not when the scenario runs.
#include "language/script/script_reading.hpp"

#include <iterator>

#include <fmt/format.h>

#include "language/language.hpp"

namespace lantern::language {

std::vector<std::size_t> NameResolver::take(const std::vector<Named>& written,
                                            std::vector<bool>& marks, bool mark,
                                            std::string_view clash) {
  std::vector<std::size_t> found;
  for (const Named& named : without_ranges(written, names_, kind_, problems_)) {
    const NamedRange* range = find(named);
    is_sure_ &= range != nullptr;
    if (!range) continue;
    std::size_t clashes = 0, example = 0;
    for (std::size_t i = range->first; i < range->first + range->count; ++i) {
      const bool clash_here =
          marks[i] == mark || (&marks == &state_.in_world && !mark && !is_there(i));
      if (is_sure_ && clash_here && ++clashes == 1) example = i - range->first + 1;
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

std::vector<std::size_t> NameResolver::present(const std::vector<Named>& written) {
  std::vector<std::size_t> found;
  std::vector<bool> named_before(state_.in_world.size());
  for (const Named& named : without_ranges(written, names_, kind_, problems_)) {
    const NamedRange* range = find(named);
    if (!range) continue;
    std::string_view clash;
    for (std::size_t i = range->first; i < range->first + range->count; ++i) {
      if (named_before[i]) clash = "is named twice";
      if (!is_there(i)) clash = "is not in the world at this step";
      named_before[i] = true;
      found.push_back(i);
    }
    if (!clash.empty()) problems_.add(named.where, fmt::format("'{}' {}", named.name, clash));
  }
  return found;
}

const NamedRange* NameResolver::find(const Named& named) {
  const NamedRange* range = names_.find(named.name);
  if (!range)
    problems_.add_unknown(named.where, kind_, named.name,
                          [&known = names_] { return known.declared(); });
  return range && may_name(range->count, "bodies or textures", named.where, state_, problems_)
             ? range
             : nullptr;
}

bool may_name(std::size_t count, std::string_view what, Place where, ScriptState& state,
              Problems& problems) {
  const bool had_room = state.named <= kMostNamed;
  state.named += count;
  if (state.named > kMostNamed && had_room)
    problems.add(where, fmt::format("the steps name more than {} {} in all", kMostNamed, what));
  return state.named <= kMostNamed;
}

std::optional<std::size_t> ScriptReading::present_body(const TableReader& table, const char* key) {
  const auto name = table.named(key);
  const auto body = name ? one_body(*name, draft) : std::nullopt;
  if (body && !bodies.is_there(*body))
    table.bad_value(key, fmt::format("'{}' is not in the world at this step", name->name),
                    state.in_world[*body] ? "it has been emitted, but may not have entered yet"
                                          : "insert it first");
  return body;
}

void ScriptReading::require_contacts(Place where) {
  if (draft.dimension != 0 && !draft.scenario.has_contacts())
    draft.problems.add(where, kNothingTouches, kGiveContacts);
}

void ScriptReading::require_sleep(Place where) {
  if (draft.dimension != 0 && !draft.scenario.world.may_sleep)
    draft.problems.add(where, kNothingSleeps, kGiveSleep);
}

bool has_nodes(const TableReader& table, const char* key, const ScriptPast& past) {
  const std::string why = why_not_counted(*find_count("nodes"), past);
  if (!why.empty())
    table.bad_value(key, fmt::format("there is no node here: {}", why), "a structure makes nodes");
  return why.empty();
}

namespace {

class ScriptReader {
 public:
  explicit ScriptReader(Draft& draft)
      : draft_(draft),
        state_(draft),
        script_{draft, state_, NameResolver(draft.bodies, "body", draft.problems, state_),
                NameResolver(draft.textures, "texture", draft.problems, state_)} {}

  void read(const TomlValue& value) {
    const VerbDoc* verb = verb_of(std::get<TomlTable>(value.data), value.where);
    if (!verb) return script_.lose_track();
    const TableReader table =
        open(value, verb->table, draft_, fmt::format("a step with {}", verb->table.heading));
    Step step;
    table.fill(step);
    step.where = draft_.position(value.where);
    script_.frames = 1;
    if (has_basis(table, verb->traits)) step.verb = verb->read(table, script_);
    state_.past.note(step.verb);
    count_frames(table);
    check_plot(table, draft_, state_);
    for (const char* key : {"caption", "after", "answer", "verdict"})
      check_quotes(table, key, draft_, state_.past);
    read_look(table, step, draft_);
    read_notes(table, step, draft_, state_);
    step.headline = read_headline(table, draft_, &state_);
    check_panels(table, step);
    if (table.has("lit")) step.lit.emplace();
    for (const Named& name : table.names("lit"))
      step.lit->push_back({name.name, draft_.position(name.where)});
    step.rulers = read_rulers(table, script_);
    read_code(table, step, draft_);
    note_ending(table, step);
    check_question(table, step);
    for (const TomlValue* expect : table.tables("expect"))
      step.expect = read_expectations(*expect, "expect", draft_, state_);
    for (const TomlValue* always : table.tables("always"))
      step.always = read_expectations(*always, "always", draft_, state_);
    draft_.scenario.steps.push_back(std::move(step));
  }

  const ScriptState& state() const { return state_; }

 private:
  // All that frames show is known from the file's beginning on, so steps choose among that.
  void check_panels(const TableReader& table, const Step& step) {
    const std::vector<Panel>& all = draft_.scenario.panels;
    std::size_t i = 0;
    for (const Named& written : table.names("panels"))
      if (const Panel panel = step.panels[i++]; std::ranges::find(all, panel) == all.end())
        draft_.problems.add(written.where,
                            fmt::format("'{}' is not among the scenario's panels", written.name),
                            "name all of them at the top: panels = [\"world\", …]");
  }

  // Only the last step ends the sequence.
  void note_ending(const TableReader& table, const Step& step) {
    if (ending_ && !told_ending_) {
      draft_.problems.add(*ending_, "'ending' is for the last step, and another one follows",
                          "take it out, or put the step at the end");
      told_ending_ = true;
    }
    if (step.ending) ending_ = table.key_place("ending");
  }

  // A question has an answer, and the answer a proof.
  void check_question(const TableReader& table, const Step& step) {
    for (const char* key : {"question", "answer"})
      if (table.has(key) && !table.is_good(key)) return;  // told already
    if (table.has("answer") && !table.has("question"))
      return table.bad_key("answer", "an 'answer' without a 'question'",
                           "ask, as question = \"Why is nothing tested?\"");
    if (table.has("predict") && table.is_good("predict")) {
      if (!table.has("question"))
        return table.bad_key("predict", "a 'predict' without a 'question'",
                             "ask, as question = \"How many pairs are left?\"");
      check_counted({step.predict, table.key_place("predict")}, draft_, &state_);
    }
    if (!table.has("question")) return;
    if (!table.has("answer"))
      return table.bad_key("question", "a 'question' without an 'answer'",
                           "say what the step's last frame shows, as answer = \"…\"");
    if (!table.has("expect") && !table.has("always"))
      table.bad_key("question", "the answer to this 'question' is proved by nothing",
                    "give the step what it must find, as expect = { pairs = 0 }");
  }

  // The step's verb. Adds a problem and gives null if there is none of that name.
  const VerbDoc* verb_of(const TomlTable& entries, Place where) {
    const TomlEntry* found = entry_of(entries, "do");
    if (!found) {
      draft_.problems.add(where, "a step has no 'do'", "say what it does, as do = \"insert\"");
      return nullptr;
    }
    const auto* name = std::get_if<std::string>(&found->value.data);
    std::vector<std::string_view> verbs;
    for (const VerbDoc& verb : known_verbs()) {
      if (name && *name == verb.traits.name) return &verb;
      verbs.push_back(verb.traits.name);
    }
    if (name)
      draft_.problems.add_unknown(found->value.where, "verb", *name, [verbs] { return verbs; });
    else
      draft_.problems.add(found->value.where, "'do' must be a text, one of the verbs",
                          nearest("", verbs));
    return nullptr;
  }

  // What the verb works on and the scenario lacks, and how to mend it; empty if nothing.
  struct Lack {
    std::string_view what;
    std::string_view hint;
  };
  Lack lack_of(Basis basis) const {
    const bool has_atlas = draft_.scenario.atlas.has_value();
    if (basis == Basis::nothing) return {};
    if (basis == Basis::atlas)
      return has_atlas ? Lack{} : Lack{"an [atlas]", "add [atlas] with size = [512, 512]"};
    if (!draft_.has_world)
      return {"a [world]", has_atlas ? "an atlas knows pack, ask_room and draw"
                                     : "add [world] with size = [64, 64]"};
    if (basis == Basis::level && !draft_.scenario.level)
      return {"a [level]", "add [level] with its loops"};
    if (basis == Basis::bodies && draft_.bodies.empty())
      return {"bodies", "add a [[body]] or a [[pattern]]"};
    return {};
  }

  bool has_basis(const TableReader& table, const VerbTraits& verb) {
    const Lack lack = lack_of(verb.basis);
    if (lack.what.empty()) return true;
    table.bad_value("do", fmt::format("'{}' needs {}, the scenario has none", verb.name, lack.what),
                    std::string(lack.hint));
    return false;
  }

  void count_frames(const TableReader& table) {
    const bool had_room = state_.frames <= kMostScriptFrames;
    state_.frames += script_.frames;
    if (state_.frames <= kMostScriptFrames || !had_room) return;
    const char* key = table.has("seconds") ? "seconds" : table.has("at_most") ? "at_most" : "do";
    table.bad_value(key, fmt::format("the steps up to here have {} frames in all, the limit is {}",
                                     state_.frames, kMostScriptFrames));
  }

  Draft& draft_;
  ScriptState state_;
  ScriptReading script_;
  std::optional<Place> ending_;
  bool told_ending_ = false;
};

std::vector<VerbDoc> made_verbs() {
  std::vector<VerbDoc> all = {verb<Show>("Nothing happens; the caption speaks.")};
  for (auto part : {verbs_of_bodies(), verbs_of_time(), verbs_of_structures(), verbs_of_levels(),
                    verbs_of_atlases()})
    std::ranges::move(part, std::back_inserter(all));
  // The verb's own keys, then those of every step.
  const std::vector<KeyDoc>& common = language_table("step").keys;
  for (VerbDoc& one : all) {
    one.table.name = one.traits.name;
    one.table.example = example_of_verb(one.traits.name);
    one.table.heading = fmt::format("do = \"{}\"", one.traits.name);
    one.table.keys.insert(one.table.keys.end(), common.begin(), common.end());
  }
  return all;
}

}  // namespace

void read_script(const TableReader& file, Draft& draft) {
  if (file.has("step") && file.tables("step").empty() && !draft.problems.any())
    draft.problems.add(file.place("step"), "the script has no step",
                       "add [[step]] with do = \"show\"");
  draft.scenario.headline = read_headline(file, draft, nullptr);
  ScriptReader reader(draft);
  for (const TomlValue* value : file.tables("step")) reader.read(*value);
  draft.scenario.most_frames = reader.state().frames;
  draft.scenario.world_steps = reader.state().ticks;
  if (draft.scenario.chart && !draft.scenario.chart->over_time() && !reader.state().has_plot &&
      !draft.problems.any())
    draft.problems.add(file.place("chart"), "no step adds anything to the chart",
                       "give steps a label in 'plot'");
}

std::span<const VerbDoc> known_verbs() {
  static const std::vector<VerbDoc> verbs = made_verbs();
  return verbs;
}

std::span<const TableDoc> language_verbs() {
  static const std::vector<TableDoc> tables = [] {
    return mapped(known_verbs(), &VerbDoc::table);
  }();
  return tables;
}

const std::vector<std::size_t>* entering(const Verb& verb) {
  if (const auto* insert = std::get_if<Insert>(&verb)) return &insert->bodies;
  if (const auto* emit = std::get_if<Emit>(&verb)) return &emit->bodies;
  return nullptr;
}

double seconds_of(const Verb& any, double time_step) {
  const auto seconds = [&]<class V>(const V& verb) {
    if constexpr (V::kTraits.passes_time) return verb.seconds_of(time_step);
    return 0.0;
  };
  return std::visit(seconds, any);
}

}  // namespace lantern::language
