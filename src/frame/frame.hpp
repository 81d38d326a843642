// One picture's worth of facts, as plain values from the engine. All that is drawn or written as
// JSON is here; nothing of it is computed by whoever draws.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frame/body_state.hpp"
#include "frame/comparison.hpp"
#include "frame/parts.hpp"
#include "geometry/flat.hpp"
#include "geometry/plane.hpp"
#include "language/code_text.hpp"
#include "language/scenario.hpp"
#include "physics/gjk.hpp"
#include "physics/world_config.hpp"
#include "spatial/structure.hpp"

namespace lantern::frame {

// What the current step did to a node.
enum class Mark { quiet, passed, lit };

// The same by their handles.
struct Touched {
  std::set<NodeHandle> lit;
  std::set<NodeHandle> passed;
  std::set<NodeHandle> skipped;  // left out by a ray, view or region, with all below them
  std::vector<NodeHandle> met;   // by a ray, in this order

  Mark mark_of(NodeHandle node) const {
    if (lit.contains(node)) return Mark::lit;
    return passed.contains(node) ? Mark::passed : Mark::quiet;
  }
};

// Where a body is, or was, or would be.
struct FramePlace {
  Vec<3> position{0.0};
  double angle = 0;  // radians, of a flat world

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("position", r.position).flat_world("orientation", r.angle);
  }
};

// Of a body's trail.
struct FrameStop : FramePlace {
  bool impact = false;  // between two steps; else at the end of one
};

// Points are of three dimensions; in a flat world z is 0, and so are the half sizes along it.
struct FrameBody : BodyState {
  BodyId id = 0;
  std::uint32_t place = 0;  // among the scenario's bodies, there or not
  std::string name;
  Look look = Look::box;
  int color = 1;
  Shape<3> shape;
  Box<3> box;                        // the smallest one around it
  std::optional<Box<3>> stored_box;  // that the structure holds: with contacts enlarged by how far
                                     // it may come in the next step; of a tree that was not
                                     // rebuilt, the old one
  std::vector<FrameStop> trail;      // where it has been, the oldest first, if frames show it
  std::optional<FramePlace> ahead;   // after the step that is about to be taken, if nothing is met
  bool is_static = false;
  bool asleep = false;
  bool lit = false;     // the step is about it
  bool dimmed = false;  // the step has ruled it out: culled, or not met by the ray
};

struct FrameNode {
  std::uint32_t id = 0;  // position in the order of visiting
  std::uint32_t parent = kNone;
  std::uint32_t slot = 0;  // which child of its parent
  std::uint32_t depth = 0;
  std::string label;  // "root", "1", "1.3"; of a BSP "back", "front.back"; of an atlas "C"
  Box<3> box;         // an atlas counts pixels, y down
  std::optional<Plane<3>> plane;  // inner nodes of a BSP or a kD-tree
  std::string plane_name;
  Polygon region;               // a flat BSP's, cut to the world's bounds; otherwise empty
  bool solid = false;           // a level's sector that lies behind walls
  std::uint32_t order = kNone;  // a level's sector: its place in the order from the eye, from 0
  bool unseen = false;          // a level's sector that the eye's sector cannot see
  bool leaf = true;
  bool awake = true;
  std::vector<BodyId> bodies;       // a leaf's, ascending; of an atlas, textures
  bool cut_vertically = false;      // an atlas's inner nodes
  bool over_capacity = false;       // holds more than its limit: at the depth limit, or no progress
  bool of_static = false;           // of the structure for what never moves
  std::uint32_t first = kNone;      // a leaf's contents in the array that all leaves share
  std::uint32_t room = 0;           // slots kept for it there, `bodies.size()` of them in use
  std::uint32_t pool_slot = kNone;  // its place in the pool of nodes, where there is one
  bool reused = false;              // a node of a tree before stood there
  Mark mark = Mark::quiet;
  bool split = false;    // since the frame before, at the same time: the step is about its division
  bool skipped = false;  // by a ray, view or region, itself or with a node above it
  std::uint32_t met = kNone;  // a leaf's place in the order in which a ray met them, from 0
};

