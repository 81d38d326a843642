#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/stop.hpp"
#include "measure/boxes/bench.hpp"
#include "measure/broad_phase_cost.hpp"
#include "measure/solvers.hpp"
#include "spatial/box_table.hpp"
#include "spatial/query.hpp"

namespace lantern::measure {

namespace {

template <int D>
const BoxUpdates<D>& updates_in(const BoxStage& stage) {
  return std::get<BoxUpdates<D>>(stage.scene.boxes);
}
template <int D>
const Questions<D>& questions_in(const BoxStage& stage) {
  return std::get<Questions<D>>(stage.questions);
}

// --- how one is run ---

// One that finds pairs, whoever it is.
template <int D>
class PeerPairs : public BoxRun {
 public:
  PeerPairs(const BoxStage& stage, const BoxPeer& peer, std::unique_ptr<PairFinder<D>> finder)
      : scene_(updates_in<D>(stage)), peer_(peer), finder_(std::move(finder)) {}

  void step(std::size_t frame) override {
    pairs_.clear();
    finder_->find(scene_.frames[frame], pairs_);
    into_order(pairs_, static_cast<std::uint32_t>(scene_.frames[frame].size()));
  }
  const std::vector<Pair>& found() const override { return pairs_; }
  std::optional<std::uint64_t> allocations() const override {
    return peer_.allocations ? std::optional(peer_.allocations()) : std::nullopt;
  }

 private:
  const BoxUpdates<D>& scene_;
  const BoxPeer& peer_;
  std::unique_ptr<PairFinder<D>> finder_;
  std::vector<Pair> pairs_;
};

// Told once of what never moves, as the others are; `auto` of the others only that they move.
template <int D>
class OwnPairs : public BoxRun {
 public:
  OwnPairs(const BoxStage& stage, const BroadPhaseConfig<D>& config)
      : scene_(updates_in<D>(stage)),
        some_rest_(std::ranges::any_of(scene_.frames[0], &Proxy<D>::is_static)),
        follows_(some_rest_ || config.kind == StructureKind::automatic),
        broad_phase_(config) {}

  void step(std::size_t frame) override {
    const std::vector<Proxy<D>>& boxes = scene_.frames[frame];
    if (!follows_ || !std::exchange(told_, true)) return broad_phase_.update(boxes);
    if (!some_rest_) return broad_phase_.follow(boxes);
    moving_.clear();
    std::ranges::copy_if(boxes, std::back_inserter(moving_), std::not_fn(&Proxy<D>::is_static));
    broad_phase_.follow(moving_);
  }
  const std::vector<Pair>& found() const override { return broad_phase_.pairs(); }
  std::optional<std::uint64_t> allocations() const override {
    return broad_phase_.counters().allocations;
  }
  BoxCounts counts() const override {
    const BroadPhaseCounters& c = broad_phase_.counters();
    const Counters tree = broad_phase_.dynamic().counters();
    const auto number = [](std::uint64_t n) { return static_cast<double>(n); };
    return {number(c.pair_tests), number(tree.box_tests), number(c.nodes_visited),
            number(tree.nodes), number(tree.entries)};
  }

 private:
  const BoxUpdates<D>& scene_;
  bool some_rest_, follows_, told_ = false;
  BroadPhase<D> broad_phase_;
  std::vector<Proxy<D>> moving_;
};

template <int D>
class OwnOracle : public Oracle<D> {
 public:
  explicit OwnOracle(const BroadPhaseConfig<D>& config) : broad_phase_(config) {}

  void build(Boxes<D> boxes) override { broad_phase_.build(boxes); }
  void along(const Ray<D>& ray, std::vector<BodyId>& ids) override { inside(ray, ids); }
  bool first(const Ray<D>& ray, std::vector<BodyId>& ids) override {
    const NearestHit nearest = raycast_nearest(broad_phase_.dynamic(), ray);
    if (nearest.hit) ids.push_back(nearest.hit->id);
    counts_ += nearest.counts;
    return true;
  }
  void within(const Box<D>& box, std::vector<BodyId>& ids) override { inside(box, ids); }
  void within(const Ball<D>& ball, std::vector<BodyId>& ids) override { inside(ball, ids); }
  bool nearest(const Vec<D>& point, std::vector<BodyId>& ids) override {
    const NearestBody nearest = nearest_body(broad_phase_.dynamic(), point);
    ids.push_back(nearest.body.value().id);
    counts_ += nearest.counts;
    return true;
  }
  std::optional<QueryCounts> counts() const override { return counts_; }

