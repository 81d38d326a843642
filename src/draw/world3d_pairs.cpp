#include "draw/body_shapes.hpp"
#include "draw/world3d_parts.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostPairs = 900;
constexpr std::size_t kMostCased = 60;  // links with a casing and joints

// The bodies of a pair, as far as both are drawn; half-spaces, which are ground, always are.
using Drawn = std::unordered_map<BodyId, const FrameBody*>;

Drawn drawn_of(const Frame& frame, const std::vector<Body3D>& bodies) {
  Drawn found;
  for (const Body3D& b : bodies) found.emplace(b.body->id, b.body);
  for (const FrameBody& body : frame.bodies)
    if (is_half_space(body) && !bodies.empty()) found.emplace(body.id, &body);
  return found;
}

// f(one, other, pair) for each pair that both bodies of are drawn, until it gives false.
template <class F>
bool for_each_pair(const Frame& frame, const Drawn& drawn, const F& f) {
  for (const FramePair& pair : frame.pairs) {
    const auto a = drawn.find(pair.pair.a), b = drawn.find(pair.pair.b);
    if (a != drawn.end() && b != drawn.end() && !f(*a->second, *b->second, pair)) return false;
  }
  return true;
}

// Where a pair's link ends at this body: its centre, or the place of the ground nearest to the
// other one.
Vec<3> end_at(const FrameBody& body, const FrameBody& other) {
  return is_half_space(body) ? foot_on(body, other.position) : body.position;
}

}  // namespace

bool add_pairs(const Frame& frame, Marks3D& marks) {
  const Drawn bodies = drawn_of(frame, marks.bodies);
  const bool many = frame.pairs.size() > kMostCased;
  std::size_t count = 0;
  const auto add = [&](bool lit) {
    return for_each_pair(
        frame, bodies, [&](const FrameBody& a, const FrameBody& b, const FramePair& pair) {
          if (pair.lit != lit) return true;
          if (++count > kMostPairs) return false;
          marks.line(end_at(a, b), end_at(b, a), {Role::pair, (lit ? 4.4 : 3.0) * (many ? 0.6 : 1)},
                     many ? 0 : 2);
          return true;
        });
  };
  return add(false) && add(true);
}

void draw_joints(const Frame& frame, const Marks3D& marks) {
  if (frame.pairs.size() > kMostCased) return;
  for_each_pair(frame, drawn_of(frame, marks.bodies),
                [&](const FrameBody& a, const FrameBody& b, const FramePair&) {
                  if (!overlap(a.box, b.box)) return true;
                  const Box<3> common{glm::max(a.box.lo, b.box.lo), glm::min(a.box.hi, b.box.hi)};
                  const bool grounded = is_half_space(a) || is_half_space(b);
                  const Vec<3> foot = is_half_space(a) ? end_at(a, b) : end_at(b, a);
                  marks.dot(grounded ? foot : common.center(), 6, Role::pair, {Role::panel, 2});
                  return true;
                });
}

}  // namespace lantern
