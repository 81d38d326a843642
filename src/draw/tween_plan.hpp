// Who is who in two pictures, for the ones between them.
#pragma once

#include <cstddef>
#include <vector>

#include "draw/draw_list.hpp"

namespace lantern::draw {

// What becomes of a shape of either picture.
struct Fate {
  enum Kind {
    fades,    // where it stands
    meets,    // it is `mate` of the other picture
    handed,   // the same, of a thing that it takes over from or gives way to
    follows,  // its thing, from the other picture's place
    emerges,  // out of, or back into, another thing's box or middle, or its own middle
    stands,   // as it is, all the while
    hidden,   // another shape stands for it
  };
  Kind kind = fades;
  std::size_t mate = 0;
  Box<2> own, other;  // where its thing is, and where that was or is to be
};

// One for each shape of either picture.
struct TweenPlan {
  std::vector<Fate> of_a, of_b;
};

// By their keys: what has none is the same only where it looks the same.
TweenPlan plan_tween(const DrawList& a, const DrawList& b);

}  // namespace lantern::draw
