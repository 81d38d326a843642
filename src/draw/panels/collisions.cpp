// The collisions that are remembered, over time: a strip with a row a pair, a column a world step.
//
//   @ @  | begin        _             end
//        | |||||  |||   |||||||   |   |      pips: frames left
//        |  o           o                    touching
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/panel.hpp"
#include "draw/pen.hpp"
#include "frame/parts/panels.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

using frame::FrameCollision;
using frame::FrameCollisions;

constexpr double kCollisionHeading = 40;
constexpr double kPip = 12;                 // from pip to pip
constexpr double kCallRow = 30;             // height of the line of begins and ends
constexpr double kTouchRow = 22;            // under the pips
constexpr double kCollisionPair = 120;      // width of the pair's bodies
constexpr double kMostColumn = 44;          // width
constexpr double kLeastColumn = 5;          // of more steps the last ones are drawn
constexpr std::size_t kMostCollisions = 3;  // rows

double row_height(int remembered) { return kCallRow + remembered * kPip + kTouchRow + 8; }

class CollisionsView : PanelPicture {
 public:
  explicit CollisionsView(const PanelPicture& on) : PanelPicture(on) {
    const std::uint64_t passed = told_.now - told_.first;
    const std::uint64_t all = std::max<std::uint64_t>({told_.steps.value_or(passed), passed, 12});
    const double room = panel_.size().x - kCollisionPair;
    column_ = std::clamp(room / static_cast<double>(all), kLeastColumn, kMostColumn);
    const auto columns = static_cast<std::uint64_t>(room / column_);
    first_ = passed > columns ? told_.now - columns : told_.first;
    end_ = panel_.lo.x + kCollisionPair + column_ * static_cast<double>(std::min(columns, all));
  }

  void draw() {
    if (!frame_.find<FrameCollisions>()) return;
    list_.referents.insert(
        {"collisions_alive", "begins", "ends", "contacts", "begins_in_all", "touches_in_all"});
    draw_heading();
    double y = panel_.lo.y + kCollisionHeading;
    std::size_t drawn = 0;
    for (const FrameCollision& row : told_.rows) {
      if (row.moments.empty() || row.moments.back().step <= first_) continue;
      if (drawn++ == kMostCollisions || y + row_height(told_.remembered) > panel_.hi.y + 1) break;
      draw_row(row, y);
      y += row_height(told_.remembered);
    }
  }

 private:
  double column_at(std::uint64_t step) const {
    return panel_.lo.x + kCollisionPair + column_ * static_cast<double>(step - first_ - 1);
  }

  void draw_row(const FrameCollision& row, double y) {
    const DrawList::Scope scope(list_, fmt::format("collisions/{}-{}", row.pair.a, row.pair.b));
    const double base = y + kCallRow + told_.remembered * kPip;  // under the lowest pip
    draw_pair(row, {panel_.lo.x, base - 0.5 * told_.remembered * kPip});
    list_.crisp_line({panel_.lo.x + kCollisionPair, base}, {end_, base}, {Role::cell_line_2, 1.6});
    for (const FrameCollision::Moment& moment : row.moments)
      if (moment.step > first_ && moment.step <= told_.now) {
        const DrawList::Scope column(
            list_, fmt::format("collisions/{}-{}/{}", row.pair.a, row.pair.b, moment.step));
        draw_moment(moment, base);
      }
    for (const FrameCollision::Moment& moment : row.moments)
      if (moment.step > first_ && (moment.begins || moment.frames_left < 0))
        draw_call(moment, {y, base});
  }

  void draw_pair(const FrameCollision& row, const Vec<2>& at) {
    double x = at.x;
    for (const BodyId id : {row.pair.a, row.pair.b}) {
      draw_icon(body_of(bodies_, id), Box<2>::around({x + 24, at.y}, Vec<2>(22)), list_);
      x += 52;
    }
  }

