// Masses in a row, each tied to the next by a spring: small or large motion along the row, since
// the springs are linear.
#pragma once

#include <vector>

namespace lantern {

// Both ends are fixed, or only the first: with N masses there are N + 1 or N springs. Masses and
// stiffnesses above 0. Displacements and velocities are from rest, at time 0.
class ChainMotion {
 public:
  ChainMotion(const std::vector<long double>& masses, const std::vector<long double>& stiffnesses,
              const std::vector<long double>& displacements,
              const std::vector<long double>& velocities);

  void at(long double time, std::vector<long double>& displacements,
          std::vector<long double>& velocities) const;

  const std::vector<long double>& frequencies() const { return omega_; }  // radians a second

 private:
  void find_uniform_modes(std::size_t n, long double mass, long double stiffness);
  void find_modes(const std::vector<long double>& masses,
                  const std::vector<long double>& stiffnesses);

  std::vector<long double> omega_;
  std::vector<std::vector<long double>> modes_;  // [mode][mass], of unit length
  std::vector<long double> root_mass_;
  std::vector<long double> cosines_, sines_;  // what of each mode there is at the start
};

}  // namespace lantern
