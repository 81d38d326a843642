// Symmetric positive definite linear equations, solved directly by Cholesky factors. Each line of
// the factor begins where the matrix's does (an envelope: Jennings, "A Compact Storage Scheme",
// 1966), so that a chain or a stack, numbered from end to end, costs time in proportion to its
// length.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/stop.hpp"

namespace lantern::physics {

class EnvelopeSystem {
 public:
  void clear() {
    first_.clear();
    start_.clear();
    entries_.clear();
    work_ = 0;
  }

  // Room for so many lines, if they are short.
  void reserve(std::size_t lines) {
    constexpr std::size_t kShort = 8;
    first_.reserve(lines);
    start_.reserve(lines);
    entries_.reserve(lines * kShort);
  }

  // The next line has nothing before the column `first`, which is no further than its diagonal.
  void add_line(std::size_t first) {
    const std::size_t length = first_.size() - first + 1;
    first_.push_back(first);
    start_.push_back(entries_.size());
    entries_.resize(entries_.size() + length);
    work_ += static_cast<double>(length) * static_cast<double>(length) / 2;
  }

  std::size_t lines() const { return first_.size(); }
  double work() const { return work_; }  // products that a factor takes, about

  // Finds the factor of the matrix whose entries are matrix(line, column), asked for once each, up
  // to the diagonal. False if it is not positive definite, or if of a line no more than the part
  // `least` is left by what those before it say.
  template <class Matrix>
  bool factor(Matrix&& matrix, double least = 0) {
    for (std::size_t i = 0; i < lines(); ++i) {
      stop_if_asked();
      double* line_i = &entries_[start_[i]];
      for (std::size_t j = first_[i]; j <= i; ++j) {
        const double* line_j = &entries_[start_[j]];
        double value = matrix(i, j);
        const double whole = value;
        for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k)
          value -= line_i[k - first_[i]] * line_j[k - first_[j]];
        if (i == j && !(value > least * whole)) return false;
        line_i[j - first_[i]] = i == j ? std::sqrt(value) : value / line_j[j - first_[j]];
      }
    }
    return true;
  }

  // Replaces the right-hand side by the solution. After `factor`.
  void solve(std::vector<double>& values) const {
    for (std::size_t i = 0; i < lines(); ++i) {
      stop_if_asked();
      const double* line = &entries_[start_[i]];
      double value = values[i];
      for (std::size_t j = first_[i]; j < i; ++j) value -= line[j - first_[i]] * values[j];
      values[i] = value / line[i - first_[i]];
    }
    for (std::size_t i = lines(); i-- > 0;) {
      const double* line = &entries_[start_[i]];
      values[i] /= line[i - first_[i]];
      for (std::size_t j = first_[i]; j < i; ++j) values[j] -= line[j - first_[i]] * values[i];
    }
  }

 private:
  std::vector<std::size_t> first_, start_;  // of each line: its first column, and where it is kept
  std::vector<double> entries_;             // of the factor
  double work_ = 0;
};

}  // namespace lantern::physics
