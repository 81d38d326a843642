// What kinds of structures do (FrameComparison) in the world that a step compares: the world's
// picture, and a bar of comparisons for each kind.
//
//   tower 1 500 bodies              a step: [##] to build [==] to find pairs   first built
//        /\                       the lecture's structures
//       /##/                      quadtree   [#########==========] 115 618        52 200
//      /##/                       octree     [###########=]( 81 692 )             75 300
//     /__/                        others
//   A quadtree sees one floor.    brute force [=========//=========] 1 124 250         0
//
// Ringed is the least of the lecture's own, and on a lit ground that of all. A bar much longer than
// all others is cut. What was built first has a column where something never moves, for then it is
// not built again. The ending has all worlds beside each other, each with three of its bars, all of
// one scale; so has the `clock`, whose bars are the times that the scenario gives.
#include <algorithm>
#include <ranges>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "frame/parts/panels.hpp"
#include "language/panel_rules.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::draw {
namespace {

using Row = frame::FrameComparison::Row;
using Cell = frame::FrameComparison::Cell;

constexpr double kPictureShare = 0.4;  // of a world's place
constexpr double kBarLine = 34, kMostBarLine = 58;
constexpr double kNames = 192, kNumbers = 160, kColumn = 140;  // widths
constexpr double kBar = 26;                                    // height
constexpr std::size_t kAcross = 3;                             // worlds on the ending
constexpr double kLeastDot = 2.6;                              // side of a body in a picture
constexpr double kDepthX = 0.4, kDepthY = 0.3;  // how far on the page a unit of depth leads
constexpr Role kBuild = Role::quiet_ink, kPair = Role::static_body;

// What a bar is as long as: the comparisons of a step, or its microseconds.
using Amount = std::uint64_t (*)(const Cell&);
std::uint64_t comparisons(const Cell& cell) { return cell.work.step(); }
constexpr std::uint64_t kNoAmount = frame::FrameComparison::kNoWork;
std::uint64_t microseconds(const Cell& cell) {
  return cell.micros > 0 ? static_cast<std::uint64_t>(cell.micros) : kNoAmount;
}

bool is_brute_force(const Cell& cell) { return cell.kind == StructureKind::brute_force; }
bool is_of_lecture(const Cell& cell) { return traits_of(cell.kind).is_of_lecture; }

bool is_ringed(const Row& row, const Cell& cell, Amount amount) {
  return amount(cell) == row.least(false, amount) ||
         (is_of_lecture(cell) && amount(cell) == row.least(true, amount));
}
// What a bar of full length stands for: the longest ones, each more than twice as long as the next,
// are cut, but three are left.
double scale_of(const Row& row) {
  auto steps = mapped(row.cells, [](const Cell& cell) { return cell.work.step(); });
  std::ranges::sort(steps, std::greater());
  std::size_t longest = 0;
  while (longest + 3 < steps.size() && steps[longest] > 2 * steps[longest + 1]) ++longest;
  return static_cast<double>(std::max<std::uint64_t>(1, steps[longest]));
}
std::string text_of(std::uint64_t count) { return number_text(static_cast<double>(count)); }

class ComparisonView : PanelPicture {
 public:
  explicit ComparisonView(const PanelPicture& on) : PanelPicture(on) {}

  void draw() {
    if (table_.rows.empty()) return;
    list_.referents.insert(
        {"least_work", "least_lecture_work", "compared_bodies", "compared_pairs"});
    if (frame_.ending && table_.rows.size() > 1)
      return draw_all(comparisons, word("comparisons a step") + "; " + word(kBest));
    const Row& row = table_.rows.back();
    const double middle = panel_.lo.x + kPictureShare * panel_.size().x;
    draw_world(row, {panel_.lo, {middle - 24, panel_.hi.y}}, true);
    draw_chart(row, {{middle, panel_.lo.y}, panel_.hi});
  }

