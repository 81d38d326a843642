// The marks and colours of measured points.
#pragma once

#include "draw/draw_list.hpp"

namespace lantern {

inline constexpr int kPlotMarks = 14;     // shapes; with 8 colours, 56 looks are unlike
inline constexpr int kFirstPeerLook = 8;  // from here on crosses and stars: what peers take

// The colour of a look, 0 or more.
Role plot_role(int look);

// A mark, `radius` large; open: of something that is not there, such as a diverged run.
void draw_plot_mark(int look, const Vec<2>& at, double radius, bool open, DrawList& list);

// A whisker through a mark of that radius, level or upright, with a short bar across either end.
void draw_plot_whisker(int look, const Vec<2>& from, const Vec<2>& to, double radius,
                       DrawList& list);

// A line in a look's colour, so that pale colours stay visible on pale ground.
void draw_plot_line(int look, bool is_peer, const Vec<2>& from, const Vec<2>& to, double width,
                    DrawList& list);

}  // namespace lantern
