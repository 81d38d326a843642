// A lesson page: one HTML file that a lecturer steps through, with nothing beside it.
#pragma once

#include "base/file.hpp"
#include "draw/draw_list.hpp"
#include "frame/frame.hpp"
#include "publish/lesson_frames.hpp"

namespace lantern::publish {

// Asked of the students after a lesson, and the frame that answers it.
struct LessonQuestion {
  std::string asked, answer;
  std::uint64_t frame = 0;   // of the page's frames, from 0
  std::string predict = {};  // the count that is to be guessed before; may be empty
};

// What an index of lessons tells of one.
struct LessonCard {
  std::string scenario, title, idea;
  std::optional<std::uint32_t> lecture;  // its place in the order of teaching
  std::vector<std::string> needs;        // scenarios to be seen before
  std::uint64_t steps = 0, frames = 0;
  std::vector<LessonQuestion> questions = {};
  std::string language = {};  // "de"; empty: English
  // The lesson that comes after it in its folder: its file and its title; empty for none.
  std::string next_file = {}, next_title = {};
};
// As one line of JSON; back from it, nothing if it is not that.
std::string to_json(const LessonCard& card);
std::optional<LessonCard> lesson_card(std::string_view json);

// The card's questions as <details>, each with its answer and a link to the frame of `page`, a URL
// or nothing for the page itself, that shows it.
std::string question_list(const LessonCard& card, std::string_view page);

// A scenario that a page can run.
struct LiveScenario {
  std::string name;  // of its file
  std::string title, idea;
  std::optional<std::uint32_t> lecture;
  std::string text;
};

// What makes a page live.
struct LivePart {
  std::vector<LiveScenario> scenarios;  // the first is shown; of several the reader chooses
  std::string engine;                   // packed_engine(), or empty where it stands beside the page
};

// WebAssembly, compressed, as a page has it.
std::string packed_engine(std::string_view wasm);
// Writes it for all pages in a folder. False, and nothing is touched, if a file of its name stands
// there that is not of this kind. Throws IoError.
inline constexpr const char* kEngineFile = "lantern.engine.js";
bool write_engine(const Folder& folder, std::string_view packed);

class Lesson {
 public:
  // `theme`: "light" follows what the reader's system prefers; "dark" and "print" are what the page
  // opens in. The card's frames are counted here, and its questions gathered from them.
  Lesson(LessonCard card, std::string theme) : card_(std::move(card)), theme_(std::move(theme)) {}

  // The lesson that comes after it.
  void set_next(std::string file, std::string title) {
    card_.next_file = std::move(file), card_.next_title = std::move(title);
  }

  // In order. The list must be one that a renderer takes (check_draw_list), or Refused is thrown.
  void add(const Frame& frame, const DrawList& list, const FrameWords& words);

  // What the frames so far take before they are compressed.
  std::size_t bytes() const { return frames_.bytes() + facts_.size(); }
  std::size_t frames() const { return frames_.count(); }

  void make_live(LivePart live) { live_ = std::move(live); }

  // The page. At least one frame must have been added, unless the reader chooses a scenario.
  std::string html() const;

 private:
  std::string part(std::string_view name) const;       // of the page's text
  std::string picture_of(const DrawList& list) const;  // an SVG
  std::string live_part() const;
  std::string words_part() const;
  std::string script() const;

  LessonCard card_;
  std::string theme_;
  LessonFrames frames_;
  std::string facts_;
  std::optional<LivePart> live_;
  DrawList first_, last_;
  std::string captions_;      // <li> ...
  std::string last_caption_;  // of those
};

// index.html of a folder: each lesson page that stands in it, with its last picture, its idea, how
// many steps it has and what is to be seen before. Those of the files in `order` come first, then
// those with a place in the lecture, then the others by name. Throws IoError if the folder or a
// page cannot be read.
std::string lesson_index(const Folder& folder, const std::vector<std::string>& order = {},
                         const std::string& title = "");

// Writes it. Where there is one and no order or title is given, it keeps its own. False, and
// nothing is touched, if an index.html stands there that is not of this kind. Throws IoError.
bool write_lesson_index(const Folder& folder, std::vector<std::string> order = {},
                        std::string title = "");

}  // namespace lantern::publish
