#include <set>

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/words.hpp"
#include "frame/parts/level.hpp"
#include "language/counts.hpp"
#include "run/stage.hpp"
#include "spatial/pairs.hpp"

namespace lantern::run {

// --- what is counted here ---

namespace {

constexpr CountDoc kLevelCounts[] = {
    {"walls", when::compiled, "", "Walls of the level."},
    {"wall_pieces", when::compiled, "", "Walls after lines have cut them."},
    {"sectors", when::compiled, "", "Leaves of the level's BSP."},
    {"sector_pairs", when::compiled, "pair of sectors/pairs of sectors",
     "All pairs of sectors there are."},
    {"cuts", when::compiled, "", "Walls that a line has cut in two."},
    {"lines_tried", when::compiled, "line tried/lines tried",
     "Lines of walls that its compiler tried, to divide regions."},
    {"side_tests", when::compiled, "",
     "Tests that took: on which side of a line a piece of wall lies."},
    {"plane_score", when::compiled, "score", "Score of the line that divides the whole level."},
    {"first_wall_score", when::compiled, "the first wall's score",
     "What the first wall to divide it would have scored."},
    {"sector", when::located, "sector", "Where the last `locate` ended, from 1."},
    {"planes_tested", when::located, "line asked/lines asked",
     "Lines that it asked for the point's side."},
    {"bodies_here", when::located, "in this sector",
     "Bodies in that sector, if the level holds the bodies."},
    {"portals", when::sighted, "", "Openings between two sectors of the level."},
    {"portals_tested", when::sighted, "portal tested/portals tested",
     "How often a portal was held against the view through others."},
    {"visible_pairs", when::sighted, "pair sees each other/pairs see each other",
     "Pairs of sectors that see each other."},
    {"sectors_seen", when::eyed, "sector seen/sectors seen",
     "Sectors that the eye's sector sees, itself among them."},
    {"bodies_seen", when::eyed, "body seen/bodies seen",
     "Bodies in these, if the level holds the bodies."}};

}  // namespace

std::span<const CountDoc> level_counts() { return kLevelCounts; }

LevelStage::LevelStage(const Scenario& scenario)
    : spec_(*scenario.level),
      bounds_(flat(scenario.world.bounds)),
      walls_(walls_of_loops(spec_.loops)) {}

void LevelStage::compile(const Watch& watch) {
  LevelConfig config{.balance_weight = spec_.balance, .cut_weight = spec_.cuts};
  if (spec_.first_wall) config.choose = LevelConfig::Choose::first_wall;
  place_.reset();
  put_away_answers();
  const auto observer = [&](const LevelBsp& level, const LevelEvent& event) {
    using Kind = LevelEvent::Kind;
    if (event.kind == Kind::candidate || event.kind == Kind::divide) return;
    current_ = &level;
    lit_node_ = event.node;
    const bool lights = event.kind == Kind::choose || event.kind == Kind::cut;
    lit_line_ = lights ? event.line : LineChoice();
    constexpr std::string_view kNames[] = {"consider", "", "choose", "cut", "", "sector"};
    watch({kNames[static_cast<int>(event.kind)], told(event)});
  };
  level_.reset();
  visibility_.reset();
  seen_ = nullptr;
  try {
    LevelBsp made = compile_level(walls_, bounds_, config, observer);
    level_.emplace(std::move(made));
  } catch (...) {
    current_ = nullptr;  // what it has looked at is gone
    throw;
  }
  current_ = &*level_;
  side_tests_ += level_->counters().side_tests;
  lit_node_ = kNone;
  lit_line_ = {};
}

// "13 − 11 + 3 · 2 = 8": how far the sides differ, and what the cuts cost.
static std::string score_text(const LineChoice& line, double balance, double cut) {
  const auto [less, more] = std::minmax(line.front, line.back);
  std::string sum = fmt::format("{} − {}", more, less);
  if (balance != 1) sum = fmt::format("{:.4g} · ({})", balance, sum);
  if (line.cuts > 0) sum += fmt::format(" + {:.4g} · {}", cut, line.cuts);
  return fmt::format("{} = {:.4g}", sum, line.score);
}

std::string LevelStage::told(const LevelEvent& event) const {
  using Kind = LevelEvent::Kind;
  switch (event.kind) {
    case Kind::consider:
      return say("A region with {}. Does one of them lie behind another?",
                 say_count(event.line.front, "wall piece/wall pieces"));
    case Kind::choose:
      return say("Wall {} has the best line: {} in front, {} behind, {} cut. Score: {}.",
                 event.line.wall + 1, event.line.front, event.line.back, event.line.cuts,
                 score_text(event.line, spec_.balance, spec_.cuts));
    case Kind::cut:
      return say("The line cuts wall {} in two.", event.line.wall + 1);
    case Kind::sector:
      return say("No wall lies behind another: the region is convex. It becomes sector {}.",
                 event.sector + 1);
    case Kind::candidate:
    case Kind::divide:
      break;
  }
  return {};
}

const LevelBsp& LevelStage::compiled() const {
  if (!level_) throw Refused("the level is not compiled yet");
  return *level_;
}

void LevelStage::put_away_answers() {
  shown_ = Answer::none;
  order_.clear();
  eye_.reset();
}

void LevelStage::locate(const Vec<2>& point) {
  put_away_answers();
  place_ = compiled().locate(point);
  eye_ = point;
  shown_ = Answer::place;
}

void LevelStage::order_from(const Vec<2>& eye) {
  locate(eye);  // its sector is the first
  shown_ = Answer::order;
  compiled().front_to_back(eye, [&](std::uint32_t sector) {
    order_.push_back(sector);
    return true;
  });
}

void LevelStage::see(const std::optional<Vec<2>>& eye, const Watch& watch) {
  const LevelBsp& level = compiled();
  put_away_answers();
  if (!visibility_) {
    const auto observer = [&](const LevelVisibility& so_far) {
      seen_ = &so_far;
      viewer_ = so_far.done == 0 ? kNone : so_far.done - 1;
      watch({viewer_ == kNone ? "portals" : "row", told(so_far)});
    };
    try {
      visibility_.emplace(find_visibility(level, {}, observer));
    } catch (...) {
      seen_ = nullptr;
      throw;
    }
    seen_ = &*visibility_;
    viewer_ = kNone;
  }
  if (!eye) return;
  locate(*eye);
  if (!place_) throw Refused("the eye [{}, {}] lies outside of the world", eye->x, eye->y);
  shown_ = Answer::sights;
}

std::string LevelStage::told(const LevelVisibility& seen) const {
  if (viewer_ == kNone)
    return say("{} between the sectors: openings that one can look through.",
               say_count(seen.portals.size(), "portal/portals"));
  std::uint32_t others = 0;
  for (std::uint32_t s = 0; s < seen.sectors; ++s) others += s != viewer_ && seen.sees(viewer_, s);
  const std::string sees = say("{} of {}", others, say_count(seen.sectors - 1, "other/others"));
  if (viewer_ > 0) return say("Sector {} sees {}.", viewer_ + 1, sees);
  return say(
      "Sector 1 looks through one portal after another, as long as one straight line fits through "
      "all of them. It sees {}.",
      sees);
}

StructureSpec LevelStage::structure() const {
  StructureSpec spec;
  spec.kind = StructureKind::bsp;
  spec.of_level = true;
  std::vector<std::string> ways;  // from the root, by id
  compiled().visit([&](const LevelNodeView& view) {
    std::string way;
    if (view.parent != kNone)
      way = ways[view.parent] + (ways[view.parent].empty() ? "" : ".") +
            (view.slot == 1 ? "front" : "back");
    if (view.plane)
      spec.planes.push_back({"",
                             solid(view.plane->normal * view.plane->offset),
                             solid(view.plane->normal),
                             way.empty() ? "root" : way,
                             {}});
    spec.sectors.push_back(view.sector);
    ways.push_back(std::move(way));
    return true;
  });
  return spec;
}

// The pictures of a level: its walls and sectors, who looks and what is seen, and the counts.

void LevelStage::picture_walls(Frame& frame) const {
  for (std::uint32_t i = 0; i < walls_.size(); ++i)
    frame.add<FrameLevel>().walls.push_back({walls_[i].line.a, walls_[i].line.b, i, kNone,
                                             i == lit_line_.wall ? Mark::lit : Mark::quiet});
}

// Does the one that looks see this sector?
bool LevelStage::is_seen(std::uint32_t sector) const {
  const std::uint32_t from = shown_ == Answer::sights ? place_->sector : viewer_;
  return seen_ && from != kNone && seen_->sees(from, sector);
}

void LevelStage::mark_sector(std::uint32_t sector, FrameNode& node) const {
  const auto at = std::ranges::find(order_, sector);
  if (at != order_.end()) node.order = static_cast<std::uint32_t>(at - order_.begin());
  const bool looks = shown_ == Answer::sights || viewer_ != kNone;
  if ((shown_ != Answer::none && place_ && place_->sector == sector) || viewer_ == sector)
    node.mark = Mark::lit;
  else if (looks && is_seen(sector))
    node.mark = Mark::passed;
  node.unseen = looks && !is_seen(sector);
}

LevelStage::NodeOfSector LevelStage::picture_nodes(const LevelBsp& level, bool holds_bodies,
                                                   Frame& frame) const {
  // Those of the bodies' tree are the same, in the same order; else they stand before these.
  const auto first = holds_bodies ? 0u : static_cast<std::uint32_t>(frame.nodes.size());
  if (!holds_bodies) frame.nodes.resize(first + level.nodes().size());
  LANTERN_CHECK(frame.nodes.size(), ==, first + level.nodes().size());
  std::vector<std::uint32_t> node_of(level.nodes().size(), kNone);
  NodeOfSector sectors(level.sectors().size(), kNone);
  level.visit([&](const LevelNodeView& view) {
    node_of[view.handle] = first + view.id;
    FrameNode& node = frame.nodes[first + view.id];
    node.id = first + view.id;
    node.parent = view.parent == kNone ? kNone : first + view.parent;
    node.slot = view.slot;
    node.depth = view.depth;
    node.leaf = view.leaf;
    node.region = *view.region;
    node.box = frame.bounds;
    if (!node.region.empty()) node.box = solid(box_of(node.region));
    if (view.plane) {
      node.plane = solid(*view.plane);
      node.plane_name = fmt::format("{}", level.nodes()[view.handle].chosen.wall + 1);
    }
    if (view.sector != kNone) {
      sectors[view.sector] = node.id;
      node.label = fmt::format("{}", view.sector + 1);
      node.region = level.sectors()[view.sector].floor;
      mark_sector(view.sector, node);
    } else if (view.parent == kNone) {
      node.label = "root";
    }
    if (view.handle == lit_node_) node.mark = Mark::lit;
    return true;
  });
  // The way down to a place.
  for (std::size_t i = frame.nodes.size(); shown_ != Answer::none && i-- > first + 1;)
    if (frame.nodes[i].mark == Mark::lit ||
        (!frame.nodes[i].leaf && frame.nodes[i].mark != Mark::quiet))
      frame.nodes[frame.nodes[i].parent].mark = Mark::passed;
  for (const WallPiece& piece : level.pieces()) {
    const NodeHandle node = piece.sector != kNone ? level.sectors()[piece.sector].node : piece.node;
    frame.add<FrameLevel>().walls.push_back(
        {piece.line.a, piece.line.b, piece.wall, node == kNone ? kNone : node_of[node],
         piece.wall == lit_line_.wall ? Mark::lit : Mark::quiet});
  }
  return sectors;
}

void LevelStage::picture_sights(const NodeOfSector& nodes, Frame& frame) const {
  if (!seen_) return;
  for (const Portal& p : seen_->portals)
    frame.add<FrameLevel>().portals.push_back({p.line.a, p.line.b, nodes[p.a], nodes[p.b]});
  for (const Sight& s : seen_->sights)
    if (s.from == viewer_ || s.to == viewer_)
      frame.add<FrameLevel>().sights.push_back({s.line.a, s.line.b, nodes[s.from], nodes[s.to]});
}

void LevelStage::picture_matrix(Frame& frame) const {
  if (!level_) return;
  const auto n = static_cast<std::uint32_t>(current_->sectors().size());
  FrameMatrix& matrix = frame.add<FrameMatrix>();
  matrix.rows.assign(n, std::string(n, '.'));
  for (std::uint32_t a = 0; seen_ && a < n; ++a)
    for (std::uint32_t b = 0; b < n; ++b)
      if (a < seen_->done || b < seen_->done) matrix.rows[a][b] = seen_->sees(a, b) ? '1' : '0';
  matrix.lit = shown_ == Answer::sights ? place_->sector : viewer_;
}

// Who is in none of the sectors that are in question.
void LevelStage::dim_bodies(const NodeOfSector& nodes, Frame& frame) const {
  if (!place_ || (shown_ != Answer::place && shown_ != Answer::sights)) return;
  std::set<BodyId> kept;
  for (std::uint32_t s = 0; s < nodes.size(); ++s)
    if (s == place_->sector || (shown_ == Answer::sights && is_seen(s)))
      kept.insert(frame.nodes[nodes[s]].bodies.begin(), frame.nodes[nodes[s]].bodies.end());
  for (FrameBody& body : frame.bodies) body.dimmed = !kept.contains(body.id);
}

void LevelStage::picture_counts(const LevelBsp& level, bool holds_bodies, Frame& frame) const {
  const LevelCounters c = level.counters();
  if (!frame.count("nodes")) {  // of the bodies' tree, if there is one
    const auto leaves = sum_of<std::uint64_t>(frame.nodes, &FrameNode::leaf);
    frame.add_count("nodes", c.nodes);
    frame.add_count("leaves", leaves);
    frame.add_count("depth", c.depth);
  }
  if (holds_bodies)
    for (auto& [name, n] : frame.counts)
      if (name == "tests_so_far") n += static_cast<std::int64_t>(side_tests_);
  frame.add_count("walls", c.walls);
  frame.add_count("wall_pieces", c.pieces);
  frame.add_count("sectors", c.sectors);
  frame.add_count("sector_pairs", all_pairs(c.sectors));
  frame.add_count("cuts", c.cuts);
  frame.add_count("lines_tried", c.candidates);
  frame.add_count("side_tests", c.side_tests);
  const LevelNode& root = level.nodes()[0];
  if (!root.is_leaf()) {
    frame.add_count("plane_score", static_cast<std::uint64_t>(root.chosen.score));
    frame.add_count("first_wall_score", static_cast<std::uint64_t>(root.first.score));
  }
}

void LevelStage::count_answers(const NodeOfSector& nodes, bool holds_bodies, Frame& frame) const {
  const auto bodies_in = [&](const auto& wanted) {
    std::set<BodyId> bodies;
    for (std::uint32_t s = 0; holds_bodies && s < nodes.size(); ++s)
      if (wanted(s))
        bodies.insert(frame.nodes[nodes[s]].bodies.begin(), frame.nodes[nodes[s]].bodies.end());
    return bodies.size();
  };
  if (place_) {
    frame.add_count("sector", place_->sector + 1);
    frame.add_count("planes_tested", place_->nodes_visited - 1);
    frame.add_count("bodies_here", bodies_in([&](auto s) { return s == place_->sector; }));
  }
  if (!seen_) return;
  const std::uint64_t n = seen_->sectors;
  frame.add_count("portals", seen_->portals.size());
  frame.add_count("portals_tested", seen_->portals_tested);
  frame.add_count("visible_pairs", seen_->sights.size());
  if (!place_ || !visibility_) return;
  const auto sees = [&](std::uint32_t s) { return seen_->sees(place_->sector, s); };
  std::uint64_t seen = 0;
  for (std::uint32_t s = 0; s < n; ++s) seen += sees(s);
  frame.add_count("sectors_seen", seen);
  frame.add_count("bodies_seen", bodies_in(sees));
}

void LevelStage::picture(bool holds_bodies, Frame& frame) const {
  FrameLevel& told = frame.add<FrameLevel>();
  told.eye = eye_;
  told.front = lit_line_.front;
  told.back = lit_line_.back;
  if (!current_) return picture_walls(frame);
  const bool holds = holds_bodies && level_;  // not while it is compiled anew
  // A frame has one structure: where bodies have another one, of the level only walls are seen.
  const bool shows = holds || frame.structure == StructureKind::none;
  NodeOfSector nodes;
  if (shows)
    nodes = picture_nodes(*current_, holds, frame);
  else
    picture_walls(frame);
  picture_counts(*current_, holds, frame);
  if (!level_) return;
  if (shows) picture_sights(nodes, frame);
  if (holds) dim_bodies(nodes, frame);
  count_answers(nodes, holds, frame);
}

}  // namespace lantern::run
