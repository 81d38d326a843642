// The lecture's own source as frames show it: one function, and which of its lines something
// happens in. The text is that of the files that were compiled (lecture/source.hpp). By rule it is
// shown without comments, blank lines and what only this program's watchers and stops need, and
// with each statement on one line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/frame.hpp"

namespace lantern::scenario {

// The function of this name, "QuadTreeNode::Insert", or the first that is called so in some class,
// "Insert"; no line is lit. Nothing if there is none of more than one line.
std::optional<FrameCode> code_of(std::string_view function);

// All names that code_of knows, with their classes.
std::vector<std::string> code_functions();

// Lights each line that has the text in it, and no other one; says how many.
std::size_t light_line(FrameCode& code, std::string_view text);

struct CodePlace {
  std::string_view function;
  std::string_view line;
};

// Where the lecture's tree is when it tells of an event of an insertion ("store"), or the lecture's
// physics in a phase of a step ("narrow_phase"). Nothing for what the lecture does not do.
std::optional<CodePlace> code_place(std::string_view event);

}  // namespace lantern::scenario
