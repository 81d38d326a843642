// The engine behind one function, as a page asks it: questions and answers are JSON.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "rooms.hpp"

namespace lantern::live {

// What is asked, by "do", with what, and what is answered. D is {"severity", "line", "column",
// "message", "suggestion"}, with line 0 for the file as a whole; lines and columns count from 1. A
// picture is {"lesson": frames as a lesson page has them, "facts": [...], "hashes": ["..."],
// "like": [[of which step of the lesson each is, or -1; whether its caption is the text's own]]}.
//
// open: text, name, held, lesson, width, height. {"page": its size in hundredths, "frames": n,
// "steps": n, "world": b, "level": b, "warnings": [D], "unmet": [D]}; the text is parsed, and run
// whole. Pictures light what is of the body `held`, if that is given, in place of what the text
// lights; so they do from a grab of a body on. Where another world comes of the text than of
// `lesson`, if that is given, what it says as the lesson does is left out, in drags, too. Pictures
// are so many page units wide and high, or as a recorded lesson's.
//
// lesson. The picture of all frames, "title", "questions": [[asked, answer, frame, predict]], and
// "colours": a style, if the text or the lesson has colours of its own; else it is empty.
//
// frame: index. The picture of one.
//
// grab: frame, entity, x, y. {"grabbed": "position", "move", "size" or "corner", "kept": b}; a hand
// goes down on a "body/red", in page units, or on a level's corner where `entity` is empty. Kept:
// all before what it changes has been run, which the next drag uses up; whoever copies the memory
// here, and begins each drag with it, spares that run.
//
// drag: x, y, turn, vx, vy. {"text", "index", "steps"} and the picture of that frame, with what was
// grabbed at another place, turned by so many degrees, and thrown as fast, in page units a second.
// It begins from the text at the grab, and what does not change stays where it is on the page.
//
// fly. {"frames": n, "seconds"}: opens what the last drag has left, but that frames are so many
// seconds apart in its world from the step on that it has changed, as long as time passes.
//
// add: frame; remove: frame, entity. {"text", "entity", "index"}: with a body more, where there is
// most room in that frame, or with one less, in a step behind the frame's, which begins at "index".
//
// set: path, value. {"text"}, see with_value().
//
// controls; complete: text, line, column. See controls_json() and complete_json().
//
// facts: index. {"facts": the frame's JSON as a text}. svg: index, width, height. {"svg"}.
//
// What cannot be done is {"refused": [D], "said": as the command line says it}, and changes
// nothing.
class Session {
 public:
  Session();
  ~Session();
  // Never throws, but for a broken invariant.
  std::string ask(std::string_view question);

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace lantern::live
