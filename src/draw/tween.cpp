#include "draw/tween.hpp"

#include <algorithm>
#include <utility>

#include "base/stop.hpp"
#include "draw/tween_plan.hpp"
#include "draw/tween_shapes.hpp"

namespace lantern::draw {
namespace {

// When each part of a change begins and ends. They overlap, so that nothing waits.
struct Span {
  double from, to;
  double at(double t) const { return std::clamp((t - from) / (to - from), 0.0, 1.0); }
};

// How far each part of a change is.
struct Phases {
  Phases(double t, Motion motion) {
    const bool stage = motion == Motion::eased;
    const auto part = [&](const Span& staged, const Span& other) {
      return stage ? eased(staged.at(t)) : other.at(t);
    };
    out = part({0, 0.35}, {0, 0.5});
    move = part({0.1, 0.75}, {0, 1});
    in = part({0.65, 1}, {0.5, 1});
    over = part({0.2, 0.5}, {0.2, 0.5});
    under = part({0.4, 0.7}, {0.5, 0.8});
    grow = part({0.2, 0.85}, {0, 1});
    dawn = part({0.2, 0.45}, {0, 0.4});
    fold = part({0, 0.65}, {0, 1});
    dusk = part({0.4, 0.65}, {0.6, 1});
  }
  double out, move, in;  // what goes, moves, comes
  double over, under;    // the new over the old, which goes under it, so that nothing shows through
  double grow, dawn;     // what comes out of something: its way, and how soon it is seen
  double fold, dusk;     // what goes back into something
};

class Tween {
 public:
  Tween(const DrawList& a, const DrawList& b, double t, Motion motion)
      : a_(a), b_(b), phases_(t, motion), plan_(plan_tween(a, b)) {}

  // What goes is painted before what lay on it; what is handed on passes over all else.
  DrawList made() {
    out_.page = b_.page;
    std::size_t next = 0;  // of a, that is not yet painted if it goes
    for (std::size_t i = 0; i < b_.shapes.size(); ++i) {
      stop_if_asked();
      if (plan_.of_b[i].kind == Fate::meets)
        for (; next < plan_.of_b[i].mate; ++next) paint_old(next);
      paint_new(i);
    }
    for (; next < a_.shapes.size(); ++next) paint_old(next);
    for (std::size_t i = 0; i < a_.shapes.size(); ++i)
      if (plan_.of_a[i].kind == Fate::handed)
        add_blend(a_.shapes[i], b_.shapes[plan_.of_a[i].mate], phases_.fold);
    for (std::size_t i = 0; i < b_.shapes.size(); ++i)
      if (plan_.of_b[i].kind == Fate::handed)
        add_blend(a_.shapes[plan_.of_b[i].mate], b_.shapes[i], phases_.grow);
    return std::move(out_);
  }

 private:
  void add(DrawShape shape, double opacity, Tint tint = {}) {
    tint.opacity = std::clamp(opacity, 0.0, 1.0);
    if (!(tint.opacity > 0)) return;
    out_.shapes.push_back(std::move(shape));
    out_.tints.push_back(tint);
  }

  void add_blend(const DrawShape& a, const DrawShape& b, double share) {
    if (a == b) return add(b, 1);
    auto [shape, tint] = blend(a, b, share);
    add(std::move(shape), 1, tint);
  }

  void paint_new(std::size_t i) {
    const Fate& fate = plan_.of_b[i];
    const DrawShape& shape = b_.shapes[i];
    const Phases& p = phases_;
    const auto on_the_way = [&](double share) {
      return put(shape, fate.own, mix(fate.other, fate.own, share));
    };
    switch (fate.kind) {
      case Fate::handed:  // painted last
      case Fate::hidden:
        return;
      case Fate::stands:
        return add(shape, 1);
      case Fate::fades:
        return add(shape, p.in);
      case Fate::follows:
        return add(on_the_way(p.move), is_text(shape) ? p.in : p.over);
      case Fate::emerges:
        return add(on_the_way(p.grow), p.dawn);
      case Fate::meets:
        return add_blend(a_.shapes[fate.mate], shape, p.move);
    }
  }

  void paint_old(std::size_t i) {
    const Fate& fate = plan_.of_a[i];
    const DrawShape& shape = a_.shapes[i];
    const Phases& p = phases_;
    const auto on_the_way = [&](double share) {
      return put(shape, fate.own, mix(fate.own, fate.other, share));
    };
    switch (fate.kind) {
      case Fate::meets:   // painted with its mate
      case Fate::handed:  // painted last
      case Fate::hidden:
        return;
      case Fate::stands:
        return add(shape, 1);
      case Fate::fades:
        return add(shape, 1 - p.out);
      case Fate::follows:
        return add(on_the_way(p.move), 1 - (is_text(shape) ? p.out : p.under));
      case Fate::emerges:
        return add(on_the_way(p.fold), 1 - p.dusk);
    }
  }

  static bool is_text(const DrawShape& shape) { return std::holds_alternative<TextShape>(shape); }

  const DrawList &a_, &b_;
  Phases phases_;
  TweenPlan plan_;
  DrawList out_;
};

}  // namespace

// Smootherstep (Perlin, 2002): at both ends neither speed nor acceleration.
double eased(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (t * (6 * t - 15) + 10);
}

DrawList between(const DrawList& a, const DrawList& b, double t, Motion motion) {
  if (t <= 0) return a;
  if (t >= 1) return b;
  return Tween(a, b, t, motion).made();
}

}  // namespace lantern::draw
