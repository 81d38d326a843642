// Packs textures into one large image with a kD-tree whose leaves fit them exactly.
//
// A texture goes to the first free leaf, in order of descent, that it fits. A leaf that is larger
// is cut in two along the axis with more room to spare, so that the first half fits the texture on
// that axis, and the texture goes on into the first half, until the leaf has exactly its size:
//
//   +-----+---------+      cut 1 (vertical): left half as wide as A, right half free
//   |  A  |         |      cut 2 (horizontal, left half): A, and a free leaf below it
//   +-----+         |
//   |     |         |      With equal room on both axes the cut is horizontal. Where nothing is
//   +-----+---------+      to spare, nothing is cut: no leaf is ever empty.
//
// Each node knows the greatest width and the greatest height among the free leaves below it, so
// that whole branches without room are passed by. The leaf found is the same.
//
// So the lecture has it. Where all textures are known before, `insert_all` has the leaves choose
// among them instead (packer.hpp): the tree is one of the same cuts, fuller, and sooner there.
//
// The lightmap packer of Jim Scott, "Packing Lightmaps" (2001), is the same idea.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "atlas/packer.hpp"
#include "base/stop.hpp"

namespace lantern::atlas {

using TextureId = std::uint32_t;

struct AtlasNodeView {
  std::uint32_t handle = 0;           // stable as long as the atlas lives
  std::uint32_t id = 0;               // position in the order of visiting, from 0
  std::uint32_t parent = 0xffffffff;  // id of the parent; none for the root
  std::uint32_t slot = 0;             // 0: the half that was cut to fit, 1: what remained
  std::uint32_t depth = 0;
  Rect rect;
  bool leaf = true;
  bool cut_vertically = false;       // an inner node's halves stand side by side
  std::optional<TextureId> texture;  // a used leaf's; a free leaf has none
};

struct AtlasEvent {
  enum class Kind {
    too_small,  // a free leaf that the texture does not fit
    used,       // a leaf that is taken already
    cut,        // the leaf is about to be cut in two
    store,      // the leaf has exactly the texture's size and now holds it
    refuse,     // no leaf has room
  };
  Kind kind{};
  std::uint32_t node = 0;  // handle; of `refuse` the root's
  TextureId texture = 0;   // of insert_all's cuts, the one that is stored next
  bool turned = false;     // width and height are exchanged; by insert_all
};

// The default observer: its calls compile to nothing.
struct NoAtlasObserver {
  void operator()(const AtlasEvent&) const {}
};

class Atlas {
 public:
  // Width and height in pixels, 1 to 65536 each; throws Refused otherwise.
  Atlas(int width, int height);

  // Where the texture lies now; nothing if it fits nowhere, and the atlas stays as it was. Throws
  // Refused for a width or height below 1. Tells the observer of every leaf before the one found,
  // in order of descent, also of those in branches that are passed by; it may call `visit`.
  template <class Observer = NoAtlasObserver>
  std::optional<Rect> insert(TextureId id, int width, int height, Observer&& observer = {}) {
    require_size(id, width, height);
    const auto passed = [&](std::uint32_t node) { tell_leaves(node, id, observer); };
    std::uint32_t leaf = first_fit(width, height, passed);
    if (leaf == kNoNode) {
      observer(AtlasEvent{AtlasEvent::Kind::refuse, 0, id});
      return std::nullopt;
    }
    while (nodes_[leaf].rect.width != width || nodes_[leaf].rect.height != height) {
      observer(AtlasEvent{AtlasEvent::Kind::cut, leaf, id});
      const Rect& rect = nodes_[leaf].rect;
      const bool vertically = rect.width - width > rect.height - height;
      leaf = cut_at(leaf, vertically, vertically ? width : height);
    }
    take(leaf, id);
    observer(AtlasEvent{AtlasEvent::Kind::store, leaf, id});
    return nodes_[leaf].rect;
  }