 private:
  template <class Volume>
  void inside(const Volume& volume, std::vector<BodyId>& ids) {
    found_ = overlap_query(broad_phase_.dynamic(), volume, {}, {}, std::move(found_));
    ids.insert(ids.end(), found_.ids.begin(), found_.ids.end());
    counts_ += found_.counts;
  }

  BroadPhase<D> broad_phase_;
  Found found_;
  QueryCounts counts_;
};

// One that is asked, whoever it is. It is built before the first step.
template <int D>
class Asked : public BoxRun {
 public:
  Asked(const BoxStage& stage, std::unique_ptr<Oracle<D>> oracle)
      : task_(stage.task),
        boxes_(updates_in<D>(stage).frames[0]),
        questions_(questions_in<D>(stage)),
        oracle_(std::move(oracle)) {
    oracle_->build(boxes_);
  }

  void step(std::size_t) override {
    before_ = oracle_->counts();
    found_.clear();
    for (std::uint32_t i = 0; i < kQuestions; ++i) {
      ids_.clear();
      ask(i);
      std::ranges::sort(ids_);
      for (const BodyId id : ids_) found_.push_back({i, id});
    }
  }
  const std::vector<Pair>& found() const override { return found_; }
  // Of a question, in the mean.
  BoxCounts counts() const override {
    const std::optional<QueryCounts> now = oracle_->counts();
    if (!now || !before_) return {};
    const auto mean = [](std::uint64_t from, std::uint64_t to) {
      return static_cast<double>(to - from) / static_cast<double>(kQuestions);
    };
    return {.pair_tests = mean(before_->objects_tested, now->objects_tested),
            .box_tests = mean(before_->boxes_compared, now->boxes_compared),
            .nodes_visited = mean(before_->nodes_visited, now->nodes_visited),
            .nodes = {},
            .entries = {}};
  }

 private:
  void ask(std::size_t i) {
    if (task_ == BoxTask::nearest) {
      oracle_->nearest(questions_.balls[i].center, ids_);
      return;
    }
    if (task_ == BoxTask::rays) return oracle_->along(questions_.rays[i], ids_);
    if (task_ == BoxTask::boxes) return oracle_->within(questions_.boxes[i], ids_);
    if (task_ == BoxTask::balls) return oracle_->within(questions_.balls[i], ids_);
    if (!oracle_->first(questions_.rays[i], ids_)) keep_first(questions_.rays[i]);
  }

  void keep_first(const Ray<D>& ray) {
    std::optional<RayHit> best;
    for (const BodyId id : ids_)
      if (const auto span = span_in(ray, boxes_[id].box))
        if (const RayHit hit{id, span->from}; !best || RayHit::before(hit, *best)) best = hit;
    ids_.clear();
    if (best) ids_.push_back(best->id);
  }

