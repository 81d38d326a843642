#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/marks.hpp"
#include "draw/number_text.hpp"
#include "draw/panel.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kMemoryHeading = 38;
constexpr double kBracket = 30;    // under a row, for brackets and names
constexpr double kRowGap = 12;     // between rows
constexpr double kNamedSlot = 46;  // from here on a body's name has room under it
constexpr double kDrawnSlot = 18;  // from here on slots are drawn one by one
constexpr double kSlots[] = {100, 84, 72, 62, 54, 46, 40, 34, 28, 24, 20, 16, 13, 10, 8, 6, 5};
constexpr std::size_t kMostSlotShapes = 2600;  // that slots may take

// How slots are laid out on a panel.
struct Strip {
  double slot = 0;    // width
  double height = 0;  // of a slot
  double pitch = 0;   // from row to row
  double gutter = 0;  // before each row, for the number of its first slot
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  enum class Names { none, brief, full } names = Names::none;  // of bodies, under them

  bool named() const { return names != Names::none; }
  bool drawn() const { return slot >= kDrawnSlot; }
};

// The first letter, and the digits that a name ends with: "b12" of "body 12". A name without digits
// stays whole: of its first letter nobody could tell who it is.
std::string brief_name(const std::string& name) {
  std::size_t digits = name.size();
  while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9') --digits;
  if (digits == 0 || digits == name.size()) return name;
  return name.substr(0, std::min(digits, first_letter(name).bytes)) + name.substr(digits);
}

// The room that the bodies' names need.
struct NameWidths {
  double full = 0, brief = 0;
};

NameWidths name_widths(const Frame& frame) {
  if (frame.display.names == ShownNames::none) return {1e9, 1e9};
  NameWidths widest;
  std::map<std::string, std::string> meant;  // by brief names
  for (const FrameBody& body : frame.bodies) {
    const std::string brief = brief_name(body.called());
    widest.full = std::max(widest.full, text_width(body.called(), kQuiet));
    widest.brief = std::max(widest.brief, text_width(brief, kQuiet));
    if (meant.emplace(brief, body.called()).first->second != body.called()) widest.brief = 1e9;
  }
  if (widest.brief > widest.full) widest.brief = widest.full;  // brief ones would be mistaken
  return widest;
}

// All bodies have the longest names that fit, or none has one.
Strip strip_for(std::uint32_t slots, double slot, double width, const NameWidths& widest) {
  Strip s;
  s.slot = slot;
  const double room = slot - 4;
  if (slot >= kNamedSlot && widest.brief <= room)
    s.names = widest.full <= room ? Strip::Names::full : Strip::Names::brief;
  s.height = s.named() ? slot + 16 : slot;
  s.pitch = s.height + (s.drawn() ? kBracket + kRowGap : 10);
  const std::string last = number_text(slots);
  s.gutter = text_width(last, kQuiet) + 12;
  s.columns = static_cast<std::uint32_t>(std::max(1.0, (width - s.gutter) / slot));
  // Whole eights are easier to count.
  if (s.columns > 16 && s.columns < slots) s.columns -= s.columns % 8;
  s.columns = std::min(s.columns, std::max(slots, 1u));
  s.rows = (std::max(slots, 1u) + s.columns - 1) / s.columns;
  return s;
}

// The largest slots at which all of them have room, or the smallest there are.
Strip best_strip(std::uint32_t slots, const Vec<2>& room, const NameWidths& widest) {
  Strip s;
  for (const double slot : kSlots) {
    s = strip_for(slots, slot, room.x, widest);
    if (s.rows * s.pitch <= room.y) break;
  }
  return s;
}

class MemoryView : PanelPicture {
 public:
  explicit MemoryView(const PanelPicture& on) : PanelPicture(on), bodies_(by_id(frame_.bodies)) {
    const Box<2> area{panel_.lo + Vec<2>(0, kMemoryHeading), panel_.hi};
    strip_ = best_strip(frame_.get<FrameStructure>().array_size, area.size(), name_widths(frame_));
    const double rows = std::max(1.0, std::floor((area.size().y + 4) / strip_.pitch));
    shown_ = static_cast<std::uint32_t>(
        std::min<double>(frame_.get<FrameStructure>().array_size, rows * double(strip_.columns)));
    origin_ = area.lo + Vec<2>(strip_.gutter, 0);
  }

