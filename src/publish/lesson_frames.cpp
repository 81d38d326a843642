// What the keys of shapes (draw/keys.hpp) stand for.
#include "publish/lesson_frames.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <variant>

#include <fmt/format.h>

#include "base/json_writer.hpp"
#include "base/stop.hpp"
#include "draw/font.hpp"
#include "draw/page.hpp"
#include "draw/theme.hpp"
#include "language/scenario.hpp"

namespace lantern::publish {
namespace {

// "world/cell/root.0" as "world", "cell", "root.0".
std::vector<std::string_view> parts_of(std::string_view key) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= key.size();) {
    const std::size_t slash = std::min(key.find('/', at), key.size());
    parts.push_back(key.substr(at, slash - at));
    at = slash + 1;
  }
  return parts;
}

bool is_among(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

class Entities {
 public:
  Entities(std::string prefix, const Frame& side) : prefix_(std::move(prefix)), side_(side) {}

  // By the panel and the kind within it; what follows says of whom.
  std::vector<std::string> of(const std::vector<std::string_view>& parts) {
    if (parts.size() < 2) return {};
    const std::string_view panel = parts[0], kind = parts[1];
    if (panel == "pool") add("slot", kind);
    if (panel == "sweep" || panel == "ledger") add_ids(kind);
    if (parts.size() < 3) return std::move(found_);
    if (panel == "ledger" && kind == "body") add_ids(parts[2]);
    if (panel == "world") add_of_world(parts);
    if (panel == "tree" && is_among(kind, {"node", "edge", "name", "side"})) add("node", parts[2]);
    if (panel == "tree" && is_among(kind, {"body", "texture"})) {
      add("body", parts[2]);
      if (parts.size() > 3) add("node", parts[3]);
    }
    if (panel == "islands" && kind == "node") add("body", parts[2]);
    if (panel == "islands" && kind == "edge" && parts.size() > 3) add_pair(parts[2], parts[3]);
    if (panel == "memory" && kind == "leaf") add("node", parts[2]);
    if (panel == "atlas" && is_among(kind, {"cell", "lit", "name"})) add("node", parts[2]);
    if (panel == "atlas" && is_among(kind, {"texture", "plate"})) add("body", parts[2]);
    return std::move(found_);
  }

 private:
  void add_of_world(const std::vector<std::string_view>& parts) {
    const std::string_view kind = parts[1];
    if (is_among(kind, {"body", "box", "broad box", "name", "outside", "velocity", "shadow", "drop",
                        "over"}))
      add("body", parts[2]);
    if (is_among(kind, {"cell", "border", "lit", "plane", "plane name", "ground", "cell name"}))
      add("node", parts[2]);
    if (parts.size() < 4) return;
    if (is_among(kind, {"pair", "joint"})) add_pair(parts[2], parts[3]);
    if (kind == "contact") add_ids(fmt::format("{}-{}", parts[2], parts[3]));
  }

  void add(std::string_view kind, std::string_view whose) {
    found_.push_back(fmt::format("{}{}/{}", prefix_, kind, whose));
  }
  void add_pair(std::string_view a, std::string_view b) {
    add("pair", fmt::format("{}|{}", std::min(a, b), std::max(a, b)));
  }
  // "7" is a body, "3-7" a pair.
  void add_ids(std::string_view ids) {
    const auto is_number = [](std::string_view text) {
      return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
    };
    const std::size_t dash = ids.find('-');
    if (is_number(ids)) add("body", name_of(ids));
    if (dash == ids.npos) return;
    const std::string_view a = ids.substr(0, dash), b = ids.substr(dash + 1);
    if (is_number(a) && is_number(b)) add_pair(name_of(a), name_of(b));
  }

  // As its keys have it: by its number where it has no name.
  std::string name_of(std::string_view id) const {
    for (const FrameBody& body : side_.bodies)
      if (!body.name.empty() && fmt::format("{}", body.id) == id) return body.name;
    return fmt::format("#{}", id);
  }

  std::string prefix_;
  const Frame& side_;
  std::vector<std::string> found_;
};

std::int64_t whole(double x) { return static_cast<std::int64_t>(std::floor(x + 0.5)); }
std::int64_t thousandths(double x) { return whole(1000 * x); }

int number_of(Role role) { return static_cast<int>(role); }

// A list of JSON: whole numbers, behind `first` if there is one.
class Numbers {
 public:
  explicit Numbers(std::string first = "") : text_(std::move(first)) {}
  void add(std::integral auto... numbers) {
    ((text_ += text_.empty() ? "" : ",", text_ += fmt::format_int(numbers).c_str()), ...);
  }
  // A point, told by its way from another one.
  void add_way(const Vec<2>& from, const Vec<2>& to) {
    add(hundredths(to.x) - hundredths(from.x), hundredths(to.y) - hundredths(from.y));
  }
  std::string json() const { return "[" + text_ + "]"; }

 private:
  std::string text_;
};

std::string list_of(std::integral auto... numbers) {
  Numbers list;
  list.add(numbers...);
  return list.json();
}

// A glyph's path in ems and absolute, as one of thousandths that goes on from where the pen is.
std::string written_path(int glyph, Weight weight) {
  std::string text = "\"";
  std::array<std::int64_t, 2> pen{}, start{};
  for (const PathStep& step : glyph_path(glyph, weight)) {
    text += static_cast<char>(step.letter - 'A' + 'a');
    std::array<std::int64_t, 2> at = pen;
    for (std::size_t i = 0; i < 2 * step.points.size(); ++i) {  // all from where the pen was
      at[i % 2] = thousandths(step.points[i / 2][static_cast<int>(i % 2)]);
      const std::int64_t way = at[i % 2] - pen[i % 2];
      if (i > 0 && way >= 0) text += ' ';  // a sign separates numbers as well
      text += fmt::format_int(way).c_str();
    }
    pen = step.letter == 'Z' ? start : at;  // a closed contour leaves the pen at its start
    if (step.letter == 'M') start = pen;
  }
  return text + "\"";
}

// The same, written once.
const std::string& quoted_path(int glyph, Weight weight) {
  thread_local std::map<std::pair<int, Weight>, std::string> known;
  const auto [it, fresh] = known.try_emplace({glyph, weight});
  if (fresh) it->second = written_path(glyph, weight);
  return it->second;
}

bool is_put(const Passage& p) { return !(p.own == p.start && p.own == p.end); }

// Rows that stand still, one after the other.
struct StandingRun {
  std::size_t first = 0, count = 0;
};

// When each beat of a change begins and ends, eased and steady: [[[from, to, eased], ...], ...].
std::string beats() {
  std::string text;
  for (const Motion motion : {Motion::eased, Motion::steady}) {
    text += text.empty() ? "[" : ",[";
    for (int i = 0; i < static_cast<int>(Beat::count_beats); ++i) {
      const BeatSpan span = span_of(static_cast<Beat>(i), motion);
      text +=
          fmt::format("{}[{},{},{}]", i > 0 ? "," : "", span.from, span.to, span.is_eased ? 1 : 0);
    }
    text += "]";
  }
  return "[" + text + "]";
}

// The roles' colours as CSS variables.
std::string colours(const Theme& theme) {
  std::string text;
  for (std::size_t i = 0; i < theme.colors.size(); ++i) {
    const Color& c = theme.colors[i];
    text += fmt::format("--role-{}:#{:02x}{:02x}{:02x};", i, c.r, c.g, c.b);
  }
  return text;
}

}  // namespace

