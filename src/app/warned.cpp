#include "app/warned.hpp"

#include "app/commands.hpp"
#include "app/terminal.hpp"

namespace lantern {

int tell_warnings(std::vector<Diagnostic> warnings, bool strict) {
  for (Diagnostic& d : warnings) d.severity = strict ? Severity::error : Severity::warning;
  complain(warnings);
  return strict && !warnings.empty() ? kBadScenario : kGood;
}

}  // namespace lantern
