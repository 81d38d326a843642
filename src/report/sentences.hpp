// What a problem's rows say, in one sentence.
#pragma once

#include <string>

#include "report/problem_rows.hpp"

namespace lantern::report {

// The error that a method should stay under: 1e-6 if somebody does, else the least power of ten
// that somebody does. Nothing if no row has an error.
std::optional<double> error_bound(const ProblemRows& problem);

// "The cheapest method under 1e-6 is velocity Verlet: 0.8 ms at h = 0.005 s, 2060 force
// evaluations; explicit Euler does not get there even at the finest step." Cheapest in seconds
// where rows are timed, else in counted work. A peer that is cheaper than all methods is named
// first. Those that cost the same within the spread of their times (cheapest_rows) are told as
// equals, and so are methods with equal errors.
std::string sentence(const ProblemRows& problem);

// The same without counted work and without those that fall short.
std::string short_sentence(const ProblemRows& problem);

// "12 s", "0.8 ms", "41 µs".
std::string seconds_text(double seconds);
// "1e-6", "3.2e-9", "0.012": three figures, as one types them.
std::string figure(double number);

// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

// With a capital at its beginning, if that is a letter of ASCII.
std::string capital(std::string text);

}  // namespace lantern::report
