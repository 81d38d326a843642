// In-betweens: pictures on the way from one frame's picture to the next one's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"
#include "frame/frame.hpp"

namespace lantern::draw {

enum class Motion {
  eased,   // a change of its own: one thing after the other, each from rest to rest
  steady,  // a part of a movement that goes on: all at once, at one speed
};

// A change lasts so long when it is shown as it is.
inline constexpr double kChangeSeconds = 0.5;

// Does the world's time go on from the one frame to the other in a small step?
bool is_one_movement(const Frame& a, const Frame& b);
// A change is eased; moments of one movement are passed steadily.
Motion motion_between(const Frame& a, const Frame& b);

// Smoothly from 0 to 1: from rest, to rest. What lies beyond is the nearer end.
double eased(double t);

// The parts of a change, each with a time of its own. They overlap, so that nothing waits.
enum class Beat {
  always,  // done from the first moment on
  out,     // what goes
  move,    // what moves
  in,      // what comes
  over,    // the new over the old,
  under,   // which goes under it, so that nothing shows through
  grow,    // what comes out of something: its way,
  dawn,    // and how soon it is seen
  fold,    // what goes back into something: its way,
  dusk,    // and how long it is seen
  swap,    // a text gives way to another one where it stands, when all has arrived
  first,   // where many parts of a tree or an atlas come at once they do so in waves,
  second,  // one after another
  third,
  count_beats  // how many there are
};

// When a part begins and ends, of the whole change 0 ... 1; between them it is eased, or goes at
// one speed.
struct BeatSpan {
  double from = 0, to = 1;
  bool is_eased = true;
};
BeatSpan span_of(Beat beat, Motion motion);

// How far a part of a change is at `t`: 0 ... 1.
double progress(Beat beat, double t, Motion motion);

// What is painted of one shape, or of two that are the same thing, in a change from picture `a` to
// picture `b`: all that a renderer of its own must know to show it.
struct Passage {
  std::optional<std::size_t>
      a = {},
      b = {};                // its shape in either picture; of both, it goes from a's to b's
  Beat move = Beat::always;  // how far on its way it is
  Beat fade = Beat::always;  // how much of it is seen,
  bool leaves = false;       // or no longer
  // A shape of one picture alone: put from its thing's box `own` upon one between these.
  Box<2> own = {}, start = {}, end = {};
};

// In the order of painting. What has the same key in both (DrawList::Scope) goes from its place,
// size and colours to the new ones. What is new comes out of its `from` as `a` shows it, or where
// it stands; what is gone goes back the same way. What goes fades first, then what moves moves,
// then what comes appears. A text glides, is faded over, or in the place of another one takes over
// at once in the end; it never says what neither picture says. What is keyed "page/..." is the
// page's own words, which are those of `a` throughout: words come last.
std::vector<Passage> passages(const DrawList& a, const DrawList& b);

// The picture at `t`, from 0, which is `a` itself, to 1, which is `b` itself, by their passages. No
// labels: what moves may pass over what stands.
DrawList between(const DrawList& a, const DrawList& b, std::span<const Passage> passages, double t,
                 Motion motion);

// What an in-between does with one shape, or with two that are the same thing.

// What the shape covers, without its stroke.
Box<2> extent_of(const DrawShape& shape);

// Equal for shapes that are drawn in one way, wherever they are: kind, roles, dashes, words.
std::string style_of(const DrawShape& shape);

// Can the one become the other by degrees? They are of one kind; polygons have equally many
// corners, lines are both dashed or both not, texts say the same.
bool can_blend(const DrawShape& a, const DrawShape& b);

// On the way from `a`, at 0, to `b`, at 1. They must be able to.
std::pair<DrawShape, Tint> blend(const DrawShape& a, const DrawShape& b, double share);

// The shape where it is when the box `from` is put upon the box `to`: moved, and as much larger or
// smaller. Of a box without width only the middle counts along that axis.
DrawShape put(DrawShape shape, const Box<2>& from, const Box<2>& to);

inline double mix(double a, double b, double share) { return a + (b - a) * share; }
inline Box<2> mix(const Box<2>& a, const Box<2>& b, double share) {
  return {a.lo + (b.lo - a.lo) * share, a.hi + (b.hi - a.hi) * share};
}

}  // namespace lantern::draw
