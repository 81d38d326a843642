// A thin strip under what moves: one count over the time so far. The ends of its axes are those of
// the whole part where they are known, else powers of two.
//
//   12 pairs  64 |- - - - - - - - - |
//              0 |__|~|_o___________| 4 s
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/words.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "draw/pen.hpp"
#include "frame/parts/panels.hpp"
#include "geometry/elementary.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kSparkEdge = 0.7 * kLabel;  // half of a line of text
constexpr double kSparkDot = 6;
constexpr std::size_t kMostSparkPoints = 600;

// At least `value`: an end of an axis that seldom moves.
double power_of_two_over(double value) {
  return std::ldexp(1.0, static_cast<int>(std::ceil(geometry::log2(std::clamp(value, 1.0, 1e15)))));
}

// Of many points those that are highest and lowest on their stretch of the way, so that no peak is
// lost.
std::vector<Vec<2>> outline_of(const std::vector<Vec<2>>& points) {
  if (points.size() <= kMostSparkPoints) return points;
  std::vector<Vec<2>> some;
  const std::size_t stretch = 2 * points.size() / kMostSparkPoints + 1;
  for (std::size_t from = 0; from < points.size(); from += stretch) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(from);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(stretch, points.size() - from));
    const auto [low, high] =
        std::minmax_element(begin, end, [](const Vec<2>& p, const Vec<2>& q) { return p.y < q.y; });
    some.push_back(low < high ? *low : *high);
    if (low != high) some.push_back(low < high ? *high : *low);
  }
  some.push_back(points.back());
  return some;
}

void draw_sparkline(const Frame& frame, const Staging& staging, const Box<2>& place, DrawList& list,
                    Labels& labels) {
  const FrameTrace& trace = frame.get<FrameTrace>();
  if (trace.points.empty()) return;
  const auto highest = greatest_of<double>(0, trace.points, [](const Vec<2>& p) { return p.y; });
  const Vec<2> now = trace.points.back();
  const AxisRanges& axes = staging.axes();
  const double most =
      axes.trace() > 0 ? std::max(axes.trace(), highest) : power_of_two_over(highest);
  const auto whole = trace.seconds ? trace.seconds : axes.seconds_of(frame.part);
  const double seconds = std::max(whole.value_or(power_of_two_over(now.x)), now.x);

  const std::string one = count_words(frame, trace.name, 1),
                    many = count_words(frame, trace.name, kMany);
  const auto digits = static_cast<std::int64_t>(number_text(most).size());
  const double number = Labels::number_width(digits, kStrong);
  const std::string top = number_text(most), end = number_text(seconds, 2) + " s";
  const double after = text_width(end, kQuiet) + 14, before = text_width(top, kQuiet) + 12;
  const double words = std::max(text_width(one, kQuiet), text_width(many, kQuiet));
  const Box<2> area{place.lo + Vec<2>(number + 8 + words + 26 + before, kSparkEdge),
                    place.hi - Vec<2>(after, kSparkEdge)};
  if (area.size().x < 60) return;

  const double middle = area.center().y + 0.36 * kLabel;
  labels.add_number(static_cast<std::int64_t>(now.y), {place.lo.x + number, middle}, kStrong,
                    place);
  labels.add(count_words(frame, trace.name, static_cast<std::int64_t>(now.y)),
             {{place.lo.x + number + 8, middle}, 0}, kQuiet, place);
  list.crisp_line(area.lo, {area.hi.x, area.lo.y}, {Role::rule, 1.4, 5});
  list.crisp_line({area.lo.x, area.hi.y}, area.hi, {Role::cell_line_2, 1.8});
  for (const auto& [text, y] : {std::pair{top, area.lo.y}, std::pair{std::string("0"), area.hi.y}})
    labels.add(text, centred({area.lo.x - 10, y}, kQuiet, 1), kQuiet, place);
  labels.add(end, centred({area.hi.x + 12, area.hi.y}, kQuiet, 0), kQuiet, place);

  const auto at = [&](const Vec<2>& p) {
    const Vec<2> share{seconds > 0 ? p.x / seconds : 0, p.y / most};
    return Vec<2>{area.lo.x + std::clamp(share.x, 0.0, 1.0) * area.size().x,
                  area.hi.y - std::clamp(share.y, 0.0, 1.0) * area.size().y};
  };
  // A count holds until it changes.
  Pen pen(list, place);
  std::vector<Vec<2>> stairs;
  for (const Vec<2>& p : outline_of(trace.points)) {
    const std::size_t n = stairs.size();
    if (n > 1 && stairs[n - 1].y == stairs[n - 2].y) stairs.pop_back();
    if (n > 0 && stairs.back().y != at(p).y) stairs.push_back({at(p).x, stairs.back().y});
    stairs.push_back(at(p));
  }
  pen.path(stairs, false, {Role::pair, 2.6});
  const DrawList::Scope scope(list, "sparkline/now");
  list.disc(at(now), kSparkDot, Role::pair, {Role::panel, 1.6});
}

}  // namespace

PanelEntry sparkline_panel() {
  return {
      {.name = "sparkline",
       .words = "as a strip, the `sparkline`: the first count of the headline, or the pairs, over "
                "the time so far",
       .needs = "it needs a [structure] and a step that runs",
       .possible = language::runs_with_structure,
       .example = language::running_example},
      {.stage = "sparkline", .shows = {{"a line so far", lists<FrameTrace, &FrameTrace::points>}}},
      {.draw = draw_sparkline,
       .strip = [](const Frame&, const Vec<2>&) { return 84.0; },
       .weight = 0.28,
       .inset = 3,
       .smallest = {-1e300, 2 * kLabel}}};
}

}  // namespace lantern::draw
