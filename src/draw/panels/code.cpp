// A function of the lecture's source, beside the picture of what it does; the lines that the frame
// is about are lit. Of a function too long for the panel its head is shown and what is around
// these. A long line loses the end of its list of arguments, or is broken.
//
//   quad_tree.hpp   QuadTreeNode::Insert
//   69  void Insert(const T& object, const Vector3& objectPos, …) {
//     ‥‥‥
//   79 |  contents.push_back(QuadTreeEntry<T>(object, …));   <- lit
//   81    if (static_cast<int>(contents.size()) > maxSize && depthLeft > 0) {
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "draw/panel.hpp"
#include "frame/parts/panels.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

using run::FrameCode;

constexpr std::array<double, 3> kCodeSizes = {30, 28, 26};  // em, of a face of small letters
constexpr double kCodePitch = 1.28;                         // of the em, from row to row
constexpr double kCodeIndent = 0.95;                        // of the em, a level
constexpr double kCodeHeading = 42;
constexpr double kCodeGap = 16;  // between the numbers and the code
constexpr double kCodeCut = 12;  // height of the mark of lines left out
constexpr std::size_t kFewRows =
    12;  // letters are as large as so many rows, and the whole function, allow

// One row of the panel: a line, or the rest of one that is broken.
struct CodeRow {
  std::string text;
  double indent = 0;  // page units
};

// What stands behind the brackets that are open before `at`, and those brackets closed.
std::string closed_from(std::string_view text, std::size_t at) {
  const auto before = text.substr(0, at);
  std::ptrdiff_t depth = std::ranges::count(before, '(') - std::ranges::count(before, ')');
  std::string closing(static_cast<std::size_t>(depth), ')');
  for (; at < text.size() && depth > 0; ++at) {
    if (text[at] == '(') ++depth;
    if (text[at] == ')') --depth;
  }
  return closing.append(text.substr(at));
}

// The line without the last of what stands in its brackets, as little of it as can be; of a
// function's head, if nothing else helps, without all of it. Empty if that is not enough.
std::string cut_arguments(std::string_view text, bool is_head, double width,
                          const TextStyle& style) {
  for (std::size_t at = text.size(); at-- > 0;) {
    const bool ends_all = is_head && text[at] == '(';
    if (text[at] != ',' && text[at] != ';' && !ends_all) continue;
    const auto before = text.substr(0, at + 1);
    if (std::ranges::count(before, '(') <= std::ranges::count(before, ')')) continue;
    std::string less = std::string(before).append(ends_all ? "…" : " …");
    less += closed_from(text, at + 1);
    if (text_width(less, style) <= width) return less;
  }
  return {};
}

std::vector<CodeRow> rows_of(const FrameCode::Line& line, bool is_head, double width,
                             const TextStyle& style) {
  const double level = kCodeIndent * style.size, indent = line.indent * level;
  if (text_width(line.text, style) <= width - indent) return {{line.text, indent}};
  if (std::string less = cut_arguments(line.text, is_head, width - indent, style); !less.empty())
    return {{std::move(less), indent}};
  std::vector<CodeRow> rows;
  for (const std::string& part : wrapped(line.text, width - indent - 2 * level, style))
    rows.push_back({part, rows.empty() ? indent : indent + 2 * level});
  return rows;
}

class CodeView : PanelPicture {
 public:
  explicit CodeView(const PanelPicture& on) : PanelPicture(on), code_(frame_.get<FrameCode>()) {
    for (const double size : kCodeSizes) {
      lay_out(size);
      if (rooms_ >= kFewRows && row_count(0, lines_.size()) <= rooms_) break;
    }
  }

  void draw() {
    if (code_.lines.empty()) return;
    draw_heading();
    const auto [first, end] = window();
    double y = draw_line(0, panel_.lo.y + kCodeHeading);
    if (first > 1) y = draw_cut(y);
    for (std::size_t i = first; i < end; ++i) y = draw_line(i, y);
    if (end < lines_.size()) draw_cut(y);
  }

 private:
  void lay_out(double size) {
    style_.size = size;
    pitch_ = kCodePitch * size;
    number_ = text_width("000", style_);
    lines_.clear();
    const double width = panel_.size().x - number_ - kCodeGap - 10;
    for (const FrameCode::Line& line : code_.lines)
      lines_.push_back(rows_of(line, lines_.empty(), width, style_));
    rooms_ = static_cast<std::size_t>((panel_.size().y - kCodeHeading) / pitch_);
  }

