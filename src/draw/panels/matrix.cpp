// The visibility matrix: a row for each sector, and in it a square for each sector that it may see.
// The row that is asked for is lit.
//
//         1  2  3
//      1  ■  ■  □      ■ seen    □ hidden    · not known yet
//      2  ■  ■  ■      Sector 1 does not see sector 3, nor 3 sector 1: the matrix is its own mirror
//      3  □  ■  ■      image.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/panel.hpp"
#include "frame/parts/level.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kMatrixHeading = 40, kMatrixEdge = 38;  // heights of the heading and of numbers
constexpr double kMatrixKey = 40;
constexpr double kMostMatrixCell = 44, kLeastMatrixCell = 2;
constexpr double kLeastNumbered = 27;  // a square of this size has room for a number beside it

class Matrix : PanelPicture {
 public:
  explicit Matrix(const PanelPicture& on) : PanelPicture(on), matrix_(frame_.get<FrameMatrix>()) {
    const double n = std::max(1.0, static_cast<double>(matrix_.rows.size()));
    const Vec<2> room =
        panel_.size() - Vec<2>(kMatrixEdge, kMatrixHeading + kMatrixEdge + kMatrixKey);
    cell_ = std::floor(std::min({room.x / n, room.y / n, kMostMatrixCell}));
    const double slack = std::max(0.0, room.x - n * cell_) / 2;
    corner_ = panel_.lo + Vec<2>(kMatrixEdge + slack, kMatrixHeading + kMatrixEdge);
  }

  void draw() {
    if (matrix_.rows.empty() || cell_ < kLeastMatrixCell) return;
    for (std::size_t row = 0; row < matrix_.rows.size(); ++row)
      for (std::size_t column = 0; column < matrix_.rows.size(); ++column) {
        const DrawList::Scope scope(list_, fmt::format("matrix/{}-{}", row, column));
        draw_sample(matrix_.rows[row][column], row == matrix_.lit, square(row, column));
      }
    if (matrix_.lit != kNone) {
      const DrawList::Scope scope(list_, "matrix/lit");
      const Box<2> row{square(matrix_.lit, 0).lo, square(matrix_.lit, matrix_.rows.size() - 1).hi};
      list_.rect(shrunk(row, -4), Role::none, {Role::lit, 3.2}, 4);
    }
    for (std::size_t i = 0; i < matrix_.rows.size(); ++i) number(i);
    write(shortened(word("Who sees whom?"), panel_.size().x, kStrong),
          {{corner_.x, panel_.lo.y + 26}, 0}, kStrong);
    draw_key();
    // What can be counted on it.
    list_.referents.insert({"sectors", "sector_pairs"});
    if (frame_.count("visible_pairs")) list_.referents.emplace("visible_pairs");
    if (matrix_.lit != kNone) list_.referents.insert({"sectors_seen", "sector"});
  }

 private:
  Box<2> square(std::size_t row, std::size_t column) const {
    const Vec<2> lo =
        corner_ + Vec<2>(static_cast<double>(column), static_cast<double>(row)) * cell_;
    return shrunk({lo, lo + cell_}, std::clamp(0.07 * cell_, 0.2, 2.5));
  }

  void draw_sample(char letter, bool lit, const Box<2>& box) {
    const double radius = 0.08 * box.size().x;
    if (letter == '.')
      return list_.disc(box.center(), std::max(0.6, 0.07 * box.size().x), Role::cell_line_3);
    if (letter == '1') return list_.rect(box, lit ? Role::lit : Role::cell_line_1, {}, radius);
    list_.rect(box, Role::free_space, {Role::rule, 1.2}, radius);
  }

  // A sector's number before its row and over its column.
  void number(std::size_t i) {
    const bool lit = i == matrix_.lit;
    if (cell_ < kLeastNumbered && !lit && i % 5 != 4) return;
    TextStyle style = kQuiet;
    if (lit) style = {kLabel, Weight::semibold, Role::lit_ink};
    const std::string text = fmt::format("{}", i + 1);
    const DrawList::Scope scope(list_, fmt::format("matrix/number/{}", i));
    try_write(text, {centred({corner_.x - 12, square(i, 0).center().y}, style, 1)}, style);
    try_write(text, {centred({square(0, i).center().x, corner_.y - 20}, kQuiet)}, kQuiet);
  }

  void draw_key() {
    const double y = corner_.y + static_cast<double>(matrix_.rows.size()) * cell_ + 28;
    double x = corner_.x;
    for (const auto& [letter, english] :
         {std::pair{'1', "sees"}, std::pair{'0', "cannot see"}, std::pair{'.', "not known"}}) {
      const DrawList::Scope scope(list_, fmt::format("matrix/key/{}", english));
      const std::string words = word(english);
      const double width = 24 + 10 + text_width(words, kQuiet);
      if (x + width > panel_.hi.x) return;
      draw_sample(letter, false, Box<2>::around({x + 12, y}, Vec<2>(11)));
      write(words, centred({x + 34, y}, kQuiet, 0), kQuiet);
      x += width + 26;
    }
  }

  const FrameMatrix& matrix_;
  double cell_ = 0;
  Vec<2> corner_{0.0};  // of the first square
};

}  // namespace

PanelEntry matrix_panel() {
  return {{.name = "matrix",
           .words = "the `matrix` of a level's sectors, a square for each two: who sees whom",
           .needs = "it needs a [level] and a step with do = \"see\"",
           .possible = language::sees_in_level,
           .example = [] { return language::example_with("level", "see"); }},
          {.shows = {{"sectors to see", lists<FrameMatrix, &FrameMatrix::rows>}}},
          {.draw = draw_as<Matrix>, .inset = 3, .smallest = {160, 160}}};
}

}  // namespace lantern::draw
