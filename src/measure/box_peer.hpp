// What Lantern asks of another library that knows boxes: all pairs that overlap, and what a ray, a
// box or a ball meets. A peer is a module of its own (src/peers/boxes_*), loaded only when it is
// measured: it is built with nothing of Lantern but headers.
#pragma once

#include "spatial/broad_phase.hpp"
#include "spatial/query.hpp"

namespace lantern::measure {

// The ids of boxes are their places in the list, from 0.
template <int D>
using Boxes = std::span<const Proxy<D>>;

template <int D>
class PairFinder {
 public:
  virtual ~PairFinder() = default;
  // Appends each pair of boxes that overlap (touching does) and are not both static: once, the
  // lower id first, the pairs in any order. In each call there are the same bodies, moved.
  virtual void find(Boxes<D> boxes, std::vector<Pair>& pairs) = 0;
};

template <int D>
class Oracle {
 public:
  virtual ~Oracle() = default;
  // To be called once, before anything is asked; the boxes outlive this.
  virtual void build(Boxes<D> boxes) = 0;
  // Append the bodies whose boxes the ray, box or ball meets: each once, in any order.
  virtual void along(const Ray<D>& ray, std::vector<BodyId>& ids) = 0;
  // The same, or only the first of them (of two at the same distance the lower id) where it has a
  // quicker way to that; says whether it is only that one.
  virtual bool first(const Ray<D>& ray, std::vector<BodyId>& ids) {
    along(ray, ids);
    return false;
  }
  virtual void within(const Box<D>& box, std::vector<BodyId>& ids) = 0;
  virtual void within(const Ball<D>& ball, std::vector<BodyId>& ids) = 0;
  // Appends the body whose box is nearest to the point, of several the one with the lowest id;
  // false, and nothing is done, if it cannot.
  virtual bool nearest(const Vec<D>&, std::vector<BodyId>&) { return false; }
  // Of all questions so far, where they are counted.
  virtual std::optional<QueryCounts> counts() const { return std::nullopt; }
};

// One library by one of its ways.
struct BoxPeer {
  template <class T>
  using Maker = std::function<std::unique_ptr<T>(std::size_t setting)>;

  std::string name, version;  // "CGAL", "5.5.1 (double)"
  std::string how;            // a sentence: what of it is run, and how
  // In words; the quickest is found out before anything is timed.
  std::vector<std::string> settings;
  // Empty where it cannot.
  Maker<PairFinder<2>> pairs_2d = {};
  Maker<PairFinder<3>> pairs_3d = {};
  Maker<Oracle<2>> oracle_2d = {};
  Maker<Oracle<3>> oracle_3d = {};
  bool finds_nearest = false;
  std::function<std::uint64_t()> allocations = {};  // calls for memory so far; empty: not counted
};

// The one function of a module: adds its peers. By the name "lantern_box_peers", C linkage.
using BoxPeersOfModule = void (*)(std::vector<BoxPeer>&);

}  // namespace lantern::measure
