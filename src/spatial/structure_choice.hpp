// Which structure for which bodies: `kind = "auto"`.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "spatial/structure.hpp"

namespace lantern::spatial {

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
StructureChoice<D> choose_structure(std::span<const Item<D>> items,
                                    const StructureConfig<D>& config, Use use = Use::pairs);

extern template StructureChoice<2> choose_structure(std::span<const Item<2>>,
                                                    const StructureConfig<2>&, Use);
extern template StructureChoice<3> choose_structure(std::span<const Item<3>>,
                                                    const StructureConfig<3>&, Use);

}  // namespace lantern::spatial
