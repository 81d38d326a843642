// What bodies look like that are of no known look: outlines and colours of an author's own.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "geometry/elementary.hpp"
#include "language/tables/draft.hpp"

namespace lantern::language {
namespace {

constexpr std::string_view kCommands = "MLHVCQZ";
constexpr int kArguments[] = {2, 2, 1, 1, 6, 4, 0};
constexpr int kPieces = 12;  // lines that a curve becomes
constexpr std::size_t kMostPoints = 2000;

constexpr char upper(char letter) { return static_cast<char>(letter & ~0x20); }

// A path as SVG writes it, its curves as short lines. Each part of it is filled by itself.
class PathReader {
 public:
  explicit PathReader(std::string_view text) : rest_(text) {}

  std::string read(std::vector<Polygon>& parts) {
    char command = 0;
    for (skip(); !rest_.empty(); skip()) {
      if (const char c = rest_.front(); upper(c) >= 'A' && upper(c) <= 'Z') {
        command = c;
        rest_.remove_prefix(1);
      } else if (command == 0 || command == 'z' || command == 'Z') {
        return fmt::format("'{}' stands where a command should", first_word());
      }
      const auto kind = kCommands.find(upper(command));
      if (kind == kCommands.npos)
        return fmt::format("'{}' is none of its commands, {}", command, kCommands);
      if (parts.empty() && kind != 0) return "a path begins with M";
      std::array<double, 6> a{};
      for (int i = 0; i < kArguments[kind]; ++i)
        if (!number(a[static_cast<std::size_t>(i)]))
          return fmt::format("'{}' takes {} up to a million, and there is {}", command,
                             counted(kArguments[kind], "number"),
                             rest_.empty() ? "no more" : first_word());
      draw(kCommands[kind], command >= 'a', a, parts);
      if (parts.size() + parts.back().size() > kMostPoints) return "it has too many points";
      if (command == 'm' || command == 'M') command = command == 'm' ? 'l' : 'L';
    }
    std::erase_if(parts, [](const Polygon& part) {
      const Vec<2> size = geometry::box_of(part).size();
      return part.size() < 3 || std::min(size.x, size.y) < 1e-3 * std::max(size.x, size.y);
    });
    return parts.empty() ? "nothing of it has an area" : "";
  }

 private:
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" ,\t\r\n"), rest_.size())); }
  std::string first_word() const { return std::string(rest_.substr(0, rest_.find_first_of(" ,"))); }
  bool number(double& to) {
    skip();
    const bool plus = rest_.starts_with('+');
    const char* const end = rest_.data() + rest_.size();
    const auto [after, error] = std::from_chars(rest_.data() + plus, end, to);
    if (error != std::errc() || !(std::abs(to) <= 1e6)) return false;
    rest_.remove_prefix(static_cast<std::size_t>(after - rest_.data()));
    return true;
  }
  void draw(char command, bool relative, const std::array<double, 6>& a,
            std::vector<Polygon>& parts) {
    const Vec<2> from = at_, base = relative ? at_ : Vec<2>(0.0);
    const auto point = [&](std::size_t i) { return base + Vec<2>(a[i], a[i + 1]); };
    if (command == 'Z') {
      at_ = parts.back().front();
      begins_ = true;
      return;
    }
    if (command == 'M' || std::exchange(begins_, false))
      parts.emplace_back(1, command == 'M' ? point(0) : at_);
    if (command == 'M' || command == 'L') at_ = point(0);
    if (command == 'H') at_.x = base.x + a[0];
    if (command == 'V') at_.y = (relative ? from.y : 0) + a[0];
    if (command == 'Q' || command == 'C') {
      const Vec<2> end = point(command == 'Q' ? 2 : 4);
      // A quadratic curve is a cubic one, too.
      const Vec<2> one = command == 'C' ? point(0) : from + (point(0) - from) * (2.0 / 3);
      const Vec<2> two = command == 'C' ? point(2) : end + (point(0) - end) * (2.0 / 3);
      for (int i = 1; i < kPieces; ++i) {
        const double t = static_cast<double>(i) / kPieces, s = 1 - t;
        parts.back().push_back(from * (s * s * s) + one * (3 * s * s * t) + two * (3 * s * t * t) +
                               end * (t * t * t));
      }
      at_ = end;
    }
    if (command != 'M') parts.back().push_back(at_);
  }

  std::string_view rest_;
  Vec<2> at_{0.0};
  bool begins_ = false;  // after a Z that no M follows
};

// As WCAG 2 reckons it.
double luminance(std::uint32_t rgb) {
  double sum = 0;
  for (const auto& [shift, share] :
       {std::pair(16, 0.2126), std::pair(8, 0.7152), std::pair(0, 0.0722)}) {
    const double c = (rgb >> shift & 0xff) / 255.0;
    sum += share * (c <= 0.04045 ? c / 12.92 : geometry::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

void notice_contrast(const BodySpec& body, std::uint32_t rgb, Draft& draft) {
  for (const auto& [theme, ground] :
       {std::pair("light", kLightGround), std::pair("dark", kDarkGround)}) {
    const double a = luminance(rgb) + 0.05, b = luminance(ground) + 0.05;
    if (const double ratio = std::max(a, b) / std::min(a, b); ratio < 3)
      draft.notice(
          Warning::paint, body.where,
          fmt::format("the paint {} stands out only {:.2f} : 1 from the ground of the {} theme",
                      body.paint, ratio, theme),
          "from 3 : 1 on it can be told apart");
  }
}

}  // namespace

std::shared_ptr<const Outline> read_outline(const TableReader& table) {
  const auto text = table.get<std::string>("outline");
  if (!text) return nullptr;
  auto parts = std::make_shared<Outline>();
  if (const std::string why = PathReader(*text).read(*parts); !why.empty()) {
    table.bad_value("outline", "'outline' is no path: " + why, "as \"M0 0 L4 0 L2 3 Z\"");
    return nullptr;
  }
  Box<2> all = geometry::box_of(parts->front());
  for (const Polygon& part : *parts) all = geometry::united(all, geometry::box_of(part));
  const Vec<2> half = glm::max(all.size() / 2.0, Vec<2>(1e-9));
  for (Polygon& part : *parts)
    for (Vec<2>& p : part) p = (p - all.center()) / half;
  return parts;
}

void mix_paints(Draft& draft) {
  std::set<int> taken;
  for (const BodySpec& body : draft.scenario.bodies)
    if (body.paint.empty()) taken.insert(body.color);
  for (BodySpec& body : draft.scenario.bodies) {
    if (body.paint.empty()) continue;
    std::string digits = body.paint.substr(1);
    if (digits.size() == 3)
      digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
    if (digits.size() != 6) continue;  // which has been told
    std::uint32_t rgb = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
    auto& paints = draft.scenario.paints;
    auto paint = std::ranges::find(paints, rgb, &BodyPaint::rgb);
    if (paint == paints.end()) {
      int color = 1;
      while (taken.contains(color)) ++color;
      if (color > 8) {
        draft.problems.add({body.where.line, body.where.column},
                           "a picture has 8 colours, and others are taken before this one",
                           "give bodies the same paint, or fewer numbers in 'color'");
        return;
      }
      taken.insert(color);
      paint = paints.insert(paint, {color, rgb});
      notice_contrast(body, rgb, draft);
    }
    body.color = paint->color;
  }
}

}  // namespace lantern::language
