// Marks over the bodies of a flat world: what physics and queries say about them.
#pragma once

#include "draw/world_bodies.hpp"
#include "draw/world_parts.hpp"

namespace lantern {

// Of each this many are drawn on one frame, flat or solid; the rest is left out.
inline constexpr std::size_t kMostViews = 8;
inline constexpr std::size_t kMostQueries = 60;
inline constexpr std::size_t kMostRays = 120;
inline constexpr std::size_t kMostHits = 60;

// Half-spaces: hatched ground, cut to the bounds, or to a rim under them where none of it lies
// inside. Gives the places of their names and adds what was painted to `grounds`.
struct GroundPlace {
  const FrameBody* body = nullptr;
  Vec<2> label{0.0};  // the middle of a name
};
std::vector<GroundPlace> draw_half_spaces(const Frame& frame, const WorldMap& map, DrawList& list,
                                          Grounds& grounds);
// From a body to the ground that it is to be tested with.
void draw_ground_pairs(const Frame& frame, const WorldMap& map, DrawList& list);
void name_half_spaces(const std::vector<GroundPlace>& places, const WorldMap& map,
                      const Grounds& grounds, Labels& labels);

// Springs, distance joints and pins.
void draw_links(const Frame& frame, const WorldMap& map, DrawList& list);

// Points, normals and impulses. False if there are too many, and not all are drawn.
bool draw_contacts(const Frame& frame, const WorldMap& map, DrawList& list);

// An arrow from each body's centre, the faster the longer, by one rule for all frames.
void draw_velocities(const Frame& frame, const WorldMap& map, DrawList& list);

// Dashed, with its half sizes where the step is about the body or there are few bodies.
void draw_broad_boxes(const Frame& frame, const WorldMap& map, DrawList& list, Labels& labels);

// The grounds of views, under the cells; for a label's halo they are added to `grounds`.
void fill_views(const Frame& frame, const WorldMap& map, DrawList& list, Grounds& grounds);
void draw_views(const Frame& frame, const WorldMap& map, DrawList& list);
void draw_queries(const Frame& frame, const WorldMap& map, DrawList& list);
// Rays with their hits, numbered when there are several.
void draw_rays(const Frame& frame, const WorldMap& map, DrawList& list, Labels& labels);

// An eye at a place of the page that looks along `gaze`.
void draw_eye_mark(const Vec<2>& at, const Vec<2>& gaze, Role role, const Box<2>& place,
                   DrawList& list);

// A level's walls, and the place it is looked at from.
void draw_walls(const Frame& frame, const WorldMap& map, DrawList& list);
// A level's sectors: neighbours in different tones, solid ones hatched.
bool is_level(const Frame& frame);
void fill_sectors(const Frame& frame, const WorldMap& map, DrawList& list, Grounds& grounds);
// The places of sectors in the order from the eye.
void number_sectors(const Frame& frame, const WorldMap& map, const Grounds& grounds,
                    Labels& labels);

// Where marks may be drawn: the bounds and a little beyond.
Box<2> mark_limit(const WorldMap& map);

}  // namespace lantern
