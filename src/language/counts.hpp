// What a frame counts and measures, one row each beside the code that counts: how it is called,
// what it is, how much of it there can be, and when there is one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "language/scenario.hpp"

namespace lantern::language {

// What the steps of a script have brought about so far, as far as it decides what can be counted.
class ScriptPast {
 public:
  // Nothing yet. `dimension` is the world's, 0 if it is not known.
  ScriptPast(const ScenarioSpec& scenario, int dimension);

  // A step with this verb is done; or one of which nobody knows what it was to do, so that from now
  // on anything may have happened.
  void note(const Verb& verb);
  void note_unknown() { is_sure_ = false; }

  // How many such steps there have been, and whether any; of questions to a level, since it was
  // compiled last.
  template <class V>
  std::size_t times() const {
    return times_[Verb(V()).index()];
  }
  template <class V>
  bool has() const {
    return !is_sure_ || times<V>() > 0;
  }
  bool has_asked() const;                                     // a ray, cull or query
  bool has_located() const { return !is_sure_ || located_; }  // a point of the level
  bool has_eye_looked() const { return !is_sure_ || eyed_; }  // in the level
  bool has_structure() const { return !is_sure_ || structure_.kind != StructureKind::none; }
  const StructureSpec& structure() const { return structure_; }  // as it stands, if that is known
  bool is_sure() const { return is_sure_; }
  const ScenarioSpec& scenario() const { return scenario_; }
  int dimension() const { return dimension_; }

 private:
  const ScenarioSpec& scenario_;
  int dimension_;
  bool is_sure_ = true;
  StructureSpec structure_;
  std::array<std::size_t, std::variant_size_v<Verb>> times_{};
  bool located_ = false;
  bool eyed_ = false;
};

// When there is such a count: a question to the scenario and to what its script has done so far.
struct CountRule {
  std::string_view when;     // for the reference page: "with a structure"
  std::string_view why_not;  // for whom asks too early or in vain; {} is the kind of structure
  bool (*holds)(const ScriptPast& past) = nullptr;
  const CountRule* first = nullptr;  // that must hold before this one is asked
};

// Rules of Lantern's own counts. Each of them asks its `first` first.
namespace when {
extern const CountRule with_atlas, room, drawn, no_atlas, time, bodies, solid, structure, any_tree,
    tree, kd_tree, printed, sweep, boxes, array, inside, split, asleep_nodes, contacts, joints,
    sleep, physics, islands, query, shapes, separated, searched, compared, level, compiled, located,
    sighted, eyed;
}  // namespace when

// The most that a frame can count, by what its scenario has.
enum class Most {
  unbounded,
  size,          // of a measure, which is never negative
  part_of_step,  // of a measure from 0 to 1
  bodies,
  pairs,  // of bodies
  parts,  // nodes and what they hold
  depth,
};

struct CountDoc {
  std::string_view name;
  const CountRule& rule;
  std::string_view noun;  // beside its number, "leaf/leaves"; if empty, its name's words
  std::string_view doc;
  Most most = Most::unbounded;
  std::string_view unit = {};  // of a measure: "J"

  bool for_atlas() const;
  bool for_world() const;
  // Its noun, or its name's words: "leaf/leaves", "pair test/pair tests".
  std::string forms() const;
};

// What a headline puts in front: "pairs", or with words of its own "pairs: pair left/pairs left".
struct Fronted {
  std::string name;
  std::string words;  // empty: those of its row
};
Fronted fronted(std::string_view written);

// What a caption may quote and an expectation may name.
std::span<const CountDoc> known_counts();

// What is measured rather than counted, with a fraction: energies and the like.
std::span<const CountDoc> known_measures();

// More of them, each row beside the code that counts it (run/counters.cpp lists these); to be
// called before any scenario is read. Throws Refused if a name is taken, or is not of a–z, 0–9
// and _.
void add_counts(std::span<const CountDoc> rows);
void add_measures(std::span<const CountDoc> rows);

// The same of one body, written as `energy.bob`; in the order of BodyMeasure.
std::span<const CountDoc> known_body_measures();
bool is_counted(const CountDoc& of_body);

// Placeholders of captions that are not counts.
std::span<const CountDoc> known_texts();

// The row of that name; null if there is none.
const CountDoc* find_in(std::span<const CountDoc> docs, std::string_view name);

// A known count or measure, and the names of all of them.
const CountDoc* find_count(std::string_view name);
std::vector<std::string_view> names_of_counts();

// Why there is no such count at this point of the script; empty if there is one.
std::string why_not_counted(const CountDoc& count, const ScriptPast& past);

// The same of a measure of one body, which may enter at any time.
std::string why_not_measured(const CountDoc& measure, const ScriptPast& past);

// Does the name look like the measure of one body, as "energy.bob"?
inline bool is_of_body(std::string_view name) { return name.find('.') != std::string_view::npos; }

// Captions quote what the engine counted. Placeholders stand in braces:
//   {pairs}               the count: "2"
//   {pairs:pair}          the count and its noun, singular or plural: "1 pair", "2 pairs"
//   {leaves:leaf/leaves}  the same for an irregular plural, or for a language of more forms:
//                         {leaves:liść/liście/liści}
//   {texture}             a text
//   {{ and }}             the braces themselves

using TextLookup = std::function<std::optional<std::string>(std::string_view name)>;
using CountLookup = std::function<std::optional<std::int64_t>(std::string_view name)>;

// The caption with its placeholders filled in, texts looked up before counts. A placeholder that
// neither knows, and a brace that stands alone, are left as they are written.
std::string fill_caption(std::string_view caption, const TextLookup& text,
                         const CountLookup& count);

// The names that its placeholders quote, each once, in order.
std::vector<std::string> placeholders_of(std::string_view caption);

struct CaptionProblem {
  std::size_t offset = 0;  // in bytes, of what is wrong
  std::string message;     // empty if the only fault is that nobody knows `unknown`
  std::string unknown;     // a placeholder's name
};

// What placeholders are there.
enum class Placeholder { unknown, text, count };

// All mistakes in a caption, in order; none if it can be filled in.
std::vector<CaptionProblem> caption_problems(
    std::string_view caption, const std::function<Placeholder(std::string_view name)>& kind_of);

}  // namespace lantern::language
