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
  std::int64_t targets = 0;
  if (__builtin_cpu_supports("ssse3")) targets |= HWY_SSSE3;
  if (__builtin_cpu_supports("x86-64-v2")) targets |= HWY_SSE4;
  if (__builtin_cpu_supports("x86-64-v3")) targets |= HWY_AVX2;
  if (__builtin_cpu_supports("x86-64-v4")) targets |= HWY_AVX3;
  hwy::ChosenTarget chosen;
  chosen.Update(targets);
  return functions.begin()[chosen.GetIndex()];
}

}  // namespace lantern::spatial
#endif
