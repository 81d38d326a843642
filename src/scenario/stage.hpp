// The engine of one scenario: the world, structure and atlas that it needs, and none that it does
// not. The director moves the pieces; the stage knows how each is made, watched and pictured.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "atlas/atlas.hpp"
#include "base/work.hpp"
#include "physics/world.hpp"
#include "scenario/frame.hpp"
#include "spatial/brute_force.hpp"
#include "spatial/bsp.hpp"
#include "spatial/orthtree.hpp"

namespace lantern {

// Pairs listed on one frame; more are refused.
inline constexpr std::uint64_t kMostPairs = 2'000'000;
// Entries and nodes of one tree; more are refused.
inline constexpr std::uint64_t kMostEntries = 2'000'000;

// What the current step did to nodes, by handle.
struct Touched {
  std::set<NodeHandle> lit;
  std::set<NodeHandle> passed;
};

class Stage {
 public:
  using Watch = std::function<void(const Event&)>;
  using AtlasWatch = std::function<void(const AtlasEvent&)>;

  Stage(const Scenario& scenario, Work& work);

  // Bodies, by their index in the scenario. Each throws Refused as the world and the trees do.
  void enter(std::size_t body);                      // into the world only
  void store(std::size_t body, const Watch& watch);  // into the structure as well
  void leave(std::size_t body);
  void place(std::size_t body, const Vec<2>& position, const Vec<2>& velocity);
  void let_time_pass();                             // one world step
  void rebuild();                                   // the structure anew, its memory reused
  void rebuild_as(const StructureSpec& structure);  // another structure, all bodies anew

  std::optional<Rect> pack(std::size_t texture, const AtlasWatch& watch);
  void name_free_leaf(const std::string& name, const std::vector<std::uint32_t>& before);
  std::vector<std::uint32_t> free_leaves() const;  // handles
  bool ask_room(int width, int height);

  const Body<2>* body(std::size_t index) const;  // null when it is not in the world
  std::optional<BodyId> id_of(std::size_t index) const { return ids_[index]; }
  std::string label_of(NodeHandle node) const;           // "root", "1.3", "front.back"
  std::string atlas_label_of(std::uint32_t node) const;  // its texture, its name, or its size
  const StructureSpec& structure() const { return spec_; }
  double time() const { return time_; }
  bool has_atlas() const { return atlas_.has_value(); }

  // The state as it is: bodies, nodes, pairs, textures, counts, hash.
  void picture(const Touched& touched, Frame& frame) const;

 private:
  void make_structure();
  void picture_bodies(Frame& frame) const;
  void picture_tree(const Touched& touched, Frame& frame) const;
  void picture_atlas(const Touched& touched, Frame& frame) const;
  template <class F>
  void with_structure(F&& f) const;

  const Scenario& scenario_;
  Work& work_;
  StructureSpec spec_;
  std::optional<World<2>> world_;
  std::variant<std::monostate, BruteForce<2>, Quadtree, Bsp<2>> tree_;
  std::optional<Atlas> atlas_;
  std::vector<std::optional<BodyId>> ids_;                     // of the scenario's bodies
  std::vector<std::size_t> index_of_;                          // of a body id, in the scenario
  std::vector<FrameTexture> textures_;                         // where they lie, the atlas knows
  std::unordered_map<std::uint32_t, std::string> free_names_;  // of atlas leaves, by handle
  std::optional<bool> room_;
  double time_ = 0;
};

// "capacity 2, depth limit 4, all children made"
std::string settings_text(const StructureSpec& structure);

}  // namespace lantern