  // All of these textures, or as many pixels of them as can be, where the free leaves choose among
  // them: by the first `trials` of the packer's trials. Gives where each lies, nothing for one that
  // is refused. Tells the observer of cuts, of what is stored and, at last, of what is refused, as
  // `insert` does.
  // Throws Refused for bad sizes, the atlas staying as it was; after Stopped it may be half packed.
  template <class Observer = NoAtlasObserver>
  std::vector<std::optional<TexturePlace>> insert_all(std::span<const TextureId> ids,
                                                      std::span<const TextureSize> sizes,
                                                      bool turn = false,
                                                      std::size_t trials = SIZE_MAX,
                                                      Observer&& observer = {}) {
    using Kind = PackStep::Kind;
    std::vector<std::uint32_t> open = free_leaves();  // the next one last
    std::vector<Rect> rects;
    for (const std::uint32_t leaf : open) rects.push_back(nodes_[leaf].rect);
    const Packing packing = Packer(sizes, turn).pack_most(rects, trials);
    leaf_tests_ += packing.leaf_tests;
    std::reverse(open.begin(), open.end());
    std::vector<std::optional<TexturePlace>> places(sizes.size());
    auto stored = packing.steps.begin();  // next
    for (auto step = packing.steps.begin(); step != packing.steps.end(); ++step) {
      stop_if_asked();
      const std::uint32_t leaf = open.back();
      open.pop_back();
      for (stored = std::max(stored, step); stored != packing.steps.end(); ++stored)
        if (stored->kind == Kind::store) break;
      if (step->kind == Kind::store) {
        take(leaf, ids[step->value]);
        places[step->value] = TexturePlace{nodes_[leaf].rect, step->turned};
        observer(AtlasEvent{AtlasEvent::Kind::store, leaf, ids[step->value], step->turned});
      } else if (step->kind == Kind::leave) {
        gather_free(nodes_[leaf].parent);
      } else {
        observer(AtlasEvent{AtlasEvent::Kind::cut, leaf, ids[stored->value], stored->turned});
        const std::uint32_t half =
            cut_at(leaf, step->kind == Kind::cut_beside, static_cast<int>(step->value));
        open.push_back(half + 1);
        open.push_back(half);
      }
    }
    // A trial holds all of them in one way: what it left may have room if held in the other.
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (places[i]) continue;
      const auto [width, height] = sizes[i];
      const bool turned = turn && !has_room(width, height) && has_room(height, width);
      const auto rect = turned ? insert(ids[i], height, width, observer)
                               : insert(ids[i], width, height, observer);
      if (rect) places[i] = TexturePlace{*rect, turned};
    }
    return places;
  }

  // Is there a free leaf of at least this size?
  bool has_room(int width, int height) const {
    return first_fit(width, height, [](std::uint32_t) {}) != kNoNode;
  }

  // f(AtlasNodeView) -> bool: parents before children, the fitted half before the rest; false skips
  // the branch. Without recursion: many narrow textures make a tree as deep as the atlas is wide.
  template <class F>
  void visit(F&& f) const {
    std::vector<std::uint32_t> ids;  // of the inner nodes on the way from the root
    std::uint32_t next_id = 0;
    for (std::uint32_t handle = 0; handle != kNoNode;) {
      stop_if_asked();
      const Node& node = nodes_[handle];
      const AtlasNodeView view{.handle = handle,
                               .id = next_id++,
                               .parent = ids.empty() ? kNoNode : ids.back(),
                               .slot = is_second(handle),
                               .depth = static_cast<std::uint32_t>(ids.size()),
                               .rect = node.rect,
                               .leaf = node.is_leaf(),
                               .cut_vertically = node.cut_vertically,
                               .texture = node.texture};
      if (f(view) && !view.leaf) {
        ids.push_back(view.id);
        handle = node.first_child;
        continue;
      }
      for (; is_second(handle); handle = nodes_[handle].parent) ids.pop_back();
      handle = handle == 0 ? kNoNode : handle + 1;
    }
  }

