#include <fmt/format.h>

#include "draw/sample_frames.hpp"

namespace lantern::samples {

Named worlds() { return {}; }

}  // namespace lantern::samples
