#include <cmath>
#include <iterator>
#include <numbers>

#include "draw/body_shapes.hpp"
#include "draw/pen.hpp"
#include "geometry/elementary.hpp"
#include "geometry/plane.hpp"

namespace lantern::draw {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPlainBelow = 14;

// The body's own unit square, from -1 to 1, y down, put on its place.
struct Figure {
  Vec<2> center{0.0};
  Vec<2> half{0.0};
  double unit = 0;   // the smaller half, for parts that must stay round
  double line = 0;   // width of the outline
  Vec<2> gaze{0.0};  // unit vector on the page

  Vec<2> at(double x, double y) const { return center + Vec<2>(x * half.x, y * half.y); }
};

// Along the velocity on the page; at rest `calm`.
Vec<2> direction(const FrameBody& body, const Vec<2>& calm) {
  const double speed = geometry::hypot(body.velocity.x, body.velocity.y);
  if (!(speed > 1e-9)) return calm;
  return {body.velocity.x / speed, -body.velocity.y / speed};
}

bool is_round(Look look) { return look != Look::box && look != Look::bat && look != Look::item; }

// What the step has ruled out is dotted.
Stroke rim_of(const FrameBody& body, const Figure& f) {
  if (body.dimmed) return {Role::quiet_ink, std::max(1.0, 0.8 * f.line), 2.4};
  return {Role::body_line, f.line};
}

void draw_eye(const Figure& f, double x, bool asleep, DrawList& list) {
  const Vec<2> middle = f.at(x, -0.2);
  if (asleep) {
    const Vec<2> half{0.2 * f.unit, 0};
    return list.line(middle - half, middle + half, {Role::body_line, 1.3 * f.line});
  }
  const double white = 0.235 * f.unit, black = 0.125 * f.unit;
  list.disc(middle, white, Role::eye);
  list.disc(middle + f.gaze * (white - black) * 0.85, black, Role::pupil);
}

// Dome, straight sides, and a hem of four scallops; 38 points.
void draw_ghost(const FrameBody& body, const Figure& f, DrawList& list) {
  constexpr int kDome = 17, kScallops = 4, kPerScallop = 5;
  PolygonShape shape{{}, fill_of(body), rim_of(body, f)};
  for (int i = 0; i < kDome; ++i) {
    const double angle = kPi * (1.0 - i / double(kDome - 1));
    shape.points.push_back(f.at(0.94 * geometry::cos(angle), -0.06 - 0.92 * geometry::sin(angle)));
  }
  for (int i = 0; i <= kScallops * kPerScallop; ++i) {
    const double along = i / double(kScallops * kPerScallop);
    const double lift = std::abs(geometry::sin(kPi * kScallops * along));
    shape.points.push_back(f.at(0.94 * (1 - 2 * along), 0.98 - 0.3 * lift));
  }
  list.shapes.emplace_back(std::move(shape));
  draw_emblem(body.color, f.at(0, 0.36), 0.17 * f.unit, list);
  draw_eye(f, -0.37, body.asleep, list);
  draw_eye(f, 0.37, body.asleep, list);
}

// A horned head with angry brows; 18 points.
void draw_demon(const FrameBody& body, const Figure& f, DrawList& list) {
  static constexpr double kRight[][2] = {{0.0, -0.76}, {0.42, -0.7}, {0.94, -0.98},
                                         {0.95, -0.2}, {0.86, 0.42}, {0.45, 0.9}};
  PolygonShape shape{{}, fill_of(body), rim_of(body, f)};
  for (const auto& p : kRight) shape.points.push_back(f.at(p[0], p[1]));
  shape.points.push_back(f.at(0, 0.98));
  for (std::size_t i = std::size(kRight); i-- > 1;)
    shape.points.push_back(f.at(-kRight[i][0], kRight[i][1]));
  list.shapes.emplace_back(std::move(shape));
  draw_emblem(body.color, f.at(0, 0.5), 0.19 * f.unit, list);
  for (const double side : {-1.0, 1.0}) draw_eye(f, side * 0.38, body.asleep, list);
  if (body.asleep) return;
  list.polygon({f.at(-0.7, -0.64), f.at(0, -0.36), f.at(0.7, -0.64), f.at(0.68, -0.5),
                f.at(0, -0.2), f.at(-0.68, -0.5)},
               Role::body_line);
}

// A chest with a handle.
void draw_item(const FrameBody& body, const Figure& f, DrawList& list) {
  const double radius = 0.14 * f.unit;
  list.rect({f.at(-0.36, -0.94), f.at(0.36, -0.3)}, Role::none, rim_of(body, f), radius);
  list.rect({f.at(-0.94, -0.6), f.at(0.94, 0.94)}, fill_of(body), rim_of(body, f), radius);
}

// A disc with a mouth; 34 points.
void draw_player(const FrameBody& body, const Figure& f, DrawList& list) {
  constexpr int kRim = 32;
  constexpr double kMouth = 0.185 * kPi;  // half of its opening
  const double ahead = geometry::atan2(f.gaze.y, f.gaze.x);
  PolygonShape shape{{}, fill_of(body), rim_of(body, f)};
  for (int i = 0; i <= kRim; ++i) {
    const double angle = ahead + kMouth + (2 * kPi - 2 * kMouth) * i / kRim;
    shape.points.push_back(f.at(0.96 * geometry::cos(angle), 0.96 * geometry::sin(angle)));
  }
  shape.points.push_back(f.center - Vec<2>(f.gaze.x * f.half.x, f.gaze.y * f.half.y) * 0.14);
  list.shapes.emplace_back(std::move(shape));
}

// Head and shoulders.
void draw_person(const FrameBody& body, const Figure& f, DrawList& list) {
  constexpr int kShoulders = 15;
  const double head = 0.46 * f.unit;
  const Vec<2> face = f.center - Vec<2>(0, f.half.y - head - f.line / 2);
  const double top = face.y + 0.7 * head, bottom = f.center.y + f.half.y - f.line / 2;
  const Vec<2> shoulders{0.88 * f.half.x, std::min(0.88 * f.half.x, 0.6 * (bottom - top))};
  PolygonShape shape{{}, fill_of(body), rim_of(body, f)};
  for (int i = 0; i < kShoulders; ++i) {
    const double angle = kPi * (1.0 - i / double(kShoulders - 1));
    shape.points.push_back({f.center.x + shoulders.x * geometry::cos(angle),
                            top + shoulders.y * (1 - geometry::sin(angle))});
  }
  shape.points.push_back({f.center.x + shoulders.x, bottom});
  shape.points.push_back({f.center.x - shoulders.x, bottom});
  list.shapes.emplace_back(std::move(shape));
  draw_emblem(body.color, {f.center.x, (top + 2 * bottom) / 3}, 0.24 * f.unit, list);
  list.disc(face, head, fill_of(body), rim_of(body, f));
}

// A rectangle with soft corners.
void draw_slab(const FrameBody& body, const Figure& f, double radius, DrawList& list) {
  const Stroke outline = rim_of(body, f);
  const Vec<2> half = f.half - Vec<2>(std::min(f.line / 2, f.unit / 2));
  list.rect(Box<2>::around(f.center, half), fill_of(body), outline, radius);
}

// A shape that turns. Characters of such a shape are known by their eyes.
void draw_turned(const FrameBody& body, const Figure& f, const std::vector<Vec<2>>& outline,
                 DrawList& list) {
  list.polygon(outline, fill_of(body), rim_of(body, f));
  if (!is_character(body)) return;
  draw_eye(f, -0.3, body.asleep, list);
  draw_eye(f, 0.3, body.asleep, list);
}

// The part of the place that lies in a half-space, hatched, under a strong surface line.
void draw_ground(const FrameBody& body, const Box<2>& place, DrawList& list) {
  const Plane<2> surface = page_surface(body, place.center());
  const std::vector<Vec<2>> solid = clipped(polygon_of(place), surface, false);
  Pen pen(list, place);
  pen.polygon(solid, Role::static_body);
  pen.hatch(solid, 6, 1, {Role::quiet_ink, 1.1}, 12);
  const Vec<2> along = Vec<2>(-surface.normal.y, surface.normal.x) * (2 * place.size().x);
  pen.line(place.center() - along, place.center() + along, {Role::body_line, 2.2});
}

// What never moves is hatched, whatever its tone.
void hatch_static(const FrameBody& body, const Figure& f, const Box<2>& place,
                  std::vector<Vec<2>> outline, DrawList& list) {
  constexpr std::size_t kMostShapes = 2600;
  constexpr double kInset = 1.6;  // the hatch ends at the outline
  if (list.shapes.size() > kMostShapes) return;
  if (outline.empty() && is_round(body.look)) outline = ring_of(f.center, f.unit, 24);
  if (outline.empty()) outline = polygon_of(place);
  for (Vec<2>& p : outline)
    for (int axis = 0; axis < 2; ++axis)
      p[axis] = f.center[axis] + (p[axis] - f.center[axis]) *
                                     std::max(0.9, 1 - kInset / std::max(f.half[axis], 1e-9));
  Pen(list, place)
      .hatch(outline, std::clamp(0.4 * f.unit, 7.0, 13.0), 1, {Role::quiet_ink, 1.1}, 60);
}

void draw_round(const FrameBody& body, const Figure& f, DrawList& list) {
  constexpr double kNoTurn = 1e-6;  // what is rounded is no turning
  const Vec<2> half = f.half - Vec<2>(std::min(f.line / 2, f.unit / 2));
  list.rect(Box<2>::around(f.center, half), fill_of(body), rim_of(body, f),
            std::min(half.x, half.y));
  if (std::abs(body.angle) < kNoTurn && std::abs(body.angular_momentum.z) < kNoTurn) return;
  const Vec<2> way = unit_at(-body.angle);  // how far it has turned
  const double r = 0.96 * f.unit - f.line;
  list.line(f.center + way * (0.36 * r), f.center + way * r, rim_of(body, f));
}

// From the centre to the nearest edge of what has turned.
double room_inside(const std::vector<Vec<2>>& outline, const Figure& f) {
  double room = f.unit;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec<2> edge = outline[(i + 1) % outline.size()] - outline[i], to = f.center - outline[i];
    if (const double length = geometry::hypot(edge.x, edge.y); length > 0)
      room = std::min(room, std::abs(edge.x * to.y - edge.y * to.x) / length);
  }
  return room;
}