  int width() const { return nodes_[0].rect.width; }
  int height() const { return nodes_[0].rect.height; }
  std::int64_t used_area() const { return used_area_; }
  std::int64_t free_area() const { return std::int64_t{width()} * height() - used_area_; }
  // Leaves looked at by insert and has_room; not those in branches passed by.
  std::uint64_t leaf_tests() const { return leaf_tests_; }
  std::uint64_t bytes() const { return nodes_.capacity() * sizeof(Node); }

 private:
  static constexpr std::uint32_t kNoNode = 0xffffffff;

  struct Node {
    Rect rect;
    std::uint32_t parent = kNoNode;
    std::uint32_t first_child = 0;  // of two neighbours; 0 in a leaf
    int free_width = 0;             // the greatest of a free leaf at or below this node
    int free_height = 0;
    std::optional<TextureId> texture;
    bool cut_vertically = false;
    bool is_leaf() const { return first_child == 0; }
  };

  static void require_size(TextureId id, int width, int height);
  bool is_second(std::uint32_t node) const;              // of its parent's two
  std::uint32_t after_branch(std::uint32_t node) const;  // in order of descent; kNoNode at the end
  // The first half is so many pixels wide, or high; its handle is given, the other's is the next.
  std::uint32_t cut_at(std::uint32_t leaf, bool vertically, int pixels);
  std::vector<std::uint32_t> free_leaves() const;  // in order of descent
  void gather_free(std::uint32_t node);            // of it and all above
  void add_leaf(const Rect& rect, std::uint32_t parent);
  void take(std::uint32_t leaf, TextureId id);

  bool may_fit(std::uint32_t node, int width, int height) const {
    return width <= nodes_[node].free_width && height <= nodes_[node].free_height;
  }

  // The first free leaf that fits, or kNoNode. Calls passed(node) for each branch passed by, a
  // single leaf among them.
  template <class Passed>
  std::uint32_t first_fit(int width, int height, Passed&& passed) const {
    for (std::uint32_t node = 0; node != kNoNode;) {
      stop_if_asked();
      leaf_tests_ += nodes_[node].is_leaf();
      if (!may_fit(node, width, height)) {
        passed(node);
        node = after_branch(node);
      } else if (nodes_[node].is_leaf()) {
        return node;
      } else {
        node = nodes_[node].first_child;
      }
    }
    return kNoNode;
  }

  template <class Observer>
  void tell_leaves(std::uint32_t top, TextureId id, Observer& observer) const {
    if constexpr (!std::is_same_v<std::remove_cvref_t<Observer>, NoAtlasObserver>) {
      const std::uint32_t end = after_branch(top);
      for (std::uint32_t node = top; node != end;) {
        stop_if_asked();
        const Node& n = nodes_[node];
        if (n.is_leaf())
          observer(AtlasEvent{n.texture ? AtlasEvent::Kind::used : AtlasEvent::Kind::too_small,
                              node, id});
        node = n.is_leaf() ? after_branch(node) : n.first_child;
      }
    }
  }

  std::vector<Node> nodes_;  // the root first
  std::int64_t used_area_ = 0;
  mutable std::uint64_t leaf_tests_ = 0;
};

// What a screen costs that is drawn from textures: each draw needs its image bound, and binding
// another one is what takes time.

// A rectangle of a screen, in its pixels, that shows an image.
struct ScreenElement {
  std::uint32_t image = 0;
  Rect place;
};

// Indices of the elements, sorted by image as far as that shows: an element's layer is one above
// the highest of those earlier ones that it covers a part of, and each layer is sorted by itself,
// equal images in their order. What lies over another element is still drawn after it.
std::vector<std::size_t> sorted_by_image(const std::vector<ScreenElement>& elements);

// One unit that holds one image, none at first.
struct Binder {
  std::optional<std::uint32_t> bound = {};
  std::uint64_t bindings = 0;
  std::uint64_t draws = 0;

  // Before a draw from this image; true if another one, or none, was bound.
  bool bind(std::uint32_t image);
  // One draw from the image that is bound; there must be one.
  void draw();
};

}  // namespace lantern::atlas
