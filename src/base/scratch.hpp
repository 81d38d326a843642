// Memory for work that begins anew again and again, such as a step: what was given back is given
// out again, so that work of the same size asks the system for none.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <vector>

namespace lantern {

// Of at least so many bytes, on a cache line of its own, from operator new, which may throw.
// Whoever gives it back says as many. Each thread has a store of its own, in sizes of powers of
// two; what is larger than 64 MiB is not stored.
inline constexpr std::size_t kScratchAlignment = 64;
void* take_scratch(std::size_t bytes);
void give_scratch_back(void* memory, std::size_t bytes) noexcept;

template <class T>
struct ScratchAllocator {
  static_assert(alignof(T) <= kScratchAlignment);
  using value_type = T;
  ScratchAllocator() = default;
  template <class Other>
  ScratchAllocator(const ScratchAllocator<Other>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(take_scratch(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept {
    give_scratch_back(memory, count * sizeof(T));
  }
  bool operator==(const ScratchAllocator&) const { return true; }
};

template <class T>
using Scratch = std::vector<T, ScratchAllocator<T>>;
template <class T>
using ScratchSet = std::set<T, std::less<T>, ScratchAllocator<T>>;

}  // namespace lantern
