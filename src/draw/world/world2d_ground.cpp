#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "draw/number_text.hpp"
#include "draw/world/borders.hpp"
#include "draw/world/world2d_parts.hpp"
#include "frame/parts/ground.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeastDepth = 10;  // page units of ground that can be seen as such
const Vec<2> kRimOutside{20, 20};   // for ground that lies beyond the bounds

// How far the polygon reaches behind the surface.
double depth_behind(const std::vector<Vec<2>>& polygon, const Plane<2>& surface) {
  return greatest_of<double>(0, polygon, [&](const Vec<2>& p) {
    return surface.offset - surface.normal.x * p.x - surface.normal.y * p.y;
  });
}

// The two half edges of a turned box, from its centre, on the page.
struct HalfEdges {
  Vec<2> along{0.0};
  Vec<2> across{0.0};
  Vec<3> half{0.0};  // sizes of the box
};

std::optional<HalfEdges> half_edges_of(const FrameBody& body, double scale) {
  const auto* box = std::get_if<OrientedBox<3>>(&body.shape);
  if (!box || !body.lit) return std::nullopt;
  const auto [s, c] = geometry::sin_cos(body.angle);
  if (std::abs(s) < 1e-9 || std::abs(c) < 1e-9) return std::nullopt;
  return HalfEdges{Vec<2>(c, -s) * (box->half_size.x * scale),
                   Vec<2>(-s, -c) * (box->half_size.y * scale), box->half_size};
}

constexpr Role kAlong = Role::ray, kAcross = Role::frustum;  // the half edges' colours

// |R| h: both half edges' parts along an axis, laid end to end, are half the size of the box around
// them.
void draw_projections(const World2D& w, const FrameBody& body, const HalfEdges& edges,
                      const Box<2>& box, Pen& pen) {
  constexpr double kAway = 16, kWidth = 5;
  const TextStyle style{std::max(kLabel, 22.0), Weight::semibold, Role::ink, Role::panel};
  const Vec<2> c = box.center();
  pen.arrow(c, c + edges.along, {kAlong, 3.4}, 12, 1.4);
  pen.arrow(c, c + edges.across, {kAcross, 3.4}, 12, 1.4);
  const Vec<2> turned = unit_at(body.angle);
  const double cosine = std::abs(turned.x), sine = std::abs(turned.y);
  const auto sum = [](double a, double b) {
    return fmt::format("{} + {} = {}", short_number(a), short_number(b), short_number(a + b));
  };
  const double above = box.lo.y - kAway, beside = box.hi.x + kAway;
  const double x = c.x + std::abs(edges.along.x), y = c.y - std::abs(edges.along.y);
  pen.line({c.x, above}, {x, above}, {kAlong, kWidth});
  pen.line({x, above}, {box.hi.x, above}, {kAcross, kWidth});
  pen.line({beside, c.y}, {beside, y}, {kAlong, kWidth});
  pen.line({beside, y}, {beside, box.lo.y}, {kAcross, kWidth});
  const Vec<3>& h = edges.half;
  const std::string wide = sum(h.x * cosine, h.y * sine), high = sum(h.x * sine, h.y * cosine);
  w.labels.block({{c.x, above - 4}, {box.hi.x, above + 4}});
  w.labels.block({{beside - 4, box.lo.y}, {beside + 4, c.y}});
  w.labels.try_add(wide, {{{c.x, above - 12}, 0}, {{box.hi.x, above - 12}, 1}}, style,
                   w.map.panel());
  w.labels.try_add(high, {{{beside + 12, (c.y + box.lo.y) / 2 + 8}, 0}, {{beside, c.y + 30}, 0}},
                   style, w.map.panel());
}

void draw_dimension(Pen& pen, const Vec<2>& from, const Vec<2>& to) {
  const Vec<2> way = to - from;
  const Vec<2> across = Vec<2>(-way.y, way.x) / std::max(1e-9, geometry::hypot(way.x, way.y)) * 5.0;
  const Stroke stroke{Role::quiet_ink, 1.6};
  pen.line(from, to, stroke);
  for (const Vec<2>& end : {from, to}) pen.line(end - across, end + across, stroke);
}

// Half the width above the box, half the height at its right.
void draw_half_sizes(const World2D& w, const FrameBody& body, const Box<2>& box, Pen& pen) {
  constexpr double kAway = 12, kLeastSize = 44;
  if (std::min(box.size().x, box.size().y) < kLeastSize) return;
  const TextStyle style{kLeastLabel, Weight::regular, Role::quiet_ink, Role::panel};
  const Vec<2> c = box.center();
  const Vec<3> half = body.box.size() * 0.5;
  const double above = box.lo.y - kAway, beside = box.hi.x + kAway;
  const auto measure = [&](const Anchor& anchor, double size, const Vec<2>& from,
                           const Vec<2>& to) {
    if (!w.labels.try_add(short_number(size), {anchor}, style, w.map.picture())) return;
    draw_dimension(pen, from, to);
    w.labels.block(shrunk(united(Box<2>{from, from}, Box<2>{to, to}), -6));
  };
  measure({{(c.x + box.hi.x) / 2, above - 9}, 0.5}, half.x, {c.x, above}, {box.hi.x, above});
  measure({{beside + 9, (c.y + box.lo.y) / 2 + 6}, 0}, half.y, {beside, c.y}, {beside, box.lo.y});
}