struct FrameTexture {
  std::uint32_t id = 0;
  std::string name;
  int color = 1;
  Picture picture = Picture::pattern;
  int width = 0;
  int height = 0;
  bool packed = false;
  bool refused = false;
  bool turned = false;  // by 90 degrees: width and height are exchanged
  int x = 0;            // of a packed one, upper left corner
  int y = 0;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("id", r.id)("name", r.name)("size", r.width, r.height)
        .or_null(r.packed, "position", r.x, r.y)("refused", r.refused)
        .drawn(r.color, r.picture, r.packed, r.turned);
  }
};

// Of an atlas.
struct FrameTextures {
  static constexpr std::string_view kName = "textures";
  std::vector<FrameTexture> textures;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.when(!r.textures.empty(), "textures", r.textures);
  }
  void add_state(Hash& hash) const;
};

// A screen that is drawn from textures, and each way in which it has been drawn so far.
struct FrameElement {
  std::uint32_t texture = 0;  // of frame.textures
  int x = 0;                  // of the screen, upper left corner
  int y = 0;
  int width = 0;
  int height = 0;
  bool drawn = true;  // by the way that is under way; before the first one all are shown
  bool lit = false;   // the frame is about it

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("texture", r.texture)("position", r.x, r.y)("drawn", r.drawn)
        .drawn(r.width, r.height, r.lit);
  }
};

struct FrameDraw {
  std::uint32_t element = 0;
  bool binds = false;  // another image had to be bound before it
  bool done = false;   // else it is bound and not yet drawn

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("element", r.element)("binds", r.binds)("done", r.done);
  }
};

struct FrameWay {
  bool from_atlas = false;
  bool by_texture = false;  // sorted so; else in the order of the list
  std::vector<FrameDraw> draws;
  std::uint64_t bindings = 0;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.words("from", r.from_atlas, "textures", "atlas")
        .words("order", r.by_texture, "as_listed", "by_texture")("bindings", r.bindings)("draws",
                                                                                         r.draws);
  }
};

struct FrameScreen {
  static constexpr std::string_view kName = "screen";
  static constexpr bool kIsObject = true;
  int width = 0;
  int height = 0;
  std::uint32_t planned = 0;           // ways, in the whole script
  std::vector<FrameElement> elements;  // from the back to the front
  std::vector<FrameWay> ways;          // the last may be under way
  std::uint32_t bound = kNone;         // a texture, while it is drawn from
  bool atlas_bound = false;            // or the atlas

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("size", r.width, r.height)("elements", r.elements)("ways", r.ways)
        .drawn(r.planned, r.bound, r.atlas_bound);
  }
};

struct FramePair {
  Pair pair;
  bool lit = false;       // new since the frame before
  bool overlaps = false;  // their stored boxes do: the narrow phase will test them
};

// How much of a world step has happened on the frame. What a phase finds is listed from that phase
// on: no frame knows a result before it is there.
//   whole     all of it: the structure is ready for the next step, contacts are the last step's
//   broad     pairs are found; their boxes have not been compared, no shapes tested
//   boxes     the boxes of pairs have been compared
//   narrow    the shapes of those that overlap have been tested
//   resolve   impulses have been passed on
enum class StepPhase { whole, broad, boxes, narrow, resolve };

// Two bodies that touch, as the narrow phase says, and what the solver did about it.
struct FrameContact {
  struct Point {
    Vec<3> position{0.0};
    double separation = 0;  // below 0 they overlap
    double impulse = 0;     // along the normal, N s, over the last world step

    static decltype(auto) fields(const auto& r, auto&& v) {
      return v("position", r.position)("separation", r.separation)("impulse", r.impulse);
    }
  };
  Pair pair;
  Vec<3> normal{0.0};  // unit, from a to b
  std::vector<Point> points;
  bool begins = false;   // they did not touch a step before
  bool crushes = false;  // one of them, against a third

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("pair", r.pair)("normal", r.normal)("points", r.points)("begins", r.begins)("crushes",
                                                                                         r.crushes);
  }
};

