// Symmetric positive definite linear equations whose unknowns come in small groups, one a body.
// BlockSystem solves them directly where few groups are linked, BlockIteration step by step where
// very many are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/scratch.hpp"
#include "base/stop.hpp"

namespace lantern::physics {

// Cholesky factors of small symmetric positive definite matrices, kept row by row, of which only
// the lower half counts.
template <int N>
using SmallMatrix = std::array<double, N * N>;

// Replaces the lower half by the factor. False if the matrix is not positive definite, or if of a
// row no more than the part `least` is left by what those before it say.
template <int N>
bool factor_small(SmallMatrix<N>& m, double least = 0) {
  for (int i = 0; i < N; ++i) {
    const double whole = m[i * N + i];
    for (int j = 0; j <= i; ++j) {
      double sum = m[i * N + j];
      for (int k = 0; k < j; ++k) sum -= m[i * N + k] * m[j * N + k];
      if (i == j && !(sum > least * whole)) return false;
      m[i * N + j] = i == j ? std::sqrt(sum) : sum / m[j * N + j];
    }
  }
  return true;
}

// x := factor^-1 x, and x := transposed factor^-1 x; one after the other they solve the equations.
template <int N>
void solve_lower(const SmallMatrix<N>& factor, std::array<double, N>& x) {
  for (int r = 0; r < N; ++r) {
    for (int c = 0; c < r; ++c) x[r] -= factor[r * N + c] * x[c];
    x[r] /= factor[r * N + r];
  }
}
template <int N>
void solve_upper(const SmallMatrix<N>& factor, std::array<double, N>& x) {
  for (int r = N; r-- > 0;) {
    for (int c = r + 1; c < N; ++c) x[r] -= factor[c * N + r] * x[c];
    x[r] /= factor[r * N + r];
  }
}

// A direct solution, by a sparse Cholesky factorisation. Unlike iterations it does not care how
// stiff the springs are, and a chain or tree of any length costs time in proportion to its length.
// The groups are eliminated in the order of fewest links (minimum degree; George and Liu, SIAM
// Review 31, 1989), equal ones in order of their number, so that the result depends on nothing but
// the input.
template <int B>
class BlockSystem {
 public:
  using Block = SmallMatrix<B>;
  using Row = std::array<double, B>;
  using Link = std::pair<std::size_t, std::size_t>;

  // `count` groups of B unknowns, of which the linked ones (different, in any order, perhaps named
  // more than once) share entries. Nothing if the factor would take more than `most_bytes`.
  static std::optional<BlockSystem> planned(std::size_t count, const Scratch<Link>& links,
                                            std::size_t most_bytes) {
    BlockSystem system;
    if (!system.plan(count, links, most_bytes / sizeof(BlockBelow))) return std::nullopt;
    return system;
  }

  void clear() {
    std::fill(diagonal_.begin(), diagonal_.end(), Block{});
    for (auto& column : columns_)
      for (auto& [row, block] : column) block = Block{};
  }

  void add(std::size_t i, int row, int column, double value) {
    diagonal_[place_[i]][row * B + column] += value;
  }

  // Of linked groups: at (row of i, column of j), and at its mirror image.
  void add(std::size_t i, std::size_t j, int row, int column, double value) {
    std::size_t low = place_[j], high = place_[i];
    if (low > high) {
      std::swap(low, high);
      std::swap(row, column);
    }
    entry(low, high)[row * B + column] += value;
  }

  // Replaces the matrix by its factor. False if it is not positive definite.
  bool factor() {
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      stop_if_asked();
      if (!factor_small<B>(diagonal_[j])) return false;
      auto& column = columns_[j];
      for (auto& [row, block] : column) divide(block, diagonal_[j]);
      // Of the column of each row, the entries at the rows below it, which stand there in the same
      // order.
      for (std::size_t s = 0; s < column.size(); ++s) {
        stop_if_asked();
        subtract_product(diagonal_[column[s].first], column[s].second, column[s].second);
        auto entry = columns_[column[s].first].begin();
        for (std::size_t r = s + 1; r < column.size(); ++r) {
          while (entry->first != column[r].first) ++entry;
          subtract_product(entry->second, column[r].second, column[s].second);
        }
      }
    }
    return true;
  }

