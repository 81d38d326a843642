#include <fmt/format.h>

#include "draw/panels.hpp"
#include "draw/world3d_parts.hpp"

namespace lantern {
namespace {

constexpr std::size_t kMostBoxed = 60;

// All that other bodies may hide; adds to the note what had to be left out.
void add_marks(const Frame& frame, Marks3D& marks, std::vector<std::string>& left_out) {
  for (const Body3D& body : marks.bodies) marks.pieces.push_back(body_piece(body, marks.view));
  if (!add_cells(frame, marks)) left_out.push_back("the deepest cells are not drawn");
  add_drop_lines(marks);
  if (!add_pairs(frame, marks)) left_out.push_back("not all pairs are drawn");
  mark_links(frame, marks);
  mark_velocities(frame, marks);
  for (const Body3D& b : marks.bodies)
    if (frame.show_boxes && (b.body->lit || marks.bodies.size() <= kMostBoxed))
      marks.box(b.body->box, {b.body->lit ? Role::lit : Role::quiet_ink, 1.5, 5});
  mark_views(frame, marks);
  mark_rays(frame, marks);
  mark_queries(frame, marks);
}

}  // namespace

void draw_world3d(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  const View3D view(frame.bounds, frame.camera, panel);
  std::vector<std::string> left_out;
  const bool crowd = frame.bodies.size() > kCrowd;
  const std::vector<Body3D> bodies = crowd ? std::vector<Body3D>() : bodies_in_view(frame, view);
  draw_ground3d(frame, view, list);
  draw_cell_grounds(frame, view, list);
  draw_shadows(bodies, view, list);
  Marks3D marks(view, bodies, list);
  add_marks(frame, marks, left_out);
  marks.paint();
  if (crowd) {
    draw_crowd3d(frame, view, list);
    left_out.push_back(fmt::format("{} bodies as dots", frame.bodies.size()));
  }
  draw_joints(frame, marks);
  if (!mark_contacts(frame, marks)) left_out.push_back("not all contacts are drawn");
  mark_eyes(frame, view, panel, list);
  mark_hits(frame, marks, labels);
  labels.add_note(fmt::format("{}", fmt::join(left_out, "; ")), panel);
  std::vector<Box<2>> covered;
  for (const Body3D& body : bodies) covered.push_back(body.box);
  write_depths(frame, view, covered, labels);
  name_world3d(frame, bodies, view, list, labels);
}

}  // namespace lantern