std::vector<std::string> entities_of(const std::string& key, const Frame& frame) {
  std::string_view rest = key;
  const Frame* side = &frame;
  std::string prefix;
  for (const Frame& one : frame.sides) {
    if (!rest.starts_with(one.get<FrameSide>().name + "/")) continue;
    prefix = one.get<FrameSide>().name + "/";
    rest.remove_prefix(prefix.size());
    side = &one;
    break;
  }
  return Entities(prefix, *side).of(parts_of(rest));
}

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
  const Vec<2> size = s.box.size();
  const double most = std::max(0.0, 0.5 * std::min(size.x, size.y));
  Numbers row;
  row.add(0, key, style(s.fill, s.stroke, s.snapped));
  row.add_way(Vec<2>(0), s.box.lo);
  row.add_way(s.box.lo, s.box.hi);
  row.add(hundredths(std::min(s.radius, most)));
  return row.json();
}

std::string LessonShapes::row_of(const LineShape& s, std::uint32_t key) {
  Numbers row;
  row.add(1, key, style(Role::none, s.stroke, s.snapped));
  row.add_way(Vec<2>(0), s.from);
  row.add_way(s.from, s.to);
  return row.json();
}

std::string LessonShapes::row_of(const PolygonShape& s, std::uint32_t key) {
  Numbers row;
  row.add(2, key, style(s.fill, s.stroke));
  Vec<2> last{0.0};
  for (const Vec<2>& point : s.points) {
    row.add_way(last, point);
    last = point;
  }
  return row.json();
}

std::string LessonShapes::row_of(const TextShape& s, std::uint32_t key) {
  return list_of(3, key, style(s.role, {s.halo, 0, 0}), hundredths(s.at.x), hundredths(s.at.y),
                 hundredths(s.size), text(s));
}

