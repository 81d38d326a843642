#include "render/huffman.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace lantern::render {
namespace {

// The depth of each leaf in the tree that Huffman (1952) builds for these weights, which ascend.
// What is joined ascends, too, so that the two lightest are at the head of one list or the other.
std::vector<std::uint8_t> depths(const std::vector<std::uint64_t>& ascending) {
  const std::size_t leaves = ascending.size(), nodes = 2 * leaves - 1;
  std::vector<std::uint64_t> weights = ascending;
  weights.resize(nodes);
  std::vector<std::size_t> parent(nodes);
  std::size_t leaf = 0, joined = leaves;
  for (std::size_t made = leaves; made < nodes; ++made)
    for (int child = 0; child < 2; ++child) {
      const bool takes_leaf = leaf < leaves && (joined == made || weights[leaf] <= weights[joined]);
      const std::size_t lightest = takes_leaf ? leaf++ : joined++;
      weights[made] += weights[lightest];
      parent[lightest] = made;
    }
  std::vector<std::uint8_t> depth(nodes);
  for (std::size_t i = nodes - 1; i-- > 0;)
    depth[i] = static_cast<std::uint8_t>(depth[parent[i]] + 1);
  depth.resize(leaves);
  return depth;
}

}  // namespace

std::vector<std::uint8_t> code_lengths(std::span<const std::uint32_t> counts, int most) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) used.push_back(i);
  for (std::size_t i = 0; used.size() < 2; ++i)
    if (counts[i] == 0) used.push_back(i);
  std::ranges::stable_sort(used, {}, [&](std::size_t i) { return counts[i]; });
  std::vector<std::uint64_t> weights;
  for (const std::size_t i : used) weights.push_back(std::max<std::uint64_t>(counts[i], 1));
  std::vector<std::uint8_t> depth = depths(weights);
  // Flatter weights make a flatter tree: little is lost, since what is rare counts for little.
  while (*std::ranges::max_element(depth) > most) {
    for (std::uint64_t& w : weights) w = w / 2 + 1;
    depth = depths(weights);
  }
  std::vector<std::uint8_t> lengths(counts.size());
  for (std::size_t i = 0; i < used.size(); ++i) lengths[used[i]] = depth[i];
  return lengths;
}

std::vector<std::uint32_t> codes_of(std::span<const std::uint8_t> lengths) {
  constexpr int kMostBits = 15;
  std::uint32_t count[kMostBits + 1] = {}, next[kMostBits + 1] = {};
  for (const std::uint8_t length : lengths) ++count[length];
  count[0] = 0;
  for (int bits = 1; bits <= kMostBits; ++bits)
    next[bits] = (next[bits - 1] + count[bits - 1]) << 1;
  std::vector<std::uint32_t> codes;
  codes.reserve(lengths.size());
  for (const std::uint8_t length : lengths) {
    const std::uint32_t code = length == 0 ? 0 : next[length]++;
    std::uint32_t reversed = 0;  // Huffman codes are sent from their highest bit
    for (int i = 0; i < length; ++i) reversed |= (code >> i & 1) << (length - 1 - i);
    codes.push_back(reversed);
  }
  return codes;
}

}  // namespace lantern::render
