#include <algorithm>
#include <functional>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/world/narrow_marks.hpp"
#include "draw/world/world2d_parts.hpp"
#include "draw/world/world3d_parts.hpp"
#include "frame/parts/level.hpp"
#include "geometry/elementary.hpp"
#include "geometry/flat.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr std::size_t kMostCells = 16;
constexpr double kWidestName = 210;

// Where no body is covered, so that each name is read as its own body's.
void name_body(const Body3D& b, const std::vector<Body3D>& bodies, const View3D& view,
               Labels& labels) {
  TextStyle style;
  style.halo = Role::panel;
  const std::string text = shortened(b.body->called(), kWidestName, style);
  const auto anchors = anchors_around(b.box, 6, style);
  labels.try_add(text, anchors, style, shrunk(view.panel(), 4), view.panel(),
                 [&](const Box<2>& extent) {
                   return std::ranges::none_of(bodies, [&](const Body3D& other) {
                     return cover_each_other(other.outline, polygon_of(extent));
                   });
                 });
}

// At the corner of the cell that lies farthest out on the page, so that no two of a node's eight
// children take the same one; on the cell's own side of it.
void name_cell(const FrameNode& node, const std::vector<Body3D>& bodies, const View3D& view,
               DrawList& list, Labels& labels) {
  const bool lit = node.mark == Mark::lit;
  const TextStyle style{kLeastLabel, Weight::semibold, lit ? Role::lit_ink : Role::quiet_ink};
  if (!view.in_front(node.box.center())) return;
  const Vec<2> middle = view.to_page(view.bounds().center());
  const Vec<2> own = view.to_page(node.box.center());
  std::vector<Vec<2>> corners;
  for (const Vec<3>& corner : corners_of(node.box)) {
    if (!view.in_front(corner)) return;
    corners.push_back(view.to_page(corner));
  }
  const Vec<2> size = box_of(corners).size();
  if (size.x < 60 || size.y < 60) return;
  std::ranges::stable_sort(corners, std::greater(),
                           [&](const Vec<2>& corner) { return glm::length(corner - middle); });
  const std::string label = node_words(node.label);
  const double half = text_width(label, style) / 2;
  for (const Vec<2>& corner : corners) {
    const Vec<2> inwards = own - corner;
    const double length = glm::length(inwards);
    if (!(length > 1)) continue;
    const Vec<2> at = corner + inwards * (std::min(0.5 * length, half + 20) / length);
    const Anchor anchor = centred(at, style);
    const Box<2> plate = plate_of(label, at, style, {5, 5});
    const Box<2> extent = Labels::extent(label, anchor, style);
    const bool covers =
        std::ranges::any_of(bodies, [&](const Body3D& b) { return overlap(b.box, plate); });
    if (covers || !labels.is_free(extent, shrunk(view.panel(), 4))) continue;
    // Edges cross everywhere: a plate keeps them off the name.
    list.rect(plate, lit ? Role::lit_fill : Role::panel, {}, 5);
    return labels.add(label, anchor, style, view.panel());
  }
}

void name_world3d(const Frame& frame, const Staging& staging, const std::vector<Body3D>& bodies,
                  const View3D& view, DrawList& list, Labels& labels) {
  for (const bool lit : {true, false})
    for (const Body3D& b : bodies)
      if (b.body->lit == lit && shows_name(frame, *b.body)) {
        const DrawList::Scope scope(list, body_key("world/name", *b.body));
        name_body(b, bodies, view, labels);
      }
  std::vector<const FrameNode*> cells;
  for (const FrameNode& node : frame.nodes)
    if (frame.display.cells && node.leaf && node.depth > 0 && !node.of_static &&
        !node.label.empty() && is_valid(node.box) && shows_id(staging, node) &&
        (node.mark == Mark::lit || !node.bodies.empty()))
      cells.push_back(&node);
  std::ranges::stable_sort(cells, {}, [](const FrameNode* n) {
    return std::pair{n->mark != Mark::lit, n->depth};
  });
  if (cells.size() > kMostCells) cells.resize(kMostCells);
  for (const FrameNode* cell : cells) {
    const DrawList::Scope scope(list, node_key("world/cell name", frame.nodes, *cell));
    name_cell(*cell, bodies, view, list, labels);
  }
}

// What had to be left out of the picture, for its note.
using LeftOut = std::vector<std::string>;

void note(const LeftOut& left_out, const Box<2>& picture, Labels& labels) {
  labels.add_note(fmt::format("{}", fmt::join(left_out, "; ")), picture);
}

