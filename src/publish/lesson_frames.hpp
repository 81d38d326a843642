// The shapes of a lesson's frames, each of them kept once, and what they point at.
#pragma once

#include <unordered_map>

#include "draw/draw_list.hpp"
#include "draw/tween.hpp"
#include "frame/frame.hpp"

namespace lantern::publish {

// Gives equal texts the same number, counted from 0 in the order in which they first come, and
// keeps for each a piece of JSON.
class Numbered {
 public:
  // `make()` gives the JSON of one that is new.
  std::uint32_t number(std::string identity, const auto& make) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    const auto [it, fresh] = numbers_.try_emplace(std::move(identity), next);
    if (fresh) {
      const std::string piece = make();
      json_ += json_.empty() ? "" : ",\n";
      json_ += piece;
    }
    return it->second;
  }
  // One that is its own JSON.
  std::uint32_t number(const std::string& json) {
    return number(json, [&] { return json; });
  }

  std::size_t size() const { return numbers_.size(); }
  std::size_t bytes() const { return json_.size(); }
  std::string json() const { return "[" + json_ + "]"; }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::string json_;
};

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

// The page of a lesson's pictures where none is asked for, without what stands beside the picture:
// title, caption and buttons take this part of the height.
inline constexpr double kLessonWords = 0.21;
Vec<2> lesson_page();

// What is told of a frame beside its picture and facts.
struct FrameWords {
  std::string notes;                  // of the step, for the speaker alone
  std::vector<std::string> counters;  // that stand beside the caption
  Motion motion = Motion::eased;      // from the frame before
  double seconds = 0;                 // that the way from there takes
};

// Of a frame of this scenario, behind another one, of which the time counts.
FrameWords words_of(const Frame& before, const Frame& frame, const Scenario& scenario);

// The frame's caption, and behind it those of its sides that have one of their own.
std::string whole_caption(const Frame& frame);

// A frame is an object:
//   step, event, time, caption, part, ending, notes, counters   what they are; of the
//            last three only what there is
//   rows     in the order of painting, as pairs (from, count): of the frame before, from its
//            `from`-th row on; for -1 rows that come for the first time; for -2 the row `count`
//            alone
//   way      from the frame before, in the order of painting. [-n, b]: the n rows from the b-th of
//            this frame on stand still. [kind, ...]: a kind of passage, then by how many its row of
//            the frame before and its row of this frame lie behind the last ones told, and the
//            place that it is put upon, as far as the kind has them
//   motion, seconds   of that way
// A kind is [of the frame before, of this one, move, fade, leaves, put]: beats by number. A place
// is [sx, sy, dx, dy]: a point goes to (x sx + dx, y sy + dy); sx and sy in ten thousandths.
class LessonFrames {
 public:
  void add(const Frame& frame, const DrawList& list, const FrameWords& words);

  std::size_t count() const { return count_; }
  std::size_t bytes() const { return frames_.size() + shapes_.bytes() + places_.bytes(); }
  // {"format": "lantern.lesson/1", "page": its size in hundredths, "beats": when each begins and
  // ends, the tables, "frames": [...]}
  std::string json() const;

 private:
  std::string rows_text(const std::vector<std::uint32_t>& rows);
  std::string way_text(const DrawList& list, const std::vector<std::uint32_t>& rows);
  std::uint32_t kind_of(const Passage& passage);
  std::uint32_t place_of(const Passage& passage);

  LessonShapes shapes_;
  Numbered kinds_, places_;
  std::string frames_;
  std::size_t count_ = 0;
  std::size_t known_rows_ = 0;  // that a frame has shown
  DrawList last_;               // of the frame before
  std::vector<std::uint32_t> last_rows_;
};

// A list of objects, one for the frame or one for each of its sides:
//   name, title    of the side; empty without sides
//   counts         [["pairs", 3], ...], and measures likewise
//   textures       [id, "name", width, height, refused]
//   bodies         [id, "name", [x, y], speed, "static" | "outside" its world | "asleep" | ""]
//   nodes          ["root.0", "label", depth, leaf, [body ids], outline, pool slot]: the outline on
//                  the page, [x, y, ...] in page units, of a flat world; the slot or -1
//   leaf           ["leaf", "leaves"]: one that is none's parent, and many, in words
//   pairs          [a, b, their boxes overlap]
//   contacts       [a, b]
// Measures, places and speeds have five digits: they are to be read, not to be reckoned with.
std::string facts_for_page(const Frame& frame, const DrawList& list);

// The roles' colours, and those of the page itself, as CSS variables: light, unless the reader's
// system prefers dark or the root's data-theme says otherwise; grey on paper.
std::string lesson_colours(std::span<const BodyPaint> paints = {});

}  // namespace lantern::publish
