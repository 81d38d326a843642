// The graph of islands: a node where each body is, an edge for what holds two of them together, and
// one ground under all that hang together. What never moves is drawn as it is: a dotted line to
// where it is touched joins nothing.
//
//     _______ island 1     ___
//    ( o - o )            | o |  island 2
//     `--.\o/             |_o_|
#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/panel.hpp"
#include "draw/projection.hpp"
#include "frame/parts/motion.hpp"
#include "geometry/flat.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

using frame::FrameEdge;
using frame::FrameIsland;

constexpr double kMostNodeRadius = 25;
constexpr double kLeastNodeRadius = 8;
constexpr double kShore = 10;   // of an island's ground, around its nodes
constexpr double kCoast = 1.8;  // the line around it
constexpr std::size_t kMostNumbered = 12;
constexpr std::size_t kMostIslandNodes = 400;
const TextStyle kIslandName{24, Weight::semibold, Role::ink, Role::panel};

std::unique_ptr<Projection> projection_of(const Frame& frame, const Box<2>& panel) {
  if (frame.dimension == 3) return std::make_unique<View3D>(frame.bounds, frame.camera, panel);
  return std::make_unique<View2D>(flat(frame.bounds), panel, frame.view);
}

class IslandGraph : PanelPicture {
 public:
  explicit IslandGraph(const PanelPicture& on) : PanelPicture(on) {
    for (const FrameBody& body : frame_.bodies)
      if (!is_half_space(body))
        if (const auto at = view_->seen(body.position)) places_[body.id] = *at;
  }

  void draw() {
    list_.crisp_rect(place_, Role::panel);
    const std::size_t first = list_.shapes.size();
    // Thick strokes along the graph: first the coasts, then the grounds over all but their rims.
    for (const bool coast : {true, false})
      for (const FrameIsland& island : frame_.get<FrameIslands>().islands)
        draw_ground(island, coast);
    draw_statics();
    for (const FrameEdge& edge : frame_.get<FrameIslands>().edges) draw_edge(edge);
    std::size_t nodes = 0;
    for (const FrameBody& body : frame_.bodies)
      if (!body.is_static && places_.contains(body.id) && ++nodes <= kMostIslandNodes)
        draw_node(body);
    keep_within(list_, first, place_);
    list_.crisp_rect(place_, Role::none, {Role::cell_line_2, 1.8});
    if (nodes > kMostIslandNodes) labels_.add_note(word("not all bodies are drawn"), place_);
    name_islands();
    list_.referents.insert({"islands", "largest_island", "islands_asleep", "asleep", "awake"});
  }

 private:
  // As most bodies have room for; the same on all frames of the group, so that none grows when
  // another one enters.
  double radius_for(const Staging& staging) const {
    std::map<BodyId, double> halves;
    for (const Frame* frame : staging.frames())
      for (const FrameBody& body : frame->bodies)
        if (!body.is_static) halves.try_emplace(body.id, thickness(body.shape, frame->dimension));
    std::vector<double> sorted = mapped(halves, [](const auto& entry) { return entry.second; });
    if (sorted.empty()) return kLeastNodeRadius;
    std::ranges::sort(sorted);
    const double scale = view_->scale_at(frame_.bounds.center());
    return std::clamp(0.6 * sorted[sorted.size() / 2] * scale, kLeastNodeRadius, kMostNodeRadius);
  }

  // Each piece is its body's or its edge's, so that it comes and goes with it.
  void draw_ground(const FrameIsland& island, bool coast) {
    const char* const kind = coast ? "islands/coast" : "islands/ground";
    const double reach = radius_ + kShore + (coast ? kCoast : 0);
    const Role land = island.asleep ? Role::free_space : sector_role(island.number);
    const Role role = coast ? Role::cell_line_1 : land;
    for (const BodyId id : island.bodies) {
      if (!places_.contains(id)) continue;
      const DrawList::Scope scope(list_, body_key(kind, *bodies_.at(id)));
      list_.disc(places_.at(id), reach, role);
    }
    for (const FrameEdge& edge : frame_.get<FrameIslands>().edges) {
      const auto [a, b] = edge.pair;
      if (!std::ranges::binary_search(island.bodies, a) ||
          !std::ranges::binary_search(island.bodies, b) || !places_.contains(a) ||
          !places_.contains(b))
        continue;
      const DrawList::Scope scope(list_, pair_key(kind, *bodies_.at(a), *bodies_.at(b)));
      list_.line(places_.at(a), places_.at(b), {role, 2 * reach});
    }
  }

  // As they are in the world; of a solid world only what touches them is shown.
  void draw_statics() {
    const auto* map = dynamic_cast<const View2D*>(view_.get());
    for (const FrameBody& body : frame_.bodies)
      if (map && body.is_static) {
        const DrawList::Scope scope(list_, body_key("islands/static", body));
        draw_character(body, is_half_space(body) ? place_ : map->to_page(body.box), false, list_);
      }
  }

