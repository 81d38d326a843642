// Highway without its library: that is loaded before main() and measures a clock for milliseconds,
// whether boxes are scanned or not. All that is needed of it is which of the functions compiled for
// several kinds of processor suits this one. Included before Highway's own headers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#define HWY_IS_DEBUG_BUILD 0  // what Highway asserts of itself would need the library
#ifdef __x86_64__
#define HWY_DISABLE_PCLMUL_AES  // not used here, so that a processor without them may take SSE4
#else
#define HWY_COMPILE_ONLY_STATIC  // elsewhere: what every such processor has
#endif
#include <hwy/targets.h>

// LANTERN_BEST(FUNCTION): points to the one of the target that suits this processor best.
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
#define LANTERN_BEST(FUNCTION) (&HWY_STATIC_DISPATCH(FUNCTION))
#else
#define LANTERN_BEST(FUNCTION)                                         \
  lantern::spatial::best_of<decltype(&HWY_STATIC_DISPATCH(FUNCTION))>( \
      {nullptr, HWY_CHOOSE_TARGET_LIST(FUNCTION), HWY_CHOOSE_FALLBACK(FUNCTION)})

namespace lantern::spatial {

template <class Function>
Function best_of(std::initializer_list<Function> functions) {
  // What stands for a level beside these, such as LZCNT, every such processor has; both GCC and
  // Clang know these names.
  const bool sse4 = __builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2") &&
                    __builtin_cpu_supports("popcnt");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
  std::int64_t targets = 0;
  if (__builtin_cpu_supports("ssse3")) targets |= HWY_SSSE3;
  if (sse4) targets |= HWY_SSE4;
  if (avx2) targets |= HWY_AVX2;
  if (avx3) targets |= HWY_AVX3;
  hwy::ChosenTarget chosen;
  chosen.Update(targets);
  return functions.begin()[chosen.GetIndex()];
}

}  // namespace lantern::spatial
#endif
