// What a colour is for, and the colours of themes. Code names roles; a theme gives them colours.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "language/display.hpp"

namespace lantern::draw {

enum class Role : std::uint8_t {
  none,         // not painted
  paper,        // the page
  panel,        // the ground of a cell or box
  ink,          // text and strong lines
  quiet_ink,    // secondary text
  rule,         // hairlines of the page
  cell_line_0,  // node borders by depth: 0, 1, 2, 3 and deeper
  cell_line_1,
  cell_line_2,
  cell_line_3,
  lit,          // outline of a lit node
  lit_ink,      // its text
  lit_fill,     // its ground
  passed_fill,  // ground of a node that the step merely passed
  body_1,
  body_2,
  body_3,
  body_4,
  body_5,
  body_6,
  body_7,
  body_8,
  body_line,  // outline of characters
  eye,        // the white of an eye
  pupil,
  pair,  // link between two bodies that are to be tested
  rejected_pair,
  faint_pair,  // a link among many
  static_body,
  asleep,
  contact,
  ray,
  frustum,
  warning,
  free_space,   // ground of what takes no part: a free slot, ruled out, unseen, asleep
  body_mark_1,  // emblems and patterns on a body's colour 1 ... 8: the second cue beside its hue
  body_mark_8 = body_mark_1 + 7,
  view_fill,  // ground of what a view sees
  sector_1,   // grounds of a level's sectors, so that neighbours differ
  sector_4 = sector_1 + 3,
  body_lit_1,  // faces of 3D bodies that look towards the light: of colour 1 ... 8,
  body_lit_8 = body_lit_1 + 7,
  static_lit,  // of static and of sleeping ones
  asleep_lit,
  body_shade_1,  // and faces that look away from it
  body_shade_8 = body_shade_1 + 7,
  static_shade,
  asleep_shade,
  count_,
};

// The role of body colour 1 ... 8.
constexpr Role body_role(int color) {
  return static_cast<Role>(static_cast<int>(Role::body_1) + (color - 1) % 8);
}

// The role of what is drawn on body colour 1 ... 8.
constexpr Role body_mark_role(int color) {
  return static_cast<Role>(static_cast<int>(Role::body_mark_1) + (color - 1) % 8);
}

// The three tones of a 3D body's faces.
enum class Tone { lit, middle, shade };

// The same colour, of body 1 ... 8, a static or a sleeping one, in another tone.
constexpr Role in_tone(Role role, Tone tone) {
  if (tone == Tone::middle) return role;
  const int first = static_cast<int>(tone == Tone::lit ? Role::body_lit_1 : Role::body_shade_1);
  if (role == Role::static_body) return static_cast<Role>(first + 8);
  if (role == Role::asleep) return static_cast<Role>(first + 9);
  return static_cast<Role>(first + static_cast<int>(role) - static_cast<int>(Role::body_1));
}

inline constexpr unsigned kSectorTones = 4;

// The role of the ground of a sector of tone 0 ... 3.
constexpr Role sector_role(unsigned tone) {
  return static_cast<Role>(static_cast<unsigned>(Role::sector_1) + tone % kSectorTones);
}

// The role of a cell line at this depth of the tree.
constexpr Role cell_line_role(std::uint32_t depth) {
  return static_cast<Role>(static_cast<unsigned>(Role::cell_line_0) + (depth < 3 ? depth : 3u));
}

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Color&) const = default;
};

struct Theme {
  std::string_view name;
  std::array<Color, static_cast<std::size_t>(Role::count_)> colors;
  const Color& operator[](Role role) const { return colors[static_cast<std::size_t>(role)]; }
  // With colours of an author's own.
  Theme with(std::span<const BodyPaint> paints) const;
};

// light, dark, print
std::span<const Theme> themes();
std::optional<Theme> theme_named(std::string_view name);

}  // namespace lantern::draw
