#pragma once

#include <cstdint>
#include <span>

namespace lantern::spatial {

// Reads the bytes as a choice of structure, its settings and a row of operations, carries them out
// and checks every invariant that must hold afterwards. A broken one stops the program. Any bytes
// are allowed; when they run out, zeros follow.
void fuzz_trees(std::span<const std::uint8_t> bytes);

}  // namespace lantern::spatial
