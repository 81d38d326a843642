
#include "draw/axis.hpp"
#include "draw/font.hpp"
#include "draw/pen.hpp"
#include "geometry/elementary.hpp"
#include "report/pages.hpp"

namespace lantern::report {
namespace {

constexpr double kMapMargin = 48;
constexpr double kLegendLine = 118;
constexpr double kPanelHeading = 34;  // of a panel, over its plot
constexpr int kPanelsInRow = 3;
constexpr double kRowsGap = 34;
constexpr double kNoDamping = 14;  // height of the row of zeta = 0
constexpr double kRowGap = 6;      // and between it and the others

const TextStyle kTick{18, Weight::regular, Role::quiet_ink, Role::none};
const TextStyle kName{20, Weight::regular, Role::ink, Role::none};
const TextStyle kPanelName{21, Weight::semibold, Role::ink, Role::none};

// What a growth means, and how it is painted.
struct Band {
  double least;  // growths from here on
  std::string_view text;
  Role role;
};
const double kHair = 1e-9;  // what rounding may make of 1
const std::array kBands = {
    Band{0, "below 0.5", in_tone(body_role(6), Tone::shade)},
    Band{0.5, "below 0.9", body_role(6)},
    Band{0.9, "below 1", in_tone(body_role(6), Tone::lit)},
    Band{1 - kHair, "1, within 1e-9", Role::panel},
    Band{1 + kHair, "above 1", in_tone(body_role(1), Tone::lit)},
    Band{1.1, "above 1.1", body_role(1)},
    Band{2, "above 2", in_tone(body_role(1), Tone::shade)},
};
constexpr std::size_t kFirstGrowing = 4;

std::size_t band_of(double growth) {
  std::size_t band = kBands.size() - 1;
  while (band > 0 && growth < kBands[band].least) --band;
  return band;
}

std::string_view limit_of(Integrator method) {
  if (method == Integrator::explicit_euler) return "ωh = 2ζ, then 2(ζ − √(ζ² − 1))";
  if (method == Integrator::semi_implicit_euler) return "ωh = 2(√(1 + ζ²) − ζ)";
  if (method == Integrator::velocity_verlet) return "ωh = 2";
  if (method == Integrator::runge_kutta_4) return "ωh = 2.83 at ζ = 0, 2.79 at 1";
  return "no limit";
}

class Picture {
 public:
  explicit Picture(const StabilityMap& map) : map_(map), labels_(list_) {}

  DrawList draw() {
    draw_page_title("How one step multiplies the motion of a damped spring",
                    "measured with the engine, step by damping, beside the limit by theory",
                    kMapMargin, list_, labels_);
    draw_legend();
    const Box<2> area{{kMapMargin + 92, 158}, {list_.page.x - kMapMargin, list_.page.y - 84}};
    const double gap = 46;
    const Vec<2> size{(area.size().x - gap * (kPanelsInRow - 1)) / kPanelsInRow,
                      row_height(area) - kRowsGap};
    for (std::size_t i = 0; i < map_.panels.size(); ++i) {
      const auto column = static_cast<double>(i % kPanelsInRow),
                 row = static_cast<double>(i / kPanelsInRow);
      const Vec<2> corner = area.lo + Vec<2>(column * (size.x + gap), row * row_height(area));
      Box<2> plot{corner, corner + size};
      plot.lo.y += kPanelHeading;
      draw_panel(map_.panels[i], plot, i % kPanelsInRow == 0,
                 i + kPanelsInRow >= map_.panels.size());
    }
    name_axes(area);
    return std::move(list_);
  }

 private:
  static double row_height(const Box<2>& area) { return (area.size().y + kRowsGap) / 2; }
  Box<2> page() const { return {Vec<2>(0.0), list_.page}; }

  void draw_legend() {
    double x = kMapMargin;
    const auto word = [&](std::string_view text, const TextStyle& style) {
      labels_.add(text, {{x, kLegendLine}, 0}, style, page());
      x += text_width(text, style);
    };
    word("growth a step:", kName);
    x += 22;
    for (std::size_t band = 0; band < kBands.size(); ++band) {
      const Box<2> swatch{{x, kLegendLine - 18}, {x + 40, kLegendLine + 4}};
      paint(swatch, band);
      list_.crisp_rect(swatch, Role::none, {Role::cell_line_2, 1.2});
      x = swatch.hi.x + 9;
      word(kBands[band].text, kName);
      x += 26;
    }
    const Vec<2> from{x, kLegendLine - 7};
    draw_limit({from, from + Vec<2>(40, 0)}, page());
    x += 49;
    word("limit by theory", kName);
  }

  void paint(const Box<2>& box, std::size_t band) {
    list_.crisp_rect(box, kBands[band].role);
    if (band < kFirstGrowing) return;
    Pen(list_, box)
        .hatch({box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}}, 16, 1,
               {Role::panel, 1.2, 0});
  }

  void draw_limit(const std::vector<Vec<2>>& points, const Box<2>& place) {
    Pen pen(list_, place);
    pen.path(points, false, {Role::panel, 6.5, 0});
    pen.path(points, false, {Role::ink, 3, 0});
  }

  // Where a cell's edge or a value lies.
  double x_of(double omega_h, const Box<2>& plot) const {
    return plot.lo.x + geometry::log(omega_h / map_.omega_low) /
                           geometry::log(map_.omega_high / map_.omega_low) * plot.size().x;
  }
  double y_of(double zeta, const Box<2>& plot) const {
    const double bottom = plot.hi.y - kNoDamping - kRowGap;
    return bottom - geometry::log(zeta / map_.zeta_low) /
                        geometry::log(map_.zeta_high / map_.zeta_low) * (bottom - plot.lo.y);
  }

