// What may be claimed of the methods of a problem: who misses a bound, and who is the same.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "report/problem_rows.hpp"

namespace lantern::report {

// Whether the method's run at the problem's finest step was really made, whatever came of it: it
// was neither refused nor left out for its time. Only then may it be said what the method cannot
// do.
bool finest_run_made(const MethodRows& method, const ProblemRows& problem);

// Methods whose errors agree in every run that two of them share, and in two runs at least: in
// everything that the problem asks of them they are the same. Agreement is to a billionth, since
// they round differently. Names, two or more a group, in order of their first rows.
std::vector<std::vector<std::string>> equal_methods(const ProblemRows& problem);

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

// A range of errors for which the cheapest run of all that are timed is a peer's: no other run has
// less error and less time (by their medians). Errors from `from` on, below `to`.
struct PeerRange {
  double from = 0;
  double to = 0;                   // infinite: there is no cheaper run
  std::vector<std::string> names;  // of who is the cheapest there, by growing errors
  bool operator==(const PeerRange&) const = default;
};

// In order of growing errors, as few as can be. Empty if no peer is on the front, or none was
// timed.
std::vector<PeerRange> peer_ranges(const ProblemRows& problem);

// "At every error the quickest run is one of Lantern's.", or where it is a peer's. Empty if there
// is nothing to compare: Lantern and peers were not both timed, or errors are counted.
std::string front_words(const ProblemRows& problem);

// Of methods that are named by what they give: "impulses", "soft contacts (16 sub-steps)".
bool is_plural(const std::string& name);

// What a reader must know beside the numbers: where peers are quicker, what the main norm is, how
// good its reference is, and who is measured otherwise than the rest. A sentence each.
std::vector<std::string> notes_on(const ProblemRows& problem);

}  // namespace lantern::report
