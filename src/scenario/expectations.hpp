// Does a frame meet the expectations of its step?
#pragma once

#include <optional>
#include <string>

#include "scenario/frame.hpp"

namespace lantern {

// Nothing if the expectation holds on this frame; otherwise what was expected and what was found.
std::optional<std::string> unmet(const Expectation& expectation, const Frame& frame);

}  // namespace lantern
