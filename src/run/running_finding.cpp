#include "run/running_finding.hpp"

#include <algorithm>

namespace lantern::run {

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
      hits_.push_back(event.body);
      break;
  }
  ++at_;
}

// Hits of a ray in order along it, else by id.
Finding RunningFinding::so_far() const {
  if (at_ == whole_.walk.size()) return whole_;
  Finding found = so_far_;
  found.hits = hits_;
  if (!whole_.ray) {
    std::ranges::sort(found.hits);
    return found;
  }
  const auto order = [&](BodyId id) { return std::pair{whole_.met.at(id).distance, id}; };
  std::ranges::sort(found.hits, {}, order);
  if (whole_.nearest && !found.hits.empty()) found.hits.resize(1);
  for (const BodyId id : found.hits) found.ray->hits.push_back({id, whole_.met.at(id).position});
  if (whole_.nearest && !found.hits.empty()) found.ray->to = found.ray->hits[0].position;
  return found;
}

}  // namespace lantern::run
