#include <fmt/format.h>

#include "draw/panels.hpp"
#include "draw/world2d_parts.hpp"

namespace lantern {
namespace {

// What lies over the bodies. Gives what had to be left out.
std::string draw_marks(const Frame& frame, const View2D& map, DrawList& list, Labels& labels) {
  Marks2D marks(map, mark_limit(map), list), inside(map, map.picture(), list);
  mark_links(frame, marks);
  mark_views(frame, inside);
  mark_eyes(frame, map, shrunk(map.picture(), -20), list);
  mark_queries(frame, inside);
  mark_velocities(frame, marks);
  const bool all = mark_contacts(frame, marks);
  mark_rays(frame, marks);
  mark_hits(frame, marks, labels);
  if (frame.eye) {
    const Vec<2> eye = map.to_page(*frame.eye);
    draw_eye(eye, {1, 0}, Role::ink, shrunk(map.picture(), -20), list);
    labels.block(Box<2>::around(eye, {24, 18}));
  }
  return all ? "" : "not all contacts are drawn";
}

}  // namespace

void draw_world(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  if (frame.dimension == 3) return draw_world3d(frame, panel, list, labels);
  const View2D map(flat(frame.bounds), panel);
  Grounds grounds;
  std::string note;
  const auto leave_out = [&](const std::string& what) {
    if (!what.empty()) note += (note.empty() ? "" : "; ") + what;
  };
  if (!draw_cells(frame, map, list, grounds)) leave_out("the smallest cells are not drawn");
  draw_walls(frame, map, list);
  if (frame.bodies.size() > kCrowd) {
    const std::size_t marks = draw_crowd(frame, map, list);
    leave_out(fmt::format("{} bodies as {} marks", frame.bodies.size(), marks));
    leave_out(draw_marks(frame, map, list, labels));
    return labels.add_note(note, map.picture());
  }
  const std::vector<GroundPlace> ground = draw_half_spaces(frame, map, list, grounds);
  const std::vector<Stand> stands = stands_of(frame, map);
  // A ray, view or region is about bodies, not about pairs.
  const bool asks = !frame.rays.empty() || !frame.views.empty() || !frame.queries.empty();
  if (!asks && !draw_pairs(frame, stands, list)) leave_out("not all pairs are drawn");
  Marks2D marks(map, mark_limit(map), list);
  if (!asks) draw_ground_pairs(frame, marks);
  const bool own_boxes = frame.structure != StructureKind::none && !frame.show_boxes;
  draw_bodies(stands, map, own_boxes, list);
  for (const Stand& stand : stands)
    if (!stand.outside) draw_cells_over(frame, map, map.to_page(stand.bodies[0]->box), list);
  if (!asks) draw_joints(frame, stands, list);
  draw_broad_boxes(frame, map, list, labels);
  leave_out(draw_marks(frame, map, list, labels));
  if (!note.empty()) labels.add_note(note, map.picture());
  std::vector<Box<2>> covered;
  for (const Stand& stand : stands) covered.push_back(stand.box);
  write_depths(frame, map, covered, labels);
  number_sectors(frame, map, grounds, labels);
  label_cells(frame, map, covered, grounds, list, labels);
  name_half_spaces(ground, map, grounds, labels);
  name_bodies(stands, covered, map, grounds, labels);
}

}  // namespace lantern
