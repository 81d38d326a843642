#include "frame/pair_state.hpp"

#include <algorithm>

#include "spatial/pairs.hpp"

namespace lantern::frame {

PairStates::PairStates(const Frame& frame)
    : all_(all_pairs(frame.bodies.size())), has_contacts_(frame.count("contacts").has_value()) {
  for (const FrameBody& body : frame.bodies)
    if (body.is_static) statics_.push_back(body.id);
  std::ranges::sort(statics_);
  // Without contacts nobody compares boxes, and in the broad phase nobody has yet.
  const bool compared = has_contacts_ && frame.phase != StepPhase::broad;
  for (const FramePair& p : frame.pairs)
    found_.push_back(
        {p.pair, compared && !p.overlaps ? PairState::boxes_apart : PairState::candidate, p.lit});
  std::ranges::sort(found_, {}, &Found::pair);
  const auto raise = [&](const Pair& pair, PairState from, PairState to) {
    const Found* found = find(pair);
    if (found && found->state <= from)
      found_[static_cast<std::size_t>(found - found_.data())].state = to;
    return found != nullptr;
  };
  for (const Pair& pair : frame.tested) raise(pair, PairState::candidate, PairState::shapes_apart);
  std::vector<Found> others;  // that touch, and are no candidates: both sleep, or they have parted
  for (const FrameContact& contact : frame.contacts)
    if (!raise(contact.pair, PairState::shapes_apart, PairState::contact))
      others.push_back({contact.pair, PairState::contact, false});
  found_.insert(found_.end(), others.begin(), others.end());
  std::ranges::sort(found_, {}, &Found::pair);
  const std::uint64_t untestable = all_pairs(statics_.size());
  const auto count = [&](PairState state) -> std::uint64_t& {
    return counts_[static_cast<std::size_t>(state)];
  };
  for (const Found& found : found_) ++count(found.state);
  count(PairState::untestable) = untestable;
  count(PairState::ruled_out) = all_ - std::min(all_, untestable + found_.size());
}

const PairStates::Found* PairStates::find(const Pair& pair) const {
  const auto at = std::ranges::lower_bound(found_, pair, {}, &Found::pair);
  return at != found_.end() && at->pair == pair ? &*at : nullptr;
}

PairState PairStates::state_of(const Pair& pair) const {
  if (const Found* found = find(pair)) return found->state;
  const bool both =
      std::ranges::binary_search(statics_, pair.a) && std::ranges::binary_search(statics_, pair.b);
  return both ? PairState::untestable : PairState::ruled_out;
}

bool PairStates::is_new(const Pair& pair) const {
  const Found* found = find(pair);
  return found && found->is_new;
}

}  // namespace lantern::frame
