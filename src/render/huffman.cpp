#include "render/huffman.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace lantern {
namespace {

// The depth of each leaf in the tree that Huffman (1952) builds for these weights.
std::vector<std::uint8_t> depths(const std::vector<std::uint64_t>& weights) {
  const std::size_t leaves = weights.size();
  using Entry = std::pair<std::uint64_t, std::size_t>;  // weight, node: equal weights by number
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (std::size_t i = 0; i < leaves; ++i) open.push({weights[i], i});
  std::vector<std::size_t> parent(2 * leaves - 1);
  for (std::size_t made = leaves; made < parent.size(); ++made) {
    const Entry a = open.top();
    open.pop();
    const Entry b = open.top();
    open.pop();
    parent[a.second] = parent[b.second] = made;
    open.push({a.first + b.first, made});
  }
  std::vector<std::uint8_t> depth(parent.size());
  for (std::size_t i = parent.size() - 1; i-- > 0;)
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
  std::vector<std::uint64_t> weights;
  for (const std::size_t i : used) weights.push_back(std::max<std::uint64_t>(counts[i], 1));
  std::vector<std::uint8_t> depth = depths(weights);
  // Flatter weights make a flatter tree: little is lost, since what is rare counts for little.
  while (*std::max_element(depth.begin(), depth.end()) > most) {
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
  for (const std::uint8_t length : lengths) {
    const std::uint32_t code = length == 0 ? 0 : next[length]++;
    std::uint32_t reversed = 0;  // Huffman codes are sent from their highest bit
    for (int i = 0; i < length; ++i) reversed |= (code >> i & 1) << (length - 1 - i);
    codes.push_back(reversed);
  }
  return codes;
}

}  // namespace lantern