// All that other bodies may hide.
void add_marks(const Frame& frame, Marks3D& marks, LeftOut& left_out) {
  constexpr std::size_t kMostBoxed3d = 60;
  for (const Body3D& body : marks.bodies) {
    Piece& piece = marks.pieces.emplace_back(body_piece(body, marks.view));
    piece.key = piece.from = body_key("world/body", *body.body);
  }
  if (!add_cells(frame, marks)) left_out.push_back(word("the deepest cells are not drawn"));
  if (frame.display.cells) add_cuts(frame, marks);
  add_drop_lines(marks);
  if (frame.display.pairs && !add_pairs(frame, marks))
    left_out.push_back(word("not all pairs are drawn"));
  mark_links(frame, marks);
  mark_velocities(frame, marks);
  mark_spins(frame, marks);
  mark_forces(frame, marks);
  for (const Body3D& b : marks.bodies)
    if (frame.display.boxes && (b.body->lit || marks.bodies.size() <= kMostBoxed3d)) {
      const Marks::Scope scope(marks, body_key("world/box", *b.body));
      marks.tell(MarkKind::box);
      marks.box(b.body->box, {b.body->lit ? Role::lit : Role::quiet_ink, 1.5, 5});
    }
  mark_views(frame, marks);
  mark_rays(frame, marks);
  mark_queries(frame, marks);
}

// The numbers that can be counted on the picture.
void depict_bodies(const Frame& frame, DrawList& list) {
  list.referents.insert({"bodies", "asleep", "awake"});
  if (frame.display.depths) list.referents.emplace("penetration");
}

bool shows(const View3D& view, const FrameBody& body) {
  const std::vector<Vec<3>> corners = corners_of(body.box);
  const auto in_front =
      std::ranges::count_if(corners, [&](const Vec<3>& p) { return view.in_front(p); });
  if (in_front == 0 || view.lost(body.position)) return false;
  if (in_front < std::ssize(corners)) return true;  // the eye is beside it, or in it
  Outline outline = mapped(corners, [&](const Vec<3>& corner) { return view.to_page(corner); });
  return overlap(box_of(outline), view.panel());
}

void add_contacts(const Frame& frame, const Marks& marks, LeftOut& left_out, DrawList& list) {
  if (!frame.display.contacts) return;
  if (mark_contacts(frame, marks))
    list.referents.insert({"contacts", "contact_points", "impulses", "touching"});
  else
    left_out.push_back(word("not all contacts are drawn"));
}

// What lies over the bodies.
void draw_marks(const World2D& w, LeftOut& left_out) {
  Marks marks(w.map, mark_limit(w.map), w.list), inside(w.map, w.map.picture(), w.list);
  mark_links(w.frame, marks);
  mark_views(w.frame, inside);
  mark_eyes(w.frame, w.map, shrunk(w.map.picture(), -20), w.list);
  mark_queries(w.frame, inside);
  mark_velocities(w.frame, marks);
  add_contacts(w.frame, marks, left_out, w.list);
  mark_rays(w.frame, marks);
  mark_hits(w.frame, marks, w.labels);
  mark_found(w.frame, inside, w.list);
  mark_forces(w.frame, marks);
  write_forces(w.frame, w.map, w.labels);
  mark_rulers(w.frame, marks, w.labels);
  if (w.frame.display.pairs) mark_missed(w.frame, marks, w.labels);
  const auto is_in_a_body = [&](const Vec<2>& eye) {  // then the eye is the body's
    return std::ranges::any_of(
        w.frame.bodies, [&](const FrameBody& body) { return contains(flat(body.box), eye); });
  };
  if (const auto& own = w.frame.get<FrameLevel>().eye; own && !is_in_a_body(*own)) {
    const Vec<2> eye = w.map.to_page(*own);
    draw_eye(eye, {1, 0}, Role::ink, shrunk(w.map.picture(), -20), w.list);
    w.labels.block(Box<2>::around(eye, {24, 18}));
  }
}

// Where a world has drawn what notes are about: bodies, then what else has a place in the picture.
using PlaceOf = std::function<std::optional<Box<2>>(const FrameNode&)>;
void tell_places(const Frame& frame, const Projection& view, const PlaceOf& place_of,
                 Labels& labels) {
  for (const FrameNode& node : frame.nodes)
    if (const auto place = place_of(node)) labels.tell_place(target_of_cell(node.label), *place);
  for (std::size_t i = 0; i < frame.notes.size(); ++i)
    if (const auto at = view.seen(frame.notes[i].point); at && contains(view.picture(), *at))
      labels.tell_place(target_of_note(i), {*at, *at});
}

