// The Minkowski difference of two bodies: where it holds the origin, they have a point in common;
// and what a search for their distance has found of it.
//
//        ______
//       /      \             as large as in the world, if there is room: arrows of the world
//      |  A - B |   o 0      and of the difference can be laid on each other
//       \______/
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

constexpr double kHeading = 44;
constexpr double kRimNumbers = 40;  // height of the numbers below, width of those at the left
constexpr double kAround = 26;      // the difference

const TextStyle kOwn{kLabel, Weight::semibold, Role::ink, Role::panel};

// What all frames of the sequence need, the origin with it.
Box<2> reach_of(const Staging& staging) {
  Box<2> reach{Vec<2>(0.0), Vec<2>(0.0)};
  for (const Frame* frame : staging.frames()) {
    const auto& difference = frame->get<FrameDifference>();
    const Vec<2> round(difference.radius);
    for (const Vec<2>& p : difference.corners) reach = united(reach, Box<2>{p - round, p + round});
  }
  return reach;
}

class DifferenceView : PanelPicture {
 public:
  explicit DifferenceView(const PanelPicture& on) : PanelPicture(on) {
    const Box<2> reach = reach_of(staging_);
    const Vec<2> room = shrunk(area_, kAround).size(), size = reach.size();
    scale_ = std::min(size.x > 0 ? room.x / size.x : 1e300, size.y > 0 ? room.y / size.y : 1e300);
    if (!list_.maps.empty()) scale_ = std::min(scale_, list_.maps.back().scale);
    if (!(scale_ < 1e300)) scale_ = 1;
    origin_ = area_.center() - Vec<2>(reach.center().x, -reach.center().y) * scale_;
  }

  void draw() {
    if (difference_.corners.empty()) return;
    heading(say("every point of {} minus every point of {}", name_of(difference_.a),
                name_of(difference_.b)),
            22);
    draw_axes();
    draw_shape();
    if (const auto& search = frame_.get<FrameSearch>(); !search.steps.empty()) draw_search(search);
    draw_origin(origin_, pen_);
    list_.marks.add(MarkKind::origin);
    labels_.block(Box<2>::around(origin_, Vec<2>(11)));
    try_write(
        word("origin"),
        {centred(origin_ + Vec<2>(20, 26), kOwn, 0), centred(origin_ - Vec<2>(20, 26), kOwn, 1),
         centred(origin_ + Vec<2>(20, -26), kOwn, 0), centred(origin_ + Vec<2>(-20, 26), kOwn, 1)},
        kOwn);
    list_.referents.insert({"gjk_steps", "distance"});
  }

 private:
  Vec<2> to_page(const Vec<2>& p) const { return origin_ + Vec<2>(p.x, -p.y) * scale_; }

  std::string name_of(BodyId id) const {
    const FrameBody* body = frame_.body_of(id);
    return body ? body->called() : "";
  }

  // Lines through the origin, and numbers at the rim.
  void draw_axes() {
    list_.crisp_rect(area_, Role::panel, {Role::cell_line_1, 1.8});
    pen_.line({area_.lo.x, origin_.y}, {area_.hi.x, origin_.y}, {Role::cell_line_2, 1.8});
    pen_.line({origin_.x, area_.lo.y}, {origin_.x, area_.hi.y}, {Role::cell_line_2, 1.8});
    constexpr double kLeastApart = 64;  // page units between two numbers
    double step = 1;
    while (step * scale_ < kLeastApart) step *= 2;
    const auto each = [&](double from, double to, const auto& f) {
      for (double at = std::ceil(from / step) * step; at <= to; at += step) f(at);
    };
    each((area_.lo.x + 14 - origin_.x) / scale_, (area_.hi.x - 14 - origin_.x) / scale_,
         [&](double x) {
           const double page = origin_.x + x * scale_;
           list_.crisp_line({page, area_.hi.y}, {page, area_.hi.y - 7}, {Role::cell_line_1, 1.8});
           try_write(number_text(x, 2), {centred({page, area_.hi.y + 20}, kQuiet)}, kQuiet);
         });
    each((origin_.y - area_.hi.y + 14) / scale_, (origin_.y - area_.lo.y - 14) / scale_,
         [&](double y) {
           const double page = origin_.y - y * scale_;
           list_.crisp_line({area_.lo.x, page}, {area_.lo.x + 7, page}, {Role::cell_line_1, 1.8});
           try_write(number_text(y, 2), {centred({area_.lo.x - 8, page}, kQuiet, 1)}, kQuiet);
         });
  }

