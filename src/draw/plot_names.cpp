#include "draw/plot_names.hpp"

#include "draw/clip.hpp"

namespace lantern {

bool PlotNamer::name(const std::string& text, const std::vector<Anchor>& anchors,
                     const TextStyle& style, std::size_t most_crossed) {
  const Anchor* best = nullptr;
  std::size_t least = most_crossed + 1;
  for (const Anchor& anchor : anchors) {
    const Box<2> box = Labels::extent(text, anchor, style);
    if (!labels_.is_free(box, area_)) continue;
    bool on_mark = false;
    for (const Box<2>& mark : marks_) on_mark = on_mark || overlap(box, mark);
    if (on_mark) continue;
    std::size_t crossed = 0;
    for (const auto& [from, to] : lines_) crossed += cut_line(from, to, box).has_value();
    if (crossed >= least) continue;
    least = crossed;
    best = &anchor;
  }
  return best && labels_.try_add(text, {*best}, style, area_);
}

std::size_t PlotNamer::crowd(const Box<2>& place) const {
  std::size_t count = 0;
  for (const Box<2>& mark : marks_) count += overlap(place, mark);
  for (const auto& [from, to] : lines_) count += cut_line(from, to, place).has_value();
  return count;
}

}  // namespace lantern
