#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "draw/body_shapes.hpp"
#include "draw/world/world3d_parts.hpp"
#include "geometry/plane.hpp"

namespace lantern::draw {
namespace {

constexpr double kLeastMarked = 22;  // page units across; smaller bodies carry no emblem

Role color_of(const FrameBody& body) {
  if (body.asleep) return Role::asleep;
  return body.is_static && !is_character(body) ? Role::static_body : body_role(body.color);
}

Stroke outline_of(const Body3D& b) {
  const Vec<2> size = b.box.size();
  const double pen = std::clamp(0.022 * std::min(size.x, size.y), 0.8, 2.2);
  if (b.body->lit) return {Role::lit, std::max(3.4, 1.5 * pen), 0};
  return {b.body->dimmed ? Role::quiet_ink : Role::body_line, pen, b.body->dimmed ? 5.0 : 0.0};
}

// A face of a box: its middle, and half its extent along the two other axes.
struct Face {
  Vec<3> middle{0.0}, normal{0.0}, u{0.0}, v{0.0};
  std::vector<Vec<3>> corners() const {
    return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
  }
};

// Those that the eye sees: at most three.
std::vector<Face> seen_faces(const Convex& box, const Vec<3>& eye) {
  std::vector<Face> faces;
  for (int i = 0; i < 3; ++i)
    for (const double side : {-1.0, 1.0}) {
      Face face;
      face.normal = box.axes[i] * side;
      face.middle = box.center + face.normal * box.half[i];
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      face.u = box.axes[j] * box.half[j];
      face.v = box.axes[k] * box.half[k];
      if (std::abs(face.v.y) < std::abs(face.u.y)) std::swap(face.u, face.v);  // v upwards
      if (face.v.y < 0) face.v = -face.v;
      if (glm::dot(eye - face.middle, face.normal) > 0) faces.push_back(face);
    }
  return faces;
}

Tone tone_of(const Vec<3>& normal, const Vec<3>& light) {
  const double towards = glm::dot(normal, light);
  if (towards > 0.7) return Tone::lit;
  return towards > 0.12 ? Tone::middle : Tone::shade;
}

std::vector<Vec<3>> ends_of(const Convex& round) {
  const Vec<3> along = round.axes[1] * round.half.y;
  if (round.half.y == 0) return {round.center};
  return {round.center - along, round.center + along};
}

// The caps of both ends, and what lies between them.
Outline round_outline(const Convex& space, const View3D& view, double least_cosine) {
  Outline points;
  for (const Vec<3>& end : ends_of(space))
    for (const Vec<2>& p : view.ball_cap(end, space.radius, view.light(), least_cosine))
      points.push_back(p);
  return hull_of(std::move(points));
}

Outline outline_of(const Convex& space, const View3D& view) {
  if (space.radius > 0) return round_outline(space, view, -1);
  Outline points;
  for (const Face& face : seen_faces(space, view.eye()))
    for (const Vec<2>& p : view.polygon(face.corners())) points.push_back(p);
  return hull_of(std::move(points));
}

void recolor(DrawList& list, Role role) {
  for (DrawShape& shape : list.shapes)
    std::visit(
        [&](auto& s) {
          if constexpr (requires { s.fill; })
            (s.fill != Role::none ? s.fill : s.stroke.role) = role;
        },
        shape);
}

// The mark that is the second cue beside a colour, in a square about the origin, y down.
// On a shaded face it is as light as the lit ones.
std::vector<DrawShape> mark_of(const FrameBody& body, Tone ground) {
  DrawList list;
  if (body.asleep)
    draw_z({{-0.7, -0.8}, {0.7, 0.8}}, {Role::body_line, 0.3}, list);
  else if (body.refused)
    list.line({-0.9, 0.9}, {0.9, -0.9}, {Role::body_line, 0.4});
  else if (color_of(body) != Role::static_body)
    draw_emblem(body.color, {0, 0}, 1, list);
  if (ground == Tone::shade && !body.asleep && !body.refused)
    recolor(list, in_tone(color_of(body), Tone::lit));
  return list.shapes;
}

// Puts what is drawn on the unit square on a face in space. Its round parts become polygons.
struct PutOn {
  std::function<Vec<2>(const Vec<2>&)> to_page;
  double unit;
  const View3D& view;
  Pen& pen;

