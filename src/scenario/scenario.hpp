// A scenario as plain values, each with the place in the file it came from. The language itself,
// its keys, ranges and texts, is in language.cpp; reading it is in parse.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "geometry/flat.hpp"
#include "physics/body.hpp"
#include "physics/contact_method.hpp"
#include "physics/motion_method.hpp"
#include "spatial/structure_kinds.hpp"

namespace lantern {

enum class Children { eager, lazy };  // all made at a split, or each when something enters it
enum class Panel { world, tree, atlas, chart, memory };
enum class Pace { step, event };
enum class Look { ghost, player, ball, bat, disc, box };
enum class Brain { none, follow, wander };  // who steers a body

// What is legal in a scenario and surely not meant; found while it runs (see warnings.hpp).
enum class Warning {
  view,      // a picture that shows no body
  outside,   // a body beyond the world's bounds
  contacts,  // contacts are off, and bodies fall into each other
  joints,    // a joint's ends part
  energy,    // grows, and nothing drives it
  through,   // a body is pushed through one that never moves
};
inline constexpr std::array<std::string_view, 6> kWarnings = {"view",   "outside", "contacts",
                                                              "joints", "energy",  "through"};

// A point has three coordinates; in a flat world the third is 0.
struct WorldSpec {
  int dimension = 2;
  Box<3> bounds;                  // of the world and of the tree's root
  double time_step = 1.0 / 60.0;  // seconds
  int frame_every = 1;            // world steps from frame to frame of a run
  Vec<3> gravity{0.0};
  double gravitation = 0;  // Newton's constant between the bodies
  ContactMethod contacts = ContactMethod::none;
  Integrator integrator = Integrator::semi_implicit_euler;
  RotationMethod rotation = RotationMethod::splitting_2;
  int sub_steps = 8;           // of the soft contacts
  int iterations = 10;         // of the impulse contacts
  int impact_budget = 10'000;  // impacts located in one step of the world
  bool may_sleep = false;
  bool show_boxes = false;  // broad-phase boxes are drawn
  bool show_velocities = false;
  bool show_depths = false;  // how deep bodies overlap stands beside their contacts
  Vec<3> camera_eye{0.0};    // of a solid world
  Vec<3> camera_target{0.0};
  bool has_camera = false;
  std::vector<Warning> quiet;  // kinds of warning whose cause is meant
  SourcePosition where;
  std::map<std::string_view, SourcePosition> keys;  // where those stand that the file gives

  // Of the first of these keys that the file gives; of the table if it gives none.
  const SourcePosition& place_of(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names)
      if (const auto found = keys.find(name); found != keys.end()) return found->second;
    return where;
  }
};

struct PlaneSpec {
  std::string name;
  Vec<3> point{0.0};
  Vec<3> normal{0.0};
  std::string at;  // "root", or the way down from it: "front", "front.back", ...
  SourcePosition where;
};

struct StructureSpec {
  StructureKind kind = StructureKind::none;
  std::uint32_t capacity = 2;
  std::uint32_t max_depth = 6;
  Children children = Children::lazy;
  bool no_progress_stop = false;
  bool split_static = false;      // one structure for what never moves, one for what does
  std::vector<PlaneSpec> planes;  // bsp only; a plane's parent stands before it
  SourcePosition where;
};

struct BodySpec {
  std::string name;
  Look look = Look::box;
  int color = 1;  // body 1 ... 8 of the theme
  Shape<3> shape;
  Vec<3> position{0.0};
  Vec<3> velocity{0.0};
  double angle = 0;      // radians, counter-clockwise, or about `axis`
  double spin = 0;       // radians a second, the same way
  Vec<3> axis{0, 0, 1};  // unit; of a solid world
  BodyKind kind = BodyKind::dynamic_body;
  double density = 1;
  double mass = 0;  // 0: from shape and density
  Material material;
  double linear_drag = 0;
  double angular_drag = 0;
  bool may_turn = true;
  bool asleep = false;                     // when it enters
  std::optional<Integrator> integrator;    // none: the world's
  std::optional<RotationMethod> rotation;  // none: the world's
  Brain brain = Brain::none;
  std::size_t follows = 0;  // the body that it follows
  Vec<3> brain_axes{1.0};   // 0 where it does not follow
  double brain_speed = 0;   // units a second at most
  SourcePosition where;
};

// A spring or joint between points of two bodies, or of a body and a point of the world. It is
// there while its bodies are.
struct LinkSpec {
  enum class Kind { spring, distance, pin };
  Kind kind = Kind::spring;
  std::size_t a = 0;
  std::optional<std::size_t> b;       // none: it is tied to the world
  Vec<3> at_a{0.0};                   // from the body's centre, in its own axes
  Vec<3> at_b{0.0};                   // the same, or a point of the world
  std::optional<double> rest_length;  // else as long as it is when it comes to be
  double stiffness = 0;               // of a spring
  double damping = 0;
  SourcePosition where;
};

