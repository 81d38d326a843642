// The broad phase: which boxes overlap. One interface, many structures, the same pairs.
#pragma once

#include "spatial/broad_phase_config.hpp"
#include "spatial/near_pairs.hpp"

namespace lantern::spatial {

// Which structure for which bodies: `kind = "auto"`.
template <int D>
struct StructureChoice {
  StructureKind kind = StructureKind::brute_force;
  StructureConfig<D> config;  // as given, but for what was chosen
  // "a grid of 2 levels: 1% of 10000 bodies are more than 8 times as large as the median": the
  // numbers are counted from the bodies.
  std::string why;
};

enum class Use {
  pairs,      // all pairs of bodies whose boxes overlap
  questions,  // what a ray, a box, a ball meets
};

// The kind and the settings that are likely to serve these bodies soonest. Depends on the boxes
// alone; looks at each body once, and at a sample of some thousand pairs.
template <int D>
StructureChoice<D> choose_structure(Items<D> items, const StructureConfig<D>& config,
                                    Use use = Use::pairs);

// What the broad phase knows of a body.
template <int D>
struct Proxy {
  BodyId id = 0;
  Box<D> box;
  bool is_static = false;
  bool awake = true;  // of no matter if static
  bool operator==(const Proxy&) const = default;
};

// The way from nodes to candidate pairs, for who shows or checks it: what an update of the same
// bodies finds, step by step.
struct PairChain {
  std::uint64_t met = 0;          // pairs met in leaves, as often as they were met
  std::uint64_t besides = 0;      // tests that it took to meet them: of nodes, rows, planes
  std::vector<Pair> pairs;        // each once, in order of ids
  std::vector<Pair> overlapping;  // of these, those whose boxes overlap: the narrow phase's work
  std::uint64_t lost = 0;         // as printed: met, but mistaken for another pair
};

template <int D>
struct OrderedSearch;

// Pairs are those bodies whose boxes overlap (touching does), of which at least one is awake and
// not static; each once, in order of ids. All kinds give the same pairs.
//
// Static bodies have a structure of their own, which is built once and only asked later (the
// lecture, "Static and dynamic objects"). The one for all others is built anew when a box in it has
// changed, in the memory of the one before; when none of them is awake there is nothing to pair
// (the lecture, "Sleeping Objects").
template <int D>
class BroadPhase {
 public:
  using Config = BroadPhaseConfig<D>;
  using Watch = EventWatch;

  // Throws Refused for what the structures refuse.
  explicit BroadPhase(const Config& config);
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  // Finds the pairs. Proxies may come in any order. Nothing is done if they are those of the last
  // update; nothing is built for bodies of which none is awake. Throws Refused, naming the body,
  // for a box that is not valid and for two proxies of one id; nothing changes then. Throws
  // Refused, too, when more than `most_pairs` meet (coincident bodies have n(n-1)/2 pairs), or when
  // they need more memory than the budget. Throws StructureFault for a structure that a program was
  // given and that cannot be read. Whatever is thrown half way, Stopped too: there are no pairs and
  // no structures then, and the next update begins as the first.
  void update(std::span<const Proxy<D>> proxies);

  // The same in two parts: first these are all bodies; and then, as often as they move, the pairs.
  // Ids ascend; these alone may be others than they were, and all that stir are among them. So it
  // costs what these cost: where few of many stir, each asks a tree of what rests; where many do,
  // but no farther than they are large, `automatic` mends the pairs of the step before
  // (near_pairs.hpp). The structure itself waits until somebody looks. (Not one that is there to
  // show how it follows its bodies, and none that a program was given.)
  void tell(std::span<const Proxy<D>> proxies) { take(proxies); }
  void follow(std::span<const Proxy<D>> changed);

  // The structures of these bodies, awake or not; no pairs are looked for: `automatic` takes one
  // that is quickly asked. Throws as `update` does.
  // An update of the same bodies then builds nothing. A structure that goes on from where its
  // bodies were tells `watch`, if there is one, what it does; `watch` may look at the structures.
  void build(std::span<const Proxy<D>> proxies, const Watch& watch = {});

  // These bodies more, one after another as the lecture inserts them; a structure that is fitted to
  // its bodies is built anew, of all together. Ids must come in ascending order. `watch`, if there
  // is one, is told what happens; it may look at the structures, but not change them. Throws as
  // `update` does.
  void insert(std::span<const Proxy<D>> proxies, const Watch& watch = {});
  void insert(const Proxy<D>& proxy, const Watch& watch) { insert(std::span(&proxy, 1), watch); }

  // Of the dynamic structure: as configured or, of `automatic`, what it is now.
  StructureKind kind() const { return dynamic_.kind; }

