#include <cmath>
#include <set>

#include "base/stop.hpp"
#include "draw/world/world3d_parts.hpp"
#include "geometry/not_finite.hpp"
#include "geometry/ray.hpp"

namespace lantern::draw {
namespace {

// The point of the piece's box that is nearest to `p`.
Vec<3> nearest(const Convex& c, const Vec<3>& p) {
  Vec<3> at = c.center;
  for (int i = 0; i < 3; ++i)
    at += c.axes[i] * std::clamp(glm::dot(p - c.center, c.axes[i]), -c.half[i], c.half[i]);
  return at;
}

double reach_along(const Convex& c, const Vec<3>& n) {
  double reach = c.radius;
  for (int i = 0; i < 3; ++i) reach += c.half[i] * std::abs(glm::dot(n, c.axes[i]));
  return reach;
}

// Directions along which a gap between the two may show: the separating axes of two boxes, and the
// line between the nearest points for what is round.
std::vector<Vec<3>> directions(const Convex& a, const Convex& b) {
  std::vector<Vec<3>> found;
  const auto add = [&](const Vec<3>& d) {
    const double length = glm::length(d);
    if (length > 1e-12) found.push_back(d / length);
  };
  for (int i = 0; i < 3; ++i) add(a.axes[i]);
  for (int i = 0; i < 3; ++i) add(b.axes[i]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec<3> across = glm::cross(a.axes[i], b.axes[j]);
      if (glm::length(across) > 1e-6) add(across);
    }
  Vec<3> on_a = nearest(a, b.center);
  for (int round = 0; round < 4; ++round) {  // to and fro, towards the nearest points
    const Vec<3> on_b = nearest(b, on_a);
    add(on_b - on_a);
    on_a = nearest(a, on_b);
  }
  return found;
}

// Of a span of a line, where the square of (offset + way t) is at most r^2.
std::optional<RaySpan> in_round(const std::optional<RaySpan>& span, const Vec<3>& offset,
                                const Vec<3>& way, double r) {
  const double a = glm::dot(way, way), b = glm::dot(offset, way);
  const double c = glm::dot(offset, offset) - r * r;
  const double root = b * b - a * c;
  if (!span || (a < 1e-300 ? c > 0 : root <= 0)) return std::nullopt;
  if (a < 1e-300) return span;
  const RaySpan part{std::max(span->from, (-b - std::sqrt(root)) / a),
                     std::min(span->to, (-b + std::sqrt(root)) / a)};
  return part.from <= part.to ? std::optional(part) : std::nullopt;
}

// Thinner where it passes before others: a body must stay readable behind the edges of its cell.
void thin(Piece& line, std::vector<std::pair<double, double>> over) {
  constexpr double kThin = 0.5;
  const LineShape whole = std::get<LineShape>(line.shapes.front());
  LineShape thinner = whole;
  thinner.stroke.width = std::max(0.9, kThin * whole.stroke.width);
  line.shapes.clear();
  const auto add = [&](LineShape shape, double from, double to) {
    if (!(to > from)) return;
    const Vec<2> way = whole.to - whole.from;
    shape.from = whole.from + way * from;
    shape.to = whole.from + way * to;
    line.shapes.emplace_back(shape);
  };
  std::ranges::sort(over);
  double start = 0;
  for (const auto& [first, last] : over) {
    add(whole, start, first);
    add(thinner, std::max(start, first), last);
    start = std::max(start, last);
  }
  add(whole, start, 1);
}

}  // namespace

Convex Convex::line(const Vec<3>& a, const Vec<3>& b) {
  Convex c;
  c.center = (a + b) * 0.5;
  const double length = glm::length(b - a);
  if (!(length > 0)) return c;
  const Vec<3> along = (b - a) / length;
  const Vec<3> side = across(along);
  c.axes = Mat<3>(along, side, glm::cross(along, side));
  c.half.x = length / 2;
  return c;
}

Convex Convex::of(const FrameBody& body) {
  const auto of_core = [&](const Core<3>& core) -> Convex {
    const bool turned = core.turns && !std::holds_alternative<Sphere>(body.shape);
    return {body.position, turned ? matrix(body.orientation) : Mat<3>(1), core.half, core.radius};
  };
  return visit_shape<3>(body.shape, of_core, [&](const HalfSpace<3>&) -> Convex {
    return {body.box.center(), Mat<3>(1), body.box.size() * 0.5};
  });
}

// A piece with a radius is a ball or a capsule along its own y: the balls at its ends and the
// cylinder between, which together are convex, so what lies in them is one part of the segment.
std::optional<std::pair<double, double>> inside_of(const Convex& piece, const Vec<3>& a,
                                                   const Vec<3>& b) {
  const Vec<3> from = glm::transpose(piece.axes) * (a - piece.center);
  const Vec<3> way = glm::transpose(piece.axes) * (b - a);
  const Ray<3> ray{from, way, 1};
  std::optional<RaySpan> whole;
  const auto add = [&](const std::optional<RaySpan>& part) {
    if (whole && part)
      whole = {std::min(whole->from, part->from), std::max(whole->to, part->to)};
    else if (part)
      whole = part;
  };
  if (piece.radius > 0) {
    for (const double end : {-piece.half.y, piece.half.y})
      add(in_round(RaySpan{0, 1}, from - Vec<3>(0, end, 0), way, piece.radius));
    const Vec<3> endless{kInfinity, piece.half.y, kInfinity};
    add(in_round(span_in(ray, Box<3>{-endless, endless}), {from.x, 0, from.z}, {way.x, 0, way.z},
                 piece.radius));
  } else {
    whole = span_in(ray, Box<3>{-piece.half, piece.half});
  }
  if (!whole || !(whole->from < whole->to)) return std::nullopt;
  return std::pair{whole->from, whole->to};
}

bool nearer(const Convex& a, const Convex& b, const Vec<3>& eye) {
  double widest = -1e300, side = 0;
  for (Vec<3> n : directions(a, b)) {
    if (glm::dot(n, b.center - a.center) < 0) n = -n;
    const double end_of_a = glm::dot(n, a.center) + reach_along(a, n);
    const double start_of_b = glm::dot(n, b.center) - reach_along(b, n);
    if (start_of_b - end_of_a <= widest) continue;
    widest = start_of_b - end_of_a;
    side = glm::dot(n, eye) - (end_of_a + start_of_b) / 2;
  }
  return side < 0;
}

// Cyrus and Beck (1978).
std::optional<std::pair<double, double>> inside_of(const Outline& outline, const Vec<2>& a,
                                                   const Vec<2>& b) {
  if (outline.size() < 3) return std::nullopt;
  Vec<2> middle{0.0};
  for (const Vec<2>& p : outline) middle += p / static_cast<double>(outline.size());
  RaySpan part{0, 1};
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec<2> along = outline[(i + 1) % outline.size()] - outline[i];
    Vec<2> inwards{-along.y, along.x};
    if (glm::dot(inwards, middle - outline[i]) < 0) inwards = -inwards;
    const double at_a = glm::dot(inwards, a - outline[i]);
    const double way = glm::dot(inwards, b - a);
    if (way > 0)
      part.from = std::max(part.from, -at_a / way);
    else if (way < 0)
      part.to = std::min(part.to, -at_a / way);
    else if (at_a < 0)
      return std::nullopt;
  }
  if (!(part.from < part.to)) return std::nullopt;
  return std::pair{part.from, part.to};
}

