// How far each pair of bodies came on the way from all pairs to contacts, as a frame knows it: what
// the ledger and the links in the world both say.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "frame/frame.hpp"

namespace lantern::frame {

enum class PairState : std::uint8_t {
  untestable,    // two static bodies: no pair for any broad phase
  ruled_out,     // by the broad phase: no leaf has both, or neither moves
  candidate,     // and nothing more is known of it yet
  boxes_apart,   // a candidate whose boxes do not overlap
  shapes_apart,  // one whose shapes the narrow phase has tested: they do not touch
  contact,       // they touch, or did in the last step in which one of them moved
};
inline constexpr std::size_t kPairStates = 6;

class PairStates {
 public:
  // Keeps nothing of the frame. Without a structure no pairs are listed: all that do not touch then
  // count as ruled out.
  explicit PairStates(const Frame& frame);

  // Of two bodies of the frame, the lower id first.
  PairState state_of(const Pair& pair) const;
  // Since the frame before; only candidates can be.
  bool is_new(const Pair& pair) const;

  // How many pairs there are of a state; of all states together n(n-1)/2.
  std::uint64_t count(PairState state) const { return counts_[static_cast<std::size_t>(state)]; }
  std::uint64_t all() const { return all_; }
  // The scene has contacts: boxes are compared and shapes tested, on this frame or a later one.
  bool has_contacts() const { return has_contacts_; }

 private:
  struct Found {
    Pair pair;
    PairState state = PairState::candidate;
    bool is_new = false;
  };
  const Found* find(const Pair& pair) const;

  std::vector<Found> found_;     // all but those that are ruled out or untestable, by pair
  std::vector<BodyId> statics_;  // ascending
  std::array<std::uint64_t, kPairStates> counts_{};
  std::uint64_t all_ = 0;
  bool has_contacts_ = false;
};

// Pairs that the structure does not name, although their boxes overlap: one has left the box that
// is stored for it, or a user's own structure is wrong. In order of ids.
std::vector<Pair> missed_pairs(const Frame& frame);

}  // namespace lantern::frame
