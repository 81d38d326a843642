// The atlas and its textures.
#include <algorithm>

#include <fmt/format.h>

#include "base/random.hpp"
#include "scenario/draft.hpp"

namespace lantern {
namespace {

bool has_room_for_textures(std::size_t count, Place where, Draft& draft) {
  return draft.has_room_for(draft.scenario.textures.size() + count, kMostTextures, "textures",
                            where);
}

void read_texture(const TomlValue& value, Draft& draft) {
  const TableReader table = open(value, language_table("texture"), draft);
  const Vec<2> size = table.two("size").value_or(Vec<2>(1.0));
  const TextureSpec texture{
      table.text("name").value_or(""), static_cast<int>(size.x), static_cast<int>(size.y),
      static_cast<int>(table.whole("color").value_or(1)), draft.position(value.where)};
  if (!has_room_for_textures(1, value.where, draft)) return;
  if (!texture.name.empty())
    draft.textures.add(texture.name, {draft.scenario.textures.size(), 1, table.place("name")}, true,
                       draft.problems);
  draft.scenario.textures.push_back(texture);
}

// Multiples of `multiple` between two lengths, counted in that unit.
struct Lengths {
  std::int64_t least = 1;
  std::int64_t most = 1;
};

Lengths read_lengths(const TableReader& table, int axis, Draft& draft) {
  const std::int64_t multiple = table.whole("multiple").value_or(1);
  const auto least = static_cast<std::int64_t>(table.two("min").value_or(Vec<2>(1.0))[axis]);
  const auto most = static_cast<std::int64_t>(table.two("max").value_or(Vec<2>(1e9))[axis]);
  const Lengths lengths{(least + multiple - 1) / multiple, most / multiple};
  if (lengths.least <= lengths.most) return lengths;
  draft.problems.add(table.place(table.has("max") ? "max" : "min"),
                     fmt::format("no {} from {} to {} is a multiple of {}",
                                 axis == 0 ? "width" : "height", least, most, multiple));
  return {};
}

void read_texture_pattern(const TomlValue& value, Draft& draft) {
  const TableReader table = open(value, language_table("texture_pattern"), draft);
  const std::string name = table.text("name").value_or("");
  const auto count = static_cast<std::size_t>(table.whole("count").value_or(1));
  const Lengths widths = read_lengths(table, 0, draft);
  const Lengths heights = read_lengths(table, 1, draft);
  if (!has_room_for_textures(count, table.place("count"), draft) || name.empty()) return;

  Random random(derived_seed(table, name, draft));
  const auto multiple = static_cast<int>(table.whole("multiple").value_or(1));
  std::vector<TextureSpec> made(count);
  for (TextureSpec& texture : made) {
    texture.width = static_cast<int>(random.whole(widths.least, widths.most)) * multiple;
    texture.height = static_cast<int>(random.whole(heights.least, heights.most)) * multiple;
    texture.where = draft.position(value.where);
  }
  if (table.text("order") == "tallest_first")
    std::stable_sort(made.begin(), made.end(), [](const TextureSpec& a, const TextureSpec& b) {
      return a.height != b.height ? a.height > b.height : a.width > b.width;
    });

  auto& textures = draft.scenario.textures;
  const NamedRange all{textures.size(), count, table.place("name")};
  if (!draft.textures.add(name, all, true, draft.problems)) return;
  for (std::size_t i = 0; i < count; ++i) {
    made[i].name = fmt::format("{}{}", name, i + 1);
    made[i].color = cycled_color(table.whole("color").value_or(0), i);
    const NamedRange one{textures.size(), 1, table.place("name")};
    draft.textures.add(made[i].name, one, false, draft.problems);
    textures.push_back(std::move(made[i]));
  }
}

}  // namespace

void read_atlas(const TableReader& file, Draft& draft) {
  if (file.has("atlas")) draft.scenario.atlas.emplace();  // a bad one is told once
  for (const TomlValue* value : file.tables("atlas")) {
    const TableReader table = open(*value, language_table("atlas"), draft);
    const Vec<2> size = table.two("size").value_or(Vec<2>(1.0));
    draft.scenario.atlas =
        AtlasSpec{static_cast<int>(size.x), static_cast<int>(size.y), draft.position(value->where)};
    if (file.has("world"))
      draft.problems.add(value->where, "a scenario has either a [world] or an [atlas], not both",
                         "write two scenarios");
  }
  const auto textures = file.tables("texture");
  const auto patterns = file.tables("texture_pattern");
  if (!file.has("atlas") && (!textures.empty() || !patterns.empty()))
    draft.problems.add((textures.empty() ? patterns : textures)[0]->where,
                       "textures need an [atlas]", "add [atlas] with size = [512, 512]");
  for (const TomlValue* value : textures) read_texture(*value, draft);
  for (const TomlValue* value : patterns) read_texture_pattern(*value, draft);
}

}  // namespace lantern