  // Replaces the right-hand sides by the solution. After `factor`.
  void solve(Scratch<Row>& rows) const {
    Scratch<Row> x(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) x[place_[i]] = rows[i];
    for (std::size_t j = 0; j < x.size(); ++j) {
      solve_lower<B>(diagonal_[j], x[j]);
      for (const auto& [row, block] : columns_[j])
        for (int r = 0; r < B; ++r)
          for (int c = 0; c < B; ++c) x[row][r] -= block[r * B + c] * x[j][c];
    }
    for (std::size_t j = x.size(); j-- > 0;) {
      for (const auto& [row, block] : columns_[j])
        for (int r = 0; r < B; ++r)
          for (int c = 0; c < B; ++c) x[j][c] -= block[r * B + c] * x[row][r];
      solve_upper<B>(diagonal_[j], x[j]);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = x[place_[i]];
  }

 private:
  using BlockBelow = std::pair<std::size_t, Block>;  // its row

  BlockSystem() = default;

  // Finds the order, and which entries the elimination fills: all that were linked to a group are
  // linked to each other when it goes. False if they are more than `most`.
  bool plan(std::size_t count, const Scratch<Link>& links, std::size_t most) {
    diagonal_.resize(count);
    Scratch<ScratchSet<std::size_t>> near(count);
    for (const auto& [a, b] : links) {
      stop_if_asked();
      near[a].insert(b);
      near[b].insert(a);
    }
    ScratchSet<std::pair<std::size_t, std::size_t>> waiting;  // number of links, group
    for (std::size_t i = 0; i < count; ++i) waiting.insert({near[i].size(), i});
    place_.resize(count);
    columns_.resize(count);
    Scratch<Scratch<std::size_t>> linked(count);
    std::size_t entries = 0;
    for (std::size_t j = 0; j < count; ++j) {
      stop_if_asked();
      entries += waiting.begin()->first;
      if (entries > most) return false;
      // Where all that are left are linked to each other, they go in the order of their numbers.
      if (const std::size_t left = count - j; waiting.begin()->first + 1 == left) {
        entries += left * (left - 1) / 2 - (left - 1);
        if (entries > most) return false;
        Scratch<std::size_t> rest;
        for (const auto& entry : waiting) rest.push_back(entry.second);
        for (std::size_t k = 0; k < left; ++k) {
          place_[rest[k]] = j + k;
          linked[j + k].assign(rest.begin() + static_cast<std::ptrdiff_t>(k) + 1, rest.end());
        }
        break;
      }
      const std::size_t gone = waiting.begin()->second;
      waiting.erase(waiting.begin());
      place_[gone] = j;
      linked[j].assign(near[gone].begin(), near[gone].end());
      for (const std::size_t i : linked[j]) {
        waiting.erase({near[i].size(), i});
        near[i].erase(gone);
        for (const std::size_t k : linked[j])
          if (k != i) near[i].insert(k);
        waiting.insert({near[i].size(), i});
      }
    }
    for (std::size_t j = 0; j < count; ++j) {
      for (const std::size_t i : linked[j]) columns_[j].push_back({place_[i], Block{}});
      std::ranges::sort(columns_[j]);
    }
    return true;
  }

  Block& entry(std::size_t column, std::size_t row) {
    return std::ranges::lower_bound(columns_[column], row, {}, &BlockBelow::first)->second;
  }

  // block := block * (transposed factor)^-1
  static void divide(Block& block, const Block& factor) {
    for (int r = 0; r < B; ++r) {
      for (int c = 0; c < B; ++c) {
        double sum = block[r * B + c];
        for (int k = 0; k < c; ++k) sum -= block[r * B + k] * factor[c * B + k];
        block[r * B + c] = sum / factor[c * B + c];
      }
    }
  }

  // m -= a * transposed b
  static void subtract_product(Block& m, const Block& a, const Block& b) {
    for (int r = 0; r < B; ++r)
      for (int c = 0; c < B; ++c)
        for (int k = 0; k < B; ++k) m[r * B + c] -= a[r * B + k] * b[c * B + k];
  }

  Scratch<std::size_t> place_;  // of a group in the order of elimination; all below is by place
  Scratch<Block> diagonal_;
  Scratch<Scratch<BlockBelow>> columns_;  // below the diagonal, by row
};

// Conjugate gradients (Hestenes and Stiefel, "Methods of conjugate gradients for solving linear
// systems", 1952). Only the blocks on the diagonal are kept, and precondition the rest, which is
// asked for as a product with a vector. Memory is in proportion to the groups, not to the links.
// The sums are made in the order of the groups, so that the result depends on nothing but the
// input.
template <int B>
class BlockIteration {
 public:
  using Block = typename BlockSystem<B>::Block;
  using Row = typename BlockSystem<B>::Row;