  // As many pips as the pair has frames left, and a dot where it touches.
  void draw_moment(const FrameCollision::Moment& moment, double base) {
    const double x = column_at(moment.step), inset = std::min(3.0, 0.12 * column_);
    const bool now = moment.step == told_.now;
    const Role role = now ? Role::lit : Role::cell_line_2;
    const auto pips = [&](int from, int to) {
      return Box<2>{{x + inset, base - to * kPip}, {x + column_ - inset, base - 3 - from * kPip}};
    };
    if (column_ < kPip && moment.frames_left > 0) list_.rect(pips(0, moment.frames_left), role);
    for (int i = 0; column_ >= kPip && i <= moment.frames_left; ++i) {
      const bool taken = i == moment.frames_left;  // by this step
      list_.rect(pips(i, i + 1), taken ? Role::none : role, taken ? Stroke{role, 1.4} : Stroke{},
                 1.5);
    }
    if (moment.touches)
      list_.disc({x + column_ / 2, base + kTouchRow / 2}, std::min(7.0, 0.42 * column_),
                 Role::contact);
  }

  // OnCollisionBegin or OnCollisionEnd was called.
  void draw_call(const FrameCollision::Moment& moment, const Vec<2>& from_to) {
    const bool begins = moment.begins;
    const double x = column_at(moment.step) + (begins ? 0 : column_);
    list_.crisp_line({x, from_to[0] + 4}, {x, from_to[1]}, {Role::ink, 2.6});
    const std::string called = word(begins ? "begin" : "end");
    const double gap = 7;
    try_write(called, {{{x + gap, from_to[0] + 22}, 0}, {{x - gap, from_to[0] + 22}, 1}}, kStrong);
  }

  void draw_heading() {
    const double y = panel_.lo.y + 0.8 * kLabel;
    double x = panel_.lo.x;
    const auto put = [&](const std::string& text, const TextStyle& style) {
      write(text, {{x, y}, 0}, style);
      x += text_width(text, style) + 14;
    };
    put("allCollisions", kStrong);
    const auto left = frames_left();
    if (left) put(fmt::format("framesLeft {}", *left), kPlain);
    if (!left) put(word("empty"), kQuiet);
    draw_key(y);
  }

  // Of the one pair that is in the list now; nothing if there is none, or several.
  std::optional<int> frames_left() const {
    std::optional<int> left;
    for (const FrameCollision& row : told_.rows)
      if (!row.moments.empty() && row.moments.back().step == told_.now &&
          row.moments.back().frames_left >= 0)
        left = row.moments.back().frames_left;
    return left;
  }

  void draw_key(double y) {
    const double words = text_width(word("one frame left"), kQuiet),
                 touch = text_width(word("touching"), kQuiet);
    double x = panel_.hi.x - words - touch - 100;
    if (x < panel_.lo.x + 420) return;
    list_.disc({x, y - 8}, 7, Role::contact);
    write(word("touching"), {{x + 16, y}, 0}, kQuiet);
    x += touch + 44;
    list_.rect({{x, y - 13}, {x + 26, y - 4}}, Role::cell_line_2, {}, 1.5);
    write(word("one frame left"), {{x + 36, y}, 0}, kQuiet);
  }

  const FrameCollisions& told_ = frame_.get<FrameCollisions>();
  BodiesById bodies_ = by_id(frame_.bodies);
  double column_ = kMostColumn;
  double end_ = 0;           // of the rows, x
  std::uint64_t first_ = 0;  // world steps before the first column
};

double collisions_strip(const Frame& frame, const Vec<2>& area) {
  constexpr int kUsual = 5;  // frames, before anything has touched
  const auto* told = frame.find<FrameCollisions>();
  double height = kCollisionHeading;
  if (told) {
    const auto rows =
        static_cast<double>(std::clamp<std::size_t>(told->rows.size(), 1, kMostCollisions));
    height += rows * row_height(told->remembered > 0 ? told->remembered : kUsual) + 6;
  }
  return std::min(height, 0.46 * area.y);
}

}  // namespace

PanelEntry collisions_panel() {
  return {
      {.name = "collisions",
       .words = "as a strip, the `collisions` that a world with `contacts = \"lecture\"` remembers",
       .needs = "it needs [world] contacts = \"lecture\", which remembers them",
       .possible = language::remembers_collisions,
       .example = [] { return language::example_of("collisions"); }},
      {.stage = "collisions",
       .shows = {{"a collision", lists<FrameCollisions, &FrameCollisions::rows>}}},
      {.draw = draw_as<CollisionsView>,
       .strip = collisions_strip,
       .inset = 3,
       .smallest = {300, kCollisionHeading}}};
}

}  // namespace lantern::draw
