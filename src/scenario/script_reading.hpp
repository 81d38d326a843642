// The script of a scenario while it is being read: what is where at each point of it.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenario/draft.hpp"

namespace lantern::scenario {

// What steps have brought about so far, as far as it can be known without the engine.
struct ScriptState {
  std::vector<bool> in_world;      // by index of the body
  std::vector<std::uint64_t> due;  // the same: the world step by whose end it has entered
  std::vector<bool> packed;        // by index of the texture; refused ones, too
  StructureSpec structure;         // as it stands
  bool asked_for_room = false;
  std::size_t ways = 0;        // in which the screen was drawn
  bool queried = false;        // by a ray, cull or query
  bool shapes_tested = false;  // of all pairs
  bool separated = false;      // two bodies, axis by axis
  bool searched = false;       // for the distance of two bodies
  bool compiled = false;       // the level
  bool located = false;        // a point in it
  std::size_t rows_compared = 0;
  bool sighted = false;      // its sectors: who sees whom
  bool eyed = false;         // an eye looked
  bool has_plot = false;     // some step adds to the chart
  std::uint64_t frames = 0;  // in step pace
  std::uint64_t ticks = 0;   // world steps at most, and at least

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
    return state_.in_world[body] && state_.due[body] <= state_.least_ticks;
  }

 private:
  // Adds a problem if there is no such name, or if all steps together name too many.
  const NamedRange* find(const Named& named);

  Names& names_;
  const char* kind_;
  Problems& problems_;
  ScriptState& state_;
};

// What is at hand while a step's verb is read.
struct ScriptReading {
  Draft& draft;
  ScriptState& state;
  NameResolver bodies;
  NameResolver textures;
  std::uint64_t frames = 1;  // of the step, in step pace

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

// Why the scenario cannot count `name` at this point; empty if it can. `name` is a known count or
// measure or, in a caption, a known text.
std::string why_not_counted(std::string_view name, const Draft& draft, const ScriptState& state);

// An `expect` or `always` table.
std::vector<Expectation> read_expectations(const TomlValue& value, std::string_view called,
                                           Draft& draft, ScriptState& state);

// Adds a problem for each placeholder that cannot be filled in.
void check_caption(const TableReader& step, Draft& draft, const ScriptState& state);

// The same for the text of any key of a table.
void check_quotes(const TableReader& table, std::string_view key, Draft& draft,
                  const ScriptState& state);

// How a step is looked at: its display, view and camera; and its notes.
void read_look(const TableReader& step, Step& to, Draft& draft);
void read_notes(const TableReader& step, Step& to, Draft& draft, const ScriptState& state);

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

}  // namespace lantern::scenario
