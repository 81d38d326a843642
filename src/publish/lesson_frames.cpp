#include "publish/lesson_frames.hpp"

#include <unordered_map>

#include <fmt/format.h>

#include "base/json_writer.hpp"
#include "base/stop.hpp"

namespace lantern::publish {
namespace {

// A list of whole numbers as JSON.
class Numbers {
 public:
  void add(std::int64_t number) { text_ += fmt::format("{}{}", text_.empty() ? "" : ",", number); }
  std::string json() const { return "[" + text_ + "]"; }

 private:
  std::string text_;
};

bool is_put(const Passage& p) { return !(p.own == p.start && p.own == p.end); }

// Rows that stand still, one after the other.
struct StandingRun {
  std::size_t first = 0, count = 0;
};

}  // namespace

std::string whole_caption(const Frame& frame) {
  std::string words = frame.caption;
  for (const Frame& side : frame.sides)
    if (!side.get<FrameSide>().held && !side.caption.empty())
      words += fmt::format("{}{}: {}", words.empty() ? "" : " ", side.get<FrameSide>().title,
                           side.caption);
  return words;
}

void LessonFrames::add(const Frame& frame, const DrawList& list, const FrameWords& words) {
  const std::vector<std::uint32_t> rows = shapes_.rows_of(list, frame);
  JsonWriter json;
  json.begin_object().members("step", frame.step, "event", frame.event, "time", frame.time,
                              "caption", whole_caption(frame));
  if (!frame.part.empty()) json.member("part", frame.part);
  if (frame.ending) json.member("ending", true);
  if (!words.notes.empty()) json.member("notes", words.notes);
  if (!words.counters.empty()) {
    json.key("counters").begin_array();
    for (const std::string& counter : words.counters) json.value(counter);
    json.end_array();
  }
  std::string text = json.end_object().text();
  text.pop_back();
  text += ", \"rows\": " + rows_text(rows);
  if (count_ > 0)
    text += fmt::format(", \"way\": {}, \"motion\": {}, \"seconds\": {:.4g}", way_text(list, rows),
                        static_cast<int>(words.motion), words.seconds);
  frames_ += (count_ > 0 ? ",\n" : "") + text + "}";
  ++count_;
  last_ = list;
  last_rows_ = rows;
  known_rows_ = shapes_.rows();
}

std::string LessonFrames::rows_text(const std::vector<std::uint32_t>& rows) {
  std::unordered_map<std::uint32_t, std::size_t> places;
  for (std::size_t i = last_rows_.size(); i-- > 0;) places[last_rows_[i]] = i;
  Numbers numbers;
  std::size_t seen = known_rows_;
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t count = 1;
    if (rows[i] == seen) {  // rows are numbered as they come
      while (i + count < rows.size() && rows[i + count] == seen + count) ++count;
      seen += count;
      numbers.add(-1);
      numbers.add(static_cast<std::int64_t>(count));
    } else if (const auto place = places.find(rows[i]); place != places.end()) {
      const std::size_t at = place->second;
      while (i + count < rows.size() && at + count < last_rows_.size() &&
             rows[i + count] == last_rows_[at + count])
        ++count;
      numbers.add(static_cast<std::int64_t>(at));
      numbers.add(static_cast<std::int64_t>(count));
    } else {
      numbers.add(-2);
      numbers.add(rows[i]);
    }
    i += count;
  }
  return numbers.json();
}

std::string LessonFrames::way_text(const DrawList& list, const std::vector<std::uint32_t>& rows) {
  Numbers numbers;
  std::int64_t last_a = -1, last_b = -1;
  StandingRun still;
  const auto end_run = [&] {
    if (still.count == 0) return;
    numbers.add(-static_cast<std::int64_t>(still.count));
    numbers.add(static_cast<std::int64_t>(still.first));
    still.count = 0;
  };
  const auto add_step = [&](std::size_t to, std::int64_t& last) {
    numbers.add(static_cast<std::int64_t>(to) - last);
    last = static_cast<std::int64_t>(to);
  };
  for (const Passage& p : passages(last_, list)) {
    stop_if_asked();
    const bool same = p.a && p.b && last_rows_[*p.a] == rows[*p.b];
    if (same || (!p.a && p.fade == Beat::always && !is_put(p))) {
      if (still.count > 0 && *p.b != still.first + still.count) end_run();
      if (still.count == 0) still.first = *p.b;
      ++still.count;
      continue;
    }
    end_run();
    numbers.add(kind_of(p));
    if (p.a) add_step(*p.a, last_a);
    if (p.b) add_step(*p.b, last_b);
    if (is_put(p)) numbers.add(place_of(p));
  }
  end_run();
  return numbers.json();
}

std::uint32_t LessonFrames::kind_of(const Passage& p) {
  return kinds_.number(fmt::format("[{},{},{},{},{},{}]", p.a ? 1 : 0, p.b ? 1 : 0,
                                   static_cast<int>(p.move), static_cast<int>(p.fade),
                                   p.leaves ? 1 : 0, is_put(p) ? 1 : 0));
}

// Of its two boxes one is the shape's own: the other one is where it comes from or goes to.
std::uint32_t LessonFrames::place_of(const Passage& p) {
  const Box<2>& to = p.leaves ? p.end : p.start;
  Vec<2> scale{1.0};
  for (int i = 0; i < 2; ++i)  // a box without width has only a middle
    if (p.own.size()[i] > 1e-9) scale[i] = to.size()[i] / p.own.size()[i];
  const Vec<2> way = to.center() - p.own.center() * scale;
  return places_.number(fmt::format("[{},{},{},{}]", hundredths(100 * scale.x),
                                    hundredths(100 * scale.y), hundredths(way.x),
                                    hundredths(way.y)));
}

std::string LessonFrames::json() const {
  return fmt::format("{},\n\"kinds\": {},\n\"places\": {},\n\"frames\": [{}]", shapes_.json(),
                     kinds_.json(), places_.json(), frames_);
}

}  // namespace lantern::publish
