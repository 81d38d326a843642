#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/words.hpp"
#include "draw/font.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "frame/parts/asked.hpp"

namespace lantern::draw {
namespace {

constexpr double kCaption = 30, kEnding = 34;
constexpr double kLine = 46;        // from baseline to baseline
constexpr double kNarrowLine = 34;  // the same on a narrow page
constexpr double kBelowLast = 54;   // from the last baseline to the page's edge
constexpr double kAboveFirst = 52;  // from the hairline to the first baseline
constexpr double kWidePage = 1400;  // a narrower page has its counters under the caption

// A number and what it counts; `widest` is the longest that `noun` can get.
struct Counter {
  std::string number;
  std::string noun;
  std::string widest = {};
  std::vector<std::string> depicts = {};  // counts and measures
  bool main = false;
  bool told = false;                       // the caption speaks of it
  std::optional<std::int64_t> whole = {};  // the number, if it counts

  TextStyle style() const {
    if (main) return {30, Weight::semibold, Role::ink};
    return {25, told ? Weight::semibold : Weight::regular, told ? Role::ink : Role::quiet_ink};
  }
  double noun_width() const { return noun_width(style()); }
  double noun_width(const TextStyle& s) const {
    return std::max(text_width(noun, s), text_width(widest, s));
  }
  // Room for four digits at least, so that the number may grow without moving anything.
  double number_room() const { return std::max(Labels::number_width(4, style()), number_width()); }
  double number_width() const {
    return whole ? Labels::width_of(*whole, style()) : text_width(number, style());
  }
};

Counter counted(std::int64_t number, std::string noun, std::string widest,
                std::vector<std::string> depicts) {
  return {.number = grouped(number),
          .noun = std::move(noun),
          .widest = std::move(widest),
          .depicts = std::move(depicts),
          .whole = number};
}

// With the words of its row.
Counter counted(std::int64_t number, const std::string& name) {
  return counted(number, count_words(name, number), count_words(name, kMany), {name});
}

// What it is about when nobody says so: two at most.
std::vector<Counter> default_counters(const Frame& frame) {
  if (!frame.sides.empty()) return {};  // each counts under itself
  const auto count = [&](const char* name) { return frame.count(name).value_or(0); };
  if (!frame.get<FrameTextures>().textures.empty()) {
    const std::int64_t used = count("used_area");
    const std::int64_t all = std::max<std::int64_t>(1, count("atlas_area"));
    auto percent = static_cast<std::int64_t>(std::llround(100.0 * double(used) / double(all)));
    if (used > 0 && used < all) percent = std::clamp<std::int64_t>(percent, 1, 99);
    const auto known =
        std::ranges::count_if(frame.get<FrameTextures>().textures, &frame::FrameTexture::has_come);
    return {counted(percent, word("% used"), "", {}),
            counted(count("textures"), say("of {} textures", known), "", {"textures"})};
  }
  // Of a ray, view or region: how few bodies it had to test.
  if (!frame.get<FrameFinding>().rays.empty() || !frame.get<FrameFinding>().views.empty() ||
      !frame.get<FrameFinding>().queries.empty())
    return {counted(count("objects_tested"), say("of {} bodies tested", frame.bodies.size()), "",
                    {"objects_tested", "bodies"}),
            counted(count("hits"), "hits")};
  if (frame.count("sectors"))
    return {counted(count("sectors"), "sectors"), counted(count("walls"), "walls")};
  std::vector<Counter> counters;
  const auto pairs = frame.count("pairs"), bodies = frame.count("bodies");
  const auto add = [&](std::int64_t n, const char* forms, const char* name) {
    counters.push_back(counted(n, noun(forms, n), noun(forms, kMany), {name}));
  };
  if (pairs)
    counters.push_back(counted(*pairs, "pairs"));
  else if (bodies)
    add(*bodies, "body/bodies", "bodies");
  if (const auto all = frame.count("testable_pairs"); all && !counters.empty())
    add(*all, pairs ? "by brute force" : "pair/pairs", "testable_pairs");
  return counters;
}

// Of a count or measure that the frame has; none otherwise. Under the sides stand the numbers of
// each; the foot puts some of them large in the end.
std::optional<Counter> counter_of(const std::string& name, const Frame& frame) {
  std::string what = name, of;
  if (!frame.sides.empty()) {
    const std::size_t dot = name.find('.');
    if (!frame.ending || dot == std::string::npos || !frame.side_named(name.substr(0, dot)))
      return std::nullopt;
    of = ", " + chart_words(name.substr(0, dot));
    what = name.substr(dot + 1);
  }
  const bool own_words = frame.words.contains(name);
  if (own_words) what = name, of.clear();
  if (const auto n = frame.count(name)) {
    for (Counter& known : default_counters(frame))
      if (!own_words && known.depicts == std::vector{name}) return std::move(known);
    return counted(*n, count_words(frame, what, *n) + of, count_words(frame, what, kMany) + of,
                   {name});
  }
  if (const auto number = frame.measure(name))
    return Counter{say("{:.4g}", *number), count_words(frame, what, kMany) + of, "", {name}};
  return std::nullopt;
}

// Three at most: those that the scenario puts in front; else those that the caption tells, then the
// usual ones. The first is the main one.
std::vector<Counter> counters_of(const Frame& frame) {
  constexpr std::size_t kMost = 3, kMostUsual = 2;
  std::vector<Counter> counters;
  const auto has = [&](const std::string& name) {
    return std::ranges::any_of(counters, [&](const Counter& c) {
      return std::ranges::find(c.depicts, name) != c.depicts.end();
    });
  };
  const auto add = [&](const std::string& name) {
    if (counters.size() < kMost && !has(name))
      if (auto counter = counter_of(name, frame)) counters.push_back(std::move(*counter));
  };
  for (const std::string& name : frame.headline) add(name);
  for (const FrameNote& note : frame.notes)
    if (note.of == NoteOf::count) add(note.count);
  if (frame.headline.empty()) {
    for (const std::string& name : frame.told) add(name);
    for (Counter& usual : default_counters(frame))
      if (counters.size() < kMostUsual && (usual.depicts.empty() || !has(usual.depicts[0])))
        counters.push_back(std::move(usual));
  }
  for (Counter& counter : counters)
    counter.told = std::ranges::any_of(counter.depicts, [&](const std::string& name) {
      return std::ranges::find(frame.told, name) != frame.told.end();
    });
  if (!counters.empty()) counters[0].main = true;
  return counters;
}

// The number ends at `right`; each digit of a whole number has a cell of its own.
void draw_number(const Counter& counter, const TextStyle& style, const Vec<2>& right,
                 const Box<2>& band, Labels& labels) {
  if (counter.whole)
    labels.add_number(*counter.whole, right, style, band);
  else
    labels.add(counter.number, {right, 1}, style, band);
}

// Where the counter stands, for notes.
void tell_place(const Counter& counter, double noun_left, double baseline, Labels& labels) {
  if (!labels.has_notes() || counter.depicts.empty()) return;
  const TextStyle style = counter.style();
  const double left = noun_left - 9 - counter.number_width();
  const Box<2> noun = Labels::extent(counter.noun, {{noun_left, baseline}, 0}, style);
  labels.tell_place(target_of_count(counter.depicts[0]), {{left - 4, noun.lo.y - 6}, noun.hi});
}

// One below the other, like a table: numbers end where nouns begin, and the longest of these ends
// at the margin. Gives the left end.
double draw_column(const std::vector<Counter>& counters, const Box<2>& band, double baseline,
                   Labels& labels) {
  const bool three = counters.size() > 2;
  const double step = three ? 34 : kLine;
  double left = band.hi.x, y = three ? baseline - 12 : baseline;
  const double x = band.hi.x - greatest_of<double>(0, counters, [](const Counter& counter) {
                     return counter.noun_width();
                   });
  for (const Counter& counter : counters) {
    draw_number(counter, counter.style(), {x - 9, y}, band, labels);
    labels.add(counter.noun, {{x, y}, 0}, counter.style(), band);
    tell_place(counter, x, y, labels);
    left = std::min(left, x - 9 - counter.number_room());
    y += step;
  }
  return left;
}

// All in one row that ends at the right; what has no room is left out.
void draw_row(const std::vector<Counter>& counters, const Box<2>& band, double baseline,
              Labels& labels) {
  double x = band.hi.x;
  const auto width = [](const Counter& c) { return c.noun_width() + 9 + c.number_room() + 16; };
  double all = 0;
  std::size_t fit = 0;
  while (fit < counters.size() && all + width(counters[fit]) <= band.size().x + 16)
    all += width(counters[fit++]);
  for (std::size_t i = fit; i-- > 0;) {
    const Counter& counter = counters[i];
    x -= counter.noun_width();
    labels.add(counter.noun, {{x, baseline}, 0}, counter.style(), band);
    draw_number(counter, counter.style(), {x - 9, baseline}, band, labels);
    tell_place(counter, x, baseline, labels);
    x -= 9 + counter.number_room() + 16;
  }
}

// Of an ending: side by side, each large over its noun. Gives the left end.
double draw_large(std::vector<Counter> counters, const Box<2>& band, double baseline,
                  Labels& labels) {
  constexpr double kGap = 44, kMostOfBand = 0.55;  // the caption needs the rest
  const TextStyle large{52, Weight::semibold, Role::ink},
      small{25, Weight::regular, Role::quiet_ink};
  const auto width_of = [&](const Counter& counter) {
    return std::max(text_width(counter.number, large), counter.noun_width(small));
  };
  const auto is_wide = [&] {
    double all = -kGap;
    for (const Counter& counter : counters) all += width_of(counter) + kGap;
    return all > kMostOfBand * band.size().x;
  };
  // What is counted stands under the sides: their names say which is which.
  if (is_wide())
    for (Counter& counter : counters)
      if (const std::size_t comma = counter.noun.rfind(", "); comma != std::string::npos) {
        counter.noun.erase(0, comma + 2);
        counter.widest.clear();
      }
  while (counters.size() > 1 && is_wide()) counters.pop_back();
  double x = band.hi.x;
  for (std::size_t i = counters.size(); i-- > 0;) {
    const Counter& counter = counters[i];
    const double width = width_of(counter);
    labels.add(counter.number, {{x, baseline}, 1}, large, band);
    labels.add(counter.noun, {{x, baseline + 40}, 1}, small, band);
    x -= width + kGap;
  }
  return x + kGap;
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
  for (; style.size > kLeastCaption; style.size -= 1.1) {
    std::vector<std::string> lines = wrapped(text, width, style);
    if (lines.size() < 2) return lines;
    if (const auto sentences = by_sentence(text, width, style)) return *sentences;
    if (lines.size() == 2) return lines;
  }
  style.size = kLeastCaption;
  return two_lines(text, width, style);
}

}  // namespace

std::vector<std::string> counter_texts(const Frame& frame) {
  return mapped(counters_of(frame), [](const Counter& counter) {
    return fmt::format("{} {}", counter.number, counter.noun);
  });
}

double draw_footer(const Frame& frame, const Staging& staging, double margin, DrawList& list,
                   Labels& labels) {
  const bool wide = list.page.x >= kWidePage, narrow = list.page.x < kNarrowPage;
  constexpr double kBar = 8, kBesideBar = 20;
  const TextStyle small{kLeastCaption, Weight::regular, Role::ink};
  const double room = list.page.x - 2 * margin - kBar - kBesideBar;
  std::size_t lines = 2;
  if (narrow && frame.display.caption)
    for (const Frame* one : staging.frames())
      lines = std::max(lines, wrapped(one->caption, room, small).size());
  if (!frame.display.caption && !frame.display.counters) return list.page.y - 26;
  const double row = wide ? 0 : kLine + 4;
  const double line = narrow ? kNarrowLine : kLine;
  const double first = list.page.y - kBelowLast - row - line * static_cast<double>(lines - 1);
  const double top = first - kAboveFirst;
  const Box<2> band{{margin, top + 4}, {list.page.x - margin, list.page.y - 20}};
  const std::vector<Counter> counters =
      frame.display.counters ? counters_of(frame) : std::vector<Counter>();
  for (const Counter& counter : counters)
    list.referents.insert(counter.depicts.begin(), counter.depicts.end());
  double left = band.lo.x, right = band.hi.x;
  TextStyle style{kCaption, Weight::regular, Role::ink};
  if (frame.ending) {
    const double last = first + line * static_cast<double>(lines - 1);
    list.rect({{left, first - 36}, {left + kBar, last + 14}}, Role::lit, {}, kBar / 2);
    left += kBar + kBesideBar;
    style = {kEnding, Weight::semibold, Role::ink};
  }
  if (!wide)
    draw_row(counters, band, list.page.y - kBelowLast + 6, labels);
  else if (frame.ending)
    right = draw_large(counters, band, first + 6, labels) - 40;
  else
    right = draw_column(counters, band, first, labels) - 40;
  double baseline = first;
  if (!frame.display.caption) return top;
  if (narrow) style = small;
  for (const std::string& words : narrow ? wrapped(frame.caption, right - left, style)
                                         : caption_lines(frame.caption, right - left, style)) {
    labels.add(words, {{left, baseline}, 0}, style, band);
    baseline += line;
  }
  return top;
}

}  // namespace lantern::draw