// A look at two bodies within a world step, to find out when they meet. Times are shares of the
// step.
struct FrameLook {
  Pair pair;
  FramePlace a, b;              // where they are then
  Vec<3> on_a{0.0}, on_b{0.0};  // where their surfaces are nearest to each other
  double time = 0;
  double gap = 0;         // between them; below 0 they overlap
  double free_until = 0;  // for so long they surely do not touch; `time` if that is not known
  bool meets = false;     // this is the moment
  int number = 1;         // of the looks at this pair, from 1: not all of them are told

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("pair", r.pair)("a", r.a)("b", r.b)("time", r.time)("gap", r.gap)(
               "free_until", r.free_until)("meets", r.meets)
        .drawn(r.on_a, r.on_b, r.number);
  }
};

// For the moment of an impact, so far; the last is this frame's.
struct FrameLooks {
  static constexpr std::string_view kName = "looks";
  std::vector<FrameLook> looks;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("looks", r.looks); }
};

// A spring, a distance joint or a pin, between two points.
struct FrameLink {
  enum class Kind { spring, distance, pin };
  friend std::string_view to_string(Kind kind) {
    static constexpr std::string_view kWords[] = {"spring", "distance", "pin"};
    return kWords[static_cast<int>(kind)];
  }
  Kind kind = Kind::spring;
  Vec<3> from{0.0};
  Vec<3> to{0.0};
  double strain = 0;  // (length - rest) / rest; 0 for a pin

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("kind", r.kind)("from", r.from)("to", r.to)("strain", r.strain);
  }
};

struct FrameLinks {
  static constexpr std::string_view kName = "links";
  std::vector<FrameLink> links;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("links", r.links); }
};

// A force that acts on a body now: a script's, or the pull of a spring.
struct FrameForce {
  BodyId body = 0;
  Vec<3> at{0.0};     // in the world
  Vec<3> force{0.0};  // N
  bool of_spring = false;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("body", r.body)("at", r.at)("force", r.force)("of_spring", r.of_spring);
  }
};

// If the scenario shows them.
struct FrameForces {
  static constexpr std::string_view kName = "forces";
  std::vector<FrameForce> forces;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("forces", r.forces); }
};

// The length between two points, measured.
struct FrameRuler {
  Vec<3> from{0.0};
  Vec<3> to{0.0};
  double length = 0;
  std::optional<double> before;  // what it is compared with: as long as it was when the step began
  std::string text;              // what is measured; may be empty

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("from", r.from)("to", r.to)("length", r.length)("before", r.before).drawn(r.text);
  }
};

struct FrameRulers {
  static constexpr std::string_view kName = "rulers";
  std::vector<FrameRuler> rulers;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("rulers", r.rulers); }
};

// Bodies that hang together, as the last step of the world found, and so are moved together and
// sleep and wake together.
struct FrameIsland {
  std::uint32_t number = 0;  // from 1; an island keeps it while the body of its lowest id is in it
  std::vector<BodyId> bodies;  // ascending
  bool asleep = false;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("number", r.number)("bodies", r.bodies)("asleep", r.asleep);
  }
};

// What holds two bodies together, or keeps them apart: that they touch, or a spring or joint.
struct FrameEdge {
  Pair pair;
  bool tied = false;  // by a spring or joint
  bool lit = false;   // new since the frame before
};

// If they have a panel.
struct FrameIslands {
  static constexpr std::string_view kName = "islands";
  std::vector<FrameIsland> islands;  // in order of their numbers
  std::vector<FrameEdge> edges;      // in order of ids

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.when(!r.islands.empty(), "islands", r.islands).drawn(r.edges);
  }
};

struct FrameRay {
  Vec<3> from{0.0};
  Vec<3> to{0.0};  // where it ends: its length, or the nearest hit
  struct Hit {
    BodyId body = 0;
    Vec<3> position{0.0};