  void draw_edge(const FrameEdge& edge) {
    const auto a = bodies_.find(edge.pair.a), b = bodies_.find(edge.pair.b);
    if (a == bodies_.end() || b == bodies_.end()) return;
    const DrawList::Scope scope(list_, pair_key("islands/edge", *a->second, *b->second));
    if (a->second->is_static || b->second->is_static)
      return draw_stub(edge, a->second->is_static ? edge.pair.b : edge.pair.a);
    const auto from = places_.find(edge.pair.a), to = places_.find(edge.pair.b);
    if (from == places_.end() || to == places_.end()) return;
    const Stroke stroke = edge.lit ? Stroke{Role::lit, 6.5} : Stroke{Role::ink, 3.6};
    list_.line(from->second, to->second, stroke);
    if (!edge.tied) return;
    const Vec<2> middle = (from->second + to->second) / 2.0;
    list_.disc(middle, 6, Role::panel, {stroke.role, 2.4});
  }

  // From a body to the middle of where it touches what never moves.
  void draw_stub(const FrameEdge& edge, BodyId id) {
    const auto from = places_.find(id);
    const auto contact =
        std::ranges::find_if(frame_.contacts, [&](const auto& c) { return c.pair == edge.pair; });
    if (from == places_.end() || contact == frame_.contacts.end() || contact->points.empty())
      return;
    Vec<3> middle{0.0};
    for (const auto& point : contact->points) middle += point.position;
    const auto to = view_->seen(middle / static_cast<double>(contact->points.size()));
    if (to) list_.line(from->second, *to, {Role::quiet_ink, 2.4, 4});
  }

  void draw_node(const FrameBody& body) {
    const DrawList::Scope scope(list_, body_key("islands/node", body));
    const Vec<2> at = places_.at(body.id);
    const Stroke rim = body.lit ? Stroke{Role::lit, 4} : Stroke{Role::body_line, 2.2};
    list_.disc(at, radius_, body_role(body.color), rim);
    draw_emblem(body.color, at, 0.42 * radius_, list_);
  }

  Box<2> box_of_island(const FrameIsland& island) const {
    Box<2> box{Vec<2>(1e300), Vec<2>(-1e300)};
    for (const BodyId id : island.bodies)
      if (const auto at = places_.find(id); at != places_.end())
        box = {glm::min(box.lo, at->second), glm::max(box.hi, at->second)};
    return shrunk(box, -(radius_ + kShore));
  }

  // The largest, each above its ground or beside it, where no other ground is.
  void name_islands() {
    std::vector<const FrameIsland*> order;
    std::vector<Box<2>> grounds;
    for (const FrameIsland& island : frame_.get<FrameIslands>().islands) order.push_back(&island);
    for (const auto& [id, at] : places_)
      if (!bodies_.at(id)->is_static)
        grounds.push_back(Box<2>::around(at, Vec<2>(radius_ + kShore)));
    std::ranges::stable_sort(order, std::greater(),
                             [](const FrameIsland* island) { return island->bodies.size(); });
    if (order.size() > kMostNumbered) order.resize(kMostNumbered);
    for (const FrameIsland* island : order) {
      const std::string text = island->asleep ? say("island {}, asleep", island->number)
                                              : say("island {}", island->number);
      const Box<2> box = box_of_island(*island);
      if (!(box.size().x > 0)) continue;
      const DrawList::Scope scope(list_, fmt::format("islands/name/{}", island->number));
      const double middle = box.center().x;
      const Anchor anchors[] = {
          {{middle, box.lo.y - 10}, 0.5},      {{box.lo.x, box.lo.y - 10}, 0},
          {{box.hi.x, box.lo.y - 10}, 1},      {{box.hi.x + 10, box.lo.y + 26}, 0},
          {{box.lo.x - 10, box.lo.y + 26}, 1}, {{middle, box.hi.y + 28}, 0.5}};
      labels_.try_add(text, anchors, kIslandName, shrunk(place_, 4), place_,
                      [&](const Box<2>& extent) { return !touches(grounds, extent); });
    }
  }

  std::unique_ptr<Projection> view_ = projection_of(frame_, panel_);
  Box<2> place_ = view_->picture();
  double radius_ = radius_for(staging_);
  BodiesById bodies_ = by_id(frame_.bodies);
  std::map<BodyId, Vec<2>> places_;  // of nodes, on the page
};

}  // namespace

PanelEntry islands_panel() {
  return {
      {.name = "islands",
       .words = "the `islands`, a graph: a dot for each body, where it is in the world, and a line "
                "for each contact, spring and joint; what hangs together lies on one ground",
       .needs =
           "it needs a step that runs, and contacts, springs or joints that hold bodies together",
       .possible = language::runs_with_what_holds,
       .example = language::running_example},
      {.shows = {{"islands", lists<FrameIslands, &FrameIslands::islands>}}},
      {.draw = draw_as<IslandGraph>, .width = world_width}};
}

}  // namespace lantern::draw
