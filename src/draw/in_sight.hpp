// Is there anything to see?
#pragma once

#include "scenario/frame.hpp"

namespace lantern {

// Does the world panel show any body that is no ground? What another body hides counts as shown,
// and so does what only a panel twice as wide as high would show: the page's size is not known.
bool shows_a_body(const Frame& frame);

}  // namespace lantern
