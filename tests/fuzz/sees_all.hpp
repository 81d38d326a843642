// The fuzzer sees all that the program has but its command line.
#pragma once

#include "rooms.hpp"

namespace lantern::fuzz {
using namespace measure;
using namespace render;
}  // namespace lantern::fuzz
