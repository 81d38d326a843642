// Which closed form, or search, a pair of shapes has.
#include <array>
#include <variant>

#include "physics/collide_cores.hpp"

namespace lantern {
namespace narrow {
namespace {

template <int D>
using Placing = std::variant<PlacedCore<D>, Wall<D>>;

template <int D>
Placing<D> placing_of(const Placed<D>& placed, const Vec<D>& center) {
  using Kind = typename PlacedCore<D>::Kind;
  const auto core = [&](Kind kind, const Core<D>& core) -> Placing<D> {
    const bool is_turned = core.turns && kind != Kind::point;
    const Mat<D> axes = is_turned ? matrix(placed.orientation) : Mat<D>(1.0);
    return PlacedCore<D>{kind, center, axes, core.half, core.radius};
  };
  return std::visit(EachShape{
                        [&](const Sphere& s) { return core(Kind::point, core_of<D>(s)); },
                        [&](const AxisBox<D>& s) { return core(Kind::box, core_of<D>(s)); },
                        [&](const OrientedBox<D>& s) { return core(Kind::box, core_of<D>(s)); },
                        [&](const Capsule& s) { return core(Kind::segment, core_of<D>(s)); },
                        [&](const HalfSpace<D>& s) -> Placing<D> {
                          return Wall<D>{center, s.normal};
                        },
                    },
                    placed.shape);
}

template <int D>
std::array<double, D + 1> sizes_of(const PlacedCore<D>& core) {
  std::array<double, D + 1> sizes{core.radius};
  for (int i = 0; i < D; ++i) sizes[static_cast<std::size_t>(i) + 1] = core.half[i];
  return sizes;
}

// Whether a pair is to be handled as (a, b) rather than (b, a); `offset` leads from a to b. Closed
// forms know each pair of kinds in one order only, and a pair of equal kinds must give the same
// contact in both orders. So the larger sizes come first. Equal shapes are ordered along a
// direction that is skew to everything that scenes are made of: no pile or row of boxes is close to
// where the order changes.
template <int D>
bool is_in_order(const Placing<D>& a, const Placing<D>& b, const Vec<D>& offset) {
  if (a.index() != b.index()) return a.index() < b.index();
  if (const auto* core_a = std::get_if<PlacedCore<D>>(&a)) {
    const auto& core_b = *std::get_if<PlacedCore<D>>(&b);
    if (core_a->kind != core_b.kind) return core_a->kind < core_b.kind;
    const auto sizes_a = sizes_of(*core_a), sizes_b = sizes_of(core_b);
    if (sizes_a != sizes_b) return sizes_a > sizes_b;
  }
  const double skew[] = {0.3542, 0.8117, 0.4641};
  double along = 0;
  for (int i = 0; i < D; ++i) along += skew[i] * offset[i];
  return along >= 0;
}

template <int D>
Contact<D> touch_cores(const PlacedCore<D>& a, const PlacedCore<D>& b, double margin) {
  using Kind = typename PlacedCore<D>::Kind;
  switch (a.kind) {
    case Kind::point:
      return b.kind == Kind::point ? touch_points(a, b, margin)
             : b.kind == Kind::box ? touch_point_and_box(a, b, margin)
                                   : touch_point_and_segment(a, b, margin);
    case Kind::box:
      return touch_blocks(a, b, margin);
    case Kind::segment:
      return touch_segments(a, b, margin);
  }
  return std::nullopt;
}

template <int D>
Contact<D> touch_in_order(const Placing<D>& a, const Placing<D>& b, double margin) {
  const auto* core_a = std::get_if<PlacedCore<D>>(&a);
  if (core_a == nullptr) return std::nullopt;  // two half-spaces
  return std::visit(
      EachShape{
          [&](const PlacedCore<D>& core_b) { return touch_cores(*core_a, core_b, margin); },
          [&](const Wall<D>& wall) { return touch_wall(*core_a, wall, margin); },
      },
      b);
}

}  // namespace
}  // namespace narrow

// Positions are subtracted before anything else, so that far from the origin only their own
// rounding is lost.
template <int D>
std::optional<Manifold<D>> collide(const Placed<D>& a, const Placed<D>& b, double margin) {
  const Vec<D> offset = b.position - a.position;
  const auto at_origin = narrow::placing_of(a, Vec<D>(0.0));
  const auto at_offset = narrow::placing_of(b, offset);
  const bool in_order = narrow::is_in_order<D>(at_origin, at_offset, offset);
  const Placed<D>& first = in_order ? a : b;
  auto contact =
      in_order ? narrow::touch_in_order<D>(at_origin, at_offset, margin)
               : narrow::touch_in_order<D>(narrow::placing_of(b, Vec<D>(0.0)),
                                           narrow::placing_of(a, a.position - b.position), margin);
  if (!contact) return contact;
  if (!in_order) contact->normal = -contact->normal;
  for (int i = 0; i < contact->count; ++i)
    contact->room[static_cast<std::size_t>(i)].position += first.position;
  return contact;
}

template std::optional<Manifold<2>> collide(const Placed<2>&, const Placed<2>&, double);
template std::optional<Manifold<3>> collide(const Placed<3>&, const Placed<3>&, double);

}  // namespace lantern
