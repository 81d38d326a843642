// What must hold for every page: labels apart and in their panels, shapes on the page, type large
// enough.
#pragma once

#include <gtest/gtest.h>

#include "draw/draw_list.hpp"

namespace lantern::draw {

inline Box<2> reach_of(const DrawShape& shape) {
  Box<2> box;
  double width = 0;
  if (const auto* rect = std::get_if<RectShape>(&shape)) {
    box = rect->box;
    width = rect->stroke.role == Role::none ? 0 : rect->stroke.width;
  } else if (const auto* line = std::get_if<LineShape>(&shape)) {
    box = united(Box<2>{line->from, line->from}, Box<2>{line->to, line->to});
    width = line->stroke.width;
  } else if (const auto* polygon = std::get_if<PolygonShape>(&shape)) {
    box = {polygon->points[0], polygon->points[0]};
    for (const Vec<2>& p : polygon->points) box = united(box, Box<2>{p, p});
    width = polygon->stroke.role == Role::none ? 0 : polygon->stroke.width;
  } else {
    box = {std::get<TextShape>(shape).at, std::get<TextShape>(shape).at};
  }
  return shrunk(box, -width / 2);
}

inline void expect_laid_out(const DrawList& list, const Box<2>& place, double least_type,
                            const std::string& where) {
  constexpr double kHair = 0.01;
  for (std::size_t i = 0; i < list.labels.size(); ++i) {
    const LabelBox& label = list.labels[i];
    EXPECT_TRUE(holds(shrunk(label.panel, -kHair), label.box))
        << where << ": '" << label.text << "' leaves its panel";
    EXPECT_TRUE(holds(shrunk(place, -kHair), label.box))
        << where << ": '" << label.text << "' leaves the page";
    for (std::size_t j = i + 1; j < list.labels.size(); ++j)
      EXPECT_FALSE(overlap(shrunk(label.box, kHair), shrunk(list.labels[j].box, kHair)))
          << where << ": '" << label.text << "' covers '" << list.labels[j].text << "'";
  }
  for (const DrawShape& shape : list.shapes) {
    const Box<2> r = reach_of(shape);
    EXPECT_TRUE(is_valid(r) && holds(shrunk(place, -1), r))
        << where << ": a shape of kind " << shape.index() << " reaches from (" << r.lo.x << ", "
        << r.lo.y << ") to (" << r.hi.x << ", " << r.hi.y << ")";
    if (const auto* text = std::get_if<TextShape>(&shape)) {
      EXPECT_GE(text->size, least_type - kHair) << where << ": '" << text->text << "'";
    }
  }
}

inline bool says(const DrawList& list, const std::string& text) {
  for (const LabelBox& label : list.labels)
    if (label.text == text) return true;
  return false;
}

inline bool says_part(const DrawList& list, const std::string& text) {
  for (const LabelBox& label : list.labels)
    if (label.text.find(text) != std::string::npos) return true;
  return false;
}

}  // namespace lantern::draw