  // The row of cells `row`; row 0 is zeta = 0.
  Box<2> row_of(std::size_t row, const Box<2>& plot) const {
    if (row == 0) return {{plot.lo.x, plot.hi.y - kNoDamping}, plot.hi};
    const double bottom = plot.hi.y - kNoDamping - kRowGap;
    const double height = (bottom - plot.lo.y) / static_cast<double>(map_.zeta.size() - 1);
    // The same sum for both rows at an edge, or a hair would show between them.
    const auto edge = [&](std::size_t rows) { return bottom - static_cast<double>(rows) * height; };
    return {{plot.lo.x, edge(row)}, {plot.hi.x, edge(row - 1)}};
  }

  void draw_panel(const StabilityMap::Panel& panel, const Box<2>& plot, bool first, bool last) {
    const double heading = plot.lo.y - 12;
    labels_.add(method_words(to_string(panel.method)), {{plot.lo.x, heading}, 0}, kPanelName,
                page());
    labels_.add(limit_of(panel.method), {{plot.hi.x, heading}, 1}, kName, page());
    draw_cells(panel, plot);
    draw_limits(panel.method, plot);
    draw_ticks(plot, first, last);
  }

  // Neighbours in a row that look the same are one rectangle, and so are equal rows.
  void draw_cells(const StabilityMap::Panel& panel, const Box<2>& plot) {
    const std::size_t columns = map_.omega_h.size();
    const auto bands = [&](std::size_t row) {
      std::vector<std::size_t> list;
      for (std::size_t i = 0; i < columns; ++i)
        list.push_back(band_of(map_.growth_at(panel, i, row)));
      return list;
    };
    for (std::size_t row = 0; row < map_.zeta.size();) {
      const std::vector<std::size_t> now = bands(row);
      Box<2> box = row_of(row, plot);
      std::size_t next = row + 1;
      for (; row > 0 && next < map_.zeta.size() && bands(next) == now; ++next)
        box.lo.y = row_of(next, plot).lo.y;
      for (std::size_t from = 0; from < columns;) {
        std::size_t to = from + 1;
        while (to < columns && now[to] == now[from]) ++to;
        const double width = plot.size().x / static_cast<double>(columns);
        paint({{plot.lo.x + static_cast<double>(from) * width, box.lo.y},
               {plot.lo.x + static_cast<double>(to) * width, box.hi.y}},
              now[from]);
        from = to;
      }
      row = next;
    }
  }

  void draw_limits(Integrator method, const Box<2>& plot) {
    const Box<2> none = row_of(0, plot);
    Box<2> rest = plot;
    rest.hi.y = none.lo.y - kRowGap;
    for (const Box<2>& frame : {none, rest})
      list_.crisp_rect(frame, Role::none, {Role::cell_line_2, 1.4});
    if (std::isinf(stability_limit(method, 1))) return;
    std::vector<Vec<2>> points;
    constexpr int kPoints = 240;
    for (int i = 0; i <= kPoints; ++i) {
      const double share = static_cast<double>(i) / kPoints;
      const double zeta = map_.zeta_low * geometry::pow(map_.zeta_high / map_.zeta_low, share);
      points.push_back({x_of(stability_limit(method, zeta), plot), y_of(zeta, plot)});
    }
    draw_limit(points, rest);
    const double undamped = stability_limit(method, 0);
    if (undamped <= 0) return;
    const double x = x_of(undamped, plot);
    draw_limit({{x, none.lo.y}, {x, none.hi.y}}, none);
  }

  void draw_ticks(const Box<2>& plot, bool first, bool last) {
    const auto mark = [&](const Vec<2>& from, const Vec<2>& to) {
      list_.crisp_line(from, to, {Role::ink, 1.8});
    };
    const Axis steps = Axis::logarithmic(map_.omega_low, map_.omega_high, 9);
    for (const Axis::Tick& tick : steps.ticks()) {
      const double x = x_of(tick.value, plot);
      mark({x, plot.hi.y}, {x, plot.hi.y + 6});
      if (last) labels_.add(tick.text, {{x, plot.hi.y + 25}, 0.5}, kTick, page());
    }
    const auto row = [&](double y, std::string_view text) {
      mark({plot.lo.x - 6, y}, {plot.lo.x, y});
      if (first) labels_.add(text, {{plot.lo.x - 12, y + 6.5}, 1}, kTick, page());
    };
    const Axis ratios = Axis::logarithmic(map_.zeta_low, map_.zeta_high, 9);
    for (const Axis::Tick& tick : ratios.ticks()) {
      // The lowest would stand too close to the row of no damping.
      if (tick.value > 2 * map_.zeta_low) row(y_of(tick.value, plot), tick.text);
    }
    row(plot.hi.y - kNoDamping / 2, "0");
  }

  // Beside the first panel of each row, and below all.
  void name_axes(const Box<2>& area) {
    for (std::size_t row = 0; row * kPanelsInRow < map_.panels.size(); ++row) {
      const double y = area.lo.y + kPanelHeading - 12 + static_cast<double>(row) * row_height(area);
      labels_.add("damping", {{kMapMargin, y - 24}, 0}, kName, page());
      labels_.add("ratio ζ", {{kMapMargin, y}, 0}, kName, page());
    }
    labels_.add("step ωh: radians of the undamped swing in a step",
                {{area.center().x, list_.page.y - 22}, 0.5}, kName, page());
  }

  const StabilityMap& map_;
  DrawList list_;
  Labels labels_;
};

}  // namespace

DrawList draw_stability_map(const StabilityMap& map) { return Picture(map).draw(); }

}  // namespace lantern::report
