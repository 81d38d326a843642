// What a scenario quotes of what is counted: in captions, in its chart, in a headline.
#include <algorithm>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/printable.hpp"
#include "base/words.hpp"
#include "language/script/script_reading.hpp"

namespace lantern::language {
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
  const std::string_view rest = caption.substr(at);
  const char first = rest[0];
  if (first != '{' && first != '}') {
    const std::string_view plain = rest.substr(0, rest.find_first_of("{}"));
    return {Piece::Kind::plain, at, plain, plain};
  }
  if (rest.size() > 1 && rest[1] == first)
    return {Piece::Kind::plain, at, rest.substr(0, 2), rest.substr(0, 1)};
  const std::size_t end = rest.find_first_of("{}", 1);
  if (first == '}' || end == std::string_view::npos || rest[end] == '{')
    return {Piece::Kind::lone_brace, at, rest.substr(0, 1), {}};
  return {Piece::Kind::placeholder, at, rest.substr(0, end + 1), rest.substr(1, end - 1)};
}

// "pairs:pair" and "leaves:leaf/leaves" in their parts.
struct Parts {
  std::string_view name;
  std::optional<std::string_view> nouns = {};
};

Parts parts_of(std::string_view inside) {
  Parts parts;
  const std::size_t colon = inside.find(':');
  parts.name = inside.substr(0, colon);
  if (colon == std::string_view::npos) return parts;
  parts.nouns = inside.substr(colon + 1);
  return parts;
}

// Is one of the forms empty?
bool has_gap(std::string_view nouns) {
  return nouns.empty() || nouns.front() == '/' || nouns.back() == '/' ||
         nouns.find("//") != nouns.npos;
}

std::string with_noun(std::int64_t n, const Parts& parts) {
  if (!parts.nouns) return grouped(n);
  const bool adds_s = parts.nouns->find('/') == std::string_view::npos && n != 1;
  return fmt::format("{} {}{}", grouped(n), own_noun(*parts.nouns, n), adds_s ? "s" : "");
}

void for_each_piece(std::string_view caption, auto&& f) {
  for (std::size_t at = 0; at < caption.size();) {
    const Piece piece = next_piece(caption, at);
    f(piece);
    at += piece.written.size();
  }
}

constexpr std::size_t kMostWords = 48;  // letters of a number's own, for one and for many
constexpr std::size_t kMostNoted = 64;  // each costs time on every frame

// Names that can be counted or quoted here, for suggestions.
std::vector<std::string_view> quotable(const ScriptPast& past) {
  std::vector<std::string_view> names;
  for (const auto docs : {known_counts(), known_texts(), known_measures()})
    for (const CountDoc& doc : docs)
      if (why_not_counted(doc, past).empty()) names.push_back(doc.name);
  return names;
}

// The place of a byte of a text that is written on one line without escapes; otherwise the place of
// the text.
Place place_within(std::string_view file, Place where, std::string_view text, std::size_t offset) {
  const std::string line = line_of(file, where.line);
  std::size_t at = 0;
  for (int column = 1; column < where.column && at < line.size(); ++column) do
      ++at;
    while (at < line.size() && (line[at] & 0xc0) == 0x80);
  const std::string_view before = text.substr(0, offset);
  if (at + 1 >= line.size() || !std::string_view(line).substr(at + 1).starts_with(before))
    return where;
  return {where.line, where.column + 1 + static_cast<int>(letters(before))};
}

bool is_of_other_side(std::string_view written, const Draft& draft) {
  const std::string_view side = side_of(written, draft.sides);
  return !side.empty() && side != draft.scenario.side;
}

// The row of a name that a caption may quote; null if there is none.
const CountDoc* find_quotable(std::string_view name) {
  const CountDoc* doc = find_count(name);
  return doc ? doc : find_in(known_texts(), name);
}

void tell_not_counted(const Named& number, const std::string& why, Draft& draft) {
  draft.problems.add(number.where, fmt::format("'{}' is not counted here: {}", number.name, why));
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
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
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
    else if (kind == Placeholder::text && parts.nouns)
      problems.push_back({piece.offset,
                          fmt::format("'{}' is a text, not a count: it takes no noun", parts.name),
                          {}});
    else if (parts.nouns && has_gap(*parts.nouns))
      problems.push_back({piece.offset, "a placeholder whose noun is missing", {}});
  });
  return problems;
}

bool check_counted(const Named& written, Draft& draft, const ScriptState* state) {
  if (is_of_other_side(written.name, draft)) return true;
  const Named number{std::string(within_side(written.name, draft.sides)), written.where};
  if (is_of_body(number.name))
    return note_body_measure(number, draft, state ? &state->past : nullptr).has_value();
  const CountDoc* doc = find_count(number.name);
  if (!doc) {
    draft.problems.add_unknown(number.where, "count or measure", number.name, names_of_counts);
    return false;
  }
  const std::string why = state ? why_not_counted(*doc, state->past) : "";
  if (!why.empty()) tell_not_counted(number, why, draft);
  return why.empty();
}

