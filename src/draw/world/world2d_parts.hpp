// What the parts of a 2D world's panel share.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/body_shapes.hpp"
#include "draw/labels.hpp"
#include "draw/marks.hpp"

namespace lantern::draw {

// A node's region on the page.
Polygon page_region(const FrameNode& node, const View2D& map);

// The piece of a node's dividing line that lies in its region, in the world; nothing if it misses
// it.
std::optional<std::pair<Vec<2>, Vec<2>>> dividing_line(const FrameNode& node);

// A convex region of the page whose border moved inwards, so that a line on it shows beside the
// dividing lines.
Polygon inset(const Polygon& region, double by);

// A region whose ground is not the panel's, so that a label's halo can match it.
struct Ground {
  Polygon region;  // on the page; clockwise there
  Role role = Role::panel;
};
using Grounds = std::vector<Ground>;

// Bodies that stand at one place, or one body that stands alone.
struct Stand {
  std::vector<const FrameBody*> bodies;  // in order of ids
  Vec<2> center{0.0};                    // of the first, on the page
  Box<2> box;                            // that all of them cover on the page
  bool outside = false;                  // of the world's bounds: only a marker at the rim
};

// In order of the first body's id. Half-spaces stand nowhere.
std::vector<Stand> stands_of(const Frame& frame, const View2D& map);

// A 2D world that is drawn, and where: what its parts hand on to each other.
struct World2D {
  const Frame& frame;
  const Staging& staging;
  const View2D& map;
  DrawList& list;
  Labels& labels;
  std::vector<Stand> stands = {};    // its bodies, unless they are a crowd
  std::vector<Box<2>> covered = {};  // by these, on the page
  Grounds grounds = {};              // painted so far; the first of two is over the other
};

Role ground_at(const Grounds& grounds, const Vec<2>& point);

// The polygon holds the point, or the whole box; any convex polygon, either way round.
bool inside(const Polygon& polygon, const Vec<2>& point);
bool inside(const Polygon& polygon, const Box<2>& box);

// The quarters of quadtree nodes for which no child was made, in the world.
struct Unmade {
  Box<2> quarter;
  std::string label;  // that its node would have
};
std::vector<Unmade> unmade_quarters(const Frame& frame);

// Cells and dividing lines; leaves what it painted in the world's grounds. False if there are too
// many cells, and the smallest are left out.
bool draw_cells(World2D& w);

// The lines of cells smaller than `place`, a body's box on the page, once more over what is drawn
// there: a body hides the splits that it causes.
void draw_cells_over(const World2D& w, const Box<2>& place);

// The names of leaves in their corners, and of dividing lines. Bodies cover cells, so names keep
// clear of these.
void label_cells(const World2D& w);

// --- bodies: who stands where on the page, as what, and under which name ---

// The link of a pair on the page; of bodies at one place, of all their pairs.
struct PageLink {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
  LinkLook look;
  std::string key;               // of its shapes
  std::vector<Vec<2>> bow;       // its points where it goes round a body that would hide it
  bool close = false;            // the bodies leave no room between them: it lies over them
  std::optional<Box<2>> common;  // what the two boxes share
};
struct PageLinks {
  std::vector<PageLink> links;
  bool complete = true;  // else there are too many, and some are missing
};
PageLinks links_of(const World2D& w);
// Under the bodies, or what lies over them.
void draw_links(const World2D& w, const PageLinks& links, bool over);

// What a ray, view or region left out, and the places of cells on a ray's way; free of bodies.
void mark_walk(const World2D& w);
// Where the borders of the lit way lie, at the world's lower and left edges.
void draw_coordinates(const World2D& w);

// `boxes`: with the dashed boxes of what is no box itself.
void draw_bodies(const World2D& w, bool boxes);
// How many bodies coincide, wherever some do.
void count_stacks(const World2D& w);
// Of those that show one; each on its side and free of what is covered by bodies, as far as there
// is room.
void name_bodies(const World2D& w);

// Too many bodies to tell apart: one mark for each small square of the page that holds any.
// Returns how many marks it made.
std::size_t draw_crowd(const World2D& w);

// Where bodies were at the ends of steps, as outlines on their way, and before a step is taken
// where they would be after it.
void draw_trails(const World2D& w);
// The looks for the moment of an impact, each with its share of the step; the last with its gap.
void draw_looks(const World2D& w);

// --- ground, levels and boxes ---

// Half-spaces: hatched ground, cut to the bounds, or to a rim under them where none of it lies
// inside. Gives the places of their names and adds what was painted to the grounds.
struct GroundPlace {
  const FrameBody* body = nullptr;
  Vec<2> label{0.0};  // the middle of a name
};
std::vector<GroundPlace> draw_half_spaces(World2D& w);
void name_half_spaces(const World2D& w, const std::vector<GroundPlace>& places);

// Dashed, with its half sizes where the step is about the body or there are few bodies.
void draw_broad_boxes(const World2D& w);

// The land that the scenario draws its world on, cut to the picture.
void draw_land(const World2D& w);

// A level's walls, and the place it is looked at from.
void draw_walls(const World2D& w);
// A level's sectors: neighbours in different tones, solid ones hatched.
bool is_level(const Frame& frame);
// One that was asked for a point's side; who sees whom is asked of other lines.
bool is_asked_line(const Frame& frame, const FrameNode& node);
Grounds fill_sectors(const World2D& w);
// The sectors' numbers, or their places in the order from the eye: on all frames of a group at the
// same places, where on none of them a body stands; none where a body does.
void number_sectors(const World2D& w);
// The number of the wall whose line is taken, its front, and how many pieces lie on each side.
void name_taken_line(const World2D& w);
// Openings between sectors, and lines of sight.
void draw_portals(const World2D& w);
void draw_sights(const World2D& w);

// Where marks may be drawn: the bounds and a little beyond.
inline Box<2> mark_limit(const View2D& map) { return shrunk(map.picture(), -8); }

// Where in a 2D world a view of a part of it is: a small picture of the whole, in the corner of the
// picture where it hides least of the bodies; the frame must have a view.
Box<2> place_of_locator(const Frame& frame, const View2D& map);

// The bounds with their largest cells, bodies as dots, and the part that is shown.
void draw_locator(const Frame& frame, const Box<2>& place, DrawList& list);

}  // namespace lantern::draw
