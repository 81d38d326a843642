// A screen that is drawn from textures, and below it a row for each way in which it was drawn: its
// draws in order, and an upright mark before each that another image had to be bound for.
//
//    ____________________
//   | [~~]          [##] |
//   |____[]__[]__[]______|
//   as listed             | 6 bindings
//   |[] |[][] |[] |[]  ...
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/panel.hpp"
#include "draw/texture_picture.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kWayHead = 36;   // height of a row's words
constexpr double kWayRow = 84;    // of all of it
constexpr double kWaysGap = 18;   // under the screen
constexpr double kBindWidth = 6;  // of the mark
constexpr double kMostSwatch = 44;
constexpr double kLeastSwatch = 3;

const TextStyle kWayNumber{34, Weight::semibold, Role::ink};

std::string name_of(const FrameWay& way) {
  if (way.from_atlas) return word(way.by_texture ? "from the atlas, by texture" : "from the atlas");
  return word(way.by_texture ? "sorted by texture" : "as listed");
}

double ways_height(const FrameScreen& screen) { return kWaysGap + screen.planned * kWayRow; }

class ScreenView : PanelPicture {
 public:
  explicit ScreenView(const PanelPicture& on) : PanelPicture(on) {
    const Vec<2> size(std::max(screen_.width, 1), std::max(screen_.height, 1));
    const Vec<2> room = shrunk(panel_, 3).size();
    const double below = std::min(ways_height(screen_), 0.55 * room.y);
    scale_ = std::min(room.x / size.x, (room.y - below) / size.y);
    const double height = size.y * scale_ + below;
    const Vec<2> corner{panel_.center().x - size.x * scale_ / 2, panel_.center().y - height / 2};
    image_ = {corner, corner + size * scale_};
    // As wide as the screen, but for one that is very tall.
    const double wide = std::max(image_.size().x, 0.8 * room.x) / 2;
    ways_ = {{panel_.center().x - wide, image_.hi.y + std::min(kWaysGap, below)},
             {panel_.center().x + wide, image_.hi.y + below}};
  }

  void draw() {
    if (screen_.elements.empty()) return;
    list_.referents.insert({"bindings", "draws"});
    list_.crisp_rect(image_, Role::panel);
    for (std::size_t i = 0; i < screen_.elements.size(); ++i)
      if (!screen_.elements[i].drawn) outline(i);
    for (const std::size_t i : drawn_in_order()) paint(i);
    list_.crisp_rect(image_, Role::none, {Role::cell_line_0, 3.4});
    for (const FrameElement& element : screen_.elements)
      if (element.lit) {
        const DrawList::Scope scope(list_, "screen/lit");
        list_.rect(place_of(element), Role::none, {Role::panel, 9});
        list_.rect(place_of(element), Role::none, {Role::lit, 4.5});
      }
    const double row = ways_.size().y / std::max(screen_.planned, 1u);
    if (row < kWayHead + kLeastSwatch) return;
    for (std::size_t i = 0; i < screen_.ways.size(); ++i) draw_way(i, row);
  }

 private:
  Box<2> place_of(const FrameElement& e) const {
    const Vec<2> corner = image_.lo + Vec<2>(e.x, e.y) * scale_;
    return {corner, corner + Vec<2>(e.width, e.height) * scale_};
  }

  // As the way under way has come to them; from the back to the front if none is.
  std::vector<std::size_t> drawn_in_order() const {
    std::vector<std::size_t> order;
    if (screen_.ways.empty())
      for (std::size_t i = 0; i < screen_.elements.size(); ++i) order.push_back(i);
    else
      for (const FrameDraw& d : screen_.ways.back().draws)
        if (d.done) order.push_back(d.element);
    return order;
  }

  void outline(std::size_t i) {
    const DrawList::Scope scope(list_, fmt::format("screen/outline/{}", i));
    list_.rect(shrunk(place_of(screen_.elements[i]), 1), Role::none, {Role::cell_line_2, 1.6, 5});
  }

  void paint(std::size_t i) {
    const FrameElement& element = screen_.elements[i];
    const DrawList::Scope scope(list_, fmt::format("screen/element/{}", i));
    swatch(element.texture, place_of(element));
  }