void draw_plain(const FrameBody& body, const Figure& f, DrawList& list) {
  const bool round = is_round(body.look);
  list.rect(Box<2>::around(f.center, f.half), fill_of(body),
            {body.dimmed ? Role::quiet_ink : Role::body_line, std::min(0.8, 0.25 * f.unit), 0},
            round ? f.unit : 0);
}

// The frame of a shape that turns is that of its first, second and last corner.
void draw_outline(const FrameBody& body, const Figure& f, const std::vector<Vec<2>>& turned,
                  DrawList& list) {
  const bool turns = turned.size() == 4;
  const Vec<2> across = turns ? (turned[1] - turned[0]) / 2.0 : Vec<2>(f.half.x, 0);
  const Vec<2> down = turns ? (turned[0] - turned[3]) / 2.0 : Vec<2>(0, f.half.y);
  for (Polygon part : *body.outline) {
    for (Vec<2>& p : part) p = f.center + across * p.x + down * p.y;
    list.polygon(std::move(part), fill_of(body), rim_of(body, f));
  }
}

void draw_look(const FrameBody& body, const Figure& f, const std::vector<Vec<2>>& turned,
               DrawList& list) {
  if (body.outline) return draw_outline(body, f, turned, list);
  if (!turned.empty()) return draw_turned(body, f, turned, list);
  if (body.look == Look::ghost) return draw_ghost(body, f, list);
  if (body.look == Look::player) return draw_player(body, f, list);
  if (body.look == Look::person) return draw_person(body, f, list);
  if (body.look == Look::demon) return draw_demon(body, f, list);
  if (body.look == Look::item) return draw_item(body, f, list);
  if (body.look == Look::bat) return draw_slab(body, f, 0.45 * f.unit, list);
  if (body.look == Look::box) return draw_slab(body, f, 0.12 * f.unit, list);
  draw_round(body, f, list);
}

