// What a scenario has, as plain values, each with the place in the file it came from. A member's
// initial value is the default of the key that fills it (see key.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "geometry/flat.hpp"
#include "geometry/rotation.hpp"
#include "geometry/vec.hpp"
#include "language/display.hpp"
#include "physics/body.hpp"
#include "physics/methods.hpp"
#include "spatial/structure_kind.hpp"

namespace lantern::language {

// Which part of a 2D world is shown; without `at`, all of it.
struct ViewSpec {
  std::optional<Vec<3>> at;  // its middle
  double width = 0;
  SourcePosition where;
};

// From where a 3D world is seen.
struct CameraSpec {
  Vec<3> eye{0.0};
  Vec<3> target{0.0};
  SourcePosition where;
};

// What is lit: a body by its name, or a node by its label.
struct LitSpec {
  std::string name;
  SourcePosition where;
};

// A few words beside what they are about.
struct NoteSpec {
  std::string text;  // with {count}, as a caption
  NoteOf of = NoteOf::point;
  std::vector<std::size_t> bodies;  // one, or the two of a pair
  std::string name;                 // of the node or count
  Vec<3> point{0.0};
  std::string event;  // that it stands on; empty: all frames of the step
  SourcePosition where;
};

// Which function of the lecture's source a step is about, and which of its lines.
struct CodeSpec {
  std::string function;
  std::string line;  // each line with this text in it is lit; empty: none
  SourcePosition where;
};

enum class Brain { none, follow, wander };  // who steers a body

// What is legal in a scenario and surely not meant (see warnings.hpp): the first are found while it
// runs, the others stand in the file.
enum class Warning {
  view,        // a picture that shows no body
  outside,     // a body beyond the world's bounds
  contacts,    // contacts are off, and bodies fall into each other
  joints,      // a joint's ends part
  energy,      // grows, and nothing drives it
  through,     // a body is pushed through one that never moves
  crush,       // a body is pressed between two others, deeper than they hold
  expect,      // an expectation that cannot fail
  settings,    // of contacts, which there are not
  bodies,      // that never enter
  prototypes,  // that nobody is like
  letters,     // of a map's legend, that stand nowhere
  links,       // a spring or joint that is there twice
  needs,       // a scenario that is not there
  problem,     // whose answer is that of another problem
  paint,       // that stands out little
};
// A point has three coordinates; in a 2D world the third is 0.
struct WorldSpec {
  int dimension = 2;
  Box<3> bounds;                  // of the world and of the tree's root
  double time_step = 1.0 / 60.0;  // seconds
  int frame_every = 1;            // world steps from frame to frame of a run
  Vec<3> gravity{0.0};
  double gravitation = 0;  // Newton's constant between the bodies
  ContactMethod contacts = ContactMethod::none;
  Integrator integrator = Integrator::semi_implicit_euler;
  RotationMethod rotation = RotationMethod::exact;
  int sub_steps = 8;                   // of the soft contacts
  std::optional<double> wanted_error;  // of contacts, in units; none: nothing is measured
  int iterations = 10;                 // of the impulse contacts
  int impact_budget = 10'000;          // impacts located in one step of the world
  bool may_sleep = false;
  Vec<3> camera_eye{0.0};  // of a 3D world
  Vec<3> camera_target{0.0};
  bool has_camera = false;
  std::vector<std::vector<Vec<2>>> land;  // polygons of a flat world that are only drawn
  bool sea = true;                        // what is no land is
  std::vector<Warning> quiet;             // kinds of warning whose cause is meant
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
  Vec<3> normal{1, 0, 0};
  std::string at;  // "root", or the way down from it: "front", "front.back", ...
  SourcePosition where;
};

// Along which a sweep sorts: where centres vary most, or along one axis.
enum class SweepAxis { widest, x, y, z };

struct StructureSpec {
  StructureKind kind = StructureKind::none;
  std::uint32_t capacity = 2;
  std::uint32_t max_depth = 6;
  bool eager_children = false;  // all made at a split, else each when something enters it
  bool no_progress_stop = false;
  bool split_static = false;  // one structure for what never moves, one for what does
  double cell = 0;            // of a grid: side of the smallest cells; 0: what suits its bodies
  std::uint32_t levels = 1;   // of a grid
  bool open = false;          // of a grid
  double margin = 0;          // aabb_tree only
  Following following = Following::automatic;  // aabb_tree only
  SweepAxis axis = SweepAxis::widest;          // sort_and_sweep only
  bool as_printed = false;                     // lecture_quadtree only
  Vec<3> root{0.0};                            // lecture_quadtree only; 0: as large as the world
  std::vector<PlaneSpec> planes;               // bsp only; a plane's parent stands before it
  bool of_level = false;                       // bsp only: its planes are the compiled level's
  std::vector<std::uint32_t> sectors;  // of its nodes, in the order of visiting; kNone: inner ones
  std::string why;                     // the kind, if it was left to the bodies
  SourcePosition where;
};

struct BodySpec {
  std::string name;
  std::string label;  // what pictures call it; empty: its name
  Look look = Look::box;
  int color = 1;                           // body 1 ... 8 of the theme
  std::string paint;                       // "#rrggbb", in place of that colour; or empty
  std::shared_ptr<const Outline> outline;  // in place of the look; or null
  Shape<3> shape;
  Vec<3> position{0.0};
  Vec<3> velocity{0.0};
  double angle = 0;                 // radians, counter-clockwise, or about `axis`
  double spin = 0;                  // radians a second, the same way
  Vec<3> axis{0, 0, 1};             // unit; of a 3D world
  std::optional<Vec<3>> spin_axis;  // unit, in the world's axes; none: `axis`
  BodyKind kind = BodyKind::dynamic_body;
  double density = 1;
  double mass = 0;  // 0: from shape and density
  Material material;
  double linear_drag = 0;
  double angular_drag = 0;
  bool may_turn = true;
  bool has_volume = true;                  // else nothing meets it
  std::uint32_t address = 0;               // in the memory of the lecture's program; 0: none said
  bool asleep = false;                     // when it enters
  std::optional<Integrator> integrator;    // none: the world's
  std::optional<RotationMethod> rotation;  // none: the world's
  Brain brain = Brain::none;
  std::size_t follows = 0;  // the body that it follows
  Vec<3> brain_axes{1.0};   // 0 where it does not follow
  double brain_speed = 0;   // units a second at most
  SourcePosition where;

