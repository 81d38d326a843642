// A scenario as plain values: what there is (specs.hpp), what happens (verbs.hpp), and what must
// hold meanwhile.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "language/specs.hpp"
#include "language/verbs.hpp"

namespace lantern::language {

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
  std::string speaker_notes;        // for whoever speaks, never drawn; may be empty
  std::string question;             // for the students, after the sequence; or empty
  std::string answer;               // to it, as this step's last frame shows; it may quote counts
  std::optional<std::string> plot;  // adds a point to the chart, or a bar of this label
  std::optional<Pace> pace;         // of this step alone
  std::vector<std::string> events;  // in event pace, only these give frames; empty for all
  std::vector<Expectation> expect;  // after the step
  std::vector<Expectation> always;  // on every frame of the step
  std::optional<Display> display;   // of this step alone; none: the scenario's
  std::optional<ViewSpec> view;     // from here on, as is the camera; none: as before
  std::optional<CameraSpec> camera;
  double orbit = 0;                   // radians that the camera goes round its target meanwhile
  std::vector<NoteSpec> notes;        // on all frames of the step
  std::vector<std::string> headline;  // counts and measures put in front from here on; or empty
  std::vector<RulerSpec> rulers;      // on every frame of the step
  std::optional<CodeSpec> code;       // from here on; none: as before, with no line lit
  bool ending = false;                // its last frame is the sequence's take-away
  SourcePosition where;
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
  std::string name;       // [a-z0-9_]+, from the file's name unless given; names files and folders
  std::string file_stem;  // from which the name was made, where it could not be taken as it is
  std::string file;       // as it was given
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
  std::vector<BodySpec> bodies;  // patterns unrolled
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
