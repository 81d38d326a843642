#include "draw/page.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/words.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "frame/parts/ground.hpp"

namespace lantern::draw {
namespace {

constexpr double kTop = 90;  // of the panels
constexpr double kTopWithoutTitle = 30;
constexpr double kTitleLine = 52;  // baseline
constexpr double kTitleRule = 70;  // under it
constexpr double kOverFooter = 20;
constexpr double kMostEnlarged = 1.45;
constexpr double kStackBelow = 1.2;  // aspect of a page whose panels stand one above the other

void add_rule(DrawList& list, double y, double margin) {
  list.crisp_line({margin, y}, {list.page.x - margin, y}, {Role::rule, 1.6});
}

// The picture's number in its sequence, from 1, at the right. Gives the left end.
double draw_number(const Frame& frame, const Box<2>& band, Labels& labels) {
  if (frame.steps == 0) return band.hi.x;
  const std::int64_t number = frame.index + std::int64_t{1};
  labels.add_number(number, {band.hi.x, kTitleLine}, kQuiet, band);
  return band.hi.x - Labels::width_of(number, kQuiet);
}

// A title in bold, and behind it what more there is to say, quietly; both shortened to end at
// `right`.
void write_title(const std::string& title, const std::string& more, double size, const Vec<2>& at,
                 double right, const Box<2>& band, Labels& labels) {
  const TextStyle bold{size, Weight::semibold};
  const std::string shown = shortened(title, right - at.x, bold);
  labels.add(shown, {at, 0}, bold, band);
  const double end = at.x + text_width(shown, bold) + 11;
  if (!more.empty())
    labels.add(shortened("·  " + more, right - end, kQuiet), {{end, at.y}, 0}, kQuiet, band);
}

constexpr double kBetweenSides = 56;
constexpr double kTitleHeight = 46, kTitleBaseline = 26;
constexpr double kNumbersHeight = 44, kNumbersBaseline = 36;
constexpr double kBetweenNumbers = 34;
constexpr double kWordsBaseline = 42, kWordsLine = 34;  // of what one side does alone
constexpr double kTallArea = 0.9;          // aspect below which sides stand one above the other
constexpr double kChartShare = 0.34;       // of the height, under all sides
constexpr double kLargeChartShare = 0.44;  // under four of them, one panel each, or flat worlds
constexpr double kFlat = 1.5;              // aspect
constexpr std::size_t kMostNumbers = 3;
const TextStyle kNumber{28, Weight::semibold, Role::ink};

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

// What each does that the others do not, at the page's foot: under its own column, or, where sides
// stand in rows, one below the other.
void draw_words(const Frame& frame, const std::vector<Box<2>>& places, const Box<2>& foot,
                Labels& labels) {
  const TextStyle& style = kPlain;
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
    const std::vector<std::string> lines = two_lines(side.caption, width, style);
    for (std::size_t k = 0; k < lines.size(); ++k)
      labels.add(lines[k], {{left, y + kWordsLine * static_cast<double>(k)}, 0}, style, foot);
  }
}

// Of the counts and measures: what structures, atlases and levels are about, of those that any side
// counts.
std::vector<std::string> numbers_of(const Frame& frame) {
  std::vector<std::string> numbers;
  for (const std::string& written : frame.headline) {
    const std::size_t dot = written.find('.');
    const bool of_side = dot != std::string::npos && frame.side_named(written.substr(0, dot));
    const std::string name = of_side ? written.substr(dot + 1) : written;
    if (std::ranges::find(numbers, name) == numbers.end()) numbers.push_back(name);
  }
  if (!numbers.empty()) return numbers;
  for (const char* known : {"nodes", "textures", "pairs", "free_leaves", "contacts", "sectors"})
    if (numbers.size() < kMostNumbers && std::ranges::any_of(frame.sides, [&](const Frame& side) {
          return side.number(known).has_value();
        }))
      numbers.emplace_back(known);
  return numbers;
}

std::string number_on(const Frame& side, const std::string& name) {
  if (const auto count = side.count(name)) return grouped(*count);
  const auto measured = side.measure(name);
  return measured ? say("{:.3g}", *measured) : "";
}

// As the headline calls it on this side alone, or on all.
std::string words_on(const Frame& side, const std::string& name, std::int64_t n,
                     const Frame& page) {
  const std::string own = side.get<FrameSide>().name + "." + name;
  return count_words(page, page.words.contains(own) ? own : name, n);
}

// Wide enough for the longest of all sides and for four digits, so that what can be compared stands
// at the same place of each.
double number_room(const Frame& frame, const std::string& name) {
  double room = Labels::number_width(4, kNumber);
  for (const Frame& side : frame.sides) {
    const auto count = side.count(name);
    room = std::max(room, count ? Labels::width_of(*count, kNumber)
                                : text_width(number_on(side, name), kNumber));
  }
  return room;
}

void draw_numbers(const Frame& frame, const Frame& side, const std::vector<std::string>& numbers,
                  const Box<2>& place, Labels& labels) {
  const Box<2> line{{place.lo.x, place.hi.y - kNumbersHeight}, place.hi};
  const double y = line.lo.y + kNumbersBaseline;
  double x = line.lo.x;
  for (const std::string& name : numbers) {
    const double noun = x + number_room(frame, name) + 9;
    x = noun;
    for (const Frame& other : frame.sides)
      for (const std::int64_t n : {std::int64_t{1}, kMany})
        x = std::max(x, noun + text_width(words_on(other, name, n, frame), kQuiet));
    if (x > line.hi.x) return;
    const auto count = side.count(name);
    if (count)
      labels.add_number(*count, {noun - 9, y}, kNumber, line);
    else
      labels.add(number_on(side, name), {{noun - 9, y}, 1}, kNumber, line);
    if (side.number(name))
      labels.add(words_on(side, name, count.value_or(kMany), frame), {{noun, y}, 0}, kQuiet, line);
    x += kBetweenNumbers;
  }
}

void draw_panels(const Frame& frame, const Staging& staging, const Staging& arranged_for,
                 const Box<2>& area, DrawList& list, Labels& labels, Work& work);

// The sides beside each other, four of them in two rows, on a tall area one above the other: all as
// large as each other, so that one scale holds for all. Each has its title over it and its
// headline's counts under it, the same ones at the same places; a chart spans all of them. At the
// page's foot, where otherwise the caption is, stands what a side does that the others do not. Keys
// of what a side shows begin with its name.
void draw_sides(const Frame& frame, const Staging& staging, const Box<2>& area, DrawList& list,
                Labels& labels, Work& work) {
  Box<2> above = area;
  const auto below =
      std::ranges::find_if(frame.panels, [](Panel panel) { return kind_of(panel).of_all_sides; });
  const bool over_chart = below != frame.panels.end();
  if (over_chart) {
    const bool alone = frame.panels.size() == 1;
    const bool large = frame.sides.size() == 4 || frame.panels.size() == 2 ||
                       (frame.panels.size() == 3 && world_aspect(frame) > kFlat);
    const double share = large ? kLargeChartShare : kChartShare;
    const double top = alone ? area.lo.y : area.hi.y - share * area.size().y;
    draw_panel(*below, frame, staging, {{area.lo.x, top}, area.hi}, list, labels);
    if (alone) return;
    above.hi.y = top - 18;
  }
  const std::vector<Box<2>> places = places_of(frame.sides.size(), over_chart, above);
  const std::vector<std::string> numbers =
      frame.display.counters ? numbers_of(frame) : std::vector<std::string>();
  list.referents.insert(numbers.begin(), numbers.end());
  const bool own_times = std::ranges::any_of(
      frame.sides, [&](const Frame& side) { return side.time != frame.sides[0].time; });
  draw_rules(places, list);
  draw_words(frame, places, {{area.lo.x, area.hi.y + kOverFooter}, {area.hi.x, list.page.y - 12}},
             labels);
  for (std::size_t i = 0; i < frame.sides.size(); ++i) {
    const Frame& side = frame.sides[i];
    list.prefix = side.get<FrameSide>().name + "/";
    Box<2> inner = places[i];
    inner.lo.y += kTitleHeight;
    // Its time too, if that is not the others'.
    write_title(side.get<FrameSide>().title, own_times ? say("{:.2f} s", side.time) : "", 28,
                {inner.lo.x, places[i].lo.y + kTitleBaseline}, inner.hi.x,
                {places[i].lo, {inner.hi.x, inner.lo.y}}, labels);
    if (!numbers.empty()) inner.hi.y -= kNumbersHeight + 6;
    draw_panels(side, staging.of_side(side.get<FrameSide>().name), staging.largest_side(), inner,
                list, labels, work);
    draw_notes(side, inner, list, labels);
    labels.forget_places();  // the next side has bodies of the same names
    draw_numbers(frame, side, numbers, places[i], labels);
  }
  list.prefix.clear();
}

// `arranged_for`: with what the panels' places are chosen; of a side it is that of all sides.
void draw_panels(const Frame& frame, const Staging& staging, const Staging& arranged_for,
                 const Box<2>& area, DrawList& list, Labels& labels, Work& work) {
  if (frame.panels.empty()) return;
  if (!frame.sides.empty()) return draw_sides(frame, staging, area, list, labels, work);
  const Vec<2> whole = frame.get<FrameSide>().name.empty() ? list.page : area.size();
  const bool tall = whole.x / whole.y < kStackBelow;
  const std::vector<Box<2>> boxes = arranged(frame, arranged_for, area, tall);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    work.world_layouts += is(frame.panels[i], "world");
    work.tree_layouts += is(frame.panels[i], "tree");
    draw_panel(frame.panels[i], frame, staging, boxes[i], list, labels);
  }
}

