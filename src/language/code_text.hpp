// The lecture's own source as frames show it: one function, and which of its lines something
// happens in. The text is that of the files that were compiled (lecture/source.hpp). By rule it is
// shown without comments, blank lines and what only this program's watchers and stops need, and
// with each statement on one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lantern::language {

// A function of the lecture's own source (lecture/source.hpp), and which of its lines are lit. A
// frame has it as one of its parts.
struct CodeText {
  static constexpr std::string_view kName = "code";
  static constexpr bool kIsObject = true;
  struct Line {
    std::uint32_t number = 0;  // in its file, from 1
    std::uint32_t indent = 0;  // levels, from the function's head on
    std::string text;
    bool lit = false;
  };
  std::string file;      // "quad_tree.hpp"
  std::string function;  // "QuadTreeNode::Insert"
  std::vector<Line> lines;

  std::vector<std::uint32_t> lit() const;  // their numbers

  static auto fields(auto& r, auto&& v) {
    return v("file", r.file)("function", r.function)
        .told("lit", [&r] { return r.lit(); })
        .drawn(r.lines);
  }
};

// The function of this name, "QuadTreeNode::Insert", or the first that is called so in some class,
// "Insert"; no line is lit. Nothing if there is none of more than one line.
std::optional<CodeText> code_of(std::string_view function);

// All names that code_of knows, with their classes.
std::vector<std::string> code_functions();

// Lights each line that has the text in it, and no other one; says how many.
std::size_t light_line(CodeText& code, std::string_view text);

struct CodePlace {
  std::string_view function;
  std::string_view line;
};

// Where the lecture's tree is when it tells of an event of an insertion ("store"), or the lecture's
// physics in a phase of a step ("narrow_phase"). Nothing for what the lecture does not do.
std::optional<CodePlace> code_place(std::string_view event);

}  // namespace lantern::language
