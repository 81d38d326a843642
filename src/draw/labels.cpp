#include "draw/labels.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "base/stop.hpp"
#include "base/words.hpp"
#include "draw/font.hpp"
#include "draw/pen.hpp"
#include "draw/world/world2d_parts.hpp"

namespace lantern::draw {
namespace {

// Reach of Inter's letters and brackets above and below the baseline, as parts of the em.
constexpr double kAscent = 0.77;
constexpr double kDescent = 0.22;
constexpr double kGap = 2;  // between two labels

bool cover(const Box<2>& a, const Box<2>& b, double gap) {
  return a.lo.x < b.hi.x + gap && b.lo.x < a.hi.x + gap && a.lo.y < b.hi.y + gap &&
         b.lo.y < a.hi.y + gap;
}

// How many bytes of `text`, in whole characters, are no wider than `width`. Widths grow with the
// text, so the place is found by halving.
std::size_t prefix(std::string_view text, double width, const TextStyle& style) {
  std::vector<std::size_t> ends;  // of characters
  for (std::size_t i = 1; i <= text.size(); ++i)
    if (i == text.size() || (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) ends.push_back(i);
  const auto too_long = std::ranges::partition_point(
      ends, [&](std::size_t end) { return text_width(text.substr(0, end), style) <= width; });
  return too_long == ends.begin() ? 0 : *std::prev(too_long);
}

constexpr std::ptrdiff_t kFewBodies = 8;  // with names
constexpr double kNameSpare = 1;          // that a name's side has to the room's rim and to bodies
constexpr std::uint32_t kFewLeaves = 9;
constexpr std::size_t kMostLookedAt = 120;  // frames of a group, here and there

// As a word of its own.
bool names(const std::string& text, const std::string& name) {
  const auto is_part = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0);
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if ((at == 0 || !is_part(at - 1)) && !is_part(at + name.size())) return true;
  return false;
}

// By body: on how many frames, once more where no link of a pair runs through the name.
using Free = std::map<std::string, std::array<int, 8>, std::less<>>;

std::vector<std::pair<Vec<2>, Vec<2>>> straight_links(const Frame& frame, const View2D& map) {
  constexpr std::size_t kMostAvoided = 12;
  std::vector<std::pair<Vec<2>, Vec<2>>> links;
  if (!frame.display.pairs || frame.pairs.size() > kMostAvoided) return links;
  for (const FramePair& pair : frame.pairs) {
    const FrameBody *a = frame.body_of(pair.pair.a), *b = frame.body_of(pair.pair.b);
    if (a && b) links.emplace_back(map.to_page(a->box.center()), map.to_page(b->box.center()));
  }
  return links;
}

void count_free(const Frame& frame, const Box<2>& panel, Free& free) {
  const View2D map(flat(frame.bounds), panel);
  const std::vector<Stand> stands = stands_of(frame, map);
  const Box<2> room = shrunk(map.picture(), 5);
  const std::vector<Box<2>> covered = mapped(stands, &Stand::box);
  const auto links = straight_links(frame, map);
  for (const Stand& stand : stands) {
    const FrameBody& body = *stand.bodies.front();
    if (stand.bodies.size() > 1 || !shows_name(frame, body)) continue;
    const auto anchors = anchors_around(stand.box, kNameGap + kNameSpare, {});
    std::array<int, 8>& counts = free[body.called()];
    for (std::size_t k = 0; k < anchors.size(); ++k) {
      const Box<2> extent = Labels::extent(body.called(), anchors[k], {});
      if (!holds(room, extent) || touches(covered, extent)) continue;
      counts[k] +=
          std::ranges::any_of(links,
                              [&](const auto& link) {
                                return cut_line(link.first, link.second, extent).has_value();
                              })
              ? 1
              : 2;
    }
  }
}

}  // namespace

double text_width(std::string_view text, const TextStyle& style) {
  return text_width(text, style.size, style.weight);
}

Anchor centred(const Vec<2>& at, const TextStyle& style, double align) {
  return {{at.x, at.y + cap_height(style.weight) * style.size / 2}, align};
}

Box<2> plate_of(std::string_view text, const Vec<2>& at, const TextStyle& style,
                const Vec<2>& margin) {
  const double cap = cap_height(style.weight) * style.size;
  return Box<2>::around(at, Vec<2>(text_width(text, style), cap) / 2.0 + margin);
}

std::array<Anchor, 8> anchors_around(const Box<2>& box, double gap, const TextStyle& style) {
  const Vec<2> c = box.center();
  const double below = box.hi.y + gap + 0.78 * style.size, above = box.lo.y - gap - 4;
  const double left = box.lo.x - gap - 3, right = box.hi.x + gap + 3;
  return {Anchor{{c.x, below}, 0.5}, {{c.x, above}, 0.5},   {{box.lo.x, below}, 0},
          {{box.hi.x, below}, 1},    {{right, c.y + 6}, 0}, {{left, c.y + 6}, 1},
          {{box.lo.x, above}, 0},    {{box.hi.x, above}, 1}};
}

Box<2> Labels::extent(std::string_view text, const Anchor& anchor, const TextStyle& style) {
  const double width = text_width(text, style);
  const double left = anchor.at.x - anchor.align * width;
  return {{left, anchor.at.y - kAscent * style.size},
          {left + width, anchor.at.y + kDescent * style.size}};
}

bool Labels::is_free(const Box<2>& box, const Box<2>& panel) const {
  stop_if_asked();
  if (!holds(panel, box)) return false;
  for (const LabelBox& other : list_.labels)
    if (cover(box, other.box, kGap)) return false;
  for (const Box<2>& place : blocked_)
    if (cover(box, place, 0)) return false;
  return true;
}

void Labels::tell_place(std::string name, const Box<2>& box) {
  if (has_notes_) places_.emplace_back(std::move(name), box);
}

const Box<2>* Labels::place_of(std::string_view name) const {
  const auto found = std::ranges::find(places_, name, &std::pair<std::string, Box<2>>::first);
  return found == places_.end() ? nullptr : &found->second;
}

void Labels::add(std::string_view text, const Anchor& anchor, const TextStyle& style,
                 const Box<2>& panel) {
  if (text.empty()) return;
  list_.labels.push_back({extent(text, anchor, style), panel, std::string(text)});
  list_.shapes.emplace_back(TextShape{std::string(text), anchor.at, style.size, style.weight,
                                      anchor.align, style.role, style.halo});
}

bool Labels::try_add(std::string_view text, std::initializer_list<Anchor> list,
                     const TextStyle& style, const Box<2>& panel) {
  const std::span<const Anchor> anchors(list.begin(), list.size());
  return try_add(text, anchors, style, panel, panel, [](const Box<2>&) { return true; });
}

// From a number's last digit back to the front of its `place`-th, counted from 1. The thousands of
// numbers with more than four digits stand a little apart.
double Labels::width_to(std::int64_t place, std::int64_t digits, const TextStyle& style) {
  constexpr double kGap = 0.3;  // of a digit
  const auto gaps = static_cast<double>(digits > 4 ? (place - 1) / 3 : 0);
  return (static_cast<double>(place) + kGap * gaps) * text_width("0", style);
}

void Labels::add_number(std::int64_t number, const Vec<2>& right, const TextStyle& style,
                        const Box<2>& panel) {
  const std::string digits = fmt::format("{}", number);
  const auto count = static_cast<std::int64_t>(digits.size());
  const double half_cell = text_width("0", style) / 2;
  Box<2> box = extent("0", {right, 1}, style);
  box.lo.x = right.x - number_width(count, style);
  list_.labels.push_back({box, panel, digits});
  // One thing, or an in-between would keep the digits that two numbers share.
  const DrawList::Scope scope(list_, fmt::format("{}/number/{}/{:.0f},{:.0f}", list_.shown().key,
                                                 digits, right.x, right.y));
  for (std::int64_t place = 0; place < count; ++place) {  // from the last digit on
    const Vec<2> at{right.x - width_to(place + 1, count, style) + half_cell, right.y};
    const auto i = static_cast<std::size_t>(count - 1 - place);
    list_.shapes.emplace_back(TextShape{std::string(1, digits[i]), at, style.size, style.weight,
                                        0.5, style.role, style.halo});
  }
}

void Labels::add_note(std::string_view note, const Box<2>& picture) {
  const TextStyle style{kLabel, Weight::regular, Role::ink};
  const std::vector<std::string> lines = two_lines(note, picture.size().x - 40, style);
  if (lines.empty()) return;
  const Anchor last{{picture.lo.x + 20, picture.hi.y - 20}, 0};
  const Anchor first{last.at - Vec<2>(0, lines.size() > 1 ? 1.25 * kLabel : 0), 0};
  const Box<2> words =
      united(extent(lines.front(), first, style), extent(lines.back(), last, style));
  list_.rect(shrunk(words, -7), Role::panel, {Role::cell_line_1, 1.4}, 6);
  add(lines.front(), first, style, picture);
  if (lines.size() > 1) add(lines.back(), last, style, picture);
}

std::string shortened(std::string_view text, double width, const TextStyle& style) {
  if (text_width(text, style) <= width) return std::string(text);
  std::size_t end = prefix(text, width - text_width("…", style), style);
  while (end > 0 && text[end - 1] == ' ') --end;
  return end == 0 ? std::string() : std::string(text.substr(0, end)) + "…";
}

namespace {

// A text of Chinese or Japanese may break between any two letters but before what closes and behind
// what opens (JIS X 4051): the last such place up to `end`, behind the last space; 0 if there is
// none.
std::size_t break_between(std::string_view text, std::size_t end) {
  constexpr std::u32string_view kNotFirst =
      U"、。，．・：；？！）］｝」』】〉》ー々ぁぃぅぇぉっゃゅょァィゥェォッャュョ";
  constexpr std::u32string_view kNotLast = U"（［｛「『【〈《";
  std::size_t found = 0;
  char32_t before = 0;
  for (std::size_t at = 0; at <= end && at < text.size();) {
    const auto [bytes, code] = first_letter(text.substr(at));
    const char32_t letter = code.value_or(0);
    const bool is_wide = letter >= 0x2e80, was_wide = before >= 0x2e80;
    if (letter == ' ') found = 0;
    if (at > 0 && (is_wide || was_wide) && kNotFirst.find(letter) == kNotFirst.npos &&
        kNotLast.find(before) == kNotLast.npos && letter != ' ' && before != ' ')
      found = at;
    before = letter;
    at += bytes;
  }
  return found;
}

}  // namespace

std::vector<std::string> wrapped(std::string_view text, double width, const TextStyle& style) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    std::size_t end = prefix(text, width, style);
    if (end == 0) end = text.size();  // not one letter fits: there is nothing to break
    std::size_t next = end;
    if (end < text.size()) {
      const std::size_t space = text.rfind(' ', end);
      if (const std::size_t between = break_between(text, end); between > 0)
        end = next = between;
      else if (space != std::string_view::npos && space > 0)
        end = next = space;
    }
    lines.emplace_back(text.substr(0, end));
    while (next < text.size() && text[next] == ' ') ++next;
    text.remove_prefix(next);
  }
  return lines;
}

