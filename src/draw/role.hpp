// What a colour is for. Code names roles; a theme gives them colours.
#pragma once

#include <cstdint>

namespace lantern {

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
  static_body,
  asleep,
  contact,
  ray,
  frustum,
  warning,
  free_space,  // an atlas's unused ground
  body_mark_1,
  body_mark_2,
  body_mark_3,
  body_mark_4,  // emblems and patterns on a body's colour:
  body_mark_5,
  body_mark_6,
  body_mark_7,
  body_mark_8,  // the second cue beside its hue
  view_fill,    // ground of what a view sees
  sector_1,     // grounds of a level's sectors, so that neighbours differ
  sector_2,
  sector_3,
  sector_4,
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

inline constexpr unsigned kSectorTones = 4;

// The role of the ground of a sector of tone 0 ... 3.
constexpr Role sector_role(unsigned tone) {
  return static_cast<Role>(static_cast<unsigned>(Role::sector_1) + tone % kSectorTones);
}

// The role of a cell line at this depth of the tree.
constexpr Role cell_line_role(std::uint32_t depth) {
  return static_cast<Role>(static_cast<unsigned>(Role::cell_line_0) + (depth < 3 ? depth : 3u));
}

}  // namespace lantern
