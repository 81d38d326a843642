// The bodies of the world panel: who stands where on the page, as what, and under which name.
#pragma once

#include "draw/body_shapes.hpp"
#include "draw/world_parts.hpp"

namespace lantern {

// Bodies that stand at one place, or one body that stands alone.
struct Stand {
  std::vector<const FrameBody*> bodies;  // in order of ids
  Vec<2> center{0.0};                    // of the first, on the page
  Box<2> box;                            // that all of them cover on the page
  bool outside = false;                  // of the world's bounds: only a marker at the rim
};

// In order of the first body's id. Half-spaces stand nowhere.
std::vector<Stand> stands_of(const Frame& frame, const WorldMap& map);

// False if there are too many pairs, and not all are drawn.
bool draw_pairs(const Frame& frame, const std::vector<Stand>& stands, DrawList& list);
// A mark where two bodies that are to be tested cover each other, and with it their link.
void draw_joints(const Frame& frame, const std::vector<Stand>& stands, DrawList& list);
// `boxes`: with the dashed boxes of what is no box itself.
void draw_bodies(const std::vector<Stand>& stands, const WorldMap& map, bool boxes, DrawList& list);
void name_bodies(const std::vector<Stand>& stands, const WorldMap& map, const Grounds& grounds,
                 Labels& labels);

// Too many bodies to tell apart: one mark for each small square of the page that holds any.
// Returns how many marks it made.
std::size_t draw_crowd(const Frame& frame, const WorldMap& map, DrawList& list);

}  // namespace lantern