  void draw_shape() {
    const DrawList::Scope scope(list_, "difference/shape");
    const Outline core = shape();
    if (difference_.radius > 0) {
      Outline all;
      for (const Vec<2>& p : core) {
        const Outline ring = ring_of(p, difference_.radius * scale_, 64);
        all.insert(all.end(), ring.begin(), ring.end());
      }
      pen_.polygon(hull_of(all), Role::passed_fill, {Role::ink, 2.4});
      pen_.path(core, true, {Role::quiet_ink, 1.8, 6});
    } else if (core.size() > 2) {
      pen_.polygon(core, Role::passed_fill, {Role::ink, 2.4});
    } else {
      pen_.path(core, false, {Role::ink, 2.4});
    }
  }

  void draw_search(const frame::FrameSearch& search) {
    const auto& step = search.steps.back();
    Outline points;
    for (const auto& p : simplex_of(search)) points.push_back(to_page(p.difference()));
    {
      const DrawList::Scope scope(list_, "difference/simplex");
      draw_simplex(points, pen_);
      if (!points.empty()) list_.marks.add(MarkKind::simplex);
    }
    if (!search.taken && !search.answer) draw_newest(search, step);
    if (search.taken || search.answer) draw_nearest(search, step.nearest);
    for (const auto& p : simplex_of(search))
      number(search_number(search, p.difference()), to_page(p.difference()));
  }

  // The search goes straight at the origin, and finds the point whose line across is the farthest.
  void draw_newest(const frame::FrameSearch& search, const frame::GjkStep& step) {
    const DrawList::Scope scope(list_, "difference/search");
    const Vec<2> found = to_page(step.found.difference());
    const Vec<2> d{step.direction.x, -step.direction.y}, across{-d.y, d.x};
    pen_.line(found - across * 2000.0, found + across * 2000.0, {Role::lit, 2.4, 9});
    const std::size_t n = search.steps.size();
    const Vec<2> from = n > 1 ? to_page(search.steps[n - 2].nearest) : middle_of(shape());
    const double to_origin = glm::length(origin_ - from);
    pen_.arrow(from, from + d * std::max(to_origin - 12, 40.0), {Role::ink, 3}, 15, 1.6);
    pen_.arrow(origin_, found, {Role::lit, 4}, 16, 1.8);
    draw_support(found, pen_);
    list_.marks.add(MarkKind::support);
    number(search_number(search, step.found.difference()), found);
  }

  void draw_nearest(const frame::FrameSearch& search, const Vec<2>& nearest) {
    if (glm::length(nearest) * scale_ < 1) return;
    const DrawList::Scope scope(list_, "difference/nearest");
    const Vec<2> at = to_page(nearest), way = at - origin_;
    const bool done = search.answer.has_value();
    draw_ruler(origin_, at, {done ? Role::lit : Role::ink, done ? 4.6 : 3}, pen_);
    list_.marks.add(MarkKind::ruler);
    const Vec<2> side = Vec<2>(-way.y, way.x) / glm::length(way), middle = (at + origin_) / 2.0;
    const std::string text = short_number(glm::length(nearest));
    try_write(text,
              {centred(middle + side * 36.0, kOwn), centred(middle - side * 36.0, kOwn),
               centred(middle + side * 62.0, kOwn), centred(middle - side * 62.0, kOwn)},
              kOwn);
  }

  Outline shape() const {
    return mapped(difference_.corners, [&](const Vec<2>& p) { return to_page(p); });
  }

  // Outside of the shape.
  void number(const std::string& text, const Vec<2>& at) {
    const Vec<2> out = at - middle_of(shape());
    const double length = glm::length(out);
    const Vec<2> away = length > 0 ? out / length : Vec<2>(0, -1), side{-away.y, away.x};
    try_write(text,
              {centred(at + away * 25.0, kOwn), centred(at + (away + side) * 20.0, kOwn),
               centred(at + (away - side) * 20.0, kOwn), centred(at + side * 26.0, kOwn),
               centred(at - side * 26.0, kOwn), centred(at - away * 26.0, kOwn)},
              kOwn);
  }

  const frame::FrameDifference& difference_ = frame_.get<FrameDifference>();
  Box<2> area_{panel_.lo + Vec<2>(kRimNumbers, kHeading), panel_.hi - Vec<2>(4, kRimNumbers)};
  Pen pen_{list_, area_};
  double scale_ = 1;
  Vec<2> origin_{0.0};
};

}  // namespace

PanelEntry difference_panel() {
  return {{.name = "difference",
           .words = "the `difference`, the Minkowski difference of the two bodies that a `gjk` is "
                    "about, or of the first two that are there",
           .needs = "it needs a flat world and two bodies",
           .possible = language::has_two_flat_bodies},
          {.shows = {{"the difference of two bodies", has_part<FrameDifference>}}},
          {.draw = draw_as<DifferenceView>, .smallest = {160, 160}}};
}

}  // namespace lantern::draw
