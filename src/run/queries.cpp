#include "run/queries.hpp"

#include <algorithm>
#include <cmath>

#include "spatial/query.hpp"

namespace lantern::run {
namespace {

template <int D>
class Queries {
 public:
  explicit Queries(const World<D>& world) : world_(world) {}

  Finding answer(const CastRay& cast) {
    Ray<D> ray;
    ray.origin = in_dimension<D>(cast.from);
    const Vec<D> way = in_dimension<D>(cast.to) - ray.origin;
    ray.length = glm::length(way);
    ray.direction = way / ray.length;
    const auto meets = [&](BodyId id) {
      const Body<D>& b = *world_.find(id);
      const std::optional<double> at = entry(ray, b.shape, b.position, b.orientation);
      const auto in_box = span_in(ray, b.box());  // before it, nothing is hit
      if (at && in_box) note_met(id, std::max(*at, in_box->from), ray);
      return at;
    };
    std::vector<RayHit> hits;
    look([&](const StructureView<D>& tree, BoxOf<D> box_of, QueryWatch told) {
      if (cast.all) {
        const AllHits all = raycast_all(tree, ray, box_of, meets, told);
        hits.insert(hits.end(), all.hits.begin(), all.hits.end());
        return all.counts;
      }
      const NearestHit nearest = raycast_nearest(tree, ray, box_of, meets, told);
      if (nearest.hit) hits.push_back(*nearest.hit);
      return nearest.counts;
    });
    std::sort(hits.begin(), hits.end(), RayHit::before);
    if (!cast.all && hits.size() > 1) hits.resize(1);
    found_.ray = FrameRay{cast.from, cast.to, {}};
    found_.nearest = !cast.all;
    found_.asked = cast.to;
    for (const RayHit& hit : hits) {
      found_.hits.push_back(hit.id);
      found_.ray->hits.push_back({hit.id, solid(ray.at(hit.distance))});
    }
    if (!cast.all && !hits.empty()) found_.ray->to = found_.ray->hits[0].position;
    return std::move(found_);
  }

  Finding answer(const Cull& view) {
    const Frustum<D> frustum = frustum_of(view);
    look([&](const StructureView<D>& tree, BoxOf<D> box_of, QueryWatch told) {
      return add(overlap_query(tree, frustum, box_of, told));
    });
    found_.view = FrameView{view.eye, corners_of(frustum)};
    return sorted();
  }

  Finding answer(const Query& region) {
    const Box<D> box = in_dimension<D>(region.box);
    const Ball<D> ball{box.center(), region.radius};
    look([&](const StructureView<D>& tree, BoxOf<D> box_of, QueryWatch told) {
      return add(region.radius > 0 ? overlap_query(tree, ball, box_of, told)
                                   : overlap_query(tree, box, box_of, told));
    });
    found_.region = FrameQuery{region.box, region.radius};
    return sorted();
  }

 private:
  void note_met(BodyId id, double distance, const Ray<D>& ray) {
    found_.met[id] = {distance, solid(ray.at(distance))};
  }

  void look(FunctionRef<QueryCounts(const StructureView<D>&, BoxOf<D>, QueryWatch)> f) {
    const auto told = [&](const QueryEvent& event) { found_.walk.push_back(event); };
    const auto box_of = [&](BodyId id) { return world_.find(id)->box(); };
    const std::vector<StructureView<D>> structures = world_.broad_phase()->each();
    for (std::size_t i = 0; i < structures.size(); ++i) {
      if (i == 1) found_.first_static = found_.walk.size();
      const QueryCounts counts = f(structures[i], box_of, told);
      found_.counts.nodes_visited += counts.nodes_visited;
      found_.counts.nodes_skipped += counts.nodes_skipped;
      found_.counts.objects_tested += counts.objects_tested;
    }
  }

  QueryCounts add(const Found& found) {
    found_.hits.insert(found_.hits.end(), found.ids.begin(), found.ids.end());
    return found.counts;
  }

  Finding sorted() {
    std::sort(found_.hits.begin(), found_.hits.end());
    return std::move(found_);
  }

  static Frustum<D> frustum_of(const Cull& view) {
    constexpr double kAspect = 16.0 / 9.0;
    if constexpr (D == 2)
      return view_wedge(flat(view.eye), flat(view.target - view.eye), view.angle, view.near,
                        view.far);
    else
      return view_frustum(view.eye, view.target, up_of(view.target - view.eye), view.angle, kAspect,
                          view.near, view.far);
  }

  // Upwards, but for a view straight up or down: there the picture's top is the world's back.
  static Vec<3> up_of(const Vec<3>& forward) {
    const bool upright = std::abs(forward.y) > 0.999 * glm::length(forward);
    return upright ? Vec<3>(0, 0, -1) : Vec<3>(0, 1, 0);
  }

  // Round the wedge, or round the near plane and then the far one.
  static std::vector<Vec<3>> corners_of(const Frustum<D>& frustum) {
    constexpr std::size_t kFlat[] = {0, 2, 3, 1}, kSolid[] = {0, 2, 6, 4, 1, 3, 7, 5};
    std::vector<Vec<3>> corners;
    for (std::size_t i = 0; i < frustum.corners.size(); ++i)
      corners.push_back(solid(frustum.corners[D == 2 ? kFlat[i] : kSolid[i]]));
    return corners;
  }

  const World<D>& world_;
  Finding found_;
};

}  // namespace

template <int D>
Finding asked(const Question& question, const World<D>& world) {
  return std::visit([&](const auto& verb) { return Queries<D>(world).answer(verb); }, question);
}

template Finding asked(const Question&, const World<2>&);
template Finding asked(const Question&, const World<3>&);

}  // namespace lantern::run
