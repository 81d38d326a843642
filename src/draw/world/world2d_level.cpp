#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/world/world2d_parts.hpp"
#include "draw/world/world3d_parts.hpp"
#include "frame/parts/level.hpp"
#include "geometry/elementary.hpp"
#include "geometry/plane.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostSectors = 400;
constexpr std::size_t kMostWalls = 900;

// Two convex polygons that share more than a corner of their borders.
bool are_neighbours(const Polygon& a, const Polygon& b, double close) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec<2> p = a[i], along = a[(i + 1) % a.size()] - p;
    const double length = geometry::hypot(along.x, along.y);
    if (!(length > close)) continue;
    const Vec<2> unit = along / length;
    for (std::size_t j = 0; j < b.size(); ++j) {
      double at[2];
      bool on_line = true;
      for (const int end : {0, 1}) {
        const Vec<2> way = b[(j + static_cast<std::size_t>(end)) % b.size()] - p;
        on_line &= std::abs(unit.x * way.y - unit.y * way.x) < close;
        at[end] = unit.x * way.x + unit.y * way.y;
      }
      const double from = std::max(0.0, std::min(at[0], at[1]));
      const double to = std::min(length, std::max(at[0], at[1]));
      if (on_line && to - from > close) return true;
    }
  }
  return false;
}

std::vector<const FrameNode*> sectors_of(const Frame& frame) {
  std::vector<const FrameNode*> sectors;
  for (const FrameNode& node : frame.nodes)
    if (node.leaf && node.region.size() >= 3) sectors.push_back(&node);
  if (sectors.size() > kMostSectors) sectors.clear();
  return sectors;
}

// Each sector in turn takes the first tone that no neighbour before it has, or else the one that
// fewest have.
std::vector<unsigned> tones_of(const std::vector<Polygon>& regions) {
  constexpr double kClose = 0.5;  // page units
  std::vector<unsigned> tones;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    unsigned used[kSectorTones] = {};
    for (std::size_t j = 0; j < i; ++j)
      if (are_neighbours(regions[i], regions[j], kClose)) ++used[tones[j]];
    tones.push_back(static_cast<unsigned>(std::min_element(used, used + kSectorTones) - used));
  }
  return tones;
}

// The polygon's centre of area.
Vec<2> centroid(const Polygon& polygon) {
  Vec<2> sum{0.0};
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2> a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    const double cross = a.x * b.y - a.y * b.x;
    sum += (a + b) * cross;
    area += cross;
  }
  return std::abs(area) > 1e-9 ? polygon[0] + sum / (3 * area) : polygon[0];
}

// By label: where a sector's number stands, in the world.
using SectorPlaces = std::map<std::string, Vec<2>, std::less<>>;

const Vec<2> kNumberRoom{25, 20};  // half of what a number and its plate take, with some air
const Vec<2> kNarrowRoom{15, 14};  // in a sector without that room

// Places in a sector for its number, its middle first, then others the farther from it the later.
std::vector<Vec<2>> number_places(const Polygon& region, const Vec<2>& room) {
  constexpr int kSteps = 10;
  const Vec<2> middle = centroid(region);
  const Box<2> box = box_of(region);
  std::vector<Vec<2>> places{middle};
  for (int x = 1; x < kSteps; ++x)
    for (int y = 1; y < kSteps; ++y)
      places.push_back(box.lo + box.size() * Vec<2>(x, y) / double(kSteps));
  std::ranges::stable_sort(places, {}, [&](const Vec<2>& p) { return glm::length(p - middle); });
  std::erase_if(places, [&](const Vec<2>& p) { return !inside(region, Box<2>::around(p, room)); });
  if (places.empty() && room != kNarrowRoom) return number_places(region, kNarrowRoom);
  return places;
}

// What numbers keep clear of: bodies and, as far as they can, the links of pairs.
class Obstacles {
 public:
  Obstacles(const Frame& frame, const View2D& map) {
    if (frame.bodies.size() > kCrowd) return;
    for (const Stand& stand : stands_of(frame, map)) bodies_.push_back(stand.box);
    if (!frame.display.pairs) return;
    const BodiesById bodies = by_id(frame.bodies);
    for (const FramePair& pair : frame.pairs)
      if (const FrameBody* a = body_of(bodies, pair.pair.a), *b = body_of(bodies, pair.pair.b);
          a && b)
        links_.push_back({map.to_page(a->position), map.to_page(b->position)});
  }

  bool no_body_at(const Vec<2>& at) const {
    return !touches(bodies_, Box<2>::around(at, kNumberRoom));
  }
  bool no_link_at(const Vec<2>& at) const {
    return std::ranges::none_of(links_, [&](const Segment<2>& link) {
      constexpr double kClear = 17;
      const Vec<2> way = link.b - link.a;
      const double size = glm::dot(way, way);
      const double t = size > 0 ? std::clamp(glm::dot(at - link.a, way) / size, 0.0, 1.0) : 0;
      return glm::length(at - link.at(t)) < kClear;
    });
  }

