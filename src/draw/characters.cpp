#include "draw/characters.hpp"

#include <cmath>
#include <numbers>

#include "draw/metrics.hpp"

namespace lantern {
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

// A small character needs a thinner pen, or it would be all outline.
double pen(double size) { return std::clamp(0.034 * size, 0.8, 2.6); }

// Along the velocity on the page; at rest `calm`.
Vec<2> direction(const FrameBody& body, const Vec<2>& calm) {
  const double speed = std::hypot(body.velocity.x, body.velocity.y);
  if (!(speed > 1e-9)) return calm;
  return {body.velocity.x / speed, -body.velocity.y / speed};
}

Role fill_of(const FrameBody& body) {
  if (body.asleep) return Role::asleep;
  const bool furniture = body.look == Look::box || body.look == Look::disc;
  return body.is_static && furniture ? Role::static_body : body_role(body.color);
}

void draw_eye(const Figure& f, double x, bool asleep, DrawList& list) {
  const Vec<2> middle = f.at(x, -0.2);
  if (asleep) {
    const Vec<2> half{0.2 * f.unit, 0};
    list.shapes.emplace_back(
        LineShape{middle - half, middle + half, {Role::body_line, 1.3 * f.line, 0}, false});
    return;
  }
  const double white = 0.235 * f.unit, black = 0.125 * f.unit;
  list.shapes.emplace_back(disc(middle, white, Role::eye));
  list.shapes.emplace_back(disc(middle + f.gaze * (white - black) * 0.85, black, Role::pupil));
}

// Dome, straight sides, and a hem of four scallops; 38 points.
void draw_ghost(const FrameBody& body, const Figure& f, DrawList& list) {
  constexpr int kDome = 17, kScallops = 4, kPerScallop = 5;
  PolygonShape shape{{}, fill_of(body), {Role::body_line, f.line, 0}};
  for (int i = 0; i < kDome; ++i) {
    const double angle = kPi * (1.0 - i / double(kDome - 1));
    shape.points.push_back(f.at(0.94 * std::cos(angle), -0.06 - 0.92 * std::sin(angle)));
  }
  for (int i = 0; i <= kScallops * kPerScallop; ++i) {
    const double along = i / double(kScallops * kPerScallop);
    const double lift = std::abs(std::sin(kPi * kScallops * along));
    shape.points.push_back(f.at(0.94 * (1 - 2 * along), 0.98 - 0.3 * lift));
  }
  list.shapes.emplace_back(std::move(shape));
  draw_emblem(body.color, f.at(0, 0.36), 0.17 * f.unit, list);
  draw_eye(f, -0.37, body.asleep, list);
  draw_eye(f, 0.37, body.asleep, list);
}

// A disc with a mouth; 34 points.
void draw_player(const FrameBody& body, const Figure& f, DrawList& list) {
  constexpr int kRim = 32;
  constexpr double kMouth = 0.185 * kPi;  // half of its opening
  const double ahead = std::atan2(f.gaze.y, f.gaze.x);
  PolygonShape shape{{}, fill_of(body), {Role::body_line, f.line, 0}};
  for (int i = 0; i <= kRim; ++i) {
    const double angle = ahead + kMouth + (2 * kPi - 2 * kMouth) * i / kRim;
    shape.points.push_back(f.at(0.96 * std::cos(angle), 0.96 * std::sin(angle)));
  }
  shape.points.push_back(f.center - Vec<2>(f.gaze.x * f.half.x, f.gaze.y * f.half.y) * 0.14);
  list.shapes.emplace_back(std::move(shape));
}

// A rectangle with soft corners, turned by the body's orientation if there is one.
void draw_slab(const FrameBody& body, const Figure& f, double radius, DrawList& list) {
  const Stroke outline{Role::body_line, f.line, 0};
  const Vec<2> half = f.half - Vec<2>(std::min(f.line / 2, f.unit / 2));
  if (body.angle == 0) {
    list.shapes.emplace_back(
        RectShape{Box<2>::around(f.center, half), radius, fill_of(body), outline, false});
    return;
  }
  const double c = std::cos(body.angle), s = -std::sin(body.angle);
  PolygonShape shape{{}, fill_of(body), outline};
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Vec<2> corner{x * half.x, y * half.y};
    shape.points.push_back(f.center +
                           Vec<2>(c * corner.x - s * corner.y, s * corner.x + c * corner.y));
  }
  list.shapes.emplace_back(std::move(shape));
}

