#include "draw/sides_view.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/grouped.hpp"
#include "draw/count_words.hpp"
#include "draw/font.hpp"
#include "draw/panels.hpp"

namespace lantern::draw {
namespace {

constexpr double kBetweenSides = 56;
constexpr double kTitleHeight = 46, kTitleBaseline = 26;
constexpr double kCountsHeight = 44, kCountsBaseline = 36;
constexpr double kBetweenCounts = 34;
constexpr double kTallArea = 0.9;     // aspect below which sides stand one above the other
constexpr double kChartShare = 0.34;  // of the height, under all sides
constexpr std::size_t kMostCounts = 3;
const TextStyle kNumber{28, Weight::semibold, Role::ink};
const TextStyle kNoun{24, Weight::regular, Role::quiet_ink};

// Where each side is, in reading order.
std::vector<Box<2>> places_of(std::size_t sides, const Box<2>& area) {
  const bool tall = area.size().x < kTallArea * area.size().y;
  const std::size_t columns = tall ? 1 : sides == 4 ? 2 : sides;
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

// Its title, then what it does that the others do not, and its time if that is not theirs.
void draw_title(const Frame& side, bool own_time, const Box<2>& place, Labels& labels) {
  const TextStyle bold{28, Weight::semibold, Role::ink};
  const TextStyle quiet{24, Weight::regular, Role::quiet_ink};
  const Box<2> line{place.lo, {place.hi.x, place.lo.y + kTitleHeight}};
  const double y = line.lo.y + kTitleBaseline;
  const std::string title = shortened(side.side_title, place.size().x, bold);
  labels.add(title, {{line.lo.x, y}, 0}, bold, line);
  std::string more = side.held ? "" : side.caption;
  if (own_time) more = fmt::format("{:.2f} s", side.time) + (more.empty() ? "" : "  " + more);
  if (more.empty()) return;
  const double x = line.lo.x + text_width(title, bold) + 11;
  labels.add(shortened("·  " + more, line.hi.x - x, quiet), {{x, y}, 0}, quiet, line);
}

// A count as it stands under each side.
struct SideCount {
  std::string name;
  std::string one, many;

  double noun_width() const { return std::max(text_width(one, kNoun), text_width(many, kNoun)); }
};

// What the frame puts in front, or what its structure is about: of those that any side counts.
std::vector<SideCount> counts_of(const Frame& frame) {
  static const SideCount kKnown[] = {
      {"nodes", "node", "nodes"},          {"textures", "texture", "textures"},
      {"pairs", "pair", "pairs"},          {"free_leaves", "free leaf", "free leaves"},
      {"contacts", "contact", "contacts"}, {"sectors", "sector", "sectors"}};
  std::vector<SideCount> counts;
  for (const std::string& name : frame.headline)
    counts.push_back({name, count_words(name, true), count_words(name, false)});
  if (!counts.empty()) return counts;
  for (const SideCount& known : kKnown)
    if (counts.size() < kMostCounts && std::ranges::any_of(frame.sides, [&](const Frame& side) {
          return side.count(known.name).has_value();
        }))
      counts.push_back(known);
  return counts;
}

// Wide enough for the longest of all sides and for four digits, so that what can be compared stands
// at the same place of each.
double number_room(const Frame& frame, const SideCount& count) {
  std::int64_t digits = 4;
  for (const Frame& side : frame.sides)
    if (const auto n = side.count(count.name))
      digits = std::max(digits, static_cast<std::int64_t>(grouped(*n).size()));
  return Labels::number_width(digits, kNumber);
}

void draw_counts(const Frame& frame, const Frame& side, const std::vector<SideCount>& counts,
                 const Box<2>& place, Labels& labels) {
  const Box<2> line{{place.lo.x, place.hi.y - kCountsHeight}, place.hi};
  const double y = line.lo.y + kCountsBaseline;
  double x = line.lo.x;
  for (const SideCount& count : counts) {
    const double noun = x + number_room(frame, count) + 9, end = noun + count.noun_width();
    if (end > line.hi.x) return;
    if (const auto n = side.count(count.name)) {
      labels.add_number(*n, {noun - 9, y}, kNumber, line);
      labels.add(*n == 1 ? count.one : count.many, {{noun, y}, 0}, kNoun, line);
    }
    x = end + kBetweenCounts;
  }
}

}  // namespace

void draw_sides(const Frame& frame, const Box<2>& area, DrawList& list, Labels& labels,
                const DrawSide& draw) {
  Box<2> above = area;
  if (std::ranges::count(frame.panels, Panel::chart) > 0) {
    const bool alone = frame.panels.size() == 1;
    const double top = alone ? area.lo.y : area.hi.y - kChartShare * area.size().y;
    draw_chart(frame, {{area.lo.x, top}, area.hi}, list, labels);
    if (alone) return;
    above.hi.y = top - 18;
  }
  const std::vector<Box<2>> places = places_of(frame.sides.size(), above);
  const std::vector<SideCount> counts = counts_of(frame);
  for (const SideCount& count : counts) list.referents.insert(count.name);
  const bool own_times = std::ranges::any_of(
      frame.sides, [&](const Frame& side) { return side.time != frame.sides[0].time; });
  draw_rules(places, list);
  for (std::size_t i = 0; i < frame.sides.size(); ++i) {
    const Frame& side = frame.sides[i];
    list.prefix = side.side + "/";
    draw_title(side, own_times, places[i], labels);
    Box<2> inner = places[i];
    inner.lo.y += kTitleHeight;
    if (!counts.empty()) inner.hi.y -= kCountsHeight + 6;
    draw(side, inner);
    draw_counts(frame, side, counts, places[i], labels);
  }
  list.prefix.clear();
}

}  // namespace lantern::draw
