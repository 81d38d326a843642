// The sparse solver of the implicit methods: right-hand sides are made from solutions.
#include "physics/integrate/block_system.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace lantern::physics {
namespace {

constexpr std::size_t kAny = 1'000'000;  // entries

template <int B>
BlockSystem<B> planned(std::size_t count,
                       const Scratch<std::pair<std::size_t, std::size_t>>& links) {
  return *BlockSystem<B>::planned(count, links, kAny);
}

template <int B>
class Filled {
 public:
  Filled(std::size_t count, Random& random)
      : dense_(count * B, std::vector<double>(count * B)),
        system_(planned<B>(count, links_of(count, random))) {
    fill(random);
  }

  // Every entry of every link is different from its mirror image within the block.
  void fill(Random& random) {
    system_.clear();
    for (auto& row : dense_) std::fill(row.begin(), row.end(), 0.0);
    for (const auto& [i, j] : links_)
      for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c) {
          const double value = random.between(-1, 1);
          system_.add(i, j, r, c, value);
          dense_[i * B + r][j * B + c] += value;
          dense_[j * B + c][i * B + r] += value;
        }
    for (std::size_t i = 0; i < dense_.size() / B; ++i)
      for (int r = 0; r < B; ++r)
        for (int c = 0; c <= r; ++c) {
          // Large enough on the diagonal to outweigh all others: positive definite.
          const double value =
              r == c ? 4.0 * B * static_cast<double>(1 + links_.size()) : random.between(-1, 1);
          system_.add(i, r, c, value);
          dense_[i * B + r][i * B + c] += value;
          if (r != c) {
            system_.add(i, c, r, value);
            dense_[i * B + c][i * B + r] += value;
          }
        }
  }

  void expect_solved(Random& random) {
    using Row = typename BlockSystem<B>::Row;
    Scratch<Row> x(dense_.size() / B), rows(x.size());
    for (Row& row : x)
      for (double& value : row) value = random.between(-1, 1);
    for (std::size_t i = 0; i < dense_.size(); ++i)
      for (std::size_t j = 0; j < dense_.size(); ++j)
        rows[i / B][i % B] += dense_[i][j] * x[j / B][j % B];
    ASSERT_TRUE(system_.factor());
    system_.solve(rows);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int r = 0; r < B; ++r) EXPECT_NEAR(rows[i][r], x[i][r], 1e-12);
  }

 private:
  Scratch<std::pair<std::size_t, std::size_t>> links_of(std::size_t count, Random& random) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        if (i != j && random.whole(0, 3) == 0) links_.push_back({i, j});
    return links_;
  }

  Scratch<std::pair<std::size_t, std::size_t>> links_;
  std::vector<std::vector<double>> dense_;
  BlockSystem<B> system_;
};

template <int B>
void expect_solves() {
  Random random(B);
  for (std::size_t count = 1; count < 12; ++count) {
    Filled<B> filled(count, random);
    filled.expect_solved(random);
    filled.fill(random);
    filled.expect_solved(random);
  }
}

TEST(BlockSystem, SolvesWhateverIsLinked) {
  expect_solves<2>();
  expect_solves<3>();
  expect_solves<6>();
}

TEST(BlockSystem, RefusesWhatIsNotPositiveDefinite) {
  BlockSystem<2> system = planned<2>(2, {{1, 0}});
  for (std::size_t i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) system.add(i, k, k, 1);
  system.add(1, 0, 0, 1, 2);
  EXPECT_FALSE(system.factor());
  BlockSystem<2> alone = planned<2>(1, {});
  alone.add(0, 0, 0, 1);
  EXPECT_FALSE(alone.factor()) << "nothing on the second line";
}

}  // namespace
}  // namespace lantern::physics