struct LevelSpec {
  std::vector<std::vector<Vec<2>>> loops;  // closed polygons: the solid lies right of the way round
  double balance = 1;                      // weight of |front - back| in a line's score
  double cuts = 8;                         // weight of a wall cut in two
  bool first_wall = false;                 // take the first wall's line instead of the best
  SourcePosition where;
};

inline constexpr std::string_view kTimeAxis = "time";

struct ChartSpec {
  std::string x;                // a count or measure, or "time"; empty for bars
  std::vector<std::string> y;   // counts and measures; of bars one
  bool logarithmic = false;     // but for time
  bool each_part = false;       // over time: lines begin anew with each part
  std::optional<double> least;  // of the y axis; none: what is there
  std::optional<double> most;
  bool over_time() const { return x == kTimeAxis; }
  SourcePosition where;
};

// What is measured of one body, in the order of the language's list.
enum class BodyMeasure {
  energy,
  kinetic_energy,
  potential_energy,
  speed,
  spin,
  angular_momentum,
  own_spin_x,
  own_spin_y,
  own_spin_z,
  x,
  y,
  z,
  penetration,
};

struct BodyMeasureSpec {
  std::string name;  // as it is written: "energy.bob"
  BodyMeasure measure = BodyMeasure::energy;
  std::size_t body = 0;
};

// Whose answer is known in closed form.
enum class Solution {
  projectile,
  oscillator,
  chain,
  kepler,
  pendulum,
  free_top,
  bouncing_ball,
  blocks_and_wall,
  collisions,
  billiards,
  slide,
  slip_then_roll,
  incline,
  topple,
  stack,
  hanging_chain,
};
enum class ProblemVariant { plain, stiff, extreme };

// What `lantern measure` holds the scenario's runs against.
struct ProblemSpec {
  Solution solution = Solution::projectile;
  ProblemVariant variant = ProblemVariant::plain;
  double seconds = 1;
  std::uint32_t samples = 20;        // moments that are looked at, equally far apart
  double step = 1;                   // the largest, seconds
  int halvings = 7;                  // of the step, a run each
  std::vector<std::string> methods;  // names; empty for all that make a difference
  SourcePosition where;
};

struct TextureSpec {
  std::string name;
  int width = 0;
  int height = 0;
  int color = 1;
  SourcePosition where;
};

struct AtlasSpec {
  int width = 0;
  int height = 0;
  SourcePosition where;
};

// What must hold. Exactly one of the forms:
//   count, at_most, at_least   the count or measure `name` against `number`
//   leaves     body `name` is stored in `number` leaves
//   pairs      the candidate pairs are exactly these, by name
//   contacts   the pairs that touch are exactly these
//   hits       what the ray met, in order, or what the cull or query found, in any order
//   asleep, awake              all of `names` are
//   position, velocity         of body `name`, within `tolerance` on each axis
//   half_size  of the broad-phase box of body `name`
//   turned     body `name`, in radians; flat worlds only
//   measure    a measured number, within `tolerance`
struct Expectation {
  enum class Kind {
    count,
    at_most,
    at_least,
    leaves,
    pairs,
    contacts,
    hits,
    asleep,
    awake,
    position,
    velocity,
    half_size,
    turned,
    measure,
  };
  Kind kind = Kind::count;
  std::string name;
  double number = 0;
  std::vector<std::pair<std::string, std::string>> pairs;
  std::vector<std::string> names;
  Vec<3> position{0.0};
  double tolerance = 1e-9;
  SourcePosition where;
};

