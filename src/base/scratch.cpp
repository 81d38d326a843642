#include "base/scratch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <new>
#include <utility>

namespace lantern {
namespace {

constexpr int kLeast = 6, kMost = 26;  // sizes that are stored, as powers of two

struct Free {
  Free* next;
};
struct Store {
  std::array<Free*, kMost + 1> free{};
  bool closed = false;
};
constinit thread_local Store store;

void* from_system(std::size_t bytes) {
  return ::operator new(bytes, std::align_val_t(kScratchAlignment));
}
void to_system(void* memory) { ::operator delete(memory, std::align_val_t(kScratchAlignment)); }

struct Closer {  // when the thread ends
  ~Closer() {
    store.closed = true;
    for (Free*& first : store.free)
      while (first != nullptr) to_system(std::exchange(first, first->next));
  }
};

int power_of(std::size_t bytes) {
  return std::max(kLeast, static_cast<int>(std::bit_width(bytes - 1)));
}

}  // namespace

void* take_scratch(std::size_t bytes) {
  const int power = power_of(bytes);
  if (power > kMost) return from_system(bytes);
  Free*& first = store.free[static_cast<std::size_t>(power)];
  if (first != nullptr) return std::exchange(first, first->next);
  return from_system(std::size_t{1} << power);
}

void give_scratch_back(void* memory, std::size_t bytes) noexcept {
  thread_local const Closer closer;
  static_cast<void>(closer);
  const int power = power_of(bytes);
  if (power > kMost || store.closed) return to_system(memory);
  Free*& first = store.free[static_cast<std::size_t>(power)];
  first = new (memory) Free{first};
}

}  // namespace lantern
