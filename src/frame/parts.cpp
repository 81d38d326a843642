// The types of parts, and what parts answer of themselves.
#include <algorithm>

#include "frame/frame.hpp"
#include "frame/part_fields.hpp"

namespace lantern::frame {

template const PartType& part_type<FrameLinks>();
template const PartType& part_type<FrameIslands>();
template const PartType& part_type<FrameForces>();
template const PartType& part_type<FrameRulers>();
template const PartType& part_type<FrameLooks>();
template const PartType& part_type<FrameFinding>();
template const PartType& part_type<FrameSeparation>();
template const PartType& part_type<FrameSearch>();
template const PartType& part_type<FrameDifference>();
template const PartType& part_type<FrameLevel>();
template const PartType& part_type<FrameMatrix>();
template const PartType& part_type<FrameTextures>();
template const PartType& part_type<FrameComparison>();
template const PartType& part_type<FrameCode>();
template const PartType& part_type<FrameCollisions>();
template const PartType& part_type<FrameScreen>();
template const PartType& part_type<FrameStructure>();
template const PartType& part_type<FrameLand>();
template const PartType& part_type<FrameChart>();
template const PartType& part_type<FrameTrace>();
template const PartType& part_type<FrameQuestion>();
template const PartType& part_type<FrameSide>();

namespace {

template <class... P>
std::vector<const PartType*> types_of() {
  return {&part_type<P>()...};
}

}  // namespace

const std::vector<const PartType*>& part_order() {
  static const auto order =
      types_of<FrameLinks, FrameIslands, FrameForces, FrameRulers, FrameLooks, FrameFinding,
               FrameSeparation, FrameSearch, FrameDifference, FrameLevel, FrameMatrix,
               FrameTextures, FrameComparison, FrameCode, FrameCollisions, FrameScreen>();
  return order;
}

double FrameSeparation::gap() const {
  if (axes.empty()) return 0;
  return std::max(0.0, axes[answer.value_or(axes.size() - 1)].separation);
}

double FrameSeparation::overlap() const {
  if (axes.empty() || gap() > 0) return 0;
  if (answer) return -axes[*answer].separation;
  return -std::ranges::max(axes, {}, &FrameAxis::separation).separation;
}

void FrameTextures::add_state(Hash& hash) const {
  for (const FrameTexture& t : textures)
    for (const int x : {int{t.packed}, int{t.refused}, t.x, t.y, t.width, t.height})
      hash.add(static_cast<std::uint64_t>(x));
}

}  // namespace lantern::frame
