#include <algorithm>
#include <numeric>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/words.hpp"
#include "language/counts.hpp"
#include "run/stage.hpp"

namespace lantern::run {

// --- what is counted here ---

namespace {

constexpr CountDoc kAtlasCounts[] = {
    {"textures", when::with_atlas, "", "Textures packed."},
    {"refused", when::with_atlas, "refused", "Textures that fit nowhere."},
    {"used_area", when::with_atlas, "pixel used/pixels used", "Pixels under textures."},
    {"free_area", when::with_atlas, "pixel free/pixels free", "Pixels left free."},
    {"atlas_area", when::with_atlas, "pixel in all/pixels in all", "Pixels of the atlas."},
    {"free_leaves", when::with_atlas, "free leaf/free leaves", "Leaves without a texture."},
    {"leaf_tests", when::with_atlas, "leaf looked at/leaves looked at",
     "Leaves looked at, by packing and by questions for room."},
    {"room", when::room, "has room", "1 if the last `ask_room` found room, 0 if not."},
    {"bindings", when::drawn, "", "Times that the last `draw` had to bind another image, so far."},
    {"draws", when::drawn, "", "Elements that it has drawn."}};

}  // namespace

std::span<const CountDoc> atlas_counts() { return kAtlasCounts; }

AtlasStage::AtlasStage(const Scenario& scenario, Work& work)
    : spec_(*scenario.atlas), atlas_(scenario.atlas->width, scenario.atlas->height) {
  ++work.atlases_created;
  for (std::size_t i = 0; i < scenario.textures.size(); ++i) {
    const TextureSpec& t = scenario.textures[i];
    FrameTexture texture{.id = static_cast<std::uint32_t>(i),
                         .name = t.name,
                         .color = t.color,
                         .picture = t.picture,
                         .width = t.width,
                         .height = t.height,
                         .later = t.later};
    textures_.push_back(texture);
  }
}

void AtlasStage::hold(std::size_t index, bool turned) {
  FrameTexture& texture = textures_[index];
  if (texture.turned == turned) return;
  std::swap(texture.width, texture.height);
  texture.turned = turned;
}

bool AtlasStage::pack(std::size_t index, const Watch& watch) {
  FrameTexture& texture = textures_[index];
  const bool fits_turned = spec_.turn && !atlas_.has_room(texture.width, texture.height) &&
                           atlas_.has_room(texture.height, texture.width);
  hold(index, fits_turned);
  const auto rect = watch ? atlas_.insert(texture.id, texture.width, texture.height, watch)
                          : atlas_.insert(texture.id, texture.width, texture.height);
  texture.refused = !rect;
  return rect.has_value();
}

void AtlasStage::pack_all(const std::vector<std::size_t>& textures, const Watch& watch) {
  std::vector<TextureId> ids;
  std::vector<TextureSize> sizes;
  for (const std::size_t index : textures) {
    ids.push_back(textures_[index].id);
    sizes.push_back({textures_[index].width, textures_[index].height});
  }
  const auto told = [&](const AtlasEvent& event) {
    hold(event.texture, event.turned);
    if (event.kind == AtlasEvent::Kind::refuse) textures_[event.texture].refused = true;
    if (watch) watch(event);
  };
  atlas_.insert_all(ids, sizes, spec_.turn, static_cast<std::size_t>(spec_.trials), told);
}

std::vector<std::uint32_t> AtlasStage::free_leaves() const {
  std::vector<std::uint32_t> handles;
  atlas_.visit([&](const AtlasNodeView& node) {
    if (node.leaf && !node.texture) handles.push_back(node.handle);
    return true;
  });
  return handles;
}

void AtlasStage::name_free_leaf(const std::string& name, const std::vector<std::uint32_t>& before) {
  std::int64_t largest = 0;
  std::uint32_t handle = 0;
  atlas_.visit([&](const AtlasNodeView& node) {
    const std::int64_t area = std::int64_t{node.rect.width} * node.rect.height;
    const bool is_new = std::ranges::find(before, node.handle) == before.end();
    if (node.leaf && !node.texture && is_new && area > largest) {
      largest = area;
      handle = node.handle;
    }
    return true;
  });
  if (largest > 0) free_names_[handle] = name;
}

bool AtlasStage::ask_room(int width, int height) {
  room_ = atlas_.has_room(width, height);
  return *room_;
}

std::optional<std::uint32_t> AtlasStage::leaf_of(std::size_t texture) const {
  std::optional<std::uint32_t> leaf;
  atlas_.visit([&](const AtlasNodeView& node) {
    if (node.texture == textures_[texture].id) leaf = node.handle;
    return true;
  });
  return leaf;
}

std::string AtlasStage::label_of(std::uint32_t handle) const {
  std::string found;
  atlas_.visit([&](const AtlasNodeView& node) {
    if (node.handle != handle) return true;
    const auto name = free_names_.find(handle);
    if (node.texture)
      found = textures_[*node.texture].name;
    else if (name != free_names_.end())
      found = name->second;
    else
      found = say("of {} × {}", node.rect.width, node.rect.height);
    return true;
  });
  return found;
}

FrameNode AtlasStage::frame_node(const AtlasNodeView& view,
                                 std::vector<FrameTexture>& textures) const {
  FrameNode node;
  node.id = view.id;
  node.parent = view.parent;
  node.slot = view.slot;
  node.depth = view.depth;
  node.leaf = view.leaf;
  const Rect& r = view.rect;
  node.box = {{r.x, r.y, 0}, {double(r.x) + r.width, double(r.y) + r.height, 0}};
  node.cut_vertically = view.cut_vertically;
  if (view.texture) {
    FrameTexture& texture = textures[*view.texture];
    texture.packed = true;
    texture.x = r.x;
    texture.y = r.y;
    node.bodies = {*view.texture};
    node.label = texture.name;
  } else if (view.leaf) {
    const auto name = free_names_.find(view.handle);
    if (name != free_names_.end()) node.label = name->second;
  } else if (view.parent == kNone) {
    node.label = "root";
  }
  return node;
}

void AtlasStage::picture(const Touched& touched, Frame& frame) const {
  std::int64_t free_leaves = 0, leaves = 0, depth = 0, packed = 0, refused = 0;
  std::vector<FrameTexture>& textures = frame.add<FrameTextures>().textures;
  textures = textures_;
  atlas_.visit([&](const AtlasNodeView& view) {
    frame.nodes.push_back(frame_node(view, textures));
    frame.nodes.back().mark = touched.mark_of(view.handle);
    leaves += view.leaf;
    free_leaves += view.leaf && !view.texture;
    depth = std::max<std::int64_t>(depth, view.depth);
    return true;
  });
  for (const FrameTexture& t : textures) {
    packed += t.packed;
    refused += t.refused;
  }
  frame.counts.insert(frame.counts.end(),
                      {{"nodes", std::int64_t(frame.nodes.size())},
                       {"leaves", leaves},
                       {"depth", depth},
                       {"textures", packed},
                       {"refused", refused},
                       {"used_area", atlas_.used_area()},
                       {"free_area", atlas_.free_area()},
                       {"atlas_area", std::int64_t{atlas_.width()} * atlas_.height()},
                       {"free_leaves", free_leaves},
                       {"leaf_tests", static_cast<std::int64_t>(atlas_.leaf_tests())}});
  if (room_) frame.counts.emplace_back("room", *room_);
}

constexpr std::uint32_t kAtlasImage = kNone;  // beside the textures, which count from 0

ScreenStage::ScreenStage(const Scenario& scenario) {
  screen_.width = scenario.atlas->screen_width;
  screen_.height = scenario.atlas->screen_height;
  screen_.planned =
      static_cast<std::uint32_t>(std::ranges::count_if(scenario.steps, [](const Step& step) {
        return std::holds_alternative<DrawScreen>(step.verb);
      }));
  for (const ElementSpec& spec : scenario.elements) {
    const TextureSpec& texture = scenario.textures[spec.texture];
    const auto image = static_cast<std::uint32_t>(spec.texture);
    elements_.push_back({image, {spec.x, spec.y, texture.width, texture.height}});
    screen_.elements.push_back({image, spec.x, spec.y, texture.width, texture.height});
  }
}

std::vector<std::size_t> ScreenStage::begin(const DrawScreen& way) {
  binder_ = {};
  const bool by_texture = way.order == DrawScreen::Order::by_texture;
  screen_.ways.push_back({way.from == DrawScreen::From::atlas, by_texture, {}, 0});
  for (FrameElement& element : screen_.elements) element.drawn = false;
  if (by_texture) return sorted_by_image(elements_);
  std::vector<std::size_t> order(elements_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

void ScreenStage::light(std::size_t element) {
  for (FrameElement& e : screen_.elements) e.lit = false;
  screen_.elements[element].lit = true;
}

bool ScreenStage::bind(std::size_t element) {
  FrameWay& way = screen_.ways.back();
  const bool binds = binder_.bind(way.from_atlas ? kAtlasImage : elements_[element].image);
  screen_.bound = way.from_atlas ? kNone : *binder_.bound;
  screen_.atlas_bound = way.from_atlas;
  way.bindings = binder_.bindings;
  way.draws.push_back({static_cast<std::uint32_t>(element), binds, false});
  light(element);
  return binds;
}

void ScreenStage::draw(std::size_t element) {
  binder_.draw();
  screen_.ways.back().draws.back().done = true;
  screen_.elements[element].drawn = true;
}

void ScreenStage::end() {
  for (FrameElement& element : screen_.elements) element.lit = false;
  screen_.bound = kNone;
  screen_.atlas_bound = false;
}

void ScreenStage::picture(Frame& frame) const {
  frame.add<FrameScreen>() = screen_;
  if (screen_.ways.empty()) return;
  frame.add_count("bindings", binder_.bindings);
  frame.add_count("draws", binder_.draws);
}

}  // namespace lantern::run
