#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "base/stop.hpp"
#include "base/words.hpp"
#include "draw/world/world2d_parts.hpp"
#include "geometry/elementary.hpp"

namespace lantern::draw {
namespace {

constexpr double kOnePlace = 6;          // page units between centres that count as one place
constexpr std::ptrdiff_t kMostOver = 7;  // drawn of the bodies at one place: the uppermost
constexpr std::size_t kMostDetailed = 160;
constexpr std::size_t kMostBoxed = 12;  // of more bodies only broken corners of boxes would be seen
constexpr double kRim = 24;             // from the bounds to an outside body's marker
const Vec<2> kOverhang{34, 20};         // a body may reach this far out of the world's bounds
constexpr double kLeastBody = 5;
constexpr double kNested = 9;  // from one outline to the next at one place

// A body's box on the page, never too small to be seen.
Box<2> page_box(const FrameBody& body, const View2D& map) {
  const Box<2> box = map.to_page(body.box);
  return Box<2>::around(box.center(), glm::max(box.size(), Vec<2>(kLeastBody)) / 2.0);
}

Box<2> drawing_limit(const View2D& map) {
  return {map.picture().lo - kOverhang, map.picture().hi + kOverhang};
}

Box<2> page_part(const Box<2>& box, const View2D& map) {
  const Box<2> limit = drawing_limit(map);
  return {glm::clamp(box.lo, limit.lo, limit.hi), glm::clamp(box.hi, limit.lo, limit.hi)};
}

bool is_outside(const FrameBody& body, const Frame& frame) {
  return !frame.view && !contains(frame.bounds, body.box.center());
}

Stand stand_of(const FrameBody& body, const Frame& frame, const View2D& map) {
  Stand stand{{&body}, map.to_page(body.box.center()), page_box(body, map), false};
  stand.outside = is_outside(body, frame);
  if (stand.outside) {
    const Box<2> rim = shrunk(map.picture(), kRim);
    stand.center = glm::clamp(stand.center, glm::min(rim.lo, rim.hi), glm::max(rim.lo, rim.hi));
    stand.box = Box<2>::around(stand.center, Vec<2>(15));
  }
  return stand;
}

// In tenths of a unit: of equal bodies no rounding decides who is on top.
long size_of(const FrameBody& body, const View2D& map) {
  const Vec<2> size = page_box(body, map).size();
  return std::lround(10 * std::min(size.x, size.y));
}

void draw_outside(const World2D& w, const Stand& stand) {
  const FrameBody& body = *stand.bodies.front();
  Vec<2> way = w.map.to_page(body.box.center()) - stand.center;
  const double length = geometry::hypot(way.x, way.y);
  way = length > 0 ? way / length : Vec<2>(1, 0);
  const Vec<2> side{-way.y, way.x};
  const Vec<2> tip = stand.center + way * 15.0, back = stand.center - way * 10.0;
  w.list.polygon({tip, back + side * 11.0, back + way * 6.0, back - side * 11.0},
                 body_role(body.color), {Role::body_line, 1.6});
}

// Of what a body has painted from `first` on only its outline is left, in its own colour on both
// sides of the line; what is under it shows.
void leave_outlines(DrawList& list, std::size_t first, Role own) {
  constexpr double kWide = 8;  // page units
  std::vector<DrawShape> kept;
  for (std::size_t i = first; i < list.shapes.size(); ++i)
    std::visit(
        [&](auto shape) {
          if constexpr (requires { shape.fill; }) {
            if (shape.fill != own) return;
            shape.fill = Role::none;
            const Stroke line = std::exchange(shape.stroke, {own, kWide});
            kept.emplace_back(shape);
            shape.stroke = line;
            kept.emplace_back(shape);
          }
        },
        list.shapes[i]);
  list.shapes.resize(first, LineShape{});
  list.shapes.insert(list.shapes.end(), kept.begin(), kept.end());
}

// What reaches too far out of the world is cut off.
void draw_inside(const World2D& w, const FrameBody& body, const Box<2>& box, bool plain) {
  const std::size_t first = w.list.shapes.size();
  draw_character(body, box, plain, w.list);
  if (w.frame.display.outlined) leave_outlines(w.list, first, fill_of(body));
  const Box<2> limit = drawing_limit(w.map);
  if (!holds(limit, box)) cut_shapes(w.list, first, limit);
}

// Each where it is, the largest first: a large one must not hide a small one.
void draw_stand(const World2D& w, const Stand& stand, bool plain) {
  std::vector<const FrameBody*> order = stand.bodies;
  std::ranges::stable_sort(order, std::greater(),
                           [&](const FrameBody* body) { return size_of(*body, w.map); });
  if (std::ssize(order) > kMostOver) order.erase(order.begin(), order.end() - kMostOver);
  double inset = 0;  // outlines at one place lie in each other
  for (const FrameBody* body : order) {
    const std::string key = body_key("world/body", *body);
    const DrawList::Scope scope(w.list, key, key);
    draw_inside(w, *body, shrunk(page_box(*body, w.map), inset), plain);
    if (w.frame.display.outlined) inset += kNested;
  }
}

// Not only on the page: their centres are the same.
bool is_one_place(const Stand& stand) {
  const Box<3>& first = stand.bodies.front()->box;
  const Vec<3> size = first.size();
  const double slip = 1e-6 * std::max({size.x, size.y, size.z});
  return std::ranges::all_of(stand.bodies, [&](const FrameBody* body) {
    const Vec<3> apart = body->box.center() - first.center();
    return geometry::hypot(apart.x, apart.y, apart.z) <= slip;
  });
}

// Of the bodies that show theirs; empty if none does.
std::string names_of(const Frame& frame, const Stand& stand) {
  std::vector<std::string> shown;
  for (const FrameBody* body : stand.bodies)
    if (shows_name(frame, *body)) shown.push_back(body->called());
  if (stand.bodies.size() == 1 || shown.empty()) return shown.empty() ? "" : shown.front();
  constexpr std::size_t kMostNames = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(shown.size(), kMostNames); ++i)
    names += (i == 0 ? "" : ", ") + shown[i];
  if (const std::size_t more = stand.bodies.size() - std::min(shown.size(), kMostNames); more > 0)
    names += fmt::format(" + {}", more);
  if (stand.outside) return say("{} — outside", names);
  return is_one_place(stand) ? say("{} — one place", names) : say("{} — close together", names);
}

// On its side, or below, above, beside; first inside the bounds, then also outside of them, then
// beside and a little higher or lower, then on bodies that its own one overlaps. A name that covers
// any other body would be read as that one's, so it is left out.
void name_stand(const World2D& w, const std::string& text, const Stand& stand,
                const NameSides& sides) {
  constexpr std::size_t kFew = 12;
  TextStyle style;
  const auto around = anchors_around(stand.box, kNameGap, style);
  const auto first = on_its_side(around, sides, stand.bodies.front()->name);
  std::vector<Anchor> aside;
  for (const double down : {0.7 * style.size, -0.7 * style.size})
    for (const std::size_t beside : {4, 5})
      aside.push_back({around[beside].at + Vec<2>(0, down), around[beside].align});
  for (const int pass : {0, 1, 2, 3}) {
    if (pass > 0 && w.covered.size() > kFew) return;
    const Anchor* free = w.labels.free_anchor(
        text, pass == 2 ? std::span<const Anchor>(aside) : first, style,
        pass == 0 ? shrunk(w.map.picture(), 5) : w.map.panel(), [&](const Box<2>& extent) {
          return std::ranges::none_of(w.covered, [&](const Box<2>& other) {
            return overlap(other, extent) && (pass < 3 || !overlap(other, stand.box));
          });
        });
    if (!free) continue;
    style.halo = ground_at(w.grounds, Labels::extent(text, *free, style).center());
    return w.labels.add(text, *free, style, w.map.panel());
  }
}

bool is_lit(const Stand& stand) {
  return std::ranges::any_of(stand.bodies, [](const FrameBody* body) { return body->lit; });
}

}  // namespace