    static decltype(auto) fields(const auto& r, auto&& v) {
      return v("body", r.body)("position", r.position);
    }
  };
  std::vector<Hit> hits;  // in order along the ray

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("from", r.from)("to", r.to)("hits", r.hits);
  }
};

// A view that bodies are culled against. In a flat world a wedge: `corners` goes round it. In a
// solid one a frustum: four corners of the near plane, then four of the far plane, each going
// round.
struct FrameView {
  Vec<3> eye{0.0};
  std::vector<Vec<3>> corners;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("eye", r.eye)("corners", r.corners);
  }
};

// A region that was asked for what it overlaps.
struct FrameQuery {
  Box<3> box;
  double radius = 0;  // above 0: a disc or ball about the box's centre

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("box", r.box)("radius", r.radius);
  }
};

// What a ray, view or region was, and what it found.
struct FrameFinding {
  static constexpr std::string_view kName = "finding";
  std::vector<FrameRay> rays;
  std::vector<FrameView> views;
  std::vector<FrameQuery> queries;
  std::vector<BodyId> hits;  // of a ray in order along it

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.when(!r.rays.empty(), "rays", r.rays)
        .when(!r.views.empty(), "views", r.views)
        .when(!r.queries.empty(), "queries", r.queries)
        .drawn(r.hits);
  }
};

// An axis along which two bodies were measured: how far their shadows on it are apart.
struct FrameAxis {
  Vec<2> direction{0.0};         // unit, from the first body to the second
  double separation = 0;         // of the shadows; below 0 they overlap
  std::optional<BodyId> across;  // a face of this body; none: between closest points
  std::vector<Vec<2>> face;      // its ends
  // The points whose shadows end the bodies' shadows: the first body's least and most along the
  // axis, then the second's.
  std::array<Vec<2>, 4> ends{};

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("direction", r.direction)("separation", r.separation)("across", r.across)
        .drawn(r.face, r.ends);
  }
};

// Two bodies measured along one axis after another, until one parts them or there is none left.
struct FrameSeparation {
  static constexpr std::string_view kName = "separation";
  BodyId a = 0;
  BodyId b = 0;
  std::vector<FrameAxis> axes;  // those so far, in their order
  // Which of them answers: it parts the bodies, or they overlap least along it. None yet: unknown.
  std::optional<std::size_t> answer;

  double gap() const;      // along the answer, or else the newest axis; 0 if they overlap
  double overlap() const;  // the least so far; 0 if they are apart

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("axes", r.axes)("answer", r.answer).drawn(r.a, r.b);
  }
};

// The shapes of many pairs, each pair tested once.
struct ShapeTests {
  std::vector<Pair> tested;  // in order of ids
  std::uint64_t work = 0;    // lengths measured
  std::vector<FrameContact> touching;
};

// GJK: support point by support point to the distance of two bodies.
struct FrameSearch {
  static constexpr std::string_view kName = "search";
  BodyId a = 0;
  BodyId b = 0;
  std::vector<GjkStep> steps;  // those so far
  bool taken = true;           // the last one's point has entered the simplex
  std::optional<GjkAnswer> answer;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("searches", r.steps).drawn(r.a, r.b, r.taken, r.answer);
  }
};

// All points of the first body less all points of the second.
struct FrameDifference {
  static constexpr std::string_view kName = "difference";
  BodyId a = 0;
  BodyId b = 0;
  std::vector<Vec<2>> corners;  // convex, counter-clockwise
  double radius = 0;            // round them, of round shapes

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("difference", r.corners)("radius", r.radius).drawn(r.a, r.b);
  }
};

// A piece of a level's wall.
struct FrameWall {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
  std::uint32_t wall = 0;      // of the scenario's walls
  std::uint32_t node = kNone;  // of frame.nodes: where it lies, once it does
  Mark mark = Mark::quiet;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("wall", r.wall)("from", r.from)("to", r.to)
        .when(r.node != kNone, "node", r.node)
        .drawn(r.mark);
  }
};

