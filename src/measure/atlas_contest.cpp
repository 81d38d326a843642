#include "measure/atlas_contest.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "atlas/atlas.hpp"
#include "base/error.hpp"
#include "base/suggest.hpp"
#include "measure/peer_modules.hpp"

namespace lantern::measure {
namespace {

class TaughtPacker : public TexturePacker {
 public:
  TaughtPacker(std::span<const TextureSize> sizes, bool partly)
      : sizes_(sizes.begin(), sizes.end()), partly_(partly) {}

  bool pack(int width, int height) override {
    std::vector<TextureId> order(sizes_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, std::greater(), [&](TextureId id) {
      return std::tuple(sizes_[id].height, sizes_[id].width, ~id);
    });
    places_.assign(sizes_.size(), std::nullopt);
    Atlas atlas(width, height);
    bool all = true;
    for (const TextureId id : order) {
      if (const auto rect = atlas.insert(id, sizes_[id].width, sizes_[id].height))
        places_[id] = TexturePlace{*rect, false};
      else
        all = false;
      if (!all && !partly_) break;
    }
    leaf_tests_ += atlas.leaf_tests();
    bytes_ = atlas.bytes();
    return all;
  }
  std::vector<std::optional<TexturePlace>> places() const override { return places_; }
  std::uint64_t leaf_tests() const override { return leaf_tests_; }
  std::uint64_t bytes() const override {
    return bytes_ + places_.capacity() * sizeof(std::optional<TexturePlace>);
  }

 private:
  std::vector<TextureSize> sizes_;
  bool partly_;
  std::vector<std::optional<TexturePlace>> places_;
  std::uint64_t leaf_tests_ = 0, bytes_ = 0;
};

class ChoosingPacker : public TexturePacker {
 public:
  ChoosingPacker(std::span<const TextureSize> sizes, bool turn, bool partly)
      : sizes_(sizes.begin(), sizes.end()), turn_(turn), partly_(partly) {}

  bool pack(int width, int height) override {
    const Rect leaf{0, 0, width, height};
    Packer packer(sizes_, turn_);
    const Packing packing = partly_ ? packer.pack_most({&leaf, 1}) : packer.pack({&leaf, 1});
    places_.clear();
    if (packing.complete || partly_) places_ = places_of(packing, {&leaf, 1}, sizes_.size());
    leaf_tests_ += packing.leaf_tests;
    bytes_ = packer.bytes() + packing.steps.capacity() * sizeof(PackStep);
    return packing.complete;
  }
  std::vector<std::optional<TexturePlace>> places() const override { return places_; }
  std::uint64_t leaf_tests() const override { return leaf_tests_; }
  std::uint64_t bytes() const override {
    return bytes_ + places_.capacity() * sizeof(std::optional<TexturePlace>);
  }

 private:
  std::vector<TextureSize> sizes_;
  bool turn_, partly_;
  std::vector<std::optional<TexturePlace>> places_;
  std::uint64_t leaf_tests_ = 0, bytes_ = 0;
};

constexpr PeerModule kAtlasModules[] = {
    {"stb_rect_pack", "lantern_peer_atlas_stb.so", "libstb-dev"},
};

// "stb_rect_pack" asks for both of its ways.
bool is_named(const AtlasPeer& contestant, const std::string& name) {
  return contestant.name == name || contestant.name.starts_with(name + ":");
}

}  // namespace

std::vector<AtlasPeer> own_atlas_packers(bool partly) {
  const auto choosing = [&](bool turn) {
    return [=](std::span<const TextureSize> sizes) {
      return std::make_unique<ChoosingPacker>(sizes, turn, partly);
    };
  };
  return {{"first_fit", "", "the taught rule: the tallest first, each into the first leaf it fits",
           [=](std::span<const TextureSize> sizes) {
             return std::make_unique<TaughtPacker>(sizes, partly);
           }},
          {"best_texture", "", "each free leaf chooses the texture that leaves least of it",
           choosing(false)},
          {"best_texture:turn", "", "the same, and textures may be turned by 90 degrees",
           choosing(true)}};
}

std::vector<AtlasPeer> atlas_contestants(const AtlasBenchConfig& config,
                                         std::vector<std::string>& missing) {
  std::vector<AtlasPeer> all = own_atlas_packers(config.atlas.has_value());
  if (config.peers)
    for (AtlasPeer& peer : peers_of<AtlasPeer>(kAtlasModules, "lantern_atlas_peers", missing))
      all.push_back(std::move(peer));
  for (const std::string& name : config.only) {
    if (std::ranges::any_of(all, [&](const AtlasPeer& one) { return is_named(one, name); }))
      continue;
    std::vector<std::string_view> names;
    for (const AtlasPeer& one : all) names.push_back(one.name);
    throw Refused(with_suggestion(fmt::format("there is no contestant '{}'", name), name, names));
  }
  if (!config.only.empty())
    std::erase_if(all, [&](const AtlasPeer& one) {
      return std::ranges::none_of(config.only,
                                  [&](const std::string& name) { return is_named(one, name); });
    });
  return all;
}

void check_layout(std::span<const TextureSize> sizes,
                  std::span<const std::optional<TexturePlace>> places, AtlasRow& row) {
  std::vector<Rect> rects;
  std::int64_t area = 0;
  for (std::size_t i = 0; i < std::min(sizes.size(), places.size()); ++i) {
    if (!places[i]) continue;
    const auto& [r, turned] = *places[i];
    rects.push_back(r);
    area += std::int64_t{r.width} * r.height;
    row.turned += turned;
    row.wrong_sizes +=
        sizes[i] != (turned ? TextureSize{r.height, r.width} : TextureSize{r.width, r.height});
    row.outside += r.x < 0 || r.y < 0 || r.x + r.width > row.width || r.y + r.height > row.height;
  }
  row.packed = rects.size();
  row.fill = static_cast<double>(area) / (static_cast<double>(row.width) * row.height);
  // Sorted by x, only those that begin before a texture ends can lie over it.
  std::ranges::sort(rects, {}, &Rect::x);
  for (std::size_t i = 0; i < rects.size(); ++i) {
    stop_if_asked();
    const Rect& a = rects[i];
    for (std::size_t j = i + 1; j < rects.size() && rects[j].x < a.x + a.width; ++j)
      row.overlaps += rects[j].y < a.y + a.height && a.y < rects[j].y + rects[j].height;
  }
  if (row.overlaps + row.outside + row.wrong_sizes == 0) return;
  row.status = "wrong";
  row.reason = fmt::format("{} overlaps, {} outside, {} of another size", row.overlaps, row.outside,
                           row.wrong_sizes);
}

}  // namespace lantern::measure
