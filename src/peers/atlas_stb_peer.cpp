// stb_rect_pack by Sean Barrett: a skyline packer, by both of its heuristics.

#include "measure/atlas_peer.hpp"

#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb_rect_pack.h>

namespace lantern::peers {
namespace {

using measure::AtlasPeer;

class StbPacker : public measure::TexturePacker {
 public:
  StbPacker(std::span<const TextureSize> sizes, int heuristic) : heuristic_(heuristic) {
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      stbrp_rect rect{};
      rect.id = static_cast<int>(i);
      rect.w = sizes[i].width;
      rect.h = sizes[i].height;
      rects_.push_back(rect);
    }
  }

  // As many nodes as the atlas is wide, as its header advises. It sorts the rectangles itself, the
  // tallest first, and gives them back in order.
  bool pack(int width, int height) override {
    nodes_.resize(static_cast<std::size_t>(width));
    stbrp_context context;
    stbrp_init_target(&context, width, height, nodes_.data(), width);
    stbrp_setup_heuristic(&context, heuristic_);
    return stbrp_pack_rects(&context, rects_.data(), static_cast<int>(rects_.size())) == 1;
  }

  std::vector<std::optional<TexturePlace>> places() const override {
    std::vector<std::optional<TexturePlace>> places;
    for (const stbrp_rect& r : rects_)
      places.push_back(r.was_packed ? std::optional(TexturePlace{{r.x, r.y, r.w, r.h}, false})
                                    : std::nullopt);
    return places;
  }

  std::uint64_t bytes() const override {
    return nodes_.capacity() * sizeof(stbrp_node) + rects_.capacity() * sizeof(stbrp_rect) +
           sizeof(stbrp_context);
  }

 private:
  int heuristic_;
  std::vector<stbrp_rect> rects_;
  std::vector<stbrp_node> nodes_;
};

}  // namespace
extern "C" __attribute__((visibility("default"))) void lantern_atlas_peers(
    std::vector<AtlasPeer>& peers) {
  const auto add = [&](const char* name, const char* words, int heuristic) {
    peers.push_back({name, LANTERN_PEER_VERSION,
                     std::string("skyline, ") + words + "; as many nodes as the atlas is wide",
                     [=](std::span<const atlas::TextureSize> sizes) {
                       return std::make_unique<peers::StbPacker>(sizes, heuristic);
                     }});
  };
  add("stb_rect_pack", "the lowest place, its default", STBRP_HEURISTIC_Skyline_default);
  add("stb_rect_pack:best_fit", "the place that wastes least",
      STBRP_HEURISTIC_Skyline_BF_sortHeight);
}

}  // namespace lantern::peers
