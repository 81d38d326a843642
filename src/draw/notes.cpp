#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "draw/panel.hpp"
#include "draw/pen.hpp"

namespace lantern::draw {
namespace {

const TextStyle kNoteStyle{24, Weight::regular, Role::ink};
constexpr double kNoteLine = 30;       // from baseline to baseline
constexpr double kWidestNote = 300;    // of a line
constexpr double kNoteMargin = 8;      // around the words
constexpr double kFarthestNote = 320;  // of the words from what they are about, but in need

// What the note is about: a place on the page, and whether it is a point rather than a thing.
struct Target {
  Box<2> box;
  bool is_point = false;
};

std::optional<Target> find_target(const Frame& frame, std::size_t index, const Labels& labels) {
  const FrameNote& note = frame.notes[index];
  const auto place = [&](const std::string& key) { return labels.place_of(key); };
  const auto of_body = [&](BodyId id) -> const Box<2>* {
    const FrameBody* body = frame.body_of(id);
    return body ? place(target_of(*body)) : nullptr;
  };
  const Box<2>* found = nullptr;
  if (note.of == NoteOf::pair) {
    const Box<2>*a = of_body(note.bodies[0]), *b = of_body(note.bodies[1]);
    if (!a || !b) return std::nullopt;
    const Vec<2> middle = (a->center() + b->center()) / 2.0;
    return Target{{middle, middle}, true};
  }
  if (note.of == NoteOf::body) found = of_body(note.bodies[0]);
  if (note.of == NoteOf::node) {
    const std::string& label = frame.nodes[note.node].label;
    found = place(target_of_node(label));
    if (!found) found = place(target_of_cell(label));
  }
  if (note.of == NoteOf::count) found = place(target_of_count(note.count));
  if (note.of == NoteOf::point) found = place(target_of_note(index));
  if (!found) return std::nullopt;
  return Target{*found, note.of == NoteOf::point};
}

struct Words {
  std::vector<std::string> lines;
  Vec<2> size{0.0};  // of their plate
};

Words lines_of(const std::string& text) {
  Words words;
  const double all = text_width(text, kNoteStyle);
  const double width = all <= kWidestNote ? all : std::max(0.56 * all, 0.5 * kWidestNote);
  words.lines = wrapped(text, width + 1, kNoteStyle);
  for (const std::string& line : words.lines)
    words.size.x = std::max(words.size.x, text_width(line, kNoteStyle));
  words.size += Vec<2>(2 * kNoteMargin, 2 * kNoteMargin +
                                            kNoteLine * static_cast<double>(words.lines.size()) -
                                            (kNoteLine - kNoteStyle.size));
  return words;
}

// Where a line from the middle of a box to a point leaves the box.
Vec<2> rim_of(const Box<2>& box, const Vec<2>& towards) {
  const Vec<2> c = box.center(), way = towards - c, half = box.size() / 2.0;
  const double x = std::abs(way.x) > 1e-9 ? half.x / std::abs(way.x) : 1e9;
  const double y = std::abs(way.y) > 1e-9 ? half.y / std::abs(way.y) : 1e9;
  return c + way * std::min({x, y, 1.0});
}

// How much of what is drawn the plate or its line would disturb. Grounds do not count.
class Clutter {
 public:
  explicit Clutter(const DrawList& list) {
    for (const DrawShape& shape : list.shapes) {
      if (const auto* rect = std::get_if<RectShape>(&shape)) {
        add(rect->box);
        if (rect->stroke.role != Role::none) add_outline(rect->box);
      }
      if (const auto* polygon = std::get_if<PolygonShape>(&shape)) add(box_of(polygon->points));
      if (const auto* line = std::get_if<LineShape>(&shape))
        lines_.push_back({line->from, line->to});
    }
    for (const LabelBox& label : list.labels) labels_.push_back(label.box);
  }

  double under(const Box<2>& plate) const {
    double cost = 0;
    for (const Box<2>& thing : things_)
      if (overlap(plate, thing)) {
        const Vec<2> size = glm::min(plate.hi, thing.hi) - glm::max(plate.lo, thing.lo);
        cost += 0.02 * (size.x * size.y);
      }
    for (const auto& [from, to] : lines_) cost += cut_line(from, to, plate) ? 20 : 0;
    return cost;
  }
  double crossed(const Vec<2>& from, const Vec<2>& to) const {
    return sum_of<double>(labels_,
                          [&](const Box<2>& label) { return cut_line(from, to, label) ? 400 : 0; });
  }

 private:
  void add(const Box<2>& box) {
    constexpr double kGround = 40'000;  // page units squared
    if (box.size().x * box.size().y < kGround) things_.push_back(box);
  }
  void add_outline(const Box<2>& box) {
    const Vec<2> corners[] = {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
    for (std::size_t i = 0; i < 4; ++i) lines_.push_back({corners[i], corners[(i + 1) % 4]});
  }
  std::vector<Box<2>> things_, labels_;
  std::vector<std::pair<Vec<2>, Vec<2>>> lines_;
};

struct Placing {
  const Target& target;
  const Words& words;
  const Box<2>& area;
  const Labels& labels;
  const Clutter& clutter;

