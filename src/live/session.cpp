#include "live/session.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/error.hpp"
#include "base/json_writer.hpp"
#include "language/words.hpp"
#include "live/controls.hpp"
#include "live/edit.hpp"
#include "live/grip.hpp"
#include "live/play.hpp"
#include "live/retold.hpp"
#include "publish/lesson_frames.hpp"
#include "render/image.hpp"
#include "render/svg.hpp"

namespace lantern::live {
namespace {

using nlohmann::json;

constexpr double kFlight = 1.0 / 30;  // seconds of a world from frame to frame of a flight
constexpr int kMost = 1'000'000;      // of page units, degrees, lines and frames

// Of names and values in turn.
std::string object_of(const auto&... members) { return JsonWriter().object(members...).text(); }

std::string refusal(const std::string& message) {
  Diagnostic d;
  d.message = message;
  return object_of("refused", std::vector{d}, "said", message);
}

// Frames as a lesson page holds them.
class Pictures {
 public:
  // `like`: of each step, which of the lesson's it is; empty where there is no lesson.
  explicit Pictures(const std::vector<int>& like) : like_(like) {}

  void add(const Frame& frame, const Frame* before, const draw::DrawList& list,
           const language::Scenario& scenario) {
    frames_.add(frame, list, publish::words_of(before ? *before : Frame(), frame, scenario));
    if (!like_.empty())
      likes_ += fmt::format("{}[{},{}]", facts_.empty() ? "" : ",", like_.at(frame.step),
                            scenario.steps.at(frame.step).caption.empty() ? 0 : 1);
    facts_ += (facts_.empty() ? "" : ",") + publish::facts_for_page(frame, list);
    hashes_ += fmt::format("{}\"{:016x}\"", hashes_.empty() ? "" : ",", frame.hash);
  }
  // Members of an object.
  std::string json() const {
    return fmt::format("\"lesson\": {}, \"facts\": [{}], \"hashes\": [{}], \"like\": [{}]",
                       frames_.json(), facts_, hashes_, likes_);
  }

 private:
  const std::vector<int>& like_;
  publish::LessonFrames frames_;
  std::string facts_, hashes_, likes_;
};

}  // namespace

class Session::Engine {
 public:
  std::string answer(const json& q) {
    const std::string what = q.at("do");
    if (what == "open" && q.contains("words") && q.at("words").is_object())
      words_ = std::make_shared<const WordTable>(language::word_table(q.at("words").dump()));
    const Speaking speaking(words_.get());
    if (what == "open") return open(q);
    if (what == "complete")
      return complete_json(q.at("text").get<std::string>(), whole_in(q, "line"),
                           whole_in(q, "column"));
    if (!play_) throw Refused("nothing is opened yet");
    if (what == "lesson") return lesson();
    if (what == "frame") return "{" + picture(index_in(q, "index")) + "}";
    if (what == "grab") return grab(q);
    if (what == "drag") return drag(q);
    if (what == "fly") return fly();
    if (what == "add" || what == "remove") return recast(q, what == "add");
    if (what == "set")
      return object_of("text", with_value(text_, q.at("path").get<std::string>(),
                                          q.at("value").get<std::string>()));
    if (what == "controls") return controls_json(text_, play_->scenario());
    if (what == "facts") return object_of("facts", to_json(play_->frames()[index_in(q, "index")]));
    if (what == "svg")
      return svg(index_in(q, "index"), whole_in(q, "width"), whole_in(q, "height"));
    throw Refused("unknown request '{}'", what);
  }

 private:
  static int whole_in(const json& q, const char* name) {
    const json& n = q.at(name);
    if (!n.is_number_integer() || n < 0 || n > kMost)
      throw Refused("'{}' is a whole number from 0 to {}", name, kMost);
    return n;
  }
  // 0 if it is not there.
  static double number_in(const json& q, const char* name) {
    const json n = q.value(name, json(0));
    if (!n.is_number() || std::abs(n.get<double>()) > kMost)
      throw Refused("'{}' is a number from -{} to {}", name, kMost, kMost);
    return n;
  }

  std::size_t index_in(const json& q, const char* name) const {
    const auto index = static_cast<std::size_t>(whole_in(q, name));
    if (index >= play_->frames().size())
      throw Refused("there is no frame {}: {} are there", index, play_->frames().size());
    return index;
  }

