// What may be said of methods that miss a bound.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "report/problem_rows.hpp"

namespace lantern {

// A method that misses a bound in all of its runs. That it falls short even at the problem's finest
// step may be said only if that run was really made; a Shortfall is made of the rows themselves,
// and words about who falls short are made of Shortfalls alone, so no sentence can claim more.
class Shortfall {
 public:
  // Of a method of the problem.
  Shortfall(const MethodRows& method, const ProblemRows& problem)
      : name_(method_words(method.method)),
        kind_(finest_run_made(method, problem)                  ? Kind::at_finest_step
              : std::ranges::any_of(method.rows, &Row::was_run) ? Kind::within_runs_made
                                                                : Kind::not_run) {}

  enum class Kind { at_finest_step, within_runs_made, not_run };
  Kind kind() const { return kind_; }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  Kind kind_;
};

// "; explicit Euler does not get there even at the finest step; impulses were not run". Of more
// than three how many they are. Empty if there are none.
std::string shortfall_words(std::span<const Shortfall> all);

// "", or " within the runs made" if somebody's finest run is missing.
std::string within_runs_made(std::span<const Shortfall> all);

// Of methods that are named by what they give: "impulses", "soft contacts (16 sub-steps)".
bool is_plural(const std::string& name);

}  // namespace lantern
