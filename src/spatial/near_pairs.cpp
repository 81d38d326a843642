#include "spatial/near_pairs.hpp"

#include <cmath>
#include <utility>

namespace lantern::spatial {
namespace {

// About what it costs, each: to follow a body, to put it into a structure built anew and look for
// its partners, a partner found so; a pair of the list, and to put it in order where there are
// more; to look for the partners of one body, and a partner found so.
constexpr double kFollowed = 20, kBuilt = 100, kFound = 12;
constexpr double kCompared = 6, kOrdered = 4, kAsked = 1500, kMet = 60;

template <int D>
bool lies_in(const Box<D>& box, const Box<D>& reach) {
  bool all = true;
  for (int i = 0; i < D; ++i) all &= (reach.lo[i] <= box.lo[i]) & (box.hi[i] <= reach.hi[i]);
  return all;
}

double most_of(const auto& v) {
  double most = 0;
  for (int i = 0; i < v.length(); ++i) most = std::max(most, std::abs(v[i]));
  return most;
}

}  // namespace

// Without reaches one step costs as much as the other.
bool Horizon::is_due(double next, double plain) const {
  if (at_ == 0) return age_ >= (tried_[1].steps > 0 ? kLong : 1);
  return next * age_ > work_ || next > plain;
}

void Horizon::begin() {
  constexpr int kOften = 16;  // by then bodies may move otherwise
  tried_[at_].add(work_, age_);
  const auto best =
      static_cast<std::size_t>(std::ranges::min_element(tried_, {}, &Trial::mean) - tried_.begin());
  const bool looks_around = best == 0 ? at_ == 0 : again_ >= kOften;
  std::size_t next = best;
  for (const std::size_t i : {best - 1, best + 1})
    if (i < kHorizons && (tried_[i].steps == 0 || looks_around)) next = i;
  again_ = next == at_ ? again_ + 1 : 0;
  at_ = next;
  age_ = 0;
  work_ = 0;
}

template <int D>
Mending NearPairs<D>::follow(std::span<const Box<D>> boxes, bool reaches_stand) {
  constexpr int kKnown = 3;  // steps, with a move and how it differs from the one before
  if (horizon_.rests_for() > kKnown) {
    steps_known_ = 0;
    return Mending::none;
  }
  look_at_motion(boxes);
  left_.clear();
  if (horizon_.steps() > 0) find_left(boxes);
  Mending next = horizon_.steps() == 0 || reaches_.empty() ? Mending::none : Mending::some;
  const bool is_lost =
      horizon_.steps() > 0 && (reaches_.empty() || (!reaches_stand && !left_.empty()));
  if (steps_known_ >= kKnown &&
      (is_lost || horizon_.is_due(cost_of_mending(), cost_of_finding(pairs_)))) {
    horizon_.begin();
    while (horizon_.steps() > 0 && !begin(boxes)) give_up();
    next = horizon_.steps() == 0 ? Mending::none : Mending::anew;
  }
  if (next == Mending::some)
    for (const std::uint32_t place : left_) {
      enlarge(place, boxes[place]);
      if (std::exchange(has_left_[place], 1) == 0) all_left_.push_back(place);
    }
  for (std::size_t i = 0; i < boxes.size(); ++i) before_[i] = boxes[i].lo;
  return next;
}

// Of a sample of them.
template <int D>
void NearPairs<D>::look_at_motion(std::span<const Box<D>> boxes) {
  constexpr std::size_t kSample = 64;
  const std::size_t stride = boxes.size() / kSample + 1;
  extent_ = 0;
  if (steps_known_ == 0) {
    before_.resize(boxes.size());
    moves_.resize(boxes.size() / stride + 1);
  }
  ways_.clear();
  turns_.clear();
  for (std::size_t i = 0; i < boxes.size(); i += stride) {
    const Vec<D> move = boxes[i].lo - before_[i];
    const Vec<D> turn = move - std::exchange(moves_[i / stride], move);
    extent_ += extent_of(boxes[i]);
    ways_.push_back(most_of(move));
    turns_.push_back(most_of(turn));
  }
  const auto nearly_most = [](std::vector<double>& all) {
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 9 / 10);
    std::ranges::nth_element(all, at);
    return *at;
  };
  way_ = nearly_most(ways_);
  turn_ = nearly_most(turns_);
  extent_ /= static_cast<double>(turns_.size());
  ++steps_known_;
}