  void draw_clock() {
    if (table_.rows.empty()) return;
    draw_all(microseconds, word("microseconds a step") + "; " + word(kBest) + "; " +
                               say("processor time, {}", table_.rows.back().machine));
  }

 private:
  static constexpr const char* kBest = "filled: least of all; ringed: least of the lecture's";

  // Bars longer than the longest of the lecture's best are cut.
  void draw_all(Amount amount, const std::string& note) {
    write(shortened(note, panel_.size().x, kQuiet), {{panel_.lo.x, panel_.hi.y - 8}, 0}, kQuiet);
    std::uint64_t scale = 1;
    for (const Row& row : table_.rows)
      for (const Cell& cell : row.cells) {
        if (amount(cell) == kNoAmount) continue;
        if ((is_of_lecture(cell) && is_ringed(row, cell, amount)) ||
            (amount == microseconds && is_brute_force(cell)))
          scale = std::max(scale, amount(cell));
      }
    const std::size_t down = (table_.rows.size() + kAcross - 1) / kAcross;
    const Vec<2> size{panel_.size().x / kAcross, panel_.size().y / static_cast<double>(down)};
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      const Row& row = table_.rows[i];
      const Vec<2> corner = panel_.lo + Vec<2>(static_cast<double>(i % kAcross) * size.x,
                                               static_cast<double>(i / kAcross) * size.y);
      const double middle = corner.x + (kPictureShare + 0.06) * size.x;
      draw_world(row, {corner, {middle - 16, corner.y + size.y - 12}}, false);
      std::vector<const Cell*> cells;  // the best, the lecture's best, and brute force
      const auto add_if = [&](auto&& wanted) {
        for (const Cell& cell : row.cells | std::views::reverse)
          if (amount(cell) != kNoAmount && wanted(cell)) {
            if (std::ranges::find(cells, &cell) == cells.end()) cells.push_back(&cell);
            return;
          }
      };
      for (const bool of_lecture : {false, true})
        add_if([&, least = row.least(of_lecture, amount)](const Cell& cell) {
          return amount(cell) == least && (!of_lecture || is_of_lecture(cell));
        });
      add_if(is_brute_force);
      std::ranges::stable_sort(cells, {}, [&](const Cell* cell) { return amount(*cell); });
      double y = corner.y + 1.6 * kBarLine;
      for (const Cell* cell : cells) {
        write(word(traits_of(cell->kind).words), centred({middle, y}, kPlain, 0));
        const double right = corner.x + size.x - 16;
        draw_bar(row, *cell, {middle, y + kBarLine}, right - middle, amount,
                 static_cast<double>(scale));
        write_number(row, *cell, {right, y}, 1, amount);
        y += 2.3 * kBarLine;
      }
    }
  }

  // Its name, its picture, and what is said of it.
  void draw_world(const Row& row, const Box<2>& place, bool says) {
    const DrawList::Scope scope(list_, "comparison/row/" + row.name);
    const double width = place.size().x, y = place.lo.y + 0.8 * kLabel;
    write(shortened(row.name, width, kStrong), {{place.lo.x, y}, 0}, kStrong);
    const std::string bodies =
        text_of(row.bodies) + " " + count_words("bodies", static_cast<std::int64_t>(row.bodies));
    const double after = text_width(row.name, kStrong) + 12;
    if (after + text_width(bodies, kQuiet) < 1.8 * width)
      write(bodies, {{place.lo.x + after, y}, 0}, kQuiet);
    double low = place.hi.y;
    if (says) {
      const std::vector<std::string> lines = wrapped(row.answer, width, kPlain);
      low -= kBarLine * static_cast<double>(lines.size());
      for (std::size_t i = 0; i < lines.size(); ++i)
        write(lines[i], {{place.lo.x, low + kBarLine * (static_cast<double>(i) + 0.8)}, 0});
    }
    draw_picture(row, {{place.lo.x, y + 12}, {place.hi.x, low - 8}});
  }

