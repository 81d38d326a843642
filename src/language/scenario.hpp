// A scenario as plain values: what there is (specs.hpp), what happens, and what must hold
// meanwhile. How a verb is read from its keys stands in script/verbs_of_*.cpp, and what it does in
// run/verb_*.cpp. A new one is a struct here, a place in the list below, and these two.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/words.hpp"
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
  enum class Event { touch, part, asleep, crush, enter, leave };
  static constexpr VerbTraits kTraits{.name = "wait", .passes_time = true};
  double seconds_of(double) const { return at_most; }
  bool for_node() const { return event == Event::enter || event == Event::leave; }
  Event event = Event::touch;
  // All of them fall asleep; one of them enters a node, or touches one of the others.
  std::vector<std::size_t> bodies, others;
  std::vector<std::string> named;  // as they are written
  std::string node;                // its label
  double at_most = 0;              // seconds; if it has not happened by then, the run fails
  int every = 0;
};
inline EnumNames names(Wait::Event) {
  return {"touch", "part", "asleep", "crush", "enter", "leave"};
}

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
  int sub_steps = 0;                   // 0: as it was
  int iterations = 0;                  // the same
  std::optional<double> wanted_error;  // none: as it was
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
  std::string verdict;                               // with {count}; may be empty
  std::vector<std::pair<StructureKind, int>> times;  // microseconds a step; may be empty
  std::string machine;                               // on which they were measured
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

// What must hold. Exactly one of the forms:
//   count, at_most, at_least   the count or measure `name` against `number`
//   leaves     body `name` is stored in `number` leaves
//   pairs      the candidate pairs are exactly these, by name
//   contacts   the pairs that touch are exactly these
//   hits       what the ray met, in order, or what the cull or query found, in any order
//   asleep, awake              all of `names` are
//   position, velocity         of body `name`, within `tolerance` on each axis
//   half_size  of the broad-phase box of body `name`
//   turned     body `name`, in radians; 2D worlds only
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
    build_work,
    step_work,
    fewest,
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

struct Step {
  Verb verb;
  std::string name;                 // for --at; may be empty
  std::string part;                 // from here on shown behind the title; may be empty
  std::string caption;              // with {count} and {count:noun}; may be empty
  std::string after;                // in its place on the step's last frame; or empty
  std::string speaker_notes;        // for whoever speaks, never drawn; may be empty
  std::string question;             // for the students, after the sequence; or empty
  std::string answer;               // to it, as this step's last frame shows; it may quote counts
  std::string predict;              // a count to be guessed before the answer is shown; or empty
  std::optional<std::string> plot;  // adds a point to the chart, or a bar of this label
  std::optional<Pace> pace;         // of this step alone
  std::vector<std::string> events;  // in event pace, only these give frames; empty for all
  std::vector<Expectation> expect;  // after the step
  std::vector<Expectation> always;  // on every frame of the step
  std::optional<Display> display;   // of this step alone; none: the scenario's
  std::optional<ViewSpec> view;     // from here on, as is the camera; none: as before
  std::optional<CameraSpec> camera;
  double orbit = 0;             // radians that the camera goes round its target meanwhile
  std::vector<NoteSpec> notes;  // on all frames of the step
  std::optional<std::vector<LitSpec>> lit;  // on the step's own frames; none: what the step does
  std::vector<std::string> headline;  // counts and measures put in front from here on; or empty
  std::vector<Panel> panels;          // of the scenario's, shown from here on; or empty
  std::vector<RulerSpec> rulers;      // on every frame of the step
  std::optional<CodeSpec> code;       // from here on; none: as before, with no line lit
  bool ending = false;                // its last frame is the sequence's take-away
  int repeat = 1;                     // so many such steps were made of it
  SourcePosition where;

  const std::string& words(bool last) const { return last && !after.empty() ? after : caption; }
};

class Scenario;

// What stands in the file, is legal and surely not meant.
struct Noticed {
  Warning kind = Warning::expect;
  SourcePosition where;
  std::string message;
  std::string suggestion;
};

