#include "draw/world_view.hpp"

#include <fmt/format.h>

#include "draw/solid_view.hpp"
#include "draw/world_bodies.hpp"

namespace lantern {
namespace {

constexpr std::size_t kCrowd = 700;  // more bodies than this are no longer drawn one by one

}  // namespace

void draw_world(const Frame& frame, const Box<2>& panel, DrawList& list, Labels& labels) {
  if (frame.dimension == 3) return draw_solid_world(frame, panel, list, labels);
  const WorldMap map(flat(frame.bounds), panel);
  Grounds grounds;
  std::string note;
  const auto leave_out = [&](const std::string& what) {
    note += (note.empty() ? "" : "; ") + what;
  };
  if (!draw_cells(frame, map, list, grounds)) leave_out("the smallest cells are not drawn");
  if (frame.bodies.size() > kCrowd) {
    const std::size_t marks = draw_crowd(frame, map, list);
    leave_out(fmt::format("{} bodies as {} marks", frame.bodies.size(), marks));
    return labels.add_note(note, map.rect);
  }
  const std::vector<Stand> stands = stands_of(frame, map);
  if (!draw_pairs(frame, stands, list)) leave_out("not all pairs are drawn");
  draw_bodies(stands, map, list);
  for (const Stand& stand : stands)
    if (!stand.outside) draw_cells_over(frame, map, map.to_page(stand.bodies[0]->box), list);
  draw_joints(frame, stands, list);
  if (!note.empty()) labels.add_note(note, map.rect);
  std::vector<Box<2>> covered;
  for (const Stand& stand : stands) covered.push_back(stand.box);
  label_cells(frame, map, covered, grounds, list, labels);
  name_bodies(stands, map, grounds, labels);
}

}  // namespace lantern