  void draw_chart(const Row& row, const Box<2>& place) {
    const bool keeps = std::ranges::any_of(row.marks, &frame::FrameComparison::Mark::is_static);
    const double line =
        std::min(kMostBarLine, place.size().y / static_cast<double>(row.cells.size() + 4));
    const double bars = place.hi.x - (keeps ? kColumn : 0);
    double y = place.lo.y + 0.45 * kLabel;
    const std::string what = word("comparisons a step") + ":";
    write(what, centred({place.lo.x, y}, kQuiet, 0), kQuiet);
    double x = place.lo.x + text_width(what, kQuiet) + 16;
    for (const auto& [words, role] :
         {std::pair{word("to build"), kBuild}, {word("to find pairs"), kPair}}) {
      list_.rect({{x, y - 11}, {x + 22, y + 11}}, role);
      write(words, centred({x + 32, y}, kQuiet, 0), kQuiet);
      x += 50 + text_width(words, kQuiet);
    }
    if (keeps) write(word("built once"), centred({place.hi.x, y}, kQuiet, 1), kQuiet);
    for (const bool of_lecture : {true, false}) {
      const std::string group = word(of_lecture ? "the lecture's structures" : "others");
      write(group, centred({place.lo.x, y += line}, kQuiet, 0), kQuiet);
      list_.crisp_line({place.lo.x + text_width(group, kQuiet) + 12, y}, {place.hi.x, y},
                       {Role::rule, 1.6});
      for (const Cell& cell : row.cells) {
        if (is_of_lecture(cell) != of_lecture) continue;
        y += line;
        write(word(traits_of(cell.kind).words), centred({place.lo.x, y}, kPlain, 0));
        const double left = place.lo.x + kNames;
        const double end =
            draw_bar(row, cell, {left, y}, bars - kNumbers - left, comparisons, scale_of(row));
        write_number(row, cell, {end + 14, y}, 0, comparisons);
        if (keeps) write(text_of(cell.work.build), centred({place.hi.x, y}, kQuiet, 1), kQuiet);
      }
    }
    write(word(kBest), centred({place.hi.x, y + line}, kQuiet, 1), kQuiet);
  }

  // From there, so long at most, which `scale` is; gives the x where it ends.
  double draw_bar(const Row& row, const Cell& cell, const Vec<2>& from, double length,
                  Amount amount, double scale) {
    const DrawList::Scope scope(
        list_, fmt::format("comparison/bar/{}/{}", row.name, traits_of(cell.kind).words));
    const auto at = [&](std::uint64_t work) {
      return from.x + length * std::min(1.0, static_cast<double>(work) / scale);
    };
    const double middle = amount == comparisons ? at(cell.work.renew) : from.x;
    const double end = std::max(at(amount(cell)), from.x + 2);
    list_.rect({{from.x, from.y - kBar / 2}, {end, from.y + kBar / 2}}, kPair);
    if (middle > from.x)
      list_.rect({{from.x, from.y - kBar / 2}, {middle, from.y + kBar / 2}}, kBuild);
    if (static_cast<double>(amount(cell)) > scale)
      for (const double x : {end - 40, end - 28})
        list_.line({x - 6, from.y + kBar / 2}, {x + 6, from.y - kBar / 2}, {Role::paper, 5});
    return end;
  }

  void write_number(const Row& row, const Cell& cell, const Vec<2>& at, double align,
                    Amount amount) {
    const bool best = amount(cell) == row.least(false, amount);
    const TextStyle style = best ? TextStyle{kLabel, Weight::semibold, Role::lit_ink} : kPlain;
    const std::string text = text_of(amount(cell));
    const Anchor anchor = centred(at, style, align);
    const Box<2> letters = Labels::extent(text, anchor, style);
    if (is_ringed(row, cell, amount))
      list_.rect({{letters.lo.x - 8, at.y - 18}, {letters.hi.x + 8, at.y + 18}},
                 best ? Role::lit_fill : Role::none, {Role::lit, 3.4}, 5);
    write(text, anchor, style);
  }

