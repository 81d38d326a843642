// The marks of worlds and trees: one mark, one meaning, in all sequences.
#pragma once

#include <cstdint>

namespace lantern::draw {

// In the order of the legend.
enum class MarkKind : std::uint8_t {
  lit,
  passed,
  not_made,
  sleeping_cell,
  static_body,
  sleeping_body,
  ruled_out,       // a pale body: culled, or not met by the ray
  candidate,       // a link: this pair is to be tested
  faint_pair,      // the same among many
  boxes_apart,     // a dotted link: ruled out, the boxes do not overlap
  shapes_apart,    // a dotted link with a cross: the boxes overlap, the shapes do not touch
  box_overlap,     // a frame: what two boxes share
  contact,         // a short bar along the normal: they touch
  contact_begins,  // a ring round it: since this step
  impulse,         // an arrow from a contact: how strongly it pushes
  velocity,        // a thin arrow
  force,           // a heavy arrow, with its size
  ruler,           // a line between two ticks: a length
  box,             // round a body, in the broad phase
  ray,
  ray_hit,  // a disc on a ray
  met,      // a number on a plate: the order in which a ray meets cells
  view,
  region,
  found,    // a tick: what a view or region has found
  skipped,  // a disc with a cross: left out, with all below
  centre,   // a plus
  spring,
  rod,
  pin,             // a ring with a dot: two points held together
  shadow,          // a bar beside an axis: how far a body reaches along it
  shadow_gap,      // between two ticks: the bodies are apart along this axis
  shadow_overlap,  // a frame: what two shadows share
  support,         // a disc: the point farthest along a search's direction
  simplex,         // discs and lines: points of a search that have the nearest place between them
  origin,          // a ring with a dot, of a Minkowski difference
  portal,          // a strong dashed line: an opening between two sectors
  sight,           // a thin line between two dots: the sectors at its ends see each other
  trail,           // outlines on a line: where a body was, step by step
  ahead,           // a dotted outline: where it would be after the step
  look,            // an outline with a time: a look for the moment of an impact
  count_,
};

inline constexpr auto kMarkKinds = static_cast<unsigned>(MarkKind::count_);

// Those that are on a picture.
class MarkSet {
 public:
  void add(MarkKind kind) { bits_ |= std::uint64_t{1} << static_cast<unsigned>(kind); }
  bool has(MarkKind kind) const { return (bits_ >> static_cast<unsigned>(kind) & 1u) != 0; }
  bool empty() const { return bits_ == 0; }
  bool operator==(const MarkSet&) const = default;

 private:
  std::uint64_t bits_ = 0;
};

}  // namespace lantern::draw
