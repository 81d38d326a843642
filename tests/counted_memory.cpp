#include "counted_memory.hpp"

#include <cstdlib>
#include <new>

#include <malloc.h>

// Where one of the pair is inlined and the other is not, GCC takes them for strangers (bug 103993).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace {

void* counted(std::size_t size, std::size_t line) noexcept {
  using namespace lantern::counted_memory;
  ++calls;
  ++held;
  if (line == 0) bytes += size;
  const std::size_t room = size == 0 ? 1 : size;
  void* memory =
      line == 0 ? std::malloc(room) : std::aligned_alloc(line, (room + line - 1) / line * line);
  held_bytes += static_cast<std::int64_t>(malloc_usable_size(memory));
  return memory;
}
void* counted_or_thrown(std::size_t size, std::size_t line = 0) {
  if (void* memory = counted(size, line)) return memory;
  throw std::bad_alloc();
}
void given_back(void* memory) noexcept {
  lantern::counted_memory::held -= memory != nullptr;
  lantern::counted_memory::held_bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted_or_thrown(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted(size, 0); }
void* operator new(std::size_t size, std::align_val_t line) {
  return counted_or_thrown(size, static_cast<std::size_t>(line));
}
void operator delete(void* memory) noexcept { given_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { given_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { given_back(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { given_back(memory); }
