// Names inside a plot: put where they cover no mark and few lines.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/labels.hpp"

namespace lantern {

class PlotNamer {
 public:
  // Names stay in `area`.
  PlotNamer(const Box<2>& area, Labels& labels) : area_(area), labels_(labels) {}

  void cross(const Vec<2>& from, const Vec<2>& to) { lines_.push_back({from, to}); }
  void mark(const Vec<2>& at, double radius) {
    marks_.push_back(Box<2>::around(at, Vec<2>(radius)));
  }

  // The text at the anchor where it crosses the fewest lines, the first of equal ones; never on a
  // mark or another label. False, and nothing is drawn, if there is none, or if more than
  // `most_crossed` lines run through it.
  bool name(const std::string& text, const std::vector<Anchor>& anchors, const TextStyle& style,
            std::size_t most_crossed);

  // How many marks and lines touch the place.
  std::size_t crowd(const Box<2>& place) const;

 private:
  Box<2> area_;
  Labels& labels_;
  std::vector<std::pair<Vec<2>, Vec<2>>> lines_;
  std::vector<Box<2>> marks_;
};

}  // namespace lantern
