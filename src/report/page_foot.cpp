#include "report/page_foot.hpp"

#include "draw/metrics.hpp"

namespace lantern {

double draw_page_foot(const std::string& sentence, const std::string& small, double margin,
                      DrawList& list, Labels& labels) {
  constexpr double kSentence = 25, kLineHeight = 36;
  TextStyle style{kSentence, Weight::regular, Role::ink, Role::none};
  const TextStyle quiet{kLeastLabel + 0.1, Weight::regular, Role::quiet_ink, Role::none};
  const double width = list.page.x - 2 * margin;
  std::vector<std::string> lines = wrapped(sentence, width, style);
  if (lines.size() > 2) {
    style.size = kLeastCaption;
    lines = wrapped(sentence, width, style);
  }
  if (lines.size() > 3) lines = {lines[0], lines[1], shortened(lines[2] + " …", width, style)};
  const double top = list.page.y - 62 - kLineHeight * static_cast<double>(lines.size());
  const Box<2> band{{margin, top}, {list.page.x - margin, list.page.y - 14}};
  double y = top + 36;
  for (const std::string& words : lines) {
    labels.add(words, {{margin, y}, 0}, style, band);
    y += kLineHeight;
  }
  labels.add(shortened(small, width, quiet), {{margin, list.page.y - 26}, 0}, quiet, band);
  list.shapes.emplace_back(
      LineShape{{margin, top}, {list.page.x - margin, top}, {Role::rule, 1.6, 0}, true});
  return top;
}

}  // namespace lantern
