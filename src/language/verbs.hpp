// The script's verbs as values. How one is read from its keys stands in script/verbs_of_*.cpp, and
// what it does in run/verb_*.cpp. A new verb is a struct here, a place in the list below, and
// these two.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/vec.hpp"
#include "language/specs.hpp"

namespace lantern::language {

// What a scenario must have for a verb to work on.
enum class Basis { nothing, world, bodies, level, atlas };

// What each verb says of itself. One that passes time also has seconds_of(time_step): how much of
// it, at most.
struct VerbTraits {
  std::string_view name;
  Basis basis = Basis::world;
  bool passes_time = false;
  bool changes_bodies = false;  // which are there, where, how they move, or what moves them
  bool asks = false;            // the structure, of rays, views and regions
};

// Nothing happens; the caption speaks.
struct Show {
  static constexpr VerbTraits kTraits{.name = "show", .basis = Basis::nothing};
};

// Bodies and textures are indices into the scenario's lists.
struct Insert {
  static constexpr VerbTraits kTraits{.name = "insert", .changes_bodies = true};
  std::vector<std::size_t> bodies;
};

// One after another while time passes, the first at once.
struct Emit {
  static constexpr VerbTraits kTraits{.name = "emit", .changes_bodies = true};
  std::vector<std::size_t> bodies;
  std::uint64_t every = 1;  // world steps from one to the next
};

struct Remove {
  static constexpr VerbTraits kTraits{.name = "remove", .changes_bodies = true};
  std::vector<std::size_t> bodies;
};

struct Move {
  static constexpr VerbTraits kTraits{.name = "move", .changes_bodies = true};
  std::size_t body = 0;
  std::optional<Vec<3>> to;
  std::optional<Vec<3>> velocity;
  std::optional<double> turned;  // radians
  std::optional<double> spin;    // radians a second
  bool rebuild = true;           // false: the structure is left as it was
};

template <bool kAsleep>
struct Rest {
  static constexpr VerbTraits kTraits{.name = kAsleep ? "sleep" : "wake", .changes_bodies = true};
  std::vector<std::size_t> bodies;
};
using Sleep = Rest<true>;
using Wake = Rest<false>;

// From now on; a force of 0 ends it.
struct ApplyForce {
  static constexpr VerbTraits kTraits{.name = "force", .changes_bodies = true};
  std::size_t body = 0;
  Vec<3> force{0.0};
  Vec<3> at{0.0};
};

// N s, now.
struct ApplyImpulse {
  static constexpr VerbTraits kTraits{.name = "impulse", .changes_bodies = true};
  std::size_t body = 0;
  Vec<3> impulse{0.0};
  Vec<3> at{0.0};
};

struct Run {
  static constexpr VerbTraits kTraits{.name = "run", .passes_time = true};
  double seconds_of(double) const { return seconds; }
  double seconds = 0;
  int every = 0;  // steps from frame to frame; 0: the world's frame_every
};

// As Run, until something happens.
struct Wait {
  enum class Event { touch, part, asleep, crush };  // two bodies, but any number fall asleep
  static constexpr VerbTraits kTraits{.name = "wait", .passes_time = true};
  double seconds_of(double) const { return at_most; }
  Event event = Event::touch;
  std::vector<std::size_t> bodies;
  double at_most = 0;  // seconds; if it has not happened by then, the run fails
  int every = 0;
};
inline EnumNames names(Wait::Event) { return {"touch", "part", "asleep", "crush"}; }

// Looks at the step's first impact that `phases` may show.
inline constexpr std::size_t kMostLooks = 24;

// One world step, phase by phase.
struct Phases {
  static constexpr VerbTraits kTraits{
      .name = "phases", .basis = Basis::bodies, .passes_time = true};
  double seconds_of(double time_step) const { return time_step; }
};

// Contacts, from now on.
struct SolveBy {
  static constexpr VerbTraits kTraits{
      .name = "solve_by", .basis = Basis::bodies, .changes_bodies = true};
  ContactMethod contacts = ContactMethod::soft;
  int sub_steps = 0;         // 0: as it was
  int iterations = 0;        // the same
  double wanted_error = -1;  // below 0: as it was
};

// All bodies anew, with these settings.
struct Rebuild {
  static constexpr VerbTraits kTraits{.name = "rebuild", .basis = Basis::bodies};
  StructureSpec structure;
};

// Of bodies alone in a world of their own, in one step.
struct Compare {
  static constexpr VerbTraits kTraits{.name = "compare", .basis = Basis::bodies};
  std::vector<std::size_t> bodies;
  std::string row;
  std::vector<StructureKind> kinds;
  std::string verdict;  // with {count}; may be empty
};

// A sort and sweep finds its pairs: one frame for each body at whose beginning the sweep stands.
struct Sweep {
  static constexpr VerbTraits kTraits{.name = "sweep", .basis = Basis::bodies};
};

// The nearest hit, or all.
struct CastRay {
  static constexpr VerbTraits kTraits{.name = "ray", .basis = Basis::bodies, .asks = true};
  Vec<3> from{0.0};
  Vec<3> to{1, 0, 0};
  bool all = false;
};

// What does the camera see?
struct Cull {
  static constexpr VerbTraits kTraits{.name = "cull", .basis = Basis::bodies, .asks = true};
  Vec<3> eye{0.0};
  Vec<3> target{1, 0, 0};
  double angle = 60 * kDegree;  // of opening, in a 3D world from bottom to top
  double near = 0.1;
  double far = 10;  // both along the view
};

struct Query {
  static constexpr VerbTraits kTraits{.name = "query", .basis = Basis::bodies, .asks = true};
  Box<3> box;
  double radius = 0;  // above 0: a ball about the box's centre
};

// Which candidate pairs touch? All of them are tested by their shapes.
struct TestShapes {
  static constexpr VerbTraits kTraits{.name = "test_shapes", .basis = Basis::bodies};
};

// Which axis parts two bodies? The narrow phase's own test of them, axis by axis.
struct Separate {
  static constexpr VerbTraits kTraits{.name = "separate", .basis = Basis::bodies};
  std::size_t a = 0;
  std::size_t b = 0;
};

// How far are two bodies apart? By support points alone, step by step.
struct SearchDistance {
  static constexpr VerbTraits kTraits{.name = "gjk", .basis = Basis::bodies};
  std::size_t a = 0;
  std::size_t b = 0;
};

// What the structure is asked.
using Question = std::variant<CastRay, Cull, Query>;

// The BSP of the level.
struct CompileLevel {
  static constexpr VerbTraits kTraits{.name = "compile", .basis = Basis::level};
};

// In which sector?
struct Locate {
  static constexpr VerbTraits kTraits{.name = "locate", .basis = Basis::level};
  Vec<2> point{0.0};
};

// Sectors front to back.
struct OrderFrom {
  static constexpr VerbTraits kTraits{.name = "order", .basis = Basis::level};
  Vec<2> eye{0.0};
};

// Which sectors see which, found once; and what an eye may see.
struct See {
  static constexpr VerbTraits kTraits{.name = "see", .basis = Basis::level};
  std::optional<Vec<2>> eye;
};

// Textures, in this order.
struct Pack {
  static constexpr VerbTraits kTraits{.name = "pack", .basis = Basis::atlas};
  std::vector<std::size_t> textures;
  bool each = true;       // one frame a texture, or one for all
  std::string free_name;  // label of the largest free leaf it leaves
};

// Does any free leaf have room?
struct AskRoom {
  static constexpr VerbTraits kTraits{.name = "ask_room", .basis = Basis::atlas};
  int width = 0;
  int height = 0;
};

// The screen, element by element.
struct DrawScreen {
  enum class From { textures, atlas };
  enum class Order { as_listed, by_texture };
  static constexpr VerbTraits kTraits{.name = "draw", .basis = Basis::atlas};
  From from = From::textures;
  Order order = Order::as_listed;
};
inline EnumNames names(DrawScreen::From) { return {"textures", "atlas"}; }
inline EnumNames names(DrawScreen::Order) { return {"as_listed", "by_texture"}; }

// In the order of the reference page.
using Verb = std::variant<Show, Insert, Emit, Remove, Move, Sleep, Wake, ApplyForce, ApplyImpulse,
                          Run, Wait, Phases, SolveBy, Rebuild, Sweep, Compare, CastRay, Cull, Query,
                          TestShapes, Separate, SearchDistance, CompileLevel, Locate, OrderFrom,
                          See, Pack, AskRoom, DrawScreen>;

inline const VerbTraits& traits_of(const Verb& verb) {
  return std::visit([](const auto& v) -> const VerbTraits& { return v.kTraits; }, verb);
}

// The bodies that the verb lets in; null if none.
const std::vector<std::size_t>* entering(const Verb& verb);

// How much time it lets pass, at most.
double seconds_of(const Verb& verb, double time_step);

}  // namespace lantern::language
