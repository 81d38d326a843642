#include "scenario/running_finding.hpp"

#include <algorithm>

namespace lantern::scenario {

RunningFinding::RunningFinding(const Finding& whole) : whole_(whole) {
  so_far_.done = false;
  so_far_.nearest = whole.nearest;
  so_far_.view = whole.view;
  so_far_.region = whole.region;
  so_far_.asked = whole.asked;
  if (whole.ray) so_far_.ray = FrameRay{whole.ray->from, whole.asked, {}};
}

void RunningFinding::go_on() {
  using Kind = QueryEvent::Kind;
  const QueryEvent& event = whole_.walk[at_];
  const bool marks = !is_of_static();
  QueryCounts& counts = so_far_.counts;
  switch (event.kind) {
    case Kind::visit:
      ++counts.nodes_visited;
      if (marks) touched_.passed.insert(event.node);
      if (marks && whole_.ray) touched_.met.push_back(event.node);
      break;
    case Kind::skip:
      ++counts.nodes_skipped;
      if (marks) touched_.skipped.insert(event.node);
      break;
    case Kind::test:
      ++counts.objects_tested;
      so_far_.missed.insert(event.body);
      break;
    case Kind::hit:
      so_far_.missed.erase(event.body);
      add_hit(event.body);
      break;
  }
  if (++at_ == whole_.walk.size()) so_far_ = whole_;
}

// Of a ray in order along it, else by id.
void RunningFinding::add_hit(BodyId body) {
  std::vector<BodyId>& hits = so_far_.hits;
  if (!whole_.ray) {
    hits.insert(std::ranges::lower_bound(hits, body), body);
    return;
  }
  const auto order = [&](BodyId id) { return std::pair{whole_.met.at(id).distance, id}; };
  hits.insert(std::ranges::lower_bound(hits, order(body), {}, order), body);
  if (whole_.nearest) hits.resize(1);
  FrameRay& ray = *so_far_.ray;
  ray.hits.clear();
  for (const BodyId id : hits) ray.hits.push_back({id, whole_.met.at(id).position});
  if (whole_.nearest) ray.to = ray.hits[0].position;
}

}  // namespace lantern::scenario