  void swatch(std::uint32_t texture, const Box<2>& box) {
    const double scale = std::clamp(std::min(box.size().x, box.size().y) / 70, 0.35, 1.6);
    const FrameTexture& of = frame_.get<FrameTextures>().textures[texture];
    // In the atlas it may lie turned: on the screen it never does.
    draw_texture(of, box, scale, kMostPatternParts, list_, false);
    list_.rect(box, Role::none, {Role::body_line, 1.4});
  }

  // The name, a mark as its key, and the number of marks; then the draws.
  void draw_way(std::size_t index, double row) {
    const FrameWay& way = screen_.ways[index];
    const double top = ways_.lo.y + row * double(index);
    const double baseline = top + 27;
    const std::string counted = noun("binding/bindings", static_cast<std::int64_t>(way.bindings));
    const double words = text_width(noun("binding/bindings", kMany), kPlain);
    const double number = Labels::width_of(screen_.elements.size(), kWayNumber);
    const double right = ways_.hi.x - words - 8;
    const double key = right - number - kBindWidth - 12;
    if (key < ways_.lo.x) return;
    const std::string name = shortened(name_of(way), key - 12 - ways_.lo.x, kPlain);
    if (!name.empty()) write(name, {{ways_.lo.x, baseline}, 0});
    write(counted, {{ways_.hi.x - words, baseline}, 0});
    labels_.add_number(static_cast<std::int64_t>(way.bindings), {right, baseline}, kWayNumber,
                       panel_);
    list_.rect({{key, top + 2}, {key + kBindWidth, top + 30}}, Role::ink);
    draw_draws(index, {{ways_.lo.x, top + kWayHead}, {ways_.hi.x, top + row - 8}});
  }

  void draw_draws(std::size_t index, const Box<2>& area) {
    const FrameWay& way = screen_.ways[index];
    const double pitch = area.size().x / double(std::max<std::size_t>(screen_.elements.size(), 1));
    const double side = std::min({pitch - kBindWidth - 7, area.size().y - 6, kMostSwatch});
    if (side < kLeastSwatch) return;
    for (std::size_t k = 0; k < way.draws.size(); ++k) {
      const FrameDraw& d = way.draws[k];
      const Vec<2> corner = area.lo + Vec<2>(pitch * double(k), 0);
      if (d.binds) {
        const DrawList::Scope scope(list_, fmt::format("screen/bind/{}.{}", index, k));
        list_.rect({corner, corner + Vec<2>(kBindWidth, area.size().y)},
                   d.done ? Role::ink : Role::lit);
      }
      if (!d.done) continue;
      const DrawList::Scope scope(list_, fmt::format("screen/draw/{}.{}", index, k),
                                  fmt::format("screen/element/{}", d.element));
      const Vec<2> at = corner + Vec<2>(kBindWidth + 3, (area.size().y - side) / 2);
      swatch(screen_.elements[d.element].texture, {at, at + Vec<2>(side)});
    }
  }

  const FrameScreen& screen_ = frame_.get<FrameScreen>();
  Box<2> image_, ways_;
  double scale_ = 1;  // page units a pixel
};

double screen_width(const Frame& frame, double height) {
  const FrameScreen& screen = frame.get<FrameScreen>();
  const double room = std::max(height - ways_height(screen), 0.45 * height);
  return room * std::max(screen.width, 1) / std::max(screen.height, 1);
}

}  // namespace

PanelEntry screen_panel() {
  return {
      {.name = "screen",
       .words = "the `screen`, what is drawn from textures, and below it a mark for each binding",
       .needs = "it needs [[element]]s and a step that draws them",
       .possible = language::some_step<language::DrawScreen>,
       .place = 2,
       .by_itself = language::some_step<language::DrawScreen>,
       .example = [] { return language::example_with("atlas", "draw"); }},
      {.shows = {{"a drawn screen", lists<FrameScreen, &FrameScreen::ways>}}},
      {.draw = draw_as<ScreenView>, .width = screen_width}};
}

}  // namespace lantern::draw
