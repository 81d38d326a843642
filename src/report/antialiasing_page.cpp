#include <fmt/format.h>

#include "report/antialiasing.hpp"
#include "report/page_foot.hpp"

namespace lantern {

DrawList draw_picture_page(const PictureReport& report, const std::string& scene,
                           const std::string& circumstances) {
  constexpr double kMargin = 60;
  DrawList list;
  Labels labels(list);
  const std::string small =
      fmt::format("Drawn by {}, against 16 × 16 sub-pixels a pixel · cairo: {} · {}",
                  report.backend, report.cairo, circumstances);
  const double foot =
      draw_page_foot(cheapest_picture(report, scene), {}, small, kMargin, list, labels);
  draw_plot(picture_plot(report, scene), {{kMargin, 40}, {list.page.x - kMargin, foot - 22}}, list,
            labels);
  return list;
}

}  // namespace lantern
