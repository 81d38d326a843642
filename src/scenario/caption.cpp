#include "scenario/caption.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/grouped.hpp"

namespace lantern::scenario {
namespace {

// A stretch of a caption: plain letters, a placeholder with what stands between its braces, or a
// brace that has no partner.
struct Piece {
  enum class Kind { plain, placeholder, lone_brace };
  Kind kind{};
  std::size_t offset = 0;
  std::string_view written;  // with its braces
  std::string_view inside;   // of plain text, the text; of a placeholder, without its braces
};

Piece next_piece(std::string_view caption, std::size_t at) {
  using Kind = Piece::Kind;
  const std::string_view rest = caption.substr(at);
  const char first = rest[0];
  if (first != '{' && first != '}') {
    const std::string_view plain = rest.substr(0, rest.find_first_of("{}"));
    return {Kind::plain, at, plain, plain};
  }
  if (rest.size() > 1 && rest[1] == first)
    return {Kind::plain, at, rest.substr(0, 2), rest.substr(0, 1)};
  const std::size_t end = rest.find_first_of("{}", 1);
  if (first == '}' || end == std::string_view::npos || rest[end] == '{')
    return {Kind::lone_brace, at, rest.substr(0, 1), {}};
  return {Kind::placeholder, at, rest.substr(0, end + 1), rest.substr(1, end - 1)};
}

// "pairs:pair" and "leaves:leaf/leaves" in their parts.
struct Parts {
  std::string_view name;
  std::optional<std::string_view> one;
  std::optional<std::string_view> many;
};

Parts parts_of(std::string_view inside) {
  Parts parts;
  const std::size_t colon = inside.find(':');
  parts.name = inside.substr(0, colon);
  if (colon == std::string_view::npos) return parts;
  const std::string_view nouns = inside.substr(colon + 1);
  const std::size_t slash = nouns.find('/');
  parts.one = nouns.substr(0, slash);
  if (slash != std::string_view::npos) parts.many = nouns.substr(slash + 1);
  return parts;
}

std::string with_noun(std::int64_t n, const Parts& parts) {
  if (!parts.one) return grouped(n);
  if (n == 1) return fmt::format("1 {}", *parts.one);
  if (parts.many) return fmt::format("{} {}", grouped(n), *parts.many);
  return fmt::format("{} {}s", grouped(n), *parts.one);
}

template <class F>
void for_each_piece(std::string_view caption, F&& f) {
  for (std::size_t at = 0; at < caption.size();) {
    const Piece piece = next_piece(caption, at);
    f(piece);
    at += piece.written.size();
  }
}

}  // namespace

std::string fill_caption(std::string_view caption, const TextLookup& text,
                         const CountLookup& count) {
  std::string filled;
  for_each_piece(caption, [&](const Piece& piece) {
    if (piece.kind == Piece::Kind::plain) {
      filled += piece.inside;
      return;
    }
    const Parts parts = parts_of(piece.inside);
    const auto words = text ? text(parts.name) : std::nullopt;
    const auto number = count && !words ? count(parts.name) : std::nullopt;
    if (words)
      filled += *words;
    else
      filled += number ? with_noun(*number, parts) : std::string(piece.written);
  });
  return filled;
}

std::vector<std::string> placeholders_of(std::string_view caption) {
  std::vector<std::string> names;
  for_each_piece(caption, [&](const Piece& piece) {
    if (piece.kind != Piece::Kind::placeholder) return;
    std::string name(parts_of(piece.inside).name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  });
  return names;
}

std::vector<CaptionProblem> caption_problems(
    std::string_view caption, const std::function<Placeholder(std::string_view name)>& kind_of) {
  std::vector<CaptionProblem> problems;
  for_each_piece(caption, [&](const Piece& piece) {
    if (piece.kind == Piece::Kind::plain) return;
    if (piece.kind == Piece::Kind::lone_brace) {
      const char* message =
          piece.written == "{" ? "a '{' without its '}'" : "a '}' without its '{'";
      problems.push_back({piece.offset, message, {}});
      return;
    }
    const Parts parts = parts_of(piece.inside);
    const Placeholder kind = kind_of(parts.name);
    if (parts.name.empty())
      problems.push_back({piece.offset, "an empty placeholder", {}});
    else if (kind == Placeholder::unknown)
      problems.push_back({piece.offset, {}, std::string(parts.name)});
    else if (kind == Placeholder::text && parts.one)
      problems.push_back({piece.offset,
                          fmt::format("'{}' is a text, not a count: it takes no noun", parts.name),
                          {}});
    else if ((parts.one && parts.one->empty()) || (parts.many && parts.many->empty()))
      problems.push_back({piece.offset, "a placeholder whose noun is missing", {}});
  });
  return problems;
}

}  // namespace lantern::scenario
