// What stands below the plots of a page: a sentence, and in small how it was measured.
#pragma once

#include <string>

#include "draw/labels.hpp"

namespace lantern {

// Between the page's margins, at its lower edge; `margin` in page units. The sentence has at most
// three lines, smaller type if it needs more than two. Gives the y of the rule above it.
double draw_page_foot(const std::string& sentence, const std::string& small, double margin,
                      DrawList& list, Labels& labels);

}  // namespace lantern
