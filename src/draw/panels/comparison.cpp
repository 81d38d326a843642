// The table of what kinds of structures do (FrameComparison), a row a world with a small picture of
// it; rows to come are named only.
//
//                              brute force   quadtree     grid
//   [picture] tall  80 bodies   each step   3160     | 1204 |     948
//             A grid. A quad-   to build       0        812        80
//             tree sees one     pairs left  3160        304       102
//             floor.
//
// Behind each number of a step lies a bar, as long as the number is beside the row's largest. The
// least of a row is framed and bold.
#include <algorithm>
#include <string>
#include <vector>

#include "base/number.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "frame/parts/panels.hpp"
#include "language/panel_rules.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::draw {
namespace {

using frame::FrameComparison;

constexpr double kPictureWidth = 128, kPictureHeight = 84;
constexpr double kWorldWidth = 316, kWhenWidth = 124;  // of a world's words, of "each step"
constexpr double kTableHeader = 66;
constexpr double kTableLine = 30;               // from baseline to baseline in a row
constexpr double kMostTableRow = 136;           // height
constexpr double kLeastDot = 2.6;               // side of a body in a small picture
constexpr double kDepthX = 0.4, kDepthY = 0.3;  // how far on the page a unit of depth leads

const TextStyle kTableName{26, Weight::semibold, Role::ink};
const TextStyle kTableNumber{26, Weight::regular, Role::ink};

class ComparisonView : PanelPicture {
 public:
  explicit ComparisonView(const PanelPicture& on) : PanelPicture(on) {
    const double left = kPictureWidth + 18 + kWorldWidth + kWhenWidth;
    columns_ = panel_.lo.x + left;
    column_ = (panel_.size().x - left) / static_cast<double>(table_.kinds.size());
    row_ = std::min(kMostTableRow, (panel_.size().y - kTableHeader) /
                                       static_cast<double>(table_.all_names.size()));
  }

  void draw() {
    if (table_.kinds.empty() || table_.all_names.empty()) return;
    list_.referents.insert({"least_work", "compared_bodies"});
    if (std::ranges::count(table_.kinds, StructureKind::brute_force) > 0)
      list_.referents.emplace("compared_pairs");
    draw_header();
    for (std::size_t i = 0; i < table_.all_names.size(); ++i) {
      const double top = panel_.lo.y + kTableHeader + row_ * static_cast<double>(i);
      const Box<2> place{{panel_.lo.x, top}, {panel_.hi.x, top + row_}};
      list_.crisp_line(place.lo, {place.hi.x, place.lo.y}, {Role::rule, 1.6});
      const DrawList::Scope scope(list_, "comparison/row/" + table_.all_names[i]);
      if (i < table_.rows.size())
        draw_row(table_.rows[i], i + 1 == table_.rows.size() && !frame_.ending, place);
      else
        write(table_.all_names[i], {{words_x(), baseline(place, 0)}, 0}, kQuiet);
    }
  }

 private:
  double words_x() const { return panel_.lo.x + kPictureWidth + 18; }
  // The lines of a row stand in its middle.
  double baseline(const Box<2>& row, int line) const {
    return row.center().y - kTableLine + 9 + kTableLine * line;
  }
  void draw_header() {
    for (std::size_t i = 0; i < table_.kinds.size(); ++i) {
      const std::string words(traits_of(table_.kinds[i]).words);
      const std::vector<std::string> lines = wrapped(words, column_ - 8, kQuiet);
      const double x = columns_ + column_ * (static_cast<double>(i) + 0.5);
      double y = panel_.lo.y + kTableHeader - 14 - 28 * (static_cast<double>(lines.size()) - 1);
      for (const std::string& line : lines) {
        write(shortened(line, column_ - 6, kQuiet), {{x, y}, 0.5}, kQuiet);
        y += 28;
      }
    }
  }

  void draw_row(const FrameComparison::Row& row, bool lit, const Box<2>& place) {
    if (lit) list_.rect({place.lo + Vec<2>(0, 2), place.hi - Vec<2>(0, 2)}, Role::lit_fill);
    draw_picture(row, Box<2>{{place.lo.x + 4, place.center().y - kPictureHeight / 2},
                             {place.lo.x + kPictureWidth, place.center().y + kPictureHeight / 2}});
    draw_words(row, place);
    const char* const kLines[] = {"each step", "to build", "pairs left"};
    for (int line = 0; line < 3; ++line)
      write(kLines[line], {{columns_ - 10, baseline(place, line)}, 1}, kQuiet);
    std::uint64_t most = 1;
    for (const FrameComparison::Cell& cell : row.cells) most = std::max(most, cell.work.step());
    for (std::size_t i = 0; i < table_.kinds.size(); ++i)
      if (const FrameComparison::Cell* cell = row.cell(table_.kinds[i]))
        draw_cell(*cell, cell->work.step() == row.least(), most,
                  columns_ + column_ * static_cast<double>(i), place);
  }

