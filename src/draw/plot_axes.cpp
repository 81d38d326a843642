#include "draw/plot_axes.hpp"

#include <algorithm>

namespace lantern {

void PlotPaper::heading(const std::string& text, const TextStyle& style) {
  const std::string words = shortened(text, place.panel.size().x, style);
  if (words.empty() || place.panel.size().y < 60) return;
  labels_.add(words, {{place.panel.lo.x, place.area.lo.y + 0.78 * style.size}, 0}, style,
              place.panel);
  place.area.lo.y += 1.42 * style.size;
}

void PlotPaper::reserve_x(bool named) {
  place.area.hi.y -= type.under_ticks() + 8 * type.unit + (named ? 1.5 * type.name.size : 0);
}

void PlotPaper::reserve_y(const Axis& y) {
  double widest = 0;
  for (const Axis::Tick& tick : y.ticks())
    widest = std::max(widest, text_width(tick.text, type.tick));
  place.area.lo.x +=
      std::min(widest + 1, 0.3 * place.panel.size().x) + type.tick_length() + 8 * type.unit;
}

void PlotPaper::level_ticks(const Axis& x, double top, double bottom, const Stroke& stroke,
                            double below, double apart) {
  const Box<2>& area = place.area;
  double last = -1e9;
  for (const Axis::Tick& tick : x.ticks()) {
    const double at = area.lo.x + x.share(tick.value) * area.size().x;
    list_.crisp_line({at, top}, {at, bottom}, stroke);
    const double half = text_width(tick.text, type.tick) / 2;
    if (at - half < last + apart) continue;
    const Anchor anchor{{at, bottom + below + 0.78 * type.tick.size}, 0.5};
    if (labels_.try_add(tick.text, {anchor}, type.tick, place.panel)) last = at + half;
  }
}

void PlotPaper::upright_ticks(const Axis& y) {
  const Box<2> scaled = place.scaled();
  const double end = scaled.lo.x - type.tick_length(), room = end - 6 * type.unit;
  const auto write = [&](const std::string& text, double at) {
    labels_.try_add(shortened(text, room - place.panel.lo.x, type.tick),
                    {{{room, at + 0.36 * type.tick.size}, 1}}, type.tick, place.panel);
  };
  if (place.ground > 0) write("0", place.area.hi.y - place.ground / 2);
  double last = 1e9;
  for (const Axis::Tick& tick : y.ticks()) {
    const double at = scaled.hi.y - y.share(tick.value) * scaled.size().y;
    list_.crisp_line({end, at}, {scaled.hi.x, at}, {Role::rule, 1.5 * type.unit});
    if (at > last - 22 * type.unit) continue;
    write(tick.text, at);
    last = at;
  }
}

void PlotPaper::axis_lines() {
  const Box<2>&area = place.area, scaled = place.scaled();
  for (const Vec<2>& end : {area.lo, area.hi})
    list_.crisp_line({area.lo.x, area.hi.y}, end, {Role::ink, 2.2 * type.unit});
  for (const double at : {scaled.lo.y, scaled.hi.y})
    if (at != area.lo.y && at != area.hi.y)
      list_.crisp_line({area.lo.x, at}, {area.hi.x, at}, {Role::cell_line_3, 1.2, 4});
}

void PlotPaper::name_x(const std::string& name, const std::string& note, const TextStyle& style) {
  const double left = place.area.lo.x, right = place.panel.hi.x;
  std::string text = name + note;
  if (text_width(text, style) > right - left) text = shortened(name, right - left, style);
  const double half = text_width(text, style) / 2;
  const double x =
      std::clamp(place.area.center().x, left + half, std::max(left + half, right - half));
  labels_.try_add(text, {{{x, place.panel.hi.y - 7 * type.unit}, 0.5}}, style, place.panel);
}

void PlotPaper::say_nothing(const std::string& why) {
  list_.crisp_rect(place.area, Role::panel, {Role::rule, 1.2});
  const double room = place.area.size().x - 2 * type.name.size;
  labels_.try_add(shortened(why, room, type.tick), {{place.area.center(), 0.5}}, type.tick,
                  place.panel);
}

}  // namespace lantern
