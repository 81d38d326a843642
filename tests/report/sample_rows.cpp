#include "report/sample_rows.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace lantern::report::samples {
namespace {

struct Method {
  const char* name;
  double order, factor;  // error = factor * step^order
  double limit;          // diverges from this step on
  double evaluations;    // a step
  const char* version = "";
};

const Method kSmooth[] = {
    {"explicit_euler", 1, 6, 0.06, 1},     {"semi_implicit_euler", 1, 2, 0.3, 1},
    {"velocity_verlet", 2, 3, 0.3, 1},     {"runge_kutta_4", 4, 4, 0.42, 4},
    {"implicit_midpoint", 2, 1.7, 1e9, 7}, {"implicit_euler", 1, 8, 1e9, 5},
    {"Bullet", 1, 2.1, 0.3, 0, "3.25"},    {"MuJoCo", 1, 2.4, 0.3, 0, "0.16.2"},
    {"Box2D", 1, 2.2, 1e9, 0, "3.1"}};
const Method kContacts[] = {
    {"impulse:10", 1, 0.4, 1e9, 0},       {"impulse:100", 1, 0.02, 1e9, 0},
    {"soft:4", 1, 0.1, 1e9, 0},           {"soft:16", 1, 0.03, 1e9, 0},
    {"Bullet", 0.3, 0.1, 1e9, 0, "3.25"}, {"Jolt", 0.6, 0.02, 1e9, 0, "5.2.0"}};
const Method kTop[] = {{"splitting_2", 2, 0.5, 1e9, 3},
                       {"splitting_4", 4, 2, 1e9, 9},
                       {"explicit_gyroscopic", 1, 3, 0.06, 1},
                       {"Bullet", 1, 4, 0.1, 0, "3.25"}};

struct Problem {
  const char *name, *family, *variant;
  double seconds, stiffness;
  int kind;  // 0 smooth, 1 contacts, 2 top, 3 exact
};
const Problem kProblems[] = {{"oscillator", "oscillator", "plain", 10.3, 1, 0},
                             {"oscillator_stiff", "oscillator", "stiff", 10.3, 40, 0},
                             {"kepler", "kepler", "plain", 12.6, 3, 0},
                             {"kepler_extreme", "kepler", "extreme", 400, 9, 0},
                             {"pendulum", "pendulum", "plain", 8, 0.6, 0},
                             {"top", "top", "plain", 10, 1, 2},
                             {"stack", "stack", "plain", 10, 1, 1},
                             {"stack_extreme", "stack", "extreme", 10, 30, 1},
                             {"projectile", "projectile", "plain", 10, 1, 3}};

Row run(const Problem& problem, const Method& method, double h, Random& random) {
  const double steps = std::ceil(problem.seconds / h);
  const double floor = 0x1p-52 * std::sqrt(steps);
  const double wobble = random.between(0.97, 1.03);
  double error = method.factor * problem.stiffness * std::pow(h, method.order) * wobble;
  if (problem.kind == 3) error = method.order >= 2 ? 0 : 5 * h;
  Row row;
  row.problem = problem.name;
  row.family = problem.family;
  row.variant = problem.variant;
  row.file = row.problem + ".toml";
  row.reference = "closed form";
  row.method = method.name;
  row.version = method.version;
  row.step = h;
  row.norms = {{problem.kind == 1 ? "depth" : "traj", error + floor * random.unit(),
                problem.kind == 1 ? "units" : "1", "largest error over the run"}};
  if (problem.kind == 0) {
    row.drift.energy = 0.1 * error;
    for (const double share : {0.1, 0.2, 0.5, 1.0})
      row.samples.push_back({share * problem.seconds, share * error, share * *row.drift.energy});
  }
  const bool contacts = problem.kind == 1;
  const double each = method.evaluations > 0 ? 60e-9 + 25e-9 * method.evaluations : 900e-9;
  row.counted.steps = static_cast<std::uint64_t>(steps);
  row.counted.force_evaluations = static_cast<std::uint64_t>(steps * method.evaluations);
  const double sweeps = method.name[0] == 'i' ? (method.name[9] == '0' ? 100 : 10) : 16;
  if (contacts && row.version.empty())
    row.counted.constraint_rows = static_cast<std::uint64_t>(steps * 60 * sweeps);
  const double seconds = steps * each * (contacts ? 60 * sweeps / 10 : 1) * wobble;
  row.timing = {
      15, seconds, 0.97 * seconds, 0.99 * seconds, 1.01 * seconds, 0.98 * seconds, 1.02 * seconds};
  row.processor = row.timing;
  row.hash = random.bits();
  if (h * std::sqrt(problem.stiffness) > method.limit) {
    row.status = Status::diverged;
    row.reason = "the energy grew beyond 1e6 times its first value";
  }
  return row;
}

template <class Methods>
void run_all(const Problem& problem, const Methods& methods, Random& random, Measurement& to) {
  for (const Method& method : methods) {
    double h = 0.103;
    for (int i = 0; i < 8; ++i, h /= 2) to.rows.push_back(run(problem, method, h, random));
  }
}

}  // namespace