 private:
  std::vector<Box<2>> bodies_;
  std::vector<Segment<2>> links_;
};

// Where the number of a sector may stand: on how many frames no body is there, and no link.
struct NumberPlaces {
  std::vector<Vec<2>> places;  // on the page
  std::vector<std::pair<int, int>> free;
  int frames = 0;  // that have the sector

  void add(const Obstacles& obstacles) {
    free.resize(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      free[k].first += obstacles.no_body_at(places[k]);
      free[k].second += obstacles.no_link_at(places[k]);
    }
    ++frames;
  }
};

// The same on all frames of the group, so that no number jumps or blinks: where no body ever
// stands, and the fewest links lie.
const SectorPlaces& sector_places(const Staging& staging, const Box<2>& panel) {
  return staging.once<SectorPlaces>("places of sectors", panel, [&] {
    constexpr std::size_t kMostLookedAt = 60;  // frames of a group, here and there
    const View2D map(flat(staging.frames()[0]->bounds), panel);
    std::map<std::string, NumberPlaces, std::less<>> sectors;
    for (const Frame* frame : staging.some_frames(kMostLookedAt)) {
      const Obstacles obstacles(*frame, map);
      for (const FrameNode* sector : sectors_of(*frame)) {
        if (sector->label.empty()) continue;
        NumberPlaces& own = sectors[sector->label];
        if (own.frames == 0) own.places = number_places(page_region(*sector, map), kNumberRoom);
        own.add(obstacles);
      }
    }
    SectorPlaces places;
    for (const auto& [label, own] : sectors) {
      const auto best = std::ranges::max_element(own.free);
      if (best == own.free.end() || best->first < own.frames) continue;
      const Vec<2> from_origin =
          own.places[static_cast<std::size_t>(best - own.free.begin())] - map.to_page(Vec<2>(0.0));
      places[label] = Vec<2>(from_origin.x, -from_origin.y) / map.scale();
    }
    return places;
  });
}

// Short strokes across the wall where it was cut in two.
void draw_cuts(const World2D& w, Pen& pen) {
  const auto drawn = first_of(w.frame.get<FrameLevel>().walls, kMostWalls);
  std::vector<FrameWall> walls(drawn.begin(), drawn.end());
  std::ranges::stable_sort(walls, {}, &FrameWall::wall);
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t j = i + 1; j < walls.size(); ++j) {
      const FrameWall &a = walls[i], &b = walls[j];
      if (a.wall != b.wall) break;
      const Vec<2> way = w.map.to_page(a.to) - w.map.to_page(a.from);
      const double length = geometry::hypot(way.x, way.y);
      if (!(length > 1e-6)) continue;
      const Vec<2> across = Vec<2>(-way.y, way.x) / length * 9.0;
      for (const Vec<2>& p : {w.map.to_page(a.from), w.map.to_page(a.to)})
        for (const Vec<2>& q : {w.map.to_page(b.from), w.map.to_page(b.to)})
          if (std::abs(p.x - q.x) < 0.5 && std::abs(p.y - q.y) < 0.5) {
            pen.line(p - across, p + across, {Role::panel, 6});
            pen.line(p - across, p + across, {Role::ink, 2.4});
          }
    }
}

}  // namespace

bool is_level(const Frame& frame) {
  if (!frame.get<FrameLevel>().walls.empty() || frame.get<FrameLevel>().eye) return true;
  return std::ranges::any_of(frame.nodes,
                             [](const FrameNode& n) { return n.solid || n.order != kNone; });
}

bool is_asked_line(const Frame& frame, const FrameNode& node) {
  return node.mark != Mark::quiet && is_level(frame) && frame.get<FrameLevel>().portals.empty();
}

Grounds fill_sectors(const World2D& w) {
  Grounds grounds;
  const std::vector<const FrameNode*> sectors = sectors_of(w.frame);
  const auto regions = mapped(sectors, [&](const FrameNode* s) { return page_region(*s, w.map); });
  const std::vector<unsigned> tones = tones_of(regions);
  Pen pen(w.list, w.map.picture());
  for (std::size_t i = 0; i < sectors.size(); ++i) {
    if (sectors[i]->mark != Mark::quiet) continue;  // painted as lit or passed
    const bool left_out = sectors[i]->solid || sectors[i]->unseen;
    const Role role = left_out ? Role::free_space : sector_role(tones[i]);
    pen.polygon(regions[i], role);
    grounds.push_back({regions[i], role});
  }
  for (std::size_t i = 0; i < sectors.size(); ++i)
    if (sectors[i]->solid) pen.hatch(regions[i], 13, 1, {Role::cell_line_3, 1.5}, 60);
  return grounds;
}