// An opening between two of a level's sectors, and a line of sight between two that see each other.
struct FramePortal {
  Vec<2> from{0.0};
  Vec<2> to{0.0};
  std::uint32_t a = 0;  // the sectors' nodes, of frame.nodes
  std::uint32_t b = 0;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("from", r.from)("to", r.to)("nodes", r.a, r.b);
  }
};
using FrameSight = FramePortal;

struct FrameLevel {
  static constexpr std::string_view kName = "level";
  std::vector<FrameWall> walls;
  std::optional<Vec<2>> eye;         // from where it is looked at
  std::vector<FramePortal> portals;  // once a step asked who sees whom
  std::vector<FrameSight> sights;    // of the sector whose view has just been found

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.when(!r.walls.empty(), "walls", r.walls)
        .when(!r.portals.empty(), "portals", r.portals)
        .when(!r.sights.empty(), "sights", r.sights)
        .drawn(r.eye);
  }
};

// Who sees whom of a level's sectors.
struct FrameMatrix {
  static constexpr std::string_view kName = "matrix";
  std::vector<std::string>
      rows;                   // a letter for each sector: '1' is seen, '0' is not, '.' not known
  std::uint32_t lit = kNone;  // the row that is asked for, or has just been found

  static decltype(auto) fields(const auto& r, auto&& v) { return v("matrix", r.rows).drawn(r.lit); }
};

// A line of a chart: what one count was against another, step by step.
struct FrameSeries {
  std::string name;            // of the count or measure, or of the body it is of
  std::vector<Vec<2>> points;  // in the order of the steps
  int color = 0;               // of the body; 0: whichever is next

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.drawn(r.name, r.points, r.color);
  }
};

// How often each structure, or each step, counted something, as bars.
struct FrameBar {
  std::string label;
  double value = 0;
  int group = 0;  // bars of one group stand together
  int line = 0;   // which of the chart's quantities, or sides: those of one look alike
};

struct FrameChart {
  static constexpr std::string_view kName = "chart";
  std::string x_name;  // of the count along x; empty for bars
  std::string y_name;
  bool logarithmic = false;       // both axes, but for time
  bool over_time = false;         // x is seconds
  std::optional<double> seconds;  // over time: how far the x axis goes; none: as far as the lines
  std::optional<double> least;    // of the y axis; lines leave the picture beyond it
  std::optional<double> most;
  std::string x_unit;  // "J"; empty for what is counted
  std::string y_unit;
  std::vector<FrameSeries> series;
  std::vector<FrameBar> bars;

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.drawn(r.x_name, r.y_name, r.logarithmic, r.over_time, r.seconds, r.least, r.most,
                   r.x_unit, r.y_unit, r.series, r.bars);
  }
};

// One count over the world's time so far, for the thin strip under what moves.
struct FrameTrace {
  static constexpr std::string_view kName = "trace";
  std::string name;               // of the count
  std::vector<Vec<2>> points;     // seconds since the part began, and the count
  std::optional<double> seconds;  // of the part; none: the script does not say

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.drawn(r.name, r.points, r.seconds);
  }
};

// A function of the lecture's own source, and which of its lines the frame is about.
using FrameCode = CodeText;

// What the world remembered, step after step, of one pair that touches or has just touched.
struct FrameCollision {
  struct Moment {
    std::uint64_t step = 0;  // of the world, from 1
    int frames_left = 0;     // after it: steps without touch before the end is told; -1: told in it
    bool touches = false;    // in it
    bool begins = false;     // its begin was told in it

    static decltype(auto) fields(const auto& r, auto&& v) {
      return v("step", r.step)("frames_left", r.frames_left)("touches", r.touches)("begins",
                                                                                   r.begins);
    }
  };
  Pair pair;
  std::vector<Moment> moments;  // in order

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("pair", r.pair)("moments", r.moments);
  }
};

