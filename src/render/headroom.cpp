#include "render/headroom.hpp"

#include <algorithm>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "base/error.hpp"
#include "base/memory.hpp"

namespace lantern::render {
namespace {

// Measured with the Mesa of Debian 12: 300 MB with libraries and shaders, of these 100 MB once
// there is a context, and two threads a core, of at most 32. The rest is for other versions.
constexpr std::uint64_t kContext = 400'000'000, kShaders = 160'000'000;  // bytes
constexpr std::uint64_t kMostCores = 32;

// A picture is there three times (drawn, read back, encoded) while shaders are compiled.
constexpr std::uint64_t kBytesPerPixel = 12;

// Is there so little that the allocator must save?
bool is_limited() {
  constexpr rlim_t kPlenty = rlim_t{4} << 30;
  for (const auto which : {RLIMIT_AS, RLIMIT_DATA})
    if (rlimit limit{}; ::getrlimit(which, &limit) == 0 && limit.rlim_cur < kPlenty) return true;
  return false;
}

std::uint64_t stack_bytes() {
  pthread_attr_t defaults;
  std::size_t bytes = 0;
  if (::pthread_getattr_default_np(&defaults) != 0) return bytes;
  ::pthread_attr_getstacksize(&defaults, &bytes);
  ::pthread_attr_destroy(&defaults);
  return bytes;
}

void require_room(std::uint64_t bytes) {
  void* room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (const auto budget = room == MAP_FAILED ? budget_needed(bytes) : std::nullopt) try {
      refuse_memory(*budget, "pictures by OpenGL", "make them smaller, or SVG where that will do");
    } catch (const Refused& refused) {  // neither the picture nor the backend is wrong
      throw std::runtime_error(refused.what());
    }
  if (room == MAP_FAILED)
    throw BackendError(
        fmt::format("out of memory: OpenGL needs room for {} MB, which the limits of this process "
                    "do not leave; "
                    "raise them (ulimit -v, ulimit -d), or draw with --format svg",
                    bytes / 1'000'000));
  ::munmap(room, bytes);
}

}  // namespace

void require_room_for_context() {
  if (is_limited()) ::mallopt(M_ARENA_MAX, 1);
  const std::uint64_t cores =
      std::min<std::uint64_t>(std::thread::hardware_concurrency(), kMostCores);
  require_room(kContext + 2 * cores * stack_bytes());
}

void require_room_for_pixels(std::uint64_t pixels) {
  require_room(kShaders + kBytesPerPixel * pixels);
}

}  // namespace lantern::render