  std::size_t row_count(std::size_t from, std::size_t to) const {
    std::size_t rows = 0;
    for (std::size_t i = from; i < to; ++i) rows += lines_[i].size();
    return rows;
  }

  // Which lines are shown beside the head: all that have room, with the first lit ones in their
  // midst. It begins at few places, so that it seldom moves.
  std::pair<std::size_t, std::size_t> window() const {
    const std::size_t all = lines_.size();
    if (row_count(0, all) <= rooms_) return {1, all};
    // The marks of what is left out take the room of a row.
    const std::size_t room = rooms_ - lines_[0].size() - 1;
    const auto end_from = [&](std::size_t first) {
      std::size_t end = first;
      while (end < all && row_count(first, end + 1) <= room) ++end;
      return end;
    };
    std::size_t lit = 0, last = 0;
    for (std::size_t i = all; i-- > 0;)
      if (code_.lines[i].lit) lit = i, last = std::max(last, i);
    if (last < end_from(1)) return {1, end_from(1)};
    std::size_t tail = all;
    while (tail > 1 && row_count(tail - 1, all) <= room) --tail;
    if (lit > tail) return {tail, all};
    std::size_t first = lit > 2 ? lit - 2 : 1;
    while (first < lit && end_from(first) <= lit) ++first;  // after lines of several rows
    return {first, end_from(first)};
  }

  double draw_line(std::size_t i, double y) {
    const FrameCode::Line& line = code_.lines[i];
    const DrawList::Scope scope(list_, fmt::format("code/{}/{}", code_.function, line.number));
    const double bottom = y + pitch_ * static_cast<double>(lines_[i].size());
    TextStyle number = style_;
    number.role = line.lit ? Role::lit_ink : Role::quiet_ink;
    if (line.lit) {
      const Box<2> band{{panel_.lo.x, y}, {panel_.hi.x, bottom}};
      list_.rect(band, Role::lit_fill, {}, 4);
      list_.rect({band.lo, {band.lo.x + 6, bottom}}, Role::lit);
    }
    const double x = panel_.lo.x + 10 + number_;
    write(fmt::format("{}", line.number), centred({x, y + pitch_ / 2}, number, 1), number);
    for (const CodeRow& row : lines_[i]) {
      const double room = panel_.hi.x - x - kCodeGap - row.indent;
      write(shortened(row.text, room, style_),
            centred({x + kCodeGap + row.indent, y + pitch_ / 2}, style_, 0), style_);
      y += pitch_;
    }
    return bottom;
  }

  // Lines are left out here.
  double draw_cut(double y) {
    const double x = panel_.lo.x + 10 + number_ / 2, middle = y + kCodeCut / 2;
    for (const double dx : {-10.0, 0.0, 10.0}) list_.disc({x + dx, middle}, 2.2, Role::quiet_ink);
    return y + kCodeCut;
  }

  void draw_heading() {
    const double y = panel_.lo.y + 0.8 * kLabel;
    const std::string name = shortened(code_.function, panel_.size().x, kStrong);
    write(name, {{panel_.lo.x, y}, 0}, kStrong);
    const double x = panel_.lo.x + text_width(name, kStrong) + 20;
    if (x + text_width(code_.file, kQuiet) <= panel_.hi.x)
      write(code_.file, {{panel_.hi.x, y}, 1}, kQuiet);
    list_.crisp_line({panel_.lo.x, panel_.lo.y + kCodeHeading - 8},
                     {panel_.hi.x, panel_.lo.y + kCodeHeading - 8}, {Role::rule, 1.4});
  }

  const FrameCode& code_;
  TextStyle style_{.weight = Weight::code};
  double pitch_ = 0;
  double number_ = 0;                        // width of the column of numbers
  std::vector<std::vector<CodeRow>> lines_;  // of the code
  std::size_t rooms_ = 0;                    // rows that have room
};

}  // namespace

PanelEntry code_panel() {
  return {{.name = "code",
           .words = "the `code` of the lecture, one function of it",
           .needs = "it needs a step with 'code'",
           .possible = language::has_code,
           .of_all_sides = true,
           .example =
               [] {
                 return language::example_of("world") +
                        "\n[[step]]\ndo = \"show\"\ncode = { function = \"Insert\", line = "
                        "\"Split(\" }\n";
               }},
          {.shows = {{"lines of code", has_part<FrameCode>}}},
          {.draw = draw_as<CodeView>, .weight = 1.3, .inset = 3, .smallest = {300, 160}}};
}

}  // namespace lantern::draw