  void draw() {
    list_.referents.insert({"slots", "entries", "allocations"});
    if (is_in_pieces(frame_)) return draw_list_pieces(*this);
    std::vector<const FrameNode*> leaves;
    for (const FrameNode& node : frame_.nodes)
      if (node.leaf && node.first != kNone && node.room > 0 && node.first < shown_)
        leaves.push_back(&node);
    std::ranges::stable_sort(leaves, {}, [](const FrameNode* leaf) {
      return std::pair(leaf->mark == Mark::lit, leaf->first);
    });
    draw_free();
    number_rows();
    bool left_out = false;
    for (const FrameNode* leaf : leaves) {
      left_out = list_.shapes.size() > kMostSlotShapes;
      if (left_out) break;
      draw_leaf(*leaf);
    }
    draw_heading(left_out);
  }

 private:
  Box<2> place(std::uint32_t slot, std::uint32_t count = 1) const {
    const Vec<2> lo = origin_ + Vec<2>((slot % strip_.columns) * strip_.slot,
                                       (slot / strip_.columns) * strip_.pitch);
    return {lo, lo + Vec<2>(count * strip_.slot, strip_.height)};
  }

  // f(first slot, count) for the pieces of a run that lie in one row each.
  void for_each_piece(std::uint32_t first, std::uint32_t count, const auto& f) const {
    if (first >= shown_) return;
    const std::uint32_t end = first + std::min(count, shown_ - first);
    while (first < end) {
      const std::uint32_t here = std::min(end - first, strip_.columns - first % strip_.columns);
      f(first, here);
      first += here;
    }
  }

  // All slots as if they belonged to nobody; leaves are painted over them.
  void draw_free() {
    for_each_piece(0, shown_, [&](std::uint32_t first, std::uint32_t count) {
      const Box<2> row = place(first, count);
      list_.crisp_rect(row, Role::free_space, {Role::cell_line_3, 1.2, 4});
      if (!strip_.drawn() || list_.shapes.size() > kMostSlotShapes / 2) return;
      for (std::uint32_t i = 1; i < count; ++i) {
        const double x = row.lo.x + i * strip_.slot;
        list_.crisp_line({x, row.lo.y}, {x, row.hi.y}, {Role::cell_line_3, 1.2, 4});
      }
    });
  }

  void number_rows() {
    double last = -1e9;
    for (std::uint32_t first = 0; first < shown_; first += strip_.columns) {
      const Box<2> box = place(first);
      const double y = box.center().y + 6;
      if (y < last + 24) continue;
      if (try_write(number_text(first), {{{origin_.x - 10, y}, 1}}, kQuiet)) last = y;
    }
  }

