#include "language/code_text.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/ranges.hpp"
#include "lecture/source.hpp"

namespace lantern::language {
namespace {

// A statement, or the head of one, of a file.
struct SourceLine {
  std::uint32_t number = 0;  // in the file, from 1
  std::size_t spaces = 0;    // before it
  std::string text;
};

constexpr std::size_t kIndent = 2;  // spaces of a level
// What this program adds to the lecture's functions so that it can look and be stopped.
constexpr std::array<std::string_view, 2> kAddedCalls = {"watch.", "stop_if_asked("};

std::string_view stripped(std::string_view text) {
  const std::size_t from = text.find_first_not_of(' ');
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(' ') + 1 - from);
}

std::ptrdiff_t depth_after(std::string_view text, char open, char close) {
  return std::ranges::count(text, open) - std::ranges::count(text, close);
}

// Does its statement go on in the next line?
bool goes_on(std::string_view text) {
  if (text.ends_with('{') || text.ends_with(';') || text.ends_with('}')) return false;
  if (depth_after(text, '(', ')') > 0) return true;
  for (const std::string_view end : {",", "=", "&&", "||", "+", "-"})
    if (text.ends_with(end)) return true;
  return false;
}

// The lines of a file without comments, each statement in one.
std::vector<SourceLine> statements_of(std::string_view file) {
  std::vector<SourceLine> lines;
  std::uint32_t number = 0;
  bool open = false;  // the last one goes on
  while (!file.empty()) {
    const std::size_t end = std::min(file.find('\n'), file.size());
    const std::string_view whole = file.substr(0, std::min(end, file.find("//")));
    file.remove_prefix(std::min(end + 1, file.size()));
    ++number;
    const std::string_view text = stripped(whole);
    if (text.empty() || text.starts_with('#')) continue;
    if (open)
      lines.back().text.append(" ").append(text);
    else
      lines.push_back({number, whole.find_first_not_of(' '), std::string(text)});
    open = goes_on(lines.back().text);
  }
  return lines;
}

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == ':' || c == '~' || c == '<';  // of an operator
}

// The last name of what stands before `end`: "Insert" of "void Insert".
std::string_view name_before(std::string_view text, std::size_t end) {
  std::size_t from = end;
  while (from > 0 && is_name(text[from - 1])) --from;
  return text.substr(from, end - from);
}

// "QuadTreeNode" of "class QuadTreeNode {"; empty of anything else.
std::string_view class_of(std::string_view head) {
  for (const std::string_view word : {"class ", "struct "})
    if (head.starts_with(word))
      return name_before(head, std::min(head.find(' ', word.size()), head.size()));
  return {};
}

// What it opens a body of: "QuadTreeNode::Insert"; empty if that is no function.
std::string function_of(std::string_view head, std::string_view in_class) {
  if (!head.ends_with('{') || !class_of(head).empty() || head.starts_with("namespace")) return {};
  const std::size_t bracket = head.find('(');
  if (bracket == head.npos) return {};
  const std::string_view name = name_before(head, bracket);
  if (name.empty() || in_class.empty()) return std::string(name);
  return std::string(in_class).append("::").append(name);
}

std::vector<CodeText> functions_of(const lecture::SourceFile& file) {
  std::vector<CodeText> functions;
  const std::vector<SourceLine> lines = statements_of(file.text);
  std::vector<std::pair<std::string_view, std::size_t>> classes;  // open ones, and where they stand
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const SourceLine& head = lines[i];
    while (!classes.empty() && head.spaces <= classes.back().second) classes.pop_back();
    if (const auto name = class_of(head.text); !name.empty() && head.text.ends_with('{'))
      classes.emplace_back(name, head.spaces);
    const std::string name =
        function_of(head.text, classes.empty() ? std::string_view() : classes.back().first);
    if (name.empty()) continue;
    CodeText code{std::string(file.name), name, {}};
    std::ptrdiff_t depth = 0;
    for (; i < lines.size(); ++i) {
      const SourceLine& line = lines[i];
      depth += depth_after(line.text, '{', '}');
      if (std::ranges::none_of(kAddedCalls,
                               [&](std::string_view call) { return line.text.starts_with(call); }))
        code.lines.push_back({line.number,
                              static_cast<std::uint32_t>((line.spaces - head.spaces) / kIndent),
                              line.text, false});
      if (depth <= 0) break;
    }
    functions.push_back(std::move(code));
  }
  return functions;
}

const std::vector<CodeText>& all_functions() {
  static const std::vector<CodeText> all = [] {
    std::vector<CodeText> found;
    for (const lecture::SourceFile& file : lecture::own_source())
      for (CodeText& code : functions_of(file)) found.push_back(std::move(code));
    return found;
  }();
  return all;
}

constexpr std::pair<std::string_view, CodePlace> kPlaces[] = {
    {"test", {"QuadTreeNode::Insert", "Reached(objectPos, objectSize)"}},
    {"miss", {"QuadTreeNode::Insert", "if (!reached) return;"}},
    {"store", {"QuadTreeNode::Insert", "contents.push_back("}},
    {"split", {"QuadTreeNode::Insert", "Split("}},
    {"make_child", {"QuadTreeNode::Split", "children["}},
    {"hand_down", {"QuadTreeNode::Insert", "for (const auto& entry : contents)"}},
    {"depth_limit", {"QuadTreeNode::Insert", "depthLeft > 0"}},
    {"broad_phase", {"PhysicsSystem::BroadPhase", "AddBroadphaseCollision("}},
    {"narrow_phase", {"PhysicsSystem::NarrowPhase", "ObjectIntersection("}},
    {"solve", {"PhysicsSystem::ImpulseResolveCollision", "ApplyLinearImpulse("}},
};

}  // namespace

std::optional<CodeText> code_of(std::string_view function) {
  for (const CodeText& code : all_functions()) {
    const std::string_view name = code.function;
    const bool called_so = name.ends_with(function) && name.size() > function.size() + 2 &&
                           name.substr(0, name.size() - function.size()).ends_with("::");
    if (name == function || called_so) return code;
  }
  return std::nullopt;
}

std::vector<std::string> code_functions() { return mapped(all_functions(), &CodeText::function); }

std::vector<std::uint32_t> CodeText::lit() const {
  std::vector<std::uint32_t> numbers;
  for (const Line& line : lines)
    if (line.lit) numbers.push_back(line.number);
  return numbers;
}

std::size_t light_line(CodeText& code, std::string_view text) {
  std::size_t found = 0;
  for (CodeText::Line& line : code.lines) {
    line.lit = !text.empty() && line.text.find(text) != line.text.npos;
    found += line.lit;
  }
  return found;
}

std::optional<CodePlace> code_place(std::string_view event) {
  for (const auto& [name, place] : kPlaces)
    if (name == event) return place;
  return std::nullopt;
}

}  // namespace lantern::language