std::uint32_t LessonShapes::style(Role fill, const Stroke& stroke, bool snapped) {
  return styles_.number(list_of(number_of(fill), number_of(stroke.role), hundredths(stroke.width),
                                hundredths(stroke.dash), int{snapped}));
}

std::uint32_t LessonShapes::text(const TextShape& s) {
  const int weight = static_cast<int>(s.weight);
  return texts_.number(fmt::format("{} {} {}", weight, s.align, s.text), [&] {
    Numbers one(json_string(s.text));
    const double left = s.align == 0 ? 0 : -s.align * text_width(s.text, 1, s.weight);
    for (const PlacedGlyph& g : shape_text(s.text, 1, s.weight))
      one.add(thousandths(left + g.x), glyphs_.number(fmt::format("{} {}", weight, g.glyph), [&] {
        return quoted_path(g.glyph, s.weight);
      }));
    return one.json();
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

Vec<2> lesson_page() {
  return page_for(1600, static_cast<int>(std::lround((1 - kLessonWords) * 900)));
}

FrameWords words_of(const Frame& before, const Frame& frame, const Scenario& scenario) {
  const Motion motion = motion_between(before, frame);
  return {scenario.steps.at(frame.step).speaker_notes, counter_texts(frame), motion,
          motion == Motion::steady ? frame.time - before.time : kChangeSeconds};
}

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
  if (!words.counters.empty()) json.member("counters", words.counters);
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
      numbers.add(-1, count);
    } else if (const auto place = places.find(rows[i]); place != places.end()) {
      const std::size_t at = place->second;
      while (i + count < rows.size() && at + count < last_rows_.size() &&
             rows[i + count] == last_rows_[at + count])
        ++count;
      numbers.add(at, count);
    } else {
      numbers.add(-2, rows[i]);
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
    numbers.add(-static_cast<std::int64_t>(still.count), still.first);
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
  return kinds_.number(list_of(int{p.a.has_value()}, int{p.b.has_value()}, static_cast<int>(p.move),
                               static_cast<int>(p.fade), int{p.leaves}, int{is_put(p)}));
}

// Of its two boxes one is the shape's own: the other one is where it comes from or goes to.
std::uint32_t LessonFrames::place_of(const Passage& p) {
  const Box<2>& to = p.leaves ? p.end : p.start;
  Vec<2> scale{1.0};
  for (int i = 0; i < 2; ++i)  // a box without width has only a middle
    if (p.own.size()[i] > 1e-9) scale[i] = to.size()[i] / p.own.size()[i];
  const Vec<2> way = to.center() - p.own.center() * scale;
  return places_.number(list_of(hundredths(100 * scale.x), hundredths(100 * scale.y),
                                hundredths(way.x), hundredths(way.y)));
}

std::string LessonFrames::json() const {
  return fmt::format(
      "{{\"format\": \"lantern.lesson/1\",\n\"page\": [{},{}],\n\"beats\": {},\n{},\n\"kinds\": "
      "{},\n\"places\": {},\n\"frames\": [{}]}}\n",
      hundredths(last_.page.x), hundredths(last_.page.y), beats(), shapes_.json(), kinds_.json(),
      places_.json(), frames_);
}

std::string lesson_colours(std::span<const BodyPaint> paints) {
  const auto of = [&](const char* theme) { return colours(theme_named(theme)->with(paints)); };
  const std::string light = of("light"), dark = of("dark"), print = of("print");
  std::string css = fmt::format(":root{{{}}}\n", light);
  css +=
      fmt::format("@media (prefers-color-scheme: dark){{:root:not([data-theme]){{{}}}}}\n", dark);
  css += fmt::format(":root[data-theme=dark]{{{}}}\n:root[data-theme=print]{{{}}}\n", dark, print);
  css += fmt::format("@media print{{:root,:root[data-theme]{{{}}}}}\n", print);
  // Names for what the page itself is made of.
  for (const auto& [name, role] :
       {std::pair{"paper", Role::paper}, std::pair{"panel", Role::panel},
        std::pair{"ink", Role::ink}, std::pair{"quiet", Role::quiet_ink},
        std::pair{"rule", Role::rule}, std::pair{"lit", Role::lit},
        std::pair{"lit-ink", Role::lit_ink}, std::pair{"lit-fill", Role::lit_fill}})
    css += fmt::format(":root{{--{}:var(--role-{})}}\n", name, static_cast<int>(role));
  std::vector<int> painted;
  for (const BodyPaint& paint : paints) painted.push_back(paint.color);
  if (!painted.empty()) css += fmt::format(":root{{--painted:{}}}\n", fmt::join(painted, " "));
  return css;
}

}  // namespace lantern::publish
