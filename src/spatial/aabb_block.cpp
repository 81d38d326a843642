// Compiled once for each kind of processor, and chosen when it runs, as box_scan.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "spatial/aabb_block.cpp"
#include "spatial/aabb_block.hpp"

// clang-format off: before Highway's own
#include "spatial/vector_target.hpp"
// clang-format on

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lantern::spatial::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, kAabbBlock>;

// look(at): the mask of the lanes from place `at` on.
template <class Look>
std::uint32_t BitsOf(std::uint32_t first, Look look) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < kAabbBlock; i += static_cast<std::uint32_t>(hn::Lanes(Lanes()))) {
    std::uint8_t part[8] = {};
    hn::StoreMaskBits(Lanes(), look(first + i), part);
    bits |= (part[0] | std::uint32_t{part[1]} << 8) << i;
  }
  return bits;
}

template <int D>
BlockBits Reached(const BoxTable<D>& table, std::uint32_t first, const AabbNode<D>& asked) {
  const auto bits = [&](int smaller) {
    return BitsOf(first, [&](std::uint32_t at) {
      auto all = hn::FirstN(Lanes(), kAabbBlock);
      for (int i = 0; i < D; ++i) {
        const auto lo = hn::Set(Lanes(), detail::stepped(asked.lo[i], smaller));
        const auto hi = hn::Set(Lanes(), detail::stepped(asked.hi[i], -smaller));
        all = hn::And(all, hn::And(hn::Le(hn::LoadU(Lanes(), table.lo(i) + at), hi),
                                   hn::Le(lo, hn::LoadU(Lanes(), table.hi(i) + at))));
      }
      return all;
    });
  };
  return {bits(0), bits(2)};
}

// The slab method (geometry/ray.hpp), each span widened by what float may have lost.
template <int D>
std::uint32_t Met(const BoxTable<D>& table, std::uint32_t first, const FloatRay<D>& ray,
                  float limit) {
  const auto set = [](float x) { return hn::Set(Lanes(), x); };
  const auto less = set(1 - 0x1p-21f), more = set(1 + 0x1p-21f);
  return BitsOf(first, [&](std::uint32_t at) {
    auto from = set(0), to = set(limit);
    auto all = hn::FirstN(Lanes(), kAabbBlock);
    for (int i = 0; i < D; ++i) {
      const auto lo = hn::LoadU(Lanes(), table.lo(i) + at);
      const auto hi = hn::LoadU(Lanes(), table.hi(i) + at);
      if (ray.stands[i]) {
        all = hn::And(all, hn::And(hn::Le(lo, set(ray.above[i])), hn::Le(set(ray.below[i]), hi)));
        continue;
      }
      const auto inverse = set(ray.inverse[i]), origin = set(ray.origin[i]);
      const auto a = hn::Mul(hn::Sub(lo, origin), inverse);
      const auto b = hn::Mul(hn::Sub(hi, origin), inverse);
      const auto begin = hn::Sub(hn::Min(a, b), set(ray.slack[i]));
      const auto end = hn::Add(hn::Max(a, b), set(ray.slack[i]));
      from = hn::Max(from, hn::Mul(begin, less));
      to = hn::Min(to, hn::Max(hn::Mul(end, less), hn::Mul(end, more)));
    }
    return hn::And(all, hn::Le(from, to));
  });
}

BlockBits Reached2(const BoxTable<2>& table, std::uint32_t first, const AabbNode<2>& asked) {
  return Reached(table, first, asked);
}
BlockBits Reached3(const BoxTable<3>& table, std::uint32_t first, const AabbNode<3>& asked) {
  return Reached(table, first, asked);
}
std::uint32_t Met2(const BoxTable<2>& table, std::uint32_t first, const FloatRay<2>& ray,
                   float limit) {
  return Met(table, first, ray, limit);
}
std::uint32_t Met3(const BoxTable<3>& table, std::uint32_t first, const FloatRay<3>& ray,
                   float limit) {
  return Met(table, first, ray, limit);
}

}  // namespace lantern::spatial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lantern::spatial {

BlockBits reached_in_block(const BoxTable<2>& table, std::uint32_t first,
                           const AabbNode<2>& asked) {
  static const auto best = LANTERN_BEST(Reached2);
  return best(table, first, asked);
}
BlockBits reached_in_block(const BoxTable<3>& table, std::uint32_t first,
                           const AabbNode<3>& asked) {
  static const auto best = LANTERN_BEST(Reached3);
  return best(table, first, asked);
}
std::uint32_t met_in_block(const BoxTable<2>& table, std::uint32_t first, const FloatRay<2>& ray,
                           float limit) {
  static const auto best = LANTERN_BEST(Met2);
  return best(table, first, ray, limit);
}
std::uint32_t met_in_block(const BoxTable<3>& table, std::uint32_t first, const FloatRay<3>& ray,
                           float limit) {
  static const auto best = LANTERN_BEST(Met3);
  return best(table, first, ray, limit);
}

}  // namespace lantern::spatial
#endif