void tell_body(const Box<2>& box, std::span<const FrameBody* const> bodies, Labels& labels) {
  labels.tell_body(box);
  for (const FrameBody* body : bodies) labels.tell_place(target_of(*body), box);
}

void draw_world3d(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
                  Labels& labels) {
  const View3D view(frame.bounds, frame.camera, panel);
  list.solids.push_back({list.prefix, panel});
  LeftOut left_out;
  const bool crowd = frame.bodies.size() > kCrowd;
  const std::vector<Body3D> bodies = crowd ? std::vector<Body3D>() : bodies_in_view(frame, view);
  draw_ground3d(frame, view, list);
  if (frame.display.cells) {
    draw_cell_grounds(frame, view, list);
    draw_cut_grounds(frame, view, list);
  }
  draw_shadows(bodies, view, list);
  Marks3D marks(view, bodies, list);
  add_marks(frame, marks, left_out);
  marks.paint();
  for (const Body3D& body : bodies) tell_marks(*body.body, list);
  if (crowd) {
    draw_crowd3d(frame, view, list);
    left_out.push_back(say("{} bodies as dots", frame.bodies.size()));
  }
  if (frame.display.pairs) draw_joints(frame, marks);
  add_contacts(frame, marks, left_out, list);
  mark_eyes(frame, view, panel, list);
  mark_hits(frame, marks, labels);
  mark_found(frame, marks, list);
  write_forces(frame, view, labels);
  mark_rulers(frame, marks, labels);
  if (frame.display.pairs) mark_missed(frame, marks, labels);
  if (!crowd) depict_bodies(frame, list);
  note(left_out, panel, labels);
  std::vector<Box<2>> covered = mapped(bodies, &Body3D::box);
  std::vector<std::pair<Stack, Box<2>>> stacks;
  for (const Stack& stack : stacks_of(mapped(bodies, &Body3D::body)))
    stacks.emplace_back(stack, std::ranges::find(bodies, stack.front(), &Body3D::body)->box);
  draw_stacks(stacks, covered, panel, list, labels);
  write_depths(frame, view, covered, labels);
  name_world3d(frame, staging, bodies, view, list, labels);
  write_heights(bodies, view, list, labels);
  if (!labels.has_notes()) return;
  for (const Body3D& b : bodies) tell_body(b.box, {&b.body, 1}, labels);
  tell_places(
      frame, view,
      [&](const FrameNode& node) -> std::optional<Box<2>> {
        if (!is_valid(node.box)) return {};
        const auto at = view.seen(node.box.center());
        return at && contains(view.panel(), *at) ? std::optional(Box<2>{*at, *at}) : std::nullopt;
      },
      labels);
}

void draw_world2d(World2D w) {
  LeftOut left_out;
  if (!draw_cells(w)) left_out.push_back(word("the smallest cells are not drawn"));
  draw_portals(w);
  draw_walls(w);
  draw_sights(w);
  if (w.frame.bodies.size() > kCrowd) {
    const std::size_t marks = draw_crowd(w);
    if (50 * marks < 49 * w.frame.bodies.size())
      left_out.push_back(say("{} bodies as {} marks", w.frame.bodies.size(), marks));
    draw_marks(w, left_out);
    return note(left_out, w.map.picture(), w.labels);
  }
  const std::vector<GroundPlace> ground = draw_half_spaces(w);
  w.stands = stands_of(w.frame, w.map);
  // A ray, view or region is about bodies, not about pairs.
  const bool asks = !w.frame.get<FrameFinding>().rays.empty() ||
                    !w.frame.get<FrameFinding>().views.empty() ||
                    !w.frame.get<FrameFinding>().queries.empty();
  const bool pairs = w.frame.display.pairs && !asks;
  const PageLinks links = pairs ? links_of(w) : PageLinks();
  if (!links.complete)
    left_out.push_back(word("not all pairs are drawn"));
  else if (pairs)
    w.list.referents.insert({"pairs", "overlaps", "shapes_tested"});
  draw_links(w, links, false);
  draw_trails(w);
  const bool own_boxes = w.frame.structure != StructureKind::none && !w.frame.display.boxes;
  draw_bodies(w, own_boxes);
  for (const Stand& stand : w.stands) {
    if (stand.outside) continue;
    const DrawList::Scope scope(w.list, body_key("world/over", *stand.bodies[0]));
    draw_cells_over(w, w.map.to_page(stand.bodies[0]->box));
  }
  draw_links(w, links, true);
  depict_bodies(w.frame, w.list);
  draw_broad_boxes(w);
  draw_marks(w, left_out);
  mark_separation(w.frame, w.map, w.list, w.labels);
  mark_search(w.frame, w.map, w.list, w.labels);
  draw_looks(w);
  note(left_out, w.map.picture(), w.labels);
  for (const Stand& stand : w.stands) w.covered.push_back(stand.box);
  count_stacks(w);
  write_depths(w.frame, w.map, w.covered, w.labels);
  draw_coordinates(w);
  name_taken_line(w);
  mark_walk(w);
  number_sectors(w);
  label_cells(w);
  name_half_spaces(w, ground);
  for (const FrameNote& told : w.frame.notes)  // the end of its line
    if (told.of == NoteOf::point)
      w.labels.block(Box<2>::around(w.map.to_page(told.point), Vec<2>(8)));
  name_bodies(w);
  if (!w.labels.has_notes()) return;
  const auto seen = [&](const Box<2>& box) -> std::optional<Box<2>> {
    const Box<2>& picture = w.map.picture();
    if (!overlap(box, picture)) return {};
    return Box<2>{glm::clamp(box.lo, picture.lo, picture.hi),
                  glm::clamp(box.hi, picture.lo, picture.hi)};
  };
  for (const Stand& stand : w.stands)
    if (const auto box = seen(stand.box)) tell_body(*box, stand.bodies, w.labels);
  tell_places(
      w.frame, w.map, [&](const FrameNode& node) { return seen(w.map.to_page(node.box)); },
      w.labels);
}

}  // namespace

