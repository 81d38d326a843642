#include "render/svg.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/stop.hpp"
#include "base/words.hpp"
#include "draw/font.hpp"
#include "render/canvas.hpp"

namespace lantern::render {
namespace {

// At most three decimals, always with a point, never "-0". Values of a draw list are below a
// million (check_draw_list), so that the thousandths fit a double exactly enough.
std::string number(double x) {
  const auto thousandths = static_cast<long long>(std::floor(x * 1000 + 0.5));
  const long long whole = std::abs(thousandths) / 1000, part = std::abs(thousandths) % 1000;
  std::string text = fmt::format("{}{}", thousandths < 0 ? "-" : "", whole);
  if (part != 0) {
    text += fmt::format(".{:03}", part);
    while (text.back() == '0') text.pop_back();
  }
  return text;
}

class SvgWriter {
 public:
  SvgWriter(const DrawList& list, const Theme& theme, const SvgWords& words)
      : list_(list), theme_(theme.with(list.paints)), words_(words) {}

  std::string write(bool transparent, int width, int height) {
    for (std::size_t i = 0; i < list_.shapes.size(); ++i) {
      stop_if_asked();
      tint_ = list_.tints.empty() ? nullptr : &list_.tints[i];
      std::visit([&](const auto& s) { add(s); }, list_.shapes[i]);
    }
    tint_ = nullptr;
    const std::string w = number(list_.page.x), h = number(list_.page.y);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\"{}{}>\n{}",
        length(0, width), length(1, height), w, h, words_.letters ? kFace : "", lang() + role(),
        told());
    if (!defs_.empty()) svg += fmt::format("<defs>\n{}</defs>\n", defs_);
    if (!transparent)
      svg += fmt::format("<rect width=\"{}\" height=\"{}\"{}/>\n", w, h,
                         colored("fill", fill_of(Role::paper)));
    return svg + body_ + "</svg>\n";
  }

 private:
  static std::string lang() {
    return spoken() ? fmt::format(" lang=\"{}\"", spoken()->language) : "";
  }
  std::string length(int axis, int pixels) const {
    return words_.points ? number((*words_.points)[axis]) + "pt" : fmt::format("{}", pixels);
  }
  // For screen readers: it is one picture, with this name.
  std::string role() const {
    if (words_.title.empty()) return "";
    const std::string& p = words_.prefix;
    const std::string more = words_.description.empty() ? "" : fmt::format(" {}desc", p);
    return fmt::format(" role=\"img\" aria-labelledby=\"{}title{}\"", p, more);
  }
  std::string told() const {
    std::string text;
    for (const auto& [name, words] :
         {std::pair{"title", words_.title}, std::pair{"desc", words_.description}})
      if (!words.empty())
        text += fmt::format("<{0} id=\"{1}{0}\">{2}</{0}>\n", name, words_.prefix, escaped(words));
    return text;
  }