// All of them since a part of the script began.
struct FrameCollisions {
  static constexpr std::string_view kName = "collisions";
  std::vector<FrameCollision> rows;    // by their first begin
  int remembered = 0;                  // what framesLeft begins with
  std::uint64_t first = 0;             // world steps before the part
  std::uint64_t now = 0;               // world steps so far
  std::optional<std::uint64_t> steps;  // of the part; none: the script does not say

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("collisions", r.rows).drawn(r.remembered, r.first, r.now, r.steps);
  }
};

// Perspective, y up.
struct Camera {
  Vec<3> eye{0.0};
  Vec<3> target{0.0};
  double field_of_view = 0.7;  // radians, from bottom to top
  bool goes_round = false;     // on some frame of the scenario: the picture fits all directions

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("eye", r.eye)("target", r.target).drawn(r.field_of_view, r.goes_round);
  }
};

// That of a solid world without one: from the front, above, and to the right.
Camera usual_camera(const Box<3>& bounds);

// A few words, and what they are about.
struct FrameNote {
  std::string text;  // counts filled in
  NoteOf of = NoteOf::point;
  std::vector<BodyId> bodies;  // one, or the two of a pair
  std::uint32_t node = kNone;  // of frame.nodes
  std::string count;
  Vec<3> point{0.0};
};

// Asked of the students after the sequence, and answered by the frame that has it.
struct FrameQuestion {
  static constexpr std::string_view kName = "question";
  static constexpr bool kIsObject = true;
  std::string asked;
  std::string answer;  // counts filled in

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v("asked", r.asked)("answer", r.answer);
  }
};

// How the structure was told to be, and what its panels need beside the nodes.
struct FrameStructure {
  static constexpr std::string_view kName = "structure";
  std::string settings;                 // "capacity 2, depth limit 4": what the tree was told
  std::uint32_t capacity = 0;           // of its leaves, if they split
  std::vector<GridExtent> grid_levels;  // of a grid, the finest first
  bool hashed = false;                  // its cells share buckets, of which the extents tell
  std::optional<BodyId> swept_to;       // a sweep stands at this body's beginning
  int sweep_axis = 0;            // along which a sweep sorted; of other structures of no matter
  std::uint32_t pool_size = 0;   // nodes that the tree's pool held at most; 0: it has none
  std::uint32_t array_size = 0;  // slots of the array that all leaves share
  bool may_sleep = true;         // some body of this world can fall asleep

  static decltype(auto) fields(const auto& r, auto&& v) {
    return v.drawn(r.settings, r.capacity, r.grid_levels, r.hashed, r.swept_to, r.sweep_axis,
                   r.pool_size, r.array_size, r.may_sleep);
  }
};

// Of a flat world: drawn under all else, and met by nobody.
struct FrameLand {
  static constexpr std::string_view kName = "land";
  std::vector<Polygon> land;

  static decltype(auto) fields(const auto& r, auto&& v) { return v.drawn(r.land); }
};

// Of a frame that is one side's: which it is.
struct FrameSide {
  static constexpr std::string_view kName = "side";
  std::string name;
  std::string title;  // what stands over it
  bool held = false;  // it has nothing more to show in this step, and shows its last frame

  static decltype(auto) fields(const auto& r, auto&& v) { return v.drawn(r.name, r.title, r.held); }
};

// What all sides of a frame share: the page, and where in the script it is.
struct FramePage {
  int dimension = 2;
  std::string scenario;
  std::string title;
  std::string part;
  std::uint64_t seed = 1;
  std::uint32_t step = 0;  // of the script, from 0
  std::uint32_t steps = 0;
  std::vector<std::string> headline;  // the numbers that the scenario puts in front; may be empty
  bool ending = false;                // the take-away of the sequence
  std::vector<Panel> panels;
  Box<3> bounds;
  Display display;
};

