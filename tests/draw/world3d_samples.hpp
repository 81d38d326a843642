// Frames of solid worlds, made by hand around real trees.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "frame/frame.hpp"

namespace lantern::draw::samples {

FrameBody solid_body(BodyId id, std::string name, const Shape<3>& shape, const Vec<3>& position,
                     int color);

Frame octree_frame();   // seven bodies in a cube that is split twice
Frame tower_frame();    // boxes on a half-space, the lowest asleep, with contacts
Frame culling_frame();  // a view, a ray, links, and bodies of all shapes
Frame columns_frame();  // a quadtree over x and z: characters on a floor
Frame crowd_frame();    // more bodies than are drawn one by one
Frame inside_frame();   // the eye is within the bounds
Frame pit_frame();      // bodies of all shapes and turns, with a camera of its own

std::vector<std::pair<std::string, Frame>> all_solid();

}  // namespace lantern::draw::samples