  const std::string& called() const { return label.empty() ? name : label; }
  const Vec<3>& axis_of_spin() const { return spin_axis ? *spin_axis : axis; }
};

// How a body is turned when it enters.
inline Rotation<3> orientation_of(const BodySpec& body) {
  return turned(Rotation<3>(), body.axis * body.angle);
}

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

// What a step measures on its frames: a length between two bodies' centres, or points.
struct RulerSpec {
  std::optional<std::size_t> a;  // none: from a point
  std::optional<std::size_t> b;
  Vec<3> from{0.0};
  Vec<3> to{0.0};
  bool change = false;  // compared with what it was when the step began
  std::string text;     // may be empty
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
  std::string x;                    // a count or measure, or "time"; empty for bars
  std::vector<std::string> y;       // counts and measures; of bars one
  std::vector<std::string> pieces;  // of bars: counts whose sum they show; may be empty
  std::vector<std::string> labels;  // of the lines or pieces; none: what `y` or they say
  bool logarithmic = false;         // but for time
  bool each_part = false;           // bars, and lines over time, begin anew with each part
  std::optional<double> least;      // of the y axis; none: what is there
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
  half_width,
  half_height,
  leaves,  // from here on it is counted
  pairs,
  depth,
  id,
  address,
  key,
};
inline bool is_counted(BodyMeasure what) { return what >= BodyMeasure::leaves; }

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
  linkage,
  heavy_top,
  bridge,
  springs_along_pins,
  ball_on_plate,
  rocking_block,
  dominoes,
  pile,
  standing,
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
  Picture picture = Picture::pattern;
  bool later = false;  // it does not wait before a step packs it
  SourcePosition where;
};

inline constexpr int kMostTrials = 18;  // all that the packer has, with turning

// How textures find leaves of an atlas (atlas/atlas.hpp, atlas/packer.hpp).
enum class AtlasRule { first_fit, best_texture };

struct AtlasSpec {
  int width = 0;
  int height = 0;
  AtlasRule rule = AtlasRule::first_fit;
  bool turn = false;
  int trials = kMostTrials;
  int screen_width = 0;  // 0: there is no screen
  int screen_height = 0;
  std::vector<Warning> quiet;  // kinds of warning whose cause is meant
  SourcePosition where;
};

// A texture's place on the screen: its upper left corner.
struct ElementSpec {
  std::size_t texture = 0;  // of the scenario's
  int x = 0;
  int y = 0;
};

template <class E>
EnumNames names_up_to(E last) {
  EnumNames all;
  for (int i = 0; i <= static_cast<int>(last); ++i) all.push_back(to_string(static_cast<E>(i)));
  return all;
}

inline EnumNames names(StructureKind) {
  EnumNames all = {to_string(StructureKind::none), to_string(StructureKind::automatic)};
  for (const StructureKind kind : known_structures()) all.push_back(to_string(kind));
  return all;
}
inline EnumNames names(AtlasRule) { return {"first_fit", "best_texture"}; }
inline EnumNames names(Following) { return {"auto", "reinsert", "refit"}; }
inline EnumNames names(SweepAxis) { return {"widest", "x", "y", "z"}; }
inline EnumNames names(Warning) {
  return {"view",     "outside", "contacts",   "joints",  "energy", "through", "crush",   "expect",
          "settings", "bodies",  "prototypes", "letters", "links",  "needs",   "problem", "paint"};
}
inline EnumNames names(LinkSpec::Kind) { return {"spring", "distance", "pin"}; }
inline EnumNames names(Solution) {
  return {"projectile",    "oscillator",     "chain",           "kepler",     "pendulum",
          "free_top",      "bouncing_ball",  "blocks_and_wall", "collisions", "billiards",
          "slide",         "slip_then_roll", "incline",         "topple",     "stack",
          "hanging_chain", "linkage",        "heavy_top",       "bridge",     "springs_along_pins",
          "ball_on_plate", "rocking_block",  "dominoes",        "pile",       "standing"};
}
inline EnumNames names(ProblemVariant) { return {"plain", "stiff", "extreme"}; }
inline EnumNames names(BodyKind) { return {"dynamic", "kinematic", "static"}; }
inline EnumNames names(ContactMethod) { return contact_method_names(); }
inline EnumNames names(Integrator) { return integrator_names(); }
inline EnumNames names(RotationMethod) { return names_up_to(RotationMethod::explicit_gyroscopic); }

inline std::string_view to_string(Solution s) { return names(s)[std::size_t(s)]; }
inline std::string_view to_string(ProblemVariant v) { return names(v)[std::size_t(v)]; }

}  // namespace lantern::language
