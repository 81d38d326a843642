// The way through a structure, and the doors to it that all structures have in common.
#pragma once

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

#include "spatial/structure.hpp"

namespace lantern::spatial {

// A walk through all nodes, while it is made.
template <int D>
struct Tour {
  std::vector<BodyId>& ids;   // scratch: what the leaf at hand holds
  Vec<D> toward{0.0};         // siblings are met as a ray along it meets them; zero: in their order
  std::uint32_t next_id = 0;  // of the next node

  // The ids in ascending order: as they are if they lie so already, else a sorted copy.
  std::span<const BodyId> ascending(std::span<const BodyId> found) {
    if (std::is_sorted(found.begin(), found.end())) return found;
    ids.assign(found.begin(), found.end());
    std::sort(ids.begin(), ids.end());
    return ids;
  }
};

// See structure.hpp. The structure itself has take(tour, f), one way for all of these.
template <class Structure, int D>
class Visitable {
 public:
  template <class F>
  void visit(F&& f) const {
    visit_toward(Vec<D>(0.0), f);
  }
  template <class F>
  void visit(F&& f, std::vector<BodyId>& room) const {
    static_cast<const Structure&>(*this).take(Tour<D>{room}, f);
  }
  template <class F>
  void visit_toward(const Vec<D>& direction, F&& f) const {
    std::vector<BodyId> room;
    static_cast<const Structure&>(*this).take(Tour<D>{room, direction}, f);
  }
};

// Lists that count their calls for memory.
class CountsAllocations {
 protected:
  template <class T>
  void append(std::vector<T>& list, const std::type_identity_t<T>& value) {
    allocations_ += list.size() == list.capacity();
    list.push_back(value);
  }

  std::uint64_t allocations_ = 0;
};

}  // namespace lantern::spatial