void number_sectors(const World2D& w) {
  if (!is_level(w.frame)) return;
  const SectorPlaces& places = sector_places(w.staging, w.map.panel());
  for (const FrameNode* sector : sectors_of(w.frame)) {
    const auto found = places.find(sector->label);
    if (found == places.end()) continue;
    const Vec<2> at = w.map.to_page(found->second);
    if (touches(w.covered, Box<2>::around(at, kNarrowRoom))) continue;
    const DrawList::Scope scope(w.list, node_key("world/cell name", w.frame.nodes, *sector));
    if (sector->order != kNone && draw_met(sector->order, at, w.map.picture(), w.list, w.labels))
      continue;
    TextStyle style{kLabel, Weight::semibold, Role::quiet_ink};
    if (sector->mark == Mark::lit) style.role = Role::lit_ink;
    style.halo = ground_at(w.grounds, at);
    w.labels.try_add(node_words(sector->label), {centred(at, style)}, style, w.map.picture());
  }
  w.list.referents.insert({"sectors", "sector"});
}

void name_taken_line(const World2D& w) {
  constexpr double kReach = 46, kBeside = 52, kFar = 4000;
  const FrameLevel& level = w.frame.get<FrameLevel>();
  const auto wall = std::ranges::find(level.walls, Mark::lit, &FrameWall::mark);
  if (level.front == 0 || wall == level.walls.end()) return;
  const DrawList::Scope scope(w.list, "world/taken line");
  const Vec<2> a = w.map.to_page(wall->from), way = w.map.to_page(wall->to) - a, at = a + way / 2.0;
  const Vec<2> along = way / glm::length(way),
               front{along.y, -along.x};  // its floor is on its left
  const Vec<2> from = at - along * kFar, to = at + along * kFar;
  Pen pen(w.list, mark_limit(w.map));
  for (const FrameNode& region : w.frame.nodes)
    if (region.mark == Mark::lit)
      if (const auto in = inside_of(page_region(region, w.map), from, to))
        pen.line(from + (to - from) * in->first, from + (to - from) * in->second,
                 {Role::lit, 4, 14});
  pen.arrow(at, at + front * kReach, {Role::lit, 4}, 14, 2);
  const auto write = [&](const std::string& text, const Vec<2>& middle, const Stroke& rim) {
    const Box<2> plate = plate_of(text, middle, kStrong, {9, 7});
    if (!w.labels.is_free(plate, w.map.picture())) return false;
    w.list.rect(plate, Role::panel, rim, 6);
    w.labels.add(text, centred(middle, kStrong), kStrong, w.map.picture());
    w.labels.block(plate);
    return true;
  };
  // Without its word where there is no room for that.
  const auto count = [&](std::uint32_t n, const std::string& words, const Vec<2>& middle) {
    if (!write(words, middle, {})) write(fmt::format("{}", n), middle, {});
  };
  write(say("wall {}", wall->wall + 1), at, {Role::lit, 1.8});
  // Plates are wider than high, so beside an upright wall they stand farther off.
  const double off = kReach + 18 + kBeside * std::abs(front.x);
  count(level.front, say("{} in front", level.front), at + front * off);
  count(level.back, say("{} behind", level.back), at - front * off);
}

void draw_portals(const World2D& w) {
  Pen pen(w.list, mark_limit(w.map));
  for (const FramePortal& portal : first_of(w.frame.get<FrameLevel>().portals, kMostWalls)) {
    const auto at = static_cast<std::size_t>(&portal - w.frame.get<FrameLevel>().portals.data());
    const DrawList::Scope scope(w.list, fmt::format("world/portal/{}", at));
    draw_portal(w.map.to_page(portal.from), w.map.to_page(portal.to), pen);
    w.list.marks.add(MarkKind::portal);
  }
  if (!w.frame.get<FrameLevel>().portals.empty()) w.list.referents.emplace("portals");
}

void draw_sights(const World2D& w) {
  Pen pen(w.list, mark_limit(w.map));
  for (const FrameSight& sight : first_of(w.frame.get<FrameLevel>().sights, kMostSectors)) {
    const DrawList::Scope scope(w.list, fmt::format("world/sight/{}-{}", sight.a, sight.b));
    draw_sight(w.map.to_page(sight.from), w.map.to_page(sight.to), pen);
    w.list.marks.add(MarkKind::sight);
  }
}

void draw_walls(const World2D& w) {
  Pen pen(w.list, mark_limit(w.map));
  for (const Mark mark : {Mark::quiet, Mark::passed, Mark::lit})
    for (const FrameWall& wall : first_of(w.frame.get<FrameLevel>().walls, kMostWalls)) {
      if (wall.mark != mark) continue;
      const Vec<2> from = w.map.to_page(wall.from), to = w.map.to_page(wall.to);
      const double width = mark == Mark::lit ? 10 : mark == Mark::passed ? 6.5 : 5;
      pen.line(from, to, {Role::ink, width});
      if (mark == Mark::lit) pen.line(from, to, {Role::lit, 6});
    }
  draw_cuts(w, pen);
}

}  // namespace lantern::draw
