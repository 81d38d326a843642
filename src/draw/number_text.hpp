// Numbers as a book prints them, and what they count.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lantern::frame {
struct Frame;
}

namespace lantern::draw {

// Thousands apart by a thin space ("1 234 567"), at most `decimals` of them after the point and no
// zeros at the end; beyond a million million as a power of ten ("1.2·10¹⁵"). A number that is not
// finite becomes a dash.
std::string number_text(double number, int decimals = 0);

// "12 pairs", "1 pair" of "pair/pairs".
std::string number_of(double number, std::string_view forms);

// With as many decimals as three figures need.
std::string short_number(double number);

// "10⁻⁵"; 1 and 10 as they are.
std::string power_of_ten(int power);

// A count's or measure's name as words: "pair tests" of "pair_tests", "energy: bob" of
// "energy.bob".
std::string chart_words(std::string name);

// What it is called beside its number: "leaf" or "leaves", "node visited" or "nodes visited",
// "energy: bob", "leaves: taxi": the form that `number` takes, which a measure does not have.
std::string count_words(std::string_view name, std::int64_t number);
// The same as the headline calls it, if that has words of its own.
std::string count_words(const frame::Frame& frame, std::string_view name, std::int64_t number);

}  // namespace lantern::draw
