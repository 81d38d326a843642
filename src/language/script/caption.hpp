// Captions quote what the engine counted. Placeholders stand in braces:
//   {pairs}               the count: "2"
//   {pairs:pair}          the count and its noun, singular or plural: "1 pair", "2 pairs"
//   {leaves:leaf/leaves}  the same for an irregular plural
//   {texture}             a text
//   {{ and }}             the braces themselves
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lantern::language {

using TextLookup = std::function<std::optional<std::string>(std::string_view name)>;
using CountLookup = std::function<std::optional<std::int64_t>(std::string_view name)>;

// The caption with its placeholders filled in, texts looked up before counts. A placeholder that
// neither knows, and a brace that stands alone, are left as they are written.
std::string fill_caption(std::string_view caption, const TextLookup& text,
                         const CountLookup& count);

// The names that its placeholders quote, each once, in order.
std::vector<std::string> placeholders_of(std::string_view caption);

struct CaptionProblem {
  std::size_t offset = 0;  // in bytes, of what is wrong
  std::string message;     // empty if the only fault is that nobody knows `unknown`
  std::string unknown;     // a placeholder's name
};

// What placeholders are there.
enum class Placeholder { unknown, text, count };

// All mistakes in a caption, in order; none if it can be filled in.
std::vector<CaptionProblem> caption_problems(
    std::string_view caption, const std::function<Placeholder(std::string_view name)>& kind_of);

}  // namespace lantern::language
