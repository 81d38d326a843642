#include "draw/plot.hpp"

namespace lantern {

void draw_plot(const Plot&, const Box<2>&, DrawList&, Labels&) {}

}  // namespace lantern