// What is seen of a character on a ground of its own colour.
void add_halo(const Figure& f, std::size_t outline, DrawList& list) {
  DrawShape halo = list.shapes[outline];
  std::visit(
      [&](auto& shape) {
        if constexpr (requires { shape.stroke; })
          shape.stroke = {Role::panel, f.line + std::clamp(0.12 * f.unit, 2.0, 5.0)};
        if constexpr (requires { shape.fill; }) shape.fill = Role::panel;
      },
      halo);
  list.shapes.insert(list.shapes.begin() + static_cast<std::ptrdiff_t>(outline), std::move(halo));
}

}  // namespace

Role fill_of(const FrameBody& body) {
  if (body.dimmed) return Role::panel;
  if (body.asleep) return Role::asleep;
  const bool furniture = body.look == Look::box || body.look == Look::disc;
  return body.is_static && furniture ? Role::static_body : body_role(body.color);
}

void draw_emblem(int color, const Vec<2>& center, double radius, DrawList& list) {
  const Role role = body_mark_role(color);
  const auto bar = [&](double x, double y) {
    list.rect(Box<2>::around(center, Vec<2>(x, y) * radius), role);
  };
  const int emblem = (color - 1) % 8;
  if (emblem == 0) list.disc(center, 0.85 * radius, role);
  if (emblem == 1) list.polygon(ring_of(center, 1.15 * radius, 3, -kPi / 2), role);
  if (emblem == 2) bar(0.8, 0.8);
  if (emblem == 3) list.polygon(ring_of(center, 1.1 * radius, 4), role);
  if (emblem == 4) bar(1.3, 0.42);
  if (emblem == 5) bar(1.1, 0.36), bar(0.36, 1.1);
  if (emblem == 6) list.disc(center, 0.75 * radius, Role::none, {role, 0.45 * radius});
  if (emblem == 7) bar(0.42, 1.2);
}