  static Vec<2> sheet_in(const json& q) {
    constexpr int kLeast = 300, kMostUnits = 5000;
    const int width = whole_in(q, "width"), height = whole_in(q, "height");
    if (std::min(width, height) < kLeast || std::max(width, height) > kMostUnits)
      throw Refused("a page is {} to {} units wide and high", kLeast, kMostUnits);
    return {width, height};
  }

  std::string open(const json& q) {
    const std::string text = q.at("text"), name = q.at("name"), lesson = q.value("lesson", "");
    const Vec<2> sheet = q.contains("width") ? sheet_in(q) : publish::lesson_page();
    std::shared_ptr<Play> its = lesson.empty() ? nullptr : lesson_;
    if (!lesson.empty() && (!its || its->scenario().text != lesson))
      its = std::make_shared<Play>(parsed(lesson, name, nullptr));
    std::vector<int> like;
    std::shared_ptr<Play> play = its;
    if (!its || text != lesson)
      play = std::make_shared<Play>(parsed(text, name, its.get(), &like));
    else
      like = steps_in(its->scenario(), its->scenario());
    if (its && play != its && is_same_world(*play, *its))
      play = std::make_shared<Play>(parsed(text, name, nullptr));
    lesson_ = std::move(its);
    begin(std::move(play), std::move(like), sheet, q.value("held", ""));
    name_ = name;
    text_ = text;
    const language::Scenario& scenario = play_->scenario();
    const std::vector page{publish::hundredths(sheet.x), publish::hundredths(sheet.y)};
    return object_of("page", page, "frames", play_->frames().size(), "steps", scenario.steps.size(),
                     "world", scenario.has_world(), "level", scenario.level.has_value(), "warnings",
                     play_->warnings(), "unmet", play_->unmet());
  }

  void begin(std::shared_ptr<Play> play, std::vector<int> like, const Vec<2>& sheet,
             std::string held) {
    if (play != lesson_) play->lesson = lesson_;
    play->sheet = sheet;
    play->held = std::move(held);
    play_ = std::move(play);
    like_ = std::move(like);
    grip_.reset();
    begun_.reset();
    left_.clear();
  }

  std::string lesson() {
    Pictures all(like_);
    JsonWriter questions;
    questions.begin_array();
    const auto& frames = play_->frames();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      all.add(frames[i], i > 0 ? &frames[i - 1] : nullptr, play_->picture(i), play_->scenario());
      if (const auto* q = frames[i].find<FrameQuestion>())
        questions.begin_array()
            .value(q->asked)
            .value(q->answer)
            .value(i)
            .value(q->predict)
            .end_array();
    }
    const auto& paints = play_->scenario().paints;
    const bool painted = !paints.empty() || (lesson_ && !lesson_->scenario().paints.empty());
    return fmt::format("{{{}, \"title\": {}, \"questions\": {}, \"colours\": {}}}", all.json(),
                       json_string(play_->scenario().title), questions.end_array().text(),
                       json_string(painted ? publish::lesson_colours(paints) : ""));
  }

  std::string picture(std::size_t index) {
    Pictures one(like_);
    one.add(play_->frames()[index], nullptr, play_->picture(index), play_->scenario());
    return one.json();
  }

  std::string svg(std::size_t index, int width, int height) {
    if (std::min(width, height) < 1 || std::max(width, height) > render::kMostSide)
      throw Refused("a picture is 1 to {} pixels wide and high", render::kMostSide);
    const Frame& frame = play_->frames()[index];
    return object_of(
        "svg", render::to_svg(play_->page(index, width, height), *draw::theme_named("light"), false,
                              width, height, {frame.title, frame.caption, "l-"}));
  }

  static Vec<2> point_in(const json& q, const char* x, const char* y) {
    return {number_in(q, x), number_in(q, y)};
  }

  std::string grab(const json& q) {
    const std::size_t index = index_in(q, "frame");
    const Vec<2> at = point_in(q, "x", "y");
    const std::string entity = q.at("entity");
    grip_ = grip_on(text_, *play_, index, entity, at);
    if (const std::size_t body = entity.rfind("body/");
        body != entity.npos && grip_->what() != "size")
      play_->held = entity.substr(body + 5);
    grabbed_ = index;
    left_.clear();
    begun_.reset();
    // As of any place but that one: a text for each place is then as good as made.
    if (grip_->only_from_there)
      begun_ = begun(parsed(grip_->text({at + Vec<2>(1, 0)}), name_, lesson_.get()));
    if (begun_ && !begun_->is_long()) begun_.reset();
    return object_of("grabbed", grip_->what(), "kept", bool(begun_));
  }