  explicit BlockIteration(std::size_t count) : diagonal_(count), factors_(count) {}

  void clear() { std::fill(diagonal_.begin(), diagonal_.end(), Block{}); }

  // As those of BlockSystem. What links two groups is not kept.
  void add(std::size_t i, int row, int column, double value) {
    diagonal_[i][row * B + column] += value;
  }
  void add(std::size_t, std::size_t, int, int, double) {}

  // False if a block on the diagonal is not positive definite, and so neither is the matrix.
  bool factor() {
    factors_ = diagonal_;
    for (Block& block : factors_)
      if (!factor_small<B>(block)) return false;
    return true;
  }

  // Replaces the right-hand sides by a solution after which no more than about `tolerance` of them
  // is missing, or as little as is found. add_links(x, y) adds to y what the matrix without its
  // diagonal blocks makes of x. After `factor`. False if the matrix turns out not to be positive
  // definite, or if numbers fail; the rows are then of no use.
  template <class AddLinks>
  bool solve(Scratch<Row>& rows, double tolerance, AddLinks&& add_links) const {
    const auto product = [&](const Scratch<Row>& x) {
      Scratch<Row> y = on_diagonal(x);
      add_links(x, y);
      return y;
    };
    Scratch<Row> x(rows.size(), Row{}), missing = rows;
    const double allowed = tolerance * tolerance * dot(rows, preconditioned(rows));
    double before = 0;
    // What rounding has left is found from the equations themselves, and mended.
    for (int round = 0; round < kMostRounds; ++round) {
      const double lacks = dot(missing, preconditioned(missing));
      if (!std::isfinite(lacks)) return false;
      if (lacks <= allowed || (round > 0 && lacks > before / 4)) break;
      before = lacks;
      if (!descend(missing, std::max(allowed, kRounding * lacks), product, x)) return false;
      const Scratch<Row> found = product(x);
      missing = rows;
      add_to(missing, -1, found);
    }
    rows = std::move(x);
    return true;
  }

 private:
  static constexpr int kMostRounds = 8;
  static constexpr int kMostSteps = 10'000;
  static constexpr double kRounding = 1e-24;  // a square: of what is missing, so much is found

  // One run of conjugate gradients, whose steps are added to x.
  template <class Product>
  bool descend(Scratch<Row> missing, double allowed, Product&& product, Scratch<Row>& x) const {
    Scratch<Row> z = preconditioned(missing), way = z;
    double lacks = dot(missing, z);
    for (int step = 0; step < kMostSteps && lacks > allowed; ++step) {
      stop_if_asked();
      const Scratch<Row> gained = product(way);
      const double bend = dot(way, gained);
      if (!(bend > 0) || !std::isfinite(bend)) return false;
      add_to(x, lacks / bend, way);
      add_to(missing, -lacks / bend, gained);
      z = preconditioned(missing);
      const double left = dot(missing, z);
      if (!std::isfinite(left)) return false;
      scale(way, left / lacks);
      add_to(way, 1, z);
      lacks = left;
    }
    return true;
  }

  Scratch<Row> on_diagonal(const Scratch<Row>& x) const {
    Scratch<Row> y(x.size(), Row{});
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c) y[i][r] += diagonal_[i][r * B + c] * x[i][c];
    return y;
  }

  Scratch<Row> preconditioned(Scratch<Row> x) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
      solve_lower<B>(factors_[i], x[i]);
      solve_upper<B>(factors_[i], x[i]);
    }
    return x;
  }

  static double dot(const Scratch<Row>& x, const Scratch<Row>& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int c = 0; c < B; ++c) sum += x[i][c] * y[i][c];
    return sum;
  }
  static void scale(Scratch<Row>& x, double factor) {
    for (Row& row : x)
      for (double& value : row) value *= factor;
  }
  static void add_to(Scratch<Row>& x, double share, const Scratch<Row>& y) {
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int c = 0; c < B; ++c) x[i][c] += share * y[i][c];
  }

  Scratch<Block> diagonal_, factors_;
};

}  // namespace lantern::physics
