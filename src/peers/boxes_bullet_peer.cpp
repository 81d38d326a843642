// Bullet's dynamic bounding-volume trees: single precision, as Bullet is built by default.
#include <algorithm>
#include <cmath>

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <LinearMath/btAlignedAllocator.h>

#include "measure/box_peer.hpp"
#include "peers/single_box.hpp"

namespace lantern::peers {
namespace {

using measure::Boxes;

std::uint64_t calls_for_memory = 0;
void* counted_alloc(std::size_t bytes) {
  ++calls_for_memory;
  return std::malloc(bytes);
}

template <int D>
btVector3 lower(const Box<D>& box) {
  return {float_below(box.lo.x), float_below(box.lo.y), D == 3 ? float_below(box.lo[D - 1]) : 0};
}
template <int D>
btVector3 upper(const Box<D>& box) {
  return {float_above(box.hi.x), float_above(box.hi.y), D == 3 ? float_above(box.hi[D - 1]) : 0};
}

void* number(BodyId id) { return reinterpret_cast<void*>(static_cast<std::uintptr_t>(id)); }
BodyId number(const void* data) {
  return static_cast<BodyId>(reinterpret_cast<std::uintptr_t>(data));
}

// The broad phase as a world of Bullet uses it: boxes are set, pairs come from its cache.
template <int D>
class BroadphaseFinder : public measure::PairFinder<D> {
 public:
  explicit BroadphaseFinder(bool deferred) { broadphase_.m_deferedcollide = deferred; }

  void find(Boxes<D> boxes, std::vector<Pair>& pairs) override {
    if (proxies_.empty())
      fill(boxes);
    else
      for (const Proxy<D>& body : boxes)
        if (!body.is_static)
          broadphase_.setAabb(proxies_[body.id], lower(body.box), upper(body.box), nullptr);
    broadphase_.calculateOverlappingPairs(nullptr);
    const btBroadphasePairArray& found =
        broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < found.size(); ++i) {
      const BodyId a = number(found[i].m_pProxy0->m_clientObject),
                   b = number(found[i].m_pProxy1->m_clientObject);
      if (overlap(boxes[a].box, boxes[b].box)) pairs.push_back({std::min(a, b), std::max(a, b)});
    }
  }

 private:
  void fill(Boxes<D> boxes) {
    constexpr int kStatic = btBroadphaseProxy::StaticFilter, kAll = btBroadphaseProxy::AllFilter;
    for (const Proxy<D>& body : boxes)
      proxies_.push_back(
          broadphase_.createProxy(lower(body.box), upper(body.box), 0, number(body.id),
                                  body.is_static ? kStatic : btBroadphaseProxy::DefaultFilter,
                                  body.is_static ? kAll ^ kStatic : kAll, nullptr));
  }

  btDbvtBroadphase broadphase_;
  std::vector<btBroadphaseProxy*> proxies_;
};

// A tree that was optimized once.
template <int D>
class TreeOracle : public measure::Oracle<D> {
 public:
  void build(Boxes<D> boxes) override {
    boxes_ = boxes;
    for (const Proxy<D>& body : boxes)
      tree_.insert(btDbvtVolume::FromMM(lower(body.box), upper(body.box)), number(body.id));
    tree_.optimizeTopDown();
  }

  // Bullet steps from the first point in its own precision: what it meets is a little enlarged,
  // and asked again.
  void along(const Ray<D>& ray, std::vector<BodyId>& ids) override {
    const Vec<D> end = ray.at(ray.length);
    const btVector3 from = point(ray.origin), to = point(end);
    const btVector3 way = to - from;
    const btScalar length = way.length();
    const btVector3 along = way / length;
    btVector3 inverse;
    unsigned signs[3];
    for (int i = 0; i < 3; ++i) {
      inverse[i] = along[i] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / along[i];
      signs[i] = inverse[i] < 0;
    }
    const btScalar far = std::max({std::abs(from.x()), std::abs(from.y()), std::abs(from.z()),
                                   std::abs(to.x()), std::abs(to.y()), std::abs(to.z())});
    const btScalar slack = 4e-6f * far;
    const btVector3 more(slack, slack, slack);
    const auto meets = [&](const Box<D>& box) { return span_in(ray, box).has_value(); };
    Collector<decltype(meets)> collector(boxes_, meets, ids);
    tree_.rayTestInternal(tree_.m_root, from, to, inverse, signs, length + slack, -more, more,
                          stack_, collector);
  }
  void within(const Box<D>& box, std::vector<BodyId>& ids) override {
    collide(
        box, [&](const Box<D>& other) { return overlap(box, other); }, ids);
  }
  void within(const Ball<D>& ball, std::vector<BodyId>& ids) override {
    collide(
        Box<D>::around(ball.center, Vec<D>(ball.radius)),
        [&](const Box<D>& other) { return overlap(ball, other); }, ids);
  }

 private:
  template <class Meets>
  struct Collector : btDbvt::ICollide {
    Collector(Boxes<D> all, const Meets& asked, std::vector<BodyId>& found)
        : boxes(all), meets(asked), ids(found) {}
    void Process(const btDbvtNode* leaf) override {
      const BodyId id = number(leaf->data);
      if (meets(boxes[id].box)) ids.push_back(id);
    }
    Boxes<D> boxes;
    const Meets& meets;
    std::vector<BodyId>& ids;
  };

  static btVector3 point(const Vec<D>& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y),
            D == 3 ? static_cast<float>(p[D - 1]) : 0};
  }

  template <class Meets>
  void collide(const Box<D>& box, const Meets& meets, std::vector<BodyId>& ids) {
    Collector<Meets> collector(boxes_, meets, ids);
    tree_.collideTVNoStackAlloc(tree_.m_root, btDbvtVolume::FromMM(lower(box), upper(box)), nodes_,
                                collector);
  }

  btDbvt tree_;
  Boxes<D> boxes_;
  btAlignedObjectArray<const btDbvtNode*> stack_;
  btNodeStack nodes_;
};

template <int D>
std::unique_ptr<measure::PairFinder<D>> finder(std::size_t setting) {
  return std::make_unique<BroadphaseFinder<D>>(setting == 1);
}
template <int D>
std::unique_ptr<measure::Oracle<D>> oracle(std::size_t) {
  return std::make_unique<TreeOracle<D>>();
}

}  // namespace
extern "C" void lantern_box_peers(std::vector<BoxPeer>& peers) {
  btAlignedAllocSetCustom(counted_alloc, std::free);
  peers.push_back(
      {.name = "Bullet",
       .version = LANTERN_PEER_VERSION,
       .how = "btDbvtBroadphase with its own margin of 0.05, pairs looked for when a box is set or "
              "all at once; what is asked goes to btDbvt after optimizeTopDown",
       .settings = {"looked for at once", "deferred"},
       .pairs_2d = finder<2>,
       .pairs_3d = finder<3>,
       .oracle_2d = oracle<2>,
       .oracle_3d = oracle<3>,
       .allocations = [] { return calls_for_memory; }});
}

}  // namespace lantern::peers
