// What a scenario says of its pictures that a frame hands on to who draws it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/plane.hpp"
#include "rooms.hpp"

namespace lantern::language {

// How a scenario writes an enum's values, in the enum's order.
using EnumNames = std::vector<std::string_view>;

// Whose names stand beside bodies: of many bodies only of those that the frame is about, of all as
// far as there is room, or of none.
enum class ShownNames { story, all, none };

// What a frame shows of what there is. A mark that is off is neither drawn nor named.
inline constexpr int kMostTrail = 64;

struct Display {
  ShownNames names = ShownNames::story;
  bool pairs = true;
  bool contacts = true;
  bool arrows = false;  // velocities
  bool forces = false;  // of scripts and springs, with their sizes
  bool cells = true;    // of the world panel: borders, grounds and names
  bool not_made = true;
  bool fill = false;
  bool outlined = false;     // bodies, so that the cells under them can be seen
  bool boxes = false;        // the bodies' broad-phase boxes
  bool depths = false;       // beside contacts
  bool coordinates = false;  // of the lit way's borders, at the world's edges
  int trail = 0;             // so many world steps back, where moving bodies were
  bool counters = true;
  bool title = true;
  bool caption = true;
  bool settings = true;  // of the structure, under its tree
  bool facts = true;     // these, and the tree's counts beside them
  bool legend = false;

  bool operator==(const Display&) const = default;
};

// What a note's line leads to.
enum class NoteOf { body, node, point, pair, count };

// Bodies' own outlines, in a square from -1 to 1, y down as on the page; each is filled by itself.
using Outline = std::vector<Polygon>;
// A colour of an author's own, in place of body colour 1 ... 8: 0xrrggbb.
struct BodyPaint {
  int color = 1;
  std::uint32_t rgb = 0;
  bool operator==(const BodyPaint&) const = default;
};
// What bodies lie on, in two themes.
inline constexpr std::uint32_t kLightGround = 0xffffff, kDarkGround = 0x191d26;

// What a texture is drawn as; `pattern` follows from its place in the list.
enum class Picture { pattern, heart, sword, potion, coin, map };
enum class Pace { step, event };
enum class Look { ghost, player, ball, bat, disc, box, person, demon, item };

inline EnumNames names(ShownNames) { return {"story", "all", "none"}; }
inline EnumNames names(Picture) { return {"pattern", "heart", "sword", "potion", "coin", "map"}; }
inline EnumNames names(Pace) { return {"step", "event"}; }
inline EnumNames names(Look) {
  return {"ghost", "player", "ball", "bat", "disc", "box", "person", "demon", "item"};
}

// Panels: what a page is made of. Each is an entry (draw/panel.hpp) in the file that draws it,
// which has all that is known of it; of that the language is given this.
struct Draft;

// A panel by its place in the list.
enum class Panel : std::uint8_t {};

struct PanelKind {
  std::string_view name = {};   // as in `panels`
  std::string_view words = {};  // what it shows, for the reference: "the `chart`"
  std::string_view needs = {};  // said where it is not possible: "it needs a [chart]"
  bool (*possible)(const Draft& draft) = [](const Draft&) { return true; };
  // Of a scenario that wishes for none, which has it if this holds: its place from the left.
  int place = 0;
  bool (*by_itself)(const Draft& draft) = nullptr;
  bool of_all_sides = false;           // one for all of them, below their own
  std::string (*example)() = nullptr;  // a scenario that has it, but for `panels`; null: the usual
};

std::span<const PanelKind> panel_kinds();
const PanelKind& kind_of(Panel panel);

// A panel, which must be there.
Panel panel_named(std::string_view name);

bool is(Panel panel, std::string_view name);
// Is it one of these?
bool shows(const std::vector<Panel>& panels, std::string_view name);

// Those that can have something to show in any of these. They must be known before the first frame
// is drawn, so they follow from what the files declare.
std::vector<Panel> derived_panels(std::span<const Draft* const> drafts);

// One more. To be called before any scenario is read. Throws Refused if its
// name is taken, or is not of a–z, 0–9 and _.
void add_panel(PanelKind kind);

std::vector<std::string_view> names(Panel);

}  // namespace lantern::language
