// What a run was warned of, for check and render alike.
#pragma once

#include <vector>

#include "base/error.hpp"

namespace lantern {

// Says them on standard error and gives the exit code that they deserve: good, or, with `strict`,
// where they are errors, that of a bad scenario.
int tell_warnings(std::vector<Diagnostic> warnings, bool strict);

}  // namespace lantern