Row row(const std::string& method, double step, double error, double seconds,
        std::uint64_t evaluations) {
  Row r;
  r.problem = r.family = "oscillator";
  r.variant = "plain";
  r.method = method;
  r.step = step;
  r.norms = {{"traj", error}};
  if (seconds > 0)
    r.processor = r.timing = {15, seconds, seconds, seconds, seconds, seconds, seconds};
  r.counted.steps = r.counted.force_evaluations = evaluations;
  return r;
}

Measurement measurement(std::size_t problems, std::uint64_t seed) {
  Random random(seed);
  Measurement m;
  m.circumstances = {"0.1.0",
                     "0123456789abcdef",
                     "g++ 13.2.0",
                     "-O3 -ffp-contract=off",
                     "Intel(R) Xeon(R) Platinum 8488C",
                     seed,
                     "normal",
                     "2026-03-01 12:00 UTC",
                     2,
                     0.5,
                     1.5};
  for (std::size_t i = 0; i < problems; ++i) {
    Problem problem = kProblems[i % std::size(kProblems)];
    const std::string name =
        problem.name + (i < std::size(kProblems) ? "" : "_" + std::to_string(i));
    problem.name = name.c_str();
    if (problem.kind == 1)
      run_all(problem, kContacts, random, m);
    else if (problem.kind == 2)
      run_all(problem, kTop, random, m);
    else
      run_all(problem, kSmooth, random, m);
  }
  return m;
}

std::vector<Bar> bars() {
  return {
      {"free fall, 10 s at 1 ms", 3.1e-12, 1e-10, "m", "projectile, velocity_verlet", false,
       "0.0245 m"},
      {"torque-free, change of L", 3e-14, 1e-12, "", "top, splitting_2", false, "6e-3"},
      {"torque-free, change of E", 1.4e-6, 2e-6, "", "top, splitting_2", false, ""},
      {"elastic bounce, 20 s, change of E", 4.2e-13, 1e-12, "", "ball_elastic, soft:4", false,
       "5.7e-6"},
      {"tallest stack that stands", 60.0, 60, "boxes", "stack_extreme, soft:16", true, "60 (Jolt)"},
      {"its deepest penetration", 0.21e-3, 1e-4, "m", "stack_extreme, soft:16", false, "0.1 mm"},
      {"heavy on light, 10 000 : 1", std::nullopt, 5e-3, "m", "heavy_on_light", false, "11 mm"},
      {"sliding distance", 0.0, 1e-6, "m", "slide, impulse:100", false, "1e-2 m"},
      {"far from the origin, 1e7", std::nan(""), 1e-6, "m", "far, soft:16", false, "1e-3 m"},
  };
}

}  // namespace lantern::report::samples
