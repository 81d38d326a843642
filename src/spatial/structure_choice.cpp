#include "spatial/structure_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "geometry/shape.hpp"

namespace lantern::spatial {
namespace {

// What finding all pairs of a body costs, in ns, as measured: to compare it with another one,
// sixteen at a time; to part it from the others in cells; and how much more a pair costs there,
// since pairs of all with all come in order.
template <int D>
constexpr double kCompare = D == 2 ? 0.35 : 0.5;
constexpr double kPart = 60, kPutInOrder = 4.5;

// Of a sample of pairs: which share overlaps.
template <int D>
double share_of_overlaps(std::span<const Item<D>> items) {
  constexpr std::size_t kSamples = 2000;
  if (items.size() < 2) return 0;
  std::size_t tested = 0, overlaps = 0;
  std::uint64_t random = 1;  // Knuth's MMIX generator: any spread of numbers will do
  const auto any = [&] {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>(random >> 33) % items.size();
  };
  while (tested < kSamples) {
    const std::size_t a = any(), b = any();
    if (a == b) continue;
    ++tested;
    overlaps += overlap(items[a].box, items[b].box);
  }
  return static_cast<double>(overlaps) / static_cast<double>(tested);
}

template <int D>
bool reaches_without_end(const Box<D>& box) {
  for (int i = 0; i < D; ++i)
    if (box.lo[i] <= -kEndless || box.hi[i] >= kEndless) return true;
  return false;
}

// The longest side of each body that has one, in order.
template <int D>
std::vector<double> sizes_of(std::span<const Item<D>> items) {
  std::vector<double> sizes;
  for (const Item<D>& item : items)
    if (!reaches_without_end(item.box)) sizes.push_back(extent_of(item.box));
  std::ranges::sort(sizes);
  return sizes;
}

template <int D>
Box<D> around_all(std::span<const Item<D>> items) {
  std::optional<Box<D>> all;
  for (const Item<D>& item : items)
    if (!reaches_without_end(item.box)) all = all ? united(*all, item.box) : item.box;
  return all.value_or(Box<D>{Vec<D>(-1.0), Vec<D>(1.0)});
}

std::string percent(double share) {
  return share > 0 && share < 0.01 ? "less than 1%" : fmt::format("{:.0f}%", 100 * share);
}

}  // namespace

template <int D>
StructureChoice<D> choose_structure(std::span<const Item<D>> items,
                                    const StructureConfig<D>& config, Use use) {
  StructureChoice<D> choice;
  choice.config = config;
  if (use == Use::questions) {
    choice.kind = StructureKind::aabb_tree;
    choice.why = fmt::format("{} bodies are asked, not paired", items.size());
    return choice;
  }
  const double share = share_of_overlaps(items);
  const double others = static_cast<double>(items.size()) / 2;
  if (others * kCompare<D> < kPart + others * share * kPutInOrder) {
    choice.why = fmt::format(
        "{} bodies, of sampled pairs {} overlap: comparing all with all costs less than "
        "partitioning them",
        items.size(), percent(share));
    return choice;
  }
  const std::vector<double> sizes = sizes_of(items);
  const double median = sizes.empty() ? 0 : sizes[sizes.size() / 2];
  const double largest = sizes.empty() ? 0 : sizes.back();
  choice.kind = StructureKind::grid;
  choice.config.bounds = around_all(items);
  choice.config.cell = 0;
  choice.config.levels = 1;
  choice.why = fmt::format("{} bodies, the largest {:.3g} times as large as the median",
                           items.size(), median > 0 ? largest / median : 1.0);
  return choice;
}

template StructureChoice<2> choose_structure(std::span<const Item<2>>, const StructureConfig<2>&,
                                             Use);
template StructureChoice<3> choose_structure(std::span<const Item<3>>, const StructureConfig<3>&,
                                             Use);

}  // namespace lantern::spatial