void draw_round(const FrameBody& body, const Figure& f, DrawList& list) {
  list.shapes.emplace_back(RectShape{Box<2>::around(f.center, f.half - Vec<2>(0.04 * f.unit)),
                                     0.96 * f.unit,
                                     fill_of(body),
                                     {Role::body_line, f.line, 0},
                                     false});
}

void draw_plain(const FrameBody& body, const Figure& f, DrawList& list) {
  const bool round = body.look != Look::box && body.look != Look::bat;
  list.shapes.emplace_back(RectShape{Box<2>::around(f.center, f.half),
                                     round ? f.unit : 0,
                                     fill_of(body),
                                     {Role::body_line, std::min(0.8, 0.25 * f.unit), 0},
                                     false});
}

PolygonShape star(const Vec<2>& center, int corners, double radius, double turn, Role fill) {
  PolygonShape shape{{}, fill, {}};
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * kPi * i / corners;
    shape.points.push_back(center + Vec<2>(std::cos(angle), std::sin(angle)) * radius);
  }
  return shape;
}

}  // namespace

void draw_emblem(int color, const Vec<2>& center, double radius, DrawList& list) {
  const Role role = body_mark_role(color);
  const auto bar = [&](double x, double y) {
    list.shapes.emplace_back(filled(Box<2>::around(center, Vec<2>(x, y) * radius), role));
  };
  switch ((color - 1) % 8) {
    case 0:
      list.shapes.emplace_back(disc(center, 0.85 * radius, role));
      break;
    case 1:
      list.shapes.emplace_back(star(center, 3, 1.15 * radius, -kPi / 2, role));
      break;
    case 2:
      bar(0.8, 0.8);
      break;
    case 3:
      list.shapes.emplace_back(star(center, 4, 1.1 * radius, 0, role));
      break;
    case 4:
      bar(1.3, 0.42);
      break;
    case 5:
      bar(1.1, 0.36);
      bar(0.36, 1.1);
      break;
    case 6:
      list.shapes.emplace_back(disc(center, 0.75 * radius, Role::none, {role, 0.45 * radius, 0}));
      break;
    default:
      bar(0.42, 1.2);
      break;
  }
}

void draw_character(const FrameBody& body, const Box<2>& place, bool plain, DrawList& list) {
  Figure f;
  f.center = place.center();
  f.half = place.size() * 0.5;
  f.unit = std::min(f.half.x, f.half.y);
  f.line = pen(2 * f.unit);
  const bool upright = body.look == Look::ghost;
  f.gaze = direction(body, upright ? Vec<2>(0.8, 0.6) : Vec<2>(1.0, 0.0));
  const bool small = 2 * std::max(f.half.x, f.half.y) < kPlainBelow;
  if (plain || small) return draw_plain(body, f, list);
  switch (body.look) {
    case Look::ghost:
      return draw_ghost(body, f, list);
    case Look::player:
      return draw_player(body, f, list);
    case Look::ball:
    case Look::disc:
      draw_round(body, f, list);
      break;
    case Look::bat:
      draw_slab(body, f, 0.45 * f.unit, list);
      break;
    case Look::box:
      draw_slab(body, f, 0.12 * f.unit, list);
      break;
  }
  if (!body.asleep && fill_of(body) != Role::static_body)
    draw_emblem(body.color, f.center, 0.3 * f.unit, list);
}

}  // namespace lantern
