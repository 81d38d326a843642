// Frames as a director would give them, built by hand so that the draw room is tested alone.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/staging.hpp"
#include "frame/frame.hpp"

namespace lantern::draw::samples {

Frame ghosts(std::size_t objects);                      // 2, 3 or 4 of the lecture's ghosts
Frame pong(double ball_x);                              // court 32 x 18 with a BSP
Frame doom();                                           // a BSP with slanting lines
Frame coincident(std::uint32_t depth);                  // three bodies of some size at one point
Frame crowd(std::size_t bodies, double size);           // seeded, in a quadtree
Frame outside();                                        // bodies beyond the world's bounds
Frame overhanging();                                    // a body larger than the world
Frame long_texts();                                     // very long names, title and caption
Frame atlas(std::size_t textures, std::size_t packed);  // the first `packed` of them inserted
Frame fine_atlas(std::size_t textures);                 // very many very small ones
Frame empty();                                          // nothing in it at all
Frame unstructured();                                   // bodies, but no tree

using Named = std::vector<std::pair<std::string, Frame>>;
Named charts();    // lines and bars, few and many, plain and extreme
Named memories();  // the array that all leaves share, from no slot to 10,000
Named ledgers();   // from two bodies to many, every state of a pair, each phase
Named islands();   // two, one asleep, over a floor and a body that is in none; very many
Named screens();   // before, in the midst of and after its ways; all elements on one spot
Named strips();    // a pool of nodes, bytes, a line so far; the intervals of a sweep
Named worlds();    // turned bodies, contacts, links, rays, views, levels, sleepers, two trees
Named sides();     // two to four of them, with a chart, with long titles, one that holds

// Name and frame of all of the above, in several sizes; made once.
const Named& all();

// Parts of which samples are made: a body of a flat world, a frame without bodies.
FrameBody body(BodyId id, std::string name, Look look, int color, const Vec<2>& at,
               const Shape<2>& shape = Sphere{0.55}, double angle = 0);
Frame base(std::string title, const Box<2>& bounds, std::vector<Panel> panels);
// These under one title, called a, b, c, d.
Frame sided(std::vector<Frame> sides);

// The whole page of 1600 x 900 pixels, in a sequence of these axes.
DrawList page_of(const Frame& frame, const AxisRanges& axes = {});

}  // namespace lantern::draw::samples
