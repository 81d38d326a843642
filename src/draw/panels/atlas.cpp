#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "base/words.hpp"
#include "draw/body_shapes.hpp"
#include "draw/marks.hpp"
#include "draw/page.hpp"
#include "draw/panel.hpp"
#include "draw/texture_picture.hpp"
#include "language/panel_rules.hpp"

namespace lantern::draw {
namespace {

constexpr double kStrip = 190;  // width of the strip of textures beside the atlas
constexpr double kQueueGap = 26;
constexpr int kMostPanelShapes = 2200;  // of all packed textures together
constexpr int kMostTextures = 3000;
constexpr std::size_t kMostFree = 400;
constexpr double kAtlasHeading = 36;
constexpr double kTextureGap = 8;   // between textures in the strip
constexpr double kSingleName = 34;  // under a texture that is shown by itself
constexpr double kSingleGap = 26;
constexpr double kBeyond = 36;     // into the gap between panels
constexpr double kMostSingle = 3;  // page units a pixel

Vec<2> atlas_size(const Frame& frame) {
  return frame.nodes.empty() ? Vec<2>(1.0) : glm::max(flat(frame.nodes[0].box).size(), 1.0);
}

// A screen that is drawn from textures, of which none is packed yet: they are shown one by one.
bool shows_single(const Frame& frame) {
  return !frame.get<FrameScreen>().elements.empty() &&
         std::ranges::none_of(frame.get<FrameTextures>().textures,
                              [](const FrameTexture& t) { return t.packed || t.refused; });
}

bool waits(const FrameTexture& t) { return t.has_come() && !t.packed && !t.refused; }

// Beside a screen there is a strip only while something is in it.
bool has_strip(const Frame& frame) {
  if (frame.get<FrameTextures>().textures.empty() || shows_single(frame)) return false;
  return frame.get<FrameScreen>().elements.empty() ||
         !std::ranges::all_of(frame.get<FrameTextures>().textures, &FrameTexture::packed);
}

class AtlasView : PanelPicture {
 public:
  explicit AtlasView(const PanelPicture& on) : PanelPicture(on) {
    const Vec<2> size = atlas_size(frame_);
    const double strip = has_strip(frame_) ? kStrip + kQueueGap : 0;
    const Vec<2> room = shrunk(panel_, 3).size() - Vec<2>(strip, 0);
    scale_ = std::min(room.x / size.x, room.y / size.y);
    const Vec<2> used = size * scale_ + Vec<2>(strip, 0);
    const Vec<2> corner = panel_.lo + (panel_.size() - used) * 0.5;
    image_ = {corner, corner + size * scale_};
    strip_ = {{image_.hi.x + kQueueGap, panel_.lo.y}, {panel_.hi.x, panel_.hi.y}};
    strip_.hi.x = std::min(strip_.hi.x, strip_.lo.x + kStrip + 40);
  }

  void draw() {
    list_.referents.insert({"textures", "refused", "atlas_area"});
    if (shows_single(frame_)) return draw_single();
    list_.crisp_rect(image_, Role::panel);
    for (const FrameNode* node : free_leaves()) draw_free(*node);
    const std::vector<const FrameTexture*> packed = packed_textures();
    const auto count = std::max(1, static_cast<int>(packed.size()));
    parts_ = std::clamp(kMostPanelShapes / count - 2, 0, kMostPatternParts);
    for (const FrameTexture* texture : packed) draw_textured(*texture, place_of(*texture));
    list_.crisp_rect(image_, Role::none, {Role::cell_line_0, 3.4});
    if (frame_.get<FrameScreen>().atlas_bound) list_.crisp_rect(image_, Role::none, {Role::lit, 5});
    for (const FrameNode& node : frame_.nodes)
      if (node.mark == Mark::lit) {
        const DrawList::Scope scope = shown("atlas/lit", node);
        list_.crisp_rect(on_page(flat(node.box)), Role::none, {Role::lit, 4});
      }
    if (packed.size() == kMostTextures)
      labels_.add_note(word("not all textures are drawn"), image_);
    for (const FrameTexture* texture : packed) draw_plate(word(texture->name), place_of(*texture));
    draw_asked();
    for (const FrameNode* node : free_leaves()) name_free(*node);
    parts_ = kMostPatternParts;
    if (has_strip(frame_)) draw_strip();
  }

 private:
  Box<2> on_page(const Box<2>& pixels) const {
    return {image_.lo + pixels.lo * scale_, image_.lo + pixels.hi * scale_};
  }
  Box<2> place_of(const FrameTexture& t) const {
    return on_page({{t.x, t.y}, {double(t.x) + t.width, double(t.y) + t.height}});
  }

  // A cell, which comes out of the one that it was cut from.
  DrawList::Scope shown(std::string_view kind, const FrameNode& node) {
    return {list_, node_key(kind, frame_.nodes, node), parent_key(kind, frame_.nodes, node)};
  }

