#include "draw/in_sight.hpp"

#include <algorithm>

#include "draw/body_shapes.hpp"
#include "draw/projection.hpp"
#include "geometry/flat.hpp"

namespace lantern {
namespace {

constexpr Box<2> kWidePanel{{0, 0}, {1600, 800}};

bool shows(const View3D& view, const FrameBody& body) {
  const std::vector<Vec<3>> corners = corners_of(body.box);
  const auto in_front = std::count_if(corners.begin(), corners.end(),
                                      [&](const Vec<3>& p) { return view.in_front(p); });
  if (in_front == 0 || view.lost(body.position)) return false;
  if (in_front < std::ssize(corners)) return true;  // the eye is beside it, or in it
  Outline outline;
  for (const Vec<3>& corner : corners) outline.push_back(view.to_page(corner));
  return overlap(box_of(outline), view.panel());
}

}  // namespace

bool shows_a_body(const Frame& frame) {
  const auto is_seen = [&](auto&& shown) {
    return std::any_of(frame.bodies.begin(), frame.bodies.end(),
                       [&](const FrameBody& body) { return !is_half_space(body) && shown(body); });
  };
  if (frame.dimension == 2)
    return is_seen(
        [&](const FrameBody& body) { return overlap(flat(body.box), flat(frame.bounds)); });
  const View3D view(frame.bounds, frame.camera, kWidePanel);
  return is_seen([&](const FrameBody& body) { return shows(view, body); });
}

}  // namespace lantern