// The page, with a strip so high at the lower end of the panels' area for the legend. Nothing if
// the marks that are on it need a higher one: `strip` then says which.
std::optional<DrawList> laid_out(const Frame& frame, const Staging& staging, const Vec<2>& page,
                                 double& strip, bool last, Work& work) {
  constexpr double kAboveLegend = 14;
  DrawList list;
  list.page = page;
  list.paints = frame.get<FramePaints>().paints;
  Labels labels(list);
  const double margin = page.x < kNarrowPage ? 40 : 60;
  const auto has_notes = [](const Frame& f) { return !f.notes.empty(); };
  if (has_notes(frame) || std::ranges::any_of(frame.sides, has_notes)) labels.expect_notes();
  const bool has_foot = frame.display.caption || frame.display.counters;
  double bottom = 0;
  {
    const DrawList::Scope words(list, "page/words");
    if (frame.display.title) {
      const Box<2> band{{margin, 16}, {page.x - margin, kTitleRule - 2}};
      const double right = draw_number(frame, band, labels) - 36;
      write_title(frame.title, frame.part, 26, {margin, kTitleLine}, right, band, labels);
      add_rule(list, kTitleRule, margin);
    }
    bottom = draw_footer(frame, staging, margin, list, labels);
    if (has_foot) add_rule(list, bottom, margin);
  }
  Box<2> area{{margin, frame.display.title ? kTop : kTopWithoutTitle},
              {page.x - margin, bottom - (has_foot ? kOverFooter : 14)}};
  Box<2> legend{{area.lo.x, area.hi.y - strip}, area.hi};
  if (strip > 0) area.hi.y = legend.lo.y - kAboveLegend;
  draw_panels(frame, staging, staging, area, list, labels, work);
  if (frame.display.legend) {
    const double needed = legend_height(list.marks, area.size().x);
    if (needed > strip && !last) return strip = needed, std::nullopt;
    draw_legend(list.marks, legend, list, labels);
  }
  if (frame.sides.empty())
    draw_notes(frame, {area.lo - Vec<2>(margin - 20, 12), {page.x - 20, bottom - 6}}, list, labels);
  return list;
}

}  // namespace