std::vector<std::string> two_lines(std::string_view text, double width, const TextStyle& style) {
  std::vector<std::string> lines = wrapped(text, width, style);
  if (lines.size() <= 2) return lines;
  const std::size_t rest = text.find(lines[1], lines[0].size());
  return {lines[0], shortened(text.substr(rest), width, style)};
}

bool shows_name(const Frame& frame, const FrameBody& body) {
  if (body.name.empty() || frame.display.names == ShownNames::none) return false;
  if (body.lit || frame.display.names == ShownNames::all) return true;
  const auto named = std::ranges::count_if(
      frame.bodies, [](const FrameBody& other) { return !other.name.empty(); });
  return named <= kFewBodies || names(frame.caption, body.called());
}

std::string side_word(const FrameNode& parent, std::uint32_t slot) {
  const Vec<3> normal = parent.plane ? parent.plane->normal : Vec<3>(0);
  const auto is_along = [&](int axis) {
    return normal[axis] != 0 && normal[(axis + 1) % 3] == 0 && normal[(axis + 2) % 3] == 0;
  };
  for (const int axis : {0, 1})
    if (is_along(axis)) {
      const bool less = (slot == 0) == (normal[axis] > 0);
      return word(axis == 0 ? (less ? "left" : "right") : less ? "below" : "above");
    }
  return word(slot == 0 ? "back" : "front");
}

