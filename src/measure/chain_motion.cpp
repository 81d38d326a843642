#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "measure/closed_forms.hpp"
#include "measure/precise.hpp"

namespace lantern::measure {
namespace {

using Column = std::vector<long double>;

long double dot(const Column& a, const Column& b) {
  long double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void rotate(Column& a, Column& b, long double c, long double s) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const long double x = a[i], y = b[i];
    a[i] = c * x - s * y;
    b[i] = s * x + c * y;
  }
}

}  // namespace

ChainMotion::ChainMotion(const Column& masses, const Column& stiffnesses,
                         const Column& displacements, const Column& velocities) {
  const std::size_t n = masses.size();
  LANTERN_CHECK(n > 0 && (stiffnesses.size() == n || stiffnesses.size() == n + 1), ==, true);
  for (const long double m : masses) root_mass_.push_back(std::sqrt(m));
  const auto all_equal = [](const Column& v) {
    return std::all_of(v.begin(), v.end(), [&](long double x) { return x == v.front(); });
  };
  if (stiffnesses.size() == n + 1 && all_equal(masses) && all_equal(stiffnesses))
    find_uniform_modes(n, masses.front(), stiffnesses.front());
  else
    find_modes(masses, stiffnesses);
  Column x(n), v(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = root_mass_[i] * displacements[i];
    v[i] = root_mass_[i] * velocities[i];
  }
  for (std::size_t k = 0; k < n; ++k) {
    cosines_.push_back(dot(modes_[k], x));
    sines_.push_back(dot(modes_[k], v) / omega_[k]);
  }
}

// omega_k = 2 sqrt(k/m) sin(k pi / (2 (N+1))), and mode k is sin(j k pi / (N+1)): Rayleigh, "The
// theory of sound", section 120.
void ChainMotion::find_uniform_modes(std::size_t n, long double mass, long double stiffness) {
  Column sines(2 * (n + 1));  // of all angles that come up
  for (std::size_t j = 0; j < sines.size(); ++j)
    sines[j] = std::sin(kPi * static_cast<long double>(j) / static_cast<long double>(n + 1));
  const long double unit = std::sqrt(2 / static_cast<long double>(n + 1));
  const long double fastest = 2 * std::sqrt(stiffness / mass);
  for (std::size_t k = 1; k <= n; ++k) {
    omega_.push_back(fastest * std::sin(kPi * static_cast<long double>(k) /
                                        static_cast<long double>(2 * (n + 1))));
    Column mode(n);
    for (std::size_t j = 1; j <= n; ++j) mode[j - 1] = unit * sines[j * k % sines.size()];
    modes_.push_back(std::move(mode));
  }
}

// The matrix of stretches, one row a spring: B = sqrt(k_i) (x_i - x_(i-1)) / sqrt(m). Its singular
// values are the frequencies. Rotating its columns until they are at right angles (Hestenes, 1958)
// gives even the slow ones to the last digits, whatever the ratio of stiffnesses (Demmel and
// Veselic, "Jacobi's method is more accurate than QR", 1992); the eigenvalues of B^T B would not.
void ChainMotion::find_modes(const Column& masses, const Column& stiffnesses) {
  const std::size_t n = masses.size();
  std::vector<Column> b(n, Column(stiffnesses.size(), 0.0L));
  modes_.assign(n, Column(n, 0.0L));
  for (std::size_t j = 0; j < n; ++j) {
    modes_[j][j] = 1;
    b[j][j] = std::sqrt(stiffnesses[j]) / root_mass_[j];
    if (j + 1 < stiffnesses.size()) b[j][j + 1] = -std::sqrt(stiffnesses[j + 1]) / root_mass_[j];
  }
  bool changed = true;
  for (int sweep = 0; changed && sweep < 60; ++sweep) {
    changed = false;
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        const long double pp = dot(b[p], b[p]), qq = dot(b[q], b[q]), pq = dot(b[p], b[q]);
        if (std::abs(pq) <= 0x1p-62L * std::sqrt(pp) * std::sqrt(qq)) continue;
        changed = true;
        const long double z = (qq - pp) / (2 * pq);
        const long double t = std::copysign(1 / (std::abs(z) + std::hypot(1.0L, z)), z);
        const long double c = 1 / std::hypot(1.0L, t);
        rotate(b[p], b[q], c, c * t);
        rotate(modes_[p], modes_[q], c, c * t);
      }
    }
  }
  for (const Column& column : b) omega_.push_back(std::sqrt(dot(column, column)));
}

void ChainMotion::at(long double time, Column& displacements, Column& velocities) const {
  const std::size_t n = root_mass_.size();
  displacements.assign(n, 0);
  velocities.assign(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const auto [c, s] = cos_sin(product(omega_[k], time));
    const long double x = cosines_[k] * c + sines_[k] * s;
    const long double v = omega_[k] * (sines_[k] * c - cosines_[k] * s);
    for (std::size_t j = 0; j < n; ++j) {
      displacements[j] += x * modes_[k][j];
      velocities[j] += v * modes_[k][j];
    }
  }
  for (std::size_t j = 0; j < n; ++j) {
    displacements[j] /= root_mass_[j];
    velocities[j] /= root_mass_[j];
  }
}

}  // namespace lantern::measure
