// The table of the narrow phase: which handler a pair of shapes has.
#include <array>

#include "physics/collide_forms.hpp"

namespace lantern {
namespace narrow {
namespace {

template <int D>
using Form = std::variant<Ball<D>, Block<D>, Rod<D>, Wall<D>>;

template <int D>
Form<D> form_of(const Placed<D>& placed, const Vec<D>& center) {
  if (const auto* sphere = std::get_if<Sphere>(&placed.shape))
    return Ball<D>{center, sphere->radius};
  if (const auto* box = std::get_if<AxisBox<D>>(&placed.shape))
    return Block<D>{center, Mat<D>(1.0), box->half_size, 0};
  if (const auto* box = std::get_if<OrientedBox<D>>(&placed.shape))
    return Block<D>{center, matrix(placed.orientation), box->half_size, 0};
  if (const auto* capsule = std::get_if<Capsule>(&placed.shape))
    return Rod<D>{center, matrix(placed.orientation), capsule->half_length, capsule->radius};
  return Wall<D>{center, std::get<HalfSpace<D>>(placed.shape).normal};
}

using Sizes = std::array<double, 3>;

template <int D>
Sizes sizes_of(const Placed<D>& placed) {
  const auto of_box = [](const Vec<D>& half) {
    Sizes sizes{};
    for (int i = 0; i < D; ++i) sizes[static_cast<std::size_t>(i)] = half[i];
    return sizes;
  };
  if (const auto* sphere = std::get_if<Sphere>(&placed.shape)) return {sphere->radius, 0, 0};
  if (const auto* box = std::get_if<AxisBox<D>>(&placed.shape)) return of_box(box->half_size);
  if (const auto* box = std::get_if<OrientedBox<D>>(&placed.shape)) return of_box(box->half_size);
  if (const auto* capsule = std::get_if<Capsule>(&placed.shape))
    return {capsule->radius, capsule->half_length, 0};
  return {};
}

// Whether the pair is to be handled as (a, b) rather than (b, a). Handlers know each pair of forms
// in one order only, and a pair of equal forms must give the same contact in both orders. So the
// larger sizes come first. Equal shapes are ordered along a direction that is skew to everything
// that scenes are made of: no pile or row of boxes is close to where the order changes.
template <int D>
bool is_in_order(const Placed<D>& a, const Placed<D>& b, const Form<D>& form_a,
                 const Form<D>& form_b) {
  if (form_a.index() != form_b.index()) return form_a.index() < form_b.index();
  const Sizes sizes_a = sizes_of(a), sizes_b = sizes_of(b);
  if (sizes_a != sizes_b) return sizes_a > sizes_b;
  const double skew[] = {0.3542, 0.8117, 0.4641};
  double along = 0;
  for (int i = 0; i < D; ++i) along += skew[i] * (b.position[i] - a.position[i]);
  return along >= 0;
}

template <int D>
Contact<D> touch_in_order(const Form<D>& a, const Form<D>& b, double margin) {
  return std::visit(
      [&](const auto& x, const auto& y) -> Contact<D> {
        if constexpr (requires { touch(x, y, margin); })
          return touch(x, y, margin);
        else
          return std::nullopt;  // two half-spaces; the other pairs have been put in order
      },
      a, b);
}

}  // namespace
}  // namespace narrow

// Positions are subtracted before anything else, so that far from the origin only their own
// rounding is lost.
template <int D>
std::optional<Manifold<D>> collide(const Placed<D>& a, const Placed<D>& b, double margin) {
  const auto at_origin = narrow::form_of(a, Vec<D>(0.0));
  const auto at_offset = narrow::form_of(b, b.position - a.position);
  const bool in_order = narrow::is_in_order(a, b, at_origin, at_offset);
  const Placed<D>& first = in_order ? a : b;
  auto contact = in_order
                     ? narrow::touch_in_order(at_origin, at_offset, margin)
                     : narrow::touch_in_order(narrow::form_of(b, Vec<D>(0.0)),
                                              narrow::form_of(a, a.position - b.position), margin);
  if (!contact) return contact;
  if (!in_order) contact->normal = -contact->normal;
  for (int i = 0; i < contact->count; ++i)
    contact->room[static_cast<std::size_t>(i)].position += first.position;
  return contact;
}

template std::optional<Manifold<2>> collide(const Placed<2>&, const Placed<2>&, double);
template std::optional<Manifold<3>> collide(const Placed<3>&, const Placed<3>&, double);

}  // namespace lantern