// What every picture has, and the parts that some have.
struct Frame : FramePage {
  std::uint32_t index = 0;  // of this frame, from 0
  std::string event;        // the step's name or the algorithm's event; for --at
  StepPhase phase = StepPhase::whole;
  double time = 0;                // seconds of world time
  std::string caption;            // counts filled in
  std::vector<std::string> told;  // the counts and measures that the caption quotes, in order
  StructureKind structure = StructureKind::none;
  std::uint32_t cast = 0;        // bodies of the scenario, there or not
  std::optional<Camera> camera;  // of a solid world
  std::optional<Box<2>> view;    // the part of a flat world that is shown; none: all of it
  std::vector<FrameNote> notes;  // of what is there
  std::vector<FrameBody> bodies;
  std::vector<FrameNode> nodes;  // parents before children
  std::vector<FramePair> pairs;  // in order of ids
  std::vector<Pair> tested;      // by the narrow phase in the last step, in order of ids
  std::vector<FrameContact> contacts;
  std::optional<WorldWork> since_last_frame;  // of its steps, summed up; none if there was none
  std::vector<std::pair<std::string, std::int64_t>> counts;  // in a fixed order
  // What is measured rather than counted: energies, in a fixed order.
  std::vector<std::pair<std::string, double>> measures;
  std::uint64_t hash = 0;  // of all of the above that is state
  FrameParts parts;

  // The same moment under each side's settings. What the sides share stands above, their bodies,
  // nodes, counts and all else that they have of their own only here.
  std::vector<Frame> sides;

  // The part of that type: null, or an empty one, if there is none.
  template <class P>
  const P* find() const {
    return parts.find<P>();
  }
  template <class P>
  const P& get() const {
    static const P kNothing{};
    const P* found = find<P>();
    return found ? *found : kNothing;
  }
  template <class P>
  P* find() {
    return parts.find<P>();
  }
  // The part that is there, or else a new one.
  template <class P>
  P& add() {
    return parts.add<P>();
  }
  // This one from now on, or none.
  template <class P>
  void put(const std::optional<P>& one) {
    one ? void(add<P>() = *one) : parts.drop<P>();
  }

  // Is this node drawn as one that sleeps? What never moves or holds nothing is not, nor what only
  // rests in a world where nothing falls asleep.
  bool sleeps(const FrameNode& node) const {
    return get<FrameStructure>().may_sleep && !node.awake && !node.of_static &&
           !(node.leaf && node.bodies.empty());
  }

  // The body of that id; null if it is not there.
  const FrameBody* body_of(BodyId id) const;
  // The side of that name; null if there is none.
  const Frame* side_named(std::string_view name) const;

  void add_count(std::string_view name, std::uint64_t n) {
    counts.emplace_back(name, static_cast<std::int64_t>(n));
  }
  // Nothing if the scene does not count or measure this. Of sides the name begins with that of one,
  // as "eager.pairs".
  std::optional<std::int64_t> count(std::string_view name) const;
  std::optional<double> measure(std::string_view name) const;
  std::optional<double> number(std::string_view name) const;  // a count, or else a measure
};

// The types of the parts that come with Lantern, in the order in which the facts tell them; what a
// program has of its own stands behind them, by name.
const std::vector<const PartType*>& part_order();

// Of time, bodies, nodes, pairs and textures; not of the counts of work.
std::uint64_t state_hash(const Frame& frame);

// About what the frame takes in memory, with its sides, by the lengths of its lists: the same on
// every machine.
std::size_t estimated_bytes(const Frame& frame);

// Of `lantern.frame`, as which the facts of a frame are told.
inline constexpr std::string_view kFactsVersion = "2";

// The frame as JSON, one line a body, node and pair.
std::string to_json(const Frame& frame);

// Does the frame meet expectations of its step? For each of them nothing if it does; otherwise what
// was expected and what was found.
std::vector<std::optional<std::string>> unmet(const std::vector<Expectation>& expectations,
                                              const Frame& frame);

// What step `step` (from 0) expects when it is done, then what always, in the order of the file and
// in a few signs each: "pairs = 0". What only one side expects begins with its name: "lazy: …".
std::vector<std::string> proofs_of(const Scenario& scenario, std::size_t step);

}  // namespace lantern::frame
