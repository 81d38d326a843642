// The one way that text gets onto a page: it knows where every label lies, so that none covers
// another, and records the boxes for the layout test.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/projection.hpp"
#include "draw/staging.hpp"

namespace lantern::draw {

struct TextStyle {
  double size = kLabel;
  Weight weight = Weight::regular;
  Role role = Role::ink;
  Role halo = Role::none;
};
// What most words of panels are set in.
inline constexpr TextStyle kPlain{}, kStrong{kLabel, Weight::semibold},
    kQuiet{kLabel, Weight::regular, Role::quiet_ink};

// In page units, as text_width of its size and weight.
double text_width(std::string_view text, const TextStyle& style);

// A place for a text: on the baseline, at its left end, centre or right end by `align`.
struct Anchor {
  Vec<2> at{0.0};
  double align = 0;
};

// A place whose capitals stand in the middle of a height: beside `at`, or centred on it.
Anchor centred(const Vec<2>& at, const TextStyle& style, double align = 0.5);

// Places for a name that stands `gap` outside of a box: below, above, and beside it.
std::array<Anchor, 8> anchors_around(const Box<2>& box, double gap, const TextStyle& style);

// A text on these places would be read as the name of something else.
inline bool touches(const std::vector<Box<2>>& places, const Box<2>& box) {
  return std::ranges::any_of(places, [&](const Box<2>& place) { return overlap(place, box); });
}

// The plate under a text that is centred there, with a margin around its capitals.
Box<2> plate_of(std::string_view text, const Vec<2>& at, const TextStyle& style,
                const Vec<2>& margin);

class Labels {
 public:
  // Texts and their boxes go to `list`, which must outlive this.
  explicit Labels(DrawList& list) : list_(list) {}

  // Where its texts go, to say what they name (DrawList::Scope).
  DrawList& list() const { return list_; }

  // What the letters may cover.
  static Box<2> extent(std::string_view text, const Anchor& anchor, const TextStyle& style);

  // From here on no label is tried on this place.
  void block(const Box<2>& place) { blocked_.push_back(place); }

  // For notes: where a thing of this name is drawn, and what of the page are bodies. Told only when
  // the frame has notes; of several places of one name the first counts.
  void expect_notes() { has_notes_ = true; }
  bool has_notes() const { return has_notes_; }
  void tell_place(std::string name, const Box<2>& box);
  void forget_places() { places_.clear(), bodies_.clear(); }
  void tell_body(const Box<2>& box) { bodies_.push_back(box); }
  const Box<2>* place_of(std::string_view name) const;  // null if nothing has told it
  const std::vector<Box<2>>& bodies() const { return bodies_; }
  bool covers_body(const Box<2>& box) const { return touches(bodies_, box); }

  // Inside the panel, and free of labels and of blocked places.
  bool is_free(const Box<2>& box, const Box<2>& panel) const;

  // The text at this anchor, whatever else is there: for texts whose place is laid out beforehand.
  void add(std::string_view text, const Anchor& anchor, const TextStyle& style,
           const Box<2>& panel);

  // The text at the first anchor where it is free; false, and nothing is drawn, if there is none.
  bool try_add(std::string_view text, std::initializer_list<Anchor> anchors, const TextStyle& style,
               const Box<2>& panel);

  // The first anchor where the text is free in the room, and where what it covers is accepted; null
  // if there is none.
  const Anchor* free_anchor(std::string_view text, std::span<const Anchor> anchors,
                            const TextStyle& style, const Box<2>& room, const auto& accepts) const {
    for (const Anchor& anchor : anchors) {
      const Box<2> box = extent(text, anchor, style);
      if (is_free(box, room) && accepts(box)) return &anchor;
    }
    return nullptr;
  }

  // The text at the first of these; false, and nothing is drawn, if there is none.
  bool try_add(std::string_view text, std::span<const Anchor> anchors, const TextStyle& style,
               const Box<2>& room, const Box<2>& panel, const auto& accepts) {
    const Anchor* free = free_anchor(text, anchors, style, room, accepts);
    if (free) add(text, *free, style, panel);
    return free != nullptr;
  }

  // A number whose last digit ends at `right`. Each digit has a cell of its own, so that none moves
  // when another one changes.
  void add_number(std::int64_t number, const Vec<2>& right, const TextStyle& style,
                  const Box<2>& panel);
  static double number_width(std::int64_t digits, const TextStyle& style) {
    return width_to(digits, digits, style);
  }
  // As wide as this number.
  static double width_of(std::integral auto number, const TextStyle& style) {
    return number_width(std::ssize(std::to_string(number)), style);
  }

  // What a picture leaves out, on a plate in its lower left corner. Nothing for an empty note.
  void add_note(std::string_view note, const Box<2>& picture);

 private:
  static double width_to(std::int64_t place, std::int64_t digits, const TextStyle& style);

  DrawList& list_;
  std::vector<Box<2>> blocked_;
  bool has_notes_ = false;
  std::vector<std::pair<std::string, Box<2>>> places_;
  std::vector<Box<2>> bodies_;
};

// `text` if it is no wider than `width`, otherwise as much of it as is, with an ellipsis; empty
// when not even one letter has room.
std::string shortened(std::string_view text, double width, const TextStyle& style);

// The text's lines, broken at spaces so that each is no wider than `width`. A word that is wider by
// itself is broken anywhere.
std::vector<std::string> wrapped(std::string_view text, double width, const TextStyle& style);
// Two lines at most, the second one shortened.
std::vector<std::string> two_lines(std::string_view text, double width, const TextStyle& style);

// Is the body's name written beside it? As the frame's display has it; of a story: among few bodies
// all have theirs; among many those that the frame is about: lit ones, and those that the caption
// names.
bool shows_name(const Frame& frame, const FrameBody& body);

// Is the node's name written in its cell? In a small tree all leaves have theirs, in others those
// that the step is about or passes.
bool shows_id(const Staging& staging, const FrameNode& node);

// Sides of bodies' boxes, as places among those of anchors_around(), by the bodies' names. Each
// body keeps one over the group: the first that is free of bodies on most of its frames.
using NameSides = std::map<std::string, std::size_t, std::less<>>;
const NameSides& name_sides(const Staging& staging, const Box<2>& panel);

// The anchors with the body's own first.
std::array<Anchor, 8> on_its_side(std::array<Anchor, 8> anchors, const NameSides& sides,
                                  std::string_view name);

inline constexpr double kNameGap = 7;  // between a body's box and its name

// How the two children of a plane are told apart: "left" and "right" where it is upright, "below"
// and "above" where it is level, and else "back" and "front".
std::string side_word(const FrameNode& parent, std::uint32_t slot);
// What is written at a leaf, the best first; nothing for an unlit one of a BSP more than one step
// down: its way is longer than anyone reads. Lit, it says on which side of its last plane it lies,
// "net: left".
std::vector<std::string> leaf_names(const Frame& frame, const FrameNode& leaf);

}  // namespace lantern::draw
