#include "draw/sides_view.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "draw/count_words.hpp"
#include "draw/font.hpp"
#include "draw/panel.hpp"

namespace lantern::draw {
namespace {

constexpr double kBetweenSides = 56;
constexpr double kTitleHeight = 46, kTitleBaseline = 26;
constexpr double kNumbersHeight = 44, kNumbersBaseline = 36;
constexpr double kBetweenNumbers = 34;
constexpr double kWordsBaseline = 42, kWordsLine = 34;  // of what one side does alone
constexpr double kTallArea = 0.9;     // aspect below which sides stand one above the other
constexpr double kChartShare = 0.34;  // of the height, under all sides
constexpr double kChartUnderFour = 0.44;
constexpr std::size_t kMostNumbers = 3;
const TextStyle kNumber{28, Weight::semibold, Role::ink};
const TextStyle kNoun{24, Weight::regular, Role::quiet_ink};

// Where each side is, in reading order. Four over a chart stand in one row, or none had height.
std::vector<Box<2>> places_of(std::size_t sides, bool over_chart, const Box<2>& area) {
  const bool tall = area.size().x < kTallArea * area.size().y;
  const std::size_t columns = tall ? 1 : sides == 4 && !over_chart ? 2 : sides;
  std::vector<Box<2>> places;
  const std::size_t rows = (sides + columns - 1) / columns;
  for (const Box<2>& row : split(area, 1, std::vector(rows, 1.0), 20))
    for (const Box<2>& place : split(row, 0, std::vector(columns, 1.0), kBetweenSides))
      places.push_back(place);
  return places;
}

// Between neighbours of a row.
void draw_rules(const std::vector<Box<2>>& places, DrawList& list) {
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].lo.x > places[i - 1].hi.x) {
      const double x = places[i].lo.x - kBetweenSides / 2;
      list.crisp_line({x, places[i].lo.y}, {x, places[i].hi.y}, {Role::rule, 1.6});
    }
}

// Its title, and its time if that is not the others'.
void draw_title(const Frame& side, bool own_time, const Box<2>& place, Labels& labels) {
  const TextStyle bold{28, Weight::semibold, Role::ink};
  const TextStyle quiet{24, Weight::regular, Role::quiet_ink};
  const Box<2> line{place.lo, {place.hi.x, place.lo.y + kTitleHeight}};
  const double y = line.lo.y + kTitleBaseline;
  const std::string title = shortened(side.get<FrameSide>().title, place.size().x, bold);
  labels.add(title, {{line.lo.x, y}, 0}, bold, line);
  const double x = line.lo.x + text_width(title, bold) + 11;
  if (own_time)
    labels.add(shortened(fmt::format("·  {:.2f} s", side.time), line.hi.x - x, quiet), {{x, y}, 0},
               quiet, line);
}

// What each does that the others do not, at the page's foot: under its own column, or, where sides
// stand in rows, one below the other.
void draw_words(const Frame& frame, const std::vector<Box<2>>& places, const Box<2>& foot,
                Labels& labels) {
  const TextStyle style{24, Weight::regular, Role::ink};
  const bool columns = places.back().lo.y == places[0].lo.y;
  double y = foot.lo.y + kWordsBaseline;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Frame& side = frame.sides[i];
    if (side.get<FrameSide>().held || side.caption.empty()) continue;
    if (!columns) {
      if (y > foot.hi.y - 8) return;
      const std::string words = side.get<FrameSide>().title + ": " + side.caption;
      labels.add(shortened(words, foot.size().x, style), {{foot.lo.x, y}, 0}, style, foot);
      y += kWordsLine;
      continue;
    }
    const double left = places[i].lo.x, width = places[i].size().x;
    std::vector<std::string> lines = wrapped(side.caption, width, style);
    if (lines.size() > 2) {
      const std::size_t rest = side.caption.find(lines[1], lines[0].size());
      lines = {lines[0], shortened(std::string_view(side.caption).substr(rest), width, style)};
    }
    for (std::size_t k = 0; k < lines.size(); ++k)
      labels.add(lines[k], {{left, y + kWordsLine * static_cast<double>(k)}, 0}, style, foot);
  }
}

// A count or measure as it stands under each side; the words for one and for many.
struct SideNumber {
  std::string name;
  std::string one, many;

  double noun_width() const { return std::max(text_width(one, kNoun), text_width(many, kNoun)); }
};

