// Boost.Geometry's R-tree, packed anew each time.
#include <algorithm>
#include <optional>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include "measure/box_peer.hpp"
#include "peers/count_new.hpp"

namespace lantern::peers {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using measure::Boxes;

template <int D>
using Point = bg::model::point<double, D, bg::cs::cartesian>;
template <int D>
using Entry = std::pair<bg::model::box<Point<D>>, BodyId>;
template <int D, std::size_t M>
using RTree = bgi::rtree<Entry<D>, bgi::rstar<M>>;

template <int D>
Point<D> to_boost(const Vec<D>& v) {
  if constexpr (D == 2)
    return {v.x, v.y};
  else
    return {v.x, v.y, v.z};
}
template <int D>
bg::model::box<Point<D>> to_boost(const Box<D>& box) {
  return {to_boost<D>(box.lo), to_boost<D>(box.hi)};
}

// Those of which `wanted`.
template <int D, class F>
std::vector<Entry<D>>& entries(Boxes<D> boxes, std::vector<Entry<D>>& room, F&& wanted) {
  room.clear();
  for (const Proxy<D>& body : boxes)
    if (wanted(body)) room.emplace_back(to_boost<D>(body.box), body.id);
  return room;
}

template <int D, std::size_t M>
class PackedFinder : public measure::PairFinder<D> {
 public:
  void find(Boxes<D> boxes, std::vector<Pair>& pairs) override {
    const auto is_static = [](const Proxy<D>& body) { return body.is_static; };
    if (!static_) static_.emplace(entries<D>(boxes, room_, is_static));
    const RTree<D, M> moving(entries<D>(boxes, room_, std::not_fn(is_static)));
    for (const Entry<D>& entry : room_) {
      const BodyId id = entry.second;
      moving.query(bgi::intersects(entry.first),
                   boost::make_function_output_iterator([&](const Entry<D>& other) {
                     if (other.second > id) pairs.push_back({id, other.second});
                   }));
      if (!static_->empty())
        static_->query(bgi::intersects(entry.first),
                       boost::make_function_output_iterator([&](const Entry<D>& other) {
                         pairs.push_back({std::min(id, other.second), std::max(id, other.second)});
                       }));
    }
  }

 private:
  std::optional<RTree<D, M>> static_;
  std::vector<Entry<D>> room_;
};

template <int D, std::size_t M>
class PackedOracle : public measure::Oracle<D> {
 public:
  void build(Boxes<D> boxes) override {
    boxes_ = boxes;
    std::vector<Entry<D>> room;
    tree_ = RTree<D, M>(entries<D>(boxes, room, [](const Proxy<D>&) { return true; }));
  }
  void along(const Ray<D>& ray, std::vector<BodyId>& ids) override {
    const Vec<D> end = ray.at(ray.length);
    const bg::model::segment<Point<D>> segment(to_boost<D>(ray.origin), to_boost<D>(end));
    tree_.query(bgi::intersects(segment), into(ids));
  }
  void within(const Box<D>& box, std::vector<BodyId>& ids) override {
    tree_.query(bgi::intersects(to_boost<D>(box)), into(ids));
  }
  void within(const Ball<D>& ball, std::vector<BodyId>& ids) override {
    const Box<D> around = Box<D>::around(ball.center, Vec<D>(ball.radius));
    tree_.query(bgi::intersects(to_boost<D>(around)) && bgi::satisfies([&](const Entry<D>& entry) {
                  return overlap(ball, boxes_[entry.second].box);
                }),
                into(ids));
  }
  // Of the boxes in which the point lies, Boost names any: here the first is asked for.
  bool nearest(const Vec<D>& at, std::vector<BodyId>& ids) override {
    const Point<D> point = to_boost<D>(at);
    const std::size_t before = ids.size();
    tree_.query(bgi::nearest(point, 1), into(ids));
    if (!contains(boxes_[ids.back()].box, at)) return true;
    tree_.query(bgi::intersects(point), into(ids));
    ids[before] = *std::min_element(ids.begin() + static_cast<std::ptrdiff_t>(before), ids.end());
    ids.resize(before + 1);
    return true;
  }

 private:
  static auto into(std::vector<BodyId>& ids) {
    return boost::make_function_output_iterator(
        [&ids](const Entry<D>& entry) { ids.push_back(entry.second); });
  }

  Boxes<D> boxes_;
  RTree<D, M> tree_;
};

template <template <int, std::size_t> class Of, class T, int D>
std::unique_ptr<T> made(std::size_t setting) {
  if (setting == 0) return std::make_unique<Of<D, 8>>();
  return std::make_unique<Of<D, 16>>();
}

}  // namespace
extern "C" void lantern_box_peers(std::vector<BoxPeer>& peers) {
  peers.push_back({.name = "Boost",
                   .version = LANTERN_PEER_VERSION,
                   .how = "Boost.Geometry's rtree, packed anew each step, and one of the static "
                          "boxes packed once; each body asks with intersects",
                   .settings = {"nodes of 8", "nodes of 16"},
                   .pairs_2d = made<PackedFinder, PairFinder<2>, 2>,
                   .pairs_3d = made<PackedFinder, PairFinder<3>, 3>,
                   .oracle_2d = made<PackedOracle, Oracle<2>, 2>,
                   .oracle_3d = made<PackedOracle, Oracle<3>, 3>,
                   .finds_nearest = true,
                   .allocations = [] { return calls_for_memory; }});
}

}  // namespace lantern::peers
