// What stands below the plots of a page: a sentence, and in small what a reader must know beside it
// and how it was measured.
#pragma once

#include <string>
#include <vector>

#include "draw/labels.hpp"

namespace lantern {

// Between the page's margins, at its lower edge; `margin` in page units. The sentence has at most
// three lines, smaller type if it needs more than two; so have the notes. Gives the y of the rule
// above it.
double draw_page_foot(const std::string& sentence, const std::vector<std::string>& notes,
                      const std::string& small, double margin, DrawList& list, Labels& labels);

}  // namespace lantern
