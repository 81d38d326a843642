// Links of pairs in a 2D world: over its cells, under its bodies, and ended at their outlines.
#include <algorithm>
#include <map>
#include <unordered_map>

#include "draw/world/world2d_parts.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostLinks = 900;
constexpr double kShort = 18;   // between two outlines: a shorter link would not be seen, and
constexpr double kBridge = 26;  // is drawn over the two bodies, from one's middle to the other's

// Where a link to `stand` ends. A long wall or floor is met at its place nearest to the other body:
// links to its middle would all run into one point, far from where the two could touch.
Vec<2> aim_at(const Stand& stand, const Vec<2>& other) {
  constexpr double kLong = 260;  // page units
  const Vec<2> size = stand.box.size();
  if (stand.bodies.size() > 1 || !stand.bodies.front()->is_static || stand.outside ||
      std::max(size.x, size.y) < kLong)
    return stand.center;
  const Vec<2> inset = glm::min(Vec<2>(6), size / 2.0);
  return glm::clamp(other, stand.box.lo + inset, stand.box.hi - inset);
}

// Whether a point of the page lies on what is drawn there.
bool is_on(const Stand& stand, const Vec<2>& point) {
  if (!contains(stand.box, point)) return false;
  const FrameBody& body = *stand.bodies.front();
  if (stand.bodies.size() > 1 || stand.outside) return true;
  if (std::holds_alternative<Sphere>(body.shape))
    return glm::distance(point, stand.box.center()) <= stand.box.size().x / 2;
  const Polygon turned = turned_outline(body, stand.box);
  return turned.empty() || inside(turned, point);
}

// The share of the way from `from` to `to` at which it leaves the stand that holds `from`.
double share_inside(const Stand& stand, const Vec<2>& from, const Vec<2>& to) {
  double in = 0, out = 1;
  if (is_on(stand, to)) return 1;
  for (int i = 0; i < 24; ++i) {
    const double middle = (in + out) / 2;
    (is_on(stand, from + (to - from) * middle) ? in : out) = middle;
  }
  return in;
}

// Between two points of bodies; `gap` tells where the way is free of both.
PageLink link_between(const Vec<2>& from, const Vec<2>& to, double first, double last) {
  const Vec<2> way = to - from;
  const double length = geometry::hypot(way.x, way.y);
  if ((last - first) * length >= kShort)
    return {from + way * first, from + way * last, {}, {}, {}, false, {}};
  const Vec<2> middle = (from + to) / 2.0;
  const Vec<2> half =
      length > 0 ? way / length * (std::max(kBridge, length) / 2) : Vec<2>(kBridge / 2, 0);
  return {middle - half, middle + half, {}, {}, {}, true, {}};
}

PageLink link_of(const Stand& a, const Stand& b) {
  const Vec<2> from = aim_at(a, b.center), to = aim_at(b, from);
  PageLink link = link_between(from, to, share_inside(a, from, to), 1 - share_inside(b, to, from));
  // Boxes that touch may lie apart by a rounding on the page.
  const Vec<2> lo = glm::max(a.box.lo, b.box.lo), hi = glm::min(a.box.hi, b.box.hi);
  if (!a.outside && !b.outside && glm::all(glm::lessThanEqual(lo, hi + 1e-6)))
    link.common = Box<2>{glm::min(lo, hi), hi};
  return link;
}

// How much of a straight link another body hides, and how far that body reaches to its sides.
struct Hidden {
  double share = 0;
  double left = 0, right = 0;  // page units from the link's line
};

Hidden hidden_by(const std::vector<Stand>& stands, const Stand& a, const Stand& b,
                 const PageLink& link) {
  constexpr int kSamples = 12;
  const Vec<2> way = link.to - link.from;
  const double length = geometry::hypot(way.x, way.y);
  Hidden hidden;
  if (!(length > 0)) return hidden;
  const Vec<2> side{-way.y / length, way.x / length};
  for (const Stand& other : stands) {
    if (&other == &a || &other == &b || other.outside) continue;
    int on = 0;
    for (int i = 1; i < kSamples; ++i) on += is_on(other, link.from + way * (double(i) / kSamples));
    if (on == 0) continue;
    hidden.share += double(on) / (kSamples - 1);
    for (const Vec<2>& corner : polygon_of(other.box)) {
      const double at = glm::dot(corner - link.from, side);
      hidden.left = std::max(hidden.left, -at);
      hidden.right = std::max(hidden.right, at);
    }
  }
  return hidden;
}

// Where another body would hide most of it, a link goes round that body on its shorter side.
void bow_out(const std::vector<Stand>& stands, const Stand& a, const Stand& b, PageLink& link) {
  constexpr double kMostHidden = 0.4, kClear = 14, kMostOut = 160;
  constexpr int kParts = 24;
  if (link.close) return;
  const Hidden hidden = hidden_by(stands, a, b, link);
  const double out = std::min(hidden.left, hidden.right) + kClear;
  if (hidden.share < kMostHidden || out > kMostOut) return;
  const Vec<2> from = aim_at(a, b.center), to = aim_at(b, from), way = to - from;
  const Vec<2> side = Vec<2>(-way.y, way.x) / geometry::hypot(way.x, way.y);
  const Vec<2> middle =
      (from + to) / 2.0 + side * ((hidden.left < hidden.right ? -2 : 2) * out);  // of the control
  for (int i = 0; i <= kParts; ++i) {
    const double t = double(i) / kParts;
    const Vec<2> p = from * ((1 - t) * (1 - t)) + middle * (2 * t * (1 - t)) + to * (t * t);
    if (!is_on(a, p) && !is_on(b, p)) link.bow.push_back(p);
  }
  if (link.bow.size() < 2) link.bow.clear();
}

