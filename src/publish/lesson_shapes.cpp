#include "publish/lesson_shapes.hpp"

#include <charconv>
#include <cmath>
#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "draw/font.hpp"

namespace lantern::publish {
namespace {

std::int64_t whole(double x) { return static_cast<std::int64_t>(std::floor(x + 0.5)); }
std::int64_t thousandths(double x) { return whole(1000 * x); }

int number_of(Role role) { return static_cast<int>(role); }

// A point, told by its way from another one.
void add_way(std::string& row, const Vec<2>& from, const Vec<2>& to) {
  row += fmt::format(",{},{}", hundredths(to.x) - hundredths(from.x),
                     hundredths(to.y) - hundredths(from.y));
}

// A glyph's path in ems and absolute, as one of thousandths that goes on from where the pen is.
class RelativePath {
 public:
  explicit RelativePath(std::string_view path) : rest_(path) {}

  std::string made() {
    while (!rest_.empty()) {
      const char command = rest_.front();
      rest_.remove_prefix(1);
      switch (command) {
        case 'M':
          start_[0] = pen_[0], start_[1] = pen_[1];  // a closed contour leaves the pen at its start
          add('m', 1);
          start_[0] = pen_[0], start_[1] = pen_[1];
          break;
        case 'L':
          add('l', 1);
          break;
        case 'Q':
          add('q', 2);
          break;
        case 'C':
          add('c', 3);
          break;
        case 'Z':
          result_ += 'z';
          pen_[0] = start_[0], pen_[1] = start_[1];
          break;
        default:  // a blank
          break;
      }
    }
    return std::move(result_);
  }

 private:
  // So many points, all relative to where the pen was.
  void add(char command, int points) {
    result_ += command;
    std::int64_t at[2] = {pen_[0], pen_[1]};
    for (int i = 0; i < 2 * points; ++i) {
      const std::int64_t way = (at[i % 2] = next()) - pen_[i % 2];
      if (i > 0 && way >= 0) result_ += ' ';  // a sign separates numbers as well
      result_ += fmt::format("{}", way);
    }
    pen_[0] = at[0], pen_[1] = at[1];
  }

  std::int64_t next() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    LANTERN_CHECK(error == std::errc(), ==, true);
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return thousandths(value);
  }

  std::string_view rest_;
  std::string result_;
  std::int64_t pen_[2] = {0, 0}, start_[2] = {0, 0};
};

std::string quoted_path(int glyph, Weight weight) {
  return fmt::format("\"{}\"", RelativePath(glyph_path(glyph, weight)).made());
}

}  // namespace

std::int64_t hundredths(double length) { return whole(100 * length); }

std::vector<std::uint32_t> LessonShapes::rows_of(const DrawList& list, const Frame& frame) {
  std::vector<std::uint32_t> rows;
  rows.reserve(list.shapes.size());
  std::size_t run = 0;
  std::string key;
  std::uint32_t key_number = 0;
  const auto take = [&](std::string next) {
    key = std::move(next);
    key_number = keys_.number(key, [&] {
      std::string json = "[" + json_string(key);
      for (const std::string& entity : entities_of(key, frame)) json += "," + json_string(entity);
      return json + "]";
    });
  };
  take("");
  for (std::size_t i = 0; i < list.shapes.size(); ++i) {
    stop_if_asked();
    const std::size_t before = run;
    while (run < list.runs.size() && list.runs[run].first <= i) ++run;
    if (run != before) take(list.runs[run - 1].key);
    rows.push_back(rows_.number(row(list.shapes[i], key_number)));
  }
  return rows;
}

std::string LessonShapes::row(const DrawShape& shape, std::uint32_t key) {
  return std::visit([&](const auto& s) { return row_of(s, key); }, shape);
}

std::string LessonShapes::row_of(const RectShape& s, std::uint32_t key) {
  std::string row = fmt::format("[0,{},{},{},{}", key, style(s.fill, s.stroke, s.snapped),
                                hundredths(s.box.lo.x), hundredths(s.box.lo.y));
  add_way(row, s.box.lo, s.box.hi);
  const Vec<2> size = s.box.size();
  const double most = std::max(0.0, 0.5 * std::min(size.x, size.y));
  return row + fmt::format(",{}]", hundredths(std::min(s.radius, most)));
}

std::string LessonShapes::row_of(const LineShape& s, std::uint32_t key) {
  std::string row = fmt::format("[1,{},{},{},{}", key, style(Role::none, s.stroke, s.snapped),
                                hundredths(s.from.x), hundredths(s.from.y));
  add_way(row, s.from, s.to);
  return row + "]";
}

std::string LessonShapes::row_of(const PolygonShape& s, std::uint32_t key) {
  std::string row = fmt::format("[2,{},{}", key, style(s.fill, s.stroke));
  Vec<2> last{0.0};
  for (const Vec<2>& point : s.points) {
    add_way(row, last, point);
    last = point;
  }
  return row + "]";
}

std::string LessonShapes::row_of(const TextShape& s, std::uint32_t key) {
  return fmt::format("[3,{},{},{},{},{},{}]", key, style(s.role, {s.halo, 0, 0}),
                     hundredths(s.at.x), hundredths(s.at.y), hundredths(s.size), text(s));
}

std::uint32_t LessonShapes::style(Role fill, const Stroke& stroke, bool snapped) {
  return styles_.number(fmt::format("[{},{},{},{},{}]", number_of(fill), number_of(stroke.role),
                                    hundredths(stroke.width), hundredths(stroke.dash),
                                    snapped ? 1 : 0));
}

std::uint32_t LessonShapes::text(const TextShape& s) {
  const int weight = static_cast<int>(s.weight);
  return texts_.number(fmt::format("{} {} {}", weight, s.align, s.text), [&] {
    std::string json = "[" + json_string(s.text);
    const double left = s.align == 0 ? 0 : -s.align * text_width(s.text, 1, s.weight);
    for (const PlacedGlyph& g : shape_text(s.text, 1, s.weight)) {
      const std::uint32_t glyph = glyphs_.number(fmt::format("{} {}", weight, g.glyph),
                                                 [&] { return quoted_path(g.glyph, s.weight); });
      json += fmt::format(",{},{}", thousandths(left + g.x), glyph);
    }
    return json + "]";
  });
}

std::size_t LessonShapes::bytes() const {
  return rows_.bytes() + keys_.bytes() + styles_.bytes() + texts_.bytes() + glyphs_.bytes();
}

std::string LessonShapes::json() const {
  return fmt::format(
      "\"rows\": {},\n\"keys\": {},\n\"styles\": {},\n\"texts\": {},\n\"glyphs\": {}", rows_.json(),
      keys_.json(), styles_.json(), texts_.json(), glyphs_.json());
}

}  // namespace lantern::publish
