// Counts how often a module asks for memory: its own operator new, which only the module itself
// calls (it is linked with -Bsymbolic). To be included in one source of a module.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <new>

namespace lantern::peers {
inline std::uint64_t calls_for_memory = 0;
}

void* operator new(std::size_t bytes) {
  ++lantern::peers::calls_for_memory;
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
