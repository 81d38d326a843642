// A scenario while it is being read, and may be wrong: what the parts of the parser share.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "language/keys/table_reader.hpp"
#include "language/scenario.hpp"

namespace lantern::language {

inline constexpr const char* kNothingTouches = "in this world nothing touches";
inline constexpr const char* kGiveContacts = "give [world] contacts = \"impulse\" or \"soft\"";
inline constexpr const char* kNothingSleeps = "in this world nothing sleeps";
inline constexpr const char* kGiveSleep = "give [world] may_sleep = true";

// Bodies or textures by name: one, or all of a pattern.
struct NamedRange {
  std::size_t first = 0;
  std::size_t count = 1;
  Place where;
};

class Names {
 public:
  // Adds a problem and gives false if the name is taken. Names of a pattern's members are not
  // `declared`: they are known, but never suggested.
  bool add(const std::string& name, const NamedRange& range, bool declared, Problems& problems);

  const NamedRange* find(const std::string& name) const;
  std::vector<std::string_view> declared() const { return {declared_.begin(), declared_.end()}; }
  bool empty() const { return declared_.empty(); }

 private:
  std::unordered_map<std::string, NamedRange> ranges_;
  std::vector<std::string> declared_;
};

// Bodies from `first` on that follow one that may be declared later.
struct Follower {
  std::size_t first = 0;
  std::size_t count = 1;
  Named followed;
};

// Named sets of a body's keys, each with those of the prototype that it is like itself.
class Prototypes {
 public:
  void add(const std::string& name, TomlTable keys) { keys_.emplace(name, std::move(keys)); }
  const TomlTable* find(const std::string& name) const;
  std::vector<std::string_view> names() const;

 private:
  std::map<std::string, TomlTable> keys_;
};

class ScriptPast;

struct Draft {
  ScenarioSpec scenario;
  Problems problems;
  std::string_view text;  // of the file, without a byte order mark
  bool has_world = false;
  int dimension = 0;  // of the world; 0 while it is not known, so that no other mistake follows
  Names bodies;
  Names textures;
  Prototypes prototypes;
  std::deque<TomlValue> made;  // tables that stand so in no file; problems may refer to them
  std::vector<Follower> followers;
  std::vector<std::string> sides;  // all sides' names, of which the scenario is one; mostly none

  SourcePosition position(Place where) const { return {scenario.file, where.line, where.column}; }

  // Are `all` things, called `nouns`, no more than `most`? Else says so at `where`.
  bool has_room_for(std::size_t all, std::size_t most, const char* nouns, Place where);