  // The world from the front, its depth leading up to the right; what is far lies behind.
  void draw_picture(const Row& row, const Box<2>& place) {
    const Box<3>& world = frame_.bounds;
    const Vec<3> size = world.size();
    const bool solid = frame_.dimension == 3;
    const auto flattened = [&](const Vec<3>& p) {
      const double depth = solid ? world.hi.z - p.z : 0;
      return Vec<2>{p.x - world.lo.x + kDepthX * depth, p.y - world.lo.y + kDepthY * depth};
    };
    const double deep = solid ? size.z : 0;
    const Vec<2> whole{size.x + kDepthX * deep, size.y + kDepthY * deep};
    const double scale = std::min(place.size().x / whole.x, place.size().y / whole.y);
    const Vec<2> corner{place.lo.x, place.center().y + 0.5 * scale * whole.y};
    const auto at = [&](const Vec<3>& p) {
      const Vec<2> q = flattened(p);
      return Vec<2>{corner.x + scale * q.x, corner.y - scale * q.y};
    };
    Vec<3> a = world.lo, c = world.hi;
    if (solid) c.y = a.y;  // its floor
    const Vec<3> b = solid ? Vec<3>{c.x, a.y, a.z} : Vec<3>{c.x, a.y, 0};
    const Vec<3> d = solid ? Vec<3>{a.x, a.y, c.z} : Vec<3>{a.x, c.y, 0};
    list_.polygon({at(a), at(b), at(c), at(d)}, Role::panel, {Role::cell_line_2, 1.6});
    std::vector<frame::FrameComparison::Mark> marks;
    for (frame::FrameComparison::Mark mark : row.marks) {
      mark.box = common_part(mark.box, world);  // a half-space has no end
      if (is_valid(mark.box)) marks.push_back(mark);
    }
    std::ranges::stable_sort(marks, {}, [](const auto& mark) { return mark.box.center().z; });
    for (const frame::FrameComparison::Mark& mark : marks) {
      const Vec<3> extent = mark.box.size();
      const Vec<2> half{std::max(kLeastDot, scale * extent.x) / 2,
                        std::max(kLeastDot, scale * extent.y) / 2};
      list_.rect(Box<2>::around(at(mark.box.center()), half),
                 mark.is_static ? Role::static_body : body_role(mark.color),
                 {Role::body_line, half.x + half.y > 6 ? 0.8 : 0.4});
    }
  }

  const frame::FrameComparison& table_ = frame_.get<frame::FrameComparison>();
};

}  // namespace

PanelEntry comparison_panel() {
  return {
      {.name = "comparison",
       .words = "the `comparison`, bars of what each kind of structure does in the world that a "
                "step compares",
       .needs = "it needs a step with do = \"compare\"",
       .possible = language::some_step<language::Compare>,
       .place = 6,
       .by_itself = language::some_step<language::Compare>,
       .example = [] { return language::example_with("world", "compare"); }},
      {.shows = {{"worlds compared",
                  lists<frame::FrameComparison, &frame::FrameComparison::rows>}}},
      {.draw = draw_as<ComparisonView>, .inset = 3, .smallest = {900, -1e300}}};
}

PanelEntry clock_panel() {
  return {{.name = "clock",
           .words = "the `clock`, bars of the times that steps of `compare` give, of all worlds",
           .needs = "it needs a step with do = \"compare\"",
           .possible = language::some_step<language::Compare>,
           .place = 6,
           .example = [] { return language::example_with("world", "compare"); }},
          {.shows = {{"times", lists<frame::FrameComparison, &frame::FrameComparison::rows>}}},
          {.draw =
               [](const Frame& frame, const Staging& staging, const Box<2>& box, DrawList& list,
                  Labels& labels) {
                 ComparisonView({frame, staging, box, list, labels}).draw_clock();
               },
           .inset = 3,
           .smallest = {900, -1e300}}};
}

}  // namespace lantern::draw
