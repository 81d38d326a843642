// The axes that two bodies were measured along (FrameSeparation), below each other, all lying the
// same way and on one scale: how far both reach. As many rows as the sequence ever needs.
//
//   1  ======                overlap 1.2
//          =========
//   2  =====  =======        gap 0.6
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "draw/world/narrow_marks.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kAxesHeading = 48, kMostAxisRow = 132, kLeastAxisRow = 56;
constexpr double kAxisNumber = 44;  // width before the shadows
constexpr double kAxisWords = 170;  // width behind them
constexpr double kAxisTrack = 11;   // from the middle of a row to that of a shadow

struct Shadows {
  double a_lo = 0, a_hi = 0, b_lo = 0, b_hi = 0;
};

Shadows shadows_of(const frame::FrameAxis& axis) {
  const auto at = [&](std::size_t i) { return glm::dot(axis.ends[i], axis.direction); };
  return {at(0), at(1), at(2), at(3)};
}

class AxesView : PanelPicture {
 public:
  explicit AxesView(const PanelPicture& on) : PanelPicture(on), pen_(list_, panel_) {
    double longest = 0;
    for (const Frame* one : staging_.frames()) {
      const auto& axes = one->get<FrameSeparation>().axes;
      rows_ = std::max(rows_, axes.size());
      for (const auto& axis : axes) {
        const Shadows s = shadows_of(axis);
        longest = std::max(longest, std::max(s.a_hi, s.b_hi) - std::min(s.a_lo, s.b_lo));
      }
    }
    const double room = panel_.size().x - kAxisNumber - kAxisWords - 20;
    if (longest > 0) scale_ = room / longest;
    if (!list_.maps.empty()) scale_ = std::min(scale_, list_.maps.back().scale);
    row_ = std::min(kMostAxisRow, (panel_.size().y - kAxesHeading) /
                                      static_cast<double>(std::max<std::size_t>(1, rows_)));
  }

  void draw() {
    if (rows_ == 0 || row_ < kLeastAxisRow || !(scale_ > 0)) return;
    heading(word("how far each reaches, axis by axis"), 24);
    const std::size_t known = frame_.get<FrameSeparation>().axes.size();
    for (std::size_t i = 0; i < rows_; ++i) {
      const DrawList::Scope scope(list_, fmt::format("axes/{}", i));
      if (i < known)
        draw_row(i);
      else
        list_.crisp_line({panel_.lo.x + kAxisNumber, y_of(i)}, {panel_.hi.x - kAxisWords, y_of(i)},
                         {Role::rule, 1.8, 7});
    }
  }

 private:
  double y_of(std::size_t i) const {
    return panel_.lo.y + kAxesHeading + (static_cast<double>(i) + 0.5) * row_;
  }

  void draw_row(std::size_t i) {
    const auto& separation = frame_.get<FrameSeparation>();
    const auto& axis = separation.axes[i];
    const FrameBody *a = frame_.body_of(separation.a), *b = frame_.body_of(separation.b);
    if (!a || !b) return;
    const double y = y_of(i);
    const bool front = i == separation.answer.value_or(separation.axes.size() - 1);
    if (front)
      list_.rect({{panel_.lo.x, y - row_ / 2 + 4}, {panel_.hi.x, y + row_ / 2 - 4}}, Role::lit_fill,
                 separation.answer ? Stroke{Role::lit, 2.6} : Stroke{}, 5);
    write(fmt::format("{}", i + 1), centred({panel_.lo.x + 20, y}, kStrong), kStrong);
    const Shadows s = shadows_of(axis);
    const double from = std::min(s.a_lo, s.b_lo), left = panel_.lo.x + kAxisNumber;
    const auto x = [&](double at) { return left + (at - from) * scale_; };
    list_.crisp_line({left - 6, y}, {panel_.hi.x - kAxisWords, y}, {Role::quiet_ink, 1.8});
    draw_shadow({x(s.a_lo), y - kAxisTrack}, {x(s.a_hi), y - kAxisTrack}, body_role(a->color),
                pen_);
    draw_shadow({x(s.b_lo), y + kAxisTrack}, {x(s.b_hi), y + kAxisTrack}, body_role(b->color),
                pen_);
    const bool apart = axis.separation > 0;
    if (apart)
      draw_gap({x(s.a_hi), y}, {x(s.b_lo), y}, pen_);
    else
      draw_shared_shadow({x(s.b_lo), y}, {x(s.a_hi), y}, pen_);
    const TextStyle& style = front ? kStrong : kPlain;
    // Where one shadow lies within the other, what is told is how far it must go to leave it.
    const bool within = s.b_hi < s.a_hi || s.b_lo < s.a_lo;
    const std::string what = word(apart ? "gap" : within ? "depth" : "overlap");
    write(fmt::format("{} {}", what, short_number(std::abs(axis.separation))),
          centred({panel_.hi.x - 8, y}, style, 1), style);
  }

  Pen pen_;
  std::size_t rows_ = 0;
  double scale_ = 0;
  double row_ = 0;
};

}  // namespace

PanelEntry axes_panel() {
  return {{.name = "axes",
           .words = "the `axes` of a `separate`, side by side",
           .needs = "it needs a `separate`",
           .possible = language::some_step<language::Separate>,
           .example = [] { return language::example_with("world", "separate"); }},
          {.shows = {{"axes of two bodies", has_part<FrameSeparation>}}},
          {.draw = draw_as<AxesView>, .smallest = {420, -1e300}}};
}

}  // namespace lantern::draw