  BoxTask task_;
  Boxes<D> boxes_;
  const Questions<D>& questions_;
  std::unique_ptr<Oracle<D>> oracle_;
  std::optional<QueryCounts> before_;
  std::vector<BodyId> ids_;
  std::vector<Pair> found_;
};

// --- who takes part ---

constexpr int kMostDepth = 16;
constexpr std::array kMargins = {0.0, 0.05, 0.1, 0.2, 0.4};

template <int D>
std::unique_ptr<BoxRun> own_run(StructureKind kind, bool mends, const BoxStage& stage,
                                const BoxSetting& s) {
  const StructureTraits traits = traits_of(kind);
  BroadPhaseConfig<D> config;
  config.kind = kind;
  config.mends = mends;
  config.build = Build::at_once;
  config.bounds = updates_in<D>(stage).bounds;
  if (traits.has(Setting::levels)) config.levels = 1u << s.first;
  if (traits.has(Setting::margin)) config.margin = kMargins[static_cast<std::size_t>(s.first)];
  config.capacity = 1u << s.first;
  config.max_depth = static_cast<std::uint32_t>(s.second);
  if (traits.has(Setting::planes))
    config.planes =
        median_planes<D>(updates_in<D>(stage).frames[0], config.capacity, config.max_depth);
  if (stage.task == BoxTask::pairs) return std::make_unique<OwnPairs<D>>(stage, config);
  return std::make_unique<Asked<D>>(stage, std::make_unique<OwnOracle<D>>(config));
}

BoxContestant own_contestant(StructureKind kind, bool mends = true) {
  const StructureTraits traits = traits_of(kind);
  const bool splits = traits.splits || traits.has(Setting::planes);  // these at the medians
  BoxContestant who{.name = std::string(to_string(kind))};
  who.can = [=](const BoxStage& stage) { return is_possible(kind, stage.dimension()); };
  // Leaves of 16 that are about as large as their bodies' shares of the world.
  // Of a grid 2^first levels; of an aabb_tree one of the margins.
  who.likely = [=, name = who.name](const BoxStage& stage) -> BoxSetting {
    if (!splits) return {};
    const double children = std::pow(2.0, halved_axes(name, stage.dimension()));
    const double leaves = std::max(1.0, static_cast<double>(stage.bodies()) / 8);
    return {4, std::clamp(static_cast<int>(std::lround(std::log(leaves) / std::log(children))), 1,
                          kMostDepth)};
  };
  who.has = [=](const BoxSetting& s) {
    if (traits.has(Setting::levels)) return s.first >= 0 && s.first <= 3 && s.second == 0;
    if (traits.has(Setting::margin))
      return s.first >= 0 && s.first < static_cast<int>(kMargins.size()) && s.second == 0;
    if (!splits) return s == BoxSetting{};
    return s.first >= 1 && s.first <= 9 && s.second >= 1 && s.second <= kMostDepth;
  };
  who.words = [=](const BoxSetting& s) -> std::string {
    if (traits.has(Setting::levels)) return counted(1 << s.first, "level");
    if (traits.has(Setting::margin))
      return fmt::format("margin {:g}", kMargins[static_cast<std::size_t>(s.first)]);
    return splits ? fmt::format("capacity {}, depth limit {}", 1 << s.first, s.second) : "";
  };
  who.start = [=](const BoxStage& stage, const BoxSetting& s) {
    return stage.dimension() == 2 ? own_run<2>(kind, mends, stage, s)
                                  : own_run<3>(kind, mends, stage, s);
  };
  return who;
}

template <int D>
std::unique_ptr<BoxRun> peer_run(const BoxPeer& peer, const BoxPeer::Maker<PairFinder<D>>& finder,
                                 const BoxPeer::Maker<Oracle<D>>& oracle, const BoxStage& stage,
                                 const BoxSetting& setting) {
  const auto place = static_cast<std::size_t>(setting.first);
  if (stage.task != BoxTask::pairs) return std::make_unique<Asked<D>>(stage, oracle(place));
  return std::make_unique<PeerPairs<D>>(stage, peer, finder(place));
}

BoxContestant peer_contestant(BoxPeer told) {
  const auto peer = std::make_shared<const BoxPeer>(std::move(told));
  BoxContestant who{.name = peer->name, .version = peer->version, .how = peer->how};
  who.can = [peer](const BoxStage& stage) {
    const bool flat = stage.dimension() == 2;
    if (stage.task == BoxTask::pairs) return flat ? bool(peer->pairs_2d) : bool(peer->pairs_3d);
    if (stage.task == BoxTask::nearest && !peer->finds_nearest) return false;
    return flat ? bool(peer->oracle_2d) : bool(peer->oracle_3d);
  };
  who.likely = [](const BoxStage&) { return BoxSetting{}; };
  who.has = [peer](const BoxSetting& s) {
    return s.second == 0 && s.first >= 0 && s.first < static_cast<int>(peer->settings.size());
  };
  who.words = [peer](const BoxSetting& s) {
    return peer->settings[static_cast<std::size_t>(s.first)];
  };
  who.start = [peer](const BoxStage& stage, const BoxSetting& s) {
    return stage.dimension() == 2 ? peer_run<2>(*peer, peer->pairs_2d, peer->oracle_2d, stage, s)
                                  : peer_run<3>(*peer, peer->pairs_3d, peer->oracle_3d, stage, s);
  };
  return who;
}

constexpr PeerModule kBoxModules[] = {
    {"CGAL", "lantern_peer_boxes_cgal.so", "libcgal-dev"},
    {"Boost", "lantern_peer_boxes_boost.so", "libboost-dev"},
    {"Bullet", "lantern_peer_boxes_bullet.so", "libbullet-dev"},
    {"Box2D", "lantern_peer_boxes_box2d.so", "libbox2d-dev"},
};

}  // namespace

int halved_axes(const std::string& tree, int dimension) {
  return tree == "kd_tree" || tree == "bsp" ? 1 : dimension;
}

std::vector<BoxContestant> own_box_contestants() {
  std::vector<BoxContestant> all;
  const auto automatic = structure_named("auto");
  if (automatic) {
    all.push_back(own_contestant(*automatic));
    // The same, but built anew in each step.
    all.push_back(own_contestant(*automatic, false));
    all.back().name += "_anew";
    all.back().can = [](const BoxStage& stage) { return stage.task == BoxTask::pairs; };
  }
  for (const StructureKind kind : known_structures())
    if (kind != automatic) all.push_back(own_contestant(kind));
  return all;
}

std::vector<BoxContestant> peer_box_contestants(std::vector<std::string>& missing) {
  return mapped(peers_of<BoxPeer>(kBoxModules, "lantern_box_peers", missing),
                [](BoxPeer& peer) { return peer_contestant(std::move(peer)); });
}

std::vector<std::string> box_peer_names(std::vector<std::string>& missing) {
  return mapped(peers_of<BoxPeer>(kBoxModules, "lantern_box_peers", missing),
                [](const BoxPeer& peer) { return peer.name + " " + peer.version; });
}

void into_order(std::vector<Pair>& pairs, std::uint32_t bodies) {
  thread_local FoundPairs found;
  thread_local PairOrder order;
  found.clear();
  found.reserve(pairs.size(), 0);
  for (const Pair& pair : pairs) found.add(pair.a, pair.b);
  order.order(found, bodies, {}, pairs);
}

// --- what is to be found ---

BoxTruth::BoxTruth(const BoxStage& stage, std::size_t frame) {
  stage.dimension() == 2 ? force<2>(stage, frame) : force<3>(stage, frame);
}

template <int D>
void BoxTruth::force(const BoxStage& stage, std::size_t frame) {
  const std::vector<Proxy<D>>& boxes = std::get<BoxUpdates<D>>(stage.scene.boxes).frames[frame];
  if (stage.task != BoxTask::pairs)
    answer<D>(stage);
  else if (boxes.size() <= kMostForced)
    truth_ = pairs_by_force<D>(boxes);
  else
    force_sample<D>(boxes);
}

template <int D>
void BoxTruth::force_sample(Boxes<D> boxes) {
  is_sample_ = true;
  stride_ = boxes.size() / kSample;
  for (std::size_t i = 0; i < boxes.size(); i += stride_) {
    stop_if_asked();
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (j == i || (j % stride_ == 0 && j < i)) continue;
      if ((boxes[i].is_static && boxes[j].is_static) || !overlap(boxes[i].box, boxes[j].box))
        continue;
      truth_.push_back({std::min(boxes[i].id, boxes[j].id), std::max(boxes[i].id, boxes[j].id)});
    }
  }
  std::ranges::sort(truth_);
}

