// One picture's worth of facts, as plain values from the engine. All that is drawn or written as
// JSON is here; nothing of it is computed by whoever draws.
#pragma once

#include <algorithm>
#include <any>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "frame/body_state.hpp"
#include "geometry/flat.hpp"
#include "geometry/plane.hpp"
#include "language/code_text.hpp"
#include "language/display.hpp"
#include "physics/world_config.hpp"
#include "spatial/structure.hpp"

namespace lantern {
class Hash;
class JsonWriter;
}  // namespace lantern

namespace lantern::language {
struct Expectation;
class Scenario;
}  // namespace lantern::language

namespace lantern::frame {

// The parts of a frame: what some pictures have and others do not (frame/parts/). A part is a plain
// struct whose members are told once, in its list of fields (part_fields.hpp); all else follows
// from that list.

// What is known of all parts of one type.
struct PartType {
  std::string_view name;
  // Members of the object that is open; points have as many numbers as the world has dimensions.
  void (*write)(const std::any& part, int dimension, JsonWriter& json);
  std::size_t (*bytes)(const std::any& part);  // what its lists take
  void (*add_state)(const std::any& part, Hash& hash);
};

// Of P: where its list of fields is, `template const PartType& part_type<P>();` makes it.
template <class P>
const PartType& part_type();

// At most one part of each type. Copies are whole copies.
class FrameParts {
 public:
  // The part of that type: null, or an empty one, if there is none.
  template <class P>
  const P* find() const {
    const auto at = std::ranges::find(parts_, &part_type<P>(), &List::value_type::first);
    return at == parts_.end() ? nullptr : &std::any_cast<const P&>(at->second);
  }
  template <class P>
  P* find() {
    return const_cast<P*>(std::as_const(*this).find<P>());
  }
  template <class P>
  const P& get() const {
    static const P kNothing{};
    const P* found = find<P>();
    return found ? *found : kNothing;
  }
  // The part that is there, or else a new one.
  template <class P>
  P& add() {
    if (P* part = find<P>()) return *part;
    return std::any_cast<P&>(parts_.emplace_back(&part_type<P>(), P()).second);
  }
  // This one from now on, or none.
  template <class P>
  void put(const std::optional<P>& one) {
    one ? void(add<P>() = *one) : drop<P>();
  }
  template <class P>
  void drop() {
    std::erase_if(parts_, [](const auto& part) { return part.first == &part_type<P>(); });
  }
  // f(type, part) for each.
  template <class F>
  void each_part(const F& f) const {
    for (const auto& [type, part] : parts_) f(*type, part);
  }

 private:
  using List = std::vector<std::pair<const PartType*, std::any>>;
  List parts_;
};

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

  static auto fields(auto& r, auto&& v) {
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
  std::string label = {};  // what pictures call it; empty: its name
  Look look = Look::box;
  int color = 1;
  std::shared_ptr<const Outline> outline;  // instead of the look; or null
  Shape<3> shape;
  Box<3> box;                        // the smallest one around it
  std::optional<Box<3>> stored_box;  // that the structure holds: with contacts enlarged by how far
                                     // it may come in the next step; of a tree that was not
                                     // rebuilt, the old one
  std::vector<FrameStop> trail;      // where it has been, the oldest first, if frames show it
  std::optional<FramePlace> ahead;   // after the step that is about to be taken, if nothing is met
  bool is_static = false;
  bool asleep = false;
  bool has_volume = true;     // else nothing meets it
  std::uint64_t address = 0;  // in the memory of the lecture's program
  bool lit = false;           // the step is about it
  bool dimmed = false;        // the step has ruled it out: culled, or not met by the ray
  bool refused = false;       // a ray, view or region has tested it in vain

  const std::string& called() const { return label.empty() ? name : label; }
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

    static auto fields(auto& r, auto&& v) {
      return v("position", r.position)("separation", r.separation)("impulse", r.impulse);
    }
  };
  Pair pair;
  Vec<3> normal{0.0};  // unit, from a to b
  std::vector<Point> points = {};
  bool begins = false;   // they did not touch a step before
  bool crushes = false;  // one of them, against a third

  static auto fields(auto& r, auto&& v) {
    return v("pair", r.pair)("normal", r.normal)("points", r.points)("begins", r.begins)("crushes",
                                                                                         r.crushes);
  }
};

// The length between two points, measured.
struct FrameRuler {
  Vec<3> from{0.0};
  Vec<3> to{0.0};
  double length = 0;
  std::optional<double> before;  // what it is compared with: as long as it was when the step began
  std::string text;              // what is measured; may be empty

  static auto fields(auto& r, auto&& v) {
    return v("from", r.from)("to", r.to)("length", r.length)("before", r.before).drawn(r.text);
  }
};

struct FrameRulers {
  static constexpr std::string_view kName = "rulers";
  std::vector<FrameRuler> rulers;

  static decltype(auto) fields(const auto& r, auto&& v) { return v("rulers", r.rulers); }
};

// Perspective, y up.
struct Camera {
  Vec<3> eye{0.0};
  Vec<3> target{0.0};
  double field_of_view = 0.7;  // radians, from bottom to top
  bool goes_round = false;     // on some frame of the scenario: the picture fits all directions

  static auto fields(auto& r, auto&& v) {
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
  std::string answer;   // counts filled in
  std::string predict;  // a count that is to be guessed before; may be empty

  static auto fields(auto& r, auto&& v) {
    return v("asked", r.asked)("answer", r.answer).when(!r.predict.empty(), "predict", r.predict);
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

  static auto fields(auto& r, auto&& v) {
    return v.drawn(r.settings, r.capacity, r.grid_levels, r.hashed, r.swept_to, r.sweep_axis,
                   r.pool_size, r.array_size, r.may_sleep);
  }
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
  std::map<std::string, std::string> words;  // of those that have their own: "leaf/leaves"
  bool ending = false;                       // the take-away of the sequence
  std::vector<Panel> panels;
  Box<3> bounds;
  Display display;
};

// What every picture has, and the parts that some have.
struct Frame : FramePage, FrameParts {
  std::uint32_t index = 0;  // of this frame, from 0
  std::string event;        // the step's name or the algorithm's event; for --at
  std::string step_name;    // the step's name in either case; for --at, too
  StepPhase phase = StepPhase::whole;
  double time = 0;                // seconds of world time
  std::string caption;            // counts filled in
  std::vector<std::string> told;  // the counts and measures that the caption quotes, in order
  StructureKind structure = StructureKind::none;
  bool as_printed = false;       // the structure makes the mistakes of the lecture's text
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

  // The same moment under each side's settings. What the sides share stands above, their bodies,
  // nodes, counts and all else that they have of their own only here.
  std::vector<Frame> sides;

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

// Of each body that is in a leaf: in how many, and how deep the deepest lies.
struct Stored {
  std::uint64_t leaves = 0;
  std::uint32_t depth = 0;
};
std::unordered_map<BodyId, Stored> stored_bodies(const Frame& frame);

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

// An expectation in a few signs, "pairs = 0", of a single side "lazy: pairs = 0", and its place.
struct Proof {
  std::string text;
  SourcePosition where;
};
// What step `step` (from 0) expects when it is done, then what always, in the order of the file.
std::vector<Proof> proofs_of(const Scenario& scenario, std::size_t step);

}  // namespace lantern::frame