// The script's verbs. Bodies and textures are indices into the scenario's lists.
struct Show {};  // nothing happens; the caption speaks
struct Insert {
  std::vector<std::size_t> bodies;
};  // enter world and structure
struct Remove {
  std::vector<std::size_t> bodies;
};             // leave both; the structure is rebuilt
struct Move {  // set anew; the structure is rebuilt
  std::size_t body = 0;
  std::optional<Vec<3>> to;
  std::optional<Vec<3>> velocity;
  std::optional<double> turned;  // radians
  std::optional<double> spin;    // radians a second
  bool rebuild = true;           // false: the structure is left as it was
};
struct Run {  // a frame every `frame_every` steps
  double seconds = 0;
  int every = 0;  // instead of the world's frame_every; 0: that
};
struct Wait {                                // as Run, until something happens
  enum class Event { touch, part, asleep };  // two bodies; two bodies; all of them
  Event event = Event::touch;
  std::vector<std::size_t> bodies;
  double at_most = 0;  // seconds; if it has not happened by then, the run fails
  int every = 0;
};
struct Phases {};  // one world step, phase by phase
struct SolveBy {   // contacts, from now on
  ContactMethod contacts = ContactMethod::soft;
  int sub_steps = 0;   // 0: as it was
  int iterations = 0;  // the same
};
struct Rebuild {
  StructureSpec structure;
};  // all bodies anew, with these settings
struct ApplyForce {
  std::size_t body = 0;
  Vec<3> force{0.0};
  Vec<3> at{0.0};
};  // from now on; 0 ends it
struct ApplyImpulse {
  std::size_t body = 0;
  Vec<3> impulse{0.0};
  Vec<3> at{0.0};
};  // N s, now
struct Sleep {
  std::vector<std::size_t> bodies;
};
struct Wake {
  std::vector<std::size_t> bodies;
};
struct CastRay {
  Vec<3> from{0.0};
  Vec<3> to{0.0};
  bool all = false;
};             // nearest hit, or all
struct Cull {  // what does the camera see?
  Vec<3> eye{0.0};
  Vec<3> target{0.0};
  double angle = 1;  // radians of opening, in a solid world from bottom to top
  double near = 0.1;
  double far = 10;  // both along the view
};
struct Query {
  Box<3> box;
  double radius = 0;
};                       // radius > 0: a ball about its centre
struct CompileLevel {};  // the BSP of the level
struct Locate {
  Vec<2> point{0.0};
};  // in which sector?
struct OrderFrom {
  Vec<2> eye{0.0};
};             // sectors front to back
struct Pack {  // textures in this order
  std::vector<std::size_t> textures;
  bool each = true;       // one frame a texture, or one for all
  std::string free_name;  // label of the largest free leaf it leaves
};
struct AskRoom {
  int width = 0;
  int height = 0;
};  // does any free leaf have room?

using Verb = std::variant<Show, Insert, Remove, Move, Run, Wait, Phases, Rebuild, ApplyForce,
                          ApplyImpulse, Sleep, Wake, SolveBy, CastRay, Cull, Query, CompileLevel,
                          Locate, OrderFrom, Pack, AskRoom>;

struct Step {
  Verb verb;
  std::string name;                 // for --at; may be empty
  std::string part;                 // from here on shown behind the title; may be empty
  std::string caption;              // with {count} and {count:noun}; may be empty
  std::optional<std::string> plot;  // adds a point to the chart, or a bar of this label
  std::optional<Pace> pace;         // of this step alone
  std::vector<std::string> events;  // in event pace, only these give frames; empty for all
  std::vector<Expectation> expect;  // after the step
  std::vector<Expectation> always;  // on every frame of the step
  SourcePosition where;
};

// All that a file says. Each value has its type, but nothing is known to be right: a name may be
// that of nobody, an index may lie beyond its list. Only diagnostics can be made of it.
struct ScenarioSpec {
  std::string name;  // [a-z0-9_]+, from the file's name unless given; names files and folders
  std::string file;  // as it was given
  std::string title;
  std::string source;  // the part of the lecture it shows
  std::uint64_t seed = 1;
  Pace pace = Pace::step;
  std::vector<Panel> panels;  // as wished, or all that can show something
  WorldSpec world;
  StructureSpec structure;
  std::optional<LevelSpec> level;
  std::optional<ChartSpec> chart;
  std::optional<AtlasSpec> atlas;
  std::optional<ProblemSpec> problem;
  std::vector<BodySpec> bodies;  // patterns unrolled
  std::vector<LinkSpec> links;
  std::vector<BodyMeasureSpec> body_measures;  // that chart, promises and captions ask for
  std::vector<TextureSpec> textures;
  std::vector<Step> steps;
  std::uint64_t text_hash = 0;    // of the file's bytes
  std::string text;               // the file's bytes, for diagnostics of the run
  std::uint64_t most_frames = 0;  // in step pace; a step that waits may give fewer
  std::uint64_t world_steps = 0;  // at most, for the same reason
};

// One that is right, and the only one that can be walked, explained, run or drawn: whatever is named
// is there.
class Scenario : public ScenarioSpec {
 public:
  // The parser has found no mistake, or code has made the spec and vouches for it: an index beyond
  // its list is a broken invariant.
  explicit Scenario(ScenarioSpec spec);
};

// Throws ScenarioError with every mistake found, IoError if the file cannot be read.
Scenario load_scenario(const std::string& path);

// The same from text; `path` gives the name and is shown in messages. Never touches the disk.
Scenario parse_scenario(std::string_view text, const std::string& path);

// The line of `scenario.text` at `where`, and a diagnostic made of both.
Diagnostic diagnose(const Scenario& scenario, const SourcePosition& where, std::string message,
                    std::string suggestion = {});

std::string_view to_string(Children children);
std::string_view to_string(Solution solution);
std::string_view to_string(ProblemVariant variant);

}  // namespace lantern
