// Cholesky factors of small symmetric positive definite matrices, kept row by row, of which only
// the lower half counts.
#pragma once

#include <array>
#include <cmath>

namespace lantern::physics {

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

}  // namespace lantern::physics