std::vector<Stand> stands_of(const Frame& frame, const View2D& map) {
  std::vector<Stand> stands;
  for (const FrameBody& body : frame.bodies) {
    stop_if_asked();
    if (is_half_space(body)) continue;
    Stand mine = stand_of(body, frame, map);
    const auto same = std::ranges::find_if(stands, [&](const Stand& other) {
      const Vec<2> apart = other.center - mine.center;
      return other.outside == mine.outside && geometry::hypot(apart.x, apart.y) < kOnePlace;
    });
    if (same == stands.end())
      stands.push_back(std::move(mine));
    else {
      same->bodies.push_back(&body);
      if (!mine.outside) same->box = united(same->box, mine.box);
    }
  }
  return stands;
}

void draw_bodies(const World2D& w, bool boxes) {
  std::size_t count = 0;
  std::vector<const Stand*> order;
  for (const Stand& stand : w.stands) {
    count += stand.bodies.size();
    order.push_back(&stand);
  }
  // A large body must not hide a small one.
  std::ranges::stable_sort(order, std::greater(),
                           [&](const Stand* s) { return size_of(*s->bodies.front(), w.map); });
  const bool plain = count > kMostDetailed;
  for (const Stand* stand : order) {
    for (const FrameBody* body : stand->bodies) tell_marks(*body, w.list);
    if (stand->outside) {
      const DrawList::Scope scope(w.list, body_key("world/outside", *stand->bodies[0]));
      draw_outside(w, *stand);
    } else {
      draw_stand(w, *stand, plain);
    }
    const DrawList::Scope scope(w.list, body_key("world/box", *stand->bodies[0]));
    const Look look = stand->bodies[0]->look;
    const bool has_none = look == Look::bat || look == Look::box || look == Look::person ||
                          !stand->bodies[0]->has_volume;
    if (!stand->outside && (is_lit(*stand) || (boxes && count <= kMostBoxed && !has_none &&
                                               !stand->bodies[0]->dimmed)))
      w.list.rect(page_part(page_box(*stand->bodies[0], w.map), w.map), Role::none,
                  is_lit(*stand) ? Stroke{Role::lit, 2.8} : Stroke{Role::quiet_ink, 1.5, 5});
  }
}