  // What an update would find in the structures as they stand, bodies with `awake(id)` moving. At
  // most `most` pairs of each kind: throws Refused beyond. With addresses, of those that the
  // lecture's text takes for the same pair, only the first that was met.
  PairChain pair_chain(FunctionRef<bool(BodyId)> awake, std::uint64_t most,
                       FunctionRef<std::uint64_t(BodyId)> address = {}) const;

  // Of the last update.
  const std::vector<Pair>& pairs() const { return pairs_; }
  const BroadPhaseCounters& counters() const { return counters_; }
  const Config& config() const { return config_; }

  // The box that the structures hold of the body; nothing if they do not hold it.
  std::optional<Box<D>> box_of(BodyId id) const;
  // Of these, which no longer lies where a structure that is fitted to its bodies has it.
  bool is_stale(const Item<D>& item) const;

  // Of structures that a program was given: what of them is not so, the bodies named by their ids.
  std::vector<OwnFault> faults() const;

  // Of the dynamic structure.
  Arrangement arrangement() const { return dynamic_.structure->arrangement(); }
  // f(id, id) for each pair that it compares, in the order of the sweep; nothing if it sweeps none.
  void each_swept(FunctionRef<void(BodyId, BodyId)> f) const;

  // The structures of the last update or build, their bodies named by their ids: for views and
  // queries, until the next one. If all slept, the dynamic one as it was last built, or empty if
  // bodies have come, gone or moved in their sleep since. Without split_static, it holds all.
  StructureView<D> dynamic() const { return view_of(dynamic_); }
  StructureView<D> fixed() const { return view_of(static_); }
  // The dynamic structure and then, if static bodies have one of their own, that.
  std::vector<StructureView<D>> each() const {
    if (!config_.split_static) return {dynamic()};
    return {dynamic(), fixed()};
  }

 private:
  // Bodies, by id. A structure knows them by their places in these lists. States are left out as
  // long as all stir.
  struct Bodies : KeptItems<D> {
    std::vector<ProxyState> states = {};

    std::size_t size() const { return this->boxes.size(); }
    ProxyState state(std::size_t place) const {
      return states.empty() ? ProxyState{} : states[place];
    }
    void set_state(std::size_t place, ProxyState state) {
      if (states.empty() && state == ProxyState{}) return;
      states.reserve(this->boxes.capacity());
      states.resize(size());
      states[place] = state;
    }
    void push_back(const Item<D>& item, ProxyState state) {
      KeptItems<D>::push_back(item);
      set_state(size() - 1, state);
    }
    void clear() {
      KeptItems<D>::clear();
      states.clear();
    }
    std::size_t places() const { return KeptItems<D>::places() + states.capacity(); }
    bool has(std::size_t place, BodyId id) const { return place < size() && this->id(place) == id; }
    // Where it is, or would be.
    std::size_t place_of(BodyId id) const {
      if (this->ids.empty()) return id;
      return static_cast<std::size_t>(std::ranges::lower_bound(this->ids, id) - this->ids.begin());
    }
    // Beyond all ids.
    std::uint64_t end_id() const {
      return size() == 0 ? 0 : std::uint64_t{this->id(size() - 1)} + 1;
    }
  };
  // A structure and its bodies.
  struct Store : Bodies {
    std::unique_ptr<Structure<D>> structure;
    std::uint64_t BroadPhaseCounters::*builds;
    StructureKind kind;
    StructureConfig<D> settings;  // the depth at most as configured
    Use chosen_use = Use::pairs;
    std::size_t chosen_for = 0;             // so many bodies, and
    double chosen_tests = 0;                // so many comparisons a body in the first update after
    double tests = 0;                       // comparisons a body in the last update
    std::vector<std::uint32_t> ranks = {};  // see rank_all
    std::uint64_t room = 0;                 // how many bodies its limits were made for
    bool stands = true;                     // the structure holds these bodies, ready to be asked
    bool only_moved = false;                // it holds them where they were; else it holds none
  };

  static StructureView<D> view_of(const Store& store) {
    if (!store.stands) return *store.structure;
    return {*store.structure, store.ids, store.boxes};
  }
  std::array<Store*, 2> stores() { return {&static_, &dynamic_}; }
  std::array<const Store*, 2> stores() const { return {&static_, &dynamic_}; }
  bool is_of_static(const Proxy<D>& proxy) const { return config_.split_static && proxy.is_static; }
  Store& store_for(const Proxy<D>& proxy) { return is_of_static(proxy) ? static_ : dynamic_; }
  const Store* store_of(BodyId id, std::size_t& place) const;

