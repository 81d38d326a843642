// Trees and pairs: which of many boxes overlap, and which reach into a place.
#include <cstdio>
#include <vector>

#include <lantern/spatial/pairs.hpp>
#include <lantern/spatial/query.hpp>
#include <lantern/spatial/structure.hpp>

using namespace lantern::spatial;

int main() {
  const Box<2> world{Vec<2>(0.0), Vec<2>(16.0)};
  const std::vector<Item<2>> items = {
      {0, Box<2>::around({3.0, 3.0}, Vec<2>(1.0))},
      {1, Box<2>::around({4.5, 3.5}, Vec<2>(1.0))},
      {2, Box<2>::around({12.0, 12.0}, Vec<2>(1.0))},
      {3, Box<2>::around({13.0, 5.0}, Vec<2>(1.0))},
  };

  //! [pairs]
  const auto tree =
      make_structure<2>(StructureKind::quadtree, {.bounds = world, .capacity = 2, .max_depth = 6});
  for (const Item<2>& item : items) tree->insert(item);

  const CandidatePairs found = candidate_pairs(*tree, 1000);
  std::printf("%zu of %llu pairs are left to test\n", found.pairs.size(),
              static_cast<unsigned long long>(all_pairs(items.size())));
  //! [pairs]

  //! [visit]
  tree->visit([](const NodeView<2>& node) {
    std::printf("%*s%s with %zu bodies\n", static_cast<int>(2 * node.depth), "",
                node.leaf ? "leaf" : "node", node.bodies.size());
    return true;  // go on below it
  });
  //! [visit]

  //! [query]
  const auto box_of = [&](BodyId id) { return items[id].box; };
  const Found near = overlap_query(*tree, Ball<2>{{12.0, 10.0}, 2.0}, box_of);
  for (const BodyId id : near.ids) std::printf("body %u is near\n", id);
  //! [query]

  const bool is_right =
      found.pairs == std::vector<Pair>{{0, 1}} && near.ids == std::vector<BodyId>{2};
  return is_right ? 0 : 1;
}
