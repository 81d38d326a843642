// A broken invariant is a fault of Lantern, never of its user: it stops the program with both
// values.
#pragma once

#include <string>

#include <fmt/format.h>

namespace lantern::detail {

// Says it on standard error, and aborts.
[[noreturn]] void stop_broken(const std::string& text);

template <class A, class B>
[[noreturn]] void check_failed(const char* file, int line, const char* text, const A& a,
                               const B& b) {
  stop_broken(
      fmt::format("{}:{}: broken invariant: {} (left {}, right {})", file, line, text, a, b));
}

}  // namespace lantern::detail

// LANTERN_CHECK(a, ==, b): stops with both values unless the comparison holds. Always on. It names
// the file without its folder: where Lantern was built is nobody's business where it is installed.
#define LANTERN_CHECK(a, op, b)                                                              \
  do {                                                                                       \
    const auto& lantern_a = (a);                                                             \
    const auto& lantern_b = (b);                                                             \
    if (!(lantern_a op lantern_b))                                                           \
      ::lantern::detail::check_failed(__FILE_NAME__, __LINE__, #a " " #op " " #b, lantern_a, \
                                      lantern_b);                                            \
  } while (false)