void name_bodies(const World2D& w) {
  constexpr std::size_t kMostNamed = 35;
  constexpr double kWidestName = 240;
  const NameSides& sides = name_sides(w.staging, w.map.panel());
  std::vector<const Stand*> order = mapped(w.stands, [](const Stand& stand) { return &stand; });
  std::ranges::stable_partition(order, [](const Stand* s) { return is_lit(*s); });
  std::size_t named = 0;
  for (const Stand* stand : order) {
    const std::string names = names_of(w.frame, *stand);
    if (names.empty() || named++ == kMostNamed) continue;
    const double widest = stand->bodies.size() > 1 ? w.map.panel().size().x - 16 : kWidestName;
    const DrawList::Scope scope(w.labels.list(), body_key("world/name", *stand->bodies[0]));
    name_stand(w, shortened(names, widest, {}), *stand, sides);
  }
}

void count_stacks(const World2D& w) {
  std::vector<std::pair<Stack, Box<2>>> stacks;
  for (const Stand& stand : w.stands)
    for (const Stack& stack : stacks_of(stand.bodies))
      if (const Box<2> box = page_box(*stack.front(), w.map);
          !stand.outside && overlap(box, w.map.picture()))
        stacks.emplace_back(stack, box);
  draw_stacks(stacks, w.covered, w.frame.view ? w.map.picture() : w.map.panel(), w.list, w.labels);
}

std::size_t draw_crowd(const World2D& w) {
  constexpr std::size_t kMostMarks = 4000;
  constexpr double kMostCrowdMark = 18;  // across
  const double square = w.frame.bodies.size() > kMostMarks ? kMostCrowdMark : 1;
  std::set<std::pair<long, long>> taken;
  for (const FrameBody& body : w.frame.bodies) {
    if (is_half_space(body) || is_outside(body, w.frame)) continue;
    const Vec<2> p = w.map.to_page(body.box.center());
    if (!taken.insert({std::lround(p.x / square), std::lround(p.y / square)}).second) continue;
    const Box<2> box = page_box(body, w.map);
    const Vec<2> half = glm::min(box.size(), kMostCrowdMark) * 0.5;
    draw_character(body, Box<2>::around(box.center(), half), true, w.list);
  }
  return taken.size();
}

}  // namespace lantern::draw