constexpr double kInsetShare = 0.24;  // of the picture's width and height
constexpr double kFromRim = 12;       // from the picture's border

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

std::vector<GroundPlace> draw_half_spaces(World2D& w) {
  std::vector<GroundPlace> places;
  for (const FrameBody& body : w.frame.bodies) {
    if (!is_half_space(body)) continue;
    const Plane<2> surface = page_surface(body, w.map.to_page(body.position));
    Box<2> limit = w.map.picture();
    std::vector<Vec<2>> solid = clipped(polygon_of(limit), surface, false);
    if (solid.size() < 3 || depth_behind(solid, surface) < kLeastDepth) {
      limit = {w.map.picture().lo - kRimOutside, w.map.picture().hi + kRimOutside};
      solid = clipped(polygon_of(limit), surface, false);
    }
    if (solid.size() < 3) continue;
    const DrawList::Scope scope(w.list, body_key("world/body", body));
    Pen pen(w.list, limit);
    pen.polygon(solid, Role::free_space);
    pen.hatch(solid, 15, 1, {Role::cell_line_3, 1.6}, 160);
    const Vec<2> along = Vec<2>(-surface.normal.y, surface.normal.x) * 1e4;
    const Vec<2> at = w.map.to_page(body.position);
    pen.line(at - along, at + along,
             {body.lit      ? Role::lit
              : body.dimmed ? Role::quiet_ink
                            : Role::body_line,
              3.4, 0});
    w.grounds.insert(w.grounds.begin(), Ground{solid, Role::free_space});
    places.push_back({&body, middle_of(solid)});
  }
  return places;
}

void name_half_spaces(const World2D& w, const std::vector<GroundPlace>& places) {
  for (const GroundPlace& place : places) {
    if (!shows_name(w.frame, *place.body)) continue;
    TextStyle style;
    style.halo = ground_at(w.grounds, place.label);
    const std::string name = shortened(place.body->called(), 210, style);
    const double y = place.label.y + 0.3 * style.size;
    const double quarter = w.map.picture().size().x / 4;
    for (const double x : {0.0, -quarter, quarter})
      if (w.labels.try_add(name, {{{place.label.x + x, y}, 0.5}}, style, w.map.panel())) break;
  }
}

void draw_broad_boxes(const World2D& w) {
  if (!w.frame.display.boxes) return;
  constexpr std::size_t kMostBoxes = 400, kFewBodies = 4;
  constexpr double kSeen = 2.5;  // pixels
  Pen pen(w.list, mark_limit(w.map));
  std::size_t drawn = 0;
  for (const FrameBody& body : w.frame.bodies) {
    if (is_half_space(body) || body.dimmed || !body.has_volume) continue;
    if (++drawn > kMostBoxes) return;
    const Box<2> box = w.map.to_page(body.box);
    if (!holds(shrunk(w.map.picture(), -30), box)) continue;
    const DrawList::Scope scope(w.list, body_key("world/broad box", body));
    // What the structure holds, where one can see that it is more.
    const Box<2> held = w.map.to_page(body.stored_box.value_or(body.box));
    const bool more = box.lo.x - held.lo.x > kSeen || held.hi.x - box.hi.x > kSeen;
    if (more && holds(shrunk(w.map.picture(), -30), held))
      w.list.rect(held, Role::none, {Role::quiet_ink, 1.2, 3});
    w.list.marks.add(MarkKind::box);
    if (!body.lit)  // the others have one already
      w.list.rect(box, Role::none, {Role::quiet_ink, 1.8, 6});
    const auto edges = half_edges_of(body, w.map.scale());
    if (!edges && !body.lit && w.frame.bodies.size() > kFewBodies) continue;
    edges ? draw_projections(w, body, *edges, box, pen) : draw_half_sizes(w, body, box, pen);
    w.list.referents.insert({"half_width." + body.name, "half_height." + body.name});
  }
}

void draw_land(const World2D& w) {
  for (const Polygon& land : w.frame.get<FrameLand>().land) {
    auto coast = mapped(land, [&](const Vec<2>& corner) { return w.map.to_page(corner); });
    coast = cut_to(std::move(coast), w.map.picture());
    if (coast.size() >= 3)
      w.list.polygon(std::move(coast), sector_role(1), {Role::cell_line_3, 1.4});
  }
}

Box<2> place_of_locator(const Frame& frame, const View2D& map) {
  const Box<2>& picture = map.picture();
  const Vec<2> size = picture.size() * kInsetShare;
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