  Store made(std::uint64_t BroadPhaseCounters::*builds);
  void make_anew(Store& store);
  void choose(Store& store, Use use);
  template <class F>
  void all_or_nothing(F&& change);
  void take(std::span<const Proxy<D>> proxies);
  static bool is_in(const Store& store, std::size_t place, const Proxy<D>& proxy) {
    return store.boxes[place] == proxy.box &&
           store.state(place) == ProxyState{proxy.is_static, proxy.awake};
  }
  void set(Store& store, std::size_t place, const Proxy<D>& proxy);
  void put_to_rest(std::size_t place);
  void replace(std::span<const Proxy<D>> proxies);
  void rank_all();
  std::size_t size() const { return static_.size() + dynamic_.size(); }
  BodyId rank(const Store& store, std::size_t place) const {
    return id_at(numbered_ ? store.ids : store.ranks, place);
  }
  std::span<const BodyId> names_by_rank() const {
    if (numbered_) return {};
    return static_.size() == 0 ? dynamic_.ids : all_ids_;
  }
  void forget();
  void build(Store& store, Use use = Use::pairs, const Watch& watch = {});
  void build(Store& store, std::span<const Box<D>> boxes, Use use = Use::pairs,
             const Watch& watch = {});
  void put(Store& store, const Proxy<D>& proxy, const Watch& watch);
  static Watch naming(const Store& store, const Watch& watch);
  template <class F>
  static void with_names(const Store& store, F&& f);
  void empty(Store& store);
  bool each_asks_alone() const;
  void begin_search(std::span<const Box<D>> boxes, std::span<const ProxyState> states,
                    std::span<const BodyId> names);
  template <class PlaceOf>
  void name_by_ranks(PlaceOf&& place_of);
  void find_pairs();
  void search();
  Structure<D>& few();
  void find_pairs_of_few();
  void pair_static();
  void ask(const Structure<D>& structure, const Store& others, const Box<D>& box,
           std::size_t place);
  void order_pairs(std::vector<Pair>& pairs);
  bool mends_pairs() const;
  void mend_pairs();
  bool find_near();
  void mend_near();
  void pair_near();
  void require_room(BodyId number, std::size_t pairs) const;
  [[noreturn]] void refuse_more(BodyId number) const;
  std::size_t own_places() const;

  Config config_;
  BroadPhaseCounters counters_;
  std::uint64_t own_allocations_ = 0;
  std::uint64_t past_allocations_ = 0;  // of structures that were made anew
  Store static_, dynamic_;
  std::vector<Pair> pairs_;
  bool found_all_ = false;  // pairs_ are those of the bodies as they are
  // Of the dynamic store: the places of what stirs, as `follow` was told; where these were few, a
  // tree of them, and one of all others, and of where some were before.
  std::vector<std::size_t> stirring_;
  std::unique_ptr<Structure<D>> few_, resting_;
  std::size_t put_to_rest_ = 0;  // since that tree was built
  // Of `automatic`, where most stir: which are near each other, and whether the dynamic structure
  // holds their reaches instead of their boxes.
  NearPairs<D> near_;
  bool reaches_stand_ = false;
  struct Spot {
    bool is_static = false;
    std::uint32_t place = 0;
  };
  std::vector<Spot> spots_;  // by rank, if there are static bodies

  // Scratch of an update, kept for its memory.
  std::vector<Proxy<D>> sorted_;  // all, by id, if they came otherwise
  // Which of those that came are not as they were: where some in a row begin, where they end, and
  // so on, and how many come before there that are in the static store.
  std::vector<std::array<std::uint32_t, 2>> changed_;
  bool ranked_ = false, numbered_ = false;  // see rank_all
  std::vector<BodyId> all_ids_;
  Bodies few_bodies_;
  std::vector<BodyId> ids_;
  std::span<const BodyId> found_names_;
  std::unique_ptr<OrderedSearch<D>> search_;
};

extern template class BroadPhase<2>;
extern template class BroadPhase<3>;

// The broad phase of these settings, with bodies as they are before a step and after it: the same
// ids. What never moves has a structure of its own, which is built once. The pairs of what nobody
// looks at come from vector instructions that compare more boxes than this in less time; counted is
// the plain way, which frames show. Throws Refused as BroadPhase does, and beyond `most` pairs.
template <int D>
StructureWork structure_work(BroadPhaseConfig<D> config, std::span<const Proxy<D>> before,
                             std::span<const Proxy<D>> after, std::uint64_t most);

// Whether all that the kind does is counted: not of `none` and `automatic`, of the lecture's own
// code, and of structures that a program was given.
bool counts_its_work(StructureKind kind);

}  // namespace lantern::spatial
