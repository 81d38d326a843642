// The script of a scenario while it is being read: what is where at each point of it.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenario/draft.hpp"

namespace lantern {

// What steps have brought about so far, as far as it can be known without the engine.
struct ScriptState {
  std::vector<bool> in_world;  // by index of the body
  std::vector<bool> packed;    // by index of the texture; refused ones, too
  StructureSpec structure;     // as it stands
  bool asked_for_room = false;
  std::uint64_t frames = 0;  // in step pace
  std::size_t named = 0;     // bodies and textures, over all steps
};

// Why the scenario cannot count `name` at this point; empty if it can. `name` is a known count or,
// in a caption, a known text.
std::string why_not_counted(std::string_view name, const Draft& draft, const ScriptState& state);

// An `expect` or `always` table.
std::vector<Expectation> read_expectations(const TomlValue& value, std::string_view called,
                                           Draft& draft, const ScriptState& state);

// Adds a problem for each placeholder that cannot be filled in.
void check_caption(const TableReader& step, Draft& draft, const ScriptState& state);

}  // namespace lantern
