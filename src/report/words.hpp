// Numbers and names as reports write them.
#pragma once

#include <string>
#include <vector>

namespace lantern::report {

// "12 s", "0.8 ms", "41 µs".
std::string seconds_text(double seconds);
// "1e-6", "3.2e-9", "0.012": three figures, as one types them.
std::string figure(double number);

// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& names);

// With a capital at its beginning, if that is a letter of ASCII.
std::string capital(std::string text);

}  // namespace lantern::report
