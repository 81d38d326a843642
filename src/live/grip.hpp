// A hand on a picture: what it holds, and what the text says when it has moved.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "draw/draw_list.hpp"
#include "frame/frame.hpp"
#include "language/scenario.hpp"
#include "live/play.hpp"
#include "rooms.hpp"

namespace lantern::live {

// Where a hand is, in page units; how it has been turned since it went down, degrees; and how fast
// it moves when it lets go, page units a second; 0: it puts down.
struct Hand {
  Vec<2> at{0.0};
  double turn = 0;
  Vec<2> velocity{0.0};
};

class Grip {
 public:
  virtual ~Grip() = default;
  // "position", "move", "size" or "corner": what of the text changes.
  virtual std::string_view what() const = 0;
  // The text that puts what is held where the hand is.
  virtual std::string text(const Hand& hand) = 0;
  // The moment to be looked at in that text.
  Moment moment;
  // Nothing before that moment's step changes, wherever the hand goes.
  bool only_from_there = false;
};

// The text with a body more, where that frame of its play has most room, and with a step behind the
// frame's in which it enters. `entity` becomes what a page calls it.
std::string with_another(std::string_view text, const Play& play, const frame::Frame& whole,
                         std::string& entity);

// With a step in which that body leaves, in the same way.
std::string without(std::string_view text, const frame::Frame& whole, std::string_view entity);

// On a body or texture, as a page names it: "body/red", behind its side's prefix; or, if it is
// empty, on a corner of a level's walls that is near. Throws Refused where there is nothing to be
// moved. `text` is that of the play.
std::unique_ptr<Grip> grip_on(std::string_view text, Play& play, std::size_t index,
                              std::string_view entity, const Vec<2>& at);

}  // namespace lantern::live
