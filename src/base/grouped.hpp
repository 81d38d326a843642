// Long numbers as a book prints them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lantern {

// The digits of `number` with `gap` before each three from the right: 12345 is "12 345". Numbers of
// up to four digits stay whole.
std::string grouped(std::int64_t number, std::string_view gap = "\u2009");

}  // namespace lantern
