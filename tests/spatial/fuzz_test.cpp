// Random and mutated bytes as settings and operations of every structure and the atlas.
#include <gtest/gtest.h>

#include "base/random.hpp"
#include "fuzz/fuzz_trees.hpp"
#include "how_many.hpp"

namespace lantern::spatial {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes random_bytes(Random& random, std::uint8_t structure) {
  Bytes bytes(static_cast<std::size_t>(random.whole(1, 300)));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.bits());
  bytes[0] = structure;
  return bytes;
}

// One change: a bit, a byte, or a piece copied to another place, so that equal boxes come up.
void mutate(Bytes& bytes, Random& random) {
  const auto place = [&] {
    return static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(bytes.size()) - 1));
  };
  switch (random.whole(0, 2)) {
    case 0:
      bytes[place()] ^= static_cast<std::uint8_t>(1u << random.whole(0, 7));
      break;
    case 1:
      bytes[place()] = static_cast<std::uint8_t>(random.bits());
      break;
    default: {
      const std::size_t from = place(), to = place();
      const std::size_t count = std::min<std::size_t>({16, bytes.size() - from, bytes.size() - to});
      for (std::size_t i = 0; i < count; ++i) bytes[to + i] = bytes[from + i];
    }
  }
}

TEST(Fuzz, TreesKeepTheirInvariantsOnAnyBytes) {
  fuzz_trees({});
  for (std::uint8_t structure = 0; structure < 7; ++structure) {
    Random random(structure);
    const int rounds =
        how_many("LANTERN_TREE_BYTES", structure == 4 || structure == 5 ? 30 : 150, 3);
    for (int round = 0; round < rounds; ++round) {
      Bytes bytes = random_bytes(random, structure);
      for (int change = 0; change < 10; ++change) {
        fuzz_trees(bytes);
        mutate(bytes, random);
      }
    }
  }
}

}  // namespace
}  // namespace lantern::spatial
