// The script of a scenario while it is being read: what is where at each point of it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "language/counts.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {

// What is known at a step of what comes before it, without the engine.
struct ScriptState {
  explicit ScriptState(const Draft& draft)
      : past(draft.scenario, draft.dimension),
        in_world(draft.scenario.bodies.size()),
        due(draft.scenario.bodies.size()),
        packed(draft.scenario.textures.size()) {}

  ScriptPast past;
  std::vector<bool> in_world;      // by index of the body
  std::vector<std::uint64_t> due;  // the same: the world step by whose end it has entered
  std::vector<bool> packed;        // by index of the texture; refused ones, too
  bool has_plot = false;           // some step adds to the chart
  std::uint64_t frames = 0;        // in step pace
  std::uint64_t ticks = 0;         // world steps at most, and at least
  std::uint64_t least_ticks = 0;
  std::size_t named = 0;  // bodies and textures, over all steps
};

// Turns the names of bodies or textures that a step gives into their indices.
class NameResolver {
 public:
  NameResolver(Names& names, const char* kind, Problems& problems, ScriptState& state)
      : names_(names), kind_(kind), problems_(problems), state_(state) {}

  // Each must not yet have `mark` and is given it; `clash` says what is wrong otherwise.
  std::vector<std::size_t> take(const std::vector<Named>& written, std::vector<bool>& marks,
                                bool mark, std::string_view clash);

  // Each must be in the world: bodies that may still be on their way into it are not.
  std::vector<std::size_t> present(const std::vector<Named>& written);

  // Is it in the world at this step, however early a wait may have ended?
  bool is_there(std::size_t body) const {
    return !is_sure_ || (state_.in_world[body] && state_.due[body] <= state_.least_ticks);
  }

  // Nobody knows any more who is there: that somebody is or is not is no mistake from now on.
  void lose_track() { is_sure_ = false; }

 private:
  // Adds a problem if there is no such name, or if all steps together name too many.
  const NamedRange* find(const Named& named);

  Names& names_;
  const char* kind_;
  Problems& problems_;
  ScriptState& state_;
  bool is_sure_ = true;  // no step has named somebody unknown
};

// What is at hand while a step's verb is read.
struct ScriptReading {
  Draft& draft;
  ScriptState& state;
  NameResolver bodies;
  NameResolver textures;
  std::uint64_t frames = 1;  // of the step, in step pace

  // Of a step nobody knows what it does: what only follows from that is no mistake.
  void lose_track() {
    state.past.note_unknown();
    bodies.lose_track();
    textures.lose_track();
  }

  // World steps in the seconds that `key` gives; 1 and a problem if they are not a whole number,
  // or too many.
  std::uint64_t read_ticks(const TableReader& table, const char* key);

  // One body that is in the world, named by `key`. Adds a problem and gives nothing otherwise.
  std::optional<std::size_t> present_body(const TableReader& table, const char* key);
  // Adds a problem if nothing touches, or nothing sleeps, in this world.
  void require_contacts(Place where);
  void require_sleep(Place where);
};

// All steps together may name so many, or a small file could fill the memory; one message says so.
bool may_name(std::size_t count, std::string_view what, Place where, ScriptState& state,
              Problems& problems);

// Is this a count or measure, and is there one at this point of the script? Adds a problem if not.
// That of one body is noted, so that every frame measures it; without `state` it may come to be
// later. What is said of another side is checked when that one is read.
bool check_counted(const Named& written, Draft& draft, const ScriptState* state);

// An `expect` or `always` table.
std::vector<Expectation> read_expectations(const TomlValue& value, std::string_view called,
                                           Draft& draft, ScriptState& state);

// Adds a problem for each placeholder of the text of a key that cannot be filled in.
void check_quotes(const TableReader& table, std::string_view key, Draft& draft,
                  const ScriptPast& past);

// How a step is looked at: its display, view and camera; and its notes.
void read_look(const TableReader& step, Step& to, Draft& draft);
void read_notes(const TableReader& step, Step& to, Draft& draft, const ScriptState& state);

// False, and a problem at the key, if there are no nodes at this point of the script.
bool has_nodes(const TableReader& table, const char* key, const ScriptPast& past);

// The counts and measures of a `headline`. Adds a problem for each that is none, or for too many;
// with `state` also for those that are not counted at this step.
std::vector<std::string> read_headline(const TableReader& table, Draft& draft,
                                       const ScriptState* state);

// The rulers of a step.
std::vector<RulerSpec> read_rulers(const TableReader& step, ScriptReading& script);

// The step's `code`. Adds a problem for a function or line that the lecture's source has not.
void read_code(const TableReader& step, Step& to, Draft& draft);

// Can the chart's counts be counted at this step?
void check_plot(const TableReader& step, Draft& draft, ScriptState& state);

// A verb with its own keys, what it means and an example, and how a step with it is read.
struct VerbDoc {
  TableDoc table;
  VerbTraits traits;
  std::function<Verb(const TableReader& table, ScriptReading& script)> read;
};

// `read` fills what the keys do not fill by themselves, and tells mistakes.
template <class V>
VerbDoc verb(std::string_view doc, std::vector<KeyDoc> keys = {},
             void (*read)(V& verb, const TableReader& table, ScriptReading& script) = nullptr,
             KeyGroups groups = {}) {
  return {{.doc = doc, .keys = std::move(keys), .groups = std::move(groups)},
          V::kTraits,
          [read](const TableReader& table, ScriptReading& script) {
            V verb;
            table.fill(verb);
            if (read) read(verb, table, script);
            return Verb(std::move(verb));
          }};
}

// In the order of the reference page.
std::span<const VerbDoc> known_verbs();

// The parts of that list.
std::vector<VerbDoc> verbs_of_bodies(), verbs_of_time(), verbs_of_structures(), verbs_of_levels(),
    verbs_of_atlases();

}  // namespace lantern::language