  std::vector<const FrameTexture*> packed_textures() const {
    std::vector<const FrameTexture*> packed;
    for (const FrameTexture& texture : frame_.get<FrameTextures>().textures)
      if (texture.packed && packed.size() < kMostTextures) packed.push_back(&texture);
    return packed;
  }

  // The largest, in order of area.
  std::vector<const FrameNode*> free_leaves() const {
    std::vector<const FrameNode*> leaves;
    for (const FrameNode& node : frame_.nodes)
      if (node.leaf && node.bodies.empty()) leaves.push_back(&node);
    std::ranges::stable_sort(leaves, std::greater(), [](const FrameNode* node) {
      return node->box.size().x * node->box.size().y;
    });
    if (leaves.size() > kMostFree) leaves.resize(kMostFree);
    return leaves;
  }

  void draw_free(const FrameNode& node) {
    const Box<2> box = on_page(flat(node.box));
    const double least = std::min(box.size().x, box.size().y);
    const DrawList::Scope scope = shown("atlas/cell", node);
    if (node.mark != Mark::quiet) list_.crisp_rect(box, ground_of(node.mark));
    if (least < 6) return;
    list_.rect(shrunk(box, 2), Role::none, {Role::cell_line_2, 1.4, 5});
    mark_passed(node.mark, box, list_);
  }

  void draw_textured(const FrameTexture& texture, const Box<2>& box) {
    const double scale = std::clamp(std::min(box.size().x, box.size().y) / 70, 0.6, 1.6);
    const DrawList::Scope scope(list_, texture_key("atlas/texture", texture));
    draw_texture(texture, box, scale, parts_, list_, texture.turned);
    if (parts_ > 0) list_.rect(box, Role::none, {Role::body_line, 1.6});
    if (is_bound(texture)) list_.rect(box, Role::none, {Role::lit, 4.5});
  }

  // The name on a plate of its own, so that it can be read on any pattern.
  bool draw_plate(const std::string& name, const Box<2>& box) {
    const TextStyle style{kLabel, Weight::semibold, Role::ink};
    const Box<2> plate = plate_of(name, box.center(), style, {6, 5});
    const Anchor anchor = centred(box.center(), style);
    if (name.empty() || !holds(shrunk(box, 1), plate)) return false;
    if (!labels_.is_free(Labels::extent(name, anchor, style), panel_)) return false;
    const DrawList::Scope scope(list_, "atlas/plate/" + name);
    list_.rect(plate, Role::panel, {}, 5);
    write(name, anchor, style);
    return true;
  }

  void name_free(const FrameNode& node) {
    const Box<2> box = on_page(flat(node.box));
    const DrawList::Scope scope = shown("atlas/name", node);
    TextStyle style{kLabel, Weight::regular, Role::quiet_ink};
    if (node.mark == Mark::lit) style.role = Role::lit_ink;
    const Vec<2> size = node.box.size();
    const std::string numbers = fmt::format("{:.0f} × {:.0f}", size.x, size.y);
    const Anchor anchor = centred(box.center(), style);
    for (const std::string& text :
         {node.label.empty() ? say("free {}", numbers) : node.label + "  " + numbers,
          node.label.empty() ? numbers : node.label}) {
      if (!holds(shrunk(box, 6), Labels::extent(text, anchor, style))) continue;
      if (try_write(text, {anchor}, style)) return;
    }
  }

  // What a room is asked for, laid over the free leaf that is looked at, or that comes nearest.
  void draw_asked() {
    const Vec<2> asked = frame_.get<FrameTextures>().asked;
    const FrameNode* best = nullptr;
    double most = 0;
    const std::vector<const FrameNode*> leaves = free_leaves();
    const bool one = std::ranges::count(leaves, Mark::lit, &FrameNode::mark) == 1;
    for (const FrameNode* node : leaves) {
      const Vec<2> share = flat(node->box).size() / glm::max(asked, 1.0);
      if (one && node->mark != Mark::lit) continue;
      if (const double least = std::min(share.x, share.y); least > most) most = least, best = node;
    }
    if (asked.x == 0 || !best) return;
    const Box<2> leaf = on_page(flat(best->box));
    const Vec<2> size = asked * scale_;
    const bool fits = most >= 1;
    // What does not fit sticks out of the leaf, beside the image if there is room.
    const bool beside = !fits && leaf.lo.x + size.x <= panel_.hi.x + kBeyond;
    const Box<2> limit = beside ? shrunk(panel_, -kBeyond) : image_;
    const double down = std::max(0.0, fits ? 0.0 : (leaf.size().y - size.y) / 2);
    const Vec<2> corner = glm::max(limit.lo, glm::min(leaf.lo + Vec<2>(0, down), limit.hi - size));
    if (!fits) list_.crisp_rect(leaf, Role::lit_fill, {Role::lit, 4});
    const Role role = fits ? Role::lit : Role::warning;
    const DrawList::Scope scope(list_, "atlas/asked");
    list_.rect({corner, corner + size}, Role::none, {Role::panel, 8});
    list_.rect({corner, corner + size}, Role::none, {role, 4, 9});
    const TextStyle style{kLabel, Weight::semibold, fits ? Role::lit_ink : Role::warning};
    const std::string words = fits ? fmt::format("{:.0f} × {:.0f}", asked.x, asked.y)
                                   : say("{:.0f} × {:.0f} does not fit", asked.x, asked.y);
    const double inside = image_.hi.x - corner.x;  // how much of it lies on the image
    const double middle = inside < size.x ? (inside + size.x) / 2 : size.x / 2;
    const Vec<2> at = corner + Vec<2>(middle, fits ? 24 : size.y / 2);
    const Box<2> plate = plate_of(words, at, style, {6, 5});
    if (!holds(limit, plate) || !labels_.is_free(plate, panel_)) return;
    list_.rect(plate, Role::panel, {}, 5);
    write(words, centred(at, style), style);
  }