  void operator()(LineShape line) const {
    line.from = to_page(line.from);
    line.to = to_page(line.to);
    line.stroke.width = wide(line.stroke.width);
    if (contains(view.panel(), line.from) && contains(view.panel(), line.to))
      pen.line(line.from, line.to, line.stroke);
  }
  void operator()(PolygonShape polygon) const {
    for (Vec<2>& p : polygon.points) p = to_page(p);
    polygon.stroke.width = wide(polygon.stroke.width);
    pen.polygon(polygon.points, polygon.fill, polygon.stroke);
  }
  void operator()(const RectShape& rect) const {
    const Vec<2> c = rect.box.center(), half = rect.box.size() * 0.5;
    std::vector<Vec<2>> points = polygon_of(rect.box);
    if (rect.radius > 0) {
      points = ring_of({0, 0}, 1, 24, std::numbers::pi / 24);
      for (Vec<2>& p : points) p = c + p * half;
    }
    (*this)(PolygonShape{std::move(points), rect.fill, rect.stroke});
  }
  void operator()(const TextShape&) const {}  // no mark has any

  // A stroke that covers the panel need not be wider.
  double wide(double width) const { return std::min(width * unit, view.panel().size().x); }
};

double least_side(const Outline& outline) {
  const Vec<2> size = box_of(outline).size();
  return std::min(size.x, size.y);
}

// Slanting lines across a face, a fixed way apart: it never moves.
void hatch(const Face& face, const View3D& view, Pen& pen) {
  const double u = glm::length(face.u), v = glm::length(face.v);
  if (!(u > 0) || !(v > 0)) return;
  const double step = std::max((u + v) / 14, std::min(u, v) * 0.45);
  const Vec<3> along_u = face.u / u, along_v = face.v / v;
  for (double d = step - u - v; d < u + v; d += 2 * step) {  // x + y = d, |x| <= u, |y| <= v
    const double from = std::max(-u, d - v), to = std::min(u, d + v);
    if (from >= to) continue;
    const auto line = view.segment(face.middle + along_u * from + along_v * (d - from),
                                   face.middle + along_u * to + along_v * (d - to));
    if (line) pen.line(line->first, line->second, {Role::cell_line_3, 1.3});
  }
}

void draw_box(const Body3D& b, const View3D& view, Pen& pen) {
  Stroke stroke = outline_of(b);
  const Stroke rim = stroke;
  if (b.body->lit) stroke = {Role::body_line, 1.2};
  const Role color = color_of(*b.body);
  const std::vector<Face> faces = seen_faces(b.space, view.eye());
  const Face* widest = nullptr;
  double most = 0;
  for (const Face& face : faces) {
    const Outline outline = view.polygon(face.corners());
    const Role fill =
        b.body->dimmed ? Role::panel : in_tone(color, tone_of(face.normal, view.light()));
    pen.polygon(outline, fill, stroke);
    const bool whole = std::ranges::all_of(
        face.corners(), [&](const Vec<3>& corner) { return view.seen(corner).has_value(); });
    if (!whole || least_side(outline) <= most) continue;
    most = least_side(outline);
    widest = &face;
  }
  if (b.body->lit) pen.polygon(b.outline, Role::none, rim);
  if (widest == nullptr || most < kLeastMarked || b.body->dimmed) return;
  if (color == Role::static_body) return hatch(*widest, view, pen);
  const double size = 0.34 * std::min(glm::length(widest->u), glm::length(widest->v));
  const Vec<3> u = glm::normalize(widest->u) * size, v = glm::normalize(widest->v) * size;
  const auto to_page = [&](const Vec<2>& p) {
    return view.to_page(widest->middle + u * p.x - v * p.y);
  };
  const PutOn put{to_page, size * view.scale_at(widest->middle), view, pen};
  for (const DrawShape& mark : mark_of(*b.body, tone_of(widest->normal, view.light())))
    std::visit(put, mark);
}

void draw_round(const Body3D& b, const View3D& view, Pen& pen) {
  const Role color = color_of(*b.body);
  const Stroke stroke = outline_of(b);
  if (b.body->dimmed) return pen.polygon(b.outline, Role::panel, stroke);
  pen.polygon(b.outline, in_tone(color, Tone::shade), {});
  pen.polygon(round_outline(b.space, view, 0.02), color, {});
  if (std::min(b.box.size().x, b.box.size().y) > 12)
    pen.polygon(round_outline(b.space, view, 0.87), in_tone(color, Tone::lit), {});
  pen.polygon(b.outline, Role::none, stroke);
  const double across = 2 * b.space.radius * view.scale_at(b.space.center);
  if (across < kLeastMarked) return;
  const Vec<2> center = view.to_page(b.space.center);
  const double unit = 0.14 * across;
  const PutOn put{[&](const Vec<2>& p) { return center + p * unit; }, unit, view, pen};
  for (const DrawShape& mark : mark_of(*b.body, Tone::middle)) std::visit(put, mark);
}

// Characters stand upright and look at the viewer, wherever the camera is.
void draw_upright(const Body3D& b, const View3D& view, DrawList& list) {
  FrameBody facing = *b.body;
  const Vec<2> way = view.turned(b.body->velocity);
  facing.velocity = {way.x, -way.y, 0};
  const Box<2> place = box_of(b.outline);
  draw_character(facing, place, false, list);
  if (b.body->lit) list.rect(shrunk(place, -3), Role::none, {Role::lit, 2.8}, 8);
  if (!holds(view.panel(), place)) cut_shapes(list, 0, view.panel());
}

}  // namespace

std::vector<Body3D> bodies_in_view(const Frame& frame, const View3D& view) {
  std::vector<Body3D> found;
  for (const FrameBody& body : frame.bodies) {
    if (is_half_space(body) || view.lost(body.position)) continue;
    Body3D b{&body, Convex::of(body), {}, {}};
    b.outline = outline_of(b.space, view);
    if (b.outline.size() < 3) continue;
    b.box = box_of(b.outline);
    if (!overlap(b.box, view.panel())) continue;
    b.box = {glm::max(b.box.lo, view.panel().lo), glm::min(b.box.hi, view.panel().hi)};
    found.push_back(std::move(b));
  }
  return found;
}

Piece body_piece(const Body3D& body, const View3D& view) {
  DrawList list;
  Pen pen(list, view.panel());
  if (is_character(*body.body))
    draw_upright(body, view, list);
  else if (body.space.radius > 0)
    draw_round(body, view, pen);
  else
    draw_box(body, view, pen);
  return {body.space, body.outline, false, false, std::move(list.shapes)};
}

void draw_crowd3d(const Frame& frame, const View3D& view, DrawList& list) {
  std::vector<const FrameBody*> order;
  for (const FrameBody& body : frame.bodies)
    if (!is_half_space(body) && !view.lost(body.position) && view.in_front(body.position))
      order.push_back(&body);
  std::ranges::stable_sort(order, std::greater(),
                           [&](const FrameBody* body) { return view.depth(body->position); });
  for (const FrameBody* body : order) {
    const Vec<3> half = body->box.size() * 0.5;
    const double radius =
        std::clamp(std::min({half.x, half.y, half.z}) * view.scale_at(body->position), 1.8, 9.0);
    const Vec<2> at = view.to_page(body->position);
    if (!holds(view.panel(), Box<2>::around(at, Vec<2>(radius)))) continue;
    const Role fill = body->dimmed ? Role::panel : color_of(*body);
    const Stroke stroke{body->lit ? Role::lit : Role::body_line, body->lit ? 1.6 : 0.5, 0};
    list.disc(at, radius, fill, stroke);
  }
}

}  // namespace lantern::draw
