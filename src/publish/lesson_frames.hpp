// The frames of a lesson as JSON: what each shows, and how it comes out of the one before.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw/draw_list.hpp"
#include "draw/tween.hpp"
#include "publish/lesson_shapes.hpp"
#include "publish/numbered.hpp"
#include "scenario/frame.hpp"

namespace lantern::publish {

// What is told of a frame beside its picture and facts.
struct FrameWords {
  std::string notes;                  // of the step, for the speaker alone
  std::vector<std::string> counters;  // that stand beside the caption
  Motion motion = Motion::eased;      // from the frame before
  double seconds = 0;                 // that the way from there takes
};

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

}  // namespace lantern::publish