  // An image of its own, while it is drawn from.
  bool is_bound(const FrameTexture& texture) const {
    return !texture.packed && texture.id == frame_.get<FrameScreen>().bound;
  }

  // --- one by one ---

  // In rows, each over its name, as large as all of them have room. Gives the height that they
  // take at this scale; draws them if they are to be.
  double single_rows(double scale, bool draws, double top) {
    const TextStyle name{kLabel, Weight::regular, Role::ink};
    Vec<2> at{panel_.lo.x + 6, top};
    double row = 0;
    for (const FrameTexture& t : frame_.get<FrameTextures>().textures) {
      const Vec<2> size = Vec<2>(t.width, t.height) * scale;
      const double width = std::max(size.x, text_width(word(t.name), name));
      if (at.x > panel_.lo.x + 6 && at.x + width > panel_.hi.x - 6)
        at = {panel_.lo.x + 6, at.y + row}, row = 0;
      row = std::max(row, size.y + kSingleName + kSingleGap);
      if (draws) {
        draw_textured(t, {at, at + size});
        const TextStyle style =
            is_bound(t) ? TextStyle{kLabel, Weight::semibold, Role::lit_ink} : name;
        try_write(word(t.name), {{{at.x, at.y + size.y + 25}, 0}}, style);
      }
      at.x += width + kSingleGap;
      if (at.x - kSingleGap > panel_.hi.x - 6) return 2 * panel_.size().y;  // too wide by itself
    }
    return at.y + row - kSingleGap - top;
  }

  void draw_single() {
    const TextStyle quiet{kLabel, Weight::semibold, Role::quiet_ink};
    const std::size_t n = frame_.get<FrameTextures>().textures.size();
    const double room = panel_.size().y - kAtlasHeading;
    double scale = kMostSingle;
    while (scale > 0.02 && single_rows(scale, false, 0) > room) scale *= 0.96;
    const double height = kAtlasHeading + single_rows(scale, false, 0);
    const double top = std::max(panel_.lo.y, panel_.center().y - height / 2);
    try_write(say("{}, each an image of its own", say_count(n, "texture/textures")),
              {{{panel_.lo.x + 6, top + 23}, 0}}, quiet);
    parts_ = n > 100 ? 0 : kMostPatternParts;
    single_rows(scale, true, top + kAtlasHeading);
  }

  // --- the strip ---

  void draw_strip() {
    std::vector<const FrameTexture*> waiting, refused;
    for (const FrameTexture& t : frame_.get<FrameTextures>().textures)
      if (t.refused || waits(t)) (t.refused ? refused : waiting).push_back(&t);
    choose_strip_scale();
    Box<2> upper = strip_;
    if (!refused.empty()) upper.hi.y -= 0.4 * strip_.size().y;
    if (!waiting.empty() || refused.empty()) draw_queue("waiting", waiting, upper, false);
    if (!refused.empty())
      draw_queue("refused", refused, {{upper.lo.x, upper.hi.y}, strip_.hi}, true);
  }

  // The atlas's own scale if all textures have room in the strip, else half of it or less. All of
  // them are asked, packed or not, so that the scale holds for the whole sequence.
  void choose_strip_scale() {
    const auto widest = greatest_of<double>(1, frame_.get<FrameTextures>().textures,
                                            [](const FrameTexture& t) { return double(t.width); });
    const Vec<2> room = strip_.size() - Vec<2>(0, kAtlasHeading);
    const auto has_room = [&](double scale) {
      double x = 0, y = 0, row = 0;
      for (const FrameTexture& t : frame_.get<FrameTextures>().textures) {
        const Vec<2> size = Vec<2>(t.width, t.height) * scale;
        if (x > 0 && x + size.x > room.x) x = 0, y += row, row = 0;
        x += size.x + kTextureGap;
        row = std::max(row, size.y + kTextureGap);
      }
      return widest * scale <= room.x && y + row <= room.y;
    };
    strip_scale_ = has_room(scale_) ? scale_ : std::min(scale_ / 2, room.x / widest);
  }

