// The stability map: how much one step of each method multiplies a damped spring's motion, measured
// with the real engine, over the step (omega h) and the damping ratio (zeta).
#pragma once

#include "physics/integrate/integrator.hpp"

namespace lantern::measure {

// The growth a step: the spectral radius of the step's matrix, which takes (x, v) to the next
// (x, v). The spring is linear, so a step is, too: two steps of the engine from independent starts
// give the matrix. A long run grows or shrinks by this factor a step.
double measured_growth(Integrator method, double omega_h, double zeta);

// The same by theory: the method is stable for omega h below this. 0 if never, infinite if always.
// For explicit methods see Hairer, Norsett and Wanner, "Solving Ordinary Differential Equations I".
double stability_limit(Integrator method, double zeta);

// A growth beyond rounding.
inline bool grows(double growth) { return !(growth <= 1 + 1e-9); }

struct StabilityMap {
  struct Panel {
    Integrator method{};
    std::vector<double> growth;  // of omega_h[i] and zeta[j] at [j * omega_h.size() + i]
  };
  std::vector<double> omega_h;  // ascending, the logarithmic middles of the cells
  std::vector<double> zeta;     // 0 first, then ascending as those
  double omega_low = 1e-2, omega_high = 1e2, zeta_low = 1e-3,
         zeta_high = 1e3;     // edges of the cells
  std::vector<Panel> panels;  // one a method

  double growth_at(const Panel& panel, std::size_t column, std::size_t row) const {
    return panel.growth[row * omega_h.size() + column];
  }
};

// From 0.01 to 100 in omega h, 0.001 to 1000 in zeta.
StabilityMap make_stability_map();

}  // namespace lantern::measure
