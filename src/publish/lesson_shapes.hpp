// Shapes of a lesson's frames, each kept once, as JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "publish/numbered.hpp"
#include "scenario/frame.hpp"

namespace lantern::publish {

// A length of the page as a lesson tells it: in hundredths of a page unit.
std::int64_t hundredths(double length);

// The tables that rows refer to. A row is a list of whole numbers; points but for the first are
// told by their way from the one before:
//   [0, key, style, x, y, width, height, corner radius]     a rectangle
//   [1, key, style, x, y, dx, dy]                           a line
//   [2, key, style, x, y, dx, dy ...]                       a polygon
//   [3, key, style, x, y, size, text]                       a text, from its anchor
// A style is [fill, stroke, width, dash, snapped]: roles by number, of a text its own and its
// halo's. A text is ["words", x, glyph, x, glyph ...], where x is in thousandths of the em from the
// anchor; a glyph is a path in the same unit, relative, y down. A key is ["key", entity ...], see
// entities_of().
class LessonShapes {
 public:
  // The rows of a frame's shapes, in order.
  std::vector<std::uint32_t> rows_of(const DrawList& list, const Frame& frame);

  std::size_t rows() const { return rows_.size(); }
  std::size_t bytes() const;
  // `"rows": [...], "keys": [...]` and so on.
  std::string json() const;

 private:
  std::string row(const DrawShape& shape, std::uint32_t key);
  std::string row_of(const RectShape& shape, std::uint32_t key);
  std::string row_of(const LineShape& shape, std::uint32_t key);
  std::string row_of(const PolygonShape& shape, std::uint32_t key);
  std::string row_of(const TextShape& shape, std::uint32_t key);
  std::uint32_t style(Role fill, const Stroke& stroke, bool snapped = false);
  std::uint32_t text(const TextShape& shape);

  Numbered rows_, keys_, styles_, texts_, glyphs_;
};

// What the things of a key are, so that a page can tell what belongs together: "node/root.0.3",
// "body/ann" (and what a texture is), "pair/ann|bob" (in order of their names), "slot/4" of the
// pool; behind the side's prefix, if there is one. A body without a name is "#7", by its id. Empty
// for what is nothing of these.
std::vector<std::string> entities_of(const std::string& key, const Frame& frame);

}  // namespace lantern::publish