  void add(const RectShape& s) {
    const Vec<2> size = s.box.size();
    if (size.x < 0 || size.y < 0) return;
    const double radius = std::min(s.radius, 0.5 * std::min(size.x, size.y));
    body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", number(s.box.lo.x),
                         number(s.box.lo.y), number(size.x), number(size.y));
    if (radius > 0) body_ += fmt::format(" rx=\"{}\"", number(radius));
    body_ += paint(s.fill, s.stroke) + crisp(s.snapped) + "/>\n";
  }
  void add(const LineShape& s) {
    if (line_of(s.stroke)[3] == 0) return;
    body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"", number(s.from.x),
                         number(s.from.y), number(s.to.x), number(s.to.y));
    const char* cap = s.stroke.dash > 0 ? "" : s.snapped ? " stroke-linecap=\"square\"" : kRoundCap;
    body_ += paint(Role::none, s.stroke) + cap + crisp(s.snapped) + "/>\n";
  }
  void add(const PolygonShape& s) {
    if (s.points.empty()) return;
    body_ += "<polygon points=\"";
    for (std::size_t i = 0; i < s.points.size(); ++i)
      body_ +=
          fmt::format("{}{},{}", i > 0 ? " " : "", number(s.points[i].x), number(s.points[i].y));
    body_ += fmt::format("\"{} stroke-linejoin=\"round\"/>\n", paint(s.fill, s.stroke));
  }
  void add(const TextShape& s) {
    if (s.size <= 0) return;
    if (words_.letters) return add_letters(s);
    const double width = s.align == 0 ? 0 : text_width(s.text, s.size, s.weight);
    std::string letters;
    for (const PlacedGlyph& g : shape_text(s.text, 1.0, s.weight)) {
      const int id = glyph(g.glyph, s.weight);
      if (id >= 0)
        letters += fmt::format("<use xlink:href=\"#{}g{}\" x=\"{}\"/>", words_.prefix, id,
                               number(1000 * g.x));
    }
    if (letters.empty()) return;
    // Glyphs are kept at a thousand units to the em, so that three decimals suffice.
    const std::string place =
        fmt::format(" transform=\"translate({} {}) scale({})\"", number(s.at.x - s.align * width),
                    number(s.at.y), fmt::format("{:.6f}", s.size / 1000));
    put_letters(s, "g", place, 6 * 1000 / s.size, "", letters);
  }

  // The halo is a text of its own: not every program knows paint-order.
  void add_letters(const TextShape& s) {
    const double width = text_width(s.text, s.size, s.weight);
    if (width <= 0) return;
    const std::string place = fmt::format(
        " x=\"{}\" y=\"{}\" font-size=\"{}\"{} textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\"",
        number(s.at.x - s.align * width), number(s.at.y), number(s.size),
        s.weight == Weight::semibold ? " font-weight=\"600\""
        : s.weight == Weight::code   ? " font-family=\"Inconsolata, monospace\""
                                     : "",
        number(width));
    put_letters(s, "text", place, 6, " aria-hidden=\"true\"", escaped(s.text));
  }

  // Letters upon their halo, of whose element `more` is told.
  void put_letters(const TextShape& s, const char* tag, const std::string& place, double width,
                   const char* more, const std::string& letters) {
    if (const Paint halo = tinted(theme_, s.halo, tint_, &Tint::line); halo[3] != 0)
      body_ += fmt::format(
          "<{0}{1}{2}{3} stroke-width=\"{4}\" stroke-linejoin=\"round\"{5}>{6}</{0}>\n", tag, place,
          colored("fill", halo), colored("stroke", halo), number(width), more, letters);
    if (const Paint ink = fill_of(s.role); ink[3] != 0)
      body_ += fmt::format("<{0}{1}{2}>{3}</{0}>\n", tag, place, colored("fill", ink), letters);
  }

  // The number of a glyph in <defs>, where it is put when first met; -1 for a blank.
  int glyph(int index, Weight weight) {
    const auto [it, fresh] = glyphs_.try_emplace({index, weight}, -1);
    if (!fresh) return it->second;
    const std::vector<PathStep> path = glyph_path(index, weight);
    if (path.empty()) return -1;
    it->second = static_cast<int>(glyphs_.size()) - 1;
    defs_ += fmt::format("<path id=\"{}g{}\" d=\"{}\"/>\n", words_.prefix, it->second,
                         thousandfold(path));
    return it->second;
  }

  // A path in units of one em, in units of a thousandth.
  static std::string thousandfold(const std::vector<PathStep>& path) {
    std::string result;
    for (const PathStep& step : path) {
      result += step.letter;
      for (const Vec<2>& point : step.points)
        for (const double value : {point.x, point.y}) {
          // A sign separates numbers as well as a blank does.
          const bool after_number = result.back() >= '0' && result.back() <= '9';
          const std::string text = number(1000 * value);
          if (after_number && text[0] != '-') result += ' ';
          result += text;
        }
    }
    return result;
  }

  std::string paint(Role fill, const Stroke& stroke) const {
    const Paint ground = fill_of(fill), line = line_of(stroke);
    std::string text = ground[3] == 0 ? " fill=\"none\"" : colored("fill", ground);
    if (line[3] == 0) return text;
    text += fmt::format("{} stroke-width=\"{}\"", colored("stroke", line), number(stroke.width));
    if (stroke.dash > 0) text += fmt::format(" stroke-dasharray=\"{}\"", number(stroke.dash));
    return text;
  }
  static const char* crisp(bool snapped) {
    return snapped ? " shape-rendering=\"crispEdges\"" : "";
  }
  Paint fill_of(Role role) const { return tinted(theme_, role, tint_, &Tint::fill); }
  Paint line_of(const Stroke& stroke) const {
    return stroke.width > 0 ? tinted(theme_, stroke.role, tint_, &Tint::line) : Paint{};
  }
  // ` fill="#804000"`, and how opaque it is unless it is so altogether.
  static std::string colored(const char* what, const Paint& c) {
    std::string text = fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", what, c[0], c[1], c[2]);
    if (c[3] < 255) text += fmt::format(" {}-opacity=\"{}\"", what, number(c[3] / 255.0));
    return text;
  }

  static constexpr const char* kFace = " font-family=\"Inter, sans-serif\" xml:space=\"preserve\"";
  static constexpr const char* kRoundCap = " stroke-linecap=\"round\"";
  const DrawList& list_;
  const Theme theme_;
  const SvgWords& words_;
  const Tint* tint_ = nullptr;  // of the shape that is being added
  std::map<std::pair<int, Weight>, int> glyphs_;
  std::string defs_, body_;
};

}  // namespace

std::string to_svg(const DrawList& list, const Theme& theme, bool transparent, int width,
                   int height, const SvgWords& words) {
  check_draw_list(list);
  if (width < 1 || height < 1) throw Refused("an SVG's width and height must be at least 1");
  return SvgWriter(list, theme, words).write(transparent, width, height);
}

}  // namespace lantern::render
