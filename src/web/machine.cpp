// The machine that a page is: no files, no standard streams but what the page logs, and as much
// memory as its module may take.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/check.hpp"
#include "base/memory.hpp"

namespace lantern {

namespace {
std::uint64_t budget = std::uint64_t{256} << 20;
}

std::uint64_t machine_memory() { return std::uint64_t{1} << 30; }
std::uint64_t memory_budget() { return budget; }
void set_memory_budget(std::uint64_t bytes) { budget = bytes; }

// The page's script sees that the engine has ended, and makes a new one.
void detail::stop_broken(const std::string& text) {
  std::fprintf(stderr, "%s\n", text.c_str());
  std::abort();
}

}  // namespace lantern

// What is to be done when a thread ends: the page's ends with the page.
extern "C" int __cxa_thread_atexit(void (*)(void*), void*, void*) { return 0; }
