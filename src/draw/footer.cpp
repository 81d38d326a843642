#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "draw/font.hpp"
#include "draw/notes.hpp"
#include "draw/panels.hpp"

namespace lantern::draw {
namespace {

constexpr double kCaption = 30;
constexpr double kLine = 46;        // from baseline to baseline
constexpr double kBelowLast = 54;   // from the last baseline to the page's edge
constexpr double kAboveFirst = 52;  // from the hairline to the first baseline
constexpr double kWidePage = 1400;  // a narrower page has its counters under the caption

// A number and what it counts; `widest` is the longest that `noun` can get.
struct Counter {
  std::string name;  // of the count
  std::int64_t number = 0;
  std::string noun;
  std::string widest = {};
  bool main = false;

  TextStyle style() const {
    return main ? TextStyle{30, Weight::semibold, Role::ink}
                : TextStyle{25, Weight::regular, Role::quiet_ink};
  }
  double noun_width() const {
    const TextStyle s = style();
    return std::max(text_width(noun, s), text_width(widest, s));
  }
  // Room for four digits at least, so that the number may grow without moving anything.
  double number_room() const {
    const auto digits = static_cast<std::int64_t>(fmt::format("{}", number).size());
    return Labels::number_width(std::max<std::int64_t>(4, digits), style());
  }
};

Counter counted(const char* name, std::int64_t number, const char* one, const char* many) {
  return {name, number, number == 1 ? one : many, many};
}

// Two at most; the first is the main one.
std::vector<Counter> counters_of(const Frame& frame) {
  if (!frame.sides.empty()) return {};  // each counts under itself
  const auto count = [&](const char* name) { return frame.count(name).value_or(0); };
  if (!frame.textures.empty()) {
    const std::int64_t used = count("used_area");
    const std::int64_t all = std::max<std::int64_t>(1, count("atlas_area"));
    auto percent = static_cast<std::int64_t>(std::llround(100.0 * double(used) / double(all)));
    if (used > 0 && used < all) percent = std::clamp<std::int64_t>(percent, 1, 99);
    return {{"used_area", percent, "% used"},
            {"textures", count("textures"), fmt::format("of {} textures", frame.textures.size())}};
  }
  // Of a ray, view or region: how few bodies it had to test.
  if (!frame.rays.empty() || !frame.views.empty() || !frame.queries.empty())
    return {{"objects_tested", count("objects_tested"),
             fmt::format("of {} bodies tested", frame.bodies.size())},
            counted("hits", count("hits"), "hit", "hits")};
  if (frame.count("sectors"))
    return {counted("sectors", count("sectors"), "sector", "sectors"),
            counted("walls", count("walls"), "wall", "walls")};
  std::vector<Counter> counters;
  const auto pairs = frame.count("pairs"), bodies = frame.count("bodies");
  // With contacts only those of them are tested whose boxes overlap.
  if (pairs && frame.count("contacts"))
    counters.push_back(counted("pairs", *pairs, "candidate pair", "candidate pairs"));
  else if (pairs)
    counters.push_back(counted("pairs", *pairs, "pair to test", "pairs to test"));
  else if (bodies)
    counters.push_back(counted("bodies", *bodies, "body", "bodies"));
  if (const auto all = frame.count("testable_pairs"); all && !counters.empty())
    counters.push_back(pairs ? Counter{"testable_pairs", *all, "by brute force"}
                             : counted("testable_pairs", *all, "pair", "pairs"));
  return counters;
}

// A count that a note is about stands there, too: instead of the last, if need be.
void add_noted(const Frame& frame, std::vector<Counter>& counters) {
  constexpr std::size_t kMost = 2;
  for (const FrameNote& note : frame.notes) {
    const auto number = frame.count(note.count);
    if (note.of != NoteOf::count || !number) continue;
    if (std::ranges::count(counters, note.count, &Counter::name) > 0) continue;
    if (counters.size() == kMost) counters.pop_back();
    counters.push_back({note.count, *number, chart_words(note.count)});
  }
}

// Where the counter stands, for notes.
void tell_place(const Counter& counter, double noun_left, double baseline, Labels& labels) {
  if (!labels.has_notes()) return;
  const TextStyle style = counter.style();
  const auto digits = static_cast<std::int64_t>(fmt::format("{}", counter.number).size());
  const double left = noun_left - 9 - Labels::number_width(digits, style);
  const Box<2> noun = Labels::extent(counter.noun, {{noun_left, baseline}, 0}, style);
  labels.tell_place(target_of_count(counter.name), {{left - 4, noun.lo.y - 6}, noun.hi});
}

// One below the other; the longest form of each ends at the margin. Gives the left end.
double draw_column(const std::vector<Counter>& counters, const Box<2>& band, double baseline,
                   Labels& labels) {
  double left = band.hi.x;
  for (const Counter& counter : counters) {
    const double x = band.hi.x - counter.noun_width();
    labels.add_number(counter.number, {x - 9, baseline}, counter.style(), band);
    labels.add(counter.noun, {{x, baseline}, 0}, counter.style(), band);
    tell_place(counter, x, baseline, labels);
    left = std::min(left, x - 9 - counter.number_room());
    baseline += kLine;
  }
  return left;
}

// All in one row that ends at the right.
void draw_row(const std::vector<Counter>& counters, const Box<2>& band, double baseline,
              Labels& labels) {
  double x = band.hi.x;
  for (auto counter = counters.rbegin(); counter != counters.rend(); ++counter) {
    x -= counter->noun_width();
    labels.add(counter->noun, {{x, baseline}, 0}, counter->style(), band);
    tell_place(*counter, x, baseline, labels);
    labels.add_number(counter->number, {x - 9, baseline}, counter->style(), band);
    x -= 9 + counter->number_room() + 16;
  }
}

// Two lines broken after a sentence, if both halves have room.
std::optional<std::vector<std::string>> by_sentence(const std::string& text, double width,
                                                    const TextStyle& style) {
  std::optional<std::vector<std::string>> best;
  double evenness = 1e300;
  for (std::size_t at = text.find(". "); at != std::string::npos; at = text.find(". ", at + 1)) {
    const std::string first = text.substr(0, at + 1), second = text.substr(at + 2);
    const double longer = std::max(text_width(first, style), text_width(second, style));
    if (longer > width || longer >= evenness) continue;
    evenness = longer;
    best = {first, second};
  }
  return best;
}

std::vector<std::string> caption_lines(const std::string& caption, double width, TextStyle& style) {
  std::string text = caption;
  std::ranges::replace(text, '\n', ' ');
  for (style.size = kCaption; style.size > kLeastCaption; style.size -= 1.1) {
    std::vector<std::string> lines = wrapped(text, width, style);
    if (lines.size() < 2) return lines;
    if (const auto sentences = by_sentence(text, width, style)) return *sentences;
    if (lines.size() == 2) return lines;
  }
  style.size = kLeastCaption;
  std::vector<std::string> lines = wrapped(text, width, style);
  if (lines.size() <= 2) return lines;
  const std::size_t rest = text.find(lines[1], lines[0].size());
  return {lines[0], shortened(std::string_view(text).substr(rest), width, style)};
}

}  // namespace

double draw_footer(const Frame& frame, double margin, DrawList& list, Labels& labels) {
  const bool wide = list.page.x >= kWidePage;
  if (!frame.display.caption && !frame.display.counters) return list.page.y - 26;
  std::vector<Counter> counters;
  if (frame.display.counters) {
    counters = counters_of(frame);
    add_noted(frame, counters);
  }
  if (!counters.empty()) counters[0].main = true;
  const double row = wide ? 0 : kLine + 4;
  const double second = list.page.y - kBelowLast - row, first = second - kLine;
  const double top = first - kAboveFirst;
  const Box<2> band{{margin, top + 4}, {list.page.x - margin, list.page.y - 20}};
  double right = band.hi.x;
  if (wide)
    right = draw_column(counters, band, first, labels) - 40;
  else
    draw_row(counters, band, list.page.y - kBelowLast + 6, labels);
  TextStyle style{kCaption, Weight::regular, Role::ink};
  double baseline = first;
  if (!frame.display.caption) return top;
  for (const std::string& line : caption_lines(frame.caption, right - band.lo.x, style)) {
    labels.add(line, {{band.lo.x, baseline}, 0}, style, band);
    baseline += kLine;
  }
  return top;
}

}  // namespace lantern::draw