  // Its name, how many bodies it has, and what the row says.
  void draw_words(const FrameComparison::Row& row, const Box<2>& place) {
    write(shortened(row.name, kWorldWidth, kTableName), {{words_x(), baseline(place, 0)}, 0},
          kTableName);
    const double after = words_x() + text_width(row.name, kTableName) + 12;
    const std::string bodies = grouped(static_cast<std::int64_t>(row.bodies)) + " " +
                               count_words("bodies", row.bodies == 1);
    if (after + text_width(bodies, kQuiet) < words_x() + kWorldWidth)
      write(bodies, {{after, baseline(place, 0)}, 0}, kQuiet);
    std::vector<std::string> lines = wrapped(row.answer, kWorldWidth, kPlain);
    if (lines.size() > 2) lines = {lines[0], shortened(lines[1] + " …", kWorldWidth, kPlain)};
    for (std::size_t i = 0; i < lines.size(); ++i)
      write(lines[i], {{words_x(), baseline(place, static_cast<int>(i) + 1)}, 0});
  }

  void draw_cell(const FrameComparison::Cell& cell, bool best, std::uint64_t most, double x,
                 const Box<2>& row) {
    const double y = baseline(row, 0);
    const Box<2> box{{x + 5, y - 27}, {x + column_ - 5, y + 9}};
    const double share = static_cast<double>(cell.work.step()) / static_cast<double>(most);
    list_.rect({box.lo, {box.lo.x + std::max(2.0, share * box.size().x), box.hi.y}}, Role::rule);
    if (best) list_.rect(box, Role::none, {Role::lit, 3.4}, 5);
    const double right = x + column_ - 14;
    labels_.add_number(static_cast<std::int64_t>(cell.work.step()), {right, y},
                       best ? kTableName : kTableNumber, panel_);
    labels_.add_number(static_cast<std::int64_t>(cell.work.build), {right, baseline(row, 1)},
                       kQuiet, panel_);
    labels_.add_number(static_cast<std::int64_t>(cell.work.pairs), {right, baseline(row, 2)},
                       kQuiet, panel_);
  }

  // The world from the front, its depth leading up to the right; what is far lies behind.
  void draw_picture(const FrameComparison::Row& row, const Box<2>& place) {
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
    std::vector<FrameComparison::Mark> marks;
    for (FrameComparison::Mark mark : row.marks) {
      mark.box = common_part(mark.box, world);  // a half-space has no end
      if (is_valid(mark.box)) marks.push_back(mark);
    }
    std::ranges::stable_sort(marks, {}, [](const auto& mark) { return mark.box.center().z; });
    for (const FrameComparison::Mark& mark : marks) {
      const Vec<3> extent = mark.box.size();
      const Vec<2> half{std::max(kLeastDot, scale * extent.x) / 2,
                        std::max(kLeastDot, scale * extent.y) / 2};
      list_.rect(Box<2>::around(at(mark.box.center()), half),
                 mark.is_static ? Role::static_body : body_role(mark.color),
                 {Role::body_line, 0.8});
    }
  }

  const FrameComparison& table_ = frame_.get<FrameComparison>();
  double columns_ = 0;  // where they begin
  double column_ = 0;   // width
  double row_ = 0;      // height
};

}  // namespace

PanelEntry comparison_panel() {
  return {{.name = "comparison",
           .words = "the `comparison`, a table of what each kind of structure does for each world "
                    "that a step compares",
           .needs = "it needs a step with do = \"compare\"",
           .possible = language::some_step<language::Compare>,
           .place = 6,
           .by_itself = language::some_step<language::Compare>,
           .example = [] { return language::example_with("world", "compare"); }},
          {.shows = {{"worlds compared", lists<FrameComparison, &FrameComparison::rows>}}},
          {.draw = draw_as<ComparisonView>, .inset = 3, .smallest = {900, -1e300}}};
}

}  // namespace lantern::draw