  // In rows, first come first; what has no room is counted.
  void draw_queue(std::string_view forms, const std::vector<const FrameTexture*>& queue,
                  const Box<2>& area, bool crossed) {
    const TextStyle style{kLabel, Weight::semibold, crossed ? Role::warning : Role::quiet_ink};
    const std::string heading = noun(forms, std::ssize(queue));
    const double number = Labels::width_of(frame_.get<FrameTextures>().textures.size(), style);
    labels_.add_number(static_cast<std::int64_t>(queue.size()),
                       {area.lo.x + number, area.lo.y + 23}, style, panel_);
    write(heading, {{area.lo.x + number + 7, area.lo.y + 23}, 0}, style);
    const double end = area.lo.x + number + 7 + text_width(heading, style);
    const TextStyle note{kLabel, Weight::regular, Role::quiet_ink};
    const double name_line = crossed ? 30 : 0;
    if (strip_scale_ < scale_ && !queue.empty())
      try_write(word(strip_scale_ < scale_ / 2 ? "(drawn smaller)" : "(half size)"),
                {{{end + 10, area.lo.y + 23}, 0}}, note);
    Vec<2> at{area.lo.x, area.lo.y + kAtlasHeading};
    double row = 0;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const Vec<2> size = Vec<2>(queue[i]->width, queue[i]->height) * strip_scale_;
      const double name = crossed ? text_width(word(queue[i]->name), note) : 0;
      if (at.x > area.lo.x && at.x + std::max(size.x, name) > area.hi.x)
        at = {area.lo.x, at.y + row}, row = 0;
      const double last = area.hi.y - (i + 1 < queue.size() ? 32 : 4);
      if (at.y + size.y + name_line > last) {
        try_write(say("and {} more", queue.size() - i),
                  {{{area.lo.x, at.y + row + 23}, 0}, {{area.lo.x, area.hi.y - 6}, 0}}, note);
        return;
      }
      const Box<2> box{at, at + size};
      draw_textured(*queue[i], box);
      if (crossed)
        cross_out(*queue[i], box);
      else
        draw_plate(word(queue[i]->name), box);
      row = std::max(row, size.y + kTextureGap + name_line);
      at.x += std::max(size.x, name) + kTextureGap;
    }
  }

  void cross_out(const FrameTexture& texture, const Box<2>& box) {
    for (const double width : {7.0, 3.6}) {
      const Role role = width > 5 ? Role::panel : Role::warning;
      list_.line(box.lo, box.hi, {role, width});
      list_.line({box.lo.x, box.hi.y}, {box.hi.x, box.lo.y}, {role, width});
    }
    const TextStyle style{kLabel, Weight::regular, Role::warning};
    const std::string name = shortened(word(texture.name), panel_.hi.x - box.lo.x, style);
    try_write(name, {{{box.lo.x, box.hi.y + 23}, 0}}, style);
  }

  Box<2> image_, strip_;
  double scale_ = 1;               // page units a pixel
  double strip_scale_ = 1;         // the same, in the strip
  int parts_ = kMostPatternParts;  // of a pattern; fewer when there are many textures
};

double atlas_width(const Frame& frame, double height) {
  const Vec<2> size = atlas_size(frame);
  return height * size.x / size.y + (has_strip(frame) ? kStrip + kQueueGap : 0);
}

}  // namespace

DrawList draw_atlas_image(const Frame& frame) {
  DrawList list;
  list.page = atlas_size(frame);
  for (const FrameTexture& t : frame.get<FrameTextures>().textures)
    if (t.packed)
      draw_texture(t, {{t.x, t.y}, {double(t.x) + t.width, double(t.y) + t.height}}, 1,
                   kMostPatternParts, list, t.turned);
  return list;
}

// The packed image, and beside it the textures that wait or were refused; of an atlas with a screen
// those are shown one by one until the first is packed. It wants this width at a height.
PanelEntry atlas_panel() {
  return {
      {.name = "atlas",
       .words = "the `atlas`",
       .needs = "it needs an [atlas]",
       .possible = language::has_atlas,
       .place = 3,
       .by_itself = language::has_atlas,
       .example = [] { return language::example_with("atlas", "pack"); }},
      {.shows = {{"textures", [](const Frame& f) { return f.count("textures").value_or(0) > 0; }}}},
      {.draw = draw_as<AtlasView>, .width = atlas_width}};
}

}  // namespace lantern::draw
