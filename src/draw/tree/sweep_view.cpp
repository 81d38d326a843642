// Sort and sweep: intervals on their axis.
//
//   1 @ |===========|
//   2 @      o=========|         o: when 2 begins, 1 is open: the two are compared
//   3 @                    |==|
//       +---------------------------> x
#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeastBand = 24, kMostBand = 56;
constexpr double kSweepHeading = 42, kSweepAxis = 44;  // heights
constexpr std::size_t kMostSweepLinks = 400;

const Box<3>& swept_box(const FrameBody& body) {
  return body.stored_box ? *body.stored_box : body.box;
}

// In the order of their lower ends; ids break ties.
std::vector<const FrameBody*> swept(const Frame& frame) {
  std::vector<const FrameBody*> order;
  for (const FrameBody& body : frame.bodies)
    if (!is_half_space(body)) order.push_back(&body);
  std::ranges::sort(order, {}, [&](const FrameBody* b) {
    return std::pair(swept_box(*b).lo[frame.get<FrameStructure>().sweep_axis], b->id);
  });
  return order;
}

class SweepView : PanelPicture {
 public:
  explicit SweepView(const PanelPicture& on) : PanelPicture(on) {
    const auto most = static_cast<std::size_t>(std::max(1.0, area_.size().y / kLeastBand));
    if (all_ > most) order_.resize(most);
    row_ = std::min(kMostBand,
                    area_.size().y / static_cast<double>(std::max<std::size_t>(1, order_.size())));
    area_.hi.y = area_.lo.y + row_ * static_cast<double>(order_.size());
    numbers_ = Labels::width_of(order_.size(), kQuiet) + 14;
    if (!lies_under_world()) area_.lo.x += numbers_ + row_ + 10;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      row_of_[order_[i]->id] = i;
      lit += order_[i]->lit;
      if (order_[i]->lit) at_ = i;
    }
    stands_ = lit == 1;
    const auto& swept_to = frame_.get<FrameStructure>().swept_to;
    if (const auto at = swept_to ? row_of_.find(*swept_to) : row_of_.end(); at != row_of_.end()) {
      at_ = at->second;
      stands_ = sweeps_ = true;
    }
  }

  void draw() {
    if (panel_.size().y < kSweepHeading + kSweepAxis + 2 * kLeastBand || panel_.size().x < 160)
      return;
    if (order_.empty() || !(length() > 0)) return;
    heading(say("sorted along {}, then swept", "xyz"[axis_]));
    if (sweeps_)
      draw_reach();
    else if (stands_)
      for (std::size_t i = 0; i <= at_; ++i)  // where the sweep stands
        if (i == at_ || to(i) >= from(at_)) light(i);
    for (std::size_t i = 0; i < order_.size(); ++i) draw_row(i);
    draw_links();
    if (stands_)
      list_.crisp_line({from(at_), area_.lo.y - 6}, {from(at_), area_.hi.y + 8}, {Role::lit, 3});
    draw_axis();
  }

 private:
  // Then intervals along x stand plumb under their bodies, each with its number and icon before it.
  bool lies_under_world() {
    for (const WorldMap& map : list_.maps) {
      const double left = map.origin.x + frame_.bounds.lo.x * map.scale;
      const double right = map.origin.x + frame_.bounds.hi.x * map.scale;
      if (map.prefix != list_.prefix || axis_ != 0 || panel_.lo.y < map.picture.hi.y) continue;
      area_.lo.x = left;
      area_.hi.x = right;
      return is_plumb_ = true;
    }
    return false;
  }

  double length() const { return frame_.bounds.size()[axis_]; }
  double x_of(double at) const {
    const double share = (at - frame_.bounds.lo[axis_]) / length();
    return area_.lo.x + (share > 0 ? std::min(share, 1.0) : 0) * area_.size().x;
  }
  double from(std::size_t i) const { return x_of(swept_box(*order_[i]).lo[axis_]); }
  double to(std::size_t i) const { return x_of(swept_box(*order_[i]).hi[axis_]); }
  double y_of(std::size_t i) const { return area_.lo.y + (static_cast<double>(i) + 0.5) * row_; }
  double half() const { return std::min(0.26 * row_, 11.0); }

  // Under the row of an interval that the sweep has open.
  void light(std::size_t i) {
    list_.rect({{panel_.lo.x, y_of(i) - row_ / 2 + 1}, {area_.hi.x + 8, y_of(i) + row_ / 2 - 1}},
               i == at_ ? Role::lit_fill : Role::passed_fill, {}, 4);
  }
  // From where the sweep stands to where its body ends; the rows of those that begin in between.
  void draw_reach() {
    for (std::size_t i = at_; i < order_.size() && from(i) <= to(at_); ++i) light(i);
    list_.rect({{from(at_), area_.lo.y - 6}, {to(at_), area_.hi.y + 8}}, Role::lit_fill);
    list_.crisp_line({to(at_), area_.lo.y - 6}, {to(at_), area_.hi.y + 8}, {Role::lit, 2, 7});
  }

  void draw_row(std::size_t i) {
    const FrameBody& body = *order_[i];
    const DrawList::Scope scope(list_, fmt::format("sweep/{}", body.id));
    const double y = y_of(i), icon = std::min(0.42 * row_, 20.0);
    double middle = panel_.lo.x + numbers_ + row_ / 2;  // of the icon
    if (is_plumb_)  // before the interval, or behind it where that is too far to the left
      middle = from(i) - panel_.lo.x > numbers_ + 2 * icon + 6 ? from(i) - icon - 6
                                                               : to(i) + numbers_ + icon + 6;
    if (row_ >= kLabel)
      write(fmt::format("{}", i + 1), centred({middle - icon - 8, y}, kQuiet, 1), kQuiet);
    draw_icon(&body, Box<2>::around({middle, y}, Vec<2>(icon)), list_);
    list_.rect({{from(i), y - half()}, {std::max(to(i), from(i) + 3), y + half()}},
               body.dimmed ? Role::panel : body_role(body.color),
               {body.lit && stands_ ? Role::lit : Role::body_line, body.lit && stands_ ? 2.6 : 1.6},
               2);
  }

  // Upright, where the later of the two begins.
  void draw_links() {
    std::size_t links = 0;
    for (const FramePair& p : frame_.pairs) {
      const auto a = row_of_.find(p.pair.a), b = row_of_.find(p.pair.b);
      if (a == row_of_.end() || b == row_of_.end() || ++links > kMostSweepLinks) continue;
      const auto [first, second] = std::minmax(a->second, b->second);
      const DrawList::Scope scope(list_, fmt::format("sweep/{}-{}", p.pair.a, p.pair.b));
      const Vec<2> open{from(second), y_of(first)}, begins{from(second), y_of(second)};
      list_.crisp_line(open, begins, {Role::panel, 6});
      list_.crisp_line(open, begins, {Role::pair, 2.4});
      for (const Vec<2>& end : {open, begins})
        list_.disc(end, std::min(5.0, 0.14 * row_), Role::pair, {Role::panel, 1.2});
    }
  }

  void draw_axis() {
    const double y = area_.hi.y + 6, below = y + 0.78 * kLabel + 8;
    list_.line({area_.lo.x, y}, {area_.hi.x, y}, {Role::ink, 2.2});
    list_.polygon({{area_.hi.x + 12, y}, {area_.hi.x, y - 6}, {area_.hi.x, y + 6}}, Role::ink);
    for (const double end : {area_.lo.x, area_.hi.x})
      list_.crisp_line({end, y}, {end, y + 7}, {Role::ink, 2.0});
    try_write(number_text(frame_.bounds.lo[axis_], 2), {{{area_.lo.x, below}, 0}}, kQuiet);
    try_write(number_text(frame_.bounds.hi[axis_], 2), {{{area_.hi.x, below}, 1}}, kQuiet);
    try_write(std::string(1, "xyz"[axis_]), {{{area_.center().x, below}, 0.5}}, kQuiet);
    if (all_ > order_.size())
      try_write(say("and {} more", all_ - order_.size()),
                {{{area_.lo.x + 0.27 * area_.size().x, below}, 0.5}}, kQuiet);
  }

  int axis_ = frame_.get<FrameStructure>().sweep_axis;
  std::vector<const FrameBody*> order_ = swept(frame_);  // as many as have room
  std::size_t all_ = order_.size();
  // Of the intervals.
  Box<2> area_{panel_.lo + Vec<2>(0, kSweepHeading), panel_.hi - Vec<2>(16, kSweepAxis)};
  double row_ = kLeastBand;
  double numbers_ = 0;  // width, with the gap behind them
  std::map<BodyId, std::size_t> row_of_;
  std::size_t at_ = 0;     // the row at whose beginning the sweep stands
  bool stands_ = false;    // and whether it stands anywhere
  bool sweeps_ = false;    // it is under way
  bool is_plumb_ = false;  // under the world, along its x
};

}  // namespace

void draw_sweep(const PanelPicture& on) { SweepView(on).draw(); }

}  // namespace lantern::draw