void paint(std::vector<Piece> pieces, const View3D& view, DrawList& list) {
  const std::size_t n = pieces.size();
  const auto boxes = mapped(pieces, [&](const Piece& piece) { return box_of(piece.outline); });
  std::vector<std::vector<std::size_t>> later(n);  // who waits for whom
  std::vector<std::size_t> waits(n);
  std::vector<std::vector<std::pair<double, double>>> over(n);  // of lines that yield
  for (std::size_t i = 0; i < n; ++i) {
    stop_if_asked();
    for (std::size_t j = i + 1; j < n; ++j) {
      if ((pieces[i].is_line && pieces[j].is_line) || !overlap(boxes[i], boxes[j]) ||
          !cover_each_other(pieces[i].outline, pieces[j].outline))
        continue;
      const bool first_is_nearer = nearer(pieces[i].space, pieces[j].space, view.eye());
      const std::size_t behind = first_is_nearer ? j : i, before = first_is_nearer ? i : j;
      later[behind].push_back(before);
      ++waits[before];
      if (!pieces[before].yields) continue;
      const auto& line = std::get<LineShape>(pieces[before].shapes.front());
      if (const auto part = inside_of(pieces[behind].outline, line.from, line.to))
        over[before].push_back(*part);
    }
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!over[i].empty()) thin(pieces[i], std::move(over[i]));
  // By distance, then by their place in the list.
  using Key = std::pair<double, std::size_t>;
  std::vector<Key> keys;
  for (std::size_t i = 0; i < n; ++i) keys.emplace_back(-view.depth(pieces[i].space.center), i);
  std::set<Key> ready, waiting;
  for (std::size_t i = 0; i < n; ++i) (waits[i] == 0 ? ready : waiting).insert(keys[i]);
  while (!ready.empty() || !waiting.empty()) {
    std::set<Key>& from = ready.empty() ? waiting : ready;  // a ring: break it at the far end
    const std::size_t i = from.begin()->second;
    from.erase(from.begin());
    const DrawList::Scope scope(list, std::move(pieces[i].key), std::move(pieces[i].from));
    for (DrawShape& shape : pieces[i].shapes) list.shapes.push_back(std::move(shape));
    for (const std::size_t next : later[i]) {
      if (waits[next] == 0 || --waits[next] > 0) continue;
      if (waiting.erase(keys[next]) > 0) ready.insert(keys[next]);
    }
  }
}

}  // namespace lantern::draw