  void draw_leaf(const FrameNode& leaf) {
    const DrawList::Scope scope(list_, node_key("memory/leaf", frame_.nodes, leaf),
                                parent_key("memory/leaf", frame_.nodes, leaf));
    const bool lit = leaf.mark == Mark::lit;
    const Stroke outline = lit ? Stroke{Role::lit, 2.8} : Stroke{Role::cell_line_1, 1.8};
    const auto used =
        static_cast<std::uint32_t>(std::min<std::size_t>(leaf.bodies.size(), leaf.room));
    for_each_piece(leaf.first, leaf.room, [&](std::uint32_t first, std::uint32_t count) {
      const Role ground = ground_of(leaf.mark);
      const Box<2> run = place(first, count);
      list_.crisp_rect(run, ground, outline);
      mark_passed(leaf.mark, run, list_);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t index = first + i - leaf.first;
        if (i > 0 && strip_.drawn()) {
          const double x = run.lo.x + i * strip_.slot;
          list_.crisp_line({x, run.lo.y}, {x, run.hi.y}, {outline.role, 1.2});
        }
        if (index < used) draw_slot(leaf.bodies[index], place(first + i), ground);
      }
      if (strip_.drawn()) draw_bracket(leaf, run, outline);
    });
  }

  void draw_slot(BodyId id, const Box<2>& box, Role ground) {
    const FrameBody* body = body_of(bodies_, id);
    const double inset = std::max(1.0, 0.13 * strip_.slot);
    if (list_.shapes.size() > kMostSlotShapes) return;
    if (!body) return list_.rect(shrunk(box, inset), Role::quiet_ink);
    if (!strip_.drawn()) return list_.rect(shrunk(box, inset), body_role(body->color));
    Box<2> chip = shrunk(box, inset);
    if (strip_.named()) {
      chip = Box<2>::around({box.center().x, box.lo.y + 0.5 * (box.size().y - 20)},
                            Vec<2>(std::min(30.0, 0.33 * strip_.slot)));
      TextStyle style = kQuiet;
      style.role = ground == Role::lit_fill ? Role::ink : Role::quiet_ink;
      const bool full = strip_.names == Strip::Names::full;
      try_write(full ? body->called() : brief_name(body->called()),
                {{{box.center().x, box.hi.y - 7}, 0.5}}, style);
    }
    draw_character(*body, chip, false, list_);
  }

  void draw_bracket(const FrameNode& leaf, const Box<2>& run, const Stroke& outline) {
    const double y = run.hi.y + 7, inset = std::min(3.0, strip_.slot / 6);
    const Vec<2> from{run.lo.x + inset, y}, to{run.hi.x - inset, y};
    const Stroke stroke{outline.role, 1.8};
    list_.crisp_line(from, to, stroke);
    for (const Vec<2>& end : {from, to}) list_.crisp_line(end - Vec<2>(0, 4), end, stroke);
    TextStyle style{kLeastLabel, Weight::semibold, Role::quiet_ink};
    if (leaf.mark == Mark::lit) style.role = Role::lit_ink;
    const std::string label = node_words(leaf.label), brief = short_label(leaf.label);
    // All that a leaf stores of its contents: where they begin, and how many they are.
    const std::string numbers = say("first {}, count {}", leaf.first, leaf.bodies.size());
    const std::string pair = fmt::format("{}: {}, {}", label, leaf.first, leaf.bodies.size());
    const bool begins = run.lo == place(leaf.first).lo;
    for (const std::string& text :
         {begins ? label + ": " + numbers : "", begins ? pair : "", label, brief}) {
      if (text.empty() || text_width(text, style) > run.size().x - 2) continue;
      if (try_write(text, {{{run.center().x, y + 19}, 0.5}}, style)) return;
    }
  }

  void draw_heading(bool leaves_left_out) {
    std::int64_t used = 0;
    for (const FrameNode& node : frame_.nodes)
      if (node.leaf && node.first != kNone && !node.of_static)
        used += static_cast<std::int64_t>(node.bodies.size());
    const auto slots = std::int64_t{frame_.get<FrameStructure>().array_size};
    std::string text =
        say("{}, {} in use", number_of(double(slots), "slot/slots"), number_text(double(used)));
    if (const auto calls = frame_.count("allocations"))
      text += ", " + number_of(double(*calls), "allocation/allocations");
    if (shown_ < frame_.get<FrameStructure>().array_size)
      text += " — " + say("the first {} are drawn", number_text(double(shown_)));
    else if (leaves_left_out)
      text += " — " + word("not all leaves are drawn");
    heading(text);
  }

  Strip strip_;
  Vec<2> origin_{0.0};
  std::uint32_t shown_ = 0;  // slots
  BodiesById bodies_;
};

double memory_strip(const Frame& frame, const Vec<2>& area) {
  constexpr double kMostRows = 3;
  double height = 230;  // for two rows of lists
  if (!is_in_pieces(frame)) {
    const NameWidths widest = name_widths(frame);
    Strip s;
    for (const double slot : {62.0, 54.0, 46.0, 40.0, 34.0, 28.0}) {
      s = strip_for(frame.get<FrameStructure>().array_size, slot, area.x - 6, widest);
      if (s.rows <= kMostRows - (s.named() ? 1 : 0)) break;
    }
    height = kMemoryHeading + 8 + std::min<double>(s.rows, kMostRows) * s.pitch;
  }
  return std::clamp(height, 0.2 * area.y, 0.46 * area.y);
}

}  // namespace

// The one array that all leaves share: a strip of slots that wraps into rows. A leaf's slots are
// bracketed and named; those in use show their bodies, those kept free are empty; slots of no leaf
// are quiet. Of an array too long for the panel as many slots are drawn as have room, and the
// heading says so. It wants this height at a width.
PanelEntry memory_panel() {
  return {{.name = "memory",
           .words = "as a strip below, the `memory` of the array that all leaves share, or of a "
                    "`lecture_quadtree` what it allocates piece by piece",
           .needs = "it needs a [structure]",
           .possible = language::has_structure},
          {.shows = {{"the leaves' array",
                      [](const Frame& f) { return f.get<FrameStructure>().array_size > 0; }}}},
          {.draw = draw_as<MemoryView>,
           .strip = memory_strip,
           .weight = 0.6,
           .inset = 3,
           .smallest = {60, kMemoryHeading + 12}}};
}

}  // namespace lantern::draw
