// Symmetric positive definite linear equations whose unknowns come in small groups, one a body, of
// which very many are linked: solved by conjugate gradients (Hestenes and Stiefel, "Methods of
// conjugate gradients for solving linear systems", 1952). Only the blocks on the diagonal are kept,
// and precondition the rest, which is asked for as a product with a vector. Memory is in proportion
// to the groups, not to the links.
//
// The sums are made in the order of the groups, so that the result depends on nothing but the
// input.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/stop.hpp"
#include "physics/block_system.hpp"

namespace lantern::physics {

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
  bool solve(std::vector<Row>& rows, double tolerance, AddLinks&& add_links) const {
    const auto product = [&](const std::vector<Row>& x) {
      std::vector<Row> y = on_diagonal(x);
      add_links(x, y);
      return y;
    };
    std::vector<Row> x(rows.size(), Row{}), missing = rows;
    const double allowed = tolerance * tolerance * dot(rows, preconditioned(rows));
    double before = 0;
    // What rounding has left is found from the equations themselves, and mended.
    for (int round = 0; round < kMostRounds; ++round) {
      const double lacks = dot(missing, preconditioned(missing));
      if (!std::isfinite(lacks)) return false;
      if (lacks <= allowed || (round > 0 && lacks > before / 4)) break;
      before = lacks;
      if (!descend(missing, std::max(allowed, kRounding * lacks), product, x)) return false;
      const std::vector<Row> found = product(x);
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
  bool descend(std::vector<Row> missing, double allowed, Product&& product,
               std::vector<Row>& x) const {
    std::vector<Row> z = preconditioned(missing), way = z;
    double lacks = dot(missing, z);
    for (int step = 0; step < kMostSteps && lacks > allowed; ++step) {
      stop_if_asked();
      const std::vector<Row> gained = product(way);
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

  std::vector<Row> on_diagonal(const std::vector<Row>& x) const {
    std::vector<Row> y(x.size(), Row{});
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int r = 0; r < B; ++r)
        for (int c = 0; c < B; ++c) y[i][r] += diagonal_[i][r * B + c] * x[i][c];
    return y;
  }

  std::vector<Row> preconditioned(std::vector<Row> x) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
      solve_lower<B>(factors_[i], x[i]);
      solve_upper<B>(factors_[i], x[i]);
    }
    return x;
  }

  static double dot(const std::vector<Row>& x, const std::vector<Row>& y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int c = 0; c < B; ++c) sum += x[i][c] * y[i][c];
    return sum;
  }
  static void scale(std::vector<Row>& x, double factor) {
    for (Row& row : x)
      for (double& value : row) value *= factor;
  }
  static void add_to(std::vector<Row>& x, double share, const std::vector<Row>& y) {
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int c = 0; c < B; ++c) x[i][c] += share * y[i][c];
  }

  std::vector<Block> diagonal_, factors_;
};

}  // namespace lantern::physics
