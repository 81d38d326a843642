// How far a pair has come on the way from the broad phase to a contact.
#pragma once

#include <algorithm>

#include "scenario/frame.hpp"

namespace lantern::scenario {

enum class PairState {
  candidate,   // the broad phase has handed it on, and nothing more is known
  boxes_off,   // the narrow phase has ruled it out: its boxes do not overlap
  shapes_off,  // and of boxes that do: its shapes do not touch
  contact,     // it touches
};

// Of one of the frame's pairs, as far as the frame knows.
inline PairState state_of(const FramePair& pair, const Frame& frame) {
  if (!frame.narrow_phase_done) return PairState::candidate;
  const auto contact = std::ranges::lower_bound(frame.contacts, pair.pair, {}, &FrameContact::pair);
  if (contact != frame.contacts.end() && contact->pair == pair.pair) return PairState::contact;
  return pair.overlaps ? PairState::shapes_off : PairState::boxes_off;
}

}  // namespace lantern::scenario
