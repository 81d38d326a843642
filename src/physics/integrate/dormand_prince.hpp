// Dormand and Prince's pair of fifth and fourth order ("A family of embedded Runge-Kutta formulae",
// Journal of Computational and Applied Mathematics 6, 1980).
#pragma once

namespace lantern::physics {

// From which slopes each stage but the first follows: exact fractions, of which the last number of
// a row is the divisor. The last row is also the solution of fifth order.
inline constexpr int kDormandPrince[6][7] = {{1, 0, 0, 0, 0, 0, 5},
                                             {3, 9, 0, 0, 0, 0, 40},
                                             {44, -168, 160, 0, 0, 0, 45},
                                             {19372, -76080, 64448, -1908, 0, 0, 6561},
                                             {477901, -1806240, 1495424, 46746, -45927, 0, 167904},
                                             {12985, 0, 64000, 92750, -45927, 18656, 142464}};

// When that is, as a part of the step: the sum of its row.
template <class Real>
constexpr Real time_of_stage(int row) {
  int sum = 0;
  for (int k = 0; k < 6; ++k) sum += kDormandPrince[row][k];
  return Real(sum) / kDormandPrince[row][6];
}

}  // namespace lantern::physics