  std::string drag(const json& q) {
    if (!grip_) throw Refused("nothing is grabbed");
    const std::string text =
        grip_->text({point_in(q, "x", "y"), number_in(q, "turn"), point_in(q, "vx", "vy")});
    std::vector<int> like;
    language::Scenario changed = parsed(text, name_, lesson_.get(), &like);
    auto now = std::exchange(begun_, nullptr);
    const bool goes_on = now && now->scenario().steps.size() == changed.steps.size();
    if (!goes_on) now = begun(std::move(changed));
    const language::Scenario& scenario = goes_on ? changed : now->scenario();
    now->go_on(scenario, grip_->moment);
    const std::size_t index = now->index_of(grip_->moment);
    const Frame& frame = now->frames()[index];
    Pictures one(like);
    one.add(frame, nullptr, play_->picture(frame, grabbed_, scenario), scenario);
    left_ = text;
    return fmt::format("{{\"text\": {}, \"index\": {}, \"steps\": {}, {}}}", json_string(text),
                       index, scenario.steps.size(), one.json());
  }

  std::string fly() {
    if (left_.empty()) throw Refused("nothing was moved");
    std::vector<int> like;
    language::Scenario scenario = parsed(left_, name_, lesson_.get(), &like);
    const double step = scenario.world.time_step;
    const double every = std::clamp(std::round(kFlight / step), 1.0, double{kMost});
    stop_every(static_cast<int>(every), grip_->moment.step, scenario);
    text_ = left_;
    begin(std::make_shared<Play>(std::move(scenario)), std::move(like), play_->sheet, play_->held);
    return object_of("frames", play_->frames().size(), "seconds", every * step);
  }

  // A body more or less, in a step behind that of a frame.
  std::string recast(const json& q, bool adds) {
    const Frame& frame = play_->frames()[index_in(q, "frame")];
    std::string entity = adds ? "" : q.at("entity");
    const std::string text =
        adds ? with_another(text_, *play_, frame, entity) : without(text_, frame, entity);
    return object_of("text", text, "entity", entity, "index", play_->index_of({frame.step}) + 1);
  }

  // Of another text than the lesson's what is its own, and which steps of the lesson its steps are.
  language::Scenario parsed(const std::string& text, const std::string& name, const Play* lesson,
                            std::vector<int>* like = nullptr) const {
    language::Scenario scenario = language::parse_scenario(text, name);
    if (words_) language::translate(scenario, *words_);
    if (!lesson) return scenario;
    const language::Scenario& its = lesson->scenario();
    if (like) *like = steps_in(its, scenario);
    if (text != its.text) keep_own_words(scenario, its);
    return scenario;
  }
  std::unique_ptr<Play> begun(language::Scenario scenario) const {
    return std::make_unique<Play>(std::move(scenario), grip_->moment);
  }

  std::shared_ptr<const WordTable> words_;  // of the page; null: English
  std::shared_ptr<Play> lesson_;            // that texts are made from; null: none was told
  std::shared_ptr<Play> play_;              // of what was opened last
  std::vector<int> like_;                   // of its steps
  std::unique_ptr<Play> begun_;  // what stays the same of a hand's texts, until it has gone on
  std::string text_, name_;
  std::string left_;  // by the last drag; empty if there was none since then
  std::unique_ptr<Grip> grip_;
  std::size_t grabbed_ = 0;  // the frame that was looked at then
};

Session::Session() : engine_(std::make_unique<Engine>()) {}
Session::~Session() = default;

std::string Session::ask(std::string_view question) {
  try {
    return engine_->answer(json::parse(question));
  } catch (const ScenarioError& e) {
    return object_of("refused", e.diagnostics(), "said", std::string_view(e.what()));
  } catch (const json::exception& e) {
    return refusal(fmt::format("the request is not understood: {}", e.what()));
  } catch (const std::bad_alloc&) {
    return refusal("the engine of a page has not so much memory");
  } catch (const std::exception& e) {
    return refusal(e.what());
  }
}

}  // namespace lantern::live
