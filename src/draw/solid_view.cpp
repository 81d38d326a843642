#include "draw/solid_view.hpp"

#include <fmt/format.h>

#include "draw/depths.hpp"
#include "draw/solid_parts.hpp"

namespace lantern {

void draw_solid_world(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  constexpr std::size_t kCrowd = 700;  // more bodies than this are dots
  const SolidView view(frame.bounds, frame.camera, panel);
  std::string note;
  const auto leave_out = [&](const std::string& what) {
    note += (note.empty() ? "" : "; ") + what;
  };
  const bool crowd = frame.bodies.size() > kCrowd;
  const std::vector<SolidBody> bodies =
      crowd ? std::vector<SolidBody>() : solid_bodies(frame, view);
  draw_solid_ground(frame, view, list);
  draw_cell_grounds(frame, view, list);
  draw_shadows(bodies, view, list);
  std::vector<Piece> pieces;
  for (const SolidBody& body : bodies) pieces.push_back(body_piece(body, view));
  if (!add_cells(frame, bodies, view, pieces)) leave_out("the deepest cells are not drawn");
  add_drop_lines(bodies, view, pieces);
  if (!add_marks(frame, bodies, view, pieces)) leave_out("not all pairs are drawn");
  add_sight(frame, bodies, view, pieces);
  paint(std::move(pieces), view, list);
  if (crowd) {
    draw_solid_crowd(frame, view, list);
    leave_out(fmt::format("{} bodies as dots", frame.bodies.size()));
  }
  if (!draw_marks_over(frame, bodies, view, list)) leave_out("not all contacts are drawn");
  draw_sight_over(frame, view, list, labels);
  if (!note.empty()) labels.add_note(note, panel);
  std::vector<Box<2>> covered;
  for (const SolidBody& body : bodies) covered.push_back(body.box);
  const auto seen = [&](const Vec<3>& p) -> std::optional<Vec<2>> {
    if (view.lost(p)) return std::nullopt;
    return view.to_page(p);
  };
  write_depths(frame, seen, covered, panel, labels);
  name_solids(frame, bodies, view, list, labels);
}

}  // namespace lantern
