#include "report/bars.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "measure/stress.hpp"
#include "report/words.hpp"

namespace lantern::report {
namespace {

// The best that we saw of other engines, or read in their own tests: for orientation only, the
// bounds are Lantern's.
std::string seen_elsewhere(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kSeen[] = {
      {"free_fall", "0.0245 m"},           {"torque_free_momentum", "6e-3"},
      {"elastic_bounce", "5.7e-6"},        {"stack_of_60", "0.1 mm (Jolt)"},
      {"heavy_on_light", "11 mm (Jolt)"},  {"chain_of_rods", "13 mm (Jolt)"},
      {"sliding", "1e-2 m (Jolt's test)"}, {"far_from_origin", "1e-3 m (Box2D's test)"},
  };
  for (const auto& [known, seen] : kSeen)
    if (known == name) return std::string(seen);
  return {};
}

constexpr double kRow = 27;
constexpr double kHead = 62;
constexpr double kDecades = 4;  // that the strip shows to each side of the bar

const TextStyle kQuiet{16, Weight::regular, Role::quiet_ink, Role::none};
const TextStyle kText{16.5, Weight::regular, Role::ink, Role::none};
const TextStyle kMissed{16.5, Weight::semibold, Role::ink, Role::none};

// "1 hash" of hashes.
std::string with_unit(const std::string& number, const std::string& unit) {
  if (number == "1" && (unit.ends_with("shes") || unit.ends_with("xes")))
    return number + " " + unit.substr(0, unit.size() - 2);
  return unit.empty() ? number : number + " " + unit;
}

// Columns as shares of the width: their left ends.
enum Column { name, bar, measured, strip, verdict, elsewhere, reference, end };
constexpr double kAt[] = {0, 0.245, 0.345, 0.445, 0.59, 0.655, 0.785, 1};

class Table {
 public:
  Table(const Box<2>& place, DrawList& list, Labels& labels)
      : place_(place), list_(list), labels_(labels) {}

  void head() {
    labels_.add("Bars", {{place_.lo.x, place_.lo.y + 20}, 0},
                {20, Weight::semibold, Role::ink, Role::none}, place_);
    const double y = place_.lo.y + kHead - 14;
    put(name, "quantity", kQuiet, y);
    put(bar, "bar", kQuiet, y);
    put(measured, "measured", kQuiet, y);
    labels_.add("better", {{x(strip), y}, 0}, kQuiet, place_);
    labels_.add("worse", {{x(verdict) - 20, y}, 1}, kQuiet, place_);
    put(elsewhere, "best seen elsewhere", kQuiet, y);
    put(reference, "read from", kQuiet, y);
    line(place_.lo.y + kHead - 4);
  }

  void row(const Bar& b, double top) {
    const double y = top + 0.7 * kRow;
    put(name, b.name, kText, y);
    put(bar, (b.at_least ? "≥ " : "≤ ") + with_unit(figure(b.bound), b.unit), kText, y);
    put(measured, told(b), kText, y);
    const auto met = b.met();
    put(verdict, !met ? "not run" : *met ? "met" : "missed", met == false ? kMissed : kText, y);
    put(elsewhere, b.elsewhere.empty() ? "–" : b.elsewhere, kText, y);
    put(reference, b.reference, kQuiet, y);
    draw_strip(b, top);
  }

  void line(double y) {
    list_.crisp_line({place_.lo.x, y}, {place_.hi.x, y}, {Role::cell_line_3, 1.2});
  }

 private:
  double x(Column c) const { return place_.lo.x + kAt[c] * place_.size().x; }

  void put(Column c, const std::string& text, const TextStyle& style, double y) {
    const double room = x(static_cast<Column>(c + 1)) - x(c) - (c + 1 == end ? 0 : 14);
    labels_.add(shortened(text, room, style), {{x(c), y}, 0}, style, place_);
  }

  static std::string told(const Bar& b) {
    if (!b.value) return "–";
    return std::isfinite(*b.value) ? with_unit(figure(*b.value), b.unit) : "not finite";
  }

  // Decades from the bar: below 0 is better.
  static double distance(const Bar& b) {
    if (!std::isfinite(*b.value)) return 1e9;
    if (*b.value == b.bound) return 0;
    if (b.bound <= 0 || *b.value <= 0) return (*b.value < b.bound) == b.at_least ? 1e9 : -1e9;
    const double decades = std::log10(*b.value / b.bound);
    return b.at_least ? -decades : decades;
  }

  void draw_strip(const Bar& b, double top) {
    const double left = x(strip), right = x(verdict) - 20;
    const double y = top + 0.5 * kRow, middle = (left + right) / 2;
    list_.crisp_line({left, y}, {right, y}, {Role::rule, 1.2});
    list_.crisp_line({middle, y - 9}, {middle, y + 9}, {Role::ink, 1.8});
    if (!b.value) return;
    const double far = distance(b);
    const double share = std::clamp(far / kDecades, -1.0, 1.0);
    const double at = middle + share * (right - left - 14) / 2;
    const bool met = *b.met();
    const Role role = met ? Role::ink : Role::warning;
    list_.line({middle, y}, {at, y}, {role, 3});
    list_.disc({at, y}, 5.2, met ? Role::ink : Role::paper, {role, 2.2, 0});
    if (std::abs(far) <= kDecades) return;  // beyond the strip: an arrow's head
    const double way = far < 0 ? -1 : 1, tip = at + way * 12;
    for (const double side : {-1.0, 1.0})
      list_.line({tip, y}, {tip - way * 5, y + side * 5}, {role, 2});
  }

  Box<2> place_;
  DrawList& list_;
  Labels& labels_;
};

}  // namespace

std::optional<bool> Bar::met() const {
  if (!value) return std::nullopt;
  return at_least ? *value >= bound : *value <= bound;  // false for NaN
}

std::vector<Bar> measured_bars() {
  std::vector<Bar> bars;
  for (const StressCase& one : stress_cases()) {
    if (one.group != "bars" || one.slow) continue;
    const StressResult result = run_case(one).result;
    const auto value = std::isfinite(result.figure) ? std::optional(result.figure) : std::nullopt;
    bars.push_back({std::string(one.name), value, result.bound, result.unit,
                    fmt::format("stress {}", one.name), result.at_least, seen_elsewhere(one.name)});
    std::ranges::replace(bars.back().name, '_', ' ');
  }
  return bars;
}

double bars_table_height(const std::vector<Bar>& bars) {
  return kHead + kRow * static_cast<double>(bars.size()) + 8;
}

void draw_bars_table(const std::vector<Bar>& bars, const Box<2>& place, DrawList& list,
                     Labels& labels) {
  Table table(place, list, labels);
  table.head();
  double top = place.lo.y + kHead;
  for (const Bar& b : bars) {
    table.row(b, top);
    top += kRow;
  }
}

}  // namespace lantern::report
