// In-betweens: pictures on the way from one frame's picture to the next one's.
#pragma once

#include "draw/draw_list.hpp"

namespace lantern::draw {

enum class Motion {
  eased,   // a change of its own: one thing after the other, each from rest to rest
  steady,  // a part of a movement that goes on: all at once, at one speed
};

// Smoothly from 0 to 1: from rest, to rest. What lies beyond is the nearer end.
double eased(double t);

// The picture at `t`, from 0, which is `a` itself, to 1, which is `b` itself. What has the same key
// in both (DrawList::Scope) goes from its place, size and colours to the new ones. What is new
// comes out of its `from` as `a` shows it, or where it stands; what is gone goes back the same way.
// Eased, what goes fades first, then what moves moves, then what comes appears. A text glides or is
// faded over; it never says what neither picture says. What is keyed "page/..." is the page's own
// words, which are those of `b` throughout. No labels: what moves may pass over what stands.
DrawList between(const DrawList& a, const DrawList& b, double t, Motion motion = Motion::eased);

}  // namespace lantern::draw