void draw_bow(const PageLink& link, Pen& pen) {
  const Stroke stroke = stroke_of(link.look);
  pen.path(link.bow, false, {Role::panel, stroke.width + 4});
  pen.path(link.bow, false, stroke);
  if (link.look.state == frame::PairState::shapes_apart)
    draw_cross(link.bow[link.bow.size() / 2], Role::rejected_pair, pen);
}

// From a body to the ground.
PageLink link_to_ground(const Stand& stand, const FrameBody& ground, const View2D& map) {
  const Vec<2> from = stand.center;
  const Vec<2> to = map.to_page(foot_on(ground, stand.bodies.front()->position));
  return link_between(from, to, share_inside(stand, from, to), 1);
}

// The more the two may still touch, the more it counts for bodies at one place.
int weight_of(const LinkLook& look) {
  constexpr int kOrder[] = {0, 0, 3, 1, 2, 4};  // by PairState
  return kOrder[static_cast<std::size_t>(look.state)];
}

// The step is not about these bodies, nor about their pairs.
bool is_ruled_out(const Stand& stand) {
  return std::ranges::all_of(stand.bodies, [](const FrameBody* body) { return body->dimmed; });
}

}  // namespace

PageLinks links_of(const World2D& w) {
  std::unordered_map<BodyId, std::size_t> stand_of;
  for (std::size_t i = 0; i < w.stands.size(); ++i)
    for (const FrameBody* body : w.stands[i].bodies) stand_of[body->id] = i;
  std::unordered_map<BodyId, const FrameBody*> grounds;
  for (const FrameBody& body : w.frame.bodies)
    if (is_half_space(body)) grounds[body.id] = &body;
  const std::vector<bool> full = full_links(w.frame);
  const frame::PairStates states(w.frame);
  PageLinks found;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::size_t> seen;  // two places -> link
  for (std::size_t i = 0; i < w.frame.pairs.size() && found.complete; ++i) {
    const FramePair& pair = w.frame.pairs[i];
    const LinkLook look{states.state_of(pair.pair), full[i], pair.lit};
    const auto a = stand_of.find(pair.pair.a), b = stand_of.find(pair.pair.b);
    const auto ground_a = grounds.find(pair.pair.a), ground_b = grounds.find(pair.pair.b);
    const bool of_ground = ground_a != grounds.end() || ground_b != grounds.end();
    if (!of_ground && (a == stand_of.end() || b == stand_of.end() || a->second == b->second))
      continue;
    if (of_ground && a == stand_of.end() && b == stand_of.end()) continue;
    if (of_ground) {
      const std::size_t stand = (a == stand_of.end() ? b : a)->second;
      const FrameBody& ground = *(ground_a != grounds.end() ? ground_a : ground_b)->second;
      found.links.push_back(link_to_ground(w.stands[stand], ground, w.map));
      found.links.back().look = look;
      found.links.back().key = pair_key("world/pair", *w.stands[stand].bodies.front(), ground);
    } else {
      if (is_ruled_out(w.stands[a->second]) || is_ruled_out(w.stands[b->second])) continue;
      const auto [at, is_new] =
          seen.try_emplace(std::minmax<std::uint64_t>(a->second, b->second), found.links.size());
      if (is_new) {
        const Stand &one = w.stands[a->second], &other = w.stands[b->second];
        found.links.push_back(link_of(one, other));
        found.links.back().key = pair_key("world/pair", *one.bodies.front(), *other.bodies.front());
        if (full[i] && w.frame.pairs.size() <= kMostFullLinks)
          bow_out(w.stands, one, other, found.links.back());
      }
      LinkLook& known = found.links[at->second].look;
      if (is_new || weight_of(look) > weight_of(known)) known = look;
    }
    found.complete = found.links.size() < kMostLinks;
  }
  return found;
}

void draw_links(const World2D& w, const PageLinks& links, bool over) {
  Pen pen(w.list, mark_limit(w.map));
  for (const bool full : {false, true})
    for (const PageLink& link : links.links) {
      if (link.look.full != full || (link.close && full) != over) continue;
      if (link.look.state == frame::PairState::contact) continue;
      // Among many, only what may still touch is worth a line.
      if (!full && link.look.state != frame::PairState::candidate) continue;
      w.list.marks.add(kind_of(link.look));
      const DrawList::Scope scope(w.list, link.key, link.key);
      if (!link.bow.empty())
        draw_bow(link, pen);
      else
        draw_link(link.from, link.to, link.look, pen);
    }
  if (!over) return;
  for (const PageLink& link : links.links) {
    if (!link.common || !link.look.full || link.look.state == frame::PairState::contact) continue;
    const std::string key = link.key + "/boxes";
    const DrawList::Scope scope(w.list, key, key);
    const Box<2> limit = mark_limit(w.map);
    if (overlap(*link.common, limit))
      draw_overlap({glm::clamp(link.common->lo, limit.lo, limit.hi),
                    glm::clamp(link.common->hi, limit.lo, limit.hi)},
                   w.list);
    if (link.close && link.look.state == frame::PairState::shapes_apart)
      draw_cross(glm::clamp(link.common->center(), limit.lo, limit.hi), Role::rejected_pair, pen);
  }
}

}  // namespace lantern::draw