Vec<2> page_for(int width, int height) {
  const double pixels = std::min(width / 1600.0, height / 900.0);  // a unit
  return {width / pixels, height / pixels};
}

Vec<2> page_across(const Frame& frame, double width) {
  constexpr double kSeveral = 9.0 / 16, kNarrow = 1200, kOther = 0.62, kWords = 250;
  double height = width < kNarrow ? width : kSeveral * width;
  if (frame.panels.size() == 1 && frame.sides.empty()) {
    const PanelView& only = view_of(frame.panels[0]);
    height = only.strip                     ? only.strip(frame, {width, width}) + 60
             : is(frame.panels[0], "world") ? std::min(2.0, 1.15 / world_aspect(frame)) * width
             : only.size                    ? width
                                            : kOther * width;
  }
  const Display& shown = frame.display;
  if (shown.title) height += kTop;
  if (shown.caption || shown.counters) height += kWords;
  // Higher pages are enlarged by draw_frame().
  return Vec<2>(width, height) * (height > 900 ? kMostEnlarged : 1);
}

// The layout is made for a page about 900 units high and then scaled, so that type keeps its part
// of the page's height on squarer pages. On tall ones that would leave too little width for the
// panels, so it stops at kMostEnlarged. Which marks the legend tells of is known when they are
// drawn: where they need a strip, all is drawn again above it.
DrawList draw_frame(const Frame& frame, const Staging& staging, const Vec<2>& page, Work& work) {
  constexpr int kMostTries = 3;  // with less room there may be other marks
  const double k = std::clamp(page.y / 900, 1.0, kMostEnlarged);
  double strip = 0;
  std::optional<DrawList> drawn;
  for (int tries = 1; !drawn; ++tries)
    drawn = laid_out(frame, staging, page / k, strip, tries == kMostTries, work);
  DrawList list = std::move(*drawn);
  list.page = page;
  if (k == 1) return list;
  const auto enlarge = [&](double& measure) { measure *= k; };
  for (DrawShape& shape : list.shapes)
    std::visit([&](auto& s) { for_each_measure(s, enlarge); }, shape);
  for (WorldMap& map : list.maps) {
    map.picture = {map.picture.lo * k, map.picture.hi * k};
    map.origin *= k;
    map.scale *= k;
  }
  for (SolidPanel& solid : list.solids) solid.panel = {solid.panel.lo * k, solid.panel.hi * k};
  for (LabelBox& label : list.labels)
    for (Box<2>* box : {&label.box, &label.panel}) *box = {box->lo * k, box->hi * k};
  return list;
}

DrawList draw_frame(const Frame& frame, const Vec<2>& page, Work& work) {
  return draw_frame(frame, Staging(frame), page, work);
}

}  // namespace lantern::draw
