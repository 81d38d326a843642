// The tables of the web page, and what its parts share.
#pragma once

#include <string>
#include <vector>

#include "report/bars.hpp"
#include "report/problem_rows.hpp"

namespace lantern::report {

// Who takes part in a page: methods, and machines with a measurement each.
struct HtmlCast {
  std::vector<MethodRows> methods;  // each once, Lantern's first; their rows are of one problem
  std::size_t machines = 1;

  bool is_shared() const { return machines > 1; }
  std::size_t number_of(const std::string& method) const;
  // Of whatever belongs to a method's runs on a machine: "m3", or "m3 k1" if there are several.
  std::string class_of(const std::string& method, std::size_t machine) const;
};

// 'A', 'B', ...
char machine_letter(std::size_t machine);

// A problem as each machine has it; null where it has not, but for one at least.
struct SharedProblem {
  std::string name;
  std::vector<const ProblemRows*> of;
  const ProblemRows& any() const;
};

// Each method's most exact run.
std::string best_table(const SharedProblem& problem, const HtmlCast& cast);
// All runs, folded away.
std::string runs_table(const SharedProblem& problem, const HtmlCast& cast);
// How the other engines were run. Those without a method on the page are left out.
std::string engines_table(const std::vector<PeerRecord>& peers, const HtmlCast& cast);
std::string bars_table(const std::vector<Bar>& bars);

}  // namespace lantern::report