std::vector<std::string> read_headline(const TableReader& table, Draft& draft,
                                       const ScriptState* state) {
  std::vector<std::string> names;
  const std::vector<Named> written = table.names("headline");
  for (const Named& number : written) {
    const auto& [name, words] = fronted(number.name);
    if (!check_counted({name, number.where}, draft, state)) continue;
    if (std::ranges::find(names, name, [](const auto& n) { return fronted(n).name; }) !=
        names.end())
      draft.problems.add(number.where,
                         fmt::format("{} stands twice in 'headline'", in_quotes(name)));
    const bool has_words = !has_gap(words);
    if (number.name.size() > name.size() && !has_words)
      draft.problems.add(number.where, fmt::format("words of {} are missing", in_quotes(name)),
                         "as \"pairs: pair left/pairs left\", or \"all_pairs: by brute force\"");
    else if (letters(words) > kMostWords)
      draft.problems.add(number.where,
                         fmt::format("more than {} letters for {}", kMostWords, in_quotes(name)));
    names.push_back(number.name);
  }
  if (written.size() > kMostHeadline)
    table.bad_value("headline", fmt::format("{} numbers in a headline, the limit is {}",
                                            written.size(), kMostHeadline));
  return names;
}

void check_quotes(const TableReader& table, std::string_view key, Draft& draft,
                  const ScriptPast& past) {
  const std::string text = table.get<std::string>(key).value_or("");
  const auto known_here = [&](std::string_view written) {
    if (is_of_other_side(written, draft)) return Placeholder::count;
    const std::string_view name = within_side(written, draft.sides);
    if (is_of_body(name)) {
      const auto brace = static_cast<std::size_t>(written.data() - text.data()) - 1;
      const Place where = place_within(draft.text, table.place(key), text, brace);
      const auto noted = note_body_measure({std::string(name), where}, draft, &past);
      return !noted               ? Placeholder::unknown
             : is_counted(*noted) ? Placeholder::count
                                  : Placeholder::text;
    }
    const CountDoc* doc = find_quotable(name);
    if (!doc || !why_not_counted(*doc, past).empty()) return Placeholder::unknown;
    return find_in(known_counts(), name) ? Placeholder::count : Placeholder::text;
  };
  for (const CaptionProblem& p : caption_problems(text, known_here)) {
    const Place where = place_within(draft.text, table.place(key), text, p.offset);
    const std::string name(within_side(p.unknown, draft.sides));
    if (!p.message.empty())
      draft.problems.add(where, fmt::format("in '{}': {}", key, p.message),
                         "write {{ and }} for the braces themselves");
    else if (is_of_body(name))
      continue;  // told already
    else if (const CountDoc* doc = find_quotable(name))
      tell_not_counted({name, where}, why_not_counted(*doc, past), draft);
    else
      draft.problems.add(where, fmt::format("'{}' cannot quote {}", key, in_quotes(name)),
                         [name, known = quotable(past)] { return nearest(name, known); });
  }
}

void check_plot(const TableReader& step, Draft& draft, ScriptState& state) {
  if (step.has("plot")) state.has_plot = true;
  if (!step.is_good("plot")) return;
  const auto& chart = draft.scenario.chart;
  if (!chart)
    return step.bad_key("plot", "'plot' needs a [chart], the scenario has none",
                        "add [chart] with bars = \"pairs\"");
  if (chart->over_time())
    return step.bad_key("plot", "over time every frame is plotted by itself", "leave out 'plot'");
  std::vector<std::string> counts = chart->y;
  if (!chart->x.empty()) counts.push_back(chart->x);
  for (const std::string& count : counts) {
    const CountDoc* doc = find_count(count);
    const std::string why = doc ? why_not_counted(*doc, state.past) : "";
    if (!why.empty())
      step.bad_key("plot", fmt::format("the chart's '{}' is not counted here: {}", count, why));
  }
}

std::optional<BodyMeasure> note_body_measure(const Named& name, Draft& draft,
                                             const ScriptPast* past) {
  const std::size_t dot = name.name.find('.');
  const std::string measure = name.name.substr(0, dot);
  const CountDoc* doc = find_in(known_body_measures(), measure);
  if (!doc) {
    draft.problems.add(
        name.where,
        draft.sides.empty()
            ? fmt::format("there is no measure {} of a body", in_quotes(measure))
            : fmt::format("there is no side {0}, and no measure {0} of a body", in_quotes(measure)),
        [measure, &sides = draft.sides] {
          std::vector<std::string_view> known(sides.begin(), sides.end());
          for (const CountDoc& k : known_body_measures()) known.push_back(k.name);
          return nearest(measure, known);
        });
    return std::nullopt;
  }
  const auto what = static_cast<BodyMeasure>(doc - known_body_measures().data());
  const std::string why = !is_counted(what)
                              ? why_not_measured(*doc, {draft.scenario, draft.dimension})
                          : past ? why_not_counted(*doc, *past)
                                 : "";
  if (!why.empty()) {
    draft.problems.add(name.where, fmt::format("'{}' is not {} here: {}", name.name,
                                               is_counted(what) ? "counted" : "measured", why));
    return std::nullopt;
  }
  const auto body = one_body({name.name.substr(dot + 1), name.where}, draft);
  if (!body) return std::nullopt;
  std::vector<BodyMeasureSpec>& noted = draft.scenario.body_measures;
  if (std::ranges::find(noted, name.name, &BodyMeasureSpec::name) != noted.end()) return what;
  if (noted.size() == kMostNoted) {
    draft.problems.add(name.where,
                       fmt::format("more than {} measures of single bodies", kMostNoted));
    return std::nullopt;
  }
  noted.push_back({name.name, what, *body});
  return what;
}

}  // namespace lantern::language