  // Nothing where a label, or with `clear` a body, would be covered.
  std::optional<double> cost_of(const Box<2>& plate, bool clear) const {
    if (!holds(area, plate) || !labels.is_free(plate, area)) return std::nullopt;
    if (clear && labels.covers_body(plate)) return std::nullopt;
    const Vec<2> to = rim_of(target.box, plate.center());
    const Vec<2> from = rim_of(plate, to);
    double cost = glm::length(to - from) + clutter.under(plate) + clutter.crossed(from, to);
    for (const Box<2>& body : labels.bodies())
      if (!overlap(body, target.box) && cut_line(from, to, body)) cost += 250;
    if (overlap(plate, target.box)) cost += 500;
    return cost;
  }

  std::optional<Box<2>> best(double farthest, bool clear) const {
    constexpr int kWays = 24;
    std::optional<Box<2>> found;
    double least = 1e300;
    for (double away = 26; away <= farthest; away += 18)
      for (int i = 0; i < kWays; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.5) / kWays;
        const Vec<2> way = unit_at(-angle);
        const Vec<2> reach = target.box.size() / 2.0 + words.size / 2.0 + Vec<2>(away);
        const Box<2> plate = Box<2>::around(target.box.center() + way * reach, words.size / 2.0);
        const auto cost = cost_of(plate, clear);
        if (!cost || *cost >= least - 1e-6) continue;
        least = *cost;
        found = plate;
      }
    return found;
  }
};

void write(const Words& words, const Box<2>& plate, const Box<2>& area, DrawList& list,
           Labels& labels) {
  list.rect(plate, Role::paper, {Role::quiet_ink, 1.4}, 6);
  double y = plate.lo.y + kNoteMargin + 0.5 * kNoteStyle.size;
  for (const std::string& line : words.lines) {
    labels.add(line, centred({plate.center().x, y}, kNoteStyle), kNoteStyle, area);
    y += kNoteLine;
  }
  labels.block(plate);
}

// Of a thing a line to its rim, of a point one to a small ring about it.
void lead(const Target& target, const Box<2>& plate, DrawList& list) {
  constexpr double kRing = 5;
  const Vec<2> to = target.is_point ? target.box.center() : rim_of(target.box, plate.center());
  const Vec<2> from = rim_of(plate, to);
  const double length = glm::length(to - from);
  if (!(length > 1)) return;
  const Vec<2> end = target.is_point ? to + (from - to) * std::min(1.0, kRing / length) : to;
  list.line(from, end, {Role::panel, 4.4});
  list.line(from, end, {Role::ink, 1.8});
  if (target.is_point)
    list.disc(to, kRing, Role::none, {Role::ink, 1.8});
  else
    list.disc(to, 3.2, Role::ink);
}

// Without a target: along the upper edge, wherever it is free.
void write_apart(const Words& words, const Box<2>& area, DrawList& list, Labels& labels) {
  for (double y = area.lo.y; y + words.size.y <= area.hi.y; y += 12)
    for (double x = area.lo.x; x + words.size.x <= area.hi.x; x += 24) {
      const Box<2> plate{{x, y}, Vec<2>(x, y) + words.size};
      if (labels.is_free(plate, area)) return write(words, plate, area, list, labels);
    }
}

}  // namespace

std::string target_of(const FrameBody& body) { return fmt::format("body/{}", body.id); }
std::string target_of_node(const std::string& label) { return "node/" + label; }
std::string target_of_cell(const std::string& label) { return "cell/" + label; }
std::string target_of_count(const std::string& name) { return "count/" + name; }
std::string target_of_note(std::size_t index) { return fmt::format("note/{}", index); }

void draw_notes(const Frame& frame, const Box<2>& area, DrawList& list, Labels& labels) {
  for (std::size_t i = 0; i < frame.notes.size(); ++i) {
    const DrawList::Scope scope(list, fmt::format("note/{}", frame.notes[i].text));
    const Words words = lines_of(frame.notes[i].text);
    const auto target = find_target(frame, i, labels);
    if (!target) {
      write_apart(words, area, list, labels);
      continue;
    }
    const Clutter clutter(list);
    const Placing placing{*target, words, area, labels, clutter};
    auto plate = placing.best(kFarthestNote, true);
    if (!plate) plate = placing.best(2 * kFarthestNote, true);
    if (!plate) plate = placing.best(2 * kFarthestNote, false);
    if (!plate) {
      write_apart(words, area, list, labels);
      continue;
    }
    lead(*target, *plate, list);
    write(words, *plate, area, list, labels);
  }
}

}  // namespace lantern::draw