  // What stands there is legal and surely not meant. Nothing is noted if the file says it is.
  void notice(Warning kind, SourcePosition where, std::string message,
              const std::string& suggestion);
};

// A body's `outline`; null if there is none, or a bad one.
std::shared_ptr<const Outline> read_outline(const TableReader& table);
// Gives each paint a colour that no other body has, and notices one that stands out little.
void mix_paints(Draft& draft);

// A table within the file, whose points have as many numbers as the world has dimensions.
inline TableReader open(const TomlValue& value, const TableDoc& doc, Draft& draft,
                        std::string_view called = {}) {
  return TableReader(std::get<TomlTable>(value.data), value.where, doc, draft.problems,
                     draft.dimension, called);
}

// Calls f(table, spec) for each table of the key, with what its keys fill of a Spec, and its place.
template <class Spec, class F>
void for_each(const TableReader& from, std::string_view key, Draft& draft, F&& f,
              std::string_view called = {}) {
  for (const TomlValue* value : from.tables(key)) {
    const TableReader table = open(*value, language_table(from.doc().find(key)->of), draft, called);
    Spec spec;
    table.fill(spec);
    if constexpr (requires { spec.where; }) spec.where = draft.position(value->where);
    f(table, spec);
  }
}

// True, and a problem at the key, if the integrator knows forces of places alone and something else
// `acts`.
bool check_knows(const TableReader& table, std::string_view key, Integrator by, bool acts,
                 std::string_view what);

// Each reads its part of the file into the draft, in this order.
using ReadPart = void(const TableReader& file, Draft& draft);
ReadPart read_world, read_display, read_bodies, read_links, read_level, read_chart, read_problem,
    read_atlas, read_script;

// Notices what the file says for nothing. It must have been read without a mistake.
void notice_idle(const TableReader& file, Draft& draft);
// The same of an `expect` or `always` in which nothing stands, of no side either: of the file
// before it is read for each side.
void notice_empty_expectations(const TomlTable& file, Draft& draft);
// What was noticed of the file when it was read for each side, each thing once.
std::vector<Noticed> noticed_on(const std::vector<std::shared_ptr<const Scenario>>& sides);

// The [structure] of the file; read_world calls it.
void read_structures(const TableReader& file, Draft& draft);

// The structure keys of a table, upon `base`: what is not given stays.
StructureSpec read_structure(const TableReader& table, const StructureSpec& base, Draft& draft);

// Settings of [structure] are refused that no structure of the script has, and cells of which there
// are too many.
void check_structures(const TableReader& file, Draft& draft);

// The [[prototype]]s of the file, into the draft.
void read_prototypes(const TableReader& file, Draft& draft);

// `own` and those keys of the prototype that it does not stand against: 'radius' against
// 'half_size', say. Each keeps its place in the file.
TomlTable with_prototype(TomlTable own, const TomlTable& prototype);

// The table with the keys of the prototype that it is `like`, or itself if it is like none.
const TomlValue& completed(const TomlValue& table, Draft& draft);

// A body of these keys, whose name, unless it was made for it, may be suggested.
void read_body(const TomlValue& value, Draft& draft, bool declared = true);

// The [map] of the file.
void read_map(const TableReader& file, Draft& draft);

// What [[body]] and [[pattern]] share: all but what only one of them has, or who is followed.
BodySpec read_body_keys(const TableReader& table, Draft& draft);
// Adds a problem if `key` makes a body move that is static or has no size.
void check_motion(const TableReader& table, const char* key, const BodySpec& body, bool moves);
void read_pattern(const TomlValue& value, Draft& draft);

// The next `count` bodies follow whom the table says, who may be declared later; then they are
// found.
void note_follower(const TableReader& table, std::size_t count, Draft& draft);
void find_the_followed(Draft& draft);

// Exactly one body of that name. Adds a problem and gives nothing for an unknown name or a pattern.
std::optional<std::size_t> one_body(const Named& name, Draft& draft);

// The same of the name that a key gives, if it does.
inline std::optional<std::size_t> body_at(const TableReader& table, std::string_view key,
                                          Draft& draft) {
  const auto name = table.named(key);
  return name ? one_body(*name, draft) : std::nullopt;
}

// Each name, but of a range, as "b1..b9", all that it stands for. Adds a problem for one that is
// none, and leaves it out.
std::vector<Named> without_ranges(const std::vector<Named>& written, const Names& names,
                                  std::string_view kind, Problems& problems);

// Notes that the scenario asks for it, so that every frame measures it. Adds a problem, and gives
// nothing, if there is no such measure or body, if this world cannot have it, or what is counted is
// not there by now (if it is known how far the script is), or if there are too many.
std::optional<BodyMeasure> note_body_measure(const Named& name, Draft& draft,
                                             const ScriptPast* past = nullptr);

// Shared by bodies and textures: which colour the `index`-th has, when 0 cycles through all.
int cycled_color(std::int64_t color, std::size_t index);

// Of a pattern without one of its own: from the scenario's seed and the pattern's name.
std::uint64_t derived_seed(const TableReader& table, const std::string& name, const Draft& draft);

// In place of each structure that leaves its kind to the bodies, the one that
// spatial::choose_structure takes for all bodies as the file places them, and why. Without a world
// nothing happens.
void choose_structures(Draft& draft);

// What a file says to one of its sides: a scenario file without sides.
struct SideFile {
  std::string name;
  std::string title;
  TomlTable table;  // its own
  TomlTable file;
};

// In the order in which they stand; `file` has a "side". Adds a problem for each mistake in the
// [[side]] tables; those in what they override are left to whoever reads the files.
std::vector<SideFile> files_of_sides(const TomlTable& file, Problems& problems);

// The chart of all sides together, of a file that is right: a name without a side stands for that
// of each.
ChartSpec chart_of_sides(const TomlTable& file, const ChartSpec& of_one,
                         const std::vector<std::string>& sides);

// The side that a name begins with, as "eager" of "eager.pairs"; empty if there is none of it.
std::string_view side_of(std::string_view name, const std::vector<std::string>& sides);
// And the name without it.
std::string_view within_side(std::string_view name, const std::vector<std::string>& sides);

// May a side override this key of a table?
bool may_differ(std::string_view table, std::string_view key);

// Throws ScenarioError: the file of this name has too many bytes.
[[noreturn]] void refuse_size(const std::string& path, std::uint64_t bytes);

}  // namespace lantern::language
