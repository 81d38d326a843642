#include "draw/world/locator.hpp"

#include <algorithm>

#include "draw/body_shapes.hpp"
#include "draw/borders.hpp"
#include "draw/world/world2d_parts.hpp"
#include "geometry/flat.hpp"

namespace lantern::draw {
namespace {

constexpr double kInsetShare = 0.24;   // of the picture's width
constexpr double kInsetHighest = 0.3;  // and of its height at most
constexpr double kFromRim = 12;        // from the picture's border

Vec<2> size_in(const Box<2>& picture) {
  const Vec<2> room = picture.size();
  const double share = std::min(kInsetShare, kInsetHighest);
  return room * share;
}

// What of the bodies it would hide; those that the frame is about count most.
double hidden_by(const Box<2>& place, const Frame& frame, const View2D& map) {
  double area = 0;
  for (const FrameBody& body : frame.bodies) {
    if (is_half_space(body)) continue;
    const Box<2> box = map.to_page(body.box);
    if (!overlap(box, place)) continue;
    const Vec<2> common = glm::min(box.hi, place.hi) - glm::max(box.lo, place.lo);
    area += common.x * common.y * (body.lit ? 4 : 1);
  }
  return area;
}

void draw_largest_cells(const Frame& frame, const View2D& map, DrawList& list) {
  constexpr std::uint32_t kDeepest = 3;
  Borders borders;
  for (const FrameNode& node : frame.nodes) {
    if (node.depth == 0 || node.depth > kDeepest) continue;
    if (node.region.empty())
      borders.add(map.to_page(node.box), node.depth, 0);
    else
      list.polygon(page_region(node, map), Role::none, {cell_line_role(node.depth), 1});
  }
  borders.draw_plainly({Role::cell_line_2, 1}, list);
}

}  // namespace

Box<2> place_of_locator(const Frame& frame, const View2D& map) {
  const Box<2>& picture = map.picture();
  const Vec<2> size = size_in(picture);
  const Box<2> room = shrunk(picture, kFromRim);
  const Box<2> corners[] = {{{room.hi.x - size.x, room.lo.y}, {room.hi.x, room.lo.y + size.y}},
                            {room.lo, room.lo + size},
                            {room.hi - size, room.hi},
                            {{room.lo.x, room.hi.y - size.y}, {room.lo.x + size.x, room.hi.y}}};
  return *std::ranges::min_element(
      corners, {}, [&](const Box<2>& corner) { return hidden_by(corner, frame, map); });
}

void draw_locator(const Frame& frame, const Box<2>& place, DrawList& list) {
  constexpr std::size_t kMostDots = 200;
  const DrawList::Scope scope(list, "world/locator");
  list.crisp_rect(place, Role::paper, {Role::quiet_ink, 1.6});
  const View2D map(flat(frame.bounds), place);
  if (frame.display.cells) draw_largest_cells(frame, map, list);
  for (const FrameBody& body : first_of(frame.bodies, kMostDots)) {
    if (is_half_space(body) || !contains(frame.bounds, body.box.center())) continue;
    const Box<2> box = map.to_page(body.box);
    const double radius = std::clamp(std::min(box.size().x, box.size().y) / 2, 1.6, 7.0);
    const Vec<2> rim(radius + 1);
    const Vec<2> at = glm::clamp(box.center(), place.lo + rim, place.hi - rim);
    list.disc(at, radius, body.is_static ? Role::static_body : body_role(body.color));
  }
  list.crisp_rect(map.to_page(*frame.view), Role::none, {Role::panel, 5.2});
  list.crisp_rect(map.to_page(*frame.view), Role::none, {Role::lit, 2.8});
}

}  // namespace lantern::draw
