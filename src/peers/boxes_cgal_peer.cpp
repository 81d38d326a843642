// CGAL: intersecting sequences of boxes for pairs, an AABB tree for what is asked in space.
#include <algorithm>
#include <array>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>
#include <boost/iterator/function_output_iterator.hpp>

#include "measure/box_peer.hpp"
#include "peers/count_new.hpp"

namespace lantern::peers {
namespace {

using measure::Boxes;

// Below which it compares all with all; the first is CGAL's own default.
constexpr std::array<std::ptrdiff_t, 6> kCutoffs = {10, 30, 100, 300, 1000, 3000};

template <int D>
class SequenceFinder : public measure::PairFinder<D> {
 public:
  explicit SequenceFinder(std::ptrdiff_t cutoff) : cutoff_(cutoff) {}

  void find(Boxes<D> boxes, std::vector<Pair>& pairs) override {
    if (moving_boxes_.empty()) put(boxes, true, fixed_boxes_, fixed_);
    put(boxes, false, moving_boxes_, moving_);
    const auto add = [&](const Handled* a, const Handled* b) {
      pairs.push_back({std::min(a->info(), b->info()), std::max(a->info(), b->info())});
    };
    CGAL::box_self_intersection_d(moving_.begin(), moving_.end(), add, cutoff_,
                                  CGAL::Box_intersection_d::CLOSED);
    if (!fixed_.empty())
      CGAL::box_intersection_d(moving_.begin(), moving_.end(), fixed_.begin(), fixed_.end(), add,
                               cutoff_, CGAL::Box_intersection_d::CLOSED);
  }

 private:
  using Handled =
      CGAL::Box_intersection_d::Box_with_info_d<double, D, BodyId,
                                                CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

  static void put(Boxes<D> boxes, bool fixed, std::vector<Handled>& own,
                  std::vector<const Handled*>& list) {
    own.clear();
    list.clear();
    for (const Proxy<D>& body : boxes) {
      if (body.is_static != fixed) continue;
      double lo[D], hi[D];
      for (int i = 0; i < D; ++i) {
        lo[i] = body.box.lo[i];
        hi[i] = body.box.hi[i];
      }
      own.emplace_back(lo, hi, body.id);
    }
    for (const Handled& box : own) list.push_back(&box);
  }

  std::ptrdiff_t cutoff_;
  std::vector<Handled> moving_boxes_, fixed_boxes_;
  std::vector<const Handled*> moving_, fixed_;
};

using Kernel = CGAL::Simple_cartesian<double>;

Kernel::Point_3 point(const Vec<3>& p) { return {p.x, p.y, p.z}; }

struct CuboidPrimitive {
  using Id = BodyId;
  using Point = Kernel::Point_3;
  using Datum = Kernel::Iso_cuboid_3;

  CuboidPrimitive() = default;
  explicit CuboidPrimitive(Boxes<3>::iterator body)
      : id_(body->id), datum_(point(body->box.lo), point(body->box.hi), 0) {}
  Id id() const { return id_; }
  const Datum& datum() const { return datum_; }
  Point reference_point() const { return datum_.min(); }

 private:
  Id id_ = 0;
  Datum datum_;
};

class TreeOracle : public measure::Oracle<3> {
 public:
  void build(Boxes<3> boxes) override {
    tree_.insert(boxes.begin(), boxes.end());
    tree_.build();
  }
  void along(const Ray<3>& ray, std::vector<BodyId>& ids) override {
    tree_.all_intersected_primitives(
        Kernel::Segment_3(point(ray.origin), point(ray.at(ray.length))), std::back_inserter(ids));
  }
  void within(const Box<3>& box, std::vector<BodyId>& ids) override {
    tree_.all_intersected_primitives(Kernel::Iso_cuboid_3(point(box.lo), point(box.hi), 0),
                                     std::back_inserter(ids));
  }
  void within(const Ball<3>& ball, std::vector<BodyId>& ids) override {
    tree_.all_intersected_primitives(
        Kernel::Sphere_3(point(ball.center), ball.radius * ball.radius), std::back_inserter(ids));
  }

 private:
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CuboidPrimitive>> tree_;
};

template <int D>
std::unique_ptr<measure::PairFinder<D>> finder(std::size_t setting) {
  return std::make_unique<SequenceFinder<D>>(kCutoffs[setting]);
}

}  // namespace
extern "C" void lantern_box_peers(std::vector<BoxPeer>& peers) {
  std::vector<std::string> settings;
  for (const std::ptrdiff_t cutoff : kCutoffs)
    settings.push_back("cutoff " + std::to_string(cutoff));
  peers.push_back({.name = "CGAL",
                   .version = LANTERN_PEER_VERSION,
                   .how = "box_self_intersection_d of pointers to boxes, box_intersection_d with "
                          "static ones; what is asked in space goes to an AABB_tree",
                   .settings = settings,
                   .pairs_2d = finder<2>,
                   .pairs_3d = finder<3>,
                   .oracle_3d = [](std::size_t) { return std::make_unique<TreeOracle>(); },
                   .allocations = [] { return calls_for_memory; }});
}

}  // namespace lantern::peers
