#include "report/web_plot.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "draw/labels.hpp"
#include "draw/plot_marks.hpp"
#include "draw/theme.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

std::string color_of(Role role) { return fmt::format("var(--r{})", static_cast<int>(role)); }

std::string paint(Role fill, const Stroke& stroke) {
  std::string text =
      fmt::format(" fill=\"{}\"", fill == Role::none ? std::string("none") : color_of(fill));
  if (stroke.role == Role::none || !(stroke.width > 0)) return text;
  text +=
      fmt::format(" stroke=\"{}\" stroke-width=\"{:.1f}\"", color_of(stroke.role), stroke.width);
  if (stroke.dash > 0) text += fmt::format(" stroke-dasharray=\"{:.1f}\"", stroke.dash);
  return text;
}

std::string to_tag(const RectShape& s) {
  const Vec<2> size = s.box.size();
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"{}{}/>",
                     s.box.lo.x, s.box.lo.y, size.x, size.y,
                     s.radius > 0 ? fmt::format(" rx=\"{:.1f}\"", s.radius) : "",
                     paint(s.fill, s.stroke));
}
std::string to_tag(const LineShape& s) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"{}/>", s.from.x,
                     s.from.y, s.to.x, s.to.y, paint(Role::none, s.stroke));
}
std::string to_tag(const PolygonShape& s) {
  std::string points;
  for (const Vec<2>& p : s.points)
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", p.x, p.y);
  return fmt::format("<polygon points=\"{}\"{}/>", points, paint(s.fill, s.stroke));
}
std::string to_tag(const TextShape& s) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.1f}\" text-anchor=\"{}\" "
      "fill=\"{}\">{}</text>",
      s.at.x, s.at.y, s.size,
      s.align == 0   ? "start"
      : s.align == 1 ? "end"
                     : "middle",
      color_of(s.role), escaped(s.text));
}
std::string to_tag(const DrawShape& shape) {
  return std::visit([](const auto& s) { return to_tag(s); }, shape);
}

// What of a plot a shape is of, by its key.
struct Part {
  std::optional<std::size_t> series, point;
  bool is_whisker = false;
  bool operator==(const Part&) const = default;
};

Part part_of(const std::string& key) {
  constexpr std::string_view kSeries = "series/";
  Part part;
  if (!key.starts_with(kSeries)) return part;
  const char* const end = key.data() + key.size();
  std::size_t number = 0;
  const char* at = std::from_chars(key.data() + kSeries.size(), end, number).ptr;
  part.series = number;
  if (at == end) return part;
  part.is_whisker = std::from_chars(at + 1, end, number).ec != std::errc();
  if (!part.is_whisker) part.point = number;
  return part;
}

class PlotWriter {
 public:
  PlotWriter(const Plot& plot, const std::vector<std::string>& classes)
      : plot_(plot), classes_(classes) {}

  std::string text() {
    DrawList list = drawn();
    put("<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">",
        list.page.x, list.page.y, escaped(plot_.title));
    Part open;
    std::size_t run = 0;
    for (std::size_t i = 0; i < list.shapes.size(); ++i) {
      while (run < list.runs.size() && list.runs[run].first <= i) ++run;
      const Part part = run > 0 ? part_of(list.runs[run - 1].key) : Part();
      if (part != open) {
        close(open);
        begin(part);
        open = part;
      }
      out_ += to_tag(list.shapes[i]);
    }
    close(open);
    return out_ + "</svg>\n";
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  DrawList drawn() const {
    Plot plot = plot_;
    plot.title.clear();
    plot.y_name.clear();
    plot.slopes.clear();
    plot.names = PlotNames::none;
    plot.size = 15;
    DrawList list;
    list.page = {620, 400};
    Labels labels(list);
    draw_plot(plot, shrunk({Vec<2>(0.0), list.page}, 2), list, labels);
    return list;
  }

  void begin(const Part& part) {
    if (!part.series) return;
    const PlotSeries& series = plot_.series[*part.series];
    put("<g class=\"{}{}\" style=\"--c:{}\">", classes_[*part.series],
        series.is_peer ? " peer" : "", color_of(series.ink().role()));
    if (part.is_whisker) put("<g class=\"whisker\">");
    if (!part.point) return;
    const PlotPoint& p = series.points[*part.point];
    put("<g class=\"{}\"><title>{}: {}; {}</title>", p.beyond || p.open ? "open" : "mark",
        escaped(series.name), figure(p.at.x), p.beyond ? escaped(plot_.beyond) : figure(p.at.y));
  }
  void close(const Part& part) {
    if (part.series) out_ += part.point || part.is_whisker ? "</g></g>" : "</g>";
  }

  const Plot& plot_;
  const std::vector<std::string>& classes_;
  std::string out_;
};

}  // namespace

std::string web_colors(std::string_view name) {
  const Theme theme = *theme_named(name);
  std::string text;
  for (std::size_t role = 1; role < theme.colors.size(); ++role) {
    const Color& c = theme.colors[role];
    text += fmt::format("--r{}:#{:02x}{:02x}{:02x};", role, c.r, c.g, c.b);
  }
  return text;
}

std::string web_sample(const PlotInk& ink) {
  DrawList list;
  draw_plot_line(ink, {1, 7}, {33, 7}, 2, list);
  draw_plot_mark(ink, {17, 7}, 4.6, false, list);
  std::string text = "<svg class=\"sample\" viewBox=\"0 0 34 14\" aria-hidden=\"true\">";
  for (const DrawShape& shape : list.shapes) text += to_tag(shape);
  return text + "</svg>";
}

std::string web_plot(const Plot& plot, const std::vector<std::string>& classes) {
  return PlotWriter(plot, classes).text();
}

}  // namespace lantern::report