template <int D>
void BoxTruth::answer(const BoxStage& stage) {
  const Boxes<D> boxes = std::get<BoxUpdates<D>>(stage.scene.boxes).frames[0];
  const auto& q = std::get<Questions<D>>(stage.questions);
  for (std::uint32_t i = 0; i < kQuestions; ++i) {
    stop_if_asked();
    std::optional<RayHit> best;
    std::optional<Neighbour> nearest;
    for (const Proxy<D>& body : boxes) {
      if (stage.task == BoxTask::nearest) {
        const Neighbour one{body.id, square_of(gaps<D>(q.balls[i].center, body.box))};
        if (!nearest || Neighbour::before(one, *nearest)) nearest = one;
        continue;
      }
      const auto span = span_in(q.rays[i], body.box);
      const bool is_met = stage.task == BoxTask::boxes   ? overlap(q.boxes[i], body.box)
                          : stage.task == BoxTask::balls ? overlap(q.balls[i], body.box)
                                                         : span.has_value();
      if (!is_met) continue;
      if (stage.task != BoxTask::first_hits)
        truth_.push_back({i, body.id});
      else if (const RayHit hit{body.id, span->from}; !best || RayHit::before(hit, *best))
        best = hit;
    }
    if (best) truth_.push_back({i, best->id});
    if (nearest) truth_.push_back({i, nearest->id});
  }
}

BoxTruth::Verdict BoxTruth::judge(std::span<const Pair> found) const {
  if (!is_sample_) return {count_missing(truth_, found), count_missing(found, truth_)};
  std::vector<Pair> of_sample;
  for (const Pair& pair : found)
    if (pair.a % stride_ == 0 || pair.b % stride_ == 0) of_sample.push_back(pair);
  return {count_missing(truth_, of_sample), count_missing(of_sample, truth_)};
}

std::string BoxTruth::words() const {
  if (!is_sample_) return "brute force";
  return fmt::format("brute force of every {}th body", stride_);
}

}  // namespace lantern::measure
