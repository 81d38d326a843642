// How often a test program has asked for memory, counted where it is really asked for: the operator
// new of counted_memory.cpp, which is linked to the programs whose tests look at this.
#pragma once

#include <atomic>
#include <cstdint>

namespace lantern::counted_memory {

inline std::atomic<std::uint64_t> calls{0};
inline std::atomic<std::uint64_t> bytes{0};      // but of base/scratch.hpp, which rounds them up
inline std::atomic<std::int64_t> held{0};        // pieces that were not given back yet
inline std::atomic<std::int64_t> held_bytes{0};  // of these, rounded up as they are held

}  // namespace lantern::counted_memory