// What structures, atlases and levels are about: of those that any side counts.
std::vector<SideNumber> numbers_of(const Frame& frame) {
  static const SideNumber kKnown[] = {
      {"nodes", "node", "nodes"},          {"textures", "texture", "textures"},
      {"pairs", "pair", "pairs"},          {"free_leaves", "free leaf", "free leaves"},
      {"contacts", "contact", "contacts"}, {"sectors", "sector", "sectors"}};
  std::vector<SideNumber> numbers;
  for (const std::string& written : frame.headline) {
    const std::size_t dot = written.find('.');
    const bool of_side = dot != std::string::npos && frame.side_named(written.substr(0, dot));
    const std::string name = of_side ? written.substr(dot + 1) : written;
    if (std::ranges::find(numbers, name, &SideNumber::name) == numbers.end())
      numbers.push_back({name, count_words(name, true), count_words(name, false)});
  }
  if (!numbers.empty()) return numbers;
  for (const SideNumber& known : kKnown)
    if (numbers.size() < kMostNumbers && std::ranges::any_of(frame.sides, [&](const Frame& side) {
          return side.number(known.name).has_value();
        }))
      numbers.push_back(known);
  return numbers;
}

std::string number_on(const Frame& side, const std::string& name) {
  if (const auto count = side.count(name)) return grouped(*count);
  const auto measured = side.measure(name);
  return measured ? fmt::format("{:.3g}", *measured) : "";
}

// Wide enough for the longest of all sides and for four digits, so that what can be compared stands
// at the same place of each.
double number_room(const Frame& frame, const SideNumber& number) {
  double room = Labels::number_width(4, kNumber);
  for (const Frame& side : frame.sides) {
    const auto count = side.count(number.name);
    const std::string text = number_on(side, number.name);
    room = std::max(room, count ? Labels::number_width(std::ssize(std::to_string(*count)), kNumber)
                                : text_width(text, kNumber));
  }
  return room;
}

void draw_numbers(const Frame& frame, const Frame& side, const std::vector<SideNumber>& numbers,
                  const Box<2>& place, Labels& labels) {
  const Box<2> line{{place.lo.x, place.hi.y - kNumbersHeight}, place.hi};
  const double y = line.lo.y + kNumbersBaseline;
  double x = line.lo.x;
  for (const SideNumber& number : numbers) {
    const double noun = x + number_room(frame, number) + 9, end = noun + number.noun_width();
    if (end > line.hi.x) return;
    const auto count = side.count(number.name);
    if (count)
      labels.add_number(*count, {noun - 9, y}, kNumber, line);
    else if (const std::string text = number_on(side, number.name); !text.empty())
      labels.add(text, {{noun - 9, y}, 1}, kNumber, line);
    if (side.number(number.name))
      labels.add(count == 1 ? number.one : number.many, {{noun, y}, 0}, kNoun, line);
    x = end + kBetweenNumbers;
  }
}

}  // namespace

void draw_sides(const Frame& frame, const Staging& staging, const Box<2>& area, const Box<2>& foot,
                DrawList& list, Labels& labels, const DrawSide& draw) {
  Box<2> above = area;
  const auto below =
      std::ranges::find_if(frame.panels, [](Panel panel) { return kind_of(panel).of_all_sides; });
  const bool over_chart = below != frame.panels.end();
  if (over_chart) {
    const bool alone = frame.panels.size() == 1;
    const double share = frame.sides.size() == 4 ? kChartUnderFour : kChartShare;
    const double top = alone ? area.lo.y : area.hi.y - share * area.size().y;
    view_of(*below).draw(frame, staging, {{area.lo.x, top}, area.hi}, list, labels);
    if (alone) return;
    above.hi.y = top - 18;
  }
  const std::vector<Box<2>> places = places_of(frame.sides.size(), over_chart, above);
  const std::vector<SideNumber> numbers = numbers_of(frame);
  for (const SideNumber& number : numbers) list.referents.insert(number.name);
  const bool own_times = std::ranges::any_of(
      frame.sides, [&](const Frame& side) { return side.time != frame.sides[0].time; });
  draw_rules(places, list);
  draw_words(frame, places, foot, labels);
  for (std::size_t i = 0; i < frame.sides.size(); ++i) {
    const Frame& side = frame.sides[i];
    list.prefix = side.get<FrameSide>().name + "/";
    draw_title(side, own_times, places[i], labels);
    Box<2> inner = places[i];
    inner.lo.y += kTitleHeight;
    if (!numbers.empty()) inner.hi.y -= kNumbersHeight + 6;
    draw(side, inner);
    draw_numbers(frame, side, numbers, places[i], labels);
  }
  list.prefix.clear();
}

}  // namespace lantern::draw