// All that a file says. Each value has its type, but nothing is known to be right: a name may be
// that of nobody, an index may lie beyond its list. Only diagnostics can be made of it.
struct ScenarioSpec {
  std::string name;        // [a-z0-9_]+, from the file's name unless given; names files and folders
  std::string file_stem;   // from which the name was made, where it could not be taken as it is
  std::string file;        // as it was given
  std::string language;    // of its frames' fixed words, "de"; empty: English
  std::string words_file;  // a table of them, beside this file; may be empty
  std::shared_ptr<const WordTable> words;  // in which they are said; null: in English
  std::string title;
  std::string source;                    // the part of the lecture it shows
  std::string idea;                      // the one that it is about, in a line; may be empty
  std::optional<std::uint32_t> lecture;  // its place in the order in which one would teach
  std::vector<std::string> needs;        // names of scenarios to be seen before
  std::vector<SourcePosition> needs_at;  // where each of these is written
  std::uint64_t seed = 1;
  Pace pace = Pace::step;
  std::vector<Panel> panels;  // as wished, or all that can show something
  Display display;
  std::vector<std::string> headline;  // counts and measures that the foot puts in front
  WorldSpec world;
  StructureSpec structure;
  std::optional<LevelSpec> level;
  std::optional<ChartSpec> chart;
  std::optional<AtlasSpec> atlas;
  std::optional<ProblemSpec> problem;
  std::vector<BodySpec> bodies;   // patterns unrolled
  std::vector<BodyPaint> paints;  // that some of them have
  std::vector<LinkSpec> links;
  std::vector<BodyMeasureSpec> body_measures;  // that chart, expectations and captions ask for
  std::vector<TextureSpec> textures;
  std::vector<ElementSpec> elements;  // of the atlas's screen, from the back to the front
  std::vector<Step> steps;
  std::uint64_t text_hash = 0;    // of the file's bytes
  std::string text;               // the file's bytes, for diagnostics of the run
  std::uint64_t most_frames = 0;  // in step pace; a step that waits may give fewer
  std::uint64_t world_steps = 0;  // at most, for the same reason; of all sides together

  // The same script under other settings, one clock for all; mostly none. The members above, but
  // for the chart, are then those of the first.
  std::vector<std::shared_ptr<const Scenario>> sides;
  std::string side;  // of a side itself: its name, and what stands over it
  std::string side_title;

  std::vector<Noticed> noticed;       // but for what is meant; of all sides together
  bool is_quiet(Warning kind) const;  // what such a warning would tell is meant

  bool has_world() const { return world.where.line > 0; }  // a [world] in its file
  bool has_joints() const;                                 // links that are no springs
  bool has_contacts() const { return world.contacts != ContactMethod::none; }
  bool has_forces() const;  // gravity, gravitation, springs or joints
  bool has_physics() const { return has_contacts() || has_forces(); }  // more than free flight
  bool tells_sleepers() const;  // bodies may rest: those that do are told from those that do not
  bool has_body_of(BodyKind kind) const;
  bool shows_trails() const;  // on any frame
  // In which a text of its own is filled in, translated or not; null: in English.
  const WordTable* words_of(const std::string& own) const;
  // Of the whole script: the first that stands, and those that are rebuilt.
  std::vector<const StructureSpec*> structures() const;
};

// One that is right, and the only one that can be walked, explained, run or drawn: whatever is
// named is there.
class Scenario : public ScenarioSpec {
 public:
  // The parser has found no mistake, or code has made the spec and vouches for it: an index beyond
  // its list is a broken invariant.
  explicit Scenario(ScenarioSpec spec);
};

// What standard input is called as a file, in messages and facts.
inline constexpr std::string_view kStandardInput = "<stdin>";

// Throws ScenarioError with every mistake found, IoError if the file cannot be read. "-" is
// standard input; without a name of its own, the scenario from there is called `stdin`.
Scenario load_scenario(const std::string& path);

// Of a file of a folder, what must be known before it is read as a scenario.
struct Glance {
  bool is_scenario = true;  // false: sound TOML that has no key of a scenario
  std::string name;         // as in the file, or else the file's own; may be no legal one
  std::optional<std::uint32_t> lecture;  // as in the file, if it is a whole number
};
// Whatever cannot be read counts as a scenario: reading it as one tells what is wrong.
Glance glance_at(const std::string& path);

// The same from text; `path` gives the name and is shown in messages. Never touches the disk.
Scenario parse_scenario(std::string_view text, const std::string& path);

// What ends a warning's suggestion: "; if this is intended, add quiet = ["bodies"] to [world]".
std::string if_meant(const ScenarioSpec& scenario, Warning kind);

// The line of `scenario.text` at `where`, and a diagnostic made of both.
Diagnostic diagnose(const Scenario& scenario, const SourcePosition& where, std::string message,
                    std::string suggestion = {});

// 1 to 64 of a–z, 0–9 and _: never a path. A name that was read from a file, which anybody may have
// written, becomes a file's name only as this; and only of() makes one.
class ScenarioName {
 public:
  // Nothing for a text that is no such name.
  static std::optional<ScenarioName> of(std::string_view text);

  const std::string& text() const { return text_; }
  bool operator==(const ScenarioName&) const = default;

 private:
  explicit ScenarioName(std::string_view text) : text_(text) {}

  std::string text_;
};

// Of a scenario that was read: the language sees to it.
ScenarioName name_of(const Scenario& scenario);

}  // namespace lantern::language
