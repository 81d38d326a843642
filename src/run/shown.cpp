#include "run/shown.hpp"

#include <algorithm>

#include "base/hash.hpp"
#include "frame/parts/level.hpp"
#include "geometry/elementary.hpp"
#include "geometry/flat.hpp"
#include "language/counts.hpp"

namespace lantern::run {

// --- what is counted here ---

namespace {

constexpr CountDoc kNarrowCounts[] = {
    {"shapes_tested", when::shapes, "pair tested/pairs tested",
     "Pairs whose shapes the last `test_shapes` has tested."},
    {"narrow_work", when::shapes, "length measured/lengths measured",
     "Lengths along a direction that these tests measured: of two discs 1, of a disc and a box 3, "
     "of two boxes 3 for each axis that was needed; more in a 3D world."},
    {"touching", when::shapes, "pair touches/pairs touch", "Pairs that it found to touch."},
    {"axes_tested", when::separated, "axis tested/axes tested",
     "Axes along which the last `separate` has measured its bodies."},
    {"gjk_steps", when::searched, "search/searches",
     "Points of the difference that the last `gjk` has asked for."}};
constexpr CountDoc kNarrowMeasures[] = {
    {"gap", when::separated, "",
     "How far the last `separate` found its bodies apart along the axis that parts them; 0 if none "
     "does.",
     Most::size, "units"},
    {"overlap", when::separated, "",
     "Where none parts them, how far they overlap along the best one.", Most::size, "units"},
    {"distance", when::searched, "", "Of the bodies of the last `gjk`; 0 if they overlap.",
     Most::size, "units"}};

constexpr std::size_t kMostInFocus = 3;  // of more, nobody stands out

// Of each node its way down from the root: a node that is made anew at the same place is the
// same.
std::vector<std::uint64_t> places_of(const Frame& frame) {
  std::vector<std::uint64_t> places;
  places.reserve(frame.nodes.size());
  for (const FrameNode& node : frame.nodes) {
    const std::uint64_t parent = node.parent == kNone ? 0 : places[node.parent];
    Hash hash;
    hash.add(parent).add(std::uint64_t{node.slot}).add(std::uint64_t{node.of_static});
    // A grid's cells may have been made larger or smaller.
    if (!frame.get<FrameStructure>().grid_levels.empty() && node.leaf)
      hash.add(node.box.lo.x).add(node.box.lo.y).add(node.box.hi.x);
    places.push_back(hash.value());
  }
  return places;
}

bool holds_any(const FrameNode& leaf, const std::set<BodyId>& bodies) {
  return std::ranges::any_of(leaf.bodies, [&](BodyId id) { return bodies.contains(id); });
}

// Parents stand before children, so one pass from the back hands the light up.
void pass_to(Frame& frame) {
  for (std::size_t i = frame.nodes.size(); i-- > 0;) {
    const FrameNode& node = frame.nodes[i];
    if (node.mark == Mark::quiet || node.parent == kNone) continue;
    Mark& above = frame.nodes[node.parent].mark;
    if (above == Mark::quiet) above = Mark::passed;
  }
}

void put_out(Frame& frame) {
  for (FrameBody& body : frame.bodies) body.lit = false;
  for (FrameNode& node : frame.nodes) node.mark = Mark::quiet;
  for (FramePair& pair : frame.pairs) pair.lit = false;
  if (auto* islands = frame.find<FrameIslands>())
    for (FrameEdge& edge : islands->edges) edge.lit = false;
  if (auto* level = frame.find<FrameLevel>())
    for (FrameWall& wall : level->walls) wall.mark = Mark::quiet;
}

bool is_all_that_move(const std::set<BodyId>& focus, const Frame& frame) {
  return focus.size() > 1 && std::ranges::all_of(frame.bodies, [&](const FrameBody& body) {
           return body.is_static || focus.contains(body.id);
         });
}

// At rest at both ends.
double eased(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// As wide as it says, in the world's proportions, moved into the world.
Box<2> part_of(const Box<2>& bounds, const ViewSpec& view) {
  const Vec<2> size = bounds.size() * (view.width / bounds.size().x);
  const Vec<2> lo =
      glm::clamp(flat(*view.at) - size / 2.0, bounds.lo, glm::max(bounds.lo, bounds.hi - size));
  return {lo, lo + size};
}

// Counter-clockwise as seen from above.
Vec<3> turned_about(const Vec<3>& middle, const Vec<3>& p, double angle) {
  const Vec<3> way = p - middle;
  const auto [s, c] = geometry::sin_cos(angle);
  return middle + Vec<3>(c * way.x + s * way.z, way.y, c * way.z - s * way.x);
}

}  // namespace

std::span<const CountDoc> narrow_counts() { return kNarrowCounts; }
std::span<const CountDoc> narrow_measures() { return kNarrowMeasures; }

void Lighting::light(const Cause& cause, Frame& frame) const {
  if (frame.index == 0 && !cause.midst) return put_out(frame);
  const std::size_t n = cause.focus.size();
  const bool all = (cause.verb.passes_time && is_all_that_move(cause.focus, frame)) ||
                   (cause.verb.asks && n > 1 && n == frame.bodies.size());
  const bool few = !all && n <= kMostInFocus;
  for (FrameBody& body : frame.bodies)
    body.lit = (few || (cause.verb.asks && !all)) && cause.focus.contains(body.id);
  light_nodes(cause, few, frame);
  light_pairs(few, frame);
  light_edges(frame);
}

const LitSpec* light_only(const std::vector<LitSpec>& lit, Frame& frame) {
  put_out(frame);
  const LitSpec* strange = nullptr;
  std::set<BodyId> ids;
  for (const LitSpec& spec : lit) {
    bool found = false;
    for (FrameBody& body : frame.bodies)
      if (body.name == spec.name) found = body.lit = ids.insert(body.id).second;
    for (FrameNode& node : frame.nodes)
      if (node.label == spec.name) node.mark = Mark::lit, found = true;
    if (!found && !strange) strange = &spec;
  }
  for (FramePair& p : frame.pairs) p.lit = ids.contains(p.pair.a) && ids.contains(p.pair.b);
  pass_to(frame);
  return strange;
}

void light_held(std::string_view name, Frame& frame) {
  for (Frame& side : frame.sides) light_held(name, side);
  put_out(frame);
  for (FrameBody& body : frame.bodies) {
    if (body.name != name) continue;
    body.lit = true;
    for (FrameNode& node : frame.nodes)
      if (node.leaf && holds_any(node, {body.id})) node.mark = Mark::lit;
    for (FramePair& p : frame.pairs) p.lit = p.pair.a == body.id || p.pair.b == body.id;
  }
  pass_to(frame);
}

void Lighting::light_nodes(const Cause& cause, bool few, Frame& frame) const {
  const bool marked = std::ranges::any_of(
      frame.nodes, [](const FrameNode& node) { return node.mark != Mark::quiet; });
  if (marked) {
    // A question lights where it has found something, of all that it went through.
    if (cause.verb.asks && !cause.midst && frame.nodes.size() > 1)
      for (FrameNode& node : frame.nodes)
        if (node.leaf && node.mark == Mark::passed && holds_any(node, cause.focus))
          node.mark = Mark::lit;
    return;
  }
  if (cause.midst || frame.nodes.size() < 2) return;
  if (few && !cause.focus.empty()) {
    for (FrameNode& node : frame.nodes)
      if (node.leaf && holds_any(node, cause.focus)) node.mark = Mark::lit;
    return pass_to(frame);
  }
  if (places_.empty()) return;
  const std::vector<std::uint64_t> places = places_of(frame);
  std::vector<std::size_t> fresh;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::ranges::binary_search(places_, places[i])) fresh.push_back(i);
  if (2 * fresh.size() > places.size()) return;  // nearly all are
  for (const std::size_t i : fresh) frame.nodes[i].mark = Mark::lit;
  pass_to(frame);
}

void Lighting::light_pairs(bool few, Frame& frame) const {
  if (const auto at = frame.get<FrameStructure>().swept_to) {
    for (FramePair& p : frame.pairs) p.lit = p.pair.a == *at || p.pair.b == *at;
    return;
  }
  std::size_t fresh = 0;
  auto before = pairs_.begin();  // both lists ascend
  for (FramePair& p : frame.pairs) {
    while (before != pairs_.end() && *before < p.pair) ++before;
    p.lit = before == pairs_.end() || *before != p.pair;
    fresh += p.lit;
  }
  if (few || 2 * fresh <= frame.pairs.size()) return;
  for (FramePair& p : frame.pairs) p.lit = false;
}

// Where nothing held together before, all of it is new.
void Lighting::light_edges(Frame& frame) const {
  auto* islands = frame.find<FrameIslands>();
  if (!islands) return;
  for (FrameEdge& edge : islands->edges)
    edge.lit = !edges_.empty() && !std::ranges::binary_search(edges_, edge.pair);
}

void Lighting::remember(const Frame& frame, bool midst) {
  pairs_.clear();
  for (const FramePair& p : frame.pairs) pairs_.push_back(p.pair);
  edges_.clear();
  for (const FrameEdge& e : frame.get<FrameIslands>().edges) edges_.push_back(e.pair);
  if (midst) return;
  places_ = places_of(frame);
  std::ranges::sort(places_);
}

Looks::Looks(const Scenario& scenario) : scenario_(scenario) {
  const WorldSpec& world = scenario.world;
  if (world.has_camera) from_ = Camera{world.camera_eye, world.camera_target};
  for (const Step& step : scenario.steps) goes_round_ |= step.orbit != 0;
}

void Looks::begin(const Step& step, double time) {
  if (step_) angle_ = angle_at(time);
  step_ = &step;
  began_ = time;
  seconds_ = seconds_of(step.verb, scenario_.world.time_step);
  if (step.view) {
    view_.reset();
    if (step.view->at) view_ = part_of(flat(scenario_.world.bounds), *step.view);
  }
  if (!step.camera) return;
  from_ = Camera{step.camera->eye, step.camera->target};
  angle_ = 0;
}

// A step in which no time passes has gone all its way.
double Looks::angle_at(double time) const {
  return angle_ + step_->orbit * eased(seconds_ > 0 ? (time - began_) / seconds_ : 1);
}

void Looks::show(Frame& frame) const {
  frame.display = step_->display.value_or(scenario_.display);
  frame.view = view_;
  if (frame.dimension == 3) aim(frame);
}

void Looks::aim(Frame& frame) const {
  frame.camera = from_;
  if (!goes_round_) return;
  Camera camera = from_.value_or(usual_camera(frame.bounds));
  camera.eye = turned_about(camera.target, camera.eye, angle_at(frame.time));
  camera.goes_round = true;
  frame.camera = camera;
}

void NarrowShown::show(ShapeTests tests) {
  tests_ = std::move(tests);
  drawn_ = Drawn::tests;
}

void NarrowShown::show(FrameSeparation separation) {
  separation_ = std::move(separation);
  drawn_ = Drawn::separation;
}

void NarrowShown::show(FrameSearch search) {
  search_ = std::move(search);
  drawn_ = Drawn::search;
}

void NarrowShown::add_to(Frame& frame, const Engine& engine) const {
  if (tests_) {
    if (drawn_ == Drawn::tests) frame.tested = tests_->tested;
    if (drawn_ == Drawn::tests) frame.contacts = tests_->touching;
    frame.add_count("shapes_tested", tests_->tested.size());
    frame.add_count("narrow_work", tests_->work);
    frame.add_count("touching", tests_->touching.size());
  }
  if (separation_) {
    if (drawn_ == Drawn::separation) frame.put(separation_);
    frame.add_count("axes_tested", separation_->axes.size());
    frame.measures.emplace_back("gap", separation_->gap());
    frame.measures.emplace_back("overlap", separation_->overlap());
  }
  if (search_) {
    if (drawn_ == Drawn::search) frame.put(search_);
    frame.add_count("gjk_steps", search_->steps.size());
    if (search_->answer) frame.measures.emplace_back("distance", search_->answer->distance);
  }
  if (!shows(frame.panels, "difference")) return;
  if (search_) frame.put(engine.difference(search_->a, search_->b));
  std::vector<BodyId> there;
  for (const FrameBody& body : frame.bodies)
    if (!std::holds_alternative<HalfSpace<3>>(body.shape)) there.push_back(body.id);
  if (!frame.find<FrameDifference>() && there.size() > 1)
    frame.put(engine.difference(there[0], there[1]));
}

std::optional<std::pair<Vec<3>, Vec<3>>> ends_of(const RulerSpec& ruler, const Engine* engine) {
  std::vector<BodyState> states;
  if (engine && (ruler.a || ruler.b)) engine->observe(states);
  const auto end = [&](const std::optional<std::size_t>& body,
                       const Vec<3>& point) -> std::optional<Vec<3>> {
    if (!body) return point;
    if (*body >= states.size() || !states[*body].there) return std::nullopt;
    return states[*body].position;
  };
  const auto from = end(ruler.a, ruler.from), to = end(ruler.b, ruler.to);
  if (!from || !to) return std::nullopt;
  return std::pair{*from, *to};
}

}  // namespace lantern::run
