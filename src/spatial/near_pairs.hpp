// Pairs that are mended from one step to the next instead of being looked for anew: a list is kept
// of bodies that are near each other, as Verlet kept it of molecules ("Computer 'Experiments' on
// Classical Fluids", Physical Review 159, 1967).
//
//     +--------------+         Each body has a reach: its box, enlarged, and more so where it will
//     |  +---+       |         be if it moves on (Catto, "Dynamic Bounding Volume Hierarchies", GDC
//     |  | a |-> +---|-----+   2019). While bodies stay within their reaches only those can overlap
//     |  +---+   |   | +-+ |   whose reaches do: nothing is built, and nothing is sorted. For the
//     +----------|---+ |b| |   few that leave theirs others are looked for again; as soon as that
//                +-----|-|-+   costs more than all anew, all are.
#pragma once

#include <array>

#include "geometry/not_finite.hpp"
#include "spatial/pairs.hpp"
#include "spatial/structure.hpp"

namespace lantern::spatial {

// How many steps ahead reaches look: found by trying what serves these bodies best. Work is
// counted, in about nanoseconds, so that the same bodies are always served alike.
class Horizon {
 public:
  // 0: there are no reaches.
  int steps() const { return at_ == 0 ? 0 : 1 << (at_ - 1); }
  // A step was made, at such a cost.
  void pay(double work) {
    work_ += work;
    ++age_;
  }
  // Steps for which there will be no reaches, since they did not pay.
  double rests_for() const { return at_ == 0 && tried_[1].steps > 0 ? kLong - age_ : 0; }
  // Whether to begin anew: a step of this cost would raise the mean of all since it last began, or
  // cost more than one without reaches.
  bool is_due(double next, double plain) const;
  // As far ahead as has cost least so far, or a step farther or less far that was not tried.
  void begin();

 private:
  static constexpr std::size_t kHorizons = 8;
  static constexpr double kLong = 32;
  // What it has cost, the later the more it counts.
  struct Trial {
    double steps = 0, work = 0;
    double mean() const { return steps > 0 ? work / steps : kInfinity; }
    void add(double its_work, double its_steps) {
      if (work == kInfinity) *this = {};  // it was given up
      work = work / 2 + its_work;
      steps = steps / 2 + its_steps;
    }
  };
  std::array<Trial, kHorizons> tried_;
  std::size_t at_ = 0;
  int again_ = 0;              // how often in a row it began with the same
  double work_ = 0, age_ = 0;  // since it began
};

// What is to be done in a step.
enum class Mending {
  none,  // look for the pairs of the boxes themselves
  anew,  // all reaches have changed: look for those near each other
  some,  // those of left() have: look for those near them
};

template <int D>
class NearPairs {
 public:
  // There are other bodies now, or one moved that never should.
  void forget() { *this = {}; }
  // The bodies, by place, as they are now; whether the structure holds the reaches.
  Mending follow(std::span<const Box<D>> boxes, bool reaches_stand);
  // What it told to do is done, and so many pairs were found.
  void pay(Mending done, std::size_t pairs);
  // It could not look ahead: too many are near each other.
  void give_up();

  std::span<const Box<D>> reaches() const { return reaches_; }
  // Places of those that have left their reaches in this step, and have others now.
  std::span<const std::uint32_t> left() const { return left_; }
  // Those that have since all were looked for: in the structure they stand where they were then.
  std::span<const std::uint32_t> all_left() const { return all_left_; }
  bool has_left(std::uint32_t place) const { return has_left_[place] != 0; }

  // By their numbers among all bodies, the lower first; in order.
  std::vector<Pair>& near() { return near_; }
  // One more of a body that has left, perhaps one that is there; and when all are told.
  void add(std::uint32_t a, std::uint32_t b) { more_.push_back({std::min(a, b), std::max(a, b)}); }
  void put_in_order();

  // Places for which there is memory.
  std::size_t places() const;

 private:
  void look_at_motion(std::span<const Box<D>> boxes);
  void find_left(std::span<const Box<D>> boxes);
  double cost_of_finding(double pairs) const;
  double cost_of_comparing(double near) const;
  double cost_of_mending() const;
  bool begin(std::span<const Box<D>> boxes);
  void enlarge(std::size_t place, const Box<D>& box);

  Horizon horizon_;
  int steps_known_ = 0;
  double pairs_ = 0;               // of the last step
  double way_ = 0;                 // what nearly no body moves more than in a step, along an axis
  double turn_ = 0;                // the same of what it moves otherwise than in the step before
  double extent_ = 0;              // the mean
  double ahead_ = 0, margin_ = 0;  // of reaches: for so many moves like the last one, and beyond
  std::vector<Vec<D>> before_;     // lower corners, a step ago
  std::vector<Vec<D>> moves_;      // of a sample, in the last step
  std::vector<double> ways_, turns_;
  std::vector<Box<D>> reaches_;  // none: the list is of no use
  std::vector<std::uint32_t> left_, all_left_;
  std::vector<std::uint8_t> has_left_;
  std::vector<Pair> near_, more_;
};

}  // namespace lantern::spatial