template <int D>
void NearPairs<D>::find_left(std::span<const Box<D>> boxes) {
  for (std::uint32_t i = 0; i < reaches_.size(); ++i)
    if (!lies_in(boxes[i], reaches_[i])) left_.push_back(i);
}

// What bodies do for the most part: they move on as they did, and turn a little; or as it happens,
// and then they get the less far the oftener they turn. False if they get so far that too many
// would be near each other.
template <int D>
bool NearPairs<D>::begin(std::span<const Box<D>> boxes) {
  const double steps = horizon_.steps();
  const bool moves_on = 2 * turn_ <= way_;
  ahead_ = moves_on ? steps : 0;
  margin_ = 1.5 * std::sqrt(steps) * (moves_on ? turn_ : way_);
  if (margin_ + ahead_ * way_ > 2 * extent_) return false;
  // At least some more are near each other than overlap now.
  if (2 * cost_of_comparing(2 * pairs_) > cost_of_finding(pairs_)) return false;
  reaches_.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) enlarge(i, boxes[i]);
  left_.clear();
  all_left_.clear();
  has_left_.assign(boxes.size(), 0);
  return true;
}

template <int D>
void NearPairs<D>::enlarge(std::size_t place, const Box<D>& box) {
  const Vec<D> way = (box.lo - before_[place]) * ahead_;
  const Box<D> reach{glm::min(box.lo, box.lo + way) - margin_,
                     glm::max(box.hi, box.hi + way) + margin_};
  reaches_[place] = is_valid(reach) ? reach : box;
}

// --- the list ---

template <int D>
void NearPairs<D>::put_in_order() {
  std::ranges::sort(more_);
  more_.erase(std::ranges::unique(more_).begin(), more_.end());
  // From behind, so that both lists need no third; those that were there already stand twice then.
  std::size_t i = near_.size(), j = more_.size();
  near_.resize(i + j);
  for (std::size_t next = i + j; j > 0;)
    near_[--next] = i > 0 && more_[j - 1] < near_[i - 1] ? near_[--i] : more_[--j];
  near_.erase(std::ranges::unique(near_).begin(), near_.end());
  more_.clear();
}

// --- what it costs ---

template <int D>
double NearPairs<D>::cost_of_finding(double pairs) const {
  return (kFollowed + kBuilt) * static_cast<double>(before_.size()) + kFound * pairs;
}
template <int D>
double NearPairs<D>::cost_of_comparing(double near) const {
  return kFollowed * static_cast<double>(before_.size()) + kCompared * near;
}
template <int D>
double NearPairs<D>::cost_of_mending() const {
  const auto near = static_cast<double>(near_.size()), left = static_cast<double>(left_.size());
  const double comparing = cost_of_comparing(near);
  if (left_.empty()) return comparing;
  return comparing + kOrdered * near + kBuilt * static_cast<double>(all_left_.size()) +
         left * (kAsked + kMet * 2 * near / static_cast<double>(before_.size()));
}

template <int D>
void NearPairs<D>::pay(Mending done, std::size_t pairs) {
  pairs_ = static_cast<double>(pairs);
  const auto near = static_cast<double>(near_.size());
  // Larger boxes meet more others in vain, too.
  horizon_.pay(done == Mending::none   ? cost_of_finding(pairs_)
               : done == Mending::some ? cost_of_mending()
                                       : cost_of_finding(4 * near - 3 * pairs_));
}

template <int D>
void NearPairs<D>::give_up() {
  horizon_.pay(kInfinity);
  horizon_.begin();
  reaches_.clear();
}

template <int D>
std::size_t NearPairs<D>::places() const {
  return before_.capacity() + moves_.capacity() + ways_.capacity() + turns_.capacity() +
         reaches_.capacity() + left_.capacity() + all_left_.capacity() + has_left_.capacity() +
         near_.capacity() + more_.capacity();
}

template class NearPairs<2>;
template class NearPairs<3>;

}  // namespace lantern::spatial