bool shows_a_body(const Frame& frame) {
  const auto is_seen = [&](auto&& shown) {
    return std::ranges::any_of(
        frame.bodies, [&](const FrameBody& body) { return !is_half_space(body) && shown(body); });
  };
  if (frame.dimension == 2) {
    const Box<2> part = frame.view.value_or(flat(frame.bounds));
    return is_seen([&](const FrameBody& body) { return overlap(flat(body.box), part); });
  }
  const View3D view(frame.bounds, frame.camera, {{0, 0}, {1600, 800}});
  return is_seen([&](const FrameBody& body) { return shows(view, body); });
}

void draw_world(const Frame& frame, const Staging& staging, const Box<2>& panel, DrawList& list,
                Labels& labels) {
  if (frame.dimension == 3) return draw_world3d(frame, staging, panel, list, labels);
  const View2D map(flat(frame.bounds), panel, frame.view);
  list.maps.push_back({list.prefix, map.picture(), map.to_page(Vec<2>(0.0)), map.scale()});
  if (!frame.view) return draw_world2d({frame, staging, map, list, labels});
  // Of a part all is drawn as ever and then cut. The corner with the whole is kept free of names.
  const Box<2> corner = place_of_locator(frame, map);
  labels.block(shrunk(corner, -4));
  if (labels.has_notes()) labels.tell_body(corner);
  const std::size_t first = list.shapes.size();
  draw_world2d({frame, staging, map, list, labels});
  keep_within(list, first, map.picture());
  draw_locator(frame, corner, list);
}

double world_aspect(const Frame& frame) {
  constexpr double kLeast3D = 0.95, kMost3D = 1.35;
  const Vec<3> size = frame.bounds.size();
  if (!(size.y > 0)) return 1;
  if (frame.dimension == 2) return size.x / size.y;
  // Seen from aside, what is wide or deep takes width.
  return std::clamp(std::max(size.x, size.z) / size.y, kLeast3D, kMost3D);
}

double world_width(const Frame& frame, double height) { return height * world_aspect(frame); }

PanelEntry world_panel() {
  return {{.name = "world",
           .words = "the `world`",
           .needs = "it needs a [world]",
           .possible = language::has_world,
           .place = 1,
           .by_itself = language::has_bodies_or_level},
          {.shows = {{"bodies", [](const Frame& f) { return !f.bodies.empty(); }},
                     {"walls", lists<FrameLevel, &FrameLevel::walls>}}},
          {.draw = draw_world,
           .width = world_width,
           .size = [](const Frame& frame, const Staging&, const Box<2>& box) {
             const double width = std::min(box.size().x, box.size().y * world_aspect(frame));
             const double size = std::sqrt(width * width / world_aspect(frame));
             // A level is read on its map, whose sectors have numbers and bodies in them.
             return geometry::pow(size, frame.get<FrameLevel>().walls.empty() ? 1 : 1.5);
           }}};
}

}  // namespace lantern::draw