std::vector<std::string> leaf_names(const Frame& frame, const FrameNode& leaf) {
  if (traits_of(frame.structure).names != NodeNames::sides || leaf.parent == kNone)
    return {node_words(leaf.label)};
  if (is_level(frame) && std::isdigit(static_cast<unsigned char>(leaf.label[0])) != 0)
    return leaf.mark == Mark::lit ? std::vector{say("sector {}", leaf.label), leaf.label}
                                  : std::vector{leaf.label};
  const FrameNode& parent = frame.nodes[leaf.parent];
  const std::string side = side_word(parent, leaf.slot);
  if (parent.parent == kNone) return {side};
  if (leaf.mark != Mark::lit && !leaf.over_capacity) return {};
  if (parent.plane_name.empty()) return {side};
  return {word(parent.plane_name) + ": " + side, side};
}

bool shows_id(const Staging& staging, const FrameNode& node) {
  return node.mark != Mark::quiet || staging.most_leaves() <= kFewLeaves;
}

const NameSides& name_sides(const Staging& staging, const Box<2>& panel) {
  return staging.once<NameSides>("sides of names", panel, [&] {
    Free free;
    for (const Frame* frame : staging.some_frames(kMostLookedAt))
      if (frame->bodies.size() <= kCrowd) count_free(*frame, panel, free);
    NameSides sides;
    for (const auto& [name, counts] : free)
      sides[name] = static_cast<std::size_t>(std::ranges::max_element(counts) - counts.begin());
    return sides;
  });
}

std::array<Anchor, 8> on_its_side(std::array<Anchor, 8> anchors, const NameSides& sides,
                                  std::string_view name) {
  const auto found = sides.find(name);
  if (found != sides.end())
    std::rotate(anchors.begin(), anchors.begin() + static_cast<std::ptrdiff_t>(found->second),
                anchors.begin() + static_cast<std::ptrdiff_t>(found->second) + 1);
  return anchors;
}

}  // namespace lantern::draw
