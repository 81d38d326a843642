// A lesson page: one HTML file that a lecturer steps through, with nothing beside it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "draw/draw_list.hpp"
#include "publish/lesson_frames.hpp"
#include "scenario/frame.hpp"

namespace lantern::publish {

// Asked of the students after a lesson, and the frame that answers it.
struct LessonQuestion {
  std::string asked, answer;
  std::uint64_t frame = 0;  // of the page's frames, from 0
};

// What an index of lessons tells of one.
struct LessonCard {
  std::string scenario, title, idea;
  std::optional<std::uint32_t> lecture;  // its place in the order of teaching
  std::vector<std::string> needs;        // scenarios to be seen before
  std::uint64_t steps = 0, frames = 0;
  std::vector<LessonQuestion> questions = {};
};
// As one line of JSON; back from it, nothing if it is not that.
std::string to_json(const LessonCard& card);
std::optional<LessonCard> lesson_card(std::string_view json);

// The card's questions as <details>, each with its answer and a link to the frame of `page`, a URL
// or nothing for the page itself, that shows it.
std::string question_list(const LessonCard& card, std::string_view page);

// The roles' colours, and those of the page itself, as CSS variables: light, unless the reader's
// system prefers dark or the root's data-theme says otherwise; grey on paper.
std::string lesson_colours();

class Lesson {
 public:
  // `theme`: "light" follows what the reader's system prefers; "dark" and "print" are what the page
  // opens in. The card's frames are counted here, and its questions gathered from them.
  Lesson(LessonCard card, std::string theme) : card_(std::move(card)), theme_(std::move(theme)) {}

  // In order. The list must be one that a renderer takes (check_draw_list), or Refused is thrown.
  void add(const Frame& frame, const DrawList& list, const FrameWords& words);

  // What the frames so far take before they are compressed.
  std::size_t bytes() const { return frames_.bytes() + facts_.size(); }
  std::size_t frames() const { return frames_.count(); }

  // The page. At least one frame must have been added.
  std::string html() const;

 private:
  std::string part(std::string_view name) const;  // of the page's text
  std::string frames_json() const;
  std::string picture_of(const DrawList& list) const;  // an SVG

  LessonCard card_;
  std::string theme_;
  LessonFrames frames_;
  std::string facts_;
  DrawList first_, last_;
  std::string captions_;      // <li> ...
  std::string last_caption_;  // of those
};

}  // namespace lantern::publish
