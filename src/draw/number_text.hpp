// Numbers as a book prints them.
#pragma once

#include <string>

namespace lantern::draw {

// Thousands apart by a thin space ("1 234 567"), at most `decimals` of them after the point and no
// zeros at the end; beyond a million million as a power of ten ("1.2·10¹⁵"). A number that is not
// finite becomes a dash.
std::string number_text(double number, int decimals = 0);

// With as many decimals as three figures need.
std::string short_number(double number);

// "10⁻⁵"; 1 and 10 as they are.
std::string power_of_ten(int power);

}  // namespace lantern::draw