void draw_z(const Box<2>& box, const Stroke& stroke, DrawList& list) {
  const Vec<2> z[] = {box.lo, {box.hi.x, box.lo.y}, {box.lo.x, box.hi.y}, box.hi};
  for (int i = 1; i < 4; ++i) list.line(z[i - 1], z[i], stroke);
}

void draw_zz(const Vec<2>& corner, double unit, double width, DrawList& list) {
  const auto letter = [&](const Vec<2>& offset, double size) {
    const Vec<2> at = corner + offset * unit;
    draw_z({at, at + Vec<2>(size * unit)}, {Role::ink, width}, list);
  };
  letter({0, 0.18}, 0.3);
  letter({0.42, -0.04}, 0.22);
}

void draw_character(const FrameBody& body, const Box<2>& place, bool plain, DrawList& list) {
  if (is_half_space(body)) return draw_ground(body, place, list);
  Figure f{place.center(), place.size() * 0.5};
  f.unit = std::min(f.half.x, f.half.y);
  f.line = std::clamp(0.034 * (2 * f.unit), 0.8, 2.6);  // small ones need a thin pen
  const bool upright = body.look == Look::ghost || body.look == Look::demon;
  f.gaze = direction(body, upright ? Vec<2>(0.8, 0.6) : Vec<2>(1.0, 0.0));
  const bool small = 2 * std::max(f.half.x, f.half.y) < kPlainBelow;
  const std::vector<Vec<2>> turned = turned_outline(body, place);
  if (small || (plain && turned.empty())) return draw_plain(body, f, list);
  const std::size_t first = list.shapes.size();
  draw_look(body, f, turned, list);
  if (plain) return;
  if (is_character(body) && !body.dimmed) add_halo(f, first, list);
  if (body.is_static) hatch_static(body, f, place, turned, list);
  if (body.asleep) {  // "z z" in the middle, or of a character beside its head
    const Vec<2> corner = is_character(body) ? Vec<2>(0.5, -0.98) : Vec<2>(-0.34, -0.12);
    draw_zz(f.center + corner * f.unit, f.unit, std::max(1.2, 0.9 * f.line), list);
  }
  if (!is_character(body) && !body.asleep && fill_of(body) != Role::static_body)
    draw_emblem(body.color, body.look == Look::item ? f.at(0, 0.17) : f.center,
                0.3 * room_inside(turned, f), list);
  if (body.refused)
    for (const Stroke& stroke : {Stroke{Role::panel, 6}, Stroke{Role::ink, 2.6}})
      list.line(f.at(-0.9, 0.9), f.at(0.9, -0.9), stroke);
}

}  // namespace lantern::draw
