// The marks of worlds and trees: one mark, one meaning, in all sequences.
#pragma once

#include <cstdint>

namespace lantern::draw {

enum class MarkKind : std::uint8_t {
  candidate,       // a link: this pair is to be tested
  faint_pair,      // the same among many
  boxes_off,       // a dotted link: ruled out, the boxes do not overlap
  shapes_off,      // a dotted link with a cross: the boxes overlap, the shapes do not touch
  box_overlap,     // a frame: what two boxes share
  contact,         // a short bar along the normal: they touch
  contact_begins,  // a ring round it: since this step
  impulse,         // an arrow from a contact: how strongly it pushes
  ray_hit,         // a disc on a ray
  found,           // a tick: what a view or region has found
  skipped,         // a disc with a cross: left out, with all below
  met,             // a number on a plate: the order in which a ray meets cells
  pin,             // a ring with a dot: two points held together
  centre,          // a plus
  velocity,        // a thin arrow
  force,           // a heavy arrow, with its size
  ruler,           // a line between two ticks: a length
  count_,
};

}  // namespace lantern::draw
